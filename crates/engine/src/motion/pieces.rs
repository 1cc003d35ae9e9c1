//! Laws made of pieces, one after the other, and over and over where they repeat.
//!
//! ```text
//! f(t) = Σ cₖ xᵏ + A sin(w x + φ),   x = (t − o)/h      on each piece
//! f(t + T) = f(t) + a                                   where it repeats, every T
//! ```
//!
//! Before the first piece and after the last the law goes on straight. A piece may run backwards (h < 0): the second half of a
//! symmetric rise is its first half turned round, so that both ends are at rest exactly.

use super::{Jet, MOST_TURNS, SUBDIVISIONS, bisect};

/// Coefficients of a piece.
pub(super) const TERMS: usize = 8;

/// Part of the time by which a break may be missed: round-off of times that are sums \[–\].
const SNAP: f64 = 4.0 * f64::EPSILON;

/// A piece, from its beginning to that of the next.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct LawPiece {
    /// When it begins \[s\].
    pub from: f64,
    /// Where x = 0 \[s\].
    pub origin: f64,
    /// How much time x = 1 is \[s\].
    pub span: f64,
    /// c₀, c₁ …
    pub terms: [f64; TERMS],
    /// A, w, φ.
    pub wave: [f64; 3],
    /// Whether it goes on what was before, without a break.
    pub is_smooth: bool,
}

impl LawPiece {
    /// A constant.
    pub fn dwell(from: f64, value: f64) -> Self {
        let mut terms = [0.0; TERMS];
        terms[0] = value;
        LawPiece {
            from,
            origin: from,
            span: 1.0,
            terms,
            wave: [0.0; 3],
            is_smooth: false,
        }
    }

    pub fn jet(&self, t: f64) -> Jet {
        let x = (t - self.origin) / self.span;
        let mut jet = [0.0; 3];
        for &c in self.terms.iter().rev() {
            jet = [
                jet[0] * x + c,
                jet[1] * x + jet[0],
                jet[2] * x + 2.0 * jet[1],
            ];
        }
        let [amplitude, w, phase] = self.wave;
        if amplitude != 0.0 {
            let (sin, cos) = (w * x + phase).sin_cos();
            jet[0] += amplitude * sin;
            jet[1] += amplitude * w * cos;
            jet[2] -= amplitude * w * w * sin;
        }
        [jet[0], jet[1] / self.span, jet[2] / (self.span * self.span)]
    }
}

/// What repeats.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Cycle {
    /// How far the law goes in it.
    pub advance: f64,
    /// The number of the first one, and of the first that is none any more.
    pub numbers: [f64; 2],
}

/// A law made of pieces.
#[derive(Debug, Clone, PartialEq)]
pub struct Pieces {
    pub(super) pieces: Vec<LawPiece>,
    /// When the last one ends \[s\].
    pub(super) end: f64,
    /// Value and slope at the beginning of the first, from before.
    before: [f64; 2],
    /// Value and slope at the end of the last, from after.
    after: [f64; 2],
    cycle: Cycle,
}

impl Pieces {
    /// Pieces, at least one, each longer than nothing; gone through once.
    pub(super) fn new(pieces: Vec<LawPiece>, end: f64, before: [f64; 2], after: [f64; 2]) -> Self {
        let cycle = Cycle {
            advance: 0.0,
            numbers: [0.0, 1.0],
        };
        Pieces {
            pieces,
            end,
            before,
            after,
            cycle,
        }
    }

    /// The same over and over.
    pub(super) fn repeating(self, cycle: Cycle) -> Self {
        Pieces { cycle, ..self }
    }

    /// Whether it repeats.
    pub fn repeats(&self) -> bool {
        let [first, last] = self.cycle.numbers;
        last - first > 1.0
    }

    fn begin(&self) -> f64 {
        self.pieces[0].from
    }

    pub(super) fn period(&self) -> f64 {
        self.end - self.begin()
    }

    /// The number of the cycle around a time, and where in the first one that is.
    pub(super) fn fold(&self, t: f64) -> (f64, f64) {
        if !self.repeats() {
            return (0.0, t);
        }
        let [first, last] = self.cycle.numbers;
        let snapped = t + SNAP * t.abs() - self.begin();
        let number = (snapped / self.period()).floor().clamp(first, last - 1.0);
        (number, t - number * self.period())
    }

    /// f, f′, f″ at `t`; at a jump those after it.
    pub fn jet(&self, t: f64) -> Jet {
        let (number, local) = self.fold(t);
        let snapped = local + SNAP * t.abs();
        let line =
            |[value, slope]: [f64; 2], from: f64| [value + slope * (local - from), slope, 0.0];
        let mut jet = if snapped < self.begin() {
            line(self.before, self.begin())
        } else if snapped >= self.end {
            line(self.after, self.end)
        } else {
            let after = self.pieces.partition_point(|piece| piece.from <= snapped);
            self.pieces[after - 1].jet(local)
        };
        if number != 0.0 {
            jet[0] += number * self.cycle.advance;
        }
        jet
    }

    /// The greatest speed at ends and in the middle of pieces.
    pub fn speed(&self) -> f64 {
        let ends = self.pieces.iter().skip(1).map(|piece| piece.from);
        let ends = ends.chain([self.end]);
        let speeds = self.pieces.iter().zip(ends).map(|(piece, end)| {
            let at = [piece.from, 0.5 * (piece.from + end), end];
            at.map(|t| piece.jet(t)[1].abs())
                .into_iter()
                .fold(0.0, f64::max)
        });
        speeds.fold(self.before[1].abs().max(self.after[1].abs()), f64::max)
    }

    /// Whether there are breaks at all.
    pub fn has_breaks(&self) -> bool {
        self.pieces.iter().any(|piece| !piece.is_smooth)
    }

    /// The first break after `t`.
    pub fn next_break(&self, t: f64) -> Option<f64> {
        let (number, _) = self.fold(t);
        let [_, last] = self.cycle.numbers;
        // round-off may have put `t` into the cycle beside
        let cycles = [number - 1.0, number, number + 1.0].into_iter();
        let cycles = cycles.filter(|&number| number < last && number >= self.cycle.numbers[0]);
        let in_cycle = |number: f64| {
            let shift = number * self.period();
            let breaks = self.pieces.iter().filter(|piece| !piece.is_smooth);
            let end = Some(self.end).filter(|_| !self.pieces[0].is_smooth);
            let breaks = breaks.map(|piece| piece.from).chain(end);
            breaks.map(move |time| time + shift).find(|&time| time > t)
        };
        cycles.filter_map(in_cycle).next()
    }

    /// Times in (0, end) where f′ changes its sign.
    pub(super) fn turns(&self, end: f64) -> impl Iterator<Item = f64> + '_ {
        let [first, last] = self.cycle.numbers;
        let within = self.turns_of_cycle();
        let (number, _) = self.fold(0.0);
        let numbers = (0..=MOST_TURNS).map(move |k| number + k as f64);
        let turns = numbers
            .take_while(move |&number| {
                let begins = self.begin() + number * self.period();
                number < last && begins < end
            })
            .flat_map(move |number| {
                let shift = number * self.period();
                let (is_first, is_last) = (number == first, number + 1.0 == last);
                let own = within.clone().into_iter().filter(move |(_, at)| match at {
                    TurnsAt::Before => is_first,
                    TurnsAt::Seam => !is_first,
                    TurnsAt::Within => true,
                    TurnsAt::After => is_last,
                });
                own.map(move |(time, _)| time + shift)
            });
        turns.filter(move |&t| t > 0.0 && t < end).take(MOST_TURNS)
    }

    /// Turning times of the first cycle, in their order, and where each is.
    fn turns_of_cycle(&self) -> Vec<(f64, TurnsAt)> {
        let ends = self.pieces.iter().skip(1).map(|piece| piece.from);
        let ends = ends.chain([self.end]);
        let sign = |slope: f64| slope.signum() * f64::from(u8::from(slope != 0.0));
        let mut turns = Vec::new();
        let mut last = 0.0;
        let mut first = 0.0;
        for (piece, end) in self.pieces.iter().zip(ends) {
            let mut left = piece.from;
            for k in 0..=SUBDIVISIONS {
                let part = k as f64 / SUBDIVISIONS as f64;
                let right = piece.from + (end - piece.from) * part;
                let now = sign(piece.jet(right)[1]);
                if now != 0.0 {
                    if last != 0.0 && now != last {
                        let turn = bisect(|t| piece.jet(t)[1] * last, left, right);
                        turns.push((turn, TurnsAt::Within));
                    }
                    if first == 0.0 {
                        first = now;
                    }
                    last = now;
                }
                left = right;
            }
        }
        let (before, after) = (sign(self.before[1]), sign(self.after[1]));
        if before * first < 0.0 {
            turns.insert(0, (self.begin(), TurnsAt::Before));
        }
        if first * last < 0.0 {
            turns.insert(0, (self.begin(), TurnsAt::Seam));
        }
        if last * after < 0.0 {
            turns.push((self.end, TurnsAt::After));
        }
        turns
    }
}

/// Where a law made of pieces turns.
#[derive(Debug, Clone, Copy, PartialEq)]
enum TurnsAt {
    /// Where it begins.
    Before,
    /// Where a cycle follows another.
    Seam,
    /// Within a cycle.
    Within,
    /// Where it ends.
    After,
}
