//! Applied forces and torques as columns: their vectors in global axes, row by row.

use super::rows::{Columns, Frame};
use crate::motion::Law;
use crate::system::{ForceRole, System};
use linkdyn_linear::math::Vec2;
use linkdyn_output::{Channel, Column, LoadQuantity};

/// A load as its columns have it.
enum Load<'s> {
    /// Components in the axes of a body.
    Force([&'s Law; 2], Frame),
    Torque(&'s Law),
}

/// Columns `force.NAME.fx`, `fy` \[N\] or `force.NAME.torque` [N·m] of the loads.
pub struct Loads<'s> {
    pub headings: Vec<Column>,
    loads: Vec<Load<'s>>,
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
                ForceRole::Spring { .. } => {}
            }
        }
        Loads { headings, loads }
    }

    /// Appends the loads of a row.
    pub fn push(&self, row: &[f64], line: &mut Vec<f64>) {
        for load in &self.loads {
            match load {
                Load::Force([x, y], frame) => {
                    let vector = Vec2::new(x.jet(row[0])[0], y.jet(row[0])[0]);
                    let vector = frame.turn(row, vector);
                    line.extend([vector.x, vector.y]);
                }
                Load::Torque(value) => line.push(value.jet(row[0])[0]),
            }
        }
    }
}
