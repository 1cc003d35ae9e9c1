//! The reader of expressions: recursive descent over the text, bounded in length and depth.

mod number;

use super::quantity::{Fault, Quantity};
use super::{FUNCTIONS, LONGEST, Misfit, PI, Step};
use crate::suggest;
use number::is_unit;

/// Deepest nesting of brackets, calls and exponents.
const DEEPEST: usize = 64;

const MINUS: [char; 2] = ['-', '−'];

/// What the reading gives.
type Read<T> = Result<T, Misfit>;

pub(super) struct Parser<'a> {
    text: &'a str,
    at: usize,
    depth: usize,
    steps: Vec<(usize, Step)>,
    find: &'a dyn Fn(&str) -> Option<usize>,
    names: &'a [String],
}

fn is_name(c: char) -> bool {
    c.is_alphanumeric() || c == '_' || c == '°'
}

impl<'a> Parser<'a> {
    pub fn new(
        text: &'a str,
        find: &'a dyn Fn(&str) -> Option<usize>,
        names: &'a [String],
    ) -> Self {
        Parser {
            text,
            at: 0,
            depth: 0,
            steps: Vec::new(),
            find,
            names,
        }
    }

    /// Reads all of it.
    pub fn read(mut self) -> Read<Vec<(usize, Step)>> {
        if self.text.len() > LONGEST {
            return fault(
                0,
                Fault::new(format!("an expression has at most {LONGEST} characters")),
            );
        }
        self.skip_blanks();
        self.at += usize::from(self.rest().starts_with('='));
        self.sum()?;
        match self.peek() {
            None => Ok(self.steps),
            Some(')') => fault(self.at, Fault::new("this \")\" closes nothing")),
            Some(found) => {
                let said = Fault::new(format!(
                    "{:?} where an operator is expected",
                    found.to_string()
                ));
                let product = found == '(' || is_name(found);
                fault(
                    self.at,
                    if product {
                        said.hint("a product is written with *")
                    } else {
                        said
                    },
                )
            }
        }
    }

    fn rest(&self) -> &'a str {
        &self.text[self.at..]
    }

    fn skip_blanks(&mut self) {
        let rest = self.rest();
        self.at += rest.len() - rest.trim_start().len();
    }

    /// The next character that is no blank.
    fn peek(&mut self) -> Option<char> {
        self.skip_blanks();
        self.rest().chars().next()
    }

    /// Takes the next character where it is one of these; where it stood, and which.
    fn take(&mut self, wanted: &[char]) -> Option<(usize, char)> {
        let found = self.peek().filter(|found| wanted.contains(found))?;
        let at = self.at;
        self.at += found.len_utf8();
        Some((at, found))
    }

    fn nested(&mut self, read: fn(&mut Self) -> Read<()>) -> Read<()> {
        if self.depth == DEEPEST {
            return fault(
                self.at,
                Fault::new(format!("nested more than {DEEPEST} deep")),
            );
        }
        self.depth += 1;
        read(self)?;
        self.depth -= 1;
        Ok(())
    }

    fn sum(&mut self) -> Read<()> {
        self.product()?;
        while let Some((at, sign)) = self.take(&['+', '-', '−']) {
            self.product()?;
            self.steps.push((
                at,
                if sign == '+' {
                    Step::Add
                } else {
                    Step::Subtract
                },
            ));
        }
        Ok(())
    }

    fn product(&mut self) -> Read<()> {
        self.signed()?;
        while let Some((at, sign)) = self.take(&['*', '·', '×', '/']) {
            if self.rest().starts_with('*') {
                return fault(
                    at,
                    Fault::new("unknown operator \"**\"").hint("a power is written ^"),
                );
            }
            self.signed()?;
            self.steps.push((
                at,
                if sign == '/' {
                    Step::Divide
                } else {
                    Step::Multiply
                },
            ));
        }
        Ok(())
    }

    fn signed(&mut self) -> Read<()> {
        let mut minus = None;
        while let Some((at, sign)) = self.take(&['+', '-', '−']) {
            if MINUS.contains(&sign) {
                minus = if minus.is_none() { Some(at) } else { None };
            }
        }
        self.atom()?;
        if let Some((at, _)) = self.take(&['^']) {
            self.nested(Self::signed)?;
            self.steps.push((at, Step::Power));
        }
        self.steps.extend(minus.map(|at| (at, Step::Negate)));
        Ok(())
    }

    fn atom(&mut self) -> Read<()> {
        match self.peek() {
            None => fault(
                self.text.trim_end().len(),
                Fault::new("the expression ends where a value is expected"),
            ),
            Some('(') => {
                let open = self.at;
                self.at += 1;
                self.nested(Self::sum)?;
                self.close(open)
            }
            Some(c) if c.is_ascii_digit() || c == '.' => self.number(),
            Some(c) if c.is_alphabetic() || c == '_' => self.name(),
            Some(found) => fault(
                self.at,
                Fault::new(format!("{:?} where a value is expected", found.to_string())),
            ),
        }
    }

    fn close(&mut self, open: usize) -> Read<()> {
        match (self.take(&[')']), self.peek()) {
            (Some(_), _) => Ok(()),
            (None, None) => fault(open, Fault::new("this \"(\" is not closed")),
            (None, Some(found)) => {
                let message = format!(
                    "{:?} where an operator or \")\" is expected",
                    found.to_string()
                );
                fault(self.at, Fault::new(message))
            }
        }
    }

    /// The name at the beginning of the rest.
    fn word(&self) -> &'a str {
        let rest = self.rest();
        &rest[..rest.find(|c| !is_name(c)).unwrap_or(rest.len())]
    }

    fn name(&mut self) -> Read<()> {
        let (at, word) = (self.at, self.word());
        self.at += word.len();
        let function = FUNCTIONS.iter().find(|row| row.0 == word);
        if self.peek() == Some('(') {
            let open = self.at;
            return match function {
                Some(&(name, function, least, most)) => {
                    let count = self.values(open)?;
                    if count < least || count > most {
                        let takes = if least < most {
                            format!("at least {least}")
                        } else {
                            format!("{least}")
                        };
                        let values = if most == 1 { "value" } else { "values" };
                        let message = format!("{name} takes {takes} {values}, here it has {count}");
                        return fault(at, Fault::new(message));
                    }
                    self.steps.push((at, Step::Call(function, count)));
                    Ok(())
                }
                None if word == PI || (self.find)(word).is_some() => {
                    let said = Fault::new(format!("{word:?} is no function"));
                    fault(at, said.hint("a product is written with *"))
                }
                None => {
                    let names = FUNCTIONS.iter().map(|row| row.0);
                    let near = suggest::nearest(word, names.clone())
                        .map(|near| format!("did you mean {near:?}?"));
                    let all = || format!("the functions: {}", names.collect::<Vec<_>>().join(", "));
                    fault(
                        at,
                        Fault::new(format!("there is no function {word:?}"))
                            .hint(near.unwrap_or_else(all)),
                    )
                }
            };
        }
        if word == PI {
            self.steps.push((at, Step::Push(Quantity::pi())));
        } else if let Some(index) = (self.find)(word) {
            self.steps.push((at, Step::Parameter(index)));
        } else if function.is_some() {
            return fault(
                at,
                Fault::new(format!("{word:?} is a function")).hint(format!("write {word}( … )")),
            );
        } else {
            return fault(at, self.unknown(word));
        }
        Ok(())
    }

    fn unknown(&self, word: &str) -> Fault {
        let near = suggest::nearest(word, self.names.iter().map(String::as_str).chain([PI]));
        let said = Fault::new(format!(
            "there is no parameter {:?}",
            crate::node::excerpt(word)
        ));
        if let Some(near) = near {
            return said.hint(format!("did you mean {near:?}?"));
        }
        let mut hint = match self.names {
            [] => "write it into \"parameters\"".to_owned(),
            names => format!("the parameters: {}", suggest::list(names.iter())),
        };
        if is_unit(word) {
            hint += &format!("; a unit stands behind a number, as in 1 {word}");
        }
        said.hint(hint)
    }

    /// Values in brackets; how many.
    fn values(&mut self, open: usize) -> Read<usize> {
        self.at += 1;
        let mut count = 1;
        self.nested(Self::sum)?;
        while self.take(&[',']).is_some() {
            self.nested(Self::sum)?;
            count += 1;
        }
        self.close(open)?;
        Ok(count)
    }
}

fn fault<T>(at: usize, fault: Fault) -> Read<T> {
    Err(Misfit { at, fault })
}
