//! Columns that grow without bound while a motion passes a change point. What rows beside it show depends on where they fall, so
//! that the largest of them is no peak.

use super::Report;
use std::collections::HashMap;

/// Columns without bound, and when they have none.
#[derive(Debug, Clone, PartialEq)]
pub struct Unbounded {
    /// Names of the columns, without units.
    pub columns: Vec<String>,
    /// Each time \[s\].
    pub times: Vec<f64>,
}

impl Report {
    /// Notes that these columns, where there are some, have no bound at a time.
    pub fn note_unbounded(&mut self, columns: &[String], time: f64) {
        if columns.is_empty() {
            return;
        }
        match self.unbounded.iter_mut().find(|one| one.columns == columns) {
            Some(known) => known.times.push(time),
            None => self.unbounded.push(Unbounded {
                columns: columns.to_vec(),
                times: vec![time],
            }),
        }
    }

    /// Columns without bound, each with the first time at which it has none \[s\].
    pub fn first_unbounded(&self) -> HashMap<&str, f64> {
        let mut found = HashMap::new();
        for Unbounded { columns, times } in &self.unbounded {
            let first = times.iter().copied().min_by(f64::total_cmp);
            for (column, time) in columns.iter().zip(first.into_iter().cycle()) {
                let known = found.entry(column.as_str()).or_insert(time);
                *known = known.min(time);
            }
        }
        found
    }
}
