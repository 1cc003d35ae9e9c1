//! How parameters are written: their names, and text with a unit.

use super::super::node::excerpt;
use super::super::units::{Unit, UnitFault, split_quantity, with_decimal_point};
use super::function::{PI, RESERVED};
use super::number::FUNCTIONS;
use super::{Expression, Fault, Quantity};

/// How a parameter is written.
pub enum Written {
    /// A number, or text with a unit.
    Value(Quantity),
    /// An expression of others.
    Expression(Expression),
    /// What was complained about.
    Faulty,
}

/// Why a name can't be one of a parameter, and what would be.
pub fn refused_name(name: &str) -> Option<(String, &'static str)> {
    let letters = |c: char| c.is_ascii_alphanumeric() || c == '_';
    if name.is_empty()
        || !name.chars().all(letters)
        || name.starts_with(|c: char| c.is_ascii_digit())
    {
        let message =
            "the name of a parameter consists of letters, digits and _, with a letter first";
        return Some((message.into(), "as in crank_length or r2"));
    }
    if name == PI || name == "note" || FUNCTIONS[..RESERVED].iter().any(|row| row.0 == name) {
        return Some((
            format!("{name:?} has a meaning of its own"),
            "give the parameter another name",
        ));
    }
    None
}

/// Text with a unit.
pub fn quantity(text: &str) -> Result<Quantity, Fault> {
    if let Some(meant) = with_decimal_point(text) {
        let hint = format!("a decimal point is a point: {:?}", excerpt(&meant));
        return Err(Fault::new("a number has no comma").hint(hint));
    }
    let Some((number, unit)) = split_quantity(text) else {
        let fault = Fault::new("this does not begin with a number");
        return Err(fault.hint(
            "a number, text with a unit such as \"5 mm\", or an expression such as \"=2*r\"",
        ));
    };
    let short = excerpt(unit);
    let unit = Unit::parse(unit).map_err(|found| match found {
        UnitFault::Missing => {
            Fault::new("the unit is missing").hint("write a plain number without quotes")
        }
        UnitFault::Unknown { symbol, nearest } => {
            let fault = Fault::new(format!("unknown unit {:?}", excerpt(&symbol)));
            let near = nearest.map(|near| format!("did you mean {near:?}?"));
            fault.hint(near.unwrap_or_else(|| "an expression begins with =".into()))
        }
        UnitFault::Malformed => Fault::new(format!("{short:?} cannot be read as a unit")),
        UnitFault::TooLarge => Fault::new(format!("{short:?} is too much of a unit")),
    })?;
    let value = unit.to_si(number);
    if value.is_finite() {
        Ok(Quantity::si(value, unit.powers))
    } else {
        Err(Fault::new("the number is too large for a double"))
    }
}
