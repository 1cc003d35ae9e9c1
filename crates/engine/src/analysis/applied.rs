//! Applied forces and torques as columns: their vectors in global axes, row by row.

use super::rows::{Columns, Frame, Replay};
use crate::element::formula::Strength;
use crate::system::{ForceRole, System};
use linkdyn_linear::math::Vec2;
use linkdyn_output::{Channel, Column, LoadQuantity};

/// A load as its columns have it.
enum Load<'s> {
    /// Components in the axes of a body.
    Force([&'s Strength; 2], Frame),
    Torque(&'s Strength),
}

/// Columns `force.NAME.fx`, `fy` \[N\] or `force.NAME.torque` [N·m] of the loads.
pub struct Loads<'s> {
    pub headings: Vec<Column>,
    loads: Vec<Load<'s>>,
    /// The mechanism in a row, where a load asks how it moves.
    replay: Option<Replay<'s>>,
}

impl<'s> Loads<'s> {
    /// Beside rows with these columns.
    pub fn new(system: &'s System, columns: &Columns) -> Self {
        let (mut headings, mut loads) = (Vec::new(), Vec::new());
        for (k, force) in system.force_data.iter().enumerate() {
            let mut add = |quantities: &[LoadQuantity]| {
                headings.extend(quantities.iter().map(|&quantity| {
                    Column::of(Channel::Load(k, quantity), &force.name, quantity.unit())
                }));
            };
            match &force.role {
                ForceRole::Load {
                    vector: [x, y],
                    frame,
                    ..
                } => {
                    add(&[LoadQuantity::Fx, LoadQuantity::Fy]);
                    // Without the body's pose in the table its axes are taken for the ground's.
                    let frame = Frame::of(columns, *frame).unwrap_or(Frame::GROUND);
                    loads.push(Load::Force([x, y], frame));
                }
                ForceRole::Torque { value, .. } => {
                    add(&[LoadQuantity::Torque]);
                    loads.push(Load::Torque(value));
                }
                ForceRole::Spring { .. } | ForceRole::Cable { .. } | ForceRole::Stretch { .. } => {}
            }
        }
        let is_asked = !system.formulas.is_empty();
        Loads {
            headings,
            loads,
            replay: is_asked.then(|| Replay::new(system, columns)).flatten(),
        }
    }

    /// Appends the loads of a row; NaN where they follow from what the row does not have.
    pub fn push(&mut self, row: &[f64], line: &mut Vec<f64>) {
        if let Some(replay) = &mut self.replay {
            replay.take(row);
        }
        let value = |strength: &Strength| match (strength.of_time(row[0]), &self.replay) {
            (Some(value), _) => value,
            (None, Some(replay)) => strength.value(&replay.kinematics()),
            (None, None) => f64::NAN,
        };
        for load in &self.loads {
            match load {
                Load::Force([x, y], frame) => {
                    let vector = frame.turn(row, Vec2::new(value(x), value(y)));
                    line.extend([vector.x, vector.y]);
                }
                Load::Torque(strength) => line.push(value(strength)),
            }
        }
    }
}
