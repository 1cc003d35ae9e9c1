//! Applied forces and torques as columns: their vectors in global axes, row by row.

use super::rows::{Columns, Frame};
use crate::motion::Law;
use crate::system::compile::value_law;
use linkdyn_linear::math::Vec2;
use linkdyn_model::{self, ForceKind, Model};
use linkdyn_output::{Column, Trajectory};

/// Columns `force.NAME.fx`, `fy` \[N\] or `force.NAME.torque` [N·m] of the model's loads.
pub fn applied(model: &Model, table: &Trajectory) -> Trajectory {
    let columns = Columns::of(table);
    let mut result = Trajectory::new(Vec::new());
    let mut laws: Vec<(Vec<Law>, Option<Frame>)> = Vec::new();
    for (name, force) in &model.forces {
        let mut add = |quantities: &[(&str, &'static str)]| {
            let heading = |(quantity, unit): &(&str, &'static str)| {
                Column::new(format!("force.{name}.{quantity}"), unit)
            };
            result.columns.extend(quantities.iter().map(heading));
        };
        match &force.kind {
            ForceKind::Load { at, vector, frame } => {
                let turning = match frame {
                    linkdyn_model::Frame::Ground => None,
                    linkdyn_model::Frame::Body => Frame::of(&columns, &at.body),
                };
                add(&[("fx", "N"), ("fy", "N")]);
                laws.push((vector.iter().map(value_law).collect(), turning));
            }
            ForceKind::Torque { value, .. } => {
                add(&[("torque", "N*m")]);
                laws.push((vec![value_law(value)], None));
            }
            ForceKind::Spring { .. } | ForceKind::TorsionSpring { .. } => {}
        }
    }
    for row in table.rows() {
        for (components, frame) in &laws {
            match components.as_slice() {
                [x, y] => {
                    let vector = Vec2::new(x.jet(row[0])[0], y.jet(row[0])[0]);
                    let vector = frame.map_or(vector, |frame| frame.turn(row, vector));
                    result.data.extend([vector.x, vector.y]);
                }
                others => result
                    .data
                    .extend(others.iter().map(|law| law.jet(row[0])[0])),
            }
        }
    }
    result
}
