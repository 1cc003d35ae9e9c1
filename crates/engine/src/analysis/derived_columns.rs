//! Result columns that follow from rows: those of forces and joints that are requested, and outputs.

use super::acting::{self, Acting};
use super::channels::Contents;
use super::ratios::{self, Ratios};
use super::rows::Columns;
use crate::system::System;
use linkdyn_output::{Column, Trajectory, matches};

/// Which columns follow from rows.
#[derive(Debug, Clone, Default)]
pub(super) struct DerivedSelection {
    /// Of forces and joints.
    acting: Vec<Column>,
    /// Outputs.
    ratios: Vec<Column>,
}

/// Columns beside the rows of a run.
pub(super) struct DerivedColumns<'s> {
    pub headings: Vec<Column>,
    acting: Option<Acting<'s>>,
    ratios: Option<Ratios<'s>>,
}

impl DerivedSelection {
    /// All that there may be.
    pub fn all(system: &System, contents: Contents) -> Self {
        DerivedSelection {
            acting: acting::offered(system, contents),
            ratios: ratios::headings(system),
        }
    }

    /// Those in the results if these columns are requested; actuators and outputs have theirs anyway.
    ///
    /// Columns that were there before are kept by patterns such as `joint.*`; these must be named by their last word,
    /// `joint.*.angle`, so that the results of a file do not grow.
    pub fn in_results(system: &System, contents: Contents, patterns: &[String]) -> Self {
        let mut following = DerivedSelection {
            acting: Vec::new(),
            ratios: ratios::headings(system),
        };
        if !patterns.is_empty() || acting::has_unasked(system) {
            following.acting = acting::offered(system, contents);
            following.acting.retain(|column| {
                let is_asked = patterns.iter().any(|pattern| asks(pattern, &column.name));
                is_asked || acting::is_unasked(system, column)
            });
        }
        following
    }

    /// Those of these columns.
    pub fn of(&self, is_wanted: impl Fn(&Column) -> bool) -> Self {
        let of = |columns: &[Column]| {
            let wanted = columns.iter().filter(|column| is_wanted(column));
            wanted.cloned().collect()
        };
        DerivedSelection {
            acting: of(&self.acting),
            ratios: of(&self.ratios),
        }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.acting.is_empty() && self.ratios.is_empty()
    }

    /// Their headings, in the order of results.
    pub fn headings(&self) -> Vec<Column> {
        [self.acting.as_slice(), &self.ratios].concat()
    }
}

/// Whether a pattern asks for a column by its last word.
fn asks(pattern: &str, name: &str) -> bool {
    let kind = |text: &str| text.split_once('.').map(|(kind, _)| kind.to_owned());
    let word = |text: &str| text.rsplit_once('.').map(|(_, word)| word.to_owned());
    kind(pattern) == kind(name) && word(pattern) == word(name) && matches(pattern, name)
}

impl<'s> DerivedColumns<'s> {
    /// Beside rows with these columns.
    pub fn new(system: &'s System, columns: &Columns, following: &DerivedSelection) -> Self {
        let DerivedSelection { acting, ratios } = following;
        let acting = (!acting.is_empty()).then(|| Acting::new(system, columns, acting));
        let ratios = (!ratios.is_empty()).then(|| Ratios::new(system, columns, ratios));
        DerivedColumns {
            headings: following.headings(),
            acting: acting.flatten(),
            ratios: ratios.flatten(),
        }
    }

    /// What there is to say about empty cells of the rows so far.
    pub fn notes(&self) -> Vec<String> {
        self.ratios.as_ref().map_or_else(Vec::new, Ratios::notes)
    }

    /// Numbers from outside have these values in rows from now on.
    pub fn give(&mut self, numbers: &[f64]) {
        if let Some(acting) = &mut self.acting {
            acting.give(numbers);
        }
    }

    /// Appends the columns of a row; NaN where there is nothing.
    pub fn push(&mut self, row: &[f64], line: &mut Vec<f64>) {
        let begin = line.len();
        if let Some(acting) = &mut self.acting {
            acting.push(row, line);
        }
        if let Some(ratios) = &mut self.ratios {
            ratios.push(row, line);
        }
        line.resize(begin + self.headings.len(), f64::NAN);
    }

    /// A table with these columns behind its own.
    pub fn appended(&mut self, table: &Trajectory) -> Trajectory {
        let headings = table.columns.iter().chain(&self.headings).cloned();
        let mut together = Trajectory::new(headings.collect());
        together.reserve(table.len());
        for row in table.rows() {
            together.data.extend_from_slice(row);
            self.push(row, &mut together.data);
            let begin = together.data.len() - self.headings.len();
            let added = together.data[begin..].iter_mut();
            added
                .filter(|value| !value.is_finite())
                .for_each(|value| *value = f64::NAN);
        }
        together
    }
}
