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

use super::number::{Number, Real};

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
    fn growing(&self, function: fn(f64) -> f64) -> Interval {
        Interval::around(function(self.least), function(self.most))
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
    fn negate(&self) -> Interval {
        Interval::new(-self.most, -self.least)
    }
    fn add(&self, other: &Interval) -> Interval {
        let (least, most) = (self.least + other.least, self.most + other.most);
        Interval {
            least: below(least, sum_error(self.least, other.least, least)),
            most: above(most, sum_error(self.most, other.most, most)),
        }
    }
    fn subtract(&self, other: &Interval) -> Interval {
        self.add(&other.negate())
    }
    fn multiply(&self, other: &Interval) -> Interval {
        let corner = |a: f64, b: f64| (a * b, product_error(a, b, a * b));
        hull([
            corner(self.least, other.least),
            corner(self.least, other.most),
            corner(self.most, other.least),
            corner(self.most, other.most),
        ])
    }
    fn divide(&self, other: &Interval) -> Interval {
        if other.is_zero() {
            return Interval::EVERYTHING;
        }
        let corner = |a: f64, b: f64| (a / b, quotient_error(a, b, a / b));
        hull([
            corner(self.least, other.least),
            corner(self.least, other.most),
            corner(self.most, other.least),
            corner(self.most, other.most),
        ])
    }
    fn power(&self, exponent: &Interval) -> Interval {
        match exponent.single() {
            Some(0.0) => return Interval::of(1.0),
            Some(1.0) => return *self,
            Some(2.0) => {
                // both factors are the same number
                let square = self.abs();
                return square.multiply(&square);
            }
            Some(whole) if whole.fract() == 0.0 => return self.whole_power(whole),
            Some(_) | None => {}
        }
        if self.least < 0.0 {
            return Interval::EVERYTHING;
        }
        // monotone in the base and in the exponent, so that the corners are the extremes
        let corner = |base: f64, exponent: f64| (base.powf(exponent), 1.0);
        let ends = hull([
            corner(self.least, exponent.least),
            corner(self.least, exponent.most),
            corner(self.most, exponent.least),
            corner(self.most, exponent.most),
        ]);
        Interval::new(ends.least.next_down().max(0.0), ends.most.next_up())
    }
    fn sqrt(&self) -> Interval {
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
    fn abs(&self) -> Interval {
        if self.least >= 0.0 {
            *self
        } else if self.most <= 0.0 {
            self.negate()
        } else {
            Interval::new(0.0, self.most.max(-self.least))
        }
    }
    fn min(&self, other: &Interval) -> Interval {
        Interval::new(self.least.min(other.least), self.most.min(other.most))
    }
    fn max(&self, other: &Interval) -> Interval {
        Interval::new(self.least.max(other.least), self.most.max(other.most))
    }
    fn hypot(&self, other: &Interval) -> Interval {
        let (x, y) = (Number::abs(self), Number::abs(other));
        let ends = Interval::around(x.least.hypot(y.least), x.most.hypot(y.most));
        Interval::new(ends.least.max(0.0), ends.most)
    }
    fn atan2(&self, x: &Interval) -> Interval {
        // the origin, or the half line on which the angle jumps
        if self.is_zero() && x.least <= 0.0 {
            return Interval::around(-PI, PI);
        }
        let angles = [
            self.least.atan2(x.least),
            self.least.atan2(x.most),
            self.most.atan2(x.least),
            self.most.atan2(x.most),
        ];
        let least = angles.iter().copied().fold(f64::INFINITY, f64::min);
        let most = angles.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        Interval::around(least, most)
    }
    fn sin(&self) -> Interval {
        self.wave(f64::sin, FRAC_PI_2)
    }
    fn cos(&self) -> Interval {
        self.wave(f64::cos, 0.0)
    }
    fn tan(&self) -> Interval {
        let is_far = self.least.abs() > LARGE || self.most.abs() > LARGE;
        if is_far || self.may_hold(FRAC_PI_2) || self.may_hold(-FRAC_PI_2) {
            return Interval::EVERYTHING;
        }
        self.growing(f64::tan)
    }
    fn asin(&self) -> Interval {
        self.growing(f64::asin)
    }
    fn acos(&self) -> Interval {
        Interval::around(self.most.acos(), self.least.acos())
    }
    fn atan(&self) -> Interval {
        self.growing(f64::atan)
    }
    fn exp(&self) -> Interval {
        let ends = self.growing(f64::exp);
        Interval::new(ends.least.max(0.0), ends.most)
    }
    fn ln(&self) -> Interval {
        self.growing(f64::ln)
    }
    fn floor(&self) -> Interval {
        Interval::new(self.least.floor(), self.most.floor())
    }
    fn ceil(&self) -> Interval {
        Interval::new(self.least.ceil(), self.most.ceil())
    }
    fn round(&self) -> Interval {
        Interval::new(self.least.round(), self.most.round())
    }
    fn step(&self) -> Interval {
        Interval::new(self.least.step(), self.most.step())
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
