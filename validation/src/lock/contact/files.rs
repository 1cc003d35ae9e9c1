//! Files of the case: curves, figures, the table at every tolerance, the strokes.

use std::fmt::Write;

use super::super::figures::{Drawn, marks, panel};
use super::super::files::{CURVES, cell};
use super::super::models::{Quantity, RADII, STEPS, Stroke};
use super::super::table::{Deviation, Paper, Runs, settles};
use super::branch::Branch;
use super::convergence::{CLEAR, Convergence, STATISTICS, by_tolerance};
use super::page::Work;
use super::strokes::{Contact, TOLERANCES};
use crate::CaseError;
use linkdyn_output::{Directory, WriteError};
use linkdyn_picture::{Axis, Chart, svg};

/// Figure 4 … 8 with the massless link in the upper panel and contact in the lower one, and their curves.
///
/// # Errors
/// When they can't be drawn or written.
pub fn figures(
    directory: &Directory,
    base: &Runs,
    contact: &[&Stroke],
    change_point: Option<f64>,
) -> Result<Vec<Drawn>, CaseError> {
    let fine = STEPS.len() - 1;
    let mut drawn = Vec::new();
    for (figure, quantity) in (4..).zip(Quantity::ALL) {
        let massless = base.clearance.iter().map(|strokes| &strokes[CURVES]);
        let (upper, above) = panel(
            quantity,
            ", massless",
            [&base.ideal[CURVES]].into_iter().chain(massless),
        );
        let (lower, below) = panel(
            quantity,
            ", contact",
            [&base.ideal[fine]]
                .into_iter()
                .chain(contact.iter().copied()),
        );
        let chart = Chart {
            x: Axis::new("θ6", "deg"),
            panels: vec![upper, lower],
            marks: marks(change_point),
            note: format!(
                "All seven hinges: massless clearance links, outputs {}° apart ({above}); contact (steel, restitution 0.9), outputs {}° \
                 apart ({below}).",
                STEPS[CURVES], STEPS[fine]
            ),
            size_mm: [None, Some(112.0)],
            whole: true,
            ..Chart::default()
        };
        let scene = chart
            .draw()
            .map_err(|fault| CaseError::Broken(format!("figure {figure}: {fault}")))?;
        let file = format!("figure{figure}.svg");
        directory.write(&file, svg::write(&scene).as_bytes())?;
        let about = format!(
            "{} [{}] over theta6, massless: {above};\n{:13}contact: {below}",
            quantity.symbol(),
            quantity.unit(),
            ""
        );
        drawn.push(Drawn { file, about });
        curves(directory, base, contact, figure, quantity)?;
    }
    Ok(drawn)
}

fn curves(
    directory: &Directory,
    base: &Runs,
    contact: &[&Stroke],
    figure: usize,
    quantity: Quantity,
) -> Result<(), WriteError> {
    let ideal = &base.ideal[STEPS.len() - 1];
    let massless: Vec<&Stroke> = base
        .clearance
        .iter()
        .map(|strokes| &strokes[STEPS.len() - 1])
        .collect();
    let name = |case: &str| format!("{}.{case}[{}]", quantity.symbol(), quantity.unit());
    let mut text = format!("theta6[deg],theta6[rad],{}", name("ideal"));
    for model in ["massless", "contact"] {
        for radius in RADII {
            let _ = write!(text, ",{}", name(&format!("{model}.{radius}um")));
        }
    }
    text.push('\n');
    for (row, theta6) in ideal.theta6.iter().enumerate() {
        let _ = write!(text, "{theta6},{}", theta6.to_radians());
        for stroke in [&ideal].into_iter().chain(&massless).chain(contact) {
            let value = stroke.curve(quantity).get(row).copied().unwrap_or(f64::NAN);
            let _ = write!(text, ",{}", cell(value));
        }
        text.push('\n');
    }
    directory
        .write(&format!("figure{figure}.csv"), text.as_bytes())
        .map(|_| ())
}

/// `table.csv`: the paper's statistics at every tolerance, over the stroke and clear of the change point.
///
/// # Errors
/// When it can't be written.
pub fn table(
    directory: &Directory,
    convergence: &Convergence,
    paper: &Paper,
) -> Result<(), WriteError> {
    let ours = TOLERANCES
        .map(|rtol| format!(",ours at rtol {rtol:e}"))
        .concat();
    let mut text =
        format!("up to[deg],e[um],quantity,unit,statistic,paper,step[deg]{ours},settles\n");
    for (end, all) in [
        ("125".to_string(), &convergence.whole),
        (CLEAR.to_string(), &convergence.clear),
    ] {
        for quantity in Quantity::ALL {
            for (radius, e) in RADII.iter().enumerate() {
                for ((name, statistic), printed) in STATISTICS
                    .into_iter()
                    .zip(paper.deviation(radius, quantity))
                {
                    for (index, step) in STEPS.iter().enumerate() {
                        let values = by_tolerance(all, [radius, index], quantity, statistic);
                        let cells: String = values
                            .iter()
                            .map(|&value| format!(",{}", cell(value)))
                            .collect();
                        let settled = if settles(&values) { "yes" } else { "no" };
                        let (symbol, unit) = (quantity.symbol(), quantity.unit());
                        let _ = writeln!(
                            text,
                            "{end},{e},{symbol},{unit},{name},{printed},{step}{cells},{settled}"
                        );
                    }
                }
            }
        }
    }
    directory.write("table.csv", text.as_bytes()).map(|_| ())
}

/// `strokes.csv`: where each stroke went, and its work.
///
/// # Errors
/// When it can't be written.
pub fn strokes(
    directory: &Directory,
    strokes: &[(Contact, &Stroke)],
    branches: &[Branch],
    deviations: &[(Contact, [Deviation; 5])],
) -> Result<(), WriteError> {
    let mut text = String::from(
        "hinges,e[um],rtol,status,branch,last theta6[deg],theta2 there[deg],ideal theta2[deg],theta4-theta3[deg],\
         farthest theta2 beyond 117.5 deg[deg],\
         steps,rejected,evaluations,contacts,touching,largest force[N],energy imbalance",
    );
    for quantity in Quantity::ALL {
        let _ = write!(
            text,
            ",max {0} up to {CLEAR}[{1}],mean {0} up to {CLEAR}[{1}]",
            quantity.symbol(),
            quantity.unit()
        );
    }
    text.push('\n');
    for (((contact, stroke), branch), (_, deviations)) in
        strokes.iter().zip(branches).zip(deviations)
    {
        let Work {
            steps,
            rejected,
            evaluations,
            contacts,
            touching,
            peak_force,
            imbalance,
            ..
        } = Work::of(stroke);
        let Contact {
            joint,
            radius,
            rtol,
        } = contact;
        let Branch {
            last,
            theta2: [with, without],
            between,
            farthest,
            ..
        } = branch;
        let (joint, status, word) = (
            joint.unwrap_or("all"),
            stroke.report.status.word(),
            branch.word(),
        );
        let farthest = cell(farthest.map_or(f64::NAN, |[farthest, _]| farthest));
        let _ = write!(
            text,
            "{joint},{radius},{rtol:e},{status},{word},{last},{with},{without},{between},{farthest}"
        );
        let _ = write!(text, ",{steps},{rejected}");
        let deviations = deviations
            .map(|d| format!(",{},{}", cell(d.max), cell(d.mean)))
            .concat();
        let _ = writeln!(
            text,
            ",{evaluations},{contacts},{touching},{peak_force},{imbalance}{deviations}"
        );
    }
    directory.write("strokes.csv", text.as_bytes()).map(|_| ())
}
