//! Model → shape. Points and bodies that do not exist were refused when the model was checked.

use super::joint::joint_of;
use super::numbers::{Numbers, names};
use super::parts::{Body, Driver, DriverKind, Load, Shape, Spring, TorsionSpring};
use linkdyn_model::{self as model, ForceKind, Model};

/// Bodies beyond which centres of mass are not drawn.
const MANY: usize = 2000;

impl Shape {
    /// The shape of a model; what its loads are over time is not known yet.
    pub fn of_model(model: &Model) -> Shape {
        let numbers = Numbers::new(model);
        let mut shape = Shape {
            bodies: bodies(model),
            joints: model
                .joints
                .iter()
                .map(|(name, joint)| joint_of(&numbers, name, joint))
                .collect(),
            points: model
                .points
                .iter()
                .map(|point| numbers.point(point))
                .collect(),
            ..Shape::default()
        };
        shape.drivers = model
            .drivers
            .iter()
            .filter_map(|(name, driver)| driver_of(&numbers, &shape, name, &driver.kind))
            .collect();
        let lengths = shape.drivers.iter().filter_map(|driver| match driver.kind {
            DriverKind::Length { between } => Some(Spring {
                name: driver.name.clone(),
                between,
                actuator: true,
                driven: true,
                ..Spring::default()
            }),
            DriverKind::Rotation { .. }
            | DriverKind::Translation { .. }
            | DriverKind::Point { .. } => None,
        });
        shape.springs = lengths.collect();
        for (name, force) in &model.forces {
            shape.add_force(&numbers, name, &force.kind);
            // what has a stroke is the last one
            if let (Some(limits), Some(spring)) = (force.stroke.limits, shape.springs.last_mut()) {
                spring.limits = Some(limits);
            }
        }
        shape
    }

    fn add_force(&mut self, numbers: &Numbers, name: &str, kind: &ForceKind) {
        let name = name.to_string();
        match kind {
            ForceKind::Spring {
                between,
                stiffness,
                damping,
                ..
            } => self.springs.push(Spring {
                name,
                between: numbers.ends(between),
                damper: *stiffness == 0.0,
                damped: *stiffness != 0.0 && *damping != 0.0,
                ..Spring::default()
            }),
            ForceKind::Actuator { between, .. }
            | ForceKind::GasSpring { between, .. }
            | ForceKind::Cylinder { between, .. } => self.springs.push(Spring {
                name,
                between: numbers.ends(between),
                actuator: true,
                ..Spring::default()
            }),
            ForceKind::Cable { through, .. } => {
                let stretches = through.windows(2).map(|pair| Spring {
                    name: name.clone(),
                    between: [numbers.point(&pair[0]), numbers.point(&pair[1])],
                    cable: true,
                    ..Spring::default()
                });
                self.springs.extend(stretches);
            }
            ForceKind::TorsionSpring {
                between, stiffness, ..
            } => {
                let bodies = between.each_ref().map(|body| numbers.body(body));
                self.torsion_springs.push(TorsionSpring {
                    name,
                    bodies,
                    pin: self.pin_between(bodies),
                    damper: *stiffness == 0.0,
                });
            }
            ForceKind::Load { at, .. } => {
                let at = numbers.point(at);
                self.loads.push(Load {
                    name,
                    at: Some(at),
                    body: at.0,
                    ..Load::default()
                });
            }
            ForceKind::Torque { body, .. } | ForceKind::DcMotor { body, .. } => {
                self.loads.push(Load {
                    name,
                    body: numbers.body(body),
                    ..Load::default()
                })
            }
        }
    }
}

fn bodies(model: &Model) -> Vec<Body> {
    let body_of = |name: &str| {
        let body = model.bodies.get(name);
        let points = body.into_iter().flat_map(|body| &body.points);
        let section = body.and_then(|body| {
            let section = body.section.as_deref()?;
            let number = |point: &String| body.points.get_index_of(point);
            Some([number(&section.from)?, number(&section.to)?])
        });
        Body {
            name: name.to_string(),
            points: points
                .map(|(name, [x, y])| (name.clone(), *x, *y))
                .collect(),
            com: body
                .and_then(|body| body.com)
                .filter(|_| model.bodies.len() <= MANY),
            section,
            bending: None,
        }
    };
    names(model).map(body_of).collect()
}

/// The driver; `None` if its joint does not exist.
fn driver_of(
    numbers: &Numbers,
    shape: &Shape,
    name: &str,
    kind: &model::DriverKind,
) -> Option<Driver> {
    let kind = match kind {
        model::DriverKind::Rotation { body, relative_to } => {
            let body = numbers.body(body);
            let relative_to = relative_to
                .as_deref()
                .map_or(0, |other| numbers.body(other));
            DriverKind::Rotation {
                body,
                relative_to,
                pin: shape.pin_between([body, relative_to]),
            }
        }
        model::DriverKind::Length { between } => DriverKind::Length {
            between: numbers.ends(between),
        },
        model::DriverKind::Point { point, axis } => DriverKind::Point {
            point: numbers.point(point),
            axis: match axis {
                model::PointAxis::X => [1.0, 0.0],
                model::PointAxis::Y => [0.0, 1.0],
            },
        },
        model::DriverKind::Translation { joint } => DriverKind::Translation {
            joint: numbers.model.joints.get_index_of(joint)?,
        },
    };
    Some(Driver {
        name: name.to_string(),
        kind,
    })
}
