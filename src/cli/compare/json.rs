//! `compare.json`, for programs.

use serde_json::{Map, Value, json};

use super::ladder::Rung;
use super::report::{Report, cpu};
use linkdyn_output::Column;
use linkdyn_output::comparison::Difference;

/// The content of `compare.json`.
pub fn json(report: &Report) -> Value {
    let rung = |rung: &Rung| match &rung.ran {
        Err(why) => json!({ "model": rung.model, "status": report.refusal(), "message": why }),
        Ok(outcome) => json!({
            "model": rung.model,
            "status": outcome.report.status.word(),
            "message": outcome.report.message,
            "instants": outcome.trajectory.len(),
            "steps": outcome.report.statistics.steps,
            "evaluations": outcome.report.statistics.evaluations,
            "contacts": report.contacts(outcome),
            "cpu": cpu(outcome),
            "warnings": outcome.report.warnings,
        }),
    };
    let mut differences = Map::new();
    for Difference {
        run,
        column,
        instants,
        numbers,
    } in &report.comparison.differences
    {
        let of_column = differences
            .entry(column.label())
            .or_insert_with(|| json!({}));
        of_column[run] = json!({
            "max": numbers.map(|n| n.max),
            "max_time": numbers.map(|n| n.max_time),
            "mean": numbers.map(|n| n.mean),
            "rms": numbers.map(|n| n.rms),
            "instants": instants,
        });
    }
    let mut extremes = Map::new();
    for column in &report.comparison.columns {
        let of_column = extremes.entry(column.label()).or_insert_with(|| json!({}));
        for (model, found) in report.extremes(column) {
            of_column[model] = json!({
                "min": found.map(|e| e.min),
                "min_time": found.map(|e| e.min_time),
                "max": found.map(|e| e.max),
                "max_time": found.map(|e| e.max_time),
            });
        }
    }
    json!({
        "engine": env!("CARGO_PKG_VERSION"),
        "model": { "name": report.opened.name, "sha256": report.opened.sha256 },
        "joints": report.joints,
        "reference": report.reference(),
        "models": report.rungs.iter().map(rung).collect::<Value>(),
        "columns": report.comparison.columns.iter().map(Column::label).collect::<Vec<_>>(),
        "differences": differences,
        "extremes": extremes,
    })
}
