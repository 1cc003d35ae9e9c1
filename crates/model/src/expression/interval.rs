//! Intervals that enclose: every result is rounded outward, so that it holds what the exact operation gives for all
//! numbers of its operands.
//!
//! ```text
//! + − · / √     one double further out, unless the double is exact (its error is a double: Knuth 1969, Dekker 1971)
//! elementary    two doubles further out: the library's functions err by less than one unit in the last place
//! sin cos       by monotone pieces; a turning point that is perhaps inside counts as inside
//! ```

use std::cmp::Ordering;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::number::{Binary, Number, Real, Unary};

/// Below this products and quotients may have lost digits, and are not taken for exact.
const TINY: f64 = 1e-280;
/// Beyond this angles are too coarse to tell where sines turn \[rad\].
const LARGE: f64 = 1e9;
/// How far, in turns, a turning point may be outside of an interval and yet count as inside.
const MARGIN: f64 = 1e-6;

/// An exponent of a unit that is narrower is one number, as 1/3 is.
const ROUNDING: f64 = 1e-12;

/// All numbers from the least to the greatest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    /// The least.
    pub least: f64,
    /// The greatest.
    pub most: f64,
}

/// One double down, unless the value is exact.
fn below(value: f64, error: f64) -> f64 {
    if error == 0.0 {
        value
    } else {
        value.next_down()
    }
}

/// One double up, unless the value is exact.
fn above(value: f64, error: f64) -> f64 {
    if error == 0.0 { value } else { value.next_up() }
}

/// The error of a sum, zero where it is exact.
fn sum_error(a: f64, b: f64, sum: f64) -> f64 {
    let back = sum - a;
    (a - (sum - back)) + (b - back)
}

/// The error of a product, zero where it is exact.
fn product_error(a: f64, b: f64, product: f64) -> f64 {
    if a == 0.0 || b == 0.0 {
        0.0
    } else if product.abs() < TINY {
        1.0
    } else {
        a.mul_add(b, -product)
    }
}

/// The error of a quotient, zero where it is exact.
fn quotient_error(a: f64, b: f64, quotient: f64) -> f64 {
    if a == 0.0 {
        0.0
    } else if quotient.abs() < TINY || a.abs() < TINY {
        1.0
    } else {
        quotient.mul_add(b, -a)
    }
}

/// The least and the greatest of four numbers, each with its error.
fn hull(corners: [(f64, f64); 4]) -> Interval {
    let least = corners.iter().map(|&(value, error)| below(value, error));
    let most = corners.iter().map(|&(value, error)| above(value, error));
    // a corner that is no number makes all of it none
    let has_none = corners.iter().any(|(value, _)| value.is_nan());
    if has_none {
        return Interval::EVERYTHING;
    }
    Interval {
        least: least.fold(f64::INFINITY, f64::min),
        most: most.fold(f64::NEG_INFINITY, f64::max),
    }
}

impl Interval {
    /// All numbers.
    const EVERYTHING: Interval = Interval {
        least: f64::NEG_INFINITY,
        most: f64::INFINITY,
    };

    /// The numbers between two.
    pub fn new(least: f64, most: f64) -> Self {
        Interval { least, most }
    }

    /// Whether a number is inside.
    pub fn contains(&self, number: f64) -> bool {
        self.least <= number && number <= self.most
    }

    /// A function that grows, from a library that errs by less than a unit in the last place.
    fn growing(&self, function: Unary) -> Interval {
        Interval::around(self.least.one(function), self.most.one(function))
    }

    /// Two doubles further out.
    fn around(least: f64, most: f64) -> Interval {
        if least.is_nan() || most.is_nan() {
            return Interval::EVERYTHING;
        }
        Interval {
            least: least.next_down().next_down(),
            most: most.next_up().next_up(),
        }
    }

    /// Cut to −1 … 1.
    fn within_one(self) -> Interval {
        Interval {
            least: self.least.max(-1.0),
            most: self.most.min(1.0),
        }
    }

    /// Whether `phase` plus whole turns may be inside.
    fn may_hold(&self, phase: f64) -> bool {
        let turns = |angle: f64| (angle - phase) / TAU;
        (turns(self.least) - MARGIN).ceil() <= (turns(self.most) + MARGIN).floor()
    }

    /// A sine or cosine, greatest at `crest` and least half a turn further.
    fn wave(&self, function: fn(f64) -> f64, crest: f64) -> Interval {
        if self.least.abs() > LARGE || self.most.abs() > LARGE {
            return Interval::new(-1.0, 1.0);
        }
        let (first, last) = (function(self.least), function(self.most));
        let ends = Interval::around(first.min(last), first.max(last));
        Interval {
            least: if self.may_hold(crest + PI) {
                -1.0
            } else {
                ends.least
            },
            most: if self.may_hold(crest) { 1.0 } else { ends.most },
        }
        .within_one()
    }

    /// A whole power.
    fn whole_power(&self, exponent: f64) -> Interval {
        let [first, last] = [self.least, self.most].map(|base| base.powf(exponent));
        let ends = Interval::around(first.min(last), first.max(last));
        let is_even = (exponent / 2.0).fract() == 0.0;
        if is_even && exponent > 0.0 && self.is_zero() {
            Interval { least: 0.0, ..ends }
        } else if exponent < 0.0 && self.is_zero() {
            Interval::EVERYTHING
        } else {
            ends
        }
    }

    /// The ends of both.
    fn pairs(&self, other: &Interval) -> [(f64, f64); 4] {
        [
            (self.least, other.least),
            (self.least, other.most),
            (self.most, other.least),
            (self.most, other.most),
        ]
    }

    /// What is greatest and least at the ends of both, each with its error.
    fn corners(&self, other: &Interval, corner: fn(f64, f64) -> (f64, f64)) -> Interval {
        hull(self.pairs(other).map(|(a, b)| corner(a, b)))
    }

    fn root(&self) -> Interval {
        let root = |value: f64| {
            let root = f64::sqrt(value);
            let is_exact = value == 0.0 || (value > TINY && root.mul_add(root, -value) == 0.0);
            (root, if is_exact { 0.0 } else { 1.0 })
        };
        let ((least, first), (most, last)) = (root(self.least), root(self.most));
        if least.is_nan() || most.is_nan() {
            return Interval::EVERYTHING;
        }
        Interval::new(below(least, first), above(most, last))
    }

    fn power(&self, exponent: &Interval) -> Interval {
        match exponent.single() {
            Some(0.0) => return Interval::of(1.0),
            Some(1.0) => return *self,
            Some(2.0) => {
                // both factors are the same number
                let square = self.one(Unary::Abs);
                return square.multiply(&square);
            }
            Some(whole) if whole.fract() == 0.0 => return self.whole_power(whole),
            Some(_) | None => {}
        }
        if self.least < 0.0 {
            return Interval::EVERYTHING;
        }
        // monotone in the base and in the exponent, so that the corners are the extremes
        let ends = self.corners(exponent, |base, exponent| (base.powf(exponent), 1.0));
        Interval::new(ends.least.next_down().max(0.0), ends.most.next_up())
    }
}

impl Number for Interval {
    fn of(value: f64) -> Interval {
        Interval::new(value, value)
    }
    fn shown(&self) -> f64 {
        0.5 * (self.least + self.most)
    }
    fn is_finite(&self) -> bool {
        self.least.is_finite() && self.most.is_finite()
    }
    fn is_zero(&self) -> bool {
        self.contains(0.0)
    }
    fn is_negative(&self) -> bool {
        self.least < 0.0
    }
    fn exceeds_one(&self) -> bool {
        self.least < -1.0 || self.most > 1.0
    }
    fn single(&self) -> Option<f64> {
        (self.least == self.most).then_some(self.least)
    }
    fn nearly(&self) -> Option<f64> {
        (self.most - self.least <= ROUNDING).then(|| self.shown())
    }
    fn one(&self, function: Unary) -> Interval {
        match function {
            Unary::Negate => Interval::new(-self.most, -self.least),
            Unary::Sqrt => self.root(),
            Unary::Abs if self.least >= 0.0 => *self,
            Unary::Abs if self.most <= 0.0 => self.negate(),
            Unary::Abs => Interval::new(0.0, self.most.max(-self.least)),
            Unary::Sin => self.wave(f64::sin, FRAC_PI_2),
            Unary::Cos => self.wave(f64::cos, 0.0),
            Unary::Tan => {
                let is_far = self.least.abs() > LARGE || self.most.abs() > LARGE;
                if is_far || self.may_hold(FRAC_PI_2) || self.may_hold(-FRAC_PI_2) {
                    return Interval::EVERYTHING;
                }
                self.growing(function)
            }
            Unary::Acos => Interval::around(self.most.acos(), self.least.acos()),
            Unary::Asin | Unary::Atan | Unary::Ln => self.growing(function),
            Unary::Exp => {
                let ends = self.growing(function);
                Interval::new(ends.least.max(0.0), ends.most)
            }
            Unary::Floor | Unary::Ceil | Unary::Round | Unary::Step => {
                Interval::new(self.least.one(function), self.most.one(function))
            }
        }
    }
    fn two(&self, other: &Interval, function: Binary) -> Interval {
        match function {
            Binary::Add => {
                let (least, most) = (self.least + other.least, self.most + other.most);
                Interval {
                    least: below(least, sum_error(self.least, other.least, least)),
                    most: above(most, sum_error(self.most, other.most, most)),
                }
            }
            Binary::Subtract => self.add(&other.negate()),
            Binary::Multiply => self.corners(other, |a, b| (a * b, product_error(a, b, a * b))),
            Binary::Divide if other.is_zero() => Interval::EVERYTHING,
            Binary::Divide => self.corners(other, |a, b| (a / b, quotient_error(a, b, a / b))),
            Binary::Power => self.power(other),
            Binary::Min => Interval::new(self.least.min(other.least), self.most.min(other.most)),
            Binary::Max => Interval::new(self.least.max(other.least), self.most.max(other.most)),
            Binary::Hypot => {
                let (x, y) = (self.one(Unary::Abs), other.one(Unary::Abs));
                let ends = Interval::around(x.least.hypot(y.least), x.most.hypot(y.most));
                Interval::new(ends.least.max(0.0), ends.most)
            }
            // the origin, or the half line on which the angle jumps
            Binary::Atan2 if self.is_zero() && other.least <= 0.0 => Interval::around(-PI, PI),
            Binary::Atan2 => {
                let angles = self.pairs(other).map(|(y, x)| y.atan2(x));
                let least = angles.iter().copied().fold(f64::INFINITY, f64::min);
                let most = angles.iter().copied().fold(f64::NEG_INFINITY, f64::max);
                Interval::around(least, most)
            }
        }
    }
}

impl Real for Interval {
    fn order(&self, other: &Interval) -> Option<Ordering> {
        if self.most < other.least {
            Some(Ordering::Less)
        } else if self.least > other.most {
            Some(Ordering::Greater)
        } else if self.single().is_some() && self == other {
            Some(Ordering::Equal)
        } else {
            None
        }
    }
    fn about(value: f64) -> Interval {
        Interval::around(value, value)
    }
    fn jumps(&self, shift: f64) -> bool {
        let (least, most) = (
            (self.least + shift).next_down(),
            (self.most + shift).next_up(),
        );
        least.floor() != most.floor()
    }
}

#[cfg(test)]
mod tests;
