//! The slider-crank of Flores and Ambrósio at three clearances of its piston pin: the first turn against SciPy, and what can be
//! said of sixty turns.
//!
//! Data, references and rules stand in `validation/flores-slider-crank/SOURCE.md`.

mod files;
mod first_turn;
mod long_run;

use super::{CaseError, CaseReport, Setting, broken, finished};
use linkdyn_engine::analysis::{self, Outcome};
use linkdyn_output::{Directory, Episode};
use long_run::LongRun;

/// A line about the case.
pub const ABOUT: &str = "slider-crank at 5000 rpm, clearance 0.1, 0.2, 0.5 mm: first turn, orbits, Poincaré maps of 60 turns";

const MODEL: &str = include_str!("../../slider-crank-clearance/model.json");

/// Radial clearances \[m\].
const CLEARANCES: [f64; 3] = [1e-4, 2e-4, 5e-4];
/// Length of the rod \[m\], duration of a turn \[s\].
const ROD: f64 = 0.12;
const TURN: f64 = 0.012;
/// Tolerances of the long runs.
const RTOL: [f64; 2] = [1e-6, 1e-8];
/// Energy that may be missing, by rtol [–].
const LEDGER: f64 = 1.0;

/// Runs the case.
///
/// # Errors
/// When it can't be run or written.
pub fn run(setting: &Setting) -> Result<CaseReport, CaseError> {
    let mut report = CaseReport::default();
    for clearance in CLEARANCES {
        first_turn::compare(setting, clearance, &mut report)?;
    }
    let mut runs = Vec::new();
    for clearance in CLEARANCES {
        let [loose, tight] = RTOL.map(|rtol| LongRun::new(setting, clearance, rtol));
        runs.push([loose?, tight?]);
    }
    long_run::tell(&runs, &mut report.text);
    for pair in &runs {
        long_run::compare(pair, &mut report)?;
    }
    report.claims.push(long_run::peaks_grow(&runs));
    if let Some(output) = &setting.output {
        let directory = Directory::open(output)?;
        for [_, tight] in &runs {
            files::orbit(&directory, tight)?;
        }
        files::poincare(&directory, &runs)?;
    }
    Ok(report)
}

/// The mechanism at a clearance.
fn solve(
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

fn millimetres(clearance: f64) -> String {
    format!("c = {:.1} mm", 1e3 * clearance)
}
