//! Responses: one number of a run, from what changes along it.
//!
//! An expression of a response is split where it reduces: what stands in `max( … )` is worked out for each row, contact
//! or event, the rest once at the end. Dimensions are found by the same rules as those of all expressions.

use super::guess::Guess;
use super::program::Program;
use super::quantity::{Fault, Quantity};
use super::reduction::Reduction;
use super::results::{Place, Results};
use super::split::Splitter;
use super::{Expression, Misfit};
use crate::response::{Fact, Item, List};

/// Over what a reduction goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Over {
    /// The rows of the results.
    Rows,
    /// The contacts or events of a list.
    List(List),
}

/// What changes along a run, by the columns or by what is of a contact.
#[derive(Debug, Clone, PartialEq)]
pub enum Values {
    /// Of a row; inputs are indexes of columns.
    Row(Program),
    /// Of an entry of a list.
    Item(List, Program<Item>),
}

/// Many values that become one.
#[derive(Debug, Clone, PartialEq)]
pub struct Reduce {
    /// How.
    pub reduction: Reduction,
    /// Of what.
    pub values: Values,
    /// Both sides of the equation of `at` and `count`; inputs are indexes of columns.
    pub equation: Option<[Program; 2]>,
    /// As the text writes it.
    pub text: String,
}

/// What the last arithmetic takes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Input {
    /// The result of the reduction with this index.
    Reduced(usize),
    /// A number of the whole run.
    Fact(Fact),
}

/// A response that can be evaluated.
#[derive(Debug, Clone, PartialEq)]
pub struct Compiled {
    /// What is reduced.
    pub reductions: Vec<Reduce>,
    /// What is worked out of it at the end.
    pub total: Program<Input>,
    /// The unit of the result in SI; empty of a plain number.
    pub unit: String,
    /// Its dimension.
    pub(crate) quantity: Quantity,
}

/// Where an input of an unfinished part comes from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum From {
    Place(Place),
    Reduced(usize),
}

/// A parameter of a response, in SI.
pub(crate) type Constants<'a> = [(&'a str, Quantity)];

impl Compiled {
    /// Reads a response and finds its dimension.
    pub(crate) fn read(
        text: &str,
        parameters: &Constants<'_>,
        results: &dyn Results,
        degrees: bool,
    ) -> Result<Compiled, Misfit> {
        let names: Vec<String> = parameters.iter().map(|one| one.0.to_owned()).collect();
        let find = |name: &str| parameters.iter().position(|one| one.0 == name);
        let expression = Expression::response(text, &find, &names, results)?;
        let mut splitter = Splitter {
            text,
            parameters,
            degrees,
            reductions: Vec::new(),
        };
        let whole = splitter.split(&expression)?;
        if whole.over.is_some() {
            let said = Fault::new("this has many values: which one of them?");
            let what = if matches!(whole.over, Some(Over::Rows)) {
                "max( … ), mean( … ), last( … ), or at( … , driver.NAME = value)"
            } else {
                "max( … ), sum( … ) or count( … )"
            };
            return Err(Misfit {
                at: whole.at,
                fault: said.hint(what),
            });
        }
        let total = whole.program.map(|from| match from {
            From::Reduced(index) => Input::Reduced(index),
            From::Place(Place::Fact(fact)) => Input::Fact(fact),
            // a part with these has many values
            From::Place(Place::Row(_) | Place::Item(..)) => Input::Reduced(0),
        });
        Ok(Compiled {
            reductions: splitter.reductions,
            total,
            unit: unit(&whole.quantity),
            quantity: whole.quantity.with_value(0.0),
        })
    }

    /// Whether it needs anything but rows: contacts, events, or numbers of the whole run.
    pub fn needs_report(&self) -> bool {
        let of_list = |reduce: &Reduce| matches!(reduce.values, Values::Item(..));
        let is_fact = |input| matches!(input, Input::Fact(_));
        self.reductions.iter().any(of_list) || self.total.inputs().any(is_fact)
    }
}

/// The unit of a quantity; impulses are in N·s.
fn unit(quantity: &Quantity<Guess>) -> String {
    match quantity.unit() {
        unit if unit == "kg*m/s" => "N*s".to_owned(),
        unit => unit,
    }
}
