//! What responses need of the rows of a run, and of what follows behind them.

use super::derived::{Derived, DerivedWanted};
use super::question::Question;
use super::responses::Responses;
use crate::system::System;
use linkdyn_output::Column;

/// All columns that responses may name behind those of an analysis.
pub(super) fn behind(system: &System, question: &Question) -> Vec<Column> {
    let columns = question.contents.columns(system);
    let all = DerivedWanted::all(system, question);
    Derived::new(system, &columns, &all).headings
}

/// What responses need of rows with all result columns.
pub(super) struct Needed<'p> {
    /// Place of each of them in a row, and in what follows behind it.
    places: Vec<usize>,
    derived: Option<Derived<'p>>,
    /// A row, and behind it what follows from it.
    all: Vec<f64>,
}

impl<'p> Needed<'p> {
    /// Of runs with these columns.
    pub fn new(
        system: &'p System,
        question: &Question,
        responses: &Responses,
        columns: &[Column],
    ) -> Self {
        let needed = responses.needed().iter();
        let indices: Vec<usize> = needed.map(|column| column.index()).collect();
        if indices.iter().all(|&index| index < columns.len()) {
            return Needed {
                places: indices,
                derived: None,
                all: Vec::new(),
            };
        }
        let behind = behind(system, question);
        let follows = |index: &usize| Some(&behind[index.checked_sub(columns.len())?]);
        let is_needed =
            |column: &Column| indices.iter().filter_map(follows).any(|own| own == column);
        let all = DerivedWanted::all(system, question);
        let wanted = DerivedWanted {
            following: all.following.of(is_needed),
            ..all
        };
        let derived = Derived::new(system, columns, &wanted);
        let place = |index: &usize| {
            let Some(column) = follows(index) else {
                return *index;
            };
            let found = derived.headings.iter().position(|own| own == column);
            columns.len() + found.expect("it is among what follows")
        };
        Needed {
            places: indices.iter().map(place).collect(),
            derived: Some(derived),
            all: Vec::new(),
        }
    }

    /// The needed columns of a row.
    pub fn take(&mut self, row: &[f64], needed: &mut Vec<f64>) {
        let mut all = row;
        if let Some(derived) = &mut self.derived {
            self.all.clear();
            self.all.extend_from_slice(row);
            derived.push(row, &mut self.all);
            all = &self.all;
        }
        needed.clear();
        needed.extend(self.places.iter().map(|&place| all[place]));
    }
}
