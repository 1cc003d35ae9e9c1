//! The reader of unit texts.

use super::table::{SYMBOLS, nearest};
use super::unit::{Unit, UnitFault};

/// Highest power, number of factors and depth of brackets that a unit text may have.
const MOST: i32 = 12;

impl Unit {
    /// Reads a unit text.
    ///
    /// # Errors
    /// A symbol is unknown, or the text is no product, quotient or power of symbols.
    pub fn parse(text: &str) -> Result<Unit, UnitFault> {
        let unit = Reader::new(text).read()?;
        let factor = unit.factor();
        if factor.is_finite() && factor > 0.0 {
            Ok(unit)
        } else {
            Err(UnitFault::TooLarge)
        }
    }
}

/// Reads products, quotients, powers and brackets.
struct Reader<'a> {
    rest: &'a str,
    factors: i32,
}

impl<'a> Reader<'a> {
    /// Before the first sign.
    fn new(text: &'a str) -> Self {
        Reader {
            rest: text.trim(),
            factors: 0,
        }
    }

    /// Reads all of it.
    fn read(mut self) -> Result<Unit, UnitFault> {
        if self.rest.is_empty() {
            return Err(UnitFault::Missing);
        }
        let unit = self.product(0)?;
        if !self.rest.is_empty() {
            return Err(UnitFault::Malformed);
        }
        Ok(unit)
    }

    fn skip(&mut self, signs: &[char]) -> Option<char> {
        let sign = self
            .rest
            .chars()
            .next()
            .filter(|sign| signs.contains(sign))?;
        self.rest = self.rest[sign.len_utf8()..].trim_start();
        Some(sign)
    }

    fn product(&mut self, depth: i32) -> Result<Unit, UnitFault> {
        let mut unit = Unit::ONE.times(self.power(depth)?, 1);
        loop {
            let sign = match self.skip(&['*', '·', '⋅', '×', '/']) {
                Some('/') => -1,
                Some(_) => 1,
                // a blank is a product, as in "N m"
                None if self.rest.is_empty() || self.rest.starts_with(')') => return Ok(unit),
                None => 1,
            };
            unit = unit.times(self.power(depth)?, sign);
        }
    }

    fn power(&mut self, depth: i32) -> Result<Unit, UnitFault> {
        self.factors += 1;
        if self.factors > MOST || depth > MOST {
            return Err(UnitFault::TooLarge);
        }
        let base = if self.skip(&['(']).is_some() {
            let inner = self.product(depth + 1)?;
            self.skip(&[')']).ok_or(UnitFault::Malformed)?;
            inner
        } else {
            self.symbol()?
        };
        let power = self.exponent()?;
        if power.abs() > MOST {
            return Err(UnitFault::TooLarge);
        }
        Ok(Unit::ONE.times(base, power))
    }

    fn symbol(&mut self) -> Result<Unit, UnitFault> {
        if self.rest.starts_with('1') {
            self.skip(&['1']);
            return Ok(Unit::ONE);
        }
        let end = self
            .rest
            .find(|c: char| !(c.is_alphabetic() || "°%_'\"$".contains(c)))
            .unwrap_or(self.rest.len());
        let (symbol, rest) = self.rest.split_at(end);
        if symbol.is_empty() {
            return Err(UnitFault::Malformed);
        }
        let row = SYMBOLS.iter().find(|row| row.0 == symbol);
        let (_, unit) = row.ok_or_else(|| UnitFault::Unknown {
            symbol: symbol.into(),
            nearest: nearest(symbol),
        })?;
        self.rest = rest.trim_start();
        Ok(*unit)
    }

    fn exponent(&mut self) -> Result<i32, UnitFault> {
        if self.skip(&['^']).is_none() {
            return Ok(match self.skip(&['²', '³']) {
                Some('²') => 2,
                Some(_) => 3,
                None => 1,
            });
        }
        let sign = if self.skip(&['-']).is_some() { -1 } else { 1 };
        let end = self
            .rest
            .find(|c: char| !c.is_ascii_digit())
            .unwrap_or(self.rest.len());
        let (digits, rest) = self.rest.split_at(end);
        if digits.is_empty() {
            return Err(UnitFault::Malformed);
        }
        let power: i32 = digits.parse().map_err(|_| UnitFault::TooLarge)?;
        self.rest = rest.trim_start();
        Ok(sign * power)
    }
}
