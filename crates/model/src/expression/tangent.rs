//! Numbers with their derivative in one direction, without allocation: (x, ẋ), and f(x) has (f, f′ ẋ).
//!
//! Where a function has no derivative it is not a number. Kinks are on one side each when these are calculated with, so that
//! the derivative of `min`, `floor` and the like is that of the side.

use super::number::{Binary, Number, Unary};

/// A number and its derivative.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Tangent {
    /// x
    pub value: f64,
    /// ẋ
    pub slope: f64,
}

impl Tangent {
    /// The part of a derivative that comes from this number.
    fn part(&self, derivative: f64) -> f64 {
        // what does not change has no slope, wherever the function is steep
        match self.slope == 0.0 {
            true => 0.0,
            false => derivative * self.slope,
        }
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
    fn one(&self, function: Unary) -> Self {
        let (x, value) = (self.value, self.value.one(function));
        let by = match function {
            Unary::Negate => -1.0,
            Unary::Sqrt => 0.5 / value,
            Unary::Abs => x.sign(),
            Unary::Sin => x.cos(),
            Unary::Cos => -x.sin(),
            Unary::Tan => 1.0 + value * value,
            Unary::Asin => 1.0 / steepness(x),
            Unary::Acos => -1.0 / steepness(x),
            Unary::Atan => 1.0 / (1.0 + x * x),
            Unary::Exp => value,
            Unary::Ln => 1.0 / x,
            Unary::Floor | Unary::Ceil | Unary::Round | Unary::Step => return Tangent::of(value),
        };
        let slope = self.part(by);
        Tangent { value, slope }
    }
    fn two(&self, other: &Self, function: Binary) -> Self {
        let (x, y) = (self.value, other.value);
        let value = x.two(&y, function);
        let [one, two] = match function {
            Binary::Add => [1.0, 1.0],
            Binary::Subtract => [1.0, -1.0],
            Binary::Multiply => [y, x],
            Binary::Divide => [1.0 / y, -value / y],
            Binary::Power => [y * x.powf(y - 1.0), value * x.ln()],
            Binary::Min => return if x <= y { *self } else { *other },
            Binary::Max => return if x >= y { *self } else { *other },
            Binary::Hypot => [x / value, y / value],
            Binary::Atan2 => {
                let square = x * x + y * y;
                [y / square, -x / square]
            }
        };
        let slope = self.part(one) + other.part(two);
        Tangent { value, slope }
    }
}

/// √(1 − x²), with its digits near one.
fn steepness(x: f64) -> f64 {
    ((1.0 - x) * (1.0 + x)).sqrt()
}
