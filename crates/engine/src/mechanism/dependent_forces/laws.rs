//! Laws of the forces that depend on multipliers, at one instant.

use crate::system::{Evaluation, Inputs, System};
use std::ops::Range;

/// The laws at one instant: sizes by the multipliers of their rows.
pub(super) trait Laws {
    /// Rows of the multipliers.
    fn rows(&self, force: usize) -> Range<usize>;
    /// Size at these multipliers, with its derivatives by them.
    fn size(&self, force: usize, lambda: &[f64], slope: &mut [f64]) -> f64;
    /// Whether all sizes are proportional to the multipliers.
    fn are_straight(&self) -> bool;
}

/// Those of a system.
pub(super) struct Here<'a> {
    pub system: &'a System,
    pub evaluation: &'a Evaluation,
    pub inputs: &'a Inputs,
}

impl Laws for Here<'_> {
    fn rows(&self, force: usize) -> Range<usize> {
        let block = &self.system.blocks[self.system.dependent_forces[force].block];
        block.rows()
    }

    fn size(&self, force: usize, lambda: &[f64], slope: &mut [f64]) -> f64 {
        let at = self.evaluation.kinematics(self.inputs);
        self.system.dependent_forces[force].force.size(
            &at,
            self.inputs.memories[force],
            lambda,
            slope,
        )
    }

    fn are_straight(&self) -> bool {
        let mut forces = self.system.dependent_forces.iter();
        forces.all(|dependent| dependent.force.is_straight())
    }
}
