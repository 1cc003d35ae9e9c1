//! Which rows hold each other where a mechanism is nearly singular.

use super::Reduced;

/// Part, relative to the largest, from which a row belongs to a near self-stress.
const STRAINED: f64 = 0.1;
/// Inverse iterations for that self-stress: near a singular position one is enough, three are safe.
const STRAIN_ITERATIONS: usize = 3;

impl Reduced<'_> {
    /// Rows (of joints and drivers) that take the largest part in what is nearest to a self-stress at the last accepted
    /// point; `None` if even that can't be factored.
    ///
    /// To look for them is no work of the run.
    pub fn strained_rows(&mut self) -> Vec<usize> {
        let done = self.driven.done;
        let rows = self.rows_near_self_stress();
        self.driven.done = done;
        rows
    }

    fn rows_near_self_stress(&mut self) -> Vec<usize> {
        let system = self.driven.system;
        if self.recall().is_err() {
            return Vec::new();
        }
        self.driven.evaluation.set_position(&self.accepted.here.q);
        if self.driven.factor(&self.inputs).is_err() {
            return Vec::new();
        }
        let n = system.n();
        let (mut right, mut left) = (vec![1.0; n], vec![1.0; n]);
        self.driven
            .smallest_singular(STRAIN_ITERATIONS, &mut right, &mut left);
        let largest = linkdyn_linear::math::max_abs(&left);
        let rows = self.driven.active_rows().iter().zip(&left);
        rows.filter(|(row, part)| **row < system.m() && part.abs() > STRAINED * largest)
            .map(|(row, _)| *row)
            .collect()
    }
}
