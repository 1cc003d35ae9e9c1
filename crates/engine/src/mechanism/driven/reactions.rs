//! Multipliers: from the transposed factors, of least norm where constraints are redundant, with the forces that depend on them.

use super::motions::TOGETHER;
use super::{Driven, Failure};
use crate::system::{Inputs, System};
use linkdyn_linear::math::{dot, max_abs};

impl Driven<'_> {
    /// Multipliers λ (m) with Jᵀ λ = `b` (n), of least norm where not unique; those of independent coordinates are left out (they vanish in
    /// free motion).
    pub fn multipliers(&mut self, b: &[f64], lambda: &mut [f64]) {
        self.multipliers_of(|room| room.copy_from_slice(b), lambda);
    }

    /// The same of a right-hand side (n) that is put where it is solved for.
    pub(crate) fn multipliers_of(&mut self, put: impl FnOnce(&mut [f64]), lambda: &mut [f64]) {
        let mut g = std::mem::take(&mut self.work);
        put(&mut g);
        self.solve_transposed(&mut g);
        lambda.fill(0.0);
        for (g, &row) in g.iter().zip(&self.selection.active) {
            if let Some(l) = lambda.get_mut(row) {
                *l = *g;
            }
        }
        self.work = g;
        if self.is_redundant() {
            let basis = self.self_stress();
            project_out(&basis, self.system, lambda);
        }
    }

    /// J⁻¹ (n × m) by rows: row k has the multipliers λ with Jᵀ λ = e_k, as [`Driven::multipliers`] gives them one by one.
    pub fn inverse(&mut self, inverse: &mut [f64]) {
        let (system, m) = (self.system, self.system.m().max(1));
        let mut columns = vec![[0.0; TOGETHER]; system.n()];
        for (some, rows) in self.selection.active.chunks(TOGETHER).enumerate() {
            columns.fill([0.0; TOGETHER]);
            let scales = self.row_scales.iter().enumerate();
            for (lane, (row, scale)) in scales.skip(some * TOGETHER).take(TOGETHER).enumerate() {
                columns[row][lane] = 1.0 / scale;
            }
            self.lu.solve_together(&mut columns);
            for (k, (own, x)) in inverse.chunks_exact_mut(m).zip(&columns).enumerate() {
                for (&row, x) in rows.iter().zip(x).filter(|(row, _)| **row < m) {
                    own[row] = x * system.column_scale(k);
                }
            }
        }
        if self.is_redundant() {
            let basis = self.self_stress();
            for own in inverse.chunks_exact_mut(m) {
                project_out(&basis, system, own);
            }
        }
    }

    /// Multipliers λ (m) of a fully driven mechanism with Jᵀ λ = `balance` (n), together with the forces that depend on
    /// them, which are added to `force` and `balance`; at the position and velocity last taken and its factors.
    ///
    /// # Errors
    /// [`Failure::Locked`]; λ is then without these forces.
    pub fn react(
        &mut self,
        inputs: &Inputs,
        force: &mut [f64],
        balance: &mut [f64],
        lambda: &mut [f64],
    ) -> Result<(), Failure> {
        self.multipliers(balance, lambda);
        if self.system.dependent_forces.is_empty() {
            return Ok(());
        }
        let mut dependent = std::mem::take(&mut self.dependent_forces);
        dependent.eval_units(self.system, &self.evaluation, inputs);
        for (unit, response) in dependent.units_and_responses() {
            self.multipliers(unit, response);
        }
        let solved = dependent.solve(self.system, &self.evaluation, inputs, lambda);
        if solved.is_ok() {
            dependent.add_forces(force);
            dependent.add_forces(balance);
            dependent.add_responses(lambda);
        }
        self.dependent_forces = dependent;
        solved
    }

    /// Overwrites b (n) with the g of J_Aᵀ g = b, unscaled.
    fn solve_transposed(&mut self, g: &mut [f64]) {
        self.system.scale_columns(g);
        self.lu.solve_transposed(g);
        g.iter_mut()
            .zip(self.row_scales.iter())
            .for_each(|(g, scale)| *g /= scale);
    }

    /// Basis of the self-stresses, {z (m): Jᵀ z = 0}, one vector per redundant row, at the last factors.
    pub fn self_stress(&mut self) -> Vec<Vec<f64>> {
        let (n, m) = (self.system.n(), self.system.m());
        let mut basis = Vec::with_capacity(self.selection.redundant.len());
        for k in 0..self.selection.redundant.len() {
            let row = self.selection.redundant[k];
            let mut z = vec![0.0; m];
            z[row] = 1.0;
            let mut g = vec![0.0; n];
            self.evaluation.transposed_product(self.system, &z, &mut g);
            self.solve_transposed(&mut g);
            for (g, &active) in g.iter().zip(&self.selection.active) {
                if let Some(z) = z.get_mut(active) {
                    *z = -g;
                }
            }
            basis.push(z);
        }
        basis
    }
}

/// Part of a self-stress below which it goes through no driver.
const UNDRIVEN: f64 = 1e-9;

/// λ minus its part in the span of `basis`, of least norm among all λ that differ by self-stresses: first of the drivers, by their
/// shares, Σ λ²/share, then of all.
fn project_out(basis: &[Vec<f64>], system: &System, lambda: &mut [f64]) {
    // Modified Gram–Schmidt, twice for orthogonality to round-off.
    let mut basis = basis.to_vec();
    let drivers = system.driver_rows();
    let of_drivers: Vec<f64> = drivers
        .clone()
        .zip(&system.drivers)
        .map(|(_, driver)| 1.0 / driver.share)
        .collect();
    let of_all = vec![1.0; lambda.len()];
    for (rows, weights) in [(drivers, of_drivers), (0..lambda.len(), of_all)] {
        let mut done: Vec<Vec<f64>> = Vec::with_capacity(basis.len());
        let mut left = Vec::new();
        let along = |e: &[f64], z: &[f64]| {
            let parts = e[rows.clone()].iter().zip(&z[rows.clone()]).zip(&weights);
            parts.map(|((e, z), weight)| weight * e * z).sum::<f64>()
        };
        for mut z in basis {
            let before = dot(&z, &z).sqrt();
            for _ in 0..2 {
                for e in &done {
                    let along = along(e, &z);
                    z.iter_mut().zip(e).for_each(|(z, e)| *z -= along * e);
                }
            }
            let norm = along(&z, &z).sqrt();
            if norm > UNDRIVEN * before && max_abs(&z).is_finite() {
                z.iter_mut().for_each(|z| *z /= norm);
                done.push(z);
            } else {
                left.push(z);
            }
        }
        for _ in 0..2 {
            for e in &done {
                let along = along(e, lambda);
                lambda.iter_mut().zip(e).for_each(|(l, e)| *l -= along * e);
            }
        }
        basis = left;
    }
}
