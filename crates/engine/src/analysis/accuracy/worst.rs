//! The worst that can be found: where the output is stationary under all deviations that are allowed.
//!
//! ```text
//! φ(q) + e = 0,   e_i = argmax g_i·e_i,   g = −λ,   J(q)ᵀ λ = ∂y(q)
//! ```
//!
//! Each pin is at its rim where the unit load on the output presses it at the displaced position; so all are massless links
//! under that load. With the factors of the nominal position, q and λ are corrected together. The output is read as
//!
//! ```text
//! y ≈ y(q) − λᵀ (φ(q) + e)
//! ```
//!
//! which is off by the square of what q and λ lack, so that two corrections suffice for most. A stationary output is no
//! proof; see `enclosure` for one.

use super::displaced::{Mechanism, Stand};
use super::output::{Load, Output};

/// Most corrections.
const MOST_PASSES: usize = 60;
/// Corrections that shrink less than this are left to [`super::reach`].
const SLOW: f64 = 0.5;
/// Corrections below this, in radians or sizes, that shrink no more are round-off.
const STALLED: f64 = 1e-11;
/// What the output still lacks may be this part of its deviation …
const STILL: f64 = 1e-14;
/// … or this part of the mechanism's size (or of a radian): round-off.
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
    /// λ = J⁻ᵀ ∂y at a pose that was taken, and whose factors are at hand; none where they say nothing.
    pub fn load(&mut self, stand: &Stand, output: &Output) -> Option<Load> {
        let (n, m) = (self.driven.system.n(), self.driven.system.m());
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
        let unit = if output.is_angle() { 1.0 } else { system.size };
        let round_off = ROUND_OFF * unit;
        self.take(&stand.q, stand);
        self.shifts.fill(linkdyn_linear::math::Vec2::zeros());
        let nominal = self.value(stand, output, 0.0);
        let (mut q, mut load) = (stand.q.clone(), load.clone());
        let (mut step, mut right) = (vec![0.0; n], vec![0.0; m]);
        let (mut pull, mut correction) = (vec![0.0; n], vec![0.0; m]);
        let mut g = vec![[0.0; 2]; self.plays.len()];
        let (mut size, mut shrinks, mut slow, mut is_kept) = (f64::INFINITY, 1.0, 0, false);
        let (mut deviation, mut moved) = (f64::INFINITY, f64::INFINITY);
        for pass in 0..MOST_PASSES {
            // What has hardly an influence flickers from side to side; then all keep theirs.
            if !is_kept {
                self.influences(stand, output, &load, &mut g);
            }
            if !self.deviate(stand, &g, side) {
                return None;
            }
            let rows = self.driven.evaluation.phi.iter().zip(&self.rows);
            for (right, (phi, gap)) in right.iter_mut().zip(rows) {
                *right = -(phi + gap);
            }
            let lacking: f64 = right.iter().zip(&load.lambda).map(|(r, l)| r * l).sum();
            let now = self.value(stand, output, 1.0) - nominal + lacking;
            if !now.is_finite() {
                return None;
            }
            let last = std::mem::replace(&mut moved, (now - deviation).abs());
            // What is lacking shrinks with the square of the steps, or as the moves do; but a small move may be chance.
            let lacks = size * shrinks;
            let left =
                (moved * (moved / last).max(shrinks * shrinks).min(1.0)).max(lacks * lacks * unit);
            let enough = STILL * now.abs() + round_off;
            if pass > 1 && left <= enough {
                return Some(Farthest {
                    deviation: now,
                    q,
                    needed: Vec::new(),
                });
            }
            self.driven.answer(&right, &mut step);
            let shrunk = system.scaled_norm(&step);
            if shrunk <= STALLED && shrunk > 0.3 * size {
                return Some(Farthest {
                    deviation: now,
                    q,
                    needed: Vec::new(),
                });
            }
            self.unbalanced(stand, output, &load, &mut pull);
            self.driven.multipliers(&pull, &mut correction);
            let lambda = load.lambda.iter_mut();
            lambda.zip(&correction).for_each(|(l, more)| *l += more);
            q.iter_mut().zip(&step).for_each(|(q, d)| *q += d);
            self.take(&q, stand);
            shrinks = shrunk / size;
            slow = if shrinks > SLOW { slow + 1 } else { 0 };
            if slow > 2 && is_kept {
                return None;
            }
            if slow > 2 || (pass == MOST_PASSES / 3 && !is_kept) {
                (is_kept, slow) = (true, 0);
            }
            (deviation, size) = (now, shrunk);
        }
        None
    }
}
