//! Ranks of the constraints at a position.

use crate::system::{Evaluation, Inputs, System};
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
/// values of all entries.
///
/// # Errors
/// How many motions there are.
pub(in crate::analysis) fn tangent(system: &System, jacobian: &[f64]) -> Result<Vec<f64>, usize> {
    let Ok(rows) = rows_of(system, jacobian, system.joint_rows()) else {
        // beyond all numbers
        return Err(0);
    };
    let mut tangent = only_direction(&rows, DEPENDENCE_TOLERANCE)?;
    system.scale_columns(&mut tangent);
    Ok(tangent)
}

/// The first `rows` rows of the scaled Jacobian.
fn rows_of(system: &System, values: &[f64], rows: usize) -> Result<SparseRows, BadEntry> {
    let entries: Vec<(usize, usize, f64)> = system
        .entries
        .iter()
        .zip(values)
        .filter_map(|(entry, value)| {
            let (row, column) = (entry.row as usize, entry.column()? as usize);
            (row < rows).then(|| (row, column, system.scaled_entry(*value, row, column)))
        })
        .collect();
    SparseRows::from_triplets(rows, system.n(), &entries)
}

/// The same at a position that was assembled.
fn scaled_rows(system: &System, values: &[f64], rows: usize) -> SparseRows {
    match rows_of(system, values, rows) {
        Ok(rows) => rows,
        // `assemble` has seen to it that places are finite, and that no entry is too large.
        Err(bad) => panic!(
            "the Jacobian's entry at row {}, column {} is not finite",
            bad.row, bad.column
        ),
    }
}
