//! The outputs of a linear system: columns of results at any state.

use super::answer::NoLinearSystem;
use crate::analysis::channels::{Channels, Contents};
use crate::analysis::derived_columns::{DerivedColumns, DerivedSelection};
use crate::analysis::rows::Columns;
use crate::analysis::sample::Sample;
use crate::system::{Evaluation, Inputs, System};
use linkdyn_model::nearest;
use linkdyn_output::{Channel, Column, EnergyQuantity, matches};

/// The columns that are outputs, and what reads them.
pub struct OutputColumns<'s> {
    system: &'s System,
    channels: Channels,
    derived: DerivedColumns<'s>,
    /// Their places in a row.
    chosen: Vec<usize>,
    headings: Vec<Column>,
    row: Vec<f64>,
}

impl<'s> OutputColumns<'s> {
    /// Those of these names or patterns, in their order; those of these channels where none are given.
    ///
    /// # Errors
    /// Names and patterns of no column.
    pub fn new(
        system: &'s System,
        rubs: bool,
        patterns: &[String],
        otherwise: &[Channel],
    ) -> Result<Self, NoLinearSystem> {
        let contents = Contents {
            velocities: true,
            accelerations: true,
            reactions: true,
            friction: rubs,
        };
        let channels = Channels::new(system, contents);
        let selection = DerivedSelection::all(system, contents);
        let derived = DerivedColumns::new(system, &Columns::of(channels.columns()), &selection);
        let mut headings = channels.columns().to_vec();
        headings.extend(selection.headings());
        let mut chosen = Vec::new();
        // Time, and what is a sum over the motion before, are no functions of the state.
        let is_own =
            |column: &Column| column.channel != Some(Channel::Energy(EnergyQuantity::Dissipated));
        let places = || {
            let all = headings.iter().enumerate().skip(1);
            all.filter(|(_, column)| is_own(column))
        };
        for pattern in patterns {
            let fits = places().filter(|(_, column)| matches(pattern, &column.name));
            let before = chosen.len();
            let is_exact = !pattern.contains(['*', '?']);
            chosen.extend(fits.map(|(place, _)| place));
            if chosen.len() == before {
                let known = places().map(|(_, column)| column.name.as_str());
                let near = nearest(pattern, known).filter(|_| is_exact);
                let why = near.map_or_else(
                    || {
                        "no column is called so (names are those of results.csv, without units)"
                            .into()
                    },
                    |near| format!("no column is called so (did you mean {near:?}?)"),
                );
                return Err(NoLinearSystem::Question(format!(
                    "output {pattern:?}: {why}"
                )));
            }
        }
        if patterns.is_empty() {
            let find = |channel: &Channel| {
                let mut all = places();
                all.find(|(_, column)| column.channel == Some(*channel))
            };
            chosen.extend(otherwise.iter().filter_map(find).map(|(place, _)| place));
        }
        let mut seen = Vec::with_capacity(chosen.len());
        chosen.retain(|place| {
            let is_new = !seen.contains(place);
            seen.push(*place);
            is_new
        });
        Ok(OutputColumns {
            system,
            channels,
            derived,
            chosen,
            headings,
            row: Vec::new(),
        })
    }

    /// Their headings.
    pub fn headings(&self) -> impl Iterator<Item = &Column> {
        self.chosen.iter().map(|place| &self.headings[*place])
    }

    /// Appends their values in a sample, at whose position and velocity the evaluation is.
    pub fn read(
        &mut self,
        system: &System,
        evaluation: &Evaluation,
        inputs: &Inputs,
        sample: &Sample,
        to: &mut Vec<f64>,
    ) {
        self.row.clear();
        self.channels
            .push_row(system, evaluation, inputs, sample, &mut self.row);
        // Those that follow from others are only read where one is wanted.
        let own = self.row.len();
        if self.chosen.iter().any(|place| *place >= own) {
            let row = self.row.clone();
            let numbers = system.inputs.len();
            self.derived.give(&inputs.states[..numbers]);
            self.derived.push(&row, &mut self.row);
        }
        to.extend(self.chosen.iter().map(|place| self.row[*place]));
    }

    /// The mechanism whose columns they are.
    pub fn system(&self) -> &'s System {
        self.system
    }
}
