//! A slider-crank at 5000 rpm with clearance in its piston pin: impacts and trajectory against a program that shares nothing
//! with the engine, the convergence towards it, and the energy ledger.
//!
//! The model, where its numbers come from, and what is measured stand in `validation/slider-crank-clearance/`.

use std::fmt::Write as _;

use super::table::Table;
use super::{CaseError, CaseReport, Claim, Setting, at_most, broken, finished, verdict};
use linkdyn_engine::analysis::{self, Outcome};
use linkdyn_output::Episode;

/// A line about the case.
pub const ABOUT: &str =
    "slider-crank at 5000 rpm with a worn piston pin, by contact forces: 24 impacts in two turns";

const MODEL: &str = include_str!("../slider-crank-clearance/model.json");
const REFERENCE: &str = include_str!("../slider-crank-clearance/reference.csv");
const IMPACTS: &str = include_str!("../slider-crank-clearance/impacts.csv");

/// Radial clearance and length of the rod \[m\].
const CLEARANCE: f64 = 5e-4;
const ROD: f64 = 0.12;
/// rtol: half powers of ten between these negative exponents, times two.
const RUNGS: [u32; 2] = [12, 22];
/// The rungs above this one have errors well above those of the reference and of round-off.
const CONVERGING: f64 = 0.99e-10;
/// Slope of log error over log rtol [–].
const SLOPES: [f64; 2] = [0.8, 1.2];
/// Error as a part of the clearance, by rtol, that 24 impacts may make of it [–].
const GROWTH: f64 = 1e4;
/// Energy that may be missing, by rtol [–].
const LEDGER: f64 = 10.0;
/// First impacts by another program: time \[ms\] and approach speed [m/s], with the digits that are known.
const FIRST: [[(f64, f64); 2]; 3] = [
    [(0.2272860, 5e-8), (4.38578, 5e-6)],
    [(0.5733549, 5e-8), (2.26735, 5e-6)],
    [(0.7191476, 5e-8), (2.11926, 5e-6)],
];
/// Columns beside the positions.
const COLUMNS: [&str; 6] = [
    "slider.vx[m/s]",
    "slider.ax[m/s^2]",
    "rod.omega[rad/s]",
    "joint.b.fx[N]",
    "joint.b.fy[N]",
    "driver.motor.effort[N*m]",
];

/// A run at one tolerance.
struct Rung {
    rtol: f64,
    /// Largest error of slider and rod's end, as a part of the clearance [–].
    error: f64,
    /// Energy that is missing, by rtol [–].
    ledger: f64,
    outcome: Outcome,
}

/// Runs the case.
///
/// # Errors
/// When it can't be run.
pub fn run(setting: &Setting) -> Result<CaseReport, CaseError> {
    let (reference, impacts) = (table(REFERENCE)?, table(IMPACTS)?);
    let mut report = CaseReport::default();
    let _ = writeln!(
        report.text,
        "rtol      error/clearance  contacts  steps   CPU ms  missing energy/rtol"
    );
    let mut rungs = Vec::new();
    for half in RUNGS[0]..=RUNGS[1] {
        let rung = Rung::run(10f64.powf(-0.5 * f64::from(half)), &reference, setting)?;
        let statistics = rung.outcome.report.statistics;
        let _ = writeln!(
            report.text,
            "{:7.1e} {:16.1e} {:9} {:6} {:8.0} {:12.2}",
            rung.rtol,
            rung.error,
            rung.episodes().len(),
            statistics.steps,
            rung.outcome.report.solve.cpu * 1e3,
            rung.ledger
        );
        rungs.push(rung);
    }
    let [loosest, .., tightest] = rungs.as_slice() else {
        return Err(broken("no rungs"));
    };
    let converging: Vec<&Rung> = rungs.iter().filter(|rung| rung.rtol > CONVERGING).collect();
    report.claims.push(slope_claim(&converging));
    for rung in [loosest, tightest] {
        let what = format!(
            "trajectory at rtol {:.0e}: error as a part of the clearance [–]",
            rung.rtol
        );
        report
            .claims
            .push(at_most(what, rung.error, GROWTH * rung.rtol));
    }
    let missing = rungs.iter().map(|rung| rung.ledger).fold(0.0, f64::max);
    report.claims.push(at_most(
        "energy that is missing, by rtol, at any rtol [–]".into(),
        missing,
        LEDGER,
    ));
    report.claims.extend(first_impacts(tightest)?);
    report.claims.extend(all_impacts(tightest, &impacts)?);
    for name in COLUMNS {
        let exact = column(&reference, name)?;
        let largest = exact
            .iter()
            .fold(0.0, |largest: f64, value| largest.max(value.abs()));
        let error = distance(&tightest.values(name)?, &exact)? / largest;
        let what = format!(
            "{name} at rtol {:.0e}: error by the largest value [–]",
            tightest.rtol
        );
        report
            .claims
            .push(at_most(what, error, GROWTH * tightest.rtol));
    }
    Ok(report)
}

impl Rung {
    fn run(rtol: f64, reference: &Table, setting: &Setting) -> Result<Self, CaseError> {
        let loaded = linkdyn_model::load(
            MODEL.as_bytes(),
            &[format!("analysis.solver.rtol={rtol:e}")],
        );
        let loaded = loaded.map_err(|said| broken(format!("{said:?}")))?;
        let outcome = finished(analysis::run(&loaded.model, &setting.control))?;
        let imbalance = outcome
            .report
            .quality
            .energy_imbalance
            .ok_or_else(|| broken("no energy ledger"))?;
        let mut rung = Rung {
            rtol,
            error: 0.0,
            ledger: imbalance / rtol,
            outcome,
        };
        let off = |name: &str| distance(&rung.values(name)?, &column(reference, name)?);
        rung.error = off("slider.x[m]")?.max(ROD * off("rod.angle[rad]")?) / CLEARANCE;
        Ok(rung)
    }

    fn values(&self, name: &str) -> Result<Vec<f64>, CaseError> {
        self.outcome
            .trajectory
            .values(name)
            .ok_or_else(|| broken(format!("the results have no column {name}")))
    }

    fn episodes(&self) -> Vec<Episode> {
        self.outcome
            .report
            .events
            .iter()
            .filter_map(|event| event.episode)
            .collect()
    }
}

/// Errors are proportional to the tolerance.
fn slope_claim(rungs: &[&Rung]) -> Claim {
    let n = rungs.len() as f64;
    let logarithms = rungs.iter().map(|rung| (rung.rtol.ln(), rung.error.ln()));
    let (x, y) = logarithms
        .clone()
        .fold((0.0, 0.0), |(x, y), (t, e)| (x + t / n, y + e / n));
    let (product, square) = logarithms.fold((0.0, 0.0), |(product, square), (t, e)| {
        (product + (t - x) * (e - y), square + (t - x) * (t - x))
    });
    let slope = product / square;
    Claim {
        what: "slope of log error over log rtol down to 1e-10, least squares [–]".into(),
        reference: format!("{} to {}", SLOPES[0], SLOPES[1]),
        ours: format!("{slope:.3}"),
        difference: format!("{:.3}", slope - 1.0),
        verdict: verdict((SLOPES[0]..=SLOPES[1]).contains(&slope)),
    }
}

/// The first impacts against the digits that are known.
fn first_impacts(rung: &Rung) -> Result<Vec<Claim>, CaseError> {
    let episodes = rung.episodes();
    if episodes.len() < FIRST.len() {
        return Err(broken(format!("{} contacts", episodes.len())));
    }
    let claims = FIRST
        .iter()
        .zip(&episodes)
        .enumerate()
        .flat_map(|(k, (known, episode))| {
            let quantities = [
                ("time [ms]", episode.start * 1e3),
                ("approach speed [m/s]", episode.approach_speed),
            ];
            known
                .iter()
                .zip(quantities)
                .map(move |(&(value, half), (quantity, ours))| Claim {
                    what: format!("impact {}: {quantity}", k + 1),
                    reference: value.to_string(),
                    ours: ours.to_string(),
                    difference: format!("{:.1e}", ours - value),
                    verdict: verdict((ours - value).abs() <= half),
                })
        });
    Ok(claims.collect())
}

/// All impacts against the reference: their number, times and approach speeds.
fn all_impacts(rung: &Rung, impacts: &Table) -> Result<Vec<Claim>, CaseError> {
    let (times, speeds) = (
        column(impacts, "time[s]")?,
        column(impacts, "approach_speed[m/s]")?,
    );
    let episodes = rung.episodes();
    let mut claims = vec![Claim {
        what: "impacts in two turns".into(),
        reference: times.len().to_string(),
        ours: episodes.len().to_string(),
        difference: (episodes.len() as i64 - times.len() as i64).to_string(),
        verdict: verdict(episodes.len() == times.len()),
    }];
    if episodes.len() == times.len() {
        let of = |get: fn(&Episode) -> f64| episodes.iter().map(get).collect::<Vec<f64>>();
        let apart = times.last().copied().unwrap_or_default() / times.len() as f64;
        let late = distance(&of(|episode| episode.start), &times)? / apart;
        let what = format!(
            "times of impacts at rtol {:.0e}: error by the mean time between [–]",
            rung.rtol
        );
        claims.push(at_most(what, late, GROWTH * rung.rtol));
        let fastest = speeds.iter().copied().fold(0.0, f64::max);
        let off = distance(&of(|episode| episode.approach_speed), &speeds)? / fastest;
        let what = format!(
            "approach speeds at rtol {:.0e}: error by the largest [–]",
            rung.rtol
        );
        claims.push(at_most(what, off, GROWTH * rung.rtol));
    }
    Ok(claims)
}

/// Largest difference of two columns.
fn distance(ours: &[f64], exact: &[f64]) -> Result<f64, CaseError> {
    if ours.len() != exact.len() {
        return Err(broken(format!("{} rows for {}", ours.len(), exact.len())));
    }
    Ok(ours
        .iter()
        .zip(exact)
        .map(|(a, b)| (a - b).abs())
        .fold(0.0, f64::max))
}

fn table(text: &str) -> Result<Table, CaseError> {
    Table::parse(text).map_err(CaseError::Broken)
}

fn column(table: &Table, name: &str) -> Result<Vec<f64>, CaseError> {
    let index = table.columns.iter().position(|column| column == name);
    let index = index.ok_or_else(|| broken(format!("no column {name}")))?;
    Ok(table.rows.iter().map(|row| row[index]).collect())
}
