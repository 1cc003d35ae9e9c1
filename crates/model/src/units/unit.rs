//! A unit as a number, and what is wrong with one.

use std::f64::consts::PI;

use crate::dimension::{Powers, powers};

/// A unit: num/den · 10^ten · π^pi in SI, and its exponents.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unit {
    /// Its exponents.
    pub powers: Powers,
    pub(super) num: f64,
    pub(super) den: f64,
    pub(super) ten: i32,
    pub(super) pi: i32,
}

/// What is wrong with a unit text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum UnitFault {
    /// There is none.
    Missing,
    /// No unit has this symbol; the nearest that one has.
    Unknown {
        symbol: String,
        nearest: Option<&'static str>,
    },
    /// Neither a product, a quotient nor a power of units.
    Malformed,
    /// Too many factors or too high a power.
    TooLarge,
}

impl UnitFault {
    /// What is wrong with a text.
    pub fn message(&self, text: &str) -> String {
        match self {
            UnitFault::Unknown { symbol, .. } => format!("unknown unit {symbol:?}"),
            UnitFault::Missing | UnitFault::Malformed => {
                format!("{text:?} cannot be read as a unit")
            }
            UnitFault::TooLarge => format!("{text:?} is too much of a unit"),
        }
    }

    /// What was probably meant.
    pub fn hint(&self) -> Option<String> {
        match self {
            UnitFault::Unknown { nearest, .. } => {
                nearest.map(|near| format!("did you mean {near:?}?"))
            }
            UnitFault::Missing | UnitFault::Malformed | UnitFault::TooLarge => None,
        }
    }
}

impl Unit {
    pub(super) const ONE: Unit = Unit {
        powers: powers(0, 0, 0, 0),
        num: 1.0,
        den: 1.0,
        ten: 0,
        pi: 0,
    };

    /// The SI unit of a dimension.
    pub fn si(powers: Powers) -> Unit {
        Unit {
            powers,
            ..Unit::ONE
        }
    }

    /// The same unit, per second^order.
    pub fn per_second(self, order: i32) -> Unit {
        Unit {
            powers: self.powers.per_second(order),
            ..self
        }
    }

    /// A decimal number of this unit, in SI: rounded once where the factor is a power of ten.
    pub fn to_si(self, number: &str) -> f64 {
        let plain: f64 = number.parse().unwrap_or(f64::NAN);
        if self.pi != 0 {
            return plain * self.factor();
        }
        if self.num == 1.0 && self.den == 1.0 {
            return shifted(number, self.ten).unwrap_or(plain * self.factor());
        }
        // whole numbers times whole factors are exact, and so are powers of ten up to 10²²
        match self.ten {
            -22..0 => plain * self.num / (self.den * 10f64.powi(-self.ten)),
            0..=22 => plain * self.num * 10f64.powi(self.ten) / self.den,
            _ => plain * self.factor(),
        }
    }

    /// A number of this unit in another one of the same dimension; `None` if it is not.
    pub fn convert(self, number: f64, to: Unit) -> Option<f64> {
        (self.powers == to.powers).then(|| number * (self.factor() / to.factor()))
    }

    pub(super) fn factor(self) -> f64 {
        let scale: f64 = format!("1e{}", self.ten).parse().unwrap_or(f64::NAN);
        match self.pi {
            0 => self.num / self.den * scale,
            1 => PI * self.num / self.den * scale,
            -1 => self.num / (self.den * PI) * scale,
            pi => self.num / self.den * PI.powi(pi) * scale,
        }
    }

    pub(super) fn times(self, other: Unit, power: i32) -> Unit {
        let (num, den) = if power < 0 {
            (other.den, other.num)
        } else {
            (other.num, other.den)
        };
        let count = power.abs();
        let mut unit = Unit {
            powers: Powers {
                length: self.powers.length + power * other.powers.length,
                mass: self.powers.mass + power * other.powers.mass,
                time: self.powers.time + power * other.powers.time,
                angle: self.powers.angle + power * other.powers.angle,
            },
            num: self.num * num.powi(count),
            den: self.den * den.powi(count),
            ten: self.ten + power * other.ten,
            pi: self.pi + power * other.pi,
        };
        // mm/mm, ft/ft and the like are plain again
        if unit.num == unit.den {
            (unit.num, unit.den) = (1.0, 1.0);
        }
        unit
    }
}

/// The decimal number with its point moved, rounded once.
fn shifted(number: &str, ten: i32) -> Option<f64> {
    let (mantissa, exponent) = match number.split_once(['e', 'E']) {
        Some((mantissa, exponent)) => (mantissa, exponent.parse::<i32>().ok()?),
        None => (number, 0),
    };
    format!("{mantissa}e{}", exponent.checked_add(ten)?)
        .parse()
        .ok()
}
