//! The types of a shape. Lengths are in metres, in the frame of the body; the ground is body 0.

use super::joint::{Joint, JointKind, is_not};
use super::numbers::PointId;
use serde::{Deserialize, Serialize};

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
    /// Numbers of the points between which the axis of its cross-section lies.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub section: Option<[usize; 2]>,
    /// How it bends, of an elastic link.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bending: Option<Bending>,
}

/// How the axis of an elastic link bends, to first order.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Bending {
    /// Places along it in the frame of the body \[m\].
    pub places: Vec<[f64; 2]>,
    /// How each of them moves by each amplitude of the link, `rod.q1` and so on [–].
    pub moves: Vec<Vec<[f64; 2]>>,
    /// The curvature that each amplitude gives to each of them [1/m²]; empty where it is not known.
    pub curvatures: Vec<Vec<f64>>,
    /// Where the amplitudes are among the poses of a small motion: the number of a pose, and which of its numbers.
    #[serde(skip)]
    pub amplitudes: Vec<[usize; 2]>,
}

impl Bending {
    /// Whether there is one number of each kind for each place and amplitude.
    pub(super) fn is_whole(&self) -> bool {
        let places = self.places.len();
        let amplitudes = self.moves.first().map_or(0, Vec::len);
        places > 1
            && self.moves.len() == places
            && self.moves.iter().all(|by| by.len() == amplitudes)
            && [0, places].contains(&self.curvatures.len())
            && self.curvatures.iter().all(|by| by.len() == amplitudes)
    }
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
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
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
    /// A coordinate of a point.
    Point {
        /// The point.
        point: PointId,
        /// The direction of the coordinate.
        axis: [f64; 2],
    },
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
