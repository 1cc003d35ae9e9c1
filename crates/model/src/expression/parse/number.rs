//! Numbers in expressions, and the units behind them.

use super::super::program::Do;
use super::super::quantity::{Fault, Quantity};
use super::super::steps::Misfit;
use super::{Parser, Read, fault, is_name, is_unit};
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
        self.step(at, Do::Push(value));
        Ok(())
    }

    /// Moves behind the unit that begins here: symbols, whole powers, products and quotients of them, and brackets of such.
    fn unit_end(&mut self, number: &str) -> Read<()> {
        let (first, word) = (self.at, self.word());
        let is_parameter = (self.find)(word).is_some();
        if is_parameter && !is_unit(word) || self.is_used(word) {
            let said = Fault::new(format!("{word:?} where a unit or an operator is expected"));
            return fault(
                first,
                said.hint(format!("a product is written with *: {number}*{word}")),
            );
        }
        self.at += word.len();
        if !is_unit(word) {
            // what is wrong with it is said by the reader of units
            return Ok(());
        }
        loop {
            self.unit_power(first, number)?;
            let end = self.at;
            let factor = match self.take(&['*', '·', '×', '/']) {
                Some(_) => self.factor()?,
                None => None,
            };
            let Some(length) = factor else {
                self.at = end;
                break;
            };
            self.at += length;
        }
        // 2 m is no 2*m, which should be said where m is a parameter
        if is_parameter && self.at == first + word.len() {
            return fault(first, two_meanings(word));
        }
        Ok(())
    }

    /// Moves behind the power of a symbol or of a bracket, where one stands here.
    fn unit_power(&mut self, first: usize, number: &str) -> Read<()> {
        let end = self.at;
        if self.peek() != Some('^') {
            self.at = end;
            return Ok(());
        }
        let exponent = self.rest()[1..].trim_start().trim_start_matches('-');
        let rest = exponent.trim_start_matches(|c: char| c.is_ascii_digit());
        if rest.len() == exponent.len() {
            let said = Fault::new("the power of a unit is a whole number");
            let unit = &self.text[first..end];
            return fault(
                self.at,
                said.hint(format!(
                    "put the quantity in brackets: ({number} {unit})^ …"
                )),
            );
        }
        self.at = self.text.len() - rest.len();
        Ok(())
    }

    /// How long the symbol or the bracket here is, if it goes on with the unit that an operator joins it to.
    fn factor(&mut self) -> Read<Option<usize>> {
        self.skip_blanks();
        let (at, word) = (self.at, self.word());
        if self.rest().starts_with('(') {
            return Ok(self.unit_bracket());
        }
        if !is_unit(word) || self.is_used(word) {
            return Ok(None);
        }
        if (self.find)(word).is_some() {
            return fault(at, two_meanings(word));
        }
        Ok((!self.is_known(word)).then_some(word.len()))
    }

    /// How long a bracket is that has nothing but units in it, such as (rad/s).
    fn unit_bracket(&self) -> Option<usize> {
        let inner = &self.rest()[1..self.rest().find(')')?];
        let is_power = |word: &str| word.chars().all(|c| c.is_ascii_digit());
        let mut words = inner.split(|c| !is_name(c)).filter(|word| !word.is_empty());
        let units = words.all(|word| {
            // Names that are known come first: what is no unit is compared with all that are, to be reported.
            is_power(word) || (self.find)(word).is_none() && !self.is_known(word) && is_unit(word)
        });
        let starts = inner.trim_start().starts_with(char::is_alphabetic);
        (units && starts && Unit::parse(inner).is_ok()).then(|| inner.len() + 2)
    }

    /// Whether the word that begins here is called, as in min( … ), or owns what stands behind it, as in s.angle.
    fn is_used(&self, word: &str) -> bool {
        let rest = &self.rest()[word.len()..];
        let part = rest.strip_prefix('.').and_then(|rest| rest.chars().next());
        part.is_some_and(|c| c.is_alphabetic() || c == '_')
            || rest.trim_start().starts_with('(') && self.is_function(word)
    }

    /// Whether a name that is no parameter stands for a result, or for time.
    fn is_known(&self, word: &str) -> bool {
        self.results
            .is_some_and(|results| results.find(word).is_some())
    }
}

fn two_meanings(word: &str) -> Fault {
    let said = Fault::new(format!("{word:?} is a unit here, and a parameter, too"));
    said.hint(format!(
        "put the parameter in brackets, *({word}), or give it another name"
    ))
}

fn unit_fault(unit: &str, found: &UnitFault) -> Fault {
    let said = Fault::new(found.message(unit));
    match found {
        UnitFault::Unknown { .. } => {
            let near = found.hint();
            said.hint(near.unwrap_or_else(|| "a product is written with *".to_owned()))
        }
        UnitFault::Missing | UnitFault::Malformed | UnitFault::TooLarge => said,
    }
}
