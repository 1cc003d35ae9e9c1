//! Joints between two body points.

use serde::{Deserialize, Serialize};

use super::beam::Beam;
use super::bushing::Bushing;
use super::cam::Cam;
use super::clearance::{Clearance, Friction, ImpactSense};
use super::event::Event;
use super::point::PointRef;
use super::tolerance::Play;
use super::tree::word;
use super::words;

/// A joint from the first point to the second.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize)]
pub struct Joint {
    /// Two points `body.point`, first → second.
    pub between: [PointRef; 2],
    /// What it lets move.
    #[serde(flatten)]
    pub kind: JointKind,
    /// Where its way ends, of revolute, prismatic and slot joints; of a contact what it is made of.
    #[serde(flatten)]
    pub stops: Stops,
}

/// The ends of a joint's way: nothing where it has none.
#[derive(Debug, Clone, PartialEq, Default, Deserialize, Serialize)]
pub struct Stops {
    /// Least and greatest angle θ₂ − θ₁ \[rad\] of a revolute joint, or slide \[m\] along the axis of the others; `None` if the
    /// way has no end.
    pub limits: Option<[Option<f64>; 2]>,
    /// Coefficient of restitution of rigid stops, 0 to 1 [–]; left out: 0.
    pub restitution: Option<f64>,
    /// What it compares; left out: velocities, as files have always meant it.
    pub sense: Option<ImpactSense>,
    /// Stiffness of stops that yield [N·m/rad or N/m], and of each strand of a belt [N/m]; left out: they are rigid.
    pub stiffness: Option<f64>,
    /// Damping of the same [N·m·s/rad or N·s/m]; left out: none.
    pub damping: Option<f64>,
    /// The ends at which the joint latches.
    pub latch: Option<Latch>,
    /// Pull [N·m or N] above which a latch opens; left out: none does.
    pub release: Option<f64>,
    /// When the joint holds at all; left out: always.
    pub active: Option<Box<Timed>>,
    /// When it does not move, of revolute, prismatic and slot joints; left out: never.
    pub lock: Option<Box<Timed>>,
    /// The way in which a revolute joint turns alone; left out: both.
    pub one_way: Option<OneWay>,
}

/// From when until when something holds.
#[derive(Debug, Clone, PartialEq, Default, Deserialize, Serialize)]
pub struct Timed {
    /// Where it closes; left out: it holds at the start.
    pub from: Option<Event>,
    /// Where it opens; left out: no event opens it.
    pub until: Option<Event>,
    /// Force \[N\], of the lock of an angle torque [N·m], above which it opens; left out: none does.
    pub release: Option<f64>,
}

/// The way in which a joint turns.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum OneWay {
    /// The angle of the second body in the first grows alone.
    Forward,
    /// It becomes less alone.
    Backward,
}

/// How the strands of a belt run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Strands {
    /// Beside each other: both pulleys turn the same way.
    #[default]
    Open,
    /// Across: the pulleys turn against each other.
    Crossed,
}

/// At which of its ends a joint latches.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Latch {
    /// Where its coordinate is least.
    Lower,
    /// Where it is greatest.
    Upper,
    /// At either.
    Both,
}

impl Latch {
    /// Whether it is at the lower end, and whether at the upper.
    pub fn sides(self) -> [bool; 2] {
        [self != Latch::Upper, self != Latch::Lower]
    }
}

/// What only some kinds have: a kind that is not named here has none of it.
impl JointKind {
    /// Direction along which it slides, fixed in the first body.
    pub fn guide(&self) -> Option<[f64; 2]> {
        match self {
            JointKind::Prismatic { axis, .. } | JointKind::Slot { axis, .. } => Some(*axis),
            _ => None,
        }
    }

    /// Its clearance.
    pub fn clearance(&self) -> Option<&Clearance> {
        match self {
            JointKind::Revolute { clearance, .. } => clearance.as_deref(),
            _ => None,
        }
    }

    /// Friction beside that of a clearance.
    pub fn friction(&self) -> Option<&Friction> {
        match self {
            JointKind::Revolute { friction, .. }
            | JointKind::Prismatic { friction, .. }
            | JointKind::Contact { friction, .. } => friction.as_deref(),
            _ => None,
        }
    }

    /// Whether its bodies turn against each other about its points.
    pub(crate) fn turns(&self) -> bool {
        matches!(self, JointKind::Revolute { .. } | JointKind::Slot { .. })
    }

    /// Its `type` in a file.
    pub fn word(&self) -> String {
        word(self)
    }

    /// What does not belong together in it: key, message and hint.
    pub(crate) fn conflict(&self) -> Option<[&'static str; 3]> {
        match self {
            // The larger one is that of a ring, and the other one is not.
            JointKind::Rolling { radii, .. } => {
                let [least, most] = [radii[0].min(radii[1]), radii[0].max(radii[1])];
                let fits = least > 0.0 || (most > 0.0 && -least > most);
                (!fits).then_some([
                    "radii",
                    "a ring goes around what rolls in it: its negative radius is the larger one, and the other one is positive",
                    "as in \"radii\": [\"-60 mm\", \"20 mm\"]",
                ])
            }
            _ => None,
        }
    }

    /// Whether a file may write a key of it.
    pub(crate) fn has(&self, key: &str) -> bool {
        let kind = words::kinds("Joint").variant(&self.word());
        kind.is_some_and(|kind| kind.field(key).is_some())
    }
}

/// What the joint lets move.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize)]
#[serde(tag = "type", rename_all = "snake_case")]
pub enum JointKind {
    /// The points coincide; with `clearance` the first body holds the bearing, the second the journal.
    Revolute {
        /// What is between pin and hole; left out: none.
        clearance: Option<Box<Clearance>>,
        /// Friction of the ideal joint, from its own reaction; that of a clearance stands in the clearance. Left out: none.
        friction: Option<Box<Friction>>,
        /// Radius of the pin \[m\] on which `friction` acts, and which it needs.
        pin_radius: Option<f64>,
    },
    /// The second point stays on the line through the first along `axis` (first body's frame, any length but zero); relative angle fixed \[rad\].
    Prismatic {
        /// A direction fixed in the first body; its length does not matter.
        axis: [f64; 2],
        /// Angle of the second body relative to the first \[rad\].
        #[serde(default)]
        angle: f64,
        /// Friction along the axis, from the joint's own reaction; left out: none.
        friction: Option<Box<Friction>>,
        /// Length of the slider on its guide \[m\], centred at the second point: with it the joint's torque presses, too.
        guide_length: Option<f64>,
        /// How far the guided point may be off its line, to either side; left out: not at all.
        play: Option<Play>,
    },
    /// The second point stays on the line through the first along `axis` (first body's frame, any length but zero); the bodies may turn against each other.
    Slot {
        /// A direction fixed in the first body; its length does not matter.
        axis: [f64; 2],
        /// How far the guided point may be off its line, to either side; left out: not at all.
        play: Option<Play>,
    },
    /// Two wheels, each held at its point by a revolute joint to a common carrier, mesh: θ₂ − θ_c = ratio·(θ₁ − θ_c) + angle.
    Gear {
        /// Turns of the second wheel per turn of the first, seen from the carrier: −z₁/z₂ for an external mesh, z₁/z₂ for an internal one.
        ratio: f64,
        /// The body on which both wheels turn; left out: found from the joints.
        carrier: Option<String>,
        /// θ₂ − θ_c − ratio·(θ₁ − θ_c) \[rad\]; left out: as drawn, that of the angles in `pose`.
        angle: Option<f64>,
        /// Arc at the pitch circle \[m\] by which a wheel may turn while the other is held, from flank to flank.
        backlash: Option<f64>,
    },
    /// The profile of the first body, about its point, moves the follower of the second and holds it from both sides.
    Cam(Box<Cam>),
    /// A wheel, the first body, rolls about its point on a line of the second body that goes through that one's point.
    Rack {
        /// Direction of the line, fixed in the second body; its length does not matter.
        axis: [f64; 2],
        /// Radius of the wheel's pitch circle \[m\]; negative where the line lies to the left of the centre, looking along the axis.
        radius: f64,
        /// a·(C − R) + radius·(θ₁ − θ₂) \[m\]; left out: as drawn, that of the poses.
        offset: Option<f64>,
    },
    /// A round body rolls on another, or inside a ring, about their points: in contact and without slip.
    Rolling {
        /// Radii of the first and the second body \[m\]; a negative one is of a ring, inside which the other rolls.
        radii: [f64; 2],
        /// r₁·θ₁ + r₂·θ₂ − (r₁ + r₂)·ψ \[m\], where ψ is the angle from the first point to the contact; left out: as drawn.
        offset: Option<f64>,
    },
    /// Two pulleys with a belt around them, each held at its point by other joints.
    Belt {
        /// Radii of the first and the second pulley \[m\].
        radii: [f64; 2],
        /// How the strands run.
        #[serde(default)]
        strands: Strands,
        /// Tension of both strands of a belt that drives nothing \[N\]; left out: none is known.
        pretension: Option<f64>,
        /// The body in which the line of centres turns little; left out: the one that holds both pulleys.
        carrier: Option<String>,
    },
    /// The points stay near each other: a pin in rubber, which is no constraint.
    Bushing(Box<Bushing>),
    /// An elastic bar holds the points together: no constraint.
    Beam(Box<Beam>),
    /// The points coincide, relative angle fixed \[rad\].
    Fixed {
        /// Angle of the second body relative to the first \[rad\].
        #[serde(default)]
        angle: f64,
    },
    /// A round tip about the second point may touch an outline of the first body: one-sided.
    Contact {
        /// Points `[x, y]` of the outline in the first body's frame \[m\], or `[x, y, r]` where an arc of this radius leads to them,
        /// which turns left where it is positive; the material is on the left.
        outline: Vec<Vec<f64>>,
        /// How often the outline is repeated around the first point, evenly in a turn; left out: it stands once.
        repeat: Option<usize>,
        /// Radius of the tip \[m\], 0 of a point.
        #[serde(default)]
        radius: f64,
        /// Directions in the second body between which the tip is round, turning left \[rad\]; left out: it is a full circle.
        arc: Option<[f64; 2]>,
        /// Friction between both; left out: none.
        friction: Option<Box<Friction>>,
    },
}
