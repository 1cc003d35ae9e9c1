//! A number with its dimension, through sums, products, powers and functions; always in SI.
//!
//! Exponents of length, mass, time and angle may be fractions (√ of a length), and are kept in twelfths. The radian counts
//! as a dimension, so that Hz is not rad/s; where lengths or masses are about, one radian too many is dropped, as in r·ω.

use super::super::dimension::Powers;
use super::super::error::Complaint;
use super::number::{Binary, Function, Number, Unary};

/// One whole power.
const WHOLE: i32 = 12;
/// Highest power that is carried.
const MOST: i32 = 24 * WHOLE;
/// The powers of an angle.
const ANGLE: [i32; 4] = [0, 0, 0, WHOLE];

/// Where a number without dimension comes from; of two, an operation keeps the greater.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Pure {
    /// Written as a plain number.
    Plain,
    /// Made with π, which is at home in radians.
    Circular,
    /// Quotient of two quantities of one dimension, or a sine.
    Ratio,
}

/// A number with its dimension.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quantity<N = f64> {
    /// In SI.
    pub value: N,
    /// Twelfths of the exponents of length, mass, time, angle.
    pub(super) exponents: [i32; 4],
    /// Where it comes from.
    pub pure: Pure,
}

/// What is wrong, and what would mend it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fault {
    pub message: String,
    pub hint: Option<String>,
}

impl Fault {
    pub fn new(message: impl Into<String>) -> Self {
        Fault {
            message: message.into(),
            hint: None,
        }
    }

    pub fn hint(mut self, hint: impl Into<String>) -> Self {
        self.hint = Some(hint.into());
        self
    }

    /// What is reported about it at a path.
    pub fn at(self, path: impl Into<String>) -> Complaint {
        Complaint {
            hint: self.hint,
            ..Complaint::new(path, self.message)
        }
    }
}

/// What an operation gives.
pub type Outcome<N = f64> = Result<Quantity<N>, Fault>;

pub(super) fn whole(powers: Powers) -> [i32; 4] {
    [powers.length, powers.mass, powers.time, powers.angle].map(|power| power.saturating_mul(WHOLE))
}

impl Quantity {
    /// A plain number.
    pub fn plain(value: f64) -> Self {
        Quantity {
            value,
            exponents: [0; 4],
            pure: Pure::Plain,
        }
    }

    pub fn pi() -> Self {
        Quantity {
            pure: Pure::Circular,
            ..Quantity::plain(std::f64::consts::PI)
        }
    }

    /// A number in the SI unit of these powers.
    pub fn si(value: f64, powers: Powers) -> Self {
        Quantity {
            value,
            exponents: whole(powers),
            pure: Pure::Ratio,
        }
    }

    /// A number in SI, with exponents of length, mass, time and angle.
    pub fn of_powers(value: f64, powers: [f64; 4]) -> Self {
        Quantity {
            value,
            // exponents are bounded
            exponents: powers.map(|power| (power * f64::from(WHOLE)).round() as i32),
            pure: Pure::Ratio,
        }
    }

    /// Exponents of length, mass, time and angle.
    pub fn powers(&self) -> [f64; 4] {
        self.exponents
            .map(|twelfths| f64::from(twelfths) / f64::from(WHOLE))
    }
}

impl<N: Number> Quantity<N> {
    /// Another number of the same dimension.
    pub fn with_value<M>(&self, value: M) -> Quantity<M> {
        Quantity {
            value,
            exponents: self.exponents,
            pure: self.pure,
        }
    }

    /// A number made of others.
    fn made(value: N, exponents: [i32; 4], pure: Pure) -> Outcome<N> {
        if !value.is_finite() {
            return Err(Fault::new("the result is too large for a double"));
        }
        if exponents.iter().any(|power| power.abs() > MOST) {
            return Err(Fault::new("the power of a unit gets too high"));
        }
        Ok(Quantity {
            value,
            exponents,
            pure,
        })
    }

    /// Whether it has no dimension.
    pub fn is_pure(&self) -> bool {
        self.exponents == [0; 4]
    }

    /// Whether it may stand where a quantity of these powers is wanted.
    pub fn fits(&self, wanted: Powers) -> bool {
        let wanted = whole(wanted);
        let per_radian_left_out =
            wanted[3] < 0 && self.exponents[3] == 0 && self.exponents[..3] == wanted[..3];
        per_radian_left_out || alike(self.exponents, wanted)
    }

    /// Whether it may be added to another one.
    pub fn is_like(&self, other: &Self) -> bool {
        alike(self.exponents, other.exponents)
    }

    /// The dimension that both have, for what `verb` does.
    fn common(&self, other: &Self, verb: &str) -> Result<[i32; 4], Fault> {
        if alike(self.exponents, other.exponents) {
            let radians = self.exponents[3].min(other.exponents[3]);
            return Ok([
                self.exponents[0],
                self.exponents[1],
                self.exponents[2],
                radians,
            ]);
        }
        let fault = Fault::new(format!(
            "{} and {} can't be {verb}",
            self.words(),
            other.words()
        ));
        Err(if self.is_pure() != other.is_pure() {
            let unit = if self.is_pure() {
                other.unit()
            } else {
                self.unit()
            };
            fault.hint(format!("a number gets a unit as in 2 {unit}"))
        } else {
            fault
        })
    }

    /// A function of it and another one.
    pub fn two(&self, other: &Self, function: Binary) -> Outcome<N> {
        let (own, others) = (self.exponents, other.exponents);
        let exponents = match function {
            Binary::Add => self.common(other, "added")?,
            Binary::Subtract => self.common(other, "subtracted")?,
            Binary::Min | Binary::Max => self.common(other, "compared")?,
            Binary::Hypot => self.common(other, "the sides of one triangle")?,
            Binary::Multiply => std::array::from_fn(|index| own[index] + others[index]),
            Binary::Divide if other.value.is_zero() => {
                return Err(Fault::new("this divides by zero"));
            }
            Binary::Divide => std::array::from_fn(|index| own[index] - others[index]),
            Binary::Power => self.powered(other)?,
            Binary::Atan2 => {
                self.common(other, "the components of one vector")?;
                return Self::made(self.value.two(&other.value, function), ANGLE, Pure::Ratio);
            }
        };
        let value = self.value.two(&other.value, function);
        Self::made(value, exponents, self.pure.max(other.pure))
    }

    /// The exponents of a power of it.
    fn powered(&self, exponent: &Self) -> Result<[i32; 4], Fault> {
        if !exponent.is_pure() {
            return Err(Fault::new(format!(
                "an exponent is a plain number, not {}",
                exponent.words()
            )));
        }
        if self.value.is_negative() && !is_whole(&exponent.value) {
            return Err(Fault::new(
                "a negative number has no power that is not whole",
            ));
        }
        if self.value.is_zero() && exponent.value.is_negative() {
            return Err(Fault::new("this divides by zero"));
        }
        let mut exponents = [0; 4];
        for (power, own) in exponents.iter_mut().zip(self.exponents) {
            let Some(by) = exponent.value.nearly().or((own == 0).then_some(0.0)) else {
                let message = format!("the exponent of {} must not change", self.words());
                return Err(Fault::new(message));
            };
            let scaled = f64::from(own) * by;
            if scaled.abs() > f64::from(MOST) {
                return Err(Fault::new("the power of a unit gets too high"));
            }
            if (scaled - scaled.round()).abs() > 1e-9 {
                let message = format!(
                    "the exponent of {} must be whole or a simple fraction",
                    self.words()
                );
                return Err(Fault::new(message).hint("as in ^2, ^0.5 or ^(1/3)"));
            }
            // bounded above
            *power = scaled.round() as i32;
        }
        Ok(exponents)
    }

    /// A function of it; of an angle that is a plain number where that can only be radians.
    pub fn one(&self, function: Unary, degrees: bool) -> Outcome<N> {
        let value = || self.value.one(function);
        match function {
            Unary::Negate | Unary::Abs => Ok(self.with_value(value())),
            Unary::Sin | Unary::Cos | Unary::Tan => {
                self.expect_angle(function, degrees)?;
                Self::made(value(), [0; 4], Pure::Ratio)
            }
            Unary::Asin | Unary::Acos | Unary::Atan => {
                self.expect_pure(function)?;
                if function != Unary::Atan && self.value.exceeds_one() {
                    let found = match self.value.single() {
                        Some(value) => format!("this is {value}"),
                        None => "and these go beyond".to_owned(),
                    };
                    let word = Function::One(function).word();
                    let message = format!("{word} takes numbers from -1 to 1, {found}");
                    return Err(Fault::new(message));
                }
                Self::made(value(), ANGLE, Pure::Ratio)
            }
            Unary::Sqrt if self.value.is_negative() => {
                Err(Fault::new("a negative number has no square root"))
            }
            Unary::Sqrt => {
                let half = Quantity {
                    value: N::of(0.5),
                    exponents: [0; 4],
                    pure: self.pure,
                };
                Ok(self.two(&half, Binary::Power)?.with_value(value()))
            }
            Unary::Ln if self.is_pure() && (self.value.is_negative() || self.value.is_zero()) => {
                Err(Fault::new("ln takes numbers greater than zero"))
            }
            Unary::Exp | Unary::Ln | Unary::Floor | Unary::Ceil | Unary::Round => {
                self.expect_pure(function)?;
                Self::made(value(), [0; 4], self.pure)
            }
            Unary::Step => Ok(self.sided(value())),
        }
    }

    /// The value of a function of its sign alone.
    pub fn sided(&self, value: N) -> Self {
        Quantity {
            value,
            exponents: [0; 4],
            pure: Pure::Ratio,
        }
    }

    /// What is left of it when another one is taken off as often as it fits in.
    pub fn modulo(&self, period: &Self) -> Outcome<N> {
        if period.value.is_zero() {
            return Err(Fault::new("this divides by zero"));
        }
        let exponents = self.common(period, "compared")?;
        let value = self.value.modulo(&period.value);
        Self::made(value, exponents, self.pure.max(period.pure))
    }

    fn expect_angle(&self, function: Unary, degrees: bool) -> Result<(), Fault> {
        let word = Function::One(function).word();
        if self.exponents != ANGLE && !self.is_pure() {
            let message = format!("{word} takes an angle, not {}", self.words());
            return Err(Fault::new(message));
        }
        if self.is_pure() && self.pure == Pure::Plain && degrees && self.value.shown() != 0.0 {
            let message =
                format!("{word} of a plain number, although the file's angles are not in radians");
            return Err(Fault::new(message).hint("give it a unit, as in 30 deg or 0.5 rad"));
        }
        Ok(())
    }

    fn expect_pure(&self, function: Unary) -> Result<(), Fault> {
        if self.is_pure() {
            return Ok(());
        }
        let word = Function::One(function).word();
        let fault = Fault::new(format!("{word} takes a plain number, not {}", self.words()));
        Err(fault.hint(format!("divide it by 1 {}", self.unit())))
    }
}

/// Whether it is a whole number.
fn is_whole<N: Number>(number: &N) -> bool {
    number.single().is_some_and(|number| number.fract() == 0.0)
}

/// Whether two are of one dimension; beside lengths and masses radians may be dropped, where none divides.
fn alike(one: [i32; 4], other: [i32; 4]) -> bool {
    let beside = one[0] != 0 || one[1] != 0;
    one[..3] == other[..3] && (one[3] == other[3] || (beside && one[3] >= 0 && other[3] >= 0))
}
