//! Shaking force and shaking moment: what the mechanism exerts on the ground.
//!
//! ```text
//! F = Σ f          over joints, drivers, springs, dampers and torques between a body and the ground   [N]
//! M = Σ (r × f + τ)    about the ground's origin                                                      [N·m]
//! ```
//!
//! Weights are in it, since they reach the ground through these; applied `force`s and `torque`s come from outside and are not,
//! but for a torque whose `relative_to` is ground. So F = Σ (weights and applied forces) − d/dt Σ m v, and likewise M
//! (Berkof and Lowen, J. Eng. Ind. 91, 1969, of the inertia part alone). Checked against that balance in `tests/report.rs`.

use super::rows::{Columns, Frame, Place};
use crate::element::Applied;
use crate::system::{Evaluation, Inputs, System};
use linkdyn_linear::math::Vec2;
use linkdyn_model::{DriverKind, ForceKind, GROUND, JointKind, Model};
use linkdyn_output::Trajectory;

/// A force at a place and a torque.
#[derive(Debug, Clone, Copy, Default)]
struct Wrench {
    force: Vec2,
    /// About the ground's origin.
    moment: f64,
}

impl Wrench {
    fn add(&mut self, sign: f64, place: Vec2, force: Vec2, torque: f64) {
        self.force += force * sign;
        self.moment += sign * (place.x * force.y - place.y * force.x + torque);
    }
}

/// What reaches the ground through one element.
enum Share {
    /// A joint: force at the second point and torque, both on the second body; −1 where the ground is the first.
    Joint {
        sign: f64,
        at: Place,
        force: [usize; 2],
        torque: Option<usize>,
    },
    /// A rotation driver: torque on the body.
    Torque { sign: f64, effort: usize },
    /// A translation driver: force along the axis on the second body.
    Along {
        sign: f64,
        at: Place,
        guide: Frame,
        axis: Vec2,
        effort: usize,
    },
    /// A force element between ground and a moving body: the opposite of what it exerts on that body.
    Element { element: usize, body: usize },
}

/// Shaking force and moment of every row; none where no joint forces are in the table or nothing touches the ground.
pub fn shaking(model: &Model, system: &System, table: &Trajectory) -> Option<Vec<[f64; 3]>> {
    let columns = Columns::of(table);
    let shares = shares(model, system, &columns)?;
    let bodies: Vec<Frame> = model
        .bodies
        .keys()
        .filter(|b| *b != GROUND)
        .map(|b| Frame::of(&columns, b))
        .collect::<Option<_>>()?;
    let rates: Vec<Option<[usize; 3]>> = model
        .bodies
        .keys()
        .filter(|b| *b != GROUND)
        .map(|b| columns.find(b, ["vx", "vy", "omega"]))
        .collect();
    let mut evaluation = Evaluation::new(system);
    let mut inputs = Inputs::still(system);
    let (mut q, mut v) = (vec![0.0; system.n()], vec![0.0; system.n()]);
    let mut pull = vec![0.0; system.n()];
    let has_elements = shares
        .iter()
        .any(|share| matches!(share, Share::Element { .. }));
    let rows = table.rows().map(|row| {
        if has_elements {
            inputs.set_time(system, row[0]);
            for (k, (frame, rates)) in bodies.iter().zip(&rates).enumerate() {
                let rho = frame.turn(row, system.bodies[k].origin);
                let (origin, angle) = frame.pose(row);
                let columns = system.layout.moving(k);
                columns.write(&mut q, [origin.x - rho.x, origin.y - rho.y, angle]);
                let [vx, vy, omega] =
                    rates.map_or([0.0; 3], |rates| rates.map(|column| row[column]));
                columns.write(&mut v, [vx + omega * rho.y, vy - omega * rho.x, omega]);
            }
            evaluation.set_position(&q);
            evaluation.set_velocity(&v);
        }
        let mut sum = Wrench::default();
        for share in &shares {
            match share {
                Share::Joint {
                    sign,
                    at,
                    force,
                    torque,
                } => {
                    sum.add(
                        *sign,
                        at.at(row),
                        Vec2::from(force.map(|c| row[c])),
                        torque.map_or(0.0, |c| row[c]),
                    );
                }
                Share::Torque { sign, effort } => {
                    sum.add(*sign, Vec2::zeros(), Vec2::zeros(), row[*effort])
                }
                Share::Along {
                    sign,
                    at,
                    guide,
                    axis,
                    effort,
                } => {
                    sum.add(
                        *sign,
                        at.at(row),
                        guide.turn(row, *axis) * row[*effort],
                        0.0,
                    );
                }
                Share::Element { element, body } => {
                    let columns = system.layout.moving(*body);
                    pull[columns.range()].fill(0.0);
                    let mut applied = Applied::to(&mut pull, &system.layout);
                    system.forces[*element].apply(&evaluation.instant(&inputs), &mut applied);
                    let [fx, fy, torque] = columns.read(&pull);
                    let [x, y, _] = columns.read(&q);
                    sum.add(-1.0, Vec2::new(x, y), Vec2::new(fx, fy), torque);
                }
            }
        }
        [sum.force.x, sum.force.y, sum.moment]
    });
    Some(rows.collect())
}

/// −1 where the ground is first, 1 where it is second, none where it is neither.
fn side(first: &str, second: &str) -> Option<f64> {
    match (first == GROUND, second == GROUND) {
        (true, _) => Some(-1.0),
        (false, true) => Some(1.0),
        (false, false) => None,
    }
}

fn shares(model: &Model, system: &System, columns: &Columns) -> Option<Vec<Share>> {
    let mut shares = Vec::new();
    for (name, joint) in &model.joints {
        let [first, second] = &joint.between;
        let Some(sign) = side(&first.body, &second.body) else {
            continue;
        };
        let owner = format!("joint.{name}");
        let force = columns.find(&owner, ["fx", "fy"])?;
        let torque = columns.find(&owner, ["torque"]).map(|[torque]| torque);
        shares.push(Share::Joint {
            sign,
            at: Place::of(model, columns, second)?,
            force,
            torque,
        });
    }
    for (name, driver) in &model.drivers {
        let effort = columns
            .find(&format!("driver.{name}"), ["effort"])
            .map(|[effort]| effort);
        match &driver.kind {
            DriverKind::Rotation { body, relative_to } => {
                let other = relative_to.as_deref().unwrap_or(GROUND);
                if let Some(sign) = side(other, body) {
                    shares.push(Share::Torque {
                        sign,
                        effort: effort?,
                    });
                }
            }
            DriverKind::Translation { joint } => {
                let joint = &model.joints[joint];
                let [first, second] = &joint.between;
                let (Some(sign), Some(axis)) = (side(&first.body, &second.body), axis(&joint.kind))
                else {
                    continue;
                };
                let (at, guide) = (
                    Place::of(model, columns, second)?,
                    Frame::of(columns, &first.body)?,
                );
                shares.push(Share::Along {
                    sign,
                    at,
                    guide,
                    axis,
                    effort: effort?,
                });
            }
        }
    }
    let body = |name: &str| system.bodies.iter().position(|body| body.name == name);
    for (element, force) in model.forces.values().enumerate() {
        let ends = match &force.kind {
            ForceKind::Spring {
                between: [first, second],
                ..
            } => [&first.body, &second.body],
            ForceKind::TorsionSpring {
                between: [first, second],
                ..
            } => [first, second],
            ForceKind::Torque {
                body,
                relative_to: Some(other),
                ..
            } => [body, other],
            ForceKind::Load { .. }
            | ForceKind::Torque {
                relative_to: None, ..
            } => continue,
        };
        if ends.iter().any(|end| *end == GROUND) {
            shares.extend(
                ends.iter()
                    .find_map(|end| body(end))
                    .map(|body| Share::Element { element, body }),
            );
        }
    }
    (!shares.is_empty()).then_some(shares)
}

/// Direction of a guide in its body's frame, length one.
pub(super) fn axis(kind: &JointKind) -> Option<Vec2> {
    match kind {
        JointKind::Prismatic { axis, .. } | JointKind::Slot { axis } => {
            Some(Vec2::from(*axis).normalize())
        }
        JointKind::Revolute { .. } | JointKind::Gear { .. } | JointKind::Fixed { .. } => None,
    }
}
