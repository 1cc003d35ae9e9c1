//! The page.

use serde_json::{Value, json};

use super::facts::{apart_cuts, cuts, differences, events, extremes};
use super::parts::{ComparePage, ComparedRun};
use super::values::{chosen, encoded};
use crate::html::{Live, escaped};
use crate::palette;
use linkdyn_output::{Column, Status};

const BODY: &str = include_str!("page.html");
const STYLE: &str = include_str!("page.css");
/// In the order in which they build on each other.
pub const SCRIPTS: &[&str] = &[
    include_str!("js/data.js"),
    include_str!("js/runs.js"),
    include_str!("js/marks.js"),
    include_str!("js/card.js"),
    include_str!("js/cards.js"),
    include_str!("js/tables.js"),
    include_str!("js/head.js"),
];
/// More plots can't be looked at, and the page has to stay small.
const MOST_COLUMNS: usize = 40;
/// Warnings of a run beyond these are left out.
const MOST_NOTES: usize = 8;

impl ComparePage<'_> {
    /// The page as the text of a file, which needs nothing else.
    pub fn html(&self) -> String {
        let all = &self.comparison.columns;
        let columns = &all[..all.len().min(MOST_COLUMNS)];
        let chosen = chosen(self.comparison, columns, &self.runs);
        let mut notes = chosen.notes.clone();
        if columns.len() < all.len() {
            let (shown, all) = (columns.len(), all.len());
            notes.push(format!(
                "The first {shown} of {all} columns are shown; compare.csv and the figures have all."
            ));
        }
        let headings = columns
            .iter()
            .map(|Column { name, unit, .. }| json!([name, unit]));
        let runs = self.runs.iter().zip(&chosen.rows);
        let data = json!({
            "engine": env!("CARGO_PKG_VERSION"),
            "model": self.model,
            "about": self.about,
            "changes": self.changes,
            "columns": headings.collect::<Value>(),
            "runs": runs.map(|(run, rows)| self.run(run, rows.len(), columns)).collect::<Value>(),
            "notes": notes,
            "bytes": if chosen.binary64 { 8 } else { 4 },
            "palette": palette::to_json(),
        });
        Live {
            title: "linkdyn comparison",
            style: STYLE,
            body: BODY,
            scripts: SCRIPTS,
            data: &escaped(&data.to_string()),
            values: &encoded(&self.runs, columns, &chosen),
        }
        .html()
    }

    /// What the page knows of a run, but for its rows.
    fn run(&self, run: &ComparedRun, rows: usize, columns: &[Column]) -> Value {
        let sort = match run.status {
            None => "none",
            Some(Status::Completed) => "good",
            Some(Status::CompletedWithGaps) => "warn",
            Some(_) => "bad",
        };
        let columns = || columns.iter();
        let mut ran = self.runs.iter().filter(|run| run.table.is_some());
        let reference = ran.next().map_or("", |run| run.name);
        json!({
            "name": run.name,
            "ended": run.ended,
            "sort": sort,
            "facts": run.facts,
            "notes": run.notes.iter().take(MOST_NOTES).collect::<Vec<_>>(),
            "rows": rows,
            "events": events(run),
            "cuts": columns().map(|column| cuts(run, column)).collect::<Value>(),
            "apart_cuts": columns()
                .map(|column| apart_cuts(self.comparison, reference, run.name, column))
                .collect::<Value>(),
            "extremes": columns().map(|column| extremes(run, column)).collect::<Value>(),
            "differences": columns().map(|column| differences(self.comparison, run.name, column)).collect::<Value>(),
        })
    }
}
