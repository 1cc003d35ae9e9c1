//! What a response may name: columns, contacts and events, numbers of the whole run.

use crate::dimension::Powers;
use crate::error::Complaint;
use crate::response::{Fact, Item, List};

/// What a name stands for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Known {
    /// Where its values are.
    pub place: Place,
    /// Its dimension.
    pub powers: Powers,
}

/// Where the values of a name are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// In a column, one for each row.
    Row(usize),
    /// In a list, one for each contact or event.
    Item(List, Item),
    /// One for the whole run.
    Fact(Fact),
}

/// Knows the names of results.
pub trait Results {
    /// What a name stands for; none of other names.
    fn find(&self, name: &str) -> Option<Known>;
    /// What to say about a name that stands for nothing, beside parameters of these names.
    fn missing(&self, name: &str, parameters: &[String]) -> Complaint;
    /// The number of a table that is called like this, with the dimensions of its columns.
    fn table(&self, _name: &str) -> Option<(usize, [Powers; 2])> {
        None
    }
    /// The names of all tables.
    fn tables(&self) -> Vec<String> {
        Vec::new()
    }
}
