//! Whether a position where constraints are redundant is singular: by the second order.
//!
//! ```text
//! Jᵀ z = 0            self-stresses z (m)
//! J s = 0             motions s (n) that the constraints allow at first order, drivers at rest
//! zᵀ γ(s, s) = 0      for all z, where an acceleration J a = γ goes on with s
//! ```
//!
//! Where rows depend on each other in all positions around, as those of a doubled joint, every s is the velocity of a motion
//! and has an acceleration. Where only this position makes them dependent, some s have none: from a flat parallelogram two
//! motions lead away, and their sums are none. The converse misses singular positions whose second order vanishes altogether.
//! (Connelly and Whiteley 1996, second-order rigidity.)

use super::Driven;
use crate::math::{dot, max_abs};
use crate::system::Inputs;

/// |zᵀγ| of unit self-stress and motion (lengths by the mechanism's size, largest component 1) above which it is no
/// round-off [-]: that is below 1e-9 where the smallest singular value is above 1e-6.
const BENT: f64 = 1e-6;

impl Driven<'_> {
    /// Whether more than one motion leads away from the position of the last factors; `motions` (f × n) are those of the
    /// pins. The velocity taken is zero afterwards.
    pub fn is_bifurcation(&mut self, motions: &[f64], inputs: &Inputs) -> bool {
        if !self.is_redundant() {
            return false;
        }
        let (system, n) = (self.system, self.system.n());
        let mut stresses = self.self_stress();
        for z in &mut stresses {
            let largest =
                z.iter().enumerate().fold(0.0, |most: f64, (row, z)| most.max(z.abs() * system.row_scale(row)));
            z.iter_mut().for_each(|z| *z /= largest);
        }
        let mut still = inputs.clone();
        still.drive.iter_mut().for_each(|jet| jet[1..].fill(0.0));
        still.offset.iter_mut().for_each(|jet| jet[1..].fill(Default::default()));
        let motions: Vec<Vec<f64>> = motions.chunks_exact(n.max(1)).map(|s| unit(s, system.scaled_norm(s))).collect();
        let mut gamma = vec![0.0; system.m()];
        let mut bent = false;
        for (i, first) in motions.iter().enumerate() {
            for second in &motions[i..] {
                let sum: Vec<f64> = first.iter().zip(second).map(|(a, b)| 0.5 * (a + b)).collect();
                self.evaluation.set_velocity(&sum);
                self.evaluation.eval_gamma(system, &still, &mut gamma);
                bent |= stresses.iter().any(|z| dot(z, &gamma).abs() > BENT);
            }
        }
        gamma.resize(n, 0.0);
        gamma.fill(0.0);
        self.evaluation.set_velocity(&gamma);
        bent
    }
}

/// A motion with its largest component, or all of it where that is zero, at 1.
fn unit(s: &[f64], size: f64) -> Vec<f64> {
    if max_abs(s) == 0.0 { s.to_vec() } else { s.iter().map(|s| s / size).collect() }
}
