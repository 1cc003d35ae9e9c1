//! What `compare` tells: a table for people, `compare.json` for programs.

use std::path::PathBuf;

use serde_json::{Map, Value, json};

use super::super::open::Opened;
use super::super::page::{Page, count, number, seconds, shorten};
use super::super::summary::{status_words, unit_words};
use super::Rung;
use linkdyn_engine::analysis::Outcome;
use linkdyn_output::comparison::{Comparison, Difference};
use linkdyn_output::{Column, Extremes, Trajectory};

/// Digits of numbers in the table.
const DIGITS: usize = 4;

/// Everything there is to tell.
pub struct Report<'a> {
    pub opened: &'a Opened,
    pub joints: &'a [String],
    pub rungs: &'a [Rung],
    /// Whether the models were asked for by name.
    pub wanted: bool,
    pub comparison: &'a Comparison,
    /// Of each model that ran: its outputs and peaks.
    pub curves: &'a [(&'static str, Trajectory)],
}

impl Report<'_> {
    /// The table for people.
    pub fn page(&self, written: &[PathBuf]) -> String {
        let Report {
            opened,
            joints,
            comparison,
            ..
        } = self;
        let mut page = Page::default();
        let of = if joints.len() == 1 { "joint" } else { "joints" };
        page.line(format!(
            "{} ({}): clearance of {of} {}",
            opened.name,
            opened.label,
            joints.join(", ")
        ));
        for rung in self.rungs {
            match &rung.ran {
                Err(why) => page.row(rung.model, format!("{}: {why}", self.refusal())),
                Ok(outcome) => {
                    page.row(rung.model, self.ran(outcome));
                    page.rows("", shorten(outcome.report.warnings.clone()));
                }
            }
        }
        let ran: Vec<&str> = self
            .rungs
            .iter()
            .filter(|rung| rung.ran.is_ok())
            .map(|rung| rung.model)
            .collect();
        let compared = match ran[..] {
            [] => &[],
            [only] => {
                page.line(format!(
                    "  nothing to compare {only} with: no other model was run"
                ));
                &[]
            }
            [first, ..] if comparison.columns.is_empty() => {
                page.line(format!(
                    "  nothing to compare with {first}: the results have none of the columns that are compared"
                ));
                page.line("  unless --columns names others (efforts, forces in the joints, motion of the last body)");
                &[]
            }
            [first, ..] => {
                let heads = ["max", "at t [s]", "mean", "RMS"].map(String::from);
                page.line(table_row(&format!("difference from {first}"), heads));
                comparison.columns.as_slice()
            }
        };
        for column in compared {
            page.line(format!("  {} [{}]", column.name, unit_words(column.unit)));
            for difference in comparison
                .differences
                .iter()
                .filter(|difference| difference.column == *column)
            {
                let numbers = difference
                    .numbers
                    .map_or([f64::NAN; 4], |n| [n.max, n.max_time, n.mean, n.rms]);
                page.line(table_row(
                    &format!("  {}", difference.run),
                    numbers.map(|value| number(value, DIGITS)),
                ));
            }
        }
        if !compared.is_empty() {
            page.line(table_row(
                "smallest and largest",
                ["min", "at t [s]", "max", "at t [s]"].map(String::from),
            ));
        }
        for column in compared {
            page.line(format!("  {} [{}]", column.name, unit_words(column.unit)));
            for (model, extremes) in self.extremes(column) {
                let numbers =
                    extremes.map_or([f64::NAN; 4], |e| [e.min, e.min_time, e.max, e.max_time]);
                page.line(table_row(
                    &format!("  {model}"),
                    numbers.map(|value| number(value, DIGITS)),
                ));
            }
        }
        page.rows(
            "written",
            written.iter().map(|path| path.display().to_string()),
        );
        page.text().to_string()
    }

    /// Smallest and largest value of a column by model, peaks between the outputs included.
    fn extremes(&self, column: &Column) -> impl Iterator<Item = (&'static str, Option<Extremes>)> {
        self.curves.iter().map(|(model, table)| {
            let extremes = table.id_of(column).and_then(|id| table.extremes_of(id));
            (*model, extremes)
        })
    }

    /// How a run went.
    fn ran(&self, outcome: &Outcome) -> String {
        let contacts = self
            .contacts(outcome)
            .map(|n| format!(", {}", count(n as usize, "contact")));
        format!(
            "{}, {}, {}{}, CPU {}",
            status_words(outcome.report.status),
            count(outcome.trajectory.len(), "instant"),
            count(outcome.report.statistics.steps as usize, "step"),
            contacts.unwrap_or_default(),
            seconds(cpu(outcome))
        )
    }

    /// The content of `compare.json`.
    pub fn json(&self) -> Value {
        let rung = |rung: &Rung| match &rung.ran {
            Err(why) => json!({ "model": rung.model, "status": self.refusal(), "message": why }),
            Ok(outcome) => json!({
                "model": rung.model,
                "status": outcome.report.status.word(),
                "message": outcome.report.message,
                "instants": outcome.trajectory.len(),
                "steps": outcome.report.statistics.steps,
                "evaluations": outcome.report.statistics.evaluations,
                "contacts": self.contacts(outcome),
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
        } in &self.comparison.differences
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
        for column in &self.comparison.columns {
            let of_column = extremes.entry(column.label()).or_insert_with(|| json!({}));
            for (model, found) in self.extremes(column) {
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
            "model": { "name": self.opened.name, "sha256": self.opened.sha256 },
            "joints": self.joints,
            "reference": self.reference(),
            "models": self.rungs.iter().map(rung).collect::<Value>(),
            "columns": self.comparison.columns.iter().map(Column::label).collect::<Vec<_>>(),
            "differences": differences,
            "extremes": extremes,
        })
    }

    /// The model that the others are compared with.
    fn reference(&self) -> Option<&'static str> {
        self.rungs
            .iter()
            .find(|rung| rung.ran.is_ok())
            .map(|rung| rung.model)
    }

    /// Word for a model that can't be run.
    fn refusal(&self) -> &'static str {
        if self.wanted { "refused" } else { "skipped" }
    }

    /// Contacts of the joints, where the model has any.
    fn contacts(&self, outcome: &Outcome) -> Option<u64> {
        let counted = outcome
            .report
            .clearances
            .iter()
            .filter(|sums| self.joints.contains(&sums.joint));
        counted.map(|sums| sums.episodes).reduce(|a, b| a + b)
    }
}

/// CPU of assembly and solution \[s\].
fn cpu(outcome: &Outcome) -> f64 {
    outcome.report.assemble.cpu + outcome.report.solve.cpu
}

fn table_row(label: &str, [max, time, mean, rms]: [String; 4]) -> String {
    format!("  {label:32}{max:>12}{time:>12}{mean:>12}{rms:>12}")
}
