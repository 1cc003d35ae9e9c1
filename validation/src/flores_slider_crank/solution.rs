//! The mechanism at a clearance, solved.

use crate::{CaseError, Setting, broken, finished};
use linkdyn_engine::analysis::{self, Outcome};
use linkdyn_output::Episode;

const MODEL: &str = include_str!("../../slider-crank-clearance/model.json");

/// Duration of a turn \[s\].
pub const TURN: f64 = 0.012;

/// The mechanism at a clearance.
pub fn solve(
    setting: &Setting,
    clearance: f64,
    rtol: f64,
    turns: u32,
    outputs: u32,
) -> Result<Outcome, CaseError> {
    let sets = [
        "bodies.crank.inertia=1e-4".into(),
        format!("joints.b.clearance.radius={clearance:e}"),
        format!("analysis.solver.rtol={rtol:e}"),
        format!("analysis.end={}", f64::from(turns) * TURN),
        format!("analysis.outputs={}", turns * outputs + 1),
    ];
    let loaded =
        linkdyn_model::load(MODEL.as_bytes(), &sets).map_err(|said| broken(format!("{said:?}")))?;
    finished(analysis::run(&loaded.model, &setting.control))
}

/// What happened at the contacts.
pub fn episodes(outcome: &Outcome) -> Vec<Episode> {
    outcome
        .report
        .events
        .iter()
        .filter_map(|event| event.episode)
        .collect()
}

/// A column of the results.
pub fn values(outcome: &Outcome, name: &str) -> Result<Vec<f64>, CaseError> {
    outcome
        .trajectory
        .values(name)
        .ok_or_else(|| broken(format!("the results have no column {name}")))
}

/// The clearance in words.
pub fn millimetres(clearance: f64) -> String {
    format!("c = {:.1} mm", 1e3 * clearance)
}
