//! Velocities on branches, and how turns miss one.

use crate::analysis::control::Stop;
use crate::element::BodyId;
use crate::mechanism::branching::Branch;
use crate::system::System;
use linkdyn_linear::dense::{Dense, least_norm_solve};
use linkdyn_linear::math::dot;
use linkdyn_output::Status;

/// The nearest branch is meant where turns miss it by less than this part of what they miss the next one by.
pub(super) const NEARER: f64 = 0.7;
/// Tolerance of small systems of equations.
pub(super) const RANK: f64 = 1e-9;

/// Velocities on a branch (n, scaled), and by how much they miss what is prescribed, row by row (scaled).
pub(in crate::analysis) struct Pace {
    pub v: Vec<f64>,
    pub missing: Vec<f64>,
}

/// By what part of them turns of bodies miss a branch.
pub(super) fn miss(system: &System, hints: &[(BodyId, f64)], branch: &Branch) -> f64 {
    let columns = hints.iter().filter_map(|(body, turn)| {
        let columns = system.layout.columns(*body)?;
        Some((columns.theta(), *turn))
    });
    let (columns, turns): (Vec<usize>, Vec<f64>) = columns.unzip();
    let f = branch.tangents.len();
    let rates = columns
        .iter()
        .flat_map(|&column| branch.tangents.iter().map(move |t| t[column]));
    let rates = Dense::new(columns.len(), f, rates.collect());
    let size = dot(&turns, &turns).sqrt();
    match least_norm_solve(&rates, &turns, RANK) {
        Ok(found) if size > 0.0 => found.residual / size,
        Ok(_) | Err(_) => f64::INFINITY,
    }
}

/// A start that fails.
pub(super) fn failed(message: String) -> Stop {
    Stop::failed(Status::Singular, message)
}
