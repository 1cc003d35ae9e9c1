//! Drivers and initial values.

use super::Compiler;
use super::laws::law;
use super::roles::axis_of;
use crate::element::coordinate::Coordinate;
use crate::element::distance::Distance;
use crate::element::driven::{DriveId, Rotation, Translation};
use crate::element::prismatic::Guide;
use crate::element::{Axis, BodyId, Constraint, Marker, Measure};
use crate::system::{Block, DriverData, DriverId, Origin};
use linkdyn_linear::math::{Vec2, unit};
use linkdyn_model::DriverKind;
use std::sync::Arc;

impl Compiler<'_> {
    pub(super) fn add_drivers(&mut self) {
        for (k, (name, driver)) in self.model.drivers.iter().enumerate() {
            let drive = DriveId(k);
            let (constraint, measure): (Arc<dyn Constraint>, Measure) = match &driver.kind {
                DriverKind::Rotation { body, relative_to } => {
                    let relative_to = relative_to
                        .as_deref()
                        .map_or(BodyId::GROUND, |name| self.body(name));
                    (
                        Arc::new(Rotation {
                            body: self.body(body),
                            relative_to,
                            drive,
                        }),
                        Measure::Angle,
                    )
                }
                DriverKind::Length { between } => {
                    let [first, second] = between.each_ref().map(|end| self.marker(end));
                    let length = Distance {
                        first,
                        second,
                        drive,
                    };
                    (Arc::new(length), Measure::Length)
                }
                DriverKind::Point { point, axis } => {
                    let coordinate = Coordinate {
                        origin: self.marker(point),
                        axis: axis_of(*axis),
                        value: 0.0,
                        drive: Some(drive),
                    };
                    (Arc::new(coordinate), Measure::Length)
                }
                DriverKind::Translation { joint } => {
                    let joint = &self.model.joints[joint];
                    // The loader lets translations drive joints that slide only.
                    let axis = joint.kind.guide();
                    let axis = axis.map_or(Vec2::x(), |axis| unit(Vec2::from(axis)));
                    let (first, second) = (
                        self.marker(&joint.between[0]),
                        self.marker(&joint.between[1]),
                    );
                    (
                        Arc::new(Translation {
                            guide: Guide {
                                first,
                                second,
                                axis,
                            },
                            drive,
                        }),
                        Measure::Length,
                    )
                }
            };
            self.system.drivers.push(DriverData {
                name: name.clone(),
                role: self.driver_role(&driver.kind),
                law: law(&driver.motion),
                measure,
                share: driver.share.unwrap_or(1.0),
                is_steered: false,
            });
            self.push_block(constraint, Origin::Driver(DriverId(k)));
        }
    }

    pub(super) fn add_initial(&mut self) {
        for (name, initial) in &self.model.initial {
            let body = self.body(name);
            self.system
                .branch
                .extend(initial.branch.map(|turn| (body, turn)));
            let origin = Marker {
                body,
                s: -self.com[body.0],
            };
            let values = [
                (Axis::X, "x", "vx", initial.x, initial.vx),
                (Axis::Y, "y", "vy", initial.y, initial.vy),
                (
                    Axis::Theta,
                    "angle",
                    "angular_velocity",
                    initial.angle,
                    initial.angular_velocity,
                ),
            ];
            for (axis, key, rate_key, value, rate) in values {
                if let Some(value) = value {
                    let constraint = Coordinate {
                        origin,
                        axis,
                        value,
                        drive: None,
                    };
                    let origin = Origin::Initial(Box::new(format!("{name}.{key}")));
                    self.system.starts.push(constraint.clone());
                    let block = Block::alone(Arc::new(constraint), origin);
                    self.system.initial.push(block);
                }
                if let Some(rate) = rate {
                    let row = Coordinate {
                        origin,
                        axis,
                        value: rate,
                        drive: None,
                    };
                    self.system
                        .initial_rates
                        .push((format!("{name}.{rate_key}"), row));
                }
            }
        }
    }
}
