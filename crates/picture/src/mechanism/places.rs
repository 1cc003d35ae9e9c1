//! Points and directions of bodies in global axes.

use crate::poses::{Pose, global};
use crate::shape::{PointId, Shape};

/// A point in global coordinates. The shape was checked: every point that is named is there.
pub fn place(shape: &Shape, pose: &[Pose], point: PointId) -> [f64; 2] {
    global(pose[point.0], shape.point(point).unwrap_or_default())
}

/// A direction of a body in global axes.
pub fn turned([_, _, angle]: Pose, direction: [f64; 2]) -> [f64; 2] {
    global([0.0, 0.0, angle], direction)
}
