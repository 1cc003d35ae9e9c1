//! J, its factors, and what they tell.

use super::{Driven, Failure};
use crate::mechanism::abreast::Abreast;
use crate::system::{Inputs, Standing};

impl Driven<'_> {
    pub(super) fn scatter(&mut self) {
        for ((&slot, scale), &value) in self
            .slots
            .iter()
            .zip(self.scales.iter())
            .zip(&self.evaluation.jacobian)
        {
            self.values[slot as usize] = value * scale;
        }
    }

    /// J, by the scales of its columns and rows.
    pub(in crate::mechanism) fn scaled_entries(&self) -> impl Iterator<Item = f64> {
        let entries = self.evaluation.jacobian.iter().zip(self.scales());
        entries.map(|(value, scale)| value * scale)
    }

    /// Several of this mechanism side by side; `None` where rows are redundant or coordinates are prescribed.
    pub(crate) fn abreast(&self) -> Option<Abreast> {
        let is_plain = !self.is_redundant() && self.independent.is_empty();
        is_plain
            .then(|| Abreast::new(self.system, (&self.slots, &self.lu)))
            .flatten()
    }

    /// What the active rows hold, by J at a position that satisfies them.
    pub(in crate::mechanism) fn standing(&self) -> Standing {
        let scaled: Vec<f64> = self.scaled_entries().collect();
        Standing::of(self.system, self.active_rows(), &scaled)
    }

    /// J and its factors at the position last taken.
    ///
    /// # Errors
    /// [`Failure::Singular`].
    pub fn factor(&mut self, inputs: &Inputs) -> Result<(), Failure> {
        self.evaluation.eval_jacobian(self.system, inputs);
        self.scatter();
        self.done.factorisations += 1;
        Ok(self.lu.refactor(&self.values[..self.nnz])?)
    }

    /// The same where J is another one than that of the factors: of a chain whose angles are given it does not depend on what a
    /// correction moves.
    ///
    /// # Errors
    /// [`Failure::Singular`].
    pub fn refresh(&mut self, inputs: &Inputs) -> Result<(), Failure> {
        self.evaluation.eval_jacobian(self.system, inputs);
        if self.lu.is_factored() && self.is_current() {
            return Ok(());
        }
        self.scatter();
        self.done.factorisations += 1;
        Ok(self.lu.refactor(&self.values[..self.nnz])?)
    }

    /// Whether J is what was scattered last.
    fn is_current(&self) -> bool {
        let entries = self.slots.iter().zip(self.scales.iter());
        let mut entries = entries.zip(&self.evaluation.jacobian);
        entries.all(|((&slot, scale), value)| {
            let slot = slot as usize;
            slot == self.nnz || self.values[slot] == value * scale
        })
    }

    /// x = S_q J̃_A⁻¹ S_φ⁻¹ rhs, where `rhs` is in `self.rows`; the result goes to `x`.
    pub(super) fn solve_rows(&mut self, x: &mut [f64]) {
        self.scaled_rows(x);
        self.lu.solve(x);
        self.system.scale_columns(x);
    }

    /// S_φ⁻¹ of the right-hand side.
    pub(super) fn scaled_rows(&self, x: &mut [f64]) {
        for ((w, &row), scale) in x
            .iter_mut()
            .zip(&self.selection.active)
            .zip(self.row_scales.iter())
        {
            *w = self.rows[row] / scale;
        }
    }

    /// Sign of det J̃_A at the last factors.
    pub fn determinant_sign(&self) -> f64 {
        self.lu.determinant_sign()
    }

    /// The smallest singular value with its right (n) and left (n, by active row) vectors at the last factors, by inverse
    /// iterations from the vectors given.
    pub fn smallest_singular(
        &mut self,
        iterations: usize,
        right: &mut [f64],
        left: &mut [f64],
    ) -> f64 {
        self.lu.smallest_singular(iterations, right, left)
    }

    /// 1 / (rightᵀ J̃_A⁻¹ left): a smooth function of the position that vanishes where J does (Griewank and Reddien 1984).
    pub fn test_function(&mut self, right: &[f64], left: &[f64]) -> f64 {
        self.work.copy_from_slice(left);
        self.lu.solve(&mut self.work);
        1.0 / linkdyn_linear::math::dot(right, &self.work)
    }
}
