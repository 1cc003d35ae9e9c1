//! Shaking force and shaking moment: what the mechanism exerts on the ground.
//!
//! ```text
//! F = Σ f          over joints, drivers, springs, dampers and torques between a body and the ground   [N]
//! M = Σ (r × f + τ)    about the ground's origin                                                      [N·m]
//! ```
//!
//! Weights are in it, since they reach the ground through these; applied `force`s and `torque`s come from outside and are not,
//! but for a torque whose `relative_to` is ground. So F = Σ (weights and applied forces) − d/dt Σ m v, and likewise M
//! (Berkof and Lowen, J. Eng. Ind. 91, 1969, of the inertia part alone). Checked against that balance in `tests/fast/shaking.rs`.

use super::rows::{Columns, Frame, PlaceInRow, Replay};
use crate::element::{Applied, Axis, BodyId, direction};
use crate::system::{DriverRole, System};
use linkdyn_linear::math::Vec2;
use linkdyn_output::{
    Channel, Column, DriverQuantity, JointQuantity, LoadQuantity, ShakingQuantity,
};

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
        at: PlaceInRow,
        force: [usize; 2],
        torque: Option<usize>,
    },
    /// A rotation driver: torque on the body.
    Torque { sign: f64, effort: usize },
    /// A translation driver: force along the axis on the second body.
    Along {
        sign: f64,
        at: PlaceInRow,
        guide: Frame,
        axis: Vec2,
        effort: usize,
    },
    /// A driven length: force on the second end, away from the first.
    Between {
        sign: f64,
        ends: [PlaceInRow; 2],
        effort: usize,
    },
    /// A force element between ground and a moving body: the opposite of what it exerts on that body.
    Element { element: usize, body: usize },
}

/// Shaking force and moment, row by row.
pub struct Shaking<'s> {
    shares: Vec<Share>,
    exerted: Exerted<'s>,
    has_elements: bool,
}

impl<'s> Shaking<'s> {
    /// Next to rows with these columns, or `None` if they have no joint forces or nothing touches the ground.
    pub fn new(system: &'s System, columns: &Columns) -> Option<Self> {
        let shares = shares(system, columns)?;
        let has_elements = shares
            .iter()
            .any(|share| matches!(share, Share::Element { .. }));
        Some(Shaking {
            exerted: Exerted::new(Replay::new(system, columns)?),
            shares,
            has_elements,
        })
    }

    /// Appends force and moment of a row.
    pub fn push(&mut self, row: &[f64], line: &mut Vec<f64>) {
        if self.has_elements {
            self.exerted.replay.take(row);
        }
        let mut sum = Wrench::default();
        for share in &self.shares {
            share.add_to(&mut sum, row, &mut self.exerted);
        }
        line.extend([sum.force.x, sum.force.y, sum.moment]);
    }
}

/// The headings of its columns.
pub fn headings() -> Vec<Column> {
    let quantities = [
        ShakingQuantity::Fx,
        ShakingQuantity::Fy,
        ShakingQuantity::Moment,
    ];
    let heading =
        |quantity: ShakingQuantity| Column::of(Channel::Shaking(quantity), "", quantity.unit());
    quantities.map(heading).into()
}

impl Share {
    fn add_to(&self, sum: &mut Wrench, row: &[f64], exerted: &mut Exerted) {
        match self {
            Share::Joint {
                sign,
                at,
                force,
                torque,
            } => {
                let torque = torque.map_or(0.0, |column| row[column]);
                let force = Vec2::from(force.map(|column| row[column]));
                sum.add(*sign, at.at(row), force, torque);
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
                let force = guide.turn(row, *axis) * row[*effort];
                sum.add(*sign, at.at(row), force, 0.0);
            }
            Share::Between { sign, ends, effort } => {
                let [first, second] = ends.each_ref().map(|end| end.at(row));
                if let Some((along, _)) = direction(second - first) {
                    sum.add(*sign, second, along * row[*effort], 0.0);
                }
            }
            Share::Element { element, body } => {
                let (place, force, torque) = exerted.by(*element, *body);
                sum.add(-1.0, place, force, torque);
            }
        }
    }
}

/// What force elements exert at the state of a row.
struct Exerted<'s> {
    replay: Replay<'s>,
    pull: Vec<f64>,
}

impl<'s> Exerted<'s> {
    fn new(replay: Replay<'s>) -> Self {
        Exerted {
            pull: vec![0.0; replay.system.n()],
            replay,
        }
    }

    /// Centre of mass of a moving body, and force and torque about it that an element exerts there.
    fn by(&mut self, element: usize, body: usize) -> (Vec2, Vec2, f64) {
        let system = self.replay.system;
        let columns = system.layout.moving(body);
        self.pull[columns.range()].fill(0.0);
        let mut to = Applied::to(&mut self.pull, &system.layout);
        system.forces[element].apply(&self.replay.kinematics(), &mut to);
        let [fx, fy, torque] = columns.read(&self.pull);
        let [x, y, _] = columns.read(&self.replay.q);
        (Vec2::new(x, y), Vec2::new(fx, fy), torque)
    }
}

/// −1 where the ground is first, 1 where it is second, `None` if it is neither.
fn side([first, second]: [BodyId; 2]) -> Option<f64> {
    match (first == BodyId::GROUND, second == BodyId::GROUND) {
        (true, _) => Some(-1.0),
        (false, true) => Some(1.0),
        (false, false) => None,
    }
}

fn shares(system: &System, columns: &Columns) -> Option<Vec<Share>> {
    let mut shares = joint_shares(system, columns)?;
    shares.extend(driver_shares(system, columns)?);
    let on_ground = |between: &[BodyId; 2]| between.contains(&BodyId::GROUND);
    for (element, force) in system.force_data.iter().enumerate() {
        if let Some(between) = force.role.between().filter(on_ground) {
            let moving = between.into_iter().find(|body| *body != BodyId::GROUND);
            shares.extend(moving.map(|body| Share::Element {
                element,
                body: body.0 - 1,
            }));
        }
    }
    shares.extend(stroke_shares(system, columns)?);
    (!shares.is_empty()).then_some(shares)
}

/// Shares of the stops of springs and actuators on the ground, or `None` if their force is not in the table.
fn stroke_shares(system: &System, columns: &Columns) -> Option<Vec<Share>> {
    let mut shares = Vec::new();
    for force in 0..system.force_data.len() {
        let stop = system.stops_of_force(force).next();
        let Some(stop) = stop.and_then(|id| system.contacts[id.0].stop()) else {
            continue;
        };
        let ends = [stop.first, stop.second];
        let Some(sign) = side(ends.map(|end| end.body)) else {
            continue;
        };
        shares.push(Share::Between {
            sign,
            ends: [
                PlaceInRow::of(system, columns, &ends[0])?,
                PlaceInRow::of(system, columns, &ends[1])?,
            ],
            effort: columns.find(Channel::Load(force, LoadQuantity::Stop))?,
        });
    }
    Some(shares)
}

/// Shares of the joints on the ground, or `None` if a force is not in the table.
fn joint_shares(system: &System, columns: &Columns) -> Option<Vec<Share>> {
    let mut shares = Vec::new();
    for (k, joint) in system.joints.iter().enumerate() {
        let Some(sign) = side(joint.bodies()) else {
            continue;
        };
        let find = |quantity| columns.find(Channel::Joint(k, quantity));
        shares.push(Share::Joint {
            sign,
            at: PlaceInRow::of(system, columns, &joint.points()[1])?,
            force: [find(JointQuantity::Fx)?, find(JointQuantity::Fy)?],
            // A pin carries no torque but that of its stops; the force of a slide's is among its own.
            torque: match joint.role().axis() {
                None => find(JointQuantity::Torque).or_else(|| find(JointQuantity::Stop)),
                Some(_) => find(JointQuantity::Torque),
            },
        });
    }
    Some(shares)
}

/// Shares of the drivers that act on the ground, or `None` if a driving force is not in the table.
fn driver_shares(system: &System, columns: &Columns) -> Option<Vec<Share>> {
    let mut shares = Vec::new();
    for (k, driver) in system.drivers.iter().enumerate() {
        let effort = columns.find(Channel::Driver(k, DriverQuantity::Effort));
        match driver.role {
            DriverRole::Rotation { body, relative_to } => {
                if let Some(sign) = side([relative_to, body]) {
                    let effort = effort?;
                    shares.push(Share::Torque { sign, effort });
                }
            }
            DriverRole::Length { between } => {
                let Some(sign) = side(between.map(|end| end.body)) else {
                    continue;
                };
                let [first, second] = &between;
                shares.push(Share::Between {
                    sign,
                    ends: [
                        PlaceInRow::of(system, columns, first)?,
                        PlaceInRow::of(system, columns, second)?,
                    ],
                    effort: effort?,
                });
            }
            DriverRole::Coordinate { origin, axis } => {
                let axis = match axis {
                    Axis::X => Vec2::x(),
                    Axis::Y => Vec2::y(),
                    // no driver of a model turns a body like this
                    Axis::Theta => continue,
                };
                let Some(sign) = side([BodyId::GROUND, origin.body]) else {
                    continue;
                };
                shares.push(Share::Along {
                    sign,
                    at: PlaceInRow::of(system, columns, &origin)?,
                    guide: Frame::of(columns, BodyId::GROUND)?,
                    axis,
                    effort: effort?,
                });
            }
            DriverRole::Translation { joint } => {
                let joint = &system.joints[joint.0];
                let (Some(sign), Some(axis)) = (side(joint.bodies()), joint.role().axis()) else {
                    continue;
                };
                shares.push(Share::Along {
                    sign,
                    at: PlaceInRow::of(system, columns, &joint.points()[1])?,
                    guide: Frame::of(columns, joint.bodies()[0])?,
                    axis,
                    effort: effort?,
                });
            }
        }
    }
    Some(shares)
}
