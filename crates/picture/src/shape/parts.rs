//! The types of a shape. Lengths are in metres, in the frame of the body; the ground is body 0.

use linkdyn_model::OneWay;
use serde::{Deserialize, Serialize};

/// A body and the number of one of its points.
pub type PointId = (usize, usize);

/// All parts of a mechanism that can be drawn.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Shape {
    /// Bodies, the ground first.
    pub bodies: Vec<Body>,
    /// Joints, in the order of the model.
    pub joints: Vec<Joint>,
    /// Springs and dampers between two points.
    pub springs: Vec<Spring>,
    /// Springs and dampers between the angles of two bodies.
    pub torsion_springs: Vec<TorsionSpring>,
    /// Applied forces and torques.
    pub loads: Vec<Load>,
    /// Prescribed motions.
    pub drivers: Vec<Driver>,
    /// Points whose paths are drawn.
    pub points: Vec<PointId>,
}

/// A body.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Body {
    /// Name in the model.
    pub name: String,
    /// Name, x and y of each point \[m\].
    pub points: Vec<(String, f64, f64)>,
    /// Centre of mass \[m\].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub com: Option<[f64; 2]>,
}

/// A joint between two points.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Joint {
    /// Name in the model.
    pub name: String,
    /// First and second point.
    pub between: [PointId; 2],
    /// What the joint is, with its own parameters.
    #[serde(flatten)]
    pub kind: JointKind,
    /// Where its way ends, below and above [rad or m].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub limits: Option<[Option<f64>; 2]>,
    /// The way in which it turns alone.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub one_way: Option<OneWay>,
}

/// Kinds of joints, by the words of the model file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(tag = "type", rename_all = "snake_case")]
pub enum JointKind {
    /// A pin.
    Revolute {
        /// Bearing and journal that leave an eccentricity.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        clearance: Option<Clearance>,
    },
    /// A block on a straight guide.
    Prismatic {
        /// Direction of the guide in the frame of the first body, of any length but zero.
        axis: [f64; 2],
    },
    /// A pin in a straight slot.
    Slot {
        /// Direction of the slot in the frame of the first body, of any length but zero.
        axis: [f64; 2],
    },
    /// Two wheels in mesh.
    Gear {
        /// Turns of the second wheel per turn of the first, seen from the carrier.
        ratio: f64,
        /// Pitch circles, where the carrier is known.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        gear: Option<PitchCircles>,
    },
    /// A cam and its follower.
    Cam(Box<Profile>),
    /// A wheel that rolls on a line of the second body.
    Rack {
        /// The line and its wheel.
        rack: PitchLine,
    },
    /// Two pulleys with a belt.
    Belt {
        /// The pulleys.
        belt: Pulleys,
    },
    /// A pin in rubber.
    Bushing,
    /// A weld.
    Fixed,
    /// A tip that may touch an outline.
    Contact {
        /// Points of each way of the outline in the frame of the first body, material on the left \[m\]; closed where it ends
        /// where it began.
        outlines: Vec<Vec<[f64; 2]>>,
        /// Radius of the tip \[m\].
        radius: f64,
        /// Directions in the second body between which the tip is round \[rad\].
        #[serde(default, skip_serializing_if = "Option::is_none")]
        arc: Option<[f64; 2]>,
    },
}

/// What is seen of a cam and its follower.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Profile {
    /// Corners of the profile from the first point, in the frame of its body \[m\].
    #[serde(default)]
    pub outline: Vec<[f64; 2]>,
    /// Radius of a roller about the second point \[m\].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub roller: Option<f64>,
    /// How far a flat face reaches to either side \[m\].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reach: Option<f64>,
    /// Direction of a flat face through the second point, in the frame of its body.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub face: Option<[f64; 2]>,
}

/// Pitch circles of two wheels in mesh.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct PitchCircles {
    /// Radii of the first and the second wheel \[m\].
    pub radii: [f64; 2],
    /// Whether the smaller wheel lies in the larger one.
    pub internal: bool,
    /// The body on which both wheels turn.
    pub carrier: usize,
}

/// A wheel's pitch circle, and the line of the second body on which it rolls.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct PitchLine {
    /// Direction of the line in the frame of the second body, length one.
    pub axis: [f64; 2],
    /// Radius of the wheel \[m\]; negative where the line lies to the left of its centre, looking along the axis.
    pub radius: f64,
}

/// The pulleys of a belt.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Pulleys {
    /// Radii of the first and the second one \[m\].
    pub radii: [f64; 2],
    /// Whether the strands cross.
    #[serde(default, skip_serializing_if = "is_not")]
    pub crossed: bool,
}

/// Clearance of a pin.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Clearance {
    /// Clearance model, by the word of the model file.
    pub model: String,
    /// Radial clearance \[m\].
    pub radius: f64,
}

/// A spring, damper or actuator between two points.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Spring {
    /// Name in the model.
    pub name: String,
    /// First and second point.
    pub between: [PointId; 2],
    /// A damper without stiffness.
    #[serde(default)]
    pub damper: bool,
    /// A spring with a parallel damper.
    #[serde(default, skip_serializing_if = "is_not")]
    pub damped: bool,
    /// An actuator: a cylinder with its rod.
    #[serde(default, skip_serializing_if = "is_not")]
    pub actuator: bool,
    /// A stretch of a cable.
    #[serde(default, skip_serializing_if = "is_not")]
    pub cable: bool,
    /// The driver of this name has its length.
    #[serde(default, skip_serializing_if = "is_not")]
    pub driven: bool,
    /// Where its stroke ends \[m\].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub limits: Option<[Option<f64>; 2]>,
}

/// A spring or damper between the angles of two bodies.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TorsionSpring {
    /// Name in the model.
    pub name: String,
    /// First and second body.
    pub bodies: [usize; 2],
    /// The pin between both bodies, around which it is drawn; else it is drawn at the first point of the moving body.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pin: Option<usize>,
    /// A damper without stiffness.
    #[serde(default)]
    pub damper: bool,
}

/// An applied force or torque.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Load {
    /// Name in the model.
    pub name: String,
    /// Where a force acts; none for a torque.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at: Option<PointId>,
    /// The body on which it acts.
    pub body: usize,
    /// Instants of `values` \[s\], ascending; a single one for a load that does not change.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub times: Vec<f64>,
    /// Force in global axes \[N\], or torque [N·m] and 0.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub values: Vec<[f64; 2]>,
}

/// A prescribed motion.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Driver {
    /// Name in the model.
    pub name: String,
    /// What is driven.
    #[serde(flatten)]
    pub kind: DriverKind,
}

/// What a driver moves, by the words of the model file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(tag = "type", rename_all = "snake_case")]
pub enum DriverKind {
    /// The angle of a body.
    Rotation {
        /// The driven body.
        body: usize,
        /// The body against which it turns.
        relative_to: usize,
        /// The pin between both, around which it is drawn; else it is drawn at the first point of the driven body.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        pin: Option<usize>,
    },
    /// The slide of a joint along its axis.
    Translation {
        /// The driven joint.
        joint: usize,
    },
    /// The distance of two points.
    Length {
        /// First and second point.
        between: [PointId; 2],
    },
}

/// What is false is left out, as before there was the key.
fn is_not(value: &bool) -> bool {
    !value
}

impl Shape {
    /// Place of a point in the frame of its body \[m\].
    pub fn point(&self, (body, number): PointId) -> Option<[f64; 2]> {
        let (_, x, y) = self.bodies.get(body)?.points.get(number)?;
        Some([*x, *y])
    }

    /// The pin that joins two bodies, where there is one.
    pub fn pin_between(&self, bodies: [usize; 2]) -> Option<usize> {
        self.joints.iter().position(|joint| {
            let [first, second] = joint.between.map(|(body, _)| body);
            let is_pin = matches!(joint.kind, JointKind::Revolute { .. });
            is_pin && ([first, second] == bodies || [second, first] == bodies)
        })
    }
}

impl Shape {
    /// Gives the cam of a joint its corners, from its point \[m\], and how far a face reaches.
    pub fn take_profile(&mut self, joint: usize, outline: Vec<[f64; 2]>, reach: f64) {
        if let Some(joint) = self.joints.get_mut(joint)
            && let JointKind::Cam(profile) = &mut joint.kind
        {
            profile.outline = outline;
            profile.reach = profile.face.map(|_| reach);
        }
    }
}

impl Profile {
    /// How far it reaches from the cam's point \[m\].
    pub fn radius(&self) -> f64 {
        let far = self.outline.iter().map(|[x, y]| x.hypot(*y));
        far.fold(0.0, f64::max)
    }
}

impl Joint {
    /// Direction of a guide or slot in the frame of the first body, length one.
    pub fn axis(&self) -> Option<[f64; 2]> {
        match self.kind {
            JointKind::Prismatic { axis: [u, v] } | JointKind::Slot { axis: [u, v] } => {
                let length = u.hypot(v);
                (length > 0.0).then(|| [u / length, v / length])
            }
            _ => None,
        }
    }

    /// Whether one of its bodies is the ground.
    pub fn is_on_ground(&self) -> bool {
        self.between.iter().any(|(body, _)| *body == 0)
    }
}
