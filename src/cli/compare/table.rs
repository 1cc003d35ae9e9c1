//! The table of a comparison, for people.

use std::path::PathBuf;

use super::report::{Report, cpu};
use crate::cli::page::{Page, count, number, seconds, shorten};
use crate::cli::words::{status_words, unit_words};
use linkdyn_engine::analysis::Outcome;
use linkdyn_output::Column;

/// Digits of numbers.
const DIGITS: usize = 4;

/// The whole page.
pub fn page(report: &Report, written: &[PathBuf]) -> String {
    let Report { opened, joints, .. } = report;
    let mut page = Page::default();
    let of = if joints.len() == 1 { "joint" } else { "joints" };
    page.line(format!(
        "{} ({}): clearance of {of} {}",
        opened.name,
        opened.label,
        joints.join(", ")
    ));
    for rung in report.rungs {
        match &rung.ran {
            Err(why) => page.row(rung.model, format!("{}: {why}", report.refusal())),
            Ok(outcome) => {
                page.row(rung.model, ran(report, outcome));
                page.rows("", shorten(outcome.report.warnings.clone()));
            }
        }
    }
    let ran = report.rungs.iter().filter(|rung| rung.ran.is_ok());
    let ran: Vec<&str> = ran.map(|rung| rung.model).collect();
    let columns = report.comparison.columns.as_slice();
    match ran[..] {
        [] => {}
        [only] => page.line(format!(
            "  nothing to compare {only} with: no other model was run"
        )),
        [first, ..] if columns.is_empty() => {
            page.line(format!(
                "  nothing to compare with {first}: the results have none of the columns that are compared"
            ));
            page.line("  unless --columns names others (efforts, forces in the joints, motion of the last body)");
        }
        [first, ..] => {
            differences(&mut page, report, first, columns);
            extremes(&mut page, report, columns);
        }
    }
    page.rows(
        "written",
        written.iter().map(|path| path.display().to_string()),
    );
    page.text().to_string()
}

/// How far the columns are from those of the first model.
fn differences(page: &mut Page, report: &Report, first: &str, columns: &[Column]) {
    let heads = ["max", "at t [s]", "mean", "RMS"].map(String::from);
    page.line(table_row(&format!("difference from {first}"), heads));
    for column in columns {
        page.line(heading(column));
        let differences = report.comparison.differences.iter();
        for difference in differences.filter(|difference| difference.column == *column) {
            let numbers = difference
                .numbers
                .map_or([f64::NAN; 4], |n| [n.max, n.max_time, n.mean, n.rms]);
            page.line(values(&difference.run, numbers));
        }
    }
}

/// Smallest and largest values of the columns by model.
fn extremes(page: &mut Page, report: &Report, columns: &[Column]) {
    let heads = ["min", "at t [s]", "max", "at t [s]"].map(String::from);
    page.line(table_row("smallest and largest", heads));
    for column in columns {
        page.line(heading(column));
        for (model, extremes) in report.extremes(column) {
            let numbers =
                extremes.map_or([f64::NAN; 4], |e| [e.min, e.min_time, e.max, e.max_time]);
            page.line(values(model, numbers));
        }
    }
}

fn heading(column: &Column) -> String {
    format!("  {} [{}]", column.name, unit_words(column.unit))
}

fn values(model: &str, numbers: [f64; 4]) -> String {
    table_row(
        &format!("  {model}"),
        numbers.map(|value| number(value, DIGITS)),
    )
}

/// How a run ended and went.
fn ran(report: &Report, outcome: &Outcome) -> String {
    let ended = status_words(outcome.report.status);
    format!("{ended}, {}", went(report, outcome))
}

/// How a run went.
pub fn went(report: &Report, outcome: &Outcome) -> String {
    let contacts = report
        .contacts(outcome)
        .map(|n| format!(", {}", count(n as usize, "contact")));
    format!(
        "{}, {}{}, CPU {}",
        count(outcome.trajectory.len(), "instant"),
        count(outcome.report.statistics.steps as usize, "step"),
        contacts.unwrap_or_default(),
        seconds(cpu(outcome))
    )
}

fn table_row(label: &str, [max, time, mean, rms]: [String; 4]) -> String {
    format!("  {label:32}{max:>12}{time:>12}{mean:>12}{rms:>12}")
}
