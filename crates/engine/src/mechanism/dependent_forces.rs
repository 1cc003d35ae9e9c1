//! Forces that depend on the multipliers, which depend on them: friction of ideal joints.
//!
//! At one instant and state all else is linear, so that with T_j the size of force j in its direction g_j
//!
//! ```text
//! λ = λ⁰ + Σ Λ_j T_j            λ⁰ without these forces, Λ_j from g_j alone     (m)
//! T_i = s_i(λ)                  the laws, at most 3 multipliers each            (k)
//! ```
//!
//! and only T (k) is unknown: Newton's iteration, with the step of the plain fixed point T ← s(λ) where Newton's does not
//! bring the residual down. With B_ij = |∂s_i/∂λ| |Λ_j| (rows of i) the fixed point contracts where the spectral radius of B
//! is below one; then the solution is the only one. Elsewhere there may be several or none (Painlevé 1895): the one that is
//! meant goes on from the mechanism without friction, and is followed from there as the laws' sizes grow from 0 to 1, with
//! det(I − ∂s/∂λ Λ) > 0 all the way. Where it ends before 1, the mechanism locks itself.

mod laws;

use super::failure::Failure;
use crate::element::Applied;
use crate::system::{Evaluation, Inputs, System};
use laws::{Here, Laws};
use linkdyn_linear::math::dot;
use linkdyn_linear::small::{SmallLu, leading_minors_are_positive};

/// Rows of the largest block.
const ROWS: usize = 3;
/// Residual, in parts of the terms in it, at which the iteration ends, and the one that is good enough where it stalls.
const ROUND_OFF: f64 = 1e-14;
const STALLED: f64 = 1e-12;
/// Iterations of one solution.
const MOST: usize = 60;
/// Longest and shortest step by which the laws' sizes grow.
const STEP: f64 = 0.125;
const SHORTEST: f64 = 1e-5;

/// The forces' directions, what they do, and their sizes.
#[derive(Debug, Clone, Default)]
pub struct DependentForces {
    /// (k, n), (k, m), (k, n)
    units: Vec<f64>,
    responses: Vec<f64>,
    changes: Vec<f64>,
    n: usize,
    m: usize,
    /// λ without these forces (m), for who has no place of his own.
    pub(super) free: Vec<f64>,
    /// T (k) [N or N·m].
    sizes: Vec<f64>,
    /// T at the last part of the laws that was solved, and before Newton's last step (k).
    kept: Vec<f64>,
    before: Vec<f64>,
    residual: Vec<f64>,
    /// ∂s/∂λ (k, 3).
    slopes: Vec<f64>,
    /// I − ∂s/∂λ Λ, its factors, and I − B (k, k).
    matrix: Vec<f64>,
    lu: SmallLu,
    work: Vec<f64>,
    /// The force that could not be found last time.
    locked: Option<usize>,
    margin: f64,
}

impl DependentForces {
    /// Room for those of a system.
    pub fn new(system: &System) -> Self {
        let (k, n, m) = (system.dependent_forces.len(), system.n(), system.m());
        // Nothing is kept for nothing.
        let cells = |count: usize| vec![0.0; k * count];
        DependentForces {
            units: cells(n),
            responses: cells(m),
            changes: cells(n),
            n,
            m,
            free: if k > 0 { vec![0.0; m] } else { Vec::new() },
            sizes: cells(1),
            kept: cells(1),
            before: cells(1),
            residual: cells(1),
            slopes: cells(ROWS),
            matrix: cells(k),
            lu: SmallLu::new(k),
            work: cells(k),
            locked: None,
            margin: 1.0,
        }
    }

    /// T (k) [N or N·m] of the last solution.
    pub fn sizes(&self) -> &[f64] {
        &self.sizes
    }

    /// Sizes found otherwise, as limits.
    pub fn set_sizes(&mut self, sizes: &[f64]) {
        self.sizes.copy_from_slice(sizes);
    }

    /// The force that had no finite size at the last solution.
    pub fn locked(&self) -> Option<usize> {
        self.locked
    }

    /// det(I − ∂s/∂λ Λ) of the last solution: 1 without friction, 0 where the mechanism locks itself.
    pub fn margin(&self) -> f64 {
        self.margin
    }

    /// The force that feeds on itself most.
    pub fn tightest(&self) -> usize {
        let k = self.sizes.len();
        (0..k)
            .min_by(|&a, &b| self.matrix[a * k + a].total_cmp(&self.matrix[b * k + b]))
            .unwrap_or(0)
    }

    /// Power of all of them at velocities `v` (n) \[W\].
    pub fn power(&self, v: &[f64]) -> f64 {
        self.units
            .chunks_exact(self.n.max(1))
            .zip(&self.sizes)
            .map(|(unit, size)| size * dot(unit, v))
            .sum()
    }

    /// g_j at the position and velocity that `evaluation` has taken.
    pub fn eval_units(&mut self, system: &System, evaluation: &Evaluation, inputs: &Inputs) {
        let at = evaluation.kinematics(inputs);
        self.units.fill(0.0);
        for (unit, dependent) in self
            .units
            .chunks_exact_mut(self.n.max(1))
            .zip(&system.dependent_forces)
        {
            dependent
                .force
                .apply_unit(&at, &mut Applied::to(unit, &system.layout));
        }
    }

    /// g_j, and where Λ_j goes.
    pub(super) fn units_and_responses(&mut self) -> impl Iterator<Item = (&[f64], &mut [f64])> {
        self.units
            .chunks_exact(self.n.max(1))
            .zip(self.responses.chunks_exact_mut(self.m.max(1)))
    }

    /// g_j, and where Λ_j and the accelerations of g_j go.
    pub(super) fn units_responses_and_changes(
        &mut self,
    ) -> impl Iterator<Item = ((&[f64], &mut [f64]), &mut [f64])> {
        let responses = self.responses.chunks_exact_mut(self.m.max(1));
        let changes = self.changes.chunks_exact_mut(self.n.max(1));
        self.units
            .chunks_exact(self.n.max(1))
            .zip(responses)
            .zip(changes)
    }

    pub(super) fn sizes_and_changes(&self) -> impl Iterator<Item = (f64, &[f64])> {
        self.sizes
            .iter()
            .copied()
            .zip(self.changes.chunks_exact(self.n.max(1)))
    }

    /// Adds Σ T_j g_j.
    pub fn add_forces(&self, force: &mut [f64]) {
        add(&self.units, self.n, &self.sizes, force);
    }

    /// Adds Σ T_j Λ_j.
    pub(super) fn add_responses(&self, lambda: &mut [f64]) {
        add(&self.responses, self.m, &self.sizes, lambda);
    }

    /// T, from λ⁰ (m), the units and their responses.
    ///
    /// # Errors
    /// [`Failure::Locked`]; [`Failure::Singular`] where λ⁰ or Λ are not finite. The sizes are then NaN.
    pub(super) fn solve(
        &mut self,
        system: &System,
        evaluation: &Evaluation,
        inputs: &Inputs,
        free: &[f64],
    ) -> Result<(), Failure> {
        let finite = free.iter().chain(&self.responses).all(|x| x.is_finite());
        let found = if finite {
            self.find(
                free,
                &Here {
                    system,
                    evaluation,
                    inputs,
                },
            )
        } else {
            Err(Failure::Singular)
        };
        if found.is_err() {
            self.sizes.fill(f64::NAN);
        }
        found
    }

    /// T for these laws.
    fn find(&mut self, free: &[f64], laws: &impl Laws) -> Result<(), Failure> {
        self.locked = None;
        self.sizes.fill(0.0);
        // Sizes are convex in λ, so a single one has no second solution with a positive determinant.
        if self.iterate(free, laws, 1.0) && self.margin > 0.0 {
            if self.sizes.len() == 1 || self.contracts(laws) {
                return Ok(());
            }
            // Of straight laws this is the one solution, and only the determinant has to be followed.
            if laws.are_straight() {
                return self.follow(|forces, part| forces.determinant(laws, part) > 0.0);
            }
        }
        self.kept.fill(0.0);
        self.follow(|forces, part| {
            forces.sizes.copy_from_slice(&forces.kept);
            let is_found = forces.iterate(free, laws, part) && forces.margin > 0.0;
            if is_found {
                forces.kept.copy_from_slice(&forces.sizes);
            }
            is_found
        })
    }

    /// Goes from no forces to the whole of them, by parts at which there is a solution.
    fn follow(&mut self, mut is_there: impl FnMut(&mut Self, f64) -> bool) -> Result<(), Failure> {
        let (mut part, mut step) = (0.0, STEP);
        while part < 1.0 {
            let next = f64::min(part + step, 1.0);
            if is_there(self, next) {
                part = next;
                step = f64::min(2.0 * step, STEP);
            } else {
                step *= 0.5;
            }
            if step < SHORTEST {
                let force = self.tightest();
                self.locked = Some(force);
                return Err(Failure::Locked { force });
            }
        }
        Ok(())
    }

    /// det(I − part · ∂s/∂λ Λ) with the slopes at hand, which is the margin then.
    fn determinant(&mut self, laws: &impl Laws, part: f64) -> f64 {
        self.eval_matrix(laws, part);
        self.factor();
        self.margin = self.lu.determinant();
        self.margin
    }

    /// Solves T = part · s(λ) from the sizes at hand; whether that was possible.
    fn iterate(&mut self, free: &[f64], laws: &impl Laws, part: f64) -> bool {
        let mut worst = self.eval_residual(free, laws, part);
        // Straight laws have one matrix.
        let (is_straight, mut is_regular) = (laws.are_straight(), None);
        for _ in 0..MOST {
            if is_regular.is_none() {
                self.eval_matrix(laws, part);
            }
            if worst <= ROUND_OFF || !worst.is_finite() {
                break;
            }
            self.before.copy_from_slice(&self.sizes);
            let plain = |sizes: &mut [f64], residual: &[f64]| {
                sizes.iter_mut().zip(residual).for_each(|(t, r)| *t -= r)
            };
            // The step of the plain fixed point, in case Newton's is none.
            plain(&mut self.before, &self.residual);
            let regular = is_regular.unwrap_or_else(|| self.factor());
            is_regular = is_straight.then_some(regular);
            if regular {
                self.lu.solve(&mut self.residual);
                plain(&mut self.sizes, &self.residual);
                let reached = self.eval_residual(free, laws, part);
                if reached < worst {
                    worst = reached;
                    continue;
                }
            }
            if worst <= STALLED {
                self.sizes.copy_from_slice(&self.before);
                worst = self.eval_residual(free, laws, part);
                self.eval_matrix(laws, part);
                break;
            }
            self.sizes.copy_from_slice(&self.before);
            worst = self.eval_residual(free, laws, part);
        }
        if is_regular.is_none() {
            self.factor();
        }
        self.margin = self.lu.determinant();
        worst <= STALLED
    }

    /// T − part · s(λ), and ∂s/∂λ; returns the largest residual, in parts of its terms.
    fn eval_residual(&mut self, free: &[f64], laws: &impl Laws, part: f64) -> f64 {
        let m = self.m;
        let mut worst: f64 = 0.0;
        for i in 0..self.sizes.len() {
            let rows = laws.rows(i);
            let (mut lambda, mut terms, mut slope) = ([0.0; ROWS], [0.0; ROWS], [0.0; ROWS]);
            let count = rows.len();
            for (r, row) in rows.enumerate() {
                (lambda[r], terms[r]) = (free[row], free[row].abs());
                for (response, size) in self.responses.chunks_exact(m).zip(&self.sizes) {
                    lambda[r] += response[row] * size;
                    terms[r] += (response[row] * size).abs();
                }
            }
            let size = part * laws.size(i, &lambda[..count], &mut slope[..count]);
            let residual = self.sizes[i] - size;
            let whole = self.sizes[i].abs()
                + slope
                    .iter()
                    .zip(terms)
                    .map(|(s, t)| (part * s).abs() * t)
                    .sum::<f64>();
            if residual != 0.0 {
                // f64::max would swallow what is no number
                let ratio = residual.abs() / whole;
                worst = if ratio > worst || ratio.is_nan() {
                    ratio
                } else {
                    worst
                };
            }
            self.residual[i] = residual;
            self.slopes[i * ROWS..(i + 1) * ROWS].copy_from_slice(&slope);
        }
        worst
    }

    /// I − part · ∂s/∂λ Λ.
    fn eval_matrix(&mut self, laws: &impl Laws, part: f64) {
        let (k, m) = (self.sizes.len(), self.m);
        for i in 0..k {
            let slope = &self.slopes[i * ROWS..(i + 1) * ROWS];
            for (j, response) in self.responses.chunks_exact(m).enumerate() {
                let own = if i == j { 1.0 } else { 0.0 };
                self.matrix[i * k + j] = own - part * dot(slope, &response[laws.rows(i)]);
            }
        }
    }

    /// Whether the spectral radius of B is below one: I − B has positive pivots only.
    fn contracts(&mut self, laws: &impl Laws) -> bool {
        let (k, m) = (self.sizes.len(), self.m);
        let norm = |part: &[f64]| dot(part, part).sqrt();
        for i in 0..k {
            let slope = norm(&self.slopes[i * ROWS..(i + 1) * ROWS]);
            for (j, response) in self.responses.chunks_exact(m).enumerate() {
                let own = if i == j { 1.0 } else { 0.0 };
                self.work[i * k + j] = own - slope * norm(&response[laws.rows(i)]);
            }
        }
        leading_minors_are_positive(&mut self.work, k)
    }

    /// Factors the matrix; whether it is regular.
    fn factor(&mut self) -> bool {
        self.lu.values().copy_from_slice(&self.matrix);
        self.lu.factor()
    }
}

/// sum += Σ x_j v_j, the v_j of length `n` one after the other.
fn add(vectors: &[f64], n: usize, x: &[f64], sum: &mut [f64]) {
    for (vector, x) in vectors.chunks_exact(n.max(1)).zip(x) {
        sum.iter_mut()
            .zip(vector)
            .for_each(|(sum, v)| *sum += x * v);
    }
}

#[cfg(test)]
mod tests;
