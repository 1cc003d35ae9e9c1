//! The first turn against SciPy: trajectory, impacts, forces.

use super::ROD;
use super::solution::{episodes, millimetres, solve, values};
use crate::table::Table;
use crate::{CaseError, CaseReport, Claim, Setting, at_most, broken, verdict};
use linkdyn_engine::analysis::Outcome;
use linkdyn_output::Episode;

const REFERENCE: &str = include_str!("../../flores-slider-crank/reference.csv");
const IMPACTS: &str = include_str!("../../flores-slider-crank/impacts.csv");

/// Outputs of the reference.
const OUTPUTS: u32 = 120;
const RTOL: [f64; 3] = [1e-6, 1e-8, 1e-10];
/// Error as a part of the clearance, by rtol, that up to 22 impacts may make of it [–]; forces follow from penetrations, a tenth of
/// the clearance.
const GROWTH: f64 = 1e3;
const OF_FORCES: f64 = 1e4;
/// What is compared at the smallest rtol besides the trajectory.
const COLUMNS: [&str; 7] = [
    "slider.vx[m/s]",
    "slider.ax[m/s^2]",
    "joint.b.ex[m]",
    "joint.b.ey[m]",
    "joint.b.fx[N]",
    "joint.b.fy[N]",
    "driver.motor.effort[N*m]",
];

/// One number of a contact.
type Measured = fn(&Episode) -> f64;

/// Claims of one clearance.
pub fn compare(
    setting: &Setting,
    clearance: f64,
    report: &mut CaseReport,
) -> Result<(), CaseError> {
    let (rows, impacts) = (
        Block::of(REFERENCE, clearance)?,
        Block::of(IMPACTS, clearance)?,
    );
    let name = millimetres(clearance);
    for rtol in RTOL {
        let outcome = solve(setting, clearance, rtol, 1, OUTPUTS)?;
        let off = |column: &str| distance(&values(&outcome, column)?, &rows.column(column)?);
        let error = off("slider.x[m]")?.max(ROD * off("rod.angle[rad]")?) / clearance;
        let what = format!(
            "{name}, first turn at rtol {rtol:.0e}: trajectory, error by the clearance [–]"
        );
        report.claims.push(at_most(what, error, GROWTH * rtol));
        if rtol == RTOL[RTOL.len() - 1] {
            tightest(&outcome, &rows, &impacts, &name, report)?;
        }
    }
    Ok(())
}

/// What is compared at the smallest rtol.
fn tightest(
    outcome: &Outcome,
    rows: &Block,
    impacts: &Block,
    name: &str,
    report: &mut CaseReport,
) -> Result<(), CaseError> {
    let most = OF_FORCES * RTOL[RTOL.len() - 1];
    let mut worst = (0.0_f64, COLUMNS[0]);
    for column in COLUMNS {
        let exact = rows.column(column)?;
        let error = distance(&values(outcome, column)?, &exact)? / largest(&exact);
        worst = if error > worst.0 {
            (error, column)
        } else {
            worst
        };
    }
    let what = format!(
        "{name}, first turn: seven columns, worst error by the largest value ({}) [–]",
        worst.1
    );
    report.claims.push(at_most(what, worst.0, most));
    let ours = episodes(outcome);
    let times = impacts.column("time[s]")?;
    report.claims.push(Claim {
        what: format!("{name}, first turn: impacts"),
        reference: times.len().to_string(),
        ours: ours.len().to_string(),
        difference: (ours.len() as i64 - times.len() as i64).to_string(),
        verdict: verdict(ours.len() == times.len()),
    });
    if ours.len() != times.len() {
        return Ok(());
    }
    let quantities: [(&str, &str, Measured); 4] = [
        ("times", "time[s]", |episode| episode.start),
        ("approach speeds", "approach_speed[m/s]", |episode| {
            episode.approach_speed
        }),
        ("largest penetrations", "penetration[m]", |episode| {
            episode.peak_penetration
        }),
        ("largest forces", "force[N]", |episode| episode.peak_force),
    ];
    for (quantity, column, of) in quantities {
        let exact = impacts.column(column)?;
        let error = distance(&ours.iter().map(of).collect::<Vec<f64>>(), &exact)? / largest(&exact);
        let what = format!("{name}, first turn: {quantity} of impacts, error by the largest [–]");
        report.claims.push(at_most(what, error, most));
    }
    Ok(())
}

/// Rows of one clearance of a table.
struct Block {
    columns: Vec<String>,
    rows: Vec<Vec<f64>>,
}

impl Block {
    fn of(text: &str, clearance: f64) -> Result<Self, CaseError> {
        let Table { columns, rows } = Table::parse(text).map_err(CaseError::Broken)?;
        let rows: Vec<Vec<f64>> = rows.into_iter().filter(|row| row[0] == clearance).collect();
        if rows.is_empty() {
            Err(broken(format!("no rows for {clearance}")))
        } else {
            Ok(Block { columns, rows })
        }
    }

    fn column(&self, name: &str) -> Result<Vec<f64>, CaseError> {
        let index = self.columns.iter().position(|column| column == name);
        let index = index.ok_or_else(|| broken(format!("no column {name}")))?;
        Ok(self.rows.iter().map(|row| row[index]).collect())
    }
}

fn largest(values: &[f64]) -> f64 {
    values
        .iter()
        .fold(0.0, |largest, value| largest.max(value.abs()))
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
