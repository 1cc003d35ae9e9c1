//! Texts of JSON, with their escapes.

use super::{JsonParser, SyntaxFault};

impl JsonParser<'_> {
    pub(super) fn string(&mut self) -> Result<String, SyntaxFault> {
        let start = self.at;
        self.at += 1;
        let mut out = String::new();
        loop {
            let rest = &self.text[self.at..];
            let plain = rest
                .find(|c: char| c == '"' || c == '\\' || c < ' ')
                .unwrap_or(rest.len());
            out.push_str(&rest[..plain]);
            self.at += plain;
            match self.peek() {
                Some(b'"') => {
                    self.at += 1;
                    return Ok(out);
                }
                Some(b'\\') => out.push(self.escape()?),
                Some(b'\n' | b'\r') => {
                    return Err(self.fault(start, "the text has no closing quote on its line"));
                }
                Some(_) => {
                    return Err(self.fault(
                        self.at,
                        "a control character in a text; write a tab as \\t, another as \\u00XX",
                    ));
                }
                None => {
                    return Err(
                        self.fault(start, "the text has no closing quote; it seems cut short")
                    );
                }
            }
        }
    }

    fn escape(&mut self) -> Result<char, SyntaxFault> {
        let start = self.at;
        self.at += 2;
        let byte = self.text.as_bytes().get(start + 1).copied();
        match byte {
            Some(b'"') => Ok('"'),
            Some(b'\\') => Ok('\\'),
            Some(b'/') => Ok('/'),
            Some(b'b') => Ok('\u{8}'),
            Some(b'f') => Ok('\u{c}'),
            Some(b'n') => Ok('\n'),
            Some(b'r') => Ok('\r'),
            Some(b't') => Ok('\t'),
            Some(b'u') => self.unicode(start),
            _ => Err(self.fault(
                start,
                "an escape that JSON does not know; a backslash itself is written \\\\",
            )),
        }
    }

    /// `\uXXXX`, or two of them that are a surrogate pair.
    fn unicode(&mut self, start: usize) -> Result<char, SyntaxFault> {
        let broken = || SyntaxFault {
            at: start,
            message: "a broken \\u escape".into(),
            hint: Some("\\u and four hex digits"),
        };
        let high = self.hex().ok_or_else(broken)?;
        if !(0xD800..0xDC00).contains(&high) {
            return char::from_u32(high).ok_or_else(broken);
        }
        if !self.text[self.at..].starts_with("\\u") {
            return Err(broken());
        }
        self.at += 2;
        let low = self
            .hex()
            .filter(|low| (0xDC00..0xE000).contains(low))
            .ok_or_else(broken)?;
        char::from_u32(0x10000 + ((high - 0xD800) << 10) + (low - 0xDC00)).ok_or_else(broken)
    }

    fn hex(&mut self) -> Option<u32> {
        let digits = self.text.get(self.at..self.at + 4)?;
        let code = digits
            .bytes()
            .all(|byte| byte.is_ascii_hexdigit())
            .then(|| u32::from_str_radix(digits, 16).ok())?;
        self.at += 4;
        code
    }
}
