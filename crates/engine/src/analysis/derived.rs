//! Quantities that follow from a run's results, row by row, and are no result columns: for the report, and for responses.

use super::applied::Loads;
use super::question;
use super::rows::Columns;
use super::shaking::{self, Shaking};
use super::transmission::{Transmission, Transmitted};
use crate::system::System;
use crate::system::compile::compile;
use linkdyn_model::Checked;
use linkdyn_output::{Column, Trajectory};

/// Applied forces, shaking force and moment, velocity ratio, mechanical advantage and transmission angles, as far as there are any.
pub(super) struct Derived<'s> {
    pub headings: Vec<Column>,
    loads: Loads<'s>,
    shaking: Option<Shaking<'s>>,
    /// None where none is wanted.
    transmission: Option<Result<Transmitted<'s>, String>>,
}

impl<'s> Derived<'s> {
    /// Beside rows with these columns, with the transmission that is wanted, none within where its driver or body is not there.
    pub fn new(
        system: &'s System,
        columns: &[Column],
        wanted: Option<Option<Transmission>>,
    ) -> Self {
        let columns = Columns::of(columns);
        let loads = Loads::new(system, &columns);
        let shaking = Shaking::new(system, &columns);
        let transmission = wanted.map(|wanted| Transmitted::new(system, wanted, &columns));
        let mut headings = loads.headings.clone();
        headings.extend(shaking.iter().flat_map(|_| shaking::headings()));
        let transmitted = transmission.iter().flatten();
        headings.extend(transmitted.flat_map(|one| one.headings.iter().cloned()));
        Derived {
            headings,
            loads,
            shaking,
            transmission,
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

/// Applied forces and torques at the instants of a table with the poses of all bodies; none where the model can't be run.
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
    let table = |wanted: Option<Option<Transmission>>| {
        let mut derived = Derived::new(&system, &results.columns, wanted);
        let mut table = Trajectory::new(derived.headings.clone());
        for row in results.rows() {
            derived.push(row, &mut table.data);
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
