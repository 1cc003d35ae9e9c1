//! Driver laws f(t) with f′ and f″.
//!
//! | law                   | f(t)                                  |
//! | --------------------- | ------------------------------------- |
//! | polynomial            | Σ c_k t^k                             |
//! | harmonic              | o + A sin(2π ν t + φ)                 |
//! | table                 | natural cubic spline through (t, f)   |
//! | pieces                | other tables, rises, sequences        |
//! | constant velocity     | s + v t                               |
//! | constant acceleration | s + v t + a t²/2                      |
//!
//! A table is interpolated by the natural cubic spline (f″ = 0 at both ends; de Boor, A Practical Guide to Splines,
//! 2001, ch. IV) and goes on as a straight line beyond its ends, so f, f′, f″ are continuous everywhere. Pieces are continuous in f; where f′ or f″ jumps,
//! [`Law::next_break`] says so, and what stands there is the value after the jump.

mod curve;
mod held;
mod pieces;
pub mod rise;
mod spline;
mod table;

pub use curve::{Curve, Shape};
use linkdyn_linear::math::max_abs;
pub use pieces::Pieces;
pub use spline::Spline;
use std::f64::consts::{PI, TAU};

/// Value, first and second derivative.
pub type Jet<T = f64> = [T; 3];

/// A compiled law of time (or, for a path, of its parameter).
#[derive(Debug, Clone, PartialEq)]
pub enum Law {
    /// Coefficients, ascending.
    Polynomial(Vec<f64>),
    /// o + A sin(2π ν t + φ).
    Harmonic {
        /// o, in the unit of the value.
        offset: f64,
        /// A, in the unit of the value.
        amplitude: f64,
        /// ν \[Hz\].
        frequency: f64,
        /// φ \[rad\].
        phase: f64,
    },
    /// A table.
    Spline(Spline),
    /// What is made of pieces.
    Pieces(Pieces),
}

impl Law {
    /// f, f′, f″ at `t`.
    pub fn jet(&self, t: f64) -> Jet {
        match self {
            Law::Polynomial(c) => {
                let mut jet = [0.0; 3];
                for &ck in c.iter().rev() {
                    jet = [
                        jet[0] * t + ck,
                        jet[1] * t + jet[0],
                        jet[2] * t + 2.0 * jet[1],
                    ];
                }
                jet
            }
            Law::Harmonic {
                offset,
                amplitude,
                frequency,
                phase,
            } => {
                let w = TAU * frequency;
                let (s, c) = (w * t + phase).sin_cos();
                [
                    offset + amplitude * s,
                    amplitude * w * c,
                    -amplitude * w * w * s,
                ]
            }
            Law::Spline(s) => s.jet(t),
            Law::Pieces(pieces) => pieces.jet(t),
        }
    }

    /// f alone, the same number.
    pub fn value(&self, t: f64) -> f64 {
        match self {
            Law::Polynomial(c) => c.iter().rev().fold(0.0, |f, ck| f * t + ck),
            Law::Harmonic { .. } | Law::Spline(_) | Law::Pieces(_) => self.jet(t)[0],
        }
    }

    /// Rate at which the law moves, values measured in `unit` [1/s]; 0 of a constant.
    pub fn rate(&self, unit: f64) -> f64 {
        match self {
            Law::Polynomial(c) => {
                let mut factorial = 1.0;
                let rates = c.iter().enumerate().skip(1).map(|(k, ck)| {
                    factorial *= k as f64;
                    (ck.abs() * factorial / unit).powf(1.0 / k as f64)
                });
                rates.fold(0.0, f64::max)
            }
            Law::Harmonic { frequency, .. } if !self.is_constant() => TAU * frequency.abs(),
            Law::Harmonic { .. } => 0.0,
            Law::Spline(s) => {
                let pieces = s.times().windows(2).zip(s.values().windows(2));
                let slopes = pieces.map(|(t, f)| ((f[1] - f[0]) / (t[1] - t[0])).abs() / unit);
                slopes.fold(0.0, f64::max)
            }
            Law::Pieces(pieces) => pieces.speed() / unit,
        }
    }

    /// Whether the law never changes.
    pub fn is_constant(&self) -> bool {
        match self {
            Law::Polynomial(c) => c.iter().skip(1).all(|&ck| ck == 0.0),
            Law::Harmonic {
                amplitude,
                frequency,
                ..
            } => *amplitude == 0.0 || *frequency == 0.0,
            Law::Spline(s) => s.values().iter().all(|&f| f == s.values()[0]),
            Law::Pieces(pieces) => pieces.speed() == 0.0,
        }
    }

    /// Whether it has breaks.
    pub fn has_breaks(&self) -> bool {
        match self {
            Law::Polynomial(_) | Law::Harmonic { .. } | Law::Spline(_) => false,
            Law::Pieces(pieces) => pieces.has_breaks(),
        }
    }

    /// The first time after `t` at which the law has no Taylor series that holds on both sides; of a table's spline, whose third
    /// derivative jumps alone, none.
    pub fn next_break(&self, t: f64) -> Option<f64> {
        match self {
            Law::Polynomial(_) | Law::Harmonic { .. } | Law::Spline(_) => None,
            Law::Pieces(pieces) => pieces.next_break(t),
        }
    }

    /// Times in (0, end) where f′ changes sign, ascending: f is monotone between them. Each is looked for when it is requested; of a
    /// wave there are as many as show all that it does.
    pub fn turning_times(&self, end: f64) -> Box<dyn Iterator<Item = f64> + '_> {
        match self {
            Law::Polynomial(_) => Box::new(self.turns_between([end].into_iter(), end)),
            Law::Spline(s) => {
                let knots = s.times().iter().copied();
                let knots = knots.filter(move |&t| t > 0.0 && t < end);
                Box::new(self.turns_between(knots.chain([end]), end))
            }
            Law::Pieces(pieces) => Box::new(pieces.turns(end)),
            Law::Harmonic {
                frequency, phase, ..
            } => Box::new(self.turns_of_wave(*frequency, *phase, end)),
        }
    }

    /// Turning times in (0, end), of which there are a few at most between two `marks`: a fine subdivision brackets them.
    fn turns_between(
        &self,
        marks: impl Iterator<Item = f64>,
        end: f64,
    ) -> impl Iterator<Item = f64> {
        let speed = self.jet(0.0)[1];
        let mut sign = speed.signum() * f64::from(u8::from(speed != 0.0));
        let mut left = 0.0;
        let pieces = marks.flat_map(|mark| (1..=SUBDIVISIONS).map(move |k| (mark, k)));
        let turns = pieces.filter_map(move |(mark, k)| {
            let right = if k == SUBDIVISIONS {
                mark
            } else {
                left + (mark - left) / (SUBDIVISIONS + 1 - k) as f64
            };
            let slope = self.jet(right)[1];
            let mut turn = None;
            if slope != 0.0 {
                if sign != 0.0 && slope.signum() != sign {
                    turn = Some(bisect(|t| self.jet(t)[1] * sign, left, right));
                }
                sign = slope.signum();
            }
            left = right;
            turn
        });
        turns.filter(move |&t| t > 0.0 && t < end)
    }

    /// Turning times of a wave in (0, end), at 2π ν t + φ = (n + ½) π. Each of them costs the same, whatever `end`.
    fn turns_of_wave(&self, frequency: f64, phase: f64, end: f64) -> impl Iterator<Item = f64> {
        let nu = frequency.abs();
        // cos is even: a negative frequency turns the phase round. In (−π, π] it is as exact as sine and cosine are.
        let (sin, cos) = phase.sin_cos();
        let phase = (sin * frequency.signum()).atan2(cos);
        let near = move |k: usize| (k as f64 - 1.5 - phase / PI) / (2.0 * nu);
        let eighth = 0.125 / nu;
        (0..MOST_TURNS)
            .map(near)
            .take_while(move |near| near - eighth < end)
            .filter_map(move |near| {
                let (left, right) = ((near - eighth).max(0.0), near + eighth);
                let sign = self.jet(left)[1].signum();
                let is_turn = self.jet(left)[1] * sign > 0.0 && self.jet(right)[1] * sign < 0.0;
                is_turn.then(|| bisect(|t| self.jet(t)[1] * sign, left, right))
            })
            .filter(move |&t| t > 0.0 && t < end)
    }

    /// The stretches [from, to] of [0, end] on which f is monotone, ascending; of a wave, as many as show all that it does.
    pub fn stretches(&self, end: f64) -> impl Iterator<Item = (f64, f64)> {
        let mut left = 0.0;
        let most = match self {
            Law::Harmonic { .. } => REPEATS,
            Law::Pieces(pieces) if pieces.repeats() => REPEATS,
            Law::Polynomial(_) | Law::Spline(_) | Law::Pieces(_) => usize::MAX,
        };
        let ends = self.turning_times(end).chain([end]).take(most);
        ends.map(move |right| (std::mem::replace(&mut left, right), right))
    }

    /// The first time t in [0, `latest`] with f(t) = `value`, searched on the first monotone stretch; none if it is not
    /// reached.
    pub fn invert(&self, value: f64, latest: f64) -> Option<f64> {
        self.first_stretch(latest).invert(value, 0.0)
    }

    /// The law up to its first turning point, or to `latest`.
    pub fn first_stretch(&self, latest: f64) -> Stretch<'_> {
        let end = self.turning_times(latest).next().unwrap_or(latest);
        Stretch {
            law: self,
            end,
            from: self.jet(0.0)[0],
            to: self.jet(end)[0],
        }
    }
}

/// A law on [0, end], where it is monotone.
#[derive(Debug, Clone, Copy)]
pub struct Stretch<'a> {
    law: &'a Law,
    end: f64,
    from: f64,
    to: f64,
}

impl Stretch<'_> {
    /// The time in [0, end] with f(t) = `value`; none if it is not reached. `guess` saves work where it is near.
    pub fn invert(&self, value: f64, guess: f64) -> Option<f64> {
        let scale = self.from.abs().max(value.abs());
        if (value - self.from).abs() <= 4.0 * f64::EPSILON * scale {
            return Some(0.0);
        }
        let side = (value - self.from).signum();
        if (self.to - value) * side < -8.0 * f64::EPSILON * max_abs(&[scale, self.to]) {
            return None;
        }
        // Newton, kept within a bracket that bisection would use.
        let (mut low, mut high) = (0.0, self.end);
        let mut t = if guess > low && guess < high {
            guess
        } else {
            0.5 * self.end
        };
        for _ in 0..200 {
            let [f, speed, _] = self.law.jet(t);
            if (value - f) * side > 0.0 {
                low = t
            } else {
                high = t
            }
            let newton = t - (f - value) / speed;
            // Round-off at the turning point itself may point outside.
            let next = if newton >= low && newton <= high {
                newton
            } else {
                0.5 * (low + high)
            };
            let done = (next - t).abs() <= f64::EPSILON * t.abs() || f == value;
            t = next;
            if done {
                break;
            }
        }
        Some(t)
    }
}

/// Stretches a law's natural pieces are cut into when its turning points are looked for.
const SUBDIVISIONS: usize = 64;

/// Stretches of a wave that stand for all: extremes of more of them differ by round-off alone.
const REPEATS: usize = 10_000;

/// Turning points of a wave that are looked for: those, and some that may lie before t = 0.
const MOST_TURNS: usize = REPEATS + 2;

/// The place in [a, b] where `f` goes from positive to not positive.
pub(crate) fn bisect(f: impl Fn(f64) -> f64, mut a: f64, mut b: f64) -> f64 {
    for _ in 0..200 {
        let middle = 0.5 * (a + b);
        if middle <= a || middle >= b {
            break;
        }
        if f(middle) > 0.0 {
            a = middle
        } else {
            b = middle
        }
    }
    0.5 * (a + b)
}

#[cfg(test)]
mod piece_tests;
#[cfg(test)]
mod rise_tests;
#[cfg(test)]
mod tests;
