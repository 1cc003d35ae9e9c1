//! The slider-crank of Flores and Ambrósio at three clearances of its piston pin: the first turn against SciPy, and what can be
//! said of sixty turns.
//!
//! Data, references and rules stand in `validation/flores-slider-crank/SOURCE.md`.

mod files;
mod first_turn;
mod long_run;
mod solution;

use super::{CaseError, CaseReport, Setting};
use linkdyn_output::Directory;
use long_run::LongRun;

/// A line about the case.
pub const ABOUT: &str = "slider-crank at 5000 rpm, clearance 0.1, 0.2, 0.5 mm: first turn, orbits, Poincaré maps of 60 turns";

/// Radial clearances \[m\].
const CLEARANCES: [f64; 3] = [1e-4, 2e-4, 5e-4];
/// Length of the rod \[m\].
const ROD: f64 = 0.12;
/// Tolerances of the long runs.
const RTOL: [f64; 2] = [1e-6, 1e-8];

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
