//! Numbers with a dimension, as values of parameters.

use std::fmt;

use linkdyn_model::{Powers, Unit};

use crate::error::Error;

/// A number with its dimension, held in SI units.
///
/// # Examples
/// ```
/// use linkdyn::prelude::*;
///
/// assert_eq!(mm(120.0).si(), 0.12);
/// assert_eq!(mm(120.0).to_string(), "0.12 m");
/// assert_eq!(Quantity::new(2.5, "kN/mm")?.si(), 2.5e6);
/// # Ok::<(), linkdyn::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quantity {
    si: f64,
    powers: Powers,
}

impl Quantity {
    /// `value` in a unit such as `"mm"`, `"kg*mm^2"` or `"N*m/(rad/s)"`.
    ///
    /// # Errors
    /// [`Error::Unit`] where the text is no unit.
    pub fn new(value: f64, unit: &str) -> Result<Self, Error> {
        let unit = Unit::parse(unit).map_err(|_| Error::Unit(unit.to_owned()))?;
        Ok(Quantity {
            // From decimal digits, so that it is the double nearest to what stands there.
            si: unit.to_si(&format!("{value:?}")),
            powers: unit.powers,
        })
    }

    /// `si` in the SI unit that `unit` names; empty of a plain number. `None` if that is no unit of whole powers.
    pub(crate) fn in_si(si: f64, unit: &str) -> Option<Self> {
        let powers = match unit {
            "" => Powers::default(),
            unit => Unit::parse(unit).ok()?.powers,
        };
        Some(Quantity { si, powers })
    }

    /// The value in SI units.
    pub fn si(self) -> f64 {
        self.si
    }
    /// Whether two quantities can be put for each other.
    pub(crate) fn same_dimension(self, other: Quantity) -> bool {
        self.powers == other.powers
    }

    /// Its unit in SI, such as `m` or `N*m/rad`; empty of a plain number.
    pub fn unit(self) -> String {
        self.powers.unit()
    }
}

/// A plain number, without a dimension.
impl From<f64> for Quantity {
    fn from(si: f64) -> Self {
        Quantity {
            si,
            powers: Powers::default(),
        }
    }
}

impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.unit() {
            unit if unit.is_empty() => write!(f, "{}", self.si),
            unit => write!(f, "{} {unit}", self.si),
        }
    }
}

/// A value in a unit of the table.
fn known(value: f64, unit: &str) -> Quantity {
    Quantity::new(value, unit).expect("a unit of the table")
}

/// A length in metres.
pub fn m(value: f64) -> Quantity {
    known(value, "m")
}

/// A length in millimetres.
pub fn mm(value: f64) -> Quantity {
    known(value, "mm")
}

/// A length in micrometres.
pub fn um(value: f64) -> Quantity {
    known(value, "um")
}

/// An angle in radians.
pub fn rad(value: f64) -> Quantity {
    known(value, "rad")
}

/// An angle in degrees.
pub fn deg(value: f64) -> Quantity {
    known(value, "deg")
}

/// A mass in kilograms.
pub fn kg(value: f64) -> Quantity {
    known(value, "kg")
}

/// A time in seconds.
pub fn s(value: f64) -> Quantity {
    known(value, "s")
}

/// A force in newtons.
pub fn newton(value: f64) -> Quantity {
    known(value, "N")
}

/// A torque in newton metres.
pub fn newton_metre(value: f64) -> Quantity {
    known(value, "N*m")
}

/// An angular velocity in revolutions per minute.
pub fn rpm(value: f64) -> Quantity {
    known(value, "rpm")
}
