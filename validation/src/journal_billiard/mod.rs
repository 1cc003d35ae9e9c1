//! A journal with rigid surfaces (`three_state`) without gravity, against closed forms only: as a billiard ball in a circle,
//! and in single impacts with friction. The formulas stand in `validation/journal-billiard/SOURCE.md`.

mod billiard;
mod strike;

use super::{CaseError, CaseReport, Setting, broken, finished};
use linkdyn_engine::analysis::{self, Outcome};
use linkdyn_output::Episode;

/// A line about the case.
pub const ABOUT: &str = "a rigid journal without gravity: a thousand impacts of a billiard in a circle, friction in impacts";

const MODEL: &str = include_str!("../../journal-billiard/model.json");

/// Numbers of the model [m, kg, kg·m²].
const CLEARANCE: f64 = 1e-3;
const JOURNAL: f64 = 9e-3;
const MASS: f64 = 2.0;
const INERTIA: f64 = 1e-4;

/// Runs the case.
///
/// # Errors
/// When it can't be run.
pub fn run(setting: &Setting) -> Result<CaseReport, CaseError> {
    let mut report = CaseReport::default();
    billiard::elastic(setting, &mut report)?;
    billiard::damped(setting, &mut report)?;
    strike::spinning(setting, &mut report)?;
    strike::senses(setting, &mut report)?;
    Ok(report)
}

/// The model with some values set.
fn solve(setting: &Setting, sets: &[String]) -> Result<Outcome, CaseError> {
    let loaded =
        linkdyn_model::load(MODEL.as_bytes(), sets).map_err(|said| broken(format!("{said:?}")))?;
    finished(analysis::run(&loaded.model, &setting.control))
}

fn episodes(outcome: &Outcome) -> Vec<Episode> {
    outcome
        .report
        .events
        .iter()
        .filter_map(|event| event.episode)
        .collect()
}

fn values(outcome: &Outcome, name: &str) -> Result<Vec<f64>, CaseError> {
    outcome
        .trajectory
        .values(name)
        .ok_or_else(|| broken(format!("the results have no column {name}")))
}

/// The largest of `f` over what is given; not a number counts as infinite.
fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |largest: f64, value| {
        if value.is_nan() {
            f64::INFINITY
        } else {
            largest.max(value.abs())
        }
    })
}
