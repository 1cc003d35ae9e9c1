//! Model → shape. Points and bodies that do not exist were refused when the model was checked.

use std::collections::HashMap;
use std::f64::consts::TAU;

use super::parts::{
    Body, Clearance, Driver, DriverKind, Joint, JointKind, Load, PitchCircles, PitchLine, PointId,
    Profile, Pulleys, Shape, Spring, TorsionSpring,
};
use linkdyn_model::outline::{Corner, arc_centre};
use linkdyn_model::{self as model, ClearanceModel, ForceKind, GROUND, Model, PointRef};

/// Angle between corners of an arc of an outline \[rad\].
const CORNER: f64 = 0.1;
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
            DriverKind::Rotation { .. } | DriverKind::Translation { .. } => None,
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
            ForceKind::Actuator { between, .. } => self.springs.push(Spring {
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
            ForceKind::Torque { body, .. } => self.loads.push(Load {
                name,
                body: numbers.body(body),
                ..Load::default()
            }),
        }
    }
}

/// Numbers of bodies, ground first, and of their points.
struct Numbers<'m> {
    model: &'m Model,
    bodies: HashMap<&'m str, usize>,
}

impl<'m> Numbers<'m> {
    fn new(model: &'m Model) -> Self {
        Numbers {
            model,
            bodies: names(model).zip(0..).collect(),
        }
    }

    fn body(&self, name: &str) -> usize {
        self.bodies.get(name).copied().unwrap_or(0)
    }

    fn point(&self, point: &PointRef) -> PointId {
        let body = self.model.bodies.get(&point.body);
        let number = body.and_then(|body| body.points.get_index_of(&point.point));
        (self.body(&point.body), number.unwrap_or(0))
    }

    fn place(&self, point: &PointRef) -> [f64; 2] {
        let body = self.model.bodies.get(&point.body);
        let place = body.and_then(|body| body.points.get(&point.point));
        place.copied().unwrap_or_default()
    }

    fn ends(&self, ends: &[PointRef; 2]) -> [PointId; 2] {
        ends.each_ref().map(|end| self.point(end))
    }
}

/// Names of the bodies, ground first.
fn names(model: &Model) -> impl Iterator<Item = &str> {
    let moving = model.bodies.keys().map(String::as_str);
    [GROUND]
        .into_iter()
        .chain(moving.filter(|name| *name != GROUND))
}

fn bodies(model: &Model) -> Vec<Body> {
    let body_of = |name: &str| {
        let body = model.bodies.get(name);
        let points = body.into_iter().flat_map(|body| &body.points);
        Body {
            name: name.to_string(),
            points: points
                .map(|(name, [x, y])| (name.clone(), *x, *y))
                .collect(),
            com: body
                .and_then(|body| body.com)
                .filter(|_| model.bodies.len() <= MANY),
        }
    };
    names(model).map(body_of).collect()
}

fn joint_of(numbers: &Numbers, name: &str, joint: &model::Joint) -> Joint {
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
        model::JointKind::Belt { radii, strands, .. } => JointKind::Belt {
            belt: Pulleys {
                radii: *radii,
                crossed: *strands == model::Strands::Crossed,
            },
        },
        model::JointKind::Bushing(_) => JointKind::Bushing,
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
        model::DriverKind::Translation { joint } => DriverKind::Translation {
            joint: numbers.model.joints.get_index_of(joint)?,
        },
    };
    Some(Driver {
        name: name.to_string(),
        kind,
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
