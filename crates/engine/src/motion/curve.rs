//! Curves through points, as functions of anything: tables that formulas look through.
//!
//! Between two points, of distance h, with x = (s − s₀)/h, a curve is c₀ + c₁ x + c₂ x² + c₃ x³; slopes at the points are those of
//! [`super::table`] and of the natural spline. Before the first and behind the last point the ends hold, or it repeats.
//!
//! | shape             | side                                      |
//! | ----------------- | ----------------------------------------- |
//! | lines             | −1 before, 0 … n − 2 the piece, n − 1 behind |
//! | lines, repeating  | piece + (n − 1) · period, of n points     |
//! | smooth            | −1 before, 0, 1 behind                    |
//! | smooth, repeating | 0                                         |

use super::Spline;
use super::table::{monotone_slopes, periodic_slopes};

/// What is between the points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shape {
    /// Straight lines.
    Lines,
    /// Cubics that turn where the points do.
    Monotone,
    /// The natural spline, or the periodic one where it repeats.
    Spline,
}

/// A curve through points.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// Places of the points (n), strictly increasing.
    places: Vec<f64>,
    /// Coefficients (n − 1).
    terms: Vec<[f64; 4]>,
    /// Values of the first and the last point.
    ends: [f64; 2],
    is_kinked: bool,
    repeats: bool,
}

impl Curve {
    /// Through two points at least; where it repeats, the last is the first of the next period.
    pub fn new(points: &[[f64; 2]], shape: Shape, repeats: bool) -> Self {
        let terms = points.windows(2).zip(slopes(points, shape, repeats));
        let terms = terms.map(|(pair, [d0, d1])| {
            let h = pair[1][0] - pair[0][0];
            let rise = pair[1][1] - pair[0][1];
            match shape {
                Shape::Lines => [pair[0][1], rise, 0.0, 0.0],
                Shape::Monotone | Shape::Spline => [
                    pair[0][1],
                    h * d0,
                    3.0 * rise - h * (2.0 * d0 + d1),
                    h * (d0 + d1) - 2.0 * rise,
                ],
            }
        });
        Curve {
            terms: terms.collect(),
            places: points.iter().map(|point| point[0]).collect(),
            ends: [points[0][1], points[points.len() - 1][1]],
            is_kinked: shape == Shape::Lines,
            repeats,
        }
    }

    fn first(&self) -> f64 {
        self.places[0]
    }

    fn last(&self) -> f64 {
        self.places[self.terms.len()]
    }

    /// The period around a place, and the place in the first one.
    fn fold(&self, x: f64) -> (f64, f64) {
        let period = self.last() - self.first();
        let number = ((x - self.first()) / period).floor();
        (number, x - number * period)
    }

    /// The piece at a place, that of an end beyond it.
    fn piece(&self, x: f64) -> usize {
        let behind = self.places.partition_point(|place| *place <= x);
        behind.clamp(1, self.terms.len()) - 1
    }

    /// The side on which a place is.
    pub fn side(&self, x: f64) -> i32 {
        // a side that no i32 has is the last one
        let number = |whole: f64| whole as i32;
        match (self.repeats, self.is_kinked) {
            (true, false) => 0,
            (true, true) => {
                let (period, x) = self.fold(x);
                number(period * self.terms.len() as f64 + self.piece(x) as f64)
            }
            (false, _) if x < self.first() => -1,
            (false, false) => i32::from(x > self.last()),
            (false, true) if x > self.last() => number(self.terms.len() as f64),
            (false, true) => number(self.piece(x) as f64),
        }
    }

    /// Where a side begins and ends.
    fn range(&self, side: i32) -> [f64; 2] {
        let pieces = i32::try_from(self.terms.len()).unwrap_or(i32::MAX);
        match (self.repeats, self.is_kinked) {
            (true, false) => [f64::NEG_INFINITY, f64::INFINITY],
            (true, true) => {
                let shift = f64::from(side.div_euclid(pieces)) * (self.last() - self.first());
                let piece = self.index(side.rem_euclid(pieces));
                [self.places[piece] + shift, self.places[piece + 1] + shift]
            }
            (false, _) if side < 0 => [f64::NEG_INFINITY, self.first()],
            (false, false) if side == 0 => [self.first(), self.last()],
            (false, true) if side < pieces => {
                let piece = self.index(side);
                [self.places[piece], self.places[piece + 1]]
            }
            (false, _) => [self.last(), f64::INFINITY],
        }
    }

    fn index(&self, piece: i32) -> usize {
        usize::try_from(piece)
            .unwrap_or(0)
            .min(self.terms.len() - 1)
    }

    /// How far a place is beyond a side, not above zero on it.
    pub fn beyond(&self, x: f64, side: i32) -> f64 {
        let [begin, end] = self.range(side);
        (begin - x).max(x - end)
    }

    /// f and f′ at a place, of what holds on a side.
    pub fn jet(&self, x: f64, side: i32) -> [f64; 2] {
        let pieces = i32::try_from(self.terms.len()).unwrap_or(i32::MAX);
        let (piece, x) = match (self.repeats, self.is_kinked) {
            (true, false) => {
                let (_, x) = self.fold(x);
                (self.piece(x), x)
            }
            (true, true) => {
                let shift = f64::from(side.div_euclid(pieces)) * (self.last() - self.first());
                (self.index(side.rem_euclid(pieces)), x - shift)
            }
            (false, _) if side < 0 => return [self.ends[0], 0.0],
            (false, false) if side == 0 => (self.piece(x), x),
            (false, true) if side < pieces => (self.index(side), x),
            (false, _) => return [self.ends[1], 0.0],
        };
        let h = self.places[piece + 1] - self.places[piece];
        let part = (x - self.places[piece]) / h;
        let [c0, c1, c2, c3] = self.terms[piece];
        [
            c0 + part * (c1 + part * (c2 + part * c3)),
            (c1 + part * (2.0 * c2 + 3.0 * part * c3)) / h,
        ]
    }

    /// Whether a place is before or behind all points.
    pub fn is_outside(&self, x: f64) -> bool {
        !self.repeats && (x < self.first() || x > self.last())
    }
}

/// The slopes at both ends of all pieces.
fn slopes(points: &[[f64; 2]], shape: Shape, repeats: bool) -> Vec<[f64; 2]> {
    let last = points.len() - 1;
    let slopes = match (shape, repeats) {
        (Shape::Lines, _) => vec![0.0; points.len()],
        (Shape::Monotone, false) => monotone_slopes(points),
        (Shape::Monotone, true) => {
            let period = points[last][0] - points[0][0];
            let beside = |point: [f64; 2], by: f64| [point[0] + by, point[1]];
            let before = beside(points[last - 1], -period);
            let after = beside(points[1], period);
            let round: Vec<[f64; 2]> = [before]
                .iter()
                .chain(points)
                .chain(&[after])
                .copied()
                .collect();
            monotone_slopes(&round)[1..=last + 1].to_vec()
        }
        (Shape::Spline, false) => {
            let spline = Spline::natural(points);
            points.iter().map(|point| spline.jet(point[0])[1]).collect()
        }
        (Shape::Spline, true) => {
            let mut slopes = periodic_slopes(points);
            slopes.push(slopes[0]);
            slopes
        }
    };
    slopes.windows(2).map(|pair| [pair[0], pair[1]]).collect()
}
