//! Joints: what is seen of each kind, and how it follows from the model. The sign of each is in `mechanism/joints.rs`.

use std::f64::consts::TAU;

use super::numbers::{Numbers, PointId};
use linkdyn_model::outline::{Corner, arc_centre};
use linkdyn_model::{self as model, ClearanceModel, OneWay};
use serde::{Deserialize, Serialize};

/// Angle between corners of an arc of an outline \[rad\].
const CORNER: f64 = 0.1;

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
    /// A round body that rolls on another.
    Rolling {
        /// Radii \[m\]; negative of a ring.
        radii: [f64; 2],
    },
    /// Two pulleys with a belt.
    Belt {
        /// The pulleys.
        belt: Pulleys,
    },
    /// A pin in rubber.
    Bushing,
    /// An elastic bar.
    Beam,
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

impl Profile {
    /// How far it reaches from the cam's point \[m\].
    pub fn radius(&self) -> f64 {
        let far = self.outline.iter().map(|[x, y]| x.hypot(*y));
        far.fold(0.0, f64::max)
    }
}

/// What is false is left out, as before there was the key.
pub(super) fn is_not(value: &bool) -> bool {
    !value
}

impl JointKind {
    /// Radii about its two points within which it is drawn \[m\].
    pub fn radii(&self) -> [f64; 2] {
        match self {
            JointKind::Gear { gear, .. } => gear.map(|gear| gear.radii).unwrap_or_default(),
            JointKind::Contact { radius, .. } => [0.0, *radius],
            JointKind::Rack { rack } => [rack.radius.abs(), 0.0],
            JointKind::Rolling { radii } => radii.map(f64::abs),
            JointKind::Belt { belt } => belt.radii,
            JointKind::Cam(cam) => [cam.radius(), cam.roller.or(cam.reach).unwrap_or(0.0)],
            _ => [0.0; 2],
        }
    }

    /// Whether it joins rims of wheels, whose points belong to other joints.
    pub fn joins_rims(&self) -> bool {
        matches!(
            self,
            JointKind::Gear { .. }
                | JointKind::Rack { .. }
                | JointKind::Rolling { .. }
                | JointKind::Belt { .. }
        )
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

/// A joint of a model.
pub(super) fn joint_of(numbers: &Numbers, name: &str, joint: &model::Joint) -> Joint {
    let kind = match &joint.kind {
        model::JointKind::Revolute { clearance, .. } => JointKind::Revolute {
            clearance: clearance.as_deref().and_then(clearance_of),
        },
        model::JointKind::Prismatic { axis, .. } => JointKind::Prismatic { axis: *axis },
        model::JointKind::Slot { axis, .. } => JointKind::Slot { axis: *axis },
        model::JointKind::Gear { ratio, .. } => JointKind::Gear {
            ratio: *ratio,
            gear: pitch_circles(numbers, name, joint, *ratio),
        },
        model::JointKind::Cam(cam) => JointKind::Cam(Box::new(Profile {
            outline: Vec::new(),
            reach: None,
            roller: cam.roller_radius,
            face: cam.face,
        })),
        model::JointKind::Rack { axis, radius, .. } => JointKind::Rack {
            rack: PitchLine {
                axis: unit(*axis),
                radius: *radius,
            },
        },
        model::JointKind::Rolling { radii, .. } => JointKind::Rolling { radii: *radii },
        model::JointKind::Belt { radii, strands, .. } => JointKind::Belt {
            belt: Pulleys {
                radii: *radii,
                crossed: *strands == model::Strands::Crossed,
            },
        },
        model::JointKind::Bushing(_) => JointKind::Bushing,
        model::JointKind::Beam(_) => JointKind::Beam,
        model::JointKind::Fixed { .. } => JointKind::Fixed,
        model::JointKind::Contact { radius, arc, .. } => JointKind::Contact {
            outlines: joint
                .kind
                .outlines_around(numbers.place(&joint.between[0]))
                .iter()
                .map(|way| corners(way))
                .collect(),
            radius: *radius,
            arc: *arc,
        },
    };
    Joint {
        name: name.to_string(),
        between: numbers.ends(&joint.between),
        kind,
        limits: joint.stops.limits,
        one_way: joint.stops.one_way,
    }
}

/// An outline with arcs as so many corners.
fn corners(outline: &[Corner]) -> Vec<[f64; 2]> {
    let mut corners: Vec<[f64; 2]> = outline.iter().take(1).map(|(first, _)| *first).collect();
    for pair in outline.windows(2) {
        let [(from, _), (to, radius)] = [pair[0], pair[1]];
        if radius != 0.0 {
            let [x, y] = arc_centre(from, to, radius);
            let angle = |place: [f64; 2]| (place[1] - y).atan2(place[0] - x);
            let turn = match radius > 0.0 {
                true => (angle(to) - angle(from)).rem_euclid(TAU),
                false => -(angle(from) - angle(to)).rem_euclid(TAU),
            };
            let parts = (turn.abs() / CORNER).ceil();
            corners.extend((1..parts as usize).map(|k| {
                let (sin, cos) = (angle(from) + turn * k as f64 / parts).sin_cos();
                [x + radius.abs() * cos, y + radius.abs() * sin]
            }));
        }
        corners.push(to);
    }
    corners
}

/// The same direction, length one.
fn unit([u, v]: [f64; 2]) -> [f64; 2] {
    let length = u.hypot(v);
    [u / length, v / length]
}

/// Wheels roll on each other: |R₁| = |ratio|·|R₂|, R₂ = ℓ/(1 − ratio), where ℓ is the distance of their centres.
fn pitch_circles(
    numbers: &Numbers,
    name: &str,
    joint: &model::Joint,
    ratio: f64,
) -> Option<PitchCircles> {
    let carrier = numbers.model.carrier(name, joint)?.ok()?;
    let [[x1, y1], [x2, y2]] = carrier.centres;
    PitchCircles::of_wheels(ratio, (x2 - x1).hypot(y2 - y1), numbers.body(carrier.body))
}

impl PitchCircles {
    /// Pitch circles of wheels at that distance \[m\]; `None` if they are unbounded.
    pub fn of_wheels(ratio: f64, distance: f64, carrier: usize) -> Option<Self> {
        let second = (distance / (1.0 - ratio)).abs();
        let radii = [second * ratio.abs(), second];
        let is_drawable = |radius: &f64| radius.is_finite() && *radius < 1e3 * distance;
        radii.iter().all(is_drawable).then_some(PitchCircles {
            radii,
            internal: ratio > 0.0,
            carrier,
        })
    }
}

/// The clearance, where its model leaves an eccentricity.
fn clearance_of(clearance: &model::Clearance) -> Option<Clearance> {
    let word = match clearance.model {
        ClearanceModel::Ideal => return None,
        ClearanceModel::MasslessLink => "massless_link",
        ClearanceModel::TwoState => "two_state",
        ClearanceModel::ThreeState => "three_state",
        ClearanceModel::Contact => "contact",
    };
    Some(Clearance {
        model: word.into(),
        radius: clearance.radius?,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wheels_touch_and_roll() {
        for (ratio, radii) in [
            (-2.0, [2.0, 1.0]),
            (-0.5, [1.0, 2.0]),
            (3.0, [4.5, 1.5]),
            (0.25, [1.0, 4.0]),
        ] {
            let found = PitchCircles::of_wheels(ratio, 3.0, 0)
                .expect("wheels")
                .radii;
            assert!(
                (0..2).all(|i| (found[i] - radii[i]).abs() < 1e-12),
                "{ratio}: {found:?}"
            );
        }
        assert_eq!(PitchCircles::of_wheels(1.0, 1.0, 0), None);
    }
}
