//! The worst that can be found: where the output is stationary under all deviations that are allowed.
//!
//! ```text
//! φ(q) + e = 0,   e_i = argmax g_i·e_i,   g = −λ,   J(q)ᵀ λ = ∂y(q)
//! ```
//!
//! Each pin is at its rim where the unit load on the output presses it at the displaced position; so all are massless links
//! under that load. With the factors of the nominal position, q and λ are corrected together until the output stands still.
//! A stationary output is no proof; see `enclosure` for one.

use super::displaced::{Mechanism, Stand};
use super::output::{Load, Output};

/// Most corrections.
const MOST_PASSES: usize = 60;
/// Corrections that shrink less than this are left to [`super::reach`].
const SLOW: f64 = 0.5;
/// Corrections below this, in radians or sizes, that shrink no more are round-off.
const STALLED: f64 = 1e-11;
/// The output stands still when it moves by less than this part of its deviation …
const STILL: f64 = 1e-14;
/// … or by this part of the mechanism's size (or of a radian): round-off.
const ROUND_OFF: f64 = 2e-16;

/// Where the output is carried farthest.
#[derive(Debug, Clone)]
pub(super) struct Farthest {
    /// Deviation of the output [rad or m].
    pub deviation: f64,
    /// Coordinates there (n).
    pub q: Vec<f64>,
    /// On the way there: deviations with the share of the sources that each needs; empty where they were not followed.
    pub needed: Vec<[f64; 2]>,
}

impl Mechanism<'_> {
    /// λ = J⁻ᵀ ∂y at a pose, whose factors are kept; none where J has no inverse there.
    pub fn load(&mut self, stand: &Stand, output: &Output) -> Option<Load> {
        let (n, m) = (self.driven.system.n(), self.driven.system.m());
        self.take(&stand.q, stand);
        self.driven.factor(&stand.inputs).ok()?;
        let mut gradient = vec![0.0; n];
        self.gradient(stand, output, &mut gradient);
        let mut lambda = vec![0.0; m];
        self.driven.multipliers(&gradient, &mut lambda);
        lambda
            .iter()
            .all(|l| l.is_finite())
            .then_some(Load { lambda, size: 1.0 })
    }

    /// The farthest deviation of the output to a side (±1) that the corrections from the nominal position find; none where
    /// they do not settle. The factors are those of the pose.
    pub fn farthest(
        &mut self,
        stand: &Stand,
        output: &Output,
        load: &Load,
        side: f64,
    ) -> Option<Farthest> {
        let system = self.driven.system;
        let (n, m) = (system.n(), system.m());
        let round_off = ROUND_OFF * if output.is_angle() { 1.0 } else { system.size };
        self.take(&stand.q, stand);
        self.shifts.fill(linkdyn_linear::math::Vec2::zeros());
        let nominal = self.value(stand, output, 0.0);
        let (mut q, mut load) = (stand.q.clone(), load.clone());
        let (mut step, mut correction) = (vec![0.0; n], vec![0.0; m]);
        let mut gradient = vec![0.0; n];
        let mut right = vec![0.0; m];
        let (mut deviation, mut size, mut slow) = (f64::INFINITY, f64::INFINITY, 0);
        let mut kept = None;
        for pass in 0..MOST_PASSES {
            // What has hardly an influence flickers from side to side; then all keep theirs.
            let g = match &kept {
                Some(kept) => Vec::clone(kept),
                None => self.influences(stand, output, &load),
            };
            if !self.deviate(stand, &g, side) {
                return None;
            }
            for ((right, phi), gap) in right
                .iter_mut()
                .zip(&self.driven.evaluation.phi)
                .zip(&self.rows)
            {
                *right = -(phi + gap);
            }
            self.driven.answer(&right, &mut step);
            q.iter_mut().zip(&step).for_each(|(q, d)| *q += d);
            self.take(&q, stand);
            self.gradient(stand, output, &mut gradient);
            self.correct_load(&mut gradient, &mut load.lambda, &mut correction);
            let now = self.value(stand, output, 1.0) - nominal;
            if !now.is_finite() {
                return None;
            }
            let moved = (now - deviation).abs();
            let shrunk = system.scaled_norm(&step);
            let stalled = shrunk <= STALLED && shrunk > 0.3 * size;
            if moved <= STILL * now.abs() + round_off || stalled {
                return Some(Farthest {
                    deviation: now,
                    q,
                    needed: Vec::new(),
                });
            }
            slow = if shrunk > SLOW * size { slow + 1 } else { 0 };
            if slow > 2 && kept.is_some() {
                return None;
            }
            if slow > 2 || (pass == MOST_PASSES / 3 && kept.is_none()) {
                (kept, slow) = (Some(g), 0);
            }
            (deviation, size) = (now, shrunk);
        }
        None
    }

    /// λ += J₀⁻ᵀ (∂y − Jᵀ λ), with J at the position last taken and the factors of the pose.
    fn correct_load(&mut self, gradient: &mut [f64], lambda: &mut [f64], correction: &mut [f64]) {
        let mut carried = vec![0.0; gradient.len()];
        self.driven
            .evaluation
            .transposed_product(self.driven.system, lambda, &mut carried);
        gradient
            .iter_mut()
            .zip(&carried)
            .for_each(|(g, carried)| *g -= carried);
        self.driven.multipliers(gradient, correction);
        lambda
            .iter_mut()
            .zip(&*correction)
            .for_each(|(l, more)| *l += more);
    }
}
