//! JSON (RFC 8259) that remembers where everything stands.
//!
//! Stricter than the RFC where it lets a reader choose: keys must not repeat, numbers must fit a double, and nesting
//! and size have limits. The first fault of syntax ends the reading; repeated keys are collected.

mod number;
mod string;

use indexmap::IndexMap;
use indexmap::map::Entry as Slot;

use crate::node::{Kind, Member, Node, Origin, join};

/// Deepest nesting of lists and objects. A model needs eight.
pub const DEEPEST: usize = 128;
/// Most values of one file; a table of a million points has three million.
const MOST_VALUES: usize = 5_000_000;

/// A fault of syntax at a byte.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SyntaxFault {
    pub at: usize,
    pub message: String,
    pub hint: Option<&'static str>,
}

/// A repeated key.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Repeat {
    /// Path of the object.
    pub path: String,
    pub key: String,
    /// Where it stands for the first and the second time.
    pub first: usize,
    pub second: usize,
}

/// Reads one JSON value that is the whole text, and the repeated keys in it.
///
/// # Errors
/// The first fault of syntax.
pub fn parse(text: &str) -> Result<(Node, Vec<Repeat>), SyntaxFault> {
    let mut parser = JsonParser {
        text,
        at: 0,
        depth: 0,
        values: 0,
        path: Vec::new(),
        repeats: Vec::new(),
    };
    parser.skip_blanks();
    if parser.at == text.len() {
        return Err(parser.fault(0, "there is nothing in it"));
    }
    let node = parser.value()?;
    parser.skip_blanks();
    if parser.at < text.len() {
        return Err(parser.unexpected("the end"));
    }
    Ok((node, parser.repeats))
}

/// A step of the path to the value being read.
enum PathStep {
    Key(String),
    Index(usize),
}

struct JsonParser<'a> {
    text: &'a str,
    at: usize,
    depth: usize,
    values: usize,
    path: Vec<PathStep>,
    repeats: Vec<Repeat>,
}

impl JsonParser<'_> {
    fn fault(&self, at: usize, message: impl Into<String>) -> SyntaxFault {
        SyntaxFault {
            at,
            message: message.into(),
            hint: None,
        }
    }

    fn peek(&self) -> Option<u8> {
        self.text.as_bytes().get(self.at).copied()
    }

    fn skip_blanks(&mut self) {
        while matches!(self.peek(), Some(b' ' | b'\t' | b'\n' | b'\r')) {
            self.at += 1;
        }
    }

    /// Says what stands here instead of what is `wanted`.
    fn unexpected(&self, wanted: &str) -> SyntaxFault {
        let Some(found) = self.text[self.at..].chars().next() else {
            return self.fault(
                self.at,
                format!("it ends where {wanted} is expected; it seems cut short"),
            );
        };
        let hint = match found {
            '}' | ']' if wanted == "the end" => {
                Some("there is one closing bracket too many, here or before")
            }
            '/' | '#' => Some("JSON has no comments; use \"note\""),
            _ if wanted == "the end" => Some("it is complete before this: take out what follows"),
            '\'' => Some("text stands in double quotes"),
            'N' | 'I' => Some("JSON knows neither NaN nor Infinity"),
            '“' | '”' | '„' | '‘' | '’' | '«' | '»' => {
                Some("text stands in straight double quotes")
            }
            'T' | 'F' if wanted == "a value" => Some("true and false are written in lower case"),
            '+' | '.' if wanted == "a value" => {
                Some("a number begins with a digit or a minus sign, as in 0.5")
            }
            '0'..='9' if wanted.starts_with("a key") => {
                Some("a decimal point is a point: 0.8, not 0,8")
            }
            '"' | '{' | '[' if wanted.starts_with("\",\"") => {
                Some("a comma may be missing before it")
            }
            c if c.is_ascii_alphabetic() && wanted.starts_with("\",\"") => {
                Some("a quote or a comma may be missing before it")
            }
            '}' | ']' if !wanted.starts_with("\",\"") => {
                Some("there may be a comma too many before it")
            }
            c if c.is_ascii_alphabetic() => Some("text stands in double quotes"),
            _ => None,
        };
        SyntaxFault {
            at: self.at,
            message: format!("{found:?} where {wanted} is expected"),
            hint,
        }
    }

    fn value(&mut self) -> Result<Node, SyntaxFault> {
        let start = self.at;
        self.values += 1;
        if self.values > MOST_VALUES {
            return Err(self.fault(start, format!("more than {MOST_VALUES} values")));
        }
        let kind = match self.peek() {
            Some(b'{') => self.nested(Self::object)?,
            Some(b'[') => self.nested(Self::array)?,
            Some(b'"') => Kind::String(self.string()?),
            Some(b'-' | b'0'..=b'9') => Kind::Number(self.number()?),
            _ => self.word()?,
        };
        Ok(Node {
            kind,
            origin: Origin::Text(start, self.at),
        })
    }

    fn nested(
        &mut self,
        read: fn(&mut Self) -> Result<Kind, SyntaxFault>,
    ) -> Result<Kind, SyntaxFault> {
        if self.depth == DEEPEST {
            return Err(self.fault(self.at, format!("nested more than {DEEPEST} deep")));
        }
        self.depth += 1;
        self.at += 1;
        let kind = read(self);
        self.depth -= 1;
        kind
    }

    fn word(&mut self) -> Result<Kind, SyntaxFault> {
        for (word, kind) in [
            ("null", Kind::Null),
            ("true", Kind::Bool(true)),
            ("false", Kind::Bool(false)),
        ] {
            let rest = &self.text[self.at..];
            if rest.starts_with(word)
                && !rest[word.len()..].starts_with(|c: char| c.is_alphanumeric())
            {
                self.at += word.len();
                return Ok(kind);
            }
        }
        Err(self.unexpected("a value"))
    }

    fn array(&mut self) -> Result<Kind, SyntaxFault> {
        let mut items = Vec::new();
        self.skip_blanks();
        if self.peek() == Some(b']') {
            self.at += 1;
            return Ok(Kind::Array(items));
        }
        loop {
            self.skip_blanks();
            self.path.push(PathStep::Index(items.len()));
            items.push(self.value()?);
            self.path.pop();
            self.skip_blanks();
            match self.peek() {
                Some(b',') => self.at += 1,
                Some(b']') => {
                    self.at += 1;
                    return Ok(Kind::Array(items));
                }
                _ => return Err(self.unexpected("\",\" or \"]\"")),
            }
        }
    }

    fn object(&mut self) -> Result<Kind, SyntaxFault> {
        let mut members: Box<IndexMap<String, Member>> = Box::default();
        self.skip_blanks();
        if self.peek() == Some(b'}') {
            self.at += 1;
            return Ok(Kind::Object(members));
        }
        loop {
            self.skip_blanks();
            let start = self.at;
            if self.peek() != Some(b'"') {
                return Err(self.unexpected("a key in double quotes"));
            }
            let key = self.string()?;
            let origin = Origin::Text(start, self.at);
            self.skip_blanks();
            if self.peek() != Some(b':') {
                return Err(self.unexpected("\":\" after the key"));
            }
            self.at += 1;
            self.skip_blanks();
            self.path.push(PathStep::Key(key.clone()));
            let node = self.value()?;
            self.path.pop();
            match members.entry(key) {
                Slot::Vacant(slot) => {
                    slot.insert(Member { key: origin, node });
                }
                Slot::Occupied(slot) => {
                    let first = match slot.get().key {
                        Origin::Text(first, _) => first,
                        Origin::Set(_) => start,
                    };
                    let (path, key) = (render(&self.path), slot.key().clone());
                    self.repeats.push(Repeat {
                        path,
                        key,
                        first,
                        second: start,
                    });
                }
            }
            self.skip_blanks();
            match self.peek() {
                Some(b',') => self.at += 1,
                Some(b'}') => {
                    self.at += 1;
                    return Ok(Kind::Object(members));
                }
                _ => return Err(self.unexpected("\",\" or \"}\"")),
            }
        }
    }
}

/// `joints.b.between[1]`.
fn render(path: &[PathStep]) -> String {
    path.iter().fold(String::new(), |text, step| match step {
        PathStep::Key(key) => join(&text, key),
        PathStep::Index(index) => format!("{text}[{index}]"),
    })
}
