//! `report.html` of a run.

use super::open::Opened;
use linkdyn_engine::analysis::{Outcome, derived::derived};
use linkdyn_output::{Stage, Summary};
use linkdyn_picture::Report;

/// The text of the page.
pub fn text(opened: &Opened, outcome: &Outcome) -> String {
    let model = &opened.loaded.model;
    let (curves, complete) = (outcome.curves(), outcome.all_curves());
    let summary = Summary {
        model_name: &opened.name,
        model_sha256: &opened.sha256,
        settings: &outcome.settings,
        report: &outcome.report,
        trajectory: &curves,
        mechanism: serde_json::Value::Null,
        drawing: serde_json::Value::Null,
        load: opened.time,
        write: Stage::default(),
    };
    let (derived, mut notes) = derived(model, &complete);
    if !outcome.peaks.is_empty() {
        notes.push(format!(
            "Besides the {} outputs this page has {} instants between them: where columns have their smallest or largest value, \
             and where contacts begin, press most and end.",
            outcome.trajectory.len(),
            outcome.peaks.len()
        ));
    }
    let report = Report {
        derived: Some(&derived),
        notes,
        ..Report::new(model, &summary, &complete)
    };
    report.html()
}
