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

use super::displaced::{Mechanism, Space, Stand};
use super::output::{Load, Output};
use super::source::{Influence, Play};
use super::turn::Turn;

/// Most corrections.
const MOST_PASSES: usize = 60;
/// Corrections that shrink less than this are left to [`super::reach`].
const SLOW: f64 = 0.5;
/// Corrections below this, in radians or sizes, that shrink no more are round-off.
const STALLED: f64 = 1e-11;
/// Other deviations of a source are tried where they gain more than this part of the output's.
const WORTH: f64 = 1e-12;
/// A step that is left is worth so many times its square.
const CURVED: f64 = 10.0;
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

/// The first correction towards it.
pub(super) struct Start {
    /// Coordinates after it (n).
    q: Vec<f64>,
    /// The e of the sources.
    extremes: Vec<Influence>,
    /// The output before [rad or m].
    nominal: f64,
    /// Its deviation to first order.
    deviation: f64,
    /// Size of the correction [–].
    size: f64,
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

    /// The first correction towards the farthest deviation to a side (±1), from the influences at a pose that was taken; none
    /// where the model can't be had with it.
    pub fn start(
        &mut self,
        stand: &Stand,
        output: &Output,
        load: &Load,
        influences: &[Influence],
        side: f64,
    ) -> Option<Start> {
        if !self.deviate(stand, influences, side) {
            return None;
        }
        let lacking = self.lack(load);
        let nominal = self.value(stand, output, 0.0);
        let mut step = std::mem::take(&mut self.space.step);
        self.driven.answer(&self.space.right, &mut step);
        let start = Start {
            q: stand.q.iter().zip(&step).map(|(q, d)| q + d).collect(),
            extremes: self.extremes.clone(),
            nominal,
            deviation: self.value(stand, output, 1.0) - nominal + lacking,
            size: self.driven.system.scaled_norm(&step),
        };
        self.space.step = step;
        Some(start)
    }

    /// Sets `space.right` to what the equations lack, −(φ + e), and says what that is worth to the output.
    fn lack(&mut self, load: &Load) -> f64 {
        let rows = self.driven.evaluation.phi.iter().zip(&self.rows);
        let mut lacking = 0.0;
        for ((right, (phi, gap)), l) in self.space.right.iter_mut().zip(rows).zip(&load.lambda) {
            *right = -(phi + gap);
            lacking += *right * l;
        }
        lacking
    }

    /// The farthest deviation of the output to a side (±1) that the corrections from the nominal position find; none where
    /// they do not settle. The factors are those of the pose.
    pub fn farthest(
        &mut self,
        stand: &Stand,
        output: &Output,
        load: &Load,
        (side, start): (f64, Start),
    ) -> Option<Farthest> {
        let system = self.driven.system;
        let unit = if output.is_angle() { 1.0 } else { system.size };
        let round_off = ROUND_OFF * unit;
        let Start {
            mut q,
            extremes,
            nominal,
            deviation,
            mut size,
        } = start;
        self.extremes = extremes;
        if !self.step_parameters() {
            return None;
        }
        let mut load = load.clone();
        let (mut slow, mut is_kept, mut gained) = (0, false, 0.0);
        self.turns.fill(Turn::default());
        for pass in 1..MOST_PASSES {
            self.take(&q, stand);
            self.rebalance(stand, output, &mut load);
            // What has hardly an influence may flicker from side to side; then all keep theirs.
            let mut gain = 0.0;
            if !is_kept {
                gain = self.press(stand, output, &load, (side, WORTH * deviation.abs()))?;
            }
            self.place(stand);
            self.gap(stand);
            let lacking = self.lack(&load);
            let now = self.value(stand, output, 1.0) - nominal + lacking;
            if !now.is_finite() {
                return None;
            }
            // What is read lacks the square of the step that is left, and what other deviations would gain next.
            let shrunk = self.step();
            let gains = gain * (gain / gained).min(1.0);
            let left = gains.max(CURVED * shrunk * shrunk * unit);
            let is_done = pass > 1 && left <= STILL * now.abs() + round_off;
            if is_done || (shrunk <= STALLED && shrunk > 0.3 * size) {
                return Some(Farthest {
                    deviation: now,
                    q,
                    needed: Vec::new(),
                });
            }
            q.iter_mut()
                .zip(&self.space.step)
                .for_each(|(q, d)| *q += d);
            slow = if shrunk > SLOW * size { slow + 1 } else { 0 };
            if slow > 2 && is_kept {
                return None;
            }
            if slow > 2 || (pass == MOST_PASSES / 3 && !is_kept) {
                (is_kept, slow) = (true, 0);
            }
            (gained, size) = (gain, shrunk);
        }
        None
    }

    /// Corrects λ at the position taken, with the points where the deviations before put them.
    fn rebalance(&mut self, stand: &Stand, output: &Output, load: &mut Load) {
        self.place(stand);
        self.unbalance(stand, output, load);
        let Space {
            pull, correction, ..
        } = &mut self.space;
        self.driven.multipliers(pull, correction);
        let lambda = load.lambda.iter_mut();
        lambda.zip(correction).for_each(|(l, more)| *l += *more);
    }

    /// The next correction, in `space.step`, and its size.
    fn step(&mut self) -> f64 {
        let Space { right, step, .. } = &mut self.space;
        self.driven.answer(right, step);
        self.driven.system.scaled_norm(step)
    }

    /// Sets the e that carry the output farthest to a side, from the influences at the position taken, but for changes that are
    /// not worth it. What they gain; none where the model can't be had with them.
    fn press(
        &mut self,
        stand: &Stand,
        output: &Output,
        load: &Load,
        (side, worth): (f64, f64),
    ) -> Option<f64> {
        let mut influences = std::mem::take(&mut self.space.influences);
        self.influences(stand, output, load, &mut influences);
        let mut gain = 0.0;
        let each = self.extremes.iter_mut().zip(&mut self.turns);
        for (((e, turn), play), g) in each.zip(self.plays).zip(&influences) {
            let end = play.extreme(*g, side);
            let next = match play.ends() {
                Some(ends) => {
                    let bends = matches!(play, Play::Parameter { bends: true, .. });
                    let ends = (!bends).then_some(ends);
                    [turn.next([e[0], g[0]], end[0], ends, worth), 0.0]
                }
                None => end,
            };
            gain += g[0] * (next[0] - e[0]) + g[1] * (next[1] - e[1]);
            *e = next;
        }
        self.space.influences = influences;
        self.step_parameters().then_some(gain.abs())
    }
}
