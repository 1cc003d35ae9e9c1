//! The values of drivers in a pose.

use super::places::{place, turned};
use crate::poses::Pose;
use crate::shape::{DriverKind, Shape};

/// Value of a driver: an angle \[rad\], or a slide \[m\].
pub fn driver_value(shape: &Shape, pose: &[Pose], driver: DriverKind) -> f64 {
    match driver {
        DriverKind::Rotation {
            body, relative_to, ..
        } => pose[body][2] - pose[relative_to][2],
        DriverKind::Length { between } => {
            let [a, b] = between.map(|end| place(shape, pose, end));
            (b[0] - a[0]).hypot(b[1] - a[1])
        }
        DriverKind::Point { point, axis } => {
            let [x, y] = place(shape, pose, point);
            axis[0] * x + axis[1] * y
        }
        DriverKind::Translation { joint } => {
            let joint = &shape.joints[joint];
            let [a, b] = joint.between.map(|end| place(shape, pose, end));
            let [u, v] = turned(pose[joint.between[0].0], joint.axis().unwrap_or_default());
            u * (b[0] - a[0]) + v * (b[1] - a[1])
        }
    }
}

/// Least and greatest value of each driver.
pub fn driver_ranges<'p>(
    shape: &Shape,
    poses: impl Iterator<Item = &'p Vec<Pose>>,
) -> Vec<[f64; 2]> {
    let mut ranges = vec![[f64::INFINITY, f64::NEG_INFINITY]; shape.drivers.len()];
    for pose in poses {
        for (driver, [low, high]) in shape.drivers.iter().zip(&mut ranges) {
            let value = driver_value(shape, pose, driver.kind);
            (*low, *high) = (low.min(value), high.max(value));
        }
    }
    ranges
}
