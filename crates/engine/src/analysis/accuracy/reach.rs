//! The clearance that a deviation needs, and how far the output reaches where its first order means nothing.
//!
//! Prescribe the drivers *and* the output: one equation too many. What closes the mechanism is a share c of all deviations, each
//! where the self-stress λ of the equations presses it:
//!
//! ```text
//! φ(q) + c e(λ) = 0,  y(q) = y*,  Jᵀ λ + ∂yᵀ μ = 0            unknowns q, c
//! ```
//!
//! The equations with the border (e, ∂y) are regular also at change points, where c grows with the square of y* and the reach
//! with the root of c. From the nominal output y* goes on until c = 1; then c is held at 1 and y* is free. Each solution says
//! where q and c go on from it, so that steps may be long.

mod between;
mod bordered;
mod pressed;

use super::displaced::{Mechanism, Stand};
use super::output::{Load, Output};
use super::search::SILENT;
use super::source::Influence;
use super::turn::Turn;
use super::worst::Farthest;
pub(super) use between::Between;
pub(super) use bordered::{Bordered, Held};

/// At last so many corrections of one solution may grow, as deviations go to other ends.
const GROWTHS: usize = 2;
/// First deviations that are tried, in radians or sizes: with too small a one the gaps are round-off.
const FIRST: [f64; 4] = [1e-6, 1e-5, 1e-4, 1e-3];
/// Largest step of the deviation, in radians or sizes.
const LARGEST: f64 = 0.05;
/// A deviation beyond this, in radians or sizes, has no end.
const FARTHEST: f64 = 7.0;
/// Shortest …
const SHORTEST: f64 = 1e-12;
/// … and in parts of the deviation.
const SHORT: f64 = 1e-4;
/// Most steps.
const MOST_STEPS: usize = 100;
/// Where the next position is guessed to, it may be off by this part of the way to it.
const GUESSED: f64 = 0.05;
/// Where a share was guessed that is off by more than this part of it, something may have been passed by …
const LOST: f64 = 0.5;
/// … or a position by more than this part of the way to it …
const ASTRAY: f64 = 0.2;
/// … but in steps shorter than this, in radians or sizes.
const NARROW: f64 = 1e-6;
/// A step is at most so many times the one before.
const LONGER: f64 = 8.0;
/// A step that fails is tried again with this part of it.
const SHORTER: f64 = 0.25;

/// A displaced mechanism.
#[derive(Debug, Clone)]
pub(super) struct Displaced {
    pub q: Vec<f64>,
    /// Share of the deviations.
    pub c: f64,
    /// Deviation of the output.
    pub y: f64,
    /// ∂q/∂y and ∂c/∂y, with the deviations held but for their share.
    pub ahead: Vec<f64>,
    /// Whether the self-stress presses the other way than at the nominal position: as if c were less than 0.
    pub is_turned: bool,
    /// The deviations, whole, …
    pub extremes: Vec<Influence>,
    /// … and of those that give way how they do.
    pub turns: Vec<Turn>,
    /// How far off the guess was from which it was found, [–]; 0 where that says nothing.
    pub off: f64,
    /// Whether the deviations were where the load presses them, and not kept where they flickered.
    pub is_smooth: bool,
}

impl Displaced {
    /// ∂c/∂y, also as the deviations follow: they are stationary.
    pub fn slope(&self) -> f64 {
        self.ahead[self.q.len()]
    }

    /// The nominal position's way to the first displaced one: a parabola.
    fn begin(&mut self, first: &Displaced) {
        let n = self.q.len();
        let (now, next) = (
            self.q.iter().chain([&self.c]),
            first.q.iter().chain([&first.c]),
        );
        for (k, (now, next)) in now.zip(next).enumerate().take(n + 1) {
            self.ahead[k] = 2.0 * (next - now) / first.y - first.ahead[k];
        }
    }
}

impl Mechanism<'_> {
    /// The reach of the output to a side (±1), from a load that presses to it; none where it can't be found.
    pub fn reach(
        &mut self,
        stand: &Stand,
        output: &Output,
        load: Load,
        side: f64,
    ) -> Option<Farthest> {
        Bordered::new(self, stand, output, load, side).run()
    }
}

impl Bordered<'_, '_> {
    fn run(&mut self) -> Option<Farthest> {
        // What has no influence is best left in the middle, but beside a change point it may get one.
        let tries = [(SILENT, 0), (0.0, 0), (SILENT, GROWTHS)];
        tries.into_iter().find_map(|(still, growths)| {
            (self.still, self.growths) = (still, growths);
            self.attempt()
        })
    }

    /// Marches with the least first deviation that can be had.
    fn attempt(&mut self) -> Option<Farthest> {
        for first in FIRST {
            let mut trail = vec![self.start()?];
            let found = self.march(&mut trail, first * self.unit);
            if found.is_some() || (trail.len() > 1 && self.growths == 0) {
                return found;
            }
        }
        None
    }

    /// On from the nominal position until c = 1: all that lies before is reached with less.
    fn march(&mut self, trail: &mut Vec<Displaced>, first: f64) -> Option<Farthest> {
        let (mut step, mut is_led) = (first, true);
        for _ in 0..MOST_STEPS {
            let now = trail.last()?;
            let least = SHORTEST * self.unit + SHORT * now.y.abs();
            if step < least || now.y.abs() > FARTHEST * self.unit {
                return None;
            }
            let y = now.y + self.side * step;
            let guess = self.guess(trail, y, is_led);
            let guessed = guess.c;
            let Some(next) = self.solve(guess, Held::Output(y)) else {
                if trail.len() == 1 {
                    return None;
                }
                (step, is_led) = (SHORTER * step, false);
                continue;
            };
            let is_first = trail.len() == 1;
            if is_first {
                trail[0].begin(&next);
            }
            let now = trail.last()?;
            let between = Between::new(now, &next);
            let way = self.far(now, &next);
            let off = if is_first || !is_led || !now.is_smooth {
                0.0
            } else {
                Self::off(now, &next, guessed)
            };
            let is_narrow = step <= NARROW * self.unit || between.is_narrow();
            // Where corrections may grow, the position may be one that was not guessed.
            let is_astray = self.growths == 0 && next.off > ASTRAY * way;
            if !is_first && !is_narrow && (off > LOST || is_astray) {
                step *= SHORTER;
                continue;
            }
            if next.c >= 1.0 || (!is_first && between.most() >= 1.0) {
                let Some(reached) = self.close(&between) else {
                    step *= SHORTER;
                    continue;
                };
                trail.push(reached.clone());
                return Some(Farthest {
                    deviation: reached.y,
                    needed: self.needed(trail),
                    q: reached.q,
                    e: reached.extremes,
                    lacks: f64::NAN,
                });
            }
            // Beside a change point c falls again towards the other branch, which the clearance then lets in.
            let bent = (next.off / way).max(off);
            let longer = match (is_first, is_led) {
                (true, _) => LONGER,
                (false, true) => (GUESSED / bent).sqrt().clamp(0.5, LONGER),
                (false, false) => 2.0,
            };
            (step, is_led) = ((longer * step).min(LARGEST * self.unit), true);
            trail.push(next);
        }
        None
    }

    /// How far off the share was guessed, in parts of it.
    fn off(now: &Displaced, next: &Displaced, guessed: f64) -> f64 {
        let sign = if now.is_turned == next.is_turned {
            1.0
        } else {
            -1.0
        };
        (sign * next.c - guessed).abs() / now.c.max(next.c)
    }

    /// Where c = 1 between two displaced positions.
    fn close(&mut self, between: &Between) -> Option<Displaced> {
        let reached = self.solve(between.up(1.0)?, Held::Share(1.0))?;
        let is_first = reached.slope() * self.side > 0.0 && between.holds(reached.y);
        // From a guess that is far off the way may lead elsewhere.
        let [from, to] = between.ends();
        let is_near = reached.off <= GUESSED * self.far(from, to) || between.is_narrow();
        ((is_first && is_near) || !reached.is_smooth).then_some(reached)
    }

    /// Where the way goes on to with a deviation: by its direction and, where nothing left its end, by its curvature.
    fn guess(&self, trail: &[Displaced], y: f64, is_led: bool) -> Displaced {
        let now = &trail[trail.len() - 1];
        let mut next = now.clone();
        if trail.len() == 1 || !is_led || !now.is_smooth {
            return next;
        }
        let by = y - now.y;
        let before = &trail[trail.len() - 2];
        let is_bent = trail.len() > 2 && before.is_smooth && now.off > 0.0;
        let bend = if is_bent {
            0.5 * by * by / (now.y - before.y)
        } else {
            0.0
        };
        let ahead = now.ahead.iter().zip(&before.ahead);
        let gains = ahead.map(|(own, before)| by * own + bend * (own - before));
        let places = next.q.iter_mut().chain([&mut next.c]);
        places.zip(gains).for_each(|(place, gain)| *place += gain);
        next
    }
}
