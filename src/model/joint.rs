//! Joints between two body points.

use super::clearance::Clearance;

/// `body.point`, split.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PointRef {
    pub body: String,
    pub point: String,
}

/// A joint from the first point to the second.
#[derive(Debug, Clone, PartialEq)]
pub struct Joint {
    pub between: [PointRef; 2],
    pub kind: JointKind,
}

/// What the joint lets move.
#[derive(Debug, Clone, PartialEq)]
pub enum JointKind {
    /// The points coincide; with `clearance` the first body holds the bearing, the second the journal.
    Revolute { clearance: Option<Box<Clearance>> },
    /// The second point stays on the line through the first along `axis` (first body's frame, any length but zero); relative angle fixed [rad].
    Prismatic { axis: [f64; 2], angle: f64 },
    /// The points coincide, relative angle fixed [rad].
    Fixed { angle: f64 },
}
