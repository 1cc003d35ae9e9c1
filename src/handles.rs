//! Handles of parameters and columns: small, to be copied, found by name once.

use std::hash::{DefaultHasher, Hash, Hasher};
use std::sync::Arc;

use linkdyn_output::{Column as Heading, ColumnId};

use crate::quantity::Quantity;

/// Handle of a parameter of a [`Mechanism`](crate::Mechanism), and of all mechanisms that are made of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Parameter {
    pub(crate) index: usize,
    pub(crate) nominal: Quantity,
}

/// Handle of a result column of a [`Mechanism`](crate::Mechanism), and of all mechanisms with the same columns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Column {
    pub(crate) id: ColumnId,
    pub(crate) table: u64,
    pub(crate) unit: &'static str,
}

impl Parameter {
    /// The value in the model that was read, with its dimension.
    pub fn nominal(self) -> Quantity {
        self.nominal
    }

    /// The SI unit of its dimension; empty of a plain number.
    pub fn unit(self) -> String {
        self.nominal.unit()
    }
}

impl Column {
    /// The SI unit, such as `N*m`.
    pub fn unit(self) -> &'static str {
        self.unit
    }
}

/// The columns of the results.
#[derive(Debug)]
pub(crate) struct Columns {
    pub(crate) table: Arc<[Heading]>,
    /// Tells tables with other columns apart.
    pub(crate) mark: u64,
}

impl Columns {
    pub(crate) fn new(table: Arc<[Heading]>) -> Self {
        let mut hasher = DefaultHasher::new();
        for column in table.iter() {
            (&column.name, column.unit).hash(&mut hasher);
        }
        let mark = hasher.finish();
        Columns { table, mark }
    }
}
