//! Numbers with their derivative in one direction, without allocation: (x, ẋ), and f(x) has (f, f′ ẋ).
//!
//! Where a function has no derivative it is not a number. Kinks are on one side each when these are calculated with, so that
//! the derivative of `min`, `floor` and the like is that of the side.

use super::number::Number;

/// A number and its derivative.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Tangent {
    /// x
    pub value: f64,
    /// ẋ
    pub slope: f64,
}

impl Tangent {
    fn map(&self, value: f64, derivative: f64) -> Self {
        // what does not change has no slope, wherever the function is steep
        let slope = match self.slope == 0.0 {
            true => 0.0,
            false => derivative * self.slope,
        };
        Tangent { value, slope }
    }

    fn both(&self, other: &Self, value: f64, by: [f64; 2]) -> Self {
        let (one, two) = (self.map(value, by[0]), other.map(value, by[1]));
        Tangent {
            value,
            slope: one.slope + two.slope,
        }
    }

    fn choose(&self, other: &Self, is_first: bool) -> Self {
        if is_first { *self } else { *other }
    }
}

impl Number for Tangent {
    fn of(value: f64) -> Self {
        Tangent { value, slope: 0.0 }
    }
    fn shown(&self) -> f64 {
        self.value
    }
    fn is_finite(&self) -> bool {
        self.value.is_finite()
    }
    fn is_zero(&self) -> bool {
        self.value == 0.0
    }
    fn is_negative(&self) -> bool {
        self.value < 0.0
    }
    fn exceeds_one(&self) -> bool {
        self.value.abs() > 1.0
    }
    fn single(&self) -> Option<f64> {
        Some(self.value)
    }
    fn negate(&self) -> Self {
        self.map(-self.value, -1.0)
    }
    fn add(&self, other: &Self) -> Self {
        self.both(other, self.value + other.value, [1.0, 1.0])
    }
    fn subtract(&self, other: &Self) -> Self {
        self.both(other, self.value - other.value, [1.0, -1.0])
    }
    fn multiply(&self, other: &Self) -> Self {
        let value = self.value * other.value;
        self.both(other, value, [other.value, self.value])
    }
    fn divide(&self, other: &Self) -> Self {
        let value = self.value / other.value;
        self.both(other, value, [1.0 / other.value, -value / other.value])
    }
    fn power(&self, exponent: &Self) -> Self {
        let (x, n) = (self.value, exponent.value);
        let value = x.powf(n);
        self.both(exponent, value, [n * x.powf(n - 1.0), value * x.ln()])
    }
    fn sqrt(&self) -> Self {
        let root = self.value.sqrt();
        self.map(root, 0.5 / root)
    }
    fn abs(&self) -> Self {
        self.map(self.value.abs(), self.value.sign())
    }
    fn min(&self, other: &Self) -> Self {
        self.choose(other, self.value <= other.value)
    }
    fn max(&self, other: &Self) -> Self {
        self.choose(other, self.value >= other.value)
    }
    fn hypot(&self, other: &Self) -> Self {
        let length = self.value.hypot(other.value);
        self.both(other, length, [self.value / length, other.value / length])
    }
    fn atan2(&self, x: &Self) -> Self {
        let square = self.value * self.value + x.value * x.value;
        let by = [x.value / square, -self.value / square];
        self.both(x, self.value.atan2(x.value), by)
    }
    fn sin(&self) -> Self {
        self.map(self.value.sin(), self.value.cos())
    }
    fn cos(&self) -> Self {
        self.map(self.value.cos(), -self.value.sin())
    }
    fn tan(&self) -> Self {
        let tan = self.value.tan();
        self.map(tan, 1.0 + tan * tan)
    }
    fn asin(&self) -> Self {
        self.map(self.value.asin(), 1.0 / steepness(self.value))
    }
    fn acos(&self) -> Self {
        self.map(self.value.acos(), -1.0 / steepness(self.value))
    }
    fn atan(&self) -> Self {
        self.map(self.value.atan(), 1.0 / (1.0 + self.value * self.value))
    }
    fn exp(&self) -> Self {
        let value = self.value.exp();
        self.map(value, value)
    }
    fn ln(&self) -> Self {
        self.map(self.value.ln(), 1.0 / self.value)
    }
    fn floor(&self) -> Self {
        Tangent::of(self.value.floor())
    }
    fn ceil(&self) -> Self {
        Tangent::of(self.value.ceil())
    }
    fn round(&self) -> Self {
        Tangent::of(self.value.round())
    }
    fn step(&self) -> Self {
        Tangent::of(self.value.step())
    }
}

/// √(1 − x²), with its digits near one.
fn steepness(x: f64) -> f64 {
    ((1.0 - x) * (1.0 + x)).sqrt()
}
