//! What the page says of a run besides its curves.

use serde_json::{Value, json};

use super::ComparedRun;
use crate::cut::Cut;
use linkdyn_output::comparison::{Comparison, Difference};
use linkdyn_output::{Column, Event, EventKind, TIME};

/// Marks of contacts that are nearer than this part of the run look like one.
const APART: f64 = 1.0 / 2000.0;

/// `[kind, from, to]` of what happened; contacts that look like one at any width of a window are one mark.
pub fn events(run: &ComparedRun) -> Value {
    let times = run.table.and_then(|table| table.values(TIME));
    let last = times.and_then(|times| times.last().copied()).unwrap_or(0.0);
    let mut marks: Vec<(&'static str, f64, f64)> = Vec::new();
    for event in run.events {
        let (from, to) = (event.time, end(event, last));
        let kind = word(event);
        let near = marks.last_mut().filter(|(other, _, until)| {
            kind == "contact" && *other == kind && from - *until < APART * last
        });
        match near {
            Some((_, _, until)) => *until = until.max(to),
            None => marks.push((kind, from, to)),
        }
    }
    marks
        .iter()
        .map(|(kind, from, to)| json!([kind, from, to]))
        .collect()
}

/// The end of an event; a contact without end goes on when the run ends.
fn end(event: &Event, last: f64) -> f64 {
    let open = if event.kind == EventKind::Contact {
        last
    } else {
        event.time
    };
    event.end_time.unwrap_or(open).max(event.time)
}

/// `contact` for all that happens between journal and bearing.
fn word(event: &Event) -> &'static str {
    match event.kind {
        EventKind::Contact | EventKind::SustainedContact | EventKind::Stick | EventKind::Slip => {
            "contact"
        }
        other => other.name(),
    }
}

/// Where the axes of a column's values and of its differences end, by the rule of all pictures.
pub fn cuts(run: &ComparedRun, column: &Column) -> Value {
    let values = run
        .table
        .and_then(|table| Some((table, table.id_of(column)?)));
    let cut = values.and_then(|(table, id)| Cut::of(table.column(id).iter()));
    cut.unwrap_or_default().to_json()
}

/// Where the axis of the differences to the reference ends.
pub fn apart_cuts(comparison: &Comparison, reference: &str, run: &str, column: &Column) -> Value {
    let curves = &comparison.curves;
    let of = |run: &str| {
        let label = Column::new(format!("{run}:{}", column.name), column.unit);
        curves.id_of(&label).map(|id| curves.column(id))
    };
    let cut = of(reference)
        .zip(of(run))
        .and_then(|(first, other)| Cut::of(other.iter().zip(first.iter()).map(|(a, b)| a - b)));
    cut.unwrap_or_default().to_json()
}

/// `[smallest, at, largest, at]`, peaks between the outputs included; null where there is no value.
pub fn extremes(run: &ComparedRun, column: &Column) -> Value {
    let found = run
        .table
        .and_then(|table| table.extremes_of(table.id_of(column)?));
    found.map_or(Value::Null, |e| {
        json!([e.min, e.min_time, e.max, e.max_time])
    })
}

/// `[largest, at, mean, root mean square]` of the differences to the first run; null where there are none.
pub fn differences(comparison: &Comparison, run: &str, column: &Column) -> Value {
    let is_it = |found: &&Difference| found.run == run && found.column == *column;
    let found = comparison.differences.iter().find(is_it);
    let numbers = found.and_then(|difference| difference.numbers);
    numbers.map_or(Value::Null, |n| json!([n.max, n.max_time, n.mean, n.rms]))
}
