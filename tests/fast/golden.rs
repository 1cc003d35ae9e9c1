//! Memory, not evidence: what the bundled models gave when somebody last looked, numbers and work.
//!
//! A difference says that something changed, not which of the two is right; evidence stands in `validation/` and
//! `tests/fast/laws`. After a change that is meant: `LINKDYN_GOLDEN=write cargo test --test fast golden`, and read the
//! difference before committing it.

use crate::models;
use crate::models::{load_bundled, solve};
use linkdyn_engine::analysis::Outcome;
use linkdyn_model::bundled;
use serde_json::{Map, Value, json};
use std::fs;
use std::path::PathBuf;

/// Numbers kept per model.
const NUMBERS: usize = 12;
/// Relative to the largest magnitude in the column: another machine's sine differs in the last bit, and near a change point
/// that bit is worth several digits.
const TOLERANCE: f64 = 1e-8;
/// Work may differ by one part in this many (or by one) between machines, for the same reason.
const WORK_PARTS: u64 = 50;
/// The same where impacts multiply it again and again.
const TOLERANCE_OF_IMPACTS: f64 = 1e-3;
const WORK_PARTS_OF_IMPACTS: u64 = 10;
/// Columns that are smaller hold round-off alone.
const SMALLEST: f64 = 1e-4;

fn file(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
        .join("tests/golden")
        .join(format!("{name}.json"))
}

/// A dozen columns, spread evenly, each at another row.
fn numbers(outcome: &Outcome) -> Map<String, Value> {
    let table = &outcome.trajectory;
    let mut numbers = Map::new();
    for k in 0..NUMBERS {
        let column = (k * (table.width() - 1)) / (NUMBERS - 1);
        let row = (k + 1) * (table.len() - 1) / (NUMBERS + 1);
        numbers.insert(
            format!("{} row {row}", table.columns[column].label()),
            json!(table.row(row)[column]),
        );
    }
    numbers
}

fn remembered(outcome: &Outcome) -> Value {
    let work = &outcome.report.statistics;
    json!({
        "status": outcome.report.status.word(),
        "events": outcome.report.events.iter().map(|event| event.kind.name()).collect::<Vec<_>>(),
        "work": {
            "steps": work.steps,
            "rejected": work.rejected,
            "newton_iterations": work.newton_iterations,
            "evaluations": work.evaluations,
            "factorisations": work.factorisations,
        },
        "numbers": numbers(outcome),
    })
}

/// Largest magnitude in the column of a label `name[unit] row k`.
fn scale(outcome: &Outcome, label: &str) -> f64 {
    let column = label.split(" row ").next().expect("a column");
    models::values(outcome, column)
        .iter()
        .fold(0.0, |m: f64, value| m.max(value.abs()))
}

#[test]
fn bundled_models_give_what_they_gave() {
    let write = std::env::var_os("LINKDYN_GOLDEN").is_some_and(|value| value == "write");
    let mut changes = Vec::new();
    for bundled in bundled::MODELS {
        let outcome = solve(&load_bundled(bundled.name, &[]));
        let impacts = outcome
            .report
            .events
            .iter()
            .any(|event| event.episode.is_some());
        let (tolerance, parts) = if impacts {
            (TOLERANCE_OF_IMPACTS, WORK_PARTS_OF_IMPACTS)
        } else {
            (TOLERANCE, WORK_PARTS)
        };
        let now = remembered(&outcome);
        if write {
            fs::write(file(bundled.name), format!("{now:#}\n")).expect("written");
            continue;
        }
        let text = fs::read_to_string(file(bundled.name)).unwrap_or_else(|error| {
            panic!("{}: {error}; LINKDYN_GOLDEN=write makes it", bundled.name)
        });
        let then: Value = serde_json::from_str(&text).expect("valid JSON");
        for key in ["status", "events"] {
            if now[key] != then[key] {
                changes.push(format!(
                    "{}: {key}: {} was {}",
                    bundled.name, now[key], then[key]
                ));
            }
        }
        for (key, was) in then["work"].as_object().expect("work") {
            let (was, is) = (
                was.as_u64().expect("a count"),
                now["work"][key].as_u64().expect("a count"),
            );
            if is.abs_diff(was) > (was / parts).max(1) {
                changes.push(format!("{}: {key}: {is} was {was}", bundled.name));
            }
        }
        for (label, was) in then["numbers"].as_object().expect("numbers") {
            let (was, is) = (
                was.as_f64().unwrap_or(f64::NAN),
                now["numbers"][label].as_f64().unwrap_or(f64::NAN),
            );
            let near = (is - was).abs() <= tolerance * scale(&outcome, label).max(SMALLEST);
            if !near {
                changes.push(format!("{}: {label}: {is} was {was}", bundled.name));
            }
        }
    }
    assert!(changes.is_empty(), "{}", changes.join("\n"));
}
