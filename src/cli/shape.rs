//! The shape of a model with what its loads are over time, for results that were read.

use crate::files::shape;
use linkdyn_model::Checked;
use linkdyn_output::{BodyQuantity, Channel, Column, Table, Trajectory};
use linkdyn_picture::Shape;

/// The shape of a model, for results that were read.
pub fn shape_for(model: &Checked, table: &Table) -> Shape {
    let moving = Shape::of_model(model).bodies.into_iter().skip(1);
    shape(model, &poses(table, moving.map(|body| body.name)))
}

/// Time and the poses of these bodies, as the engine writes them.
fn poses(table: &Table, bodies: impl Iterator<Item = String>) -> Trajectory {
    let mut columns = vec![Column::of(Channel::Time, "", "s")];
    for (body, name) in bodies.enumerate() {
        let quantities = [BodyQuantity::X, BodyQuantity::Y, BodyQuantity::Angle];
        let column = |quantity: BodyQuantity| {
            Column::of(Channel::Body(body, quantity), &name, quantity.unit())
        };
        columns.extend(quantities.map(column));
    }
    let values: Vec<Option<&[f64]>> = columns
        .iter()
        .map(|column| table.values(table.column(&column.name)?).ok())
        .collect();
    let mut poses = Trajectory::new(columns);
    for row in 0..table.len() {
        // Where a pose is missing the picture itself will say so.
        let cell = |values: &Option<&[f64]>| values.map_or(f64::NAN, |values| values[row]);
        poses.push_row(&values.iter().map(cell).collect::<Vec<_>>());
    }
    poses
}
