//! A slider-crank with clearance and an elastic rod against a program that shares nothing with the engine, and its speed beside the rigid
//! rod.
//!
//! The model, where its numbers come from, and what is measured stand in `validation/elastic-clearance/`.

use std::fmt::Write as _;

use super::table::Table;
use super::{CaseError, CaseReport, Claim, Setting, at_most, broken, finished, verdict};
use linkdyn_engine::analysis::{self, Outcome};
use linkdyn_model::Checked;

/// A line about the case.
pub const ABOUT: &str =
    "slider-crank at 5000 rpm with a worn piston pin and a rod that bends: one turn";

const MODEL: &str = include_str!("../elastic-clearance/model.json");
const REFERENCE: &str = include_str!("../elastic-clearance/reference.csv");
const IMPACTS: &str = include_str!("../elastic-clearance/impacts.csv");

/// Radial clearance and length of the rod \[m\].
const CLEARANCE: f64 = 5e-4;
const ROD: f64 = 0.12;
/// By time \[s\]: error as a part of the clearance at rtol 1e-10. Impacts make 1e10 of an early error in one turn.
const ERRORS: [(f64, f64); 3] = [(1e-3, 1e-9), (4e-3, 1e-6), (6e-3, 1e-4)];
/// Until when impacts are compared \[s\], and how far they may be off [s, m/s].
const COMPARED: f64 = 4e-3;
const OFF: [f64; 2] = [1e-9, 1e-5];

/// Runs the case.
///
/// # Errors
/// When it can't be run.
pub fn run(setting: &Setting) -> Result<CaseReport, CaseError> {
    let [reference, impacts] = [table(REFERENCE)?, table(IMPACTS)?];
    let mut report = CaseReport::default();
    let _ = writeln!(
        report.text,
        "rtol     error/clearance to 1 ms    4 ms      6 ms     12 ms   contacts  steps"
    );
    for rtol in [1e-6, 1e-8, 1e-10] {
        let run = outcome(
            &loaded(&[format!("analysis.solver.rtol={rtol:e}")])?,
            setting,
        )?;
        let errors = [1e-3, 4e-3, 6e-3, 12e-3].map(|until| error(&run, &reference, until));
        let [first, second, third, last] = errors;
        let (contacts, steps) = (episodes(&run).len(), run.report.statistics.steps);
        let _ = writeln!(
            report.text,
            "{rtol:7.0e} {:18.1e} {:11.1e} {:9.1e} {:9.1e} {contacts:6} {steps:8}",
            first?, second?, third?, last?
        );
        if rtol < 1e-9 {
            for (until, most) in ERRORS {
                let what = format!(
                    "trajectory and amplitudes to {} ms at rtol 1e-10: error as a part of the clearance [–]",
                    until * 1e3
                );
                let own = error(&run, &reference, until)?;
                report.claims.push(at_most(what, own, most));
            }
            report.claims.extend(compare(&run, &impacts)?);
        }
    }
    Ok(report)
}

fn loaded(sets: &[String]) -> Result<Checked, CaseError> {
    let loaded = linkdyn_model::load(MODEL.as_bytes(), sets);
    Ok(loaded.map_err(|said| broken(format!("{said:?}")))?.model)
}

fn outcome(model: &Checked, setting: &Setting) -> Result<Outcome, CaseError> {
    finished(analysis::run(model, &setting.control))
}

/// Largest error of slider, rod's end and amplitudes until a time, as a part of the clearance [–].
fn error(run: &Outcome, reference: &Table, until: f64) -> Result<f64, CaseError> {
    let times = column(reference, "time[s]")?;
    let mut most: f64 = 0.0;
    for (name, by) in [
        ("slider.x[m]", 1.0),
        ("rod.angle[rad]", ROD),
        ("rod.q1[m]", 1.0),
        ("rod.q2[m]", 1.0),
    ] {
        let ours = run.trajectory.values(name);
        let ours = ours.ok_or_else(|| broken(format!("the results have no column {name}")))?;
        let known = column(reference, name)?;
        if ours.len() != known.len() {
            return Err(broken(format!("{} rows for {}", ours.len(), known.len())));
        }
        for ((ours, known), time) in ours.iter().zip(&known).zip(&times) {
            if *time <= until * (1.0 + 1e-9) {
                most = most.max(by * (ours - known).abs() / CLEARANCE);
            }
        }
    }
    Ok(most)
}

fn episodes(run: &Outcome) -> Vec<linkdyn_output::Episode> {
    let events = run.report.events.iter();
    events.filter_map(|event| event.episode).collect()
}

/// Impacts until [`COMPARED`]: their number, times and speeds.
fn compare(run: &Outcome, impacts: &Table) -> Result<Vec<Claim>, CaseError> {
    let (times, speeds) = (
        column(impacts, "time[s]")?,
        column(impacts, "approach_speed[m/s]")?,
    );
    let known: Vec<(f64, f64)> = times.into_iter().zip(speeds).collect();
    let known: Vec<&(f64, f64)> = known.iter().filter(|(time, _)| *time < COMPARED).collect();
    let all = episodes(run);
    let ours: Vec<_> = all.iter().filter(|own| own.start < COMPARED).collect();
    let pairs = || ours.iter().zip(&known);
    let late = pairs().map(|(own, (time, _))| (own.start - time).abs());
    let off = pairs().map(|(own, (_, speed))| (own.approach_speed - speed).abs());
    Ok(vec![
        Claim {
            what: format!("impacts in {} ms", COMPARED * 1e3),
            reference: known.len().to_string(),
            ours: ours.len().to_string(),
            difference: (ours.len() as i64 - known.len() as i64).to_string(),
            verdict: verdict(ours.len() == known.len()),
        },
        at_most(
            "times of these impacts: error [s]".into(),
            late.fold(0.0, f64::max),
            OFF[0],
        ),
        at_most(
            "their approach speeds: error [m/s]".into(),
            off.fold(0.0, f64::max),
            OFF[1],
        ),
    ])
}

fn table(text: &str) -> Result<Table, CaseError> {
    let text: String = text
        .lines()
        .filter(|line| !line.starts_with('#'))
        .map(|line| format!("{line}\n"))
        .collect();
    Table::parse(&text).map_err(CaseError::Broken)
}

fn column(table: &Table, name: &str) -> Result<Vec<f64>, CaseError> {
    let index = table.columns.iter().position(|column| column == name);
    let index = index.ok_or_else(|| broken(format!("no column {name}")))?;
    Ok(table.rows.iter().map(|row| row[index]).collect())
}
