//! What expressions calculate with: doubles, enclosing intervals, and either of both with derivatives by the parameters.

use std::cmp::Ordering;

/// A number of an expression; of an interval a predicate says whether any number in it is so.
pub trait Number: Clone {
    /// A constant.
    fn of(value: f64) -> Self;
    /// As messages show it.
    fn shown(&self) -> f64;
    /// Whether it is finite altogether.
    fn is_finite(&self) -> bool;
    /// Whether it may be zero.
    fn is_zero(&self) -> bool;
    /// Whether it may be below zero.
    fn is_negative(&self) -> bool;
    /// Whether it may be above one, or below minus one.
    fn exceeds_one(&self) -> bool;
    /// The only number that it may be, where there is only one.
    fn single(&self) -> Option<f64>;
    /// Nearly the only number that it may be, but for rounding.
    fn nearly(&self) -> Option<f64> {
        self.single()
    }
    /// −x.
    fn negate(&self) -> Self;
    /// x + y.
    fn add(&self, other: &Self) -> Self;
    /// x − y.
    fn subtract(&self, other: &Self) -> Self;
    /// x·y.
    fn multiply(&self, other: &Self) -> Self;
    /// x/y.
    fn divide(&self, other: &Self) -> Self;
    /// x^y.
    fn power(&self, exponent: &Self) -> Self;
    /// √x.
    fn sqrt(&self) -> Self;
    /// |x|.
    fn abs(&self) -> Self;
    /// The smaller of both.
    fn min(&self, other: &Self) -> Self;
    /// The greater of both.
    fn max(&self, other: &Self) -> Self;
    /// √(x² + y²).
    fn hypot(&self, other: &Self) -> Self;
    /// The angle of (x, self).
    fn atan2(&self, x: &Self) -> Self;
    /// The sine.
    fn sin(&self) -> Self;
    /// The cosine.
    fn cos(&self) -> Self;
    /// The tangent.
    fn tan(&self) -> Self;
    /// The inverse sine.
    fn asin(&self) -> Self;
    /// The inverse cosine.
    fn acos(&self) -> Self;
    /// The inverse tangent.
    fn atan(&self) -> Self;
    /// eˣ.
    fn exp(&self) -> Self;
    /// The natural logarithm.
    fn ln(&self) -> Self;
    /// The greatest whole number that is not greater.
    fn floor(&self) -> Self;
    /// The least whole number that is not less.
    fn ceil(&self) -> Self;
    /// The nearest whole number, of two the one further from zero.
    fn round(&self) -> Self;
    /// 1 from zero on, 0 below.
    fn step(&self) -> Self;
    /// −1, 0 or 1.
    fn sign(&self) -> Self {
        self.step().subtract(&self.negate().step())
    }
    /// What is left of x when it is divided by y, from zero to y.
    fn modulo(&self, period: &Self) -> Self {
        self.subtract(&self.divide(period).floor().multiply(period))
    }
}

/// A number by which derivatives can be carried.
pub trait Real: Number {
    /// Which of both is greater; nothing where that is not sure.
    fn order(&self, other: &Self) -> Option<Ordering>;
    /// Whether the largest whole number below `self + shift` may change here.
    fn jumps(&self, shift: f64) -> bool;
    /// A constant that is known to some units in the last place.
    fn about(value: f64) -> Self;
}

impl Number for f64 {
    fn of(value: f64) -> f64 {
        value
    }
    fn shown(&self) -> f64 {
        *self
    }
    fn is_finite(&self) -> bool {
        f64::is_finite(*self)
    }
    fn is_zero(&self) -> bool {
        *self == 0.0
    }
    fn is_negative(&self) -> bool {
        *self < 0.0
    }
    fn exceeds_one(&self) -> bool {
        f64::abs(*self) > 1.0
    }
    fn single(&self) -> Option<f64> {
        Some(*self)
    }
    fn negate(&self) -> f64 {
        -self
    }
    fn add(&self, other: &f64) -> f64 {
        self + other
    }
    fn subtract(&self, other: &f64) -> f64 {
        self - other
    }
    fn multiply(&self, other: &f64) -> f64 {
        self * other
    }
    fn divide(&self, other: &f64) -> f64 {
        self / other
    }
    fn power(&self, exponent: &f64) -> f64 {
        self.powf(*exponent)
    }
    fn sqrt(&self) -> f64 {
        f64::sqrt(*self)
    }
    fn abs(&self) -> f64 {
        f64::abs(*self)
    }
    fn min(&self, other: &f64) -> f64 {
        f64::min(*self, *other)
    }
    fn max(&self, other: &f64) -> f64 {
        f64::max(*self, *other)
    }
    fn hypot(&self, other: &f64) -> f64 {
        f64::hypot(*self, *other)
    }
    fn atan2(&self, x: &f64) -> f64 {
        f64::atan2(*self, *x)
    }
    fn sin(&self) -> f64 {
        f64::sin(*self)
    }
    fn cos(&self) -> f64 {
        f64::cos(*self)
    }
    fn tan(&self) -> f64 {
        f64::tan(*self)
    }
    fn asin(&self) -> f64 {
        f64::asin(*self)
    }
    fn acos(&self) -> f64 {
        f64::acos(*self)
    }
    fn atan(&self) -> f64 {
        f64::atan(*self)
    }
    fn exp(&self) -> f64 {
        f64::exp(*self)
    }
    fn ln(&self) -> f64 {
        f64::ln(*self)
    }
    fn floor(&self) -> f64 {
        f64::floor(*self)
    }
    fn ceil(&self) -> f64 {
        f64::ceil(*self)
    }
    fn round(&self) -> f64 {
        f64::round(*self)
    }
    fn step(&self) -> f64 {
        match self.partial_cmp(&0.0) {
            Some(Ordering::Less) => 0.0,
            Some(Ordering::Equal | Ordering::Greater) => 1.0,
            None => f64::NAN,
        }
    }
}

impl Real for f64 {
    fn order(&self, other: &f64) -> Option<Ordering> {
        self.partial_cmp(other)
    }
    fn about(value: f64) -> f64 {
        value
    }
    fn jumps(&self, shift: f64) -> bool {
        (self + shift).fract() == 0.0
    }
}
