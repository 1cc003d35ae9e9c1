//! Files of the case: the curves of figures 4 to 8, the table, the singular positions, F12 by centres of mass, what has no
//! solution.

use std::fmt::Write;

use super::centres::Ternary;
use super::facts::Fact;
use super::forces::ForceNear;
use super::models::{Found, Order, Quantity, RADII, STEPS};
use super::table::{Paper, Runs, settles};
use linkdyn_output::{Directory, WriteError};

/// Index of the output step of the curves in [`STEPS`]: 0.5°.
pub const CURVES: usize = 2;

/// A cell; empty where there is no value.
pub fn cell(value: f64) -> String {
    if value.is_finite() {
        format!("{value}")
    } else {
        String::new()
    }
}

/// Figure 4 … 8, one file each.
///
/// # Errors
/// When they can't be written.
pub fn curves(directory: &Directory, runs: &Runs) -> Result<(), WriteError> {
    let ideal = &runs.ideal[CURVES];
    for (figure, quantity) in (4..).zip(Quantity::ALL) {
        let name = |case: &str| format!("{}.{case}[{}]", quantity.symbol(), quantity.unit());
        let mut text = format!("theta6[deg],theta6[rad],{}", name("ideal"));
        for radius in RADII {
            let _ = write!(text, ",{}", name(&format!("{radius}um")));
        }
        text.push('\n');
        for (row, theta6) in ideal.theta6.iter().enumerate() {
            let _ = write!(
                text,
                "{theta6},{},{}",
                theta6.to_radians(),
                cell(ideal.curve(quantity)[row])
            );
            for strokes in &runs.clearance {
                let _ = write!(text, ",{}", cell(strokes[CURVES].curve(quantity)[row]));
            }
            text.push('\n');
        }
        directory.write(&format!("figure{figure}.csv"), text.as_bytes())?;
    }
    Ok(())
}

/// `table.csv`: every row of every table.
///
/// # Errors
/// When it can't be written.
pub fn table(directory: &Directory, all: &[&Runs], paper: &Paper) -> Result<(), WriteError> {
    let steps = |what: &str| {
        STEPS
            .map(|step| format!(",{what} at step {step} deg"))
            .concat()
    };
    let mut text = format!(
        "centres of mass,hinge order,e[um],quantity,unit,statistic,paper{}",
        steps("ours")
    );
    let _ = writeln!(text, ",settles{}", steps("theta6[deg] of the largest"));
    for runs in all {
        let order = match runs.request.order {
            Order::SixOnThree => "6 on 3",
            Order::FiveOnThree => "5 on 3",
        };
        for quantity in Quantity::ALL {
            for (index, radius) in RADII.iter().enumerate() {
                let row = runs.row(index, quantity);
                let [max, mean] = paper.deviation(index, quantity);
                let places = row
                    .iter()
                    .map(|d| format!(",{}", cell(d.at)))
                    .collect::<String>();
                let halves = [
                    (
                        "max",
                        max,
                        row.iter().map(|d| d.max).collect::<Vec<f64>>(),
                        places,
                    ),
                    (
                        "mean",
                        mean,
                        row.iter().map(|d| d.mean).collect(),
                        ",".repeat(STEPS.len()),
                    ),
                ];
                for (statistic, printed, ours, places) in halves {
                    let cells = ours
                        .iter()
                        .map(|&value| format!(",{}", cell(value)))
                        .collect::<String>();
                    let (symbol, unit, centres) = (
                        quantity.symbol(),
                        quantity.unit(),
                        runs.request.centres.words(),
                    );
                    let settled = if settles(&ours) { "yes" } else { "no" };
                    let _ = write!(
                        text,
                        "{centres},{order},{radius},{symbol},{unit},{statistic},{printed}{cells}"
                    );
                    let _ = writeln!(text, ",{settled}{places}");
                }
            }
        }
    }
    directory.write("table.csv", text.as_bytes()).map(|_| ())
}

/// `singular.csv`.
///
/// # Errors
/// When it can't be written.
pub fn singular(directory: &Directory, facts: &[Fact]) -> Result<(), WriteError> {
    let mut text = String::from("quantity,independent,ours,difference,allowed\n");
    for Fact {
        what,
        reference,
        ours,
        tolerance,
    } in facts
    {
        let _ = writeln!(
            text,
            "{what},{reference},{},{},{tolerance}",
            cell(*ours),
            cell(ours - reference)
        );
    }
    directory.write("singular.csv", text.as_bytes()).map(|_| ())
}

/// `centres.csv`: F12 of the ideal lock for every choice of centres of mass.
///
/// # Errors
/// When it can't be written.
pub fn centres(directory: &Directory, map: &[ForceNear]) -> Result<(), WriteError> {
    let mut text = String::from(
        "link 3,link 4,least F12[N],theta6[deg] of the least,fastest turn by the median,theta6[deg] of the fastest,\
         turn near -40 deg by the median,change near -40 deg by the median,abrupt near -40 deg\n",
    );
    for near in map {
        let [third, fourth] = [
            Ternary::Link3.symbol(near.centres.link3),
            Ternary::Link4.symbol(near.centres.link4),
        ];
        let ([least, at], [_, turns_at]) = (near.least, near.turn);
        let numbers = [
            least,
            at,
            near.turn_most,
            turns_at,
            near.turn_near,
            near.change,
        ]
        .map(cell)
        .join(",");
        let abrupt = if near.abrupt() { "yes" } else { "no" };
        let _ = writeln!(text, "{third},{fourth},{numbers},{abrupt}");
    }
    directory.write("centres.csv", text.as_bytes()).map(|_| ())
}

/// `intervals.csv`: without assembly, without a fixed point.
///
/// # Errors
/// When it can't be written.
pub fn intervals(directory: &Directory, runs: &Runs) -> Result<(), WriteError> {
    let mut text = String::from("e[um],step[deg],what,from[deg],to[deg]\n");
    for stroke in runs.clearance.iter().flatten() {
        for (what, name) in [
            (Found::Nothing, "no assembly"),
            (Found::LastPass, "no fixed point"),
        ] {
            for [from, to] in stroke.intervals(what) {
                let _ = writeln!(
                    text,
                    "{},{},{name},{from},{to}",
                    stroke.request.radius, stroke.request.step
                );
            }
        }
    }
    directory
        .write("intervals.csv", text.as_bytes())
        .map(|_| ())
}
