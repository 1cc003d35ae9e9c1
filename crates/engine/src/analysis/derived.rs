//! Quantities that follow from a run's results, row by row, and are no result columns: for the report, and for responses.

use super::applied::Loads;
use super::derived_columns::{DerivedColumns, DerivedSelection};
use super::question::{self, Question};
use super::rows::Columns;
use super::shaking::{self, Shaking};
use super::transmission::{Transmission, Transmitted};
use crate::system::System;
use crate::system::compile::compile;
use linkdyn_model::Checked;
use linkdyn_output::{Column, Trajectory};

/// What may follow from rows, beside applied forces and shaking force and moment.
#[derive(Debug, Clone, Default)]
pub(super) struct DerivedWanted {
    /// `None` if none is requested, `None` within if its driver or body is not there.
    pub transmission: Option<Option<Transmission>>,
    /// Columns that results have if they are requested.
    pub following: DerivedSelection,
}

impl DerivedWanted {
    /// All that responses may name.
    pub fn all(system: &System, question: &Question) -> Self {
        DerivedWanted {
            transmission: question.transmission,
            following: DerivedSelection::all(system, question.contents),
        }
    }
}

/// Applied forces, shaking force and moment, velocity ratio, mechanical advantage and transmission angles, as far as there are
/// any, and columns that results have if they are requested.
pub(super) struct Derived<'s> {
    pub headings: Vec<Column>,
    loads: Loads<'s>,
    shaking: Option<Shaking<'s>>,
    /// `None` if none is wanted.
    transmission: Option<Result<Transmitted<'s>, String>>,
    beside: DerivedColumns<'s>,
}

impl<'s> Derived<'s> {
    /// Beside rows with these columns.
    pub fn new(system: &'s System, columns: &[Column], wanted: &DerivedWanted) -> Self {
        let columns = Columns::of(columns);
        let loads = Loads::new(system, &columns);
        let shaking = Shaking::new(system, &columns);
        let transmission = wanted.transmission;
        let transmission = transmission.map(|wanted| Transmitted::new(system, wanted, &columns));
        let is_new = |column: &Column| !loads.headings.contains(column);
        let beside = DerivedColumns::new(system, &columns, &wanted.following.of(is_new));
        let mut headings = loads.headings.clone();
        headings.extend(shaking.iter().flat_map(|_| shaking::headings()));
        let transmitted = transmission.iter().flatten();
        headings.extend(transmitted.flat_map(|one| one.headings.iter().cloned()));
        headings.extend(beside.headings.iter().cloned());
        Derived {
            headings,
            loads,
            shaking,
            transmission,
            beside,
        }
    }

    /// Appends what follows from a row; NaN where there is nothing.
    pub fn push(&mut self, row: &[f64], line: &mut Vec<f64>) {
        let begin = line.len();
        self.loads.push(row, line);
        if let Some(shaking) = &mut self.shaking {
            shaking.push(row, line);
        }
        if let Some(Ok(transmission)) = &mut self.transmission {
            transmission.push(row, line);
        }
        self.beside.push(row, line);
        let added = line[begin..].iter_mut();
        added
            .filter(|value| !value.is_finite())
            .for_each(|value| *value = f64::NAN);
    }

    /// What there is to say about cells that are empty.
    ///
    /// # Errors
    /// Why there is no transmission.
    fn notes(&self) -> Result<Vec<String>, String> {
        let said = self.transmission.as_ref().map(|transmission| {
            let transmission = transmission.as_ref().map_err(Clone::clone)?;
            transmission.notes()
        });
        said.unwrap_or_else(|| Ok(Vec::new()))
    }
}

/// Applied forces and torques at the instants of a table with the poses of all bodies; `None` if the model can't be run.
pub fn loads(model: &Checked, results: &Trajectory) -> Option<Trajectory> {
    let system = compile(model, model.analysis.as_ref()?.kind).ok()?;
    let mut loads = Loads::new(&system, &Columns::of(&results.columns));
    let mut table = Trajectory::new(loads.headings.clone());
    for row in results.rows() {
        loads.push(row, &mut table.data);
    }
    Some(table)
}

/// All that follows from results, and what there is to say about what does not exist.
pub fn derived(model: &Checked, results: &Trajectory) -> (Trajectory, Vec<String>) {
    let nothing = || (Trajectory::default(), Vec::new());
    let Some(analysis) = &model.analysis else {
        return nothing();
    };
    let Ok(system) = compile(model, analysis.kind) else {
        return nothing();
    };
    if results.is_empty() {
        return nothing();
    }
    let wanted = analysis.transmission.as_ref();
    let wanted = wanted.map(|wanted| question::transmission(&system, wanted));
    let table = |transmission: Option<Option<Transmission>>| {
        let wanted = DerivedWanted {
            transmission,
            ..DerivedWanted::default()
        };
        let mut derived = Derived::new(&system, &results.columns, &wanted);
        // what was requested is in the results already
        let is_new = |column: &Column| results.id_of(column).is_none();
        let new: Vec<bool> = derived.headings.iter().map(is_new).collect();
        let kept = derived.headings.iter().zip(&new).filter(|(_, new)| **new);
        let mut table = Trajectory::new(kept.map(|(column, _)| column.clone()).collect());
        let mut line = Vec::with_capacity(new.len());
        for row in results.rows() {
            line.clear();
            derived.push(row, &mut line);
            let kept = line.iter().zip(&new).filter(|(_, new)| **new);
            table.data.extend(kept.map(|(value, _)| value));
        }
        (table, derived.notes())
    };
    match table(wanted) {
        (table, Ok(notes)) => (table, notes),
        (_, Err(note)) => (
            table(None).0,
            vec![format!("analysis.transmission: {note}")],
        ),
    }
}
