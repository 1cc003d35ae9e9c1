//! What responses have beside other expressions: names of results, reductions, equations.
//!
//! ```text
//! atom     = … | result | reduction "(" value { "," value } ")"
//! value    = sum [ "=" sum ]
//! result   = word { "." word } | "'" any text "'"
//! ```

use super::super::function::PI;
use super::super::number::FUNCTIONS;
use super::super::program::Do;
use super::super::quantity::{Fault, Quantity};
use super::super::reduction::Reduction;
use super::super::results::Results;
use super::super::steps::{Misfit, Step};
use super::{Parser, Read, check_count, fault, is_function, is_name};

/// Where an equation may stand.
pub const EQUATIONS: &str =
    "an equation stands in at( … , column = value) or count(column = value)";

/// The words of all reductions.
pub fn words() -> impl Iterator<Item = &'static str> + Clone {
    Reduction::ALL.into_iter().map(Reduction::word)
}

impl<'a> Parser<'a> {
    /// Lets the text name results.
    pub fn with_results(self, results: &'a dyn Results) -> Self {
        Parser {
            results: Some(results),
            ..self
        }
    }

    /// A name whose first word was read: of a function, a parameter or a result.
    pub(super) fn result(&mut self, at: usize, results: &dyn Results) -> Read<()> {
        while self
            .rest()
            .strip_prefix('.')
            .is_some_and(|rest| rest.starts_with(is_name))
        {
            self.at += 1;
            self.at += self.word().len();
        }
        let word = &self.text[at..self.at];
        let reduction = Reduction::ALL.into_iter().find(|one| one.word() == word);
        if self.peek() == Some('(') {
            let Some(reduction) = reduction else {
                return self.call(at, word);
            };
            return self.reduction(at, reduction);
        }
        let step = if let Some(index) = (self.find)(word) {
            Do::Parameter(index)
        } else if word == PI {
            Do::Push(Quantity::pi())
        } else if let Some(known) = results.find(word) {
            Do::Input(known)
        } else if reduction.is_some() || FUNCTIONS.iter().any(|row| row.0 == word) {
            return fault(at, is_function(word));
        } else {
            return unknown(at, word, results, self.names);
        };
        self.step(at, step);
        Ok(())
    }

    /// The name of a result between single quotes.
    pub(super) fn quoted(&mut self) -> Read<()> {
        let at = self.at;
        let rest = &self.rest()[1..];
        let Some(end) = rest.find('\'') else {
            return fault(at, Fault::new("this \"'\" is not closed"));
        };
        let name = &rest[..end];
        self.at += end + 2;
        let found = self.results.map(|results| (results.find(name), results));
        match found {
            Some((Some(known), _)) => {
                self.step(at, Do::Input(known));
                Ok(())
            }
            Some((None, results)) => unknown(at, name, results, self.names),
            None => fault(at, Fault::new("this names no result")),
        }
    }

    /// A reduction whose values begin here; max and min of two or more are the greater and the smaller one.
    fn reduction(&mut self, at: usize, reduction: Reduction) -> Read<()> {
        let count = self.values(self.at, &[','])?;
        let word = reduction.word();
        let both = FUNCTIONS.iter().find(|row| row.0 == word && count > 1);
        let step = match both {
            Some(&(_, function, ..)) => Step::Do(Do::Call(function, count)),
            None => {
                let takes = if reduction == Reduction::At { 2 } else { 1 };
                check_count(at, word, count, [takes, takes])?;
                Step::Reduce(reduction, count)
            }
        };
        self.steps.push((at, step));
        Ok(())
    }

    /// What stands behind the sign of an equation.
    pub(super) fn other_side(&mut self, at: usize) -> Read<()> {
        if self.rest().starts_with('=') {
            let said = Fault::new("unknown operator \"==\"");
            return Err(Misfit {
                at,
                fault: said.hint("an equation is written with one ="),
            });
        }
        self.nested(Self::sum)?;
        self.steps.push((at, Step::Equal));
        Ok(())
    }
}

/// What whoever knows the results says about a name that is none of theirs.
fn unknown(at: usize, name: &str, results: &dyn Results, parameters: &[String]) -> Read<()> {
    let said = results.missing(name, parameters);
    fault(
        at,
        Fault {
            message: said.message,
            hint: said.hint,
        },
    )
}
