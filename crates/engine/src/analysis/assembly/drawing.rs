//! Where the way to the start begins: the drawing with its joints closed and, where that is a singular position, a branch of it.

use super::ranks::start_row;
use super::values::Values;
use crate::analysis::branch::turns;
use crate::analysis::departure::{away, hinted, pace};
use crate::analysis::in_line::singular_text;
use crate::mechanism::branching::{Branch, Singularity};
use crate::mechanism::closing::close;
use crate::system::{Block, Evaluation, Inputs, Origin, System};
use linkdyn_linear::math::{dot, max_abs};
use std::sync::Arc;

/// Values that a branch misses by more than this part of them are not on it.
const ON: f64 = 1e-5;

/// The drawing with its joints closed, drivers and initial values where it has them or, where the joints do not close there, wherever
/// they close; `None` if they do not.
pub(super) fn closed(system: &System, inputs: &Inputs, drawn: &Values) -> Option<Vec<f64>> {
    let mut inputs = inputs.clone();
    for (jet, off) in inputs.drive.iter_mut().zip(&drawn.drivers) {
        jet[0] -= off;
    }
    let starts = system.starts.iter().zip(&drawn.starts).zip(&system.initial);
    let starts: Vec<Block> = starts
        .map(|((start, off), block)| {
            let mut start = start.clone();
            start.value -= off;
            Block::alone(Arc::new(start), block.origin.clone())
        })
        .collect();
    let all: Vec<&Block> = system.blocks.iter().chain(&starts).collect();
    let closed = close(system, &all, &system.guess, &inputs);
    if closed.converged {
        return Some(closed.q);
    }
    let is_driver = |block: &&Block| matches!(block.origin, Origin::Driver(_));
    let joints: Vec<&Block> = system.blocks.iter().filter(|b| !is_driver(b)).collect();
    let closed = close(system, &joints, &system.guess, &inputs);
    closed.converged.then_some(closed.q)
}

/// A drawing that was left.
pub(super) struct Left {
    /// A regular position beside (n).
    pub q: Vec<f64>,
    /// What is said of the choice, where nobody said which branch is meant.
    pub warning: Option<String>,
}

/// A regular position beside the drawing at `q` where that is singular, on the branch that is meant and to the side where the start
/// is; `None` if it is regular.
///
/// # Errors
/// What to say where no branch leads to the start, or the branch that is meant is not known.
pub(super) fn left(system: &System, inputs: &Inputs, q: &[f64]) -> Result<Option<Left>, String> {
    let rows = system.joint_rows();
    let Ok(Some(mut singular)) = Singularity::at(system, q, inputs, rows) else {
        return Ok(None);
    };
    let branches = singular.branches(&vec![0.0; system.n()]);
    let wanted = wanted(system, inputs, q);
    let size = max_abs(&wanted.1);
    let led: Vec<(Branch, Vec<f64>)> = branches
        .into_iter()
        .filter_map(|branch| {
            let pace = pace(system, &branch, &wanted)?;
            (max_abs(&pace.missing) <= ON * size).then_some((branch, pace.v))
        })
        .collect();
    let branches: Vec<Branch> = led.iter().map(|(branch, _)| branch.clone()).collect();
    let hint = hinted(system, &branches).ok().flatten();
    let order = hint.into_iter().chain(0..led.len());
    let found = order.into_iter().find_map(|k| {
        let v = &led[k].1;
        let length = dot(v, v).sqrt();
        let direction: Vec<f64> = v.iter().map(|v| v / length).collect();
        Some((k, away(system, rows, (q, &direction), inputs)?))
    });
    let what = || {
        let dependent = super::ranks(system, q, inputs).0.dependent_rows();
        singular_text(system, &dependent).map_or_else(String::new, |what| format!(" ({what})"))
    };
    let Some((taken, q)) = found else {
        return Err(format!(
            "the drawing is a singular position{}, from which no branch of motion leads to the start; draw the bodies where they start",
            what()
        ));
    };
    let other = (0..led.len()).find(|k| *k != taken);
    let warning = other.filter(|_| hint.is_none()).map(|other| {
        let ways = [taken, other].map(|k| turns(system, &branches[k].direction));
        format!(
            "the drawing is a singular position{}, from which {} branches of motion lead to the start: taken is the one on which {}; on \
             another {}. Draw the bodies (\"pose\") where they start, or say by \"branch\" in \"initial\" how they turn by each other",
            what(), led.len(), ways[0], ways[1]
        )
    });
    Ok(Some(Left { q, warning }))
}

/// Rows of the drivers and initial values (n each), scaled, and how far these are to go.
fn wanted(system: &System, inputs: &Inputs, q: &[f64]) -> (Vec<Vec<f64>>, Vec<f64>) {
    let n = system.n();
    let mut evaluation = Evaluation::new(system);
    evaluation.set_position(q);
    evaluation.eval_jacobian(system, inputs);
    let dense = system.dense_scaled(&evaluation.jacobian);
    let values = Values::at(system, q, inputs);
    let (mut rows, mut off) = (Vec::new(), Vec::new());
    for block in &system.blocks {
        if let Origin::Driver(id) = block.origin {
            rows.push(dense[block.row() * n..(block.row() + 1) * n].to_vec());
            off.push(-values.drivers[id.0] / system.row_scale(block.row()));
        }
    }
    let at = evaluation.kinematics(inputs);
    for (start, value) in system.starts.iter().zip(&values.starts) {
        let mut row = vec![0.0; n];
        for (column, value) in start_row(system, start, &at) {
            row[column] += value;
        }
        rows.push(row);
        off.push(-value / system.axis_scale(start.axis));
    }
    (rows, off)
}
