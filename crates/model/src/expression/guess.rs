//! Numbers that are not known before a run, for finding dimensions: only what constants and parameters give is known.

use super::number::Number;

/// A number, none where only a run gives it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Guess(pub Option<f64>);

impl Guess {
    fn map(self, function: fn(f64) -> f64) -> Self {
        Guess(self.0.map(function))
    }

    fn both(self, other: &Self, function: fn(f64, f64) -> f64) -> Self {
        Guess(self.0.zip(other.0).map(|(one, other)| function(one, other)))
    }
}

/// What is not known counts as harmless: what it turns out to be is seen in the run.
impl Number for Guess {
    fn of(value: f64) -> Self {
        Guess(Some(value))
    }
    fn shown(&self) -> f64 {
        self.0.unwrap_or(f64::NAN)
    }
    fn is_finite(&self) -> bool {
        self.0.is_none_or(f64::is_finite)
    }
    fn is_zero(&self) -> bool {
        self.0 == Some(0.0)
    }
    fn is_negative(&self) -> bool {
        self.0.is_some_and(|value| value < 0.0)
    }
    fn exceeds_one(&self) -> bool {
        self.0.is_some_and(|value| value.abs() > 1.0)
    }
    fn single(&self) -> Option<f64> {
        self.0
    }
    fn negate(&self) -> Self {
        self.map(|x| -x)
    }
    fn add(&self, other: &Self) -> Self {
        self.both(other, |x, y| x + y)
    }
    fn subtract(&self, other: &Self) -> Self {
        self.both(other, |x, y| x - y)
    }
    fn multiply(&self, other: &Self) -> Self {
        self.both(other, |x, y| x * y)
    }
    fn divide(&self, other: &Self) -> Self {
        self.both(other, |x, y| x / y)
    }
    fn power(&self, exponent: &Self) -> Self {
        self.both(exponent, f64::powf)
    }
    fn sqrt(&self) -> Self {
        self.map(f64::sqrt)
    }
    fn abs(&self) -> Self {
        self.map(f64::abs)
    }
    fn min(&self, other: &Self) -> Self {
        self.both(other, f64::min)
    }
    fn max(&self, other: &Self) -> Self {
        self.both(other, f64::max)
    }
    fn hypot(&self, other: &Self) -> Self {
        self.both(other, f64::hypot)
    }
    fn atan2(&self, x: &Self) -> Self {
        self.both(x, f64::atan2)
    }
    fn sin(&self) -> Self {
        self.map(f64::sin)
    }
    fn cos(&self) -> Self {
        self.map(f64::cos)
    }
    fn tan(&self) -> Self {
        self.map(f64::tan)
    }
    fn asin(&self) -> Self {
        self.map(f64::asin)
    }
    fn acos(&self) -> Self {
        self.map(f64::acos)
    }
    fn atan(&self) -> Self {
        self.map(f64::atan)
    }
    fn exp(&self) -> Self {
        self.map(f64::exp)
    }
    fn ln(&self) -> Self {
        self.map(f64::ln)
    }
    fn floor(&self) -> Self {
        self.map(f64::floor)
    }
    fn ceil(&self) -> Self {
        self.map(f64::ceil)
    }
    fn round(&self) -> Self {
        self.map(f64::round)
    }
    fn step(&self) -> Self {
        self.map(|x| x.step())
    }
}
