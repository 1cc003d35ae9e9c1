//! Numbers that are not known before a run, for finding dimensions: only what constants and parameters give is known.

use super::number::{Binary, Number, Unary};

/// A number, `None` if only a run gives it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Guess(pub Option<f64>);

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
    fn one(&self, function: Unary) -> Self {
        Guess(self.0.map(|x| x.one(function)))
    }
    fn two(&self, other: &Self, function: Binary) -> Self {
        Guess(self.0.zip(other.0).map(|(x, y)| x.two(&y, function)))
    }
}
