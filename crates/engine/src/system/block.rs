//! The equations of one thing, and where they stand among all.

use super::{GROUND, JacobianEntry, Origin, System};
use crate::element::Constraint;
use std::ops::Range;
use std::sync::Arc;

/// Equations of one joint, driver or initial value, with their place in φ and in the entry list.
#[derive(Clone)]
pub struct Block {
    /// The equations.
    pub constraint: Arc<dyn Constraint>,
    /// What they came from.
    pub origin: Origin,
    /// First row, and first entry.
    first: [u32; 2],
    /// Number of rows, and of entries.
    count: [u32; 2],
}

impl Block {
    /// Of equations that stand for themselves.
    pub(crate) fn alone(constraint: Arc<dyn Constraint>, origin: Origin) -> Self {
        let count = [constraint.rows().len(), constraint.entries().len()];
        Block {
            constraint,
            origin,
            first: [0; 2],
            count: count.map(|count| count as u32),
        }
    }

    /// First row.
    #[inline]
    pub fn row(&self) -> usize {
        self.first[0] as usize
    }

    /// Its rows.
    #[inline]
    pub(crate) fn rows(&self) -> Range<usize> {
        self.row()..self.row() + self.count[0] as usize
    }

    /// Its entries.
    #[inline]
    pub fn entries(&self) -> Range<usize> {
        let first = self.first[1] as usize;
        first..first + self.count[1] as usize
    }
}

impl System {
    /// Adds the equations of a joint or driver behind those that are there.
    pub(crate) fn push_block(&mut self, constraint: Arc<dyn Constraint>, origin: Origin) {
        let (row, entry) = (self.measures.len(), self.entries.len());
        self.measures.extend_from_slice(constraint.rows());
        for (block_row, body, axis) in constraint.entries() {
            let column = self.layout.column(body, axis);
            self.entries.push(JacobianEntry {
                row: (row + block_row) as u32,
                column: column.map_or(GROUND, |column| column as u32),
            });
        }
        let (rows, entries) = (self.measures.len() - row, self.entries.len() - entry);
        self.blocks.push(Block {
            constraint,
            origin,
            first: [row as u32, entry as u32],
            count: [rows as u32, entries as u32],
        });
    }
}
