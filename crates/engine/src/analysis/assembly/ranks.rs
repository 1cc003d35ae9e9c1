//! Ranks of the constraints at a position.

use crate::element::coordinate::Coordinate;
use crate::element::{Constraint, Equations, Kinematics};
use crate::system::{DriverId, Evaluation, Inputs, System};
use linkdyn_linear::rank::{
    BadEntry, DEPENDENCE_TOLERANCE, RankReport, SparseRows, free_direction, independent_rows,
    only_direction,
};

/// Ranks of the joints' rows and of all rows at `q`.
pub fn ranks(system: &System, q: &[f64], inputs: &Inputs) -> (RankReport, RankReport) {
    let mut evaluation = Evaluation::new(system);
    evaluation.set_position(q);
    evaluation.eval_jacobian(system, inputs);
    let of = |rows| {
        independent_rows(
            &scaled_rows(system, &evaluation.jacobian, rows),
            DEPENDENCE_TOLERANCE,
        )
    };
    (of(system.joint_rows()), of(system.m()))
}

/// Ranks of all rows at `q` and behind them those of the initial values.
pub(super) fn with_starts(system: &System, q: &[f64], inputs: &Inputs) -> RankReport {
    let mut evaluation = Evaluation::new(system);
    evaluation.set_position(q);
    evaluation.eval_jacobian(system, inputs);
    let mut entries: Vec<_> = entries(system, &evaluation.jacobian, system.m())
        .map(|(row, column, x)| (row, column, if x.is_finite() { x } else { 0.0 }))
        .collect();
    let at = evaluation.kinematics(inputs);
    for (k, start) in system.starts.iter().enumerate() {
        let row = start_row(system, start, &at).into_iter();
        entries.extend(row.map(|(column, value)| (system.m() + k, column, value)));
    }
    let rows = system.m() + system.starts.len();
    let rows = SparseRows::from_triplets(rows, system.n(), &entries)
        .unwrap_or_else(|bad| unreachable!("row {} has finite entries", bad.row));
    independent_rows(&rows, DEPENDENCE_TOLERANCE)
}

/// Rows that follow from others at `q`, initial values behind all others, and coordinates that are free there, one for each freedom: turns
/// before places, bodies in their order.
pub fn dependent_and_free(system: &System, q: &[f64], inputs: &Inputs) -> (Vec<usize>, Vec<usize>) {
    let mut evaluation = Evaluation::new(system);
    evaluation.set_position(q);
    evaluation.eval_jacobian(system, inputs);
    let known = |x: f64| if x.is_finite() { x } else { 0.0 };
    let of_joints = entries(system, &evaluation.jacobian, system.m());
    let mut all: Vec<_> = of_joints
        .map(|(row, column, x)| (row, column, known(x)))
        .collect();
    let at = evaluation.kinematics(inputs);
    for (k, start) in system.starts.iter().enumerate() {
        let row = start_row(system, start, &at).into_iter();
        all.extend(row.map(|(column, value)| (system.m() + k, column, known(value))));
    }
    let own = system.m() + system.starts.len();
    let bodies = system.layout.bodies();
    let columns: Vec<usize> = bodies
        .flat_map(|body| [body.theta(), body.x(), body.y()])
        .collect();
    let units = columns.iter().enumerate();
    all.extend(units.map(|(k, column)| (own + k, *column, 1.0)));
    let rows = SparseRows::from_triplets(own + columns.len(), system.n(), &all)
        .unwrap_or_else(|bad| unreachable!("row {} has finite entries", bad.row));
    let report = independent_rows(&rows, DEPENDENCE_TOLERANCE);
    let dependent = report.dependent.iter().map(|one| one.row);
    let free = report.independent.iter();
    let free = free.filter_map(|row| columns.get(row.checked_sub(own)?).copied());
    (dependent.filter(|row| *row < own).collect(), free.collect())
}

/// The scaled row of an initial value, as column and value.
pub(super) fn start_row(system: &System, start: &Coordinate, at: &Kinematics) -> Vec<(usize, f64)> {
    let entries = start.entries();
    let mut values = vec![0.0; entries.len()];
    start.jacobian(at, &mut values);
    let scale = system.axis_scale(start.axis);
    let entries = entries.into_iter().zip(values);
    entries
        .filter_map(|((_, body, axis), value)| {
            let column = system.layout.column(body, axis)?;
            Some((column, value * system.axis_scale(axis) / scale))
        })
        .collect()
}

/// A direction in which nothing holds the mechanism at `q`, scaled; see [`free_direction`].
pub(super) fn free(system: &System, q: &[f64], inputs: &Inputs) -> Option<Vec<f64>> {
    let mut evaluation = Evaluation::new(system);
    evaluation.set_position(q);
    evaluation.eval_jacobian(system, inputs);
    free_direction(
        &scaled_rows(system, &evaluation.jacobian, system.m()),
        DEPENDENCE_TOLERANCE,
    )
}

/// How the joints let the coordinates move together (n), at most by their scales, where that is one motion; `jacobian` has the
/// values of all entries. Where a driver is meant, all others are held.
///
/// # Errors
/// How many motions there are.
pub(in crate::analysis) fn tangent(
    system: &System,
    jacobian: &[f64],
    by: Option<DriverId>,
) -> Result<Vec<f64>, usize> {
    let joints = system.joint_rows();
    let rows = match by {
        None => rows_of(system, jacobian, joints),
        Some(driver) => {
            let last = joints + system.drivers.len();
            let own = system.driver_row(driver);
            let held = entries(system, jacobian, last).filter(|(row, ..)| *row != own);
            SparseRows::from_triplets(last, system.n(), &held.collect::<Vec<_>>())
        }
    };
    let Ok(rows) = rows else {
        // beyond all numbers
        return Err(0);
    };
    let mut tangent = only_direction(&rows, DEPENDENCE_TOLERANCE)?;
    system.scale_columns(&mut tangent);
    Ok(tangent)
}

/// The entries of the first `rows` rows of the scaled Jacobian.
fn entries(
    system: &System,
    values: &[f64],
    rows: usize,
) -> impl Iterator<Item = (usize, usize, f64)> {
    let all = system.entries.iter().zip(values);
    all.filter_map(move |(entry, value)| {
        let (row, column) = (entry.row as usize, entry.column()? as usize);
        (row < rows).then(|| (row, column, system.scaled_entry(*value, row, column)))
    })
}

/// The first `rows` rows of the scaled Jacobian.
fn rows_of(system: &System, values: &[f64], rows: usize) -> Result<SparseRows, BadEntry> {
    let entries: Vec<_> = entries(system, values, rows).collect();
    SparseRows::from_triplets(rows, system.n(), &entries)
}

/// The same; an entry beyond all numbers says nothing, so that its row may say nothing new. `assemble` refuses positions that have
/// such entries.
fn scaled_rows(system: &System, values: &[f64], rows: usize) -> SparseRows {
    let entries = entries(system, values, rows);
    let known = |x: f64| if x.is_finite() { x } else { 0.0 };
    let known: Vec<_> = entries
        .map(|(row, column, x)| (row, column, known(x)))
        .collect();
    let rows = SparseRows::from_triplets(rows, system.n(), &known);
    rows.unwrap_or_else(|bad| unreachable!("row {} has finite entries", bad.row))
}
