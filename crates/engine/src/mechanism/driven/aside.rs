//! A solver without its mechanism, for another one of the same structure.

use super::{Driven, Independent, Scales, Selection, Work};
use crate::mechanism::dependent_forces::DependentForces;
use crate::system::{Evaluation, System};
use linkdyn_linear::lu::SparseLu;

/// What a [`Driven`] works with: independent rows, pattern, order and pivots of its factors, and room.
#[derive(Clone)]
pub struct Aside {
    evaluation: Evaluation,
    independent: Vec<Independent>,
    selection: Selection,
    row_scales: Scales,
    slots: Vec<u32>,
    scales: Scales,
    values: Vec<f64>,
    nnz: usize,
    lu: SparseLu,
    work: Vec<f64>,
    spare: Vec<f64>,
    rows: Vec<f64>,
    measures_residual: bool,
    last_step: f64,
    dependent_forces: DependentForces,
}

impl<'s> Driven<'s> {
    /// Leaves the mechanism.
    pub(crate) fn set_aside(self) -> Aside {
        Aside {
            evaluation: self.evaluation,
            independent: self.independent,
            selection: self.selection,
            row_scales: self.row_scales,
            slots: self.slots,
            scales: self.scales,
            values: self.values,
            nnz: self.nnz,
            lu: self.lu,
            work: self.work,
            spare: self.spare,
            rows: self.rows,
            measures_residual: self.measures_residual,
            last_step: self.last_step,
            dependent_forces: self.dependent_forces,
        }
    }

    /// Takes up a mechanism with the same bodies, joints and drivers as the one that was left, and other numbers.
    pub(crate) fn take_up(system: &'s System, aside: Aside) -> Self {
        let mut driven = Driven {
            system,
            evaluation: aside.evaluation,
            independent: aside.independent,
            selection: aside.selection,
            revision: 0,
            row_scales: aside.row_scales,
            slots: aside.slots,
            scales: aside.scales,
            values: aside.values,
            nnz: aside.nnz,
            lu: aside.lu,
            work: aside.work,
            spare: aside.spare,
            rows: aside.rows,
            together: Vec::new(),
            measures_residual: aside.measures_residual,
            last_step: aside.last_step,
            chord: 0.0,
            done: Work::default(),
            dependent_forces: aside.dependent_forces,
        };
        driven.scale_entries();
        driven.scale_rows();
        driven
    }
}

impl Aside {
    /// How often pivots were chosen anew.
    pub(crate) fn pivots_chosen_anew(&self) -> usize {
        self.lu.fallbacks()
    }

    /// Slots of the entries of J, and its factors; `None` where rows are redundant or coordinates are prescribed.
    pub(crate) fn factors(&self) -> Option<(&[u32], &SparseLu)> {
        let is_plain = self.selection.redundant.is_empty() && self.independent.is_empty();
        is_plain.then_some((&self.slots[..], &self.lu))
    }

    /// Takes the order and the pivots of another one of the same mechanism.
    pub(crate) fn restore(&mut self, other: &Aside) {
        self.lu.clone_from(&other.lu);
    }
}
