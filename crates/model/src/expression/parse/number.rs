//! Numbers in expressions, and the units behind them.

use super::super::quantity::{Fault, Quantity};
use super::super::{Misfit, Step};
use super::{Parser, Read, fault};
use crate::units::{Unit, UnitFault, split_quantity};

impl Parser<'_> {
    /// A number, and the unit behind it.
    pub(super) fn number(&mut self) -> Read<()> {
        let at = self.at;
        let Some((number, _)) = split_quantity(self.rest()) else {
            return fault(at, Fault::new("\".\" where a value is expected"));
        };
        self.at += number.len();
        let start = {
            self.skip_blanks();
            self.at
        };
        let word = self.word();
        let value = if word.is_empty() || word.starts_with(|c: char| c.is_ascii_digit()) {
            Quantity::plain(number.parse().unwrap_or(f64::INFINITY))
        } else {
            self.unit_end(number)?;
            let unit = self.text[start..self.at].trim();
            let unit = Unit::parse(unit).map_err(|found| Misfit {
                at: start,
                fault: unit_fault(unit, &found),
            })?;
            Quantity::si(unit.to_si(number), unit.powers)
        };
        if !value.value.is_finite() {
            return fault(at, Fault::new("the number is too large for a double"));
        }
        self.steps.push((at, Step::Push(value)));
        Ok(())
    }

    /// Moves behind the unit that begins here: symbols, whole powers, products and quotients of them.
    fn unit_end(&mut self, number: &str) -> Read<()> {
        let first = self.at;
        loop {
            let (at, word) = (self.at, self.word());
            let is_parameter = (self.find)(word).is_some();
            if !is_unit(word) && is_parameter {
                let said = Fault::new(format!("{word:?} where a unit or an operator is expected"));
                return fault(
                    at,
                    said.hint(format!("a product is written with *: {number}*{word}")),
                );
            }
            if is_parameter && at > first {
                return fault(at, two_meanings(word));
            }
            self.at += word.len();
            if !is_unit(word) {
                // what is wrong with it is said by the reader of units
                return Ok(());
            }
            let mut end = self.at;
            if self.peek() == Some('^') {
                let exponent = self.rest()[1..].trim_start().trim_start_matches('-');
                let digits = exponent.len()
                    - exponent
                        .trim_start_matches(|c: char| c.is_ascii_digit())
                        .len();
                if digits == 0 {
                    let said = Fault::new("the power of a unit is a whole number");
                    return fault(
                        self.at,
                        said.hint(format!(
                            "put the quantity in brackets: ({number} {word})^ …"
                        )),
                    );
                }
                end = self.text.len() - exponent.len() + digits;
            }
            self.at = end;
            if self.take(&['*', '·', '×', '/']).is_some() {
                self.skip_blanks();
                if is_unit(self.word()) {
                    continue;
                }
            }
            self.at = end;
            // 2 m is no 2*m, which should be said where m is a parameter
            return if is_parameter && end == at + word.len() {
                fault(at, two_meanings(word))
            } else {
                Ok(())
            };
        }
    }
}

/// Whether this is the symbol of a unit, perhaps with ² or ³ behind it.
pub fn is_unit(word: &str) -> bool {
    !word.starts_with('1') && Unit::parse(word.trim_end_matches(['²', '³'])).is_ok()
}

fn two_meanings(word: &str) -> Fault {
    let said = Fault::new(format!("{word:?} is a unit here, and a parameter, too"));
    said.hint(format!(
        "put the parameter in brackets, *({word}), or give it another name"
    ))
}

fn unit_fault(unit: &str, found: &UnitFault) -> Fault {
    match found {
        UnitFault::Unknown { symbol, nearest } => {
            let said = Fault::new(format!("unknown unit {symbol:?}"));
            match nearest {
                Some(near) => said.hint(format!("did you mean {near:?}?")),
                None => said.hint("a product is written with *"),
            }
        }
        UnitFault::TooLarge => Fault::new(format!("{unit:?} is too much of a unit")),
        UnitFault::Missing | UnitFault::Malformed => {
            Fault::new(format!("{unit:?} cannot be read as a unit"))
        }
    }
}
