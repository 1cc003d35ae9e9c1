//! What `compare` has found.

use super::ladder::Rung;
use crate::cli::open::Opened;
use linkdyn_engine::analysis::Outcome;
use linkdyn_output::comparison::Comparison;
use linkdyn_output::{Column, Extremes, Trajectory};

/// Everything there is to tell.
pub struct Report<'a> {
    /// The model.
    pub opened: &'a Opened,
    /// Joints whose clearance model changes.
    pub joints: &'a [String],
    /// The runs.
    pub rungs: &'a [Rung],
    /// Whether the models were asked for by name.
    pub wanted: bool,
    /// How far they are apart.
    pub comparison: &'a Comparison,
    /// Of each model that ran: its outputs and peaks.
    pub curves: &'a [(&'static str, Trajectory)],
}

impl Report<'_> {
    /// Smallest and largest value of a column by model, peaks between the outputs included.
    pub fn extremes(
        &self,
        column: &Column,
    ) -> impl Iterator<Item = (&'static str, Option<Extremes>)> {
        self.curves.iter().map(|(model, table)| {
            let extremes = table.id_of(column).and_then(|id| table.extremes_of(id));
            (*model, extremes)
        })
    }

    /// The model that the others are compared with.
    pub fn reference(&self) -> Option<&'static str> {
        self.rungs
            .iter()
            .find(|rung| rung.ran.is_ok())
            .map(|rung| rung.model)
    }

    /// Word for a model that can't be run.
    pub fn refusal(&self) -> &'static str {
        if self.wanted { "refused" } else { "skipped" }
    }

    /// Contacts of the joints, where the model has any.
    pub fn contacts(&self, outcome: &Outcome) -> Option<u64> {
        let counted = outcome
            .report
            .clearances
            .iter()
            .filter(|sums| self.joints.contains(&sums.joint));
        counted.map(|sums| sums.episodes).reduce(|a, b| a + b)
    }
}

/// CPU of assembly and solution \[s\].
pub fn cpu(outcome: &Outcome) -> f64 {
    outcome.report.assemble.cpu + outcome.report.solve.cpu
}
