//! What expressions calculate with: doubles, enclosing intervals, and either of both with derivatives by the parameters.

use std::cmp::Ordering;

/// A function of one number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unary {
    /// −x.
    Negate,
    /// √x.
    Sqrt,
    /// |x|.
    Abs,
    /// The sine.
    Sin,
    /// The cosine.
    Cos,
    /// The tangent.
    Tan,
    /// The inverse sine.
    Asin,
    /// The inverse cosine.
    Acos,
    /// The inverse tangent.
    Atan,
    /// eˣ.
    Exp,
    /// The natural logarithm.
    Ln,
    /// The greatest whole number that is not greater.
    Floor,
    /// The least whole number that is not less.
    Ceil,
    /// The nearest whole number, of two the one further from zero.
    Round,
    /// 1 from zero on, 0 below.
    Step,
}

/// A function of two numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Binary {
    /// x + y.
    Add,
    /// x − y.
    Subtract,
    /// x·y.
    Multiply,
    /// x/y.
    Divide,
    /// x^y.
    Power,
    /// The smaller of both.
    Min,
    /// The greater of both.
    Max,
    /// √(x² + y²).
    Hypot,
    /// The angle of a vector, from its y and x.
    Atan2,
}

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
    /// A function of it.
    fn one(&self, function: Unary) -> Self;
    /// A function of it and another one.
    fn two(&self, other: &Self, function: Binary) -> Self;
    /// −x.
    fn negate(&self) -> Self {
        self.one(Unary::Negate)
    }
    /// x + y.
    fn add(&self, other: &Self) -> Self {
        self.two(other, Binary::Add)
    }
    /// x − y.
    fn subtract(&self, other: &Self) -> Self {
        self.two(other, Binary::Subtract)
    }
    /// x·y.
    fn multiply(&self, other: &Self) -> Self {
        self.two(other, Binary::Multiply)
    }
    /// x/y.
    fn divide(&self, other: &Self) -> Self {
        self.two(other, Binary::Divide)
    }
    /// x².
    fn square(&self) -> Self {
        self.two(&Self::of(2.0), Binary::Power)
    }
    /// −1, 0 or 1.
    fn sign(&self) -> Self {
        let below = self.negate().one(Unary::Step);
        self.one(Unary::Step).subtract(&below)
    }
    /// What is left of x when it is divided by y, from zero to y.
    fn modulo(&self, period: &Self) -> Self {
        let whole = self.divide(period).one(Unary::Floor);
        self.subtract(&whole.multiply(period))
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
        self.abs() > 1.0
    }
    fn single(&self) -> Option<f64> {
        Some(*self)
    }
    fn one(&self, function: Unary) -> f64 {
        match function {
            Unary::Negate => -self,
            Unary::Sqrt => self.sqrt(),
            Unary::Abs => self.abs(),
            Unary::Sin => self.sin(),
            Unary::Cos => self.cos(),
            Unary::Tan => self.tan(),
            Unary::Asin => self.asin(),
            Unary::Acos => self.acos(),
            Unary::Atan => self.atan(),
            Unary::Exp => self.exp(),
            Unary::Ln => self.ln(),
            Unary::Floor => self.floor(),
            Unary::Ceil => self.ceil(),
            Unary::Round => self.round(),
            Unary::Step if self.is_nan() => f64::NAN,
            Unary::Step => f64::from(u8::from(*self >= 0.0)),
        }
    }
    fn two(&self, other: &f64, function: Binary) -> f64 {
        match function {
            Binary::Add => self + other,
            Binary::Subtract => self - other,
            Binary::Multiply => self * other,
            Binary::Divide => self / other,
            Binary::Power => self.powf(*other),
            Binary::Min => self.min(*other),
            Binary::Max => self.max(*other),
            Binary::Hypot => self.hypot(*other),
            Binary::Atan2 => self.atan2(*other),
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

/// A function of one number, of two, or of others.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Function {
    One(Unary),
    Two(Binary),
    /// The least of all.
    Min,
    /// The greatest of all.
    Max,
    Sign,
    Clamp,
    Modulo,
    /// Straight between points.
    Table,
}

/// Name, function, least and most values that it takes.
pub(super) const FUNCTIONS: [(&str, Function, usize, usize); 22] = [
    ("sin", Function::One(Unary::Sin), 1, 1),
    ("cos", Function::One(Unary::Cos), 1, 1),
    ("tan", Function::One(Unary::Tan), 1, 1),
    ("asin", Function::One(Unary::Asin), 1, 1),
    ("acos", Function::One(Unary::Acos), 1, 1),
    ("atan", Function::One(Unary::Atan), 1, 1),
    ("atan2", Function::Two(Binary::Atan2), 2, 2),
    ("sqrt", Function::One(Unary::Sqrt), 1, 1),
    ("abs", Function::One(Unary::Abs), 1, 1),
    ("min", Function::Min, 2, usize::MAX),
    ("max", Function::Max, 2, usize::MAX),
    ("hypot", Function::Two(Binary::Hypot), 2, 2),
    ("exp", Function::One(Unary::Exp), 1, 1),
    ("ln", Function::One(Unary::Ln), 1, 1),
    ("floor", Function::One(Unary::Floor), 1, 1),
    ("ceil", Function::One(Unary::Ceil), 1, 1),
    ("round", Function::One(Unary::Round), 1, 1),
    ("step", Function::One(Unary::Step), 1, 1),
    ("sign", Function::Sign, 1, 1),
    ("clamp", Function::Clamp, 3, 3),
    ("mod", Function::Modulo, 2, 2),
    ("table", Function::Table, 5, usize::MAX),
];

impl Function {
    /// Its name; empty of a sign between values.
    pub fn word(self) -> &'static str {
        let row = FUNCTIONS.iter().find(|row| row.1 == self);
        row.map_or("", |row| row.0)
    }
}
