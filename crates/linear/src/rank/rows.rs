//! A sparse matrix by rows.

use crate::pattern::Pattern;
use thiserror::Error;

/// A matrix by rows.
#[derive(Debug, Clone)]
pub struct SparseRows {
    /// Rows of J as columns.
    pub(super) transposed: Pattern,
    pub(super) values: Vec<f64>,
}

/// An entry that is not finite or outside the matrix.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[error("row {row}, column {column}: entry is not finite, or outside the matrix")]
pub struct BadEntry {
    /// Its row.
    pub row: usize,
    /// Its column.
    pub column: usize,
}

impl SparseRows {
    /// From a dense matrix, row after row.
    ///
    /// # Errors
    /// The first entry that is not finite.
    ///
    /// # Panics
    /// When the values do not fill whole rows.
    pub fn from_dense(rows: usize, columns: usize, values: &[f64]) -> Result<Self, BadEntry> {
        assert_eq!(
            values.len(),
            rows * columns,
            "a {rows} × {columns} matrix wants {} values",
            rows * columns
        );
        let entries: Vec<(usize, usize, f64)> = values
            .iter()
            .enumerate()
            .filter(|&(_, &value)| value != 0.0)
            .map(|(at, &value)| (at / columns, at % columns, value))
            .collect();
        Self::from_triplets(rows, columns, &entries)
    }

    /// From (row, column, value) in any order; repeats add up.
    ///
    /// # Errors
    /// The first entry that is not finite or outside.
    pub fn from_triplets(
        rows: usize,
        columns: usize,
        entries: &[(usize, usize, f64)],
    ) -> Result<Self, BadEntry> {
        let outside = |&&(row, column, value): &&(usize, usize, f64)| {
            row >= rows || column >= columns || !value.is_finite()
        };
        if let Some(&(row, column, _)) = entries.iter().find(outside) {
            return Err(BadEntry { row, column });
        }
        let positions: Vec<(usize, usize)> = entries
            .iter()
            .map(|&(row, column, _)| (column, row))
            .collect();
        let (transposed, slots) =
            Pattern::from_entries(columns, rows, &positions).map_err(|_| BadEntry {
                row: rows,
                column: columns,
            })?;
        let mut values = vec![0.0; transposed.entries()];
        for (&slot, &(_, _, value)) in slots.iter().zip(entries) {
            values[slot as usize] += value;
        }
        Ok(SparseRows { transposed, values })
    }

    /// From a pattern by columns and its values.
    ///
    /// # Errors
    /// The first entry that is not finite.
    pub fn from_pattern(pattern: &Pattern, values: &[f64]) -> Result<Self, BadEntry> {
        assert_eq!(
            values.len(),
            pattern.entries(),
            "one value per entry of the pattern"
        );
        let (transposed, slots) = pattern.transposed();
        let values: Vec<f64> = slots.iter().map(|&slot| values[slot as usize]).collect();
        for row in 0..transposed.columns() {
            for at in transposed.span(row) {
                if !values[at].is_finite() {
                    let column = transposed.column(row)[at - transposed.span(row).start] as usize;
                    return Err(BadEntry { row, column });
                }
            }
        }
        Ok(SparseRows { transposed, values })
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.transposed.columns()
    }

    /// Number of columns.
    pub fn columns(&self) -> usize {
        self.transposed.rows()
    }

    /// Entries (column, value) of a row.
    pub fn row(&self, row: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let span = self.transposed.span(row);
        self.transposed
            .column(row)
            .iter()
            .map(|&column| column as usize)
            .zip(self.values[span].iter().copied())
    }
}
