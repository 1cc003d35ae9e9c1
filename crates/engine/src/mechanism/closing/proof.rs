//! Whether the position found is the one that the guess moves to, by the theorem of Newton and Kantorovich.
//!
//! ```text
//! h = β L η ≤ ½      β = |J̃⁺|,  L: Lipschitz constant of J̃,  η = |J̃⁺ φ̃|     all at the guess, Euclidean norms
//! ```
//!
//! Then J̃ keeps its rank in the ball of radius 2 η about the guess, and closing the joints first (φ̃ of the joints), then moving
//! drivers and initial values to what is asked (φ̃ of these), goes on one way within it: η is the sum of both (Ortega and
//! Rheinboldt, Iterative Solution of Nonlinear Equations in Several Variables, 1970, 12.6).
//!
//! β comes from inverse iterations, and L from the second derivatives at the guess: of pins these are arms, which do not change. Half of
//! what the theorem allows is left for what changes.

use super::{LEAST_DAMPING, Search};
use crate::system::Origin;
use linkdyn_linear::math::dot;

/// Largest h, and largest β L r with the distance r of the position found.
const PROVES: f64 = 0.25;
const WITHIN: f64 = 0.5;
/// β above which damping hides that J̃ loses its rank.
const MOST_INVERSE: f64 = 1e4;
/// Inverse iterations for the smallest singular value.
const ITERATIONS: usize = 6;
/// Residual of drivers and initial values below which they are where they are drawn, scaled \[–\].
const STILL: f64 = 1e-12;

impl Search<'_> {
    /// β L of a guess near enough to prove what Newton finds; `None` if it does not.
    pub(super) fn proof(&mut self) -> Option<f64> {
        let values = self.part(|origin| matches!(origin, Origin::Driver(_) | Origin::Initial(_)));
        if dot(&values, &values).sqrt() <= STILL {
            return Some(0.0);
        }
        // Of a cam the second derivatives change from piece to piece.
        if self.system.cams().next().is_some() {
            return None;
        }
        if !self.factor(LEAST_DAMPING) {
            return None;
        }
        let n = self.q.len();
        let joints = self.part(|origin| matches!(origin, Origin::Joint(_) | Origin::Stop(_)));
        let eta: f64 = [joints, values]
            .into_iter()
            .map(|phi| {
                let step = &self.solve(&phi)[..n];
                dot(step, step).sqrt()
            })
            .sum();
        let certainty = self.inverse_norm() * self.lipschitz();
        (certainty * eta <= PROVES).then_some(certainty)
    }

    /// Whether one position, and one alone, closes near this one: h with all rows, where J̃ is far from losing rank.
    pub(super) fn certifies(&mut self) -> bool {
        if !self.factor(LEAST_DAMPING) {
            return false;
        }
        let beta = self.inverse_norm();
        let phi = self.phi.clone();
        let n = self.q.len();
        let step = &self.solve(&phi)[..n];
        let eta = dot(step, step).sqrt();
        beta <= MOST_INVERSE && beta * self.lipschitz() * eta <= PROVES
    }

    /// Whether the position found is near enough to a guess that proves it.
    pub(super) fn is_within(&self, certainty: f64, guess: &[f64]) -> bool {
        let moved = self.q.iter().zip(guess).enumerate();
        let moved = moved.map(|(k, (q, guess))| (q - guess) / self.system.column_scale(k));
        certainty * moved.map(|d| d * d).sum::<f64>().sqrt() <= WITHIN
    }

    /// φ̃ of some blocks, zero elsewhere (m).
    fn part(&self, takes: impl Fn(&Origin) -> bool) -> Vec<f64> {
        let mut phi = vec![0.0; self.rows.m];
        for (block, &start) in self.rows.blocks.iter().zip(&self.rows.starts) {
            if takes(&block.origin) {
                let rows = start..start + block.rows().len();
                phi[rows.clone()].copy_from_slice(&self.phi[rows]);
            }
        }
        phi
    }

    /// Both parts (n + m) of the solution with `rows` (m) at the last factors.
    fn solve(&mut self, rows: &[f64]) -> Vec<f64> {
        let mut x = vec![0.0; self.q.len() + rows.len()];
        x[self.q.len()..].copy_from_slice(rows);
        self.lu.solve(&mut x);
        x
    }

    /// β at the last factors: 1/σ² is the largest eigenvalue of (J̃ J̃ᵀ)⁻¹.
    fn inverse_norm(&mut self) -> f64 {
        let (n, m) = (self.q.len(), self.rows.m);
        // Multiples of the golden ratio are square to no singular vector.
        let mut y: Vec<f64> = (0..m)
            .map(|k| 0.2 + (0.618_033_988_749_895 * (k + 1) as f64).fract())
            .collect();
        let mut growth = 0.0;
        for _ in 0..ITERATIONS {
            let length = dot(&y, &y).sqrt();
            y.iter_mut().for_each(|y| *y /= length);
            y = self.solve(&y).split_off(n);
            growth = dot(&y, &y).sqrt();
        }
        growth.sqrt()
    }

    /// L, by the second derivatives of all rows.
    fn lipschitz(&self) -> f64 {
        let at = self.evaluation.kinematics(self.inputs);
        let mut sum = 0.0;
        for block in self.rows.blocks {
            let bends = block.constraint.curvature_pattern();
            let mut values = vec![0.0; bends.len()];
            for (row, measure) in block.constraint.rows().iter().enumerate() {
                let mut lambda = [0.0; 4];
                lambda[row] = 1.0 / self.system.measure_scale(*measure);
                let lambda = &lambda[..block.constraint.rows().len()];
                values.fill(0.0);
                block.constraint.bend(&at, lambda, &mut values);
                for (value, [a, b]) in values.iter().zip(&bends) {
                    let scale = self.system.axis_scale(a.1) * self.system.axis_scale(b.1);
                    let times = if a == b { 1.0 } else { 2.0 };
                    sum += times * (value * scale).powi(2);
                }
            }
        }
        sum.sqrt()
    }
}
