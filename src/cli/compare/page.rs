//! `compare.html`: the runs over each other.

use super::ladder::Rung;
use super::report::Report;
use super::table::went;
use crate::cli::words::status_words;
use linkdyn_picture::{ComparePage, ComparedRun};

/// The page.
pub fn html(report: &Report) -> String {
    let of = if report.joints.len() == 1 {
        "joint"
    } else {
        "joints"
    };
    // Told before the warnings: why a run ended early.
    let notes: Vec<Vec<String>> = report.rungs.iter().map(notes).collect();
    let runs = report.rungs.iter().zip(&notes);
    let page = ComparePage {
        model: &report.opened.name,
        about: report.opened.loaded.model.about.as_deref(),
        changes: format!(
            "models of the clearance of {of} {}",
            report.joints.join(", ")
        ),
        comparison: report.comparison,
        runs: runs
            .map(|(rung, notes)| compared(report, rung, notes))
            .collect(),
    };
    page.html()
}

fn notes(rung: &Rung) -> Vec<String> {
    let Ok(outcome) = &rung.ran else {
        return Vec::new();
    };
    let message = outcome.report.message.iter();
    message.chain(&outcome.report.warnings).cloned().collect()
}

fn compared<'a>(report: &'a Report, rung: &'a Rung, notes: &'a [String]) -> ComparedRun<'a> {
    let mut run = ComparedRun {
        name: rung.model,
        status: None,
        ended: report.refusal().to_string(),
        facts: String::new(),
        notes,
        table: None,
        events: &[],
    };
    match &rung.ran {
        Err(why) => run.facts.clone_from(why),
        Ok(outcome) => {
            let curves = report.curves.iter().find(|(model, _)| *model == rung.model);
            run.status = Some(outcome.report.status);
            run.ended = status_words(outcome.report.status);
            run.facts = went(report, outcome);
            run.table = curves.map(|(_, table)| table);
            run.events = &outcome.report.events;
        }
    }
    run
}
