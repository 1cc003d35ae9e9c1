//! Refuses what can't be drawn: a summary may be written by anyone.

use super::joint::JointKind;
use super::numbers::PointId;
use super::parts::{Bending, DriverKind, Shape};
use crate::fault::Fault;

/// Most parts of a kind, and points of a body, that are drawn.
pub const MOST: usize = 2000;

impl Shape {
    /// Refuses what can't be drawn; `key` is where the shape comes from.
    ///
    /// # Errors
    /// When something is named that is not there, or there is too much.
    pub fn check(&self, key: &str) -> Result<(), Fault> {
        let most_points = self.bodies.iter().map(|body| body.points.len()).max();
        let counts = [
            self.bodies.len(),
            self.joints.len(),
            self.springs.len(),
            self.torsion_springs.len(),
            self.loads.len(),
            self.drivers.len(),
            self.points.len(),
            most_points.unwrap_or(0),
        ];
        let fault = |text: String| Err(Fault::Drawing(text));
        if counts.into_iter().any(|count| count > MOST) {
            return fault(format!(
                "the mechanism has more than {MOST} parts of a kind: too many for a picture"
            ));
        }
        if self
            .named_bodies()
            .any(|body| body >= self.bodies.len().max(1))
        {
            return fault(format!(
                "the key {key:?} names a body that it does not have"
            ));
        }
        if self.named_points().any(|point| self.point(point).is_none()) {
            return fault(format!(
                "the key {key:?} names a point that it does not have"
            ));
        }
        if self.named_joints().any(|joint| joint >= self.joints.len()) {
            return fault(format!(
                "the key {key:?} names a joint that it does not have"
            ));
        }
        let mut bending = self.bodies.iter().filter_map(|body| body.bending.as_ref());
        if !bending.all(Bending::is_whole) {
            return fault(format!(
                "the key {key:?} has a link whose places and deflections do not belong together"
            ));
        }
        if self
            .loads
            .iter()
            .any(|load| load.times.len() != load.values.len())
        {
            return fault(format!(
                "the key {key:?} has a load with times and values that do not belong together"
            ));
        }
        Ok(())
    }

    /// All points that parts name.
    fn named_points(&self) -> impl Iterator<Item = PointId> {
        let joints = self.joints.iter().flat_map(|joint| joint.between);
        let springs = self.springs.iter().flat_map(|spring| spring.between);
        let lengths = self.drivers.iter().filter_map(|driver| match driver.kind {
            DriverKind::Length { between } => Some(between.to_vec()),
            DriverKind::Point { point, .. } => Some(vec![point]),
            DriverKind::Rotation { .. } | DriverKind::Translation { .. } => None,
        });
        let loads = self.loads.iter().filter_map(|load| load.at);
        let bodies = self.bodies.iter().enumerate();
        let axes = bodies.flat_map(|(body, own)| {
            let points = own.section.into_iter().flatten();
            points.map(move |point| (body, point))
        });
        joints
            .chain(springs)
            .chain(lengths.flatten())
            .chain(loads)
            .chain(axes)
            .chain(self.points.iter().copied())
    }

    /// All bodies that parts name.
    fn named_bodies(&self) -> impl Iterator<Item = usize> {
        let carriers = self.joints.iter().filter_map(|joint| match &joint.kind {
            JointKind::Gear { gear, .. } => Some((*gear)?.carrier),
            _ => None,
        });
        let driven = self.drivers.iter().flat_map(|driver| match driver.kind {
            DriverKind::Rotation {
                body, relative_to, ..
            } => [Some(body), Some(relative_to)],
            DriverKind::Translation { .. }
            | DriverKind::Length { .. }
            | DriverKind::Point { .. } => [None, None],
        });
        let twisted = self.torsion_springs.iter().flat_map(|spring| spring.bodies);
        self.named_points()
            .map(|(body, _)| body)
            .chain(carriers)
            .chain(driven.flatten())
            .chain(twisted)
            .chain(self.loads.iter().map(|load| load.body))
    }

    /// All joints that parts name.
    fn named_joints(&self) -> impl Iterator<Item = usize> {
        let driven = self.drivers.iter().filter_map(|driver| match driver.kind {
            DriverKind::Rotation { pin, .. } => pin,
            DriverKind::Translation { joint } => Some(joint),
            DriverKind::Length { .. } | DriverKind::Point { .. } => None,
        });
        driven.chain(self.torsion_springs.iter().filter_map(|spring| spring.pin))
    }
}
