//! Numbers of JSON.

use serde_json::Number;

use super::{JsonParser, SyntaxFault};
use crate::node::excerpt;

impl JsonParser<'_> {
    fn digits(&mut self) -> usize {
        let start = self.at;
        while self.peek().is_some_and(|byte| byte.is_ascii_digit()) {
            self.at += 1;
        }
        self.at - start
    }

    pub(super) fn number(&mut self) -> Result<Number, SyntaxFault> {
        let start = self.at;
        if self.peek() == Some(b'-') {
            self.at += 1;
        }
        let whole = self.at;
        let count = self.digits();
        if count == 0 {
            return Err(self.unexpected("a digit"));
        }
        if count > 1 && self.text.as_bytes()[whole] == b'0' {
            return Err(self.fault(
                start,
                "a number must not begin with a zero that counts nothing",
            ));
        }
        let mut integer = true;
        if self.peek() == Some(b'.') {
            integer = false;
            self.at += 1;
            if self.digits() == 0 {
                return Err(self.unexpected("a digit after the decimal point"));
            }
        }
        if matches!(self.peek(), Some(b'e' | b'E')) {
            integer = false;
            self.at += 1;
            if matches!(self.peek(), Some(b'+' | b'-')) {
                self.at += 1;
            }
            if self.digits() == 0 {
                return Err(self.unexpected("a digit of the exponent"));
            }
        }
        let text = &self.text[start..self.at];
        if integer
            && text != "-0"
            && let Ok(number) = text.parse::<i64>()
        {
            return Ok(number.into());
        }
        let number = text.parse().ok().and_then(Number::from_f64);
        number.ok_or_else(|| {
            self.fault(
                start,
                format!("{}: the number is too large for a double", excerpt(text)),
            )
        })
    }
}
