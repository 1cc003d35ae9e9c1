//! Responses: one number of a run, from what changes along it.
//!
//! An expression of a response is split where it reduces: what stands in `max( … )` is worked out for each row, contact
//! or event, the rest once at the end. Dimensions are found by the same rules as those of all expressions.

use super::program::Program;
use super::quantity::Quantity;
use super::reduction::Reduction;
use super::results::Place;
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
    /// Whether it needs anything but rows: contacts, events, or numbers of the whole run.
    pub fn needs_report(&self) -> bool {
        let of_list = |reduce: &Reduce| matches!(reduce.values, Values::Item(..));
        let is_fact = |input| matches!(input, Input::Fact(_));
        self.reductions.iter().any(of_list) || self.total.inputs().any(is_fact)
    }
}
