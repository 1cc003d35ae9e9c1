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
//! which is off by the square of what q and λ lack, so that two corrections suffice for most. Where they do not settle, or a source
//! may go farther at another side, `climb` goes on. A stationary output is no proof that there is no farther one; see `enclosure`
//! for that.

use super::chosen::{Gain, Worth};
use super::climb::Climb;
use super::displaced::{Mechanism, Space, Stand};
use super::output::{Load, Output};
use super::search::{Search, add};
use super::source::{Influence, Play};

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
/// … where poses before led to it, this one, …
const LED: f64 = 1e-12;
/// … or this part of the mechanism's size (or of a radian): round-off.
const ROUND_OFF: f64 = 2e-16;

/// Where the output is carried farthest.
#[derive(Debug, Clone)]
pub(super) struct Farthest {
    /// Deviation of the output [rad or m].
    pub deviation: f64,
    /// Coordinates there (n), and e of the plays.
    pub q: Vec<f64>,
    pub e: Vec<Influence>,
    /// What the sources could still gain, to first order; NaN where that is not known.
    pub lacks: f64,
    /// On the way there: deviations with the share of the sources that each needs; empty where they were not followed.
    pub needed: Vec<[f64; 2]>,
}

impl Farthest {
    /// Where a search has led beyond what another one found, which says what is needed on the way there.
    pub fn beyond(mut self, other: Farthest) -> Farthest {
        self.needed = other.needed;
        if let Some([reached, _]) = self.needed.last_mut() {
            *reached = self.deviation;
        }
        self
    }
}

impl Mechanism<'_> {
    /// λ = J⁻ᵀ ∂y at a pose that was taken, and whose factors are at hand; none where they say nothing.
    pub fn load(&mut self, stand: &Stand, output: &Output) -> Option<Load> {
        let mut gradient = std::mem::take(&mut self.space.pull);
        self.gradient(stand, output, &mut gradient);
        let mut lambda = vec![0.0; self.driven.system.m()];
        self.driven.multipliers(&gradient, &mut lambda);
        self.space.pull = gradient;
        lambda
            .iter()
            .all(|l| l.is_finite())
            .then_some(Load { lambda, size: 1.0 })
    }

    /// Sets `space.right` to what the equations lack, −(φ + e), and says what that is worth to the output.
    pub fn lack(&mut self, load: &Load) -> f64 {
        let rows = self.driven.evaluation.phi.iter().zip(&self.rows);
        let mut lacking = 0.0;
        for ((right, (phi, gap)), l) in self.space.right.iter_mut().zip(rows).zip(&load.lambda) {
            *right = -(phi + gap);
            lacking += *right * l;
        }
        lacking
    }

    /// The farthest deviation of the output to a side that the corrections find in a search that was begun; none where they do
    /// not settle. The factors are those of the pose, with the load and the influences there.
    pub fn farthest(
        &mut self,
        stand: &Stand,
        output: &Output,
        nominal: (&Load, &[Influence]),
        search: &mut Search,
    ) -> Option<Farthest> {
        std::mem::swap(&mut self.chosen, &mut search.chosen);
        let found = self.settle(stand, output, nominal, search);
        std::mem::swap(&mut self.chosen, &mut search.chosen);
        found.filter(|found| search.goes(found.deviation))
    }

    /// The same by steps that gain, on from a place, else from the nominal position, with the output and the influences there.
    /// The factors are those of the pose again.
    pub fn climb(
        &mut self,
        stand: &Stand,
        output: &Output,
        (nominal, influences, side): (f64, Option<&[Influence]>, f64),
        from: Option<&Farthest>,
    ) -> Option<Farthest> {
        let rest = self.rest();
        let mut climb = Climb {
            mechanism: self,
            stand,
            output,
            side,
            nominal,
            influences,
        };
        let top = from.and_then(|from| climb.from(&from.q, &from.e));
        let top = top.or_else(|| climb.from(&stand.q, &rest));
        self.stand(stand);
        let (top, lacks) = top?;
        Some(Farthest {
            deviation: top.y,
            q: top.q,
            e: top.e,
            lacks,
            needed: Vec::new(),
        })
    }

    /// Whether no source may go farther at another side than in a search that has `found` this, none of them kept where it was;
    /// the influences are those last asked for.
    pub fn is_plain(
        &mut self,
        of: (&Stand, &Output),
        search: &Search,
        nominal: &[Influence],
        found: &Farthest,
    ) -> bool {
        if found.lacks.is_nan() {
            return false;
        }
        let g = std::mem::take(&mut self.space.influences);
        let place = (&*found.q, &*found.e, &search.load);
        let side = (search.side, found.deviation);
        let turns = self.turns(of, place, (&g, nominal), side);
        self.space.influences = g;
        turns.is_empty()
    }

    /// The e that are nearest to none.
    fn rest(&self) -> Vec<Influence> {
        let none = |play: &Play| {
            let ends = play.ends().unwrap_or_default();
            [0.0_f64.clamp(ends[0], ends[1]), 0.0]
        };
        self.plays.iter().map(none).collect()
    }

    fn settle(
        &mut self,
        stand: &Stand,
        output: &Output,
        nominal: (&Load, &[Influence]),
        search: &mut Search,
    ) -> Option<Farthest> {
        let system = self.driven.system;
        let unit = if output.is_angle() { 1.0 } else { system.size };
        let Search { is_led, far, .. } = *search;
        let (still, round_off) = (if is_led { LED } else { STILL }, ROUND_OFF * unit);
        let worth = Worth {
            ended: WORTH * search.deviation.abs(),
            still: STILL * search.deviation.abs(),
        };
        search.began.copy_from_slice(&search.q);
        let (mut slow, mut is_kept, mut gained) = (0, false, f64::INFINITY);
        let (mut size, mut is_moved) = (if is_led { f64::INFINITY } else { far }, false);
        for pass in 1..MOST_PASSES {
            self.take(&search.q, stand);
            self.place(stand);
            let leant = self.rebalance(stand, output, &mut search.load);
            // What has hardly an influence may flicker from side to side; then all keep theirs.
            let mut gain = Gain::default();
            if !is_kept {
                gain = self.press(stand, output, &search.load, (search.side, worth))?;
            }
            is_moved |= gain.ended > 0.0;
            let now = self.reading(stand, output, search);
            if !now.is_finite() {
                return None;
            }
            // What is read lacks the square of the step that is left, and what other deviations would gain next.
            let shrunk = self.step();
            let turned = CURVED * gain.smooth * far * far;
            let ended = gain.ended * (gain.ended / gained).min(1.0);
            let allowed = still * now.abs() + round_off;
            let lacks = |left: f64| CURVED * unit * left * (shrunk + leant * far);
            // Where the step leads what is left of it is what the factors, those of the nominal position, are off by.
            let is_near = lacks((CURVED * CURVED * far).min(1.0) * shrunk) <= allowed
                && turned.max(ended) <= allowed;
            let is_stalled = shrunk <= STALLED && shrunk > 0.3 * size;
            add(&mut search.q, &self.space.step);
            if is_near || is_stalled {
                let deviation = match is_stalled || lacks(shrunk) <= allowed {
                    true => now,
                    false => {
                        self.take(&search.q, stand);
                        self.place(stand);
                        self.reading(stand, output, search)
                    }
                };
                self.keep(stand, nominal, is_moved, search);
                return deviation.is_finite().then(|| Farthest {
                    deviation,
                    q: search.q.clone(),
                    e: self.chosen.extremes.clone(),
                    lacks: if is_kept { f64::NAN } else { turned.max(ended) },
                    needed: Vec::new(),
                });
            }
            slow = if shrunk > SLOW * size { slow + 1 } else { 0 };
            if slow > 2 && is_kept {
                return None;
            }
            if slow > 2 || (pass == MOST_PASSES / 3 && !is_kept) {
                (is_kept, slow) = (true, 0);
            }
            (gained, size) = (gain.ended, shrunk);
        }
        None
    }

    /// The deviation of the output as read at the position taken, with the points where they were put.
    fn reading(&mut self, stand: &Stand, output: &Output, search: &Search) -> f64 {
        self.gap(stand);
        let lacking = self.lack(&search.load);
        self.value(stand, output, 1.0) - search.nominal + lacking
    }

    /// Corrects λ at the position taken, with the points where the deviations before put them. The largest correction in parts of
    /// the largest, both as moments or forces on the mechanism's size.
    fn rebalance(&mut self, stand: &Stand, output: &Output, load: &mut Load) -> f64 {
        self.unbalance(stand, output, load);
        let Space {
            pull, correction, ..
        } = &mut self.space;
        self.driven.multipliers(pull, correction);
        let system = self.driven.system;
        let (mut most, mut largest) = (0.0_f64, 0.0_f64);
        let lambda = load.lambda.iter_mut().zip(correction).enumerate();
        for (row, (l, more)) in lambda {
            *l += *more;
            let scale = system.row_scale(row);
            most = most.max((*l * scale).abs());
            largest = largest.max((*more * scale).abs());
        }
        if most > 0.0 { largest / most } else { 0.0 }
    }

    /// Corrects q and λ for the deviations chosen; by how much (as in `step` and `rebalance`).
    pub fn correct(
        &mut self,
        stand: &Stand,
        output: &Output,
        q: &mut [f64],
        load: &mut Load,
    ) -> (f64, f64) {
        self.take(q, stand);
        self.place(stand);
        let leant = self.rebalance(stand, output, load);
        self.gap(stand);
        self.lack(load);
        let size = self.step();
        add(q, &self.space.step);
        (size, leant)
    }

    /// The next correction, in `space.step`, and its size.
    pub fn step(&mut self) -> f64 {
        let Space { right, step, .. } = &mut self.space;
        self.driven.answer(right, step);
        self.driven.system.scaled_norm(step)
    }

    /// Sets the e that carry the output farthest to a side, from the influences at the position taken, but for changes that are
    /// not worth it, and places the points. What they gain; none where the model can't be had with them.
    fn press(
        &mut self,
        stand: &Stand,
        output: &Output,
        load: &Load,
        (side, worth): (f64, Worth),
    ) -> Option<Gain> {
        let mut influences = std::mem::take(&mut self.space.influences);
        self.influences(stand, output, load, &mut influences);
        let asked = (influences.as_slice(), side);
        let gain = self.chosen.press((&self.sorted, self.plays), asked, worth);
        self.space.influences = influences;
        if gain.steps && !self.step_parameters() {
            return None;
        }
        if gain.steps || gain.moves {
            self.place(stand);
        }
        Some(gain)
    }
}
