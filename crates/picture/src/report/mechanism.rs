//! What the report draws: the bodies' points and what connects them, as plain numbers. Poses come from the results.
//!
//! Lengths in m, in the frame of the body; bodies by their number, ground is 0; points by (body, number of the point).

use serde::Serialize;

/// A body and a point of it.
pub type PointId = (usize, usize);

/// Everything there is to draw.
#[derive(Debug, Clone, Default, Serialize)]
pub struct Mechanism {
    pub bodies: Vec<Body>,
    pub joints: Vec<Joint>,
    pub springs: Vec<Spring>,
    pub torsion_springs: Vec<TorsionSpring>,
    pub loads: Vec<Load>,
    pub drivers: Vec<Driver>,
    /// Points whose paths are asked for.
    pub points: Vec<PointId>,
}

#[derive(Debug, Clone, Serialize)]
pub struct Body {
    pub name: String,
    /// Name, x, y.
    pub points: Vec<(String, f64, f64)>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub com: Option<[f64; 2]>,
}

#[derive(Debug, Clone, Serialize)]
pub struct Joint {
    pub name: String,
    /// As the model file calls it.
    #[serde(rename = "type")]
    pub kind: &'static str,
    /// First and second point.
    pub between: [PointId; 2],
    /// Direction of a guide in the first body's frame, length one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub axis: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub gear: Option<Gear>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub clearance: Option<Clearance>,
}

/// Pitch circles.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct Gear {
    pub radii: [f64; 2],
    /// One wheel lies in the other.
    pub internal: bool,
    pub carrier: usize,
}

#[derive(Debug, Clone, Copy, Serialize)]
pub struct Clearance {
    pub model: &'static str,
    /// Radial clearance.
    pub radius: f64,
}

#[derive(Debug, Clone, Serialize)]
pub struct Spring {
    pub name: String,
    pub between: [PointId; 2],
    /// A damper, without stiffness.
    pub damper: bool,
}

#[derive(Debug, Clone, Serialize)]
pub struct TorsionSpring {
    pub name: String,
    pub bodies: [usize; 2],
}

/// An applied force or torque; its values are in the results.
#[derive(Debug, Clone, Serialize)]
pub struct Load {
    pub name: String,
    /// Where a force acts; none for a torque.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at: Option<PointId>,
    pub body: usize,
}

#[derive(Debug, Clone, Serialize)]
pub struct Driver {
    pub name: String,
    /// The driven body of a rotation.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub body: Option<usize>,
    /// The body against which it turns.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub relative_to: Option<usize>,
    /// The driven joint of a translation.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joint: Option<usize>,
}
