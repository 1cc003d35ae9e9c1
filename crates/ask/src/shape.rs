//! The shape of a model as it is drawn: with the profiles of its cams, and what its loads are over time.

use linkdyn_engine::analysis::{Outcome, bent_axes, derived};
use linkdyn_engine::system::compile::profiles;
use linkdyn_model::Checked;
use linkdyn_output::{BodyQuantity, Channel, Column, TIME, Table, Trajectory};
use linkdyn_picture::poses::Pose;
use linkdyn_picture::shape::{Bending, Shape};
use linkdyn_picture::study_page::Motion;

/// The shape of a model, with the profiles of its cams and how its elastic links bend.
pub fn with_profiles(model: &Checked) -> Shape {
    let mut shape = Shape::of_model(model);
    for profile in profiles(model) {
        let outline = profile.rows.iter().map(|row| [row[1], row[2]]);
        shape.take_profile(profile.joint, outline.collect(), profile.reach);
    }
    if model.bodies.values().all(|body| body.elastic.is_none()) {
        return shape;
    }
    let axes = bent_axes(model).into_iter();
    // Of modal data no axis is known.
    for axis in axes.filter(|axis| axis.places.len() > 1) {
        let body = shape.bodies.iter_mut().find(|body| body.name == axis.body);
        if let Some(body) = body {
            body.bending = Some(Bending {
                places: axis.places,
                moves: axis.moves,
                curvatures: axis.curvatures,
                ..Bending::default()
            });
        }
    }
    shape
}

/// The same; its loads at the instants of a table that has the poses of all bodies.
pub fn with_loads(model: &Checked, results: &Trajectory) -> Shape {
    let mut shape = with_profiles(model);
    if shape.loads.is_empty() {
        return shape;
    }
    if let Some((times, loads)) = results.values(TIME).zip(derived::loads(model, results)) {
        shape.take_loads(&times, &loads);
    }
    shape
}

/// The same, in a single position of all bodies, the ground first.
pub fn at_pose(model: &Checked, pose: &[Pose]) -> Shape {
    let bodies = Shape::of_model(model).bodies.into_iter();
    let mut poses = Trajectory::new(columns(bodies.skip(1).map(|body| body.name)));
    let moving = pose.iter().skip(1).flatten().copied();
    let row: Vec<f64> = std::iter::once(0.0).chain(moving).collect();
    poses.push_row(&row);
    with_loads(model, &poses)
}

/// The same, for results that were read.
pub fn for_table(model: &Checked, table: &Table) -> Shape {
    let moving = Shape::of_model(model).bodies.into_iter().skip(1);
    with_loads(model, &poses(table, moving.map(|body| body.name)))
}
/// Time and the poses of these bodies, as the engine writes them.
fn poses(table: &Table, bodies: impl Iterator<Item = String>) -> Trajectory {
    let columns = columns(bodies);
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

/// Columns of the time and of the poses of these bodies.
fn columns(bodies: impl Iterator<Item = String>) -> Vec<Column> {
    let mut columns = vec![Column::of(Channel::Time, "", "s")];
    for (body, name) in bodies.enumerate() {
        let quantities = [BodyQuantity::X, BodyQuantity::Y, BodyQuantity::Angle];
        let column = |quantity: BodyQuantity| {
            Column::of(Channel::Body(body, quantity), &name, quantity.unit())
        };
        columns.extend(quantities.map(column));
    }
    columns
}

/// What a run of the model has of a motion, by the number of its variant; `None` if it has no position.
pub(crate) fn moving(variant: Option<u64>, model: &Checked, outcome: &Outcome) -> Option<Motion> {
    let shape = with_profiles(model);
    let (times, poses) = instants(outcome, &shape)?;
    Some(Motion {
        variant,
        shape,
        times,
        poses,
    })
}

/// Times, and x, y and angle of all moving bodies at each, of a run.
pub(crate) fn poses_of(model: &Checked, outcome: &Outcome) -> Option<(Vec<f64>, Vec<f64>)> {
    instants(outcome, &Shape::of_model(model))
}

/// Times, and x, y and angle of all moving bodies at each.
fn instants(outcome: &Outcome, shape: &Shape) -> Option<(Vec<f64>, Vec<f64>)> {
    let table = outcome.all();
    let times = table.values(TIME)?;
    let bodies = shape.bodies.iter().skip(1);
    let names =
        bodies.flat_map(|body| ["x", "y", "angle"].map(|axis| format!("{}.{axis}", body.name)));
    let places: Option<Vec<usize>> = names.map(|name| table.column_index(&name)).collect();
    let places = places?;
    let rows = table.rows();
    let poses = rows.flat_map(|row| places.iter().map(|&place| row[place]));
    let poses: Vec<f64> = poses.collect();
    (!times.is_empty() && !places.is_empty()).then_some((times, poses))
}
