//! The reader of expressions: recursive descent over the text, bounded in length and depth.

mod number;
mod response;

pub use response::EQUATIONS;

use super::function::PI;
use super::number::{Binary, FUNCTIONS, Function, Unary};
use super::program::Do;
use super::quantity::{Fault, Quantity};
use super::results::{Known, Results};
use super::steps::{Expression, Misfit, Step};
use crate::suggest;
use crate::units::Unit;

/// Longest text of an expression in characters.
const LONGEST: usize = 4096;
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
    /// What else may be named, in a response.
    results: Option<&'a dyn Results>,
}

fn is_name(c: char) -> bool {
    c.is_alphanumeric() || c == '_' || c == '°'
}

/// Whether this is the symbol of a unit, perhaps with ² or ³ behind it.
fn is_unit(word: &str) -> bool {
    !word.starts_with('1') && Unit::parse(word.trim_end_matches(['²', '³'])).is_ok()
}

impl Expression {
    /// Reads a text that begins with `=`; `find` knows the names of parameters, `names` are all of them for hints.
    ///
    /// # Errors
    /// The first fault, with its place.
    pub fn parse<'a>(
        text: &'a str,
        find: &'a dyn Fn(&str) -> Option<usize>,
        names: &'a [String],
    ) -> Result<Expression, Misfit> {
        Parser::new(text, find, names).read().map(Expression)
    }

    /// Reads the text of a response, which may name results, too.
    ///
    /// # Errors
    /// The first fault, with its place.
    pub fn response<'a>(
        text: &'a str,
        find: &'a dyn Fn(&str) -> Option<usize>,
        names: &'a [String],
        results: &'a dyn Results,
    ) -> Result<Expression, Misfit> {
        let parser = Parser::new(text, find, names);
        parser.with_results(results).read().map(Expression)
    }
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
            results: None,
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
                if found == '=' && self.results.is_some() {
                    return fault(self.at, said.hint(EQUATIONS));
                }
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

    fn step(&mut self, at: usize, step: Do<Known>) {
        self.steps.push((at, Step::Do(step)));
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
            let function = match sign {
                '+' => Binary::Add,
                _ => Binary::Subtract,
            };
            self.step(at, Do::Call(Function::Two(function), 2));
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
            let function = match sign {
                '/' => Binary::Divide,
                _ => Binary::Multiply,
            };
            self.step(at, Do::Call(Function::Two(function), 2));
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
            self.step(at, Do::Call(Function::Two(Binary::Power), 2));
        }
        if let Some(at) = minus {
            self.step(at, Do::Call(Function::One(Unary::Negate), 1));
        }
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
            Some('\'') if self.results.is_some() => self.quoted(),
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
        if let Some(results) = self.results {
            return self.result(at, results);
        }
        if self.peek() == Some('(') {
            return self.call(at, word);
        }
        if word == PI {
            self.step(at, Do::Push(Quantity::pi()));
        } else if let Some(index) = (self.find)(word) {
            self.step(at, Do::Parameter(index));
        } else if FUNCTIONS.iter().any(|row| row.0 == word) {
            return fault(at, is_function(word));
        } else {
            return fault(at, self.unknown(word));
        }
        Ok(())
    }

    /// A function with its values, which begin here.
    fn call(&mut self, at: usize, word: &str) -> Read<()> {
        let open = self.at;
        let row = FUNCTIONS.iter().find(|row| row.0 == word);
        if row.is_none()
            && let Some((table, columns)) = self.results.and_then(|results| results.table(word))
        {
            let count = self.values(open, &[','])?;
            check_count(at, word, count, [1, 1])?;
            self.step(at, Do::Look(table, columns));
            return Ok(());
        }
        match row {
            Some(&(name, function, least, most)) => {
                // the points of a table are divided
                let signs: &[char] = match function {
                    Function::Table => &[',', ';'],
                    _ => &[','],
                };
                let count = self.values(open, signs)?;
                check_count(at, name, count, [least, most])?;
                self.step(at, Do::Call(function, count));
                Ok(())
            }
            None if word == PI || (self.find)(word).is_some() => {
                let said = Fault::new(format!("{word:?} is no function"));
                fault(at, said.hint("a product is written with *"))
            }
            None => fault(at, self.no_function(word)),
        }
    }

    /// Whether something is called by this name, with a value in brackets.
    fn is_function(&self, word: &str) -> bool {
        let is_table = |results: &dyn Results| results.table(word).is_some();
        super::is_function(word) || self.results.is_some_and(is_table)
    }

    fn no_function(&self, word: &str) -> Fault {
        let reductions = response::words().filter(|_| self.results.is_some());
        let names = FUNCTIONS.iter().map(|row| row.0).chain(reductions);
        let tables = self.results.map(|results| results.tables());
        let tables = tables.unwrap_or_default();
        let mut known: Vec<&str> = tables.iter().map(String::as_str).collect();
        for name in names.clone() {
            known.push(name);
        }
        let near = suggest::nearest(word, known).map(|near| format!("did you mean {near:?}?"));
        let mut all: Vec<&str> = Vec::new();
        for name in names {
            if !all.contains(&name) {
                all.push(name);
            }
        }
        Fault::new(format!("there is no function {word:?}"))
            .hint(near.unwrap_or_else(|| format!("the functions: {}", all.join(", "))))
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
    fn values(&mut self, open: usize, signs: &[char]) -> Read<usize> {
        self.at += 1;
        let mut count = 1;
        self.one_value()?;
        while self.take(signs).is_some() {
            self.one_value()?;
            count += 1;
        }
        self.close(open)?;
        Ok(count)
    }

    /// A value, in a response perhaps an equation.
    fn one_value(&mut self) -> Read<()> {
        self.nested(Self::sum)?;
        if self.results.is_some()
            && let Some((at, _)) = self.take(&['='])
        {
            return self.other_side(at);
        }
        Ok(())
    }
}

/// Complains about a function that has too many values, or too few.
fn check_count(at: usize, name: &str, count: usize, [least, most]: [usize; 2]) -> Read<()> {
    if (least..=most).contains(&count) {
        return Ok(());
    }
    let takes = if least < most {
        format!("at least {least}")
    } else {
        format!("{least}")
    };
    let values = if most == 1 { "value" } else { "values" };
    let message = format!("{name} takes {takes} {values}, here it has {count}");
    fault(at, Fault::new(message))
}

fn is_function(word: &str) -> Fault {
    Fault::new(format!("{word:?} is a function")).hint(format!("write {word}( … )"))
}

fn fault<T>(at: usize, fault: Fault) -> Read<T> {
    Err(Misfit { at, fault })
}

#[cfg(test)]
mod tests;
