//! Where the entries of a sparse matrix stand, without their values.
//!
//! ```text
//! start   (columns + 1)   entries start[c] .. start[c+1] belong to column c
//! row     (entries)       their rows, strictly increasing within a column
//! ```
//!
//! Values live apart, as a plain slice in the same order, so that one pattern serves every step of a run.

use sprs::{CsMatI, CsStructureI};
use thiserror::Error;

/// Compressed columns without values, indices of 32 bits: half the traffic of `usize` in the inner loops.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Pattern(CsStructureI<u32>);

/// What is wrong with a pattern.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum PatternFault {
    /// Column starts that are no partition, or rows out of order or range.
    #[error(
        "columns must partition the entries, and their rows increase strictly and stay below the number of rows"
    )]
    Structure,
    /// Indices of 32 bits are not enough.
    #[error("more than 2^32 - 2 rows, columns or entries")]
    TooLarge,
}

impl Pattern {
    /// Checks and takes the column starts and row indices of a `rows` × (`start.len() − 1`) matrix.
    ///
    /// # Errors
    /// Starts that do not partition the entries, rows out of range, unsorted or repeated.
    pub fn new(rows: usize, start: Vec<u32>, row: Vec<u32>) -> Result<Self, PatternFault> {
        let limit = u32::MAX as usize - 1;
        if rows > limit || start.len() > limit || row.len() > limit {
            return Err(PatternFault::TooLarge);
        }
        let columns = start.len().checked_sub(1).ok_or(PatternFault::Structure)?;
        let nothing = vec![(); row.len()];
        let structure = CsStructureI::try_new_csc((rows, columns), start, row, nothing);
        structure.map(Pattern).map_err(|_| PatternFault::Structure)
    }

    /// Builds the pattern from (row, column) pairs in any order, repeats welcome; the second result is, for each pair,
    /// the slot of its value.
    ///
    /// # Errors
    /// A pair outside `rows` × `columns`.
    pub fn from_entries(
        rows: usize,
        columns: usize,
        entries: &[(usize, usize)],
    ) -> Result<(Self, Vec<u32>), PatternFault> {
        let limit = u32::MAX as usize - 1;
        if rows > limit || columns > limit || entries.len() > limit {
            return Err(PatternFault::TooLarge);
        }
        if entries
            .iter()
            .any(|&(row, column)| row >= rows || column >= columns)
        {
            return Err(PatternFault::Structure);
        }

        // Sort by column, then row; equal neighbours share a slot.
        let mut sorted: Vec<u32> = (0..entries.len() as u32).collect();
        sorted.sort_unstable_by_key(|&e| {
            let (row, column) = entries[e as usize];
            (column, row)
        });
        let mut start = vec![0u32; columns + 1];
        let mut row = Vec::with_capacity(entries.len());
        let mut slot = vec![0u32; entries.len()];
        let mut previous = None;
        for &e in &sorted {
            let entry = entries[e as usize];
            if previous != Some(entry) {
                row.push(entry.0 as u32);
                start[entry.1 + 1] += 1;
                previous = Some(entry);
            }
            slot[e as usize] = row.len() as u32 - 1;
        }
        for column in 0..columns {
            start[column + 1] += start[column];
        }
        Ok((Pattern::new(rows, start, row)?, slot))
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.0.rows()
    }

    /// Number of columns.
    pub fn columns(&self) -> usize {
        self.0.cols()
    }

    /// Number of entries.
    pub fn entries(&self) -> usize {
        self.0.nnz()
    }

    /// Rows of one column.
    pub fn column(&self, column: usize) -> &[u32] {
        &self.0.indices()[self.span(column)]
    }

    /// Slots of one column's values.
    pub(crate) fn span(&self, column: usize) -> std::ops::Range<usize> {
        let start = self.0.indptr();
        let start = start.raw_storage();
        start[column] as usize..start[column + 1] as usize
    }

    /// Slot of the entry at (`row`, `column`), where there is one.
    pub(crate) fn slot(&self, row: usize, column: usize) -> Option<usize> {
        let row = u32::try_from(row).ok()?;
        let within = self.column(column).binary_search(&row).ok()?;
        Some(self.span(column).start + within)
    }

    /// The pattern of the transpose, and for each of its entries the slot here.
    pub(crate) fn transposed(&self) -> (Pattern, Vec<u32>) {
        let start = self.0.indptr().raw_storage().to_vec();
        let slots = (0..self.entries() as u32).collect();
        let own = CsMatI::new_csc(self.0.shape(), start, self.0.indices().to_vec(), slots);
        // Rows of a matrix are columns of its transpose.
        let (start, columns, slots) = own.to_csr().into_raw_storage();
        let nothing = vec![(); columns.len()];
        let shape = (self.columns(), self.rows());
        let transpose = CsStructureI::new_csc(shape, start, columns, nothing);
        (Pattern(transpose), slots)
    }

    /// result −= A x.
    pub(crate) fn subtract_product(&self, values: &[f64], x: &[f64], result: &mut [f64]) {
        assert_eq!(
            (values.len(), x.len(), result.len()),
            (self.entries(), self.columns(), self.rows())
        );
        for (column, &factor) in x.iter().enumerate() {
            let span = self.span(column);
            for (&row, value) in self.0.indices()[span.clone()].iter().zip(&values[span]) {
                result[row as usize] -= value * factor;
            }
        }
    }

    /// result −= Aᵀ x.
    pub(crate) fn subtract_transposed_product(
        &self,
        values: &[f64],
        x: &[f64],
        result: &mut [f64],
    ) {
        assert_eq!(
            (values.len(), x.len(), result.len()),
            (self.entries(), self.rows(), self.columns())
        );
        for (column, target) in result.iter_mut().enumerate() {
            let span = self.span(column);
            let dot: f64 = self.0.indices()[span.clone()]
                .iter()
                .zip(&values[span])
                .map(|(&row, value)| value * x[row as usize])
                .sum();
            *target -= dot;
        }
    }
}

/// The pattern of an n × n matrix with entries that are known to lie within it, and the slot of each.
///
/// # Panics
/// When one does not.
pub fn square(n: usize, entries: &[(usize, usize)]) -> (Pattern, Vec<u32>) {
    match Pattern::from_entries(n, n, entries) {
        Ok(found) => found,
        Err(fault) => panic!("{fault}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_are_sorted_and_repeats_share_a_slot() {
        let (pattern, slot) =
            Pattern::from_entries(3, 2, &[(2, 1), (0, 0), (2, 1), (1, 1)]).unwrap();
        assert_eq!(
            pattern,
            Pattern::new(3, vec![0, 1, 3], vec![0, 1, 2]).unwrap()
        );
        assert_eq!(slot, [2, 0, 2, 1]);
        assert_eq!(pattern.slot(2, 1), Some(2));
        assert_eq!(pattern.slot(2, 0), None);
    }

    #[test]
    fn faults_are_told() {
        assert_eq!(
            Pattern::new(2, vec![0, 2], vec![1, 1]),
            Err(PatternFault::Structure)
        );
        assert_eq!(
            Pattern::new(2, vec![0, 1], vec![2]),
            Err(PatternFault::Structure)
        );
        assert_eq!(
            Pattern::new(2, vec![0, 2, 1], vec![0]),
            Err(PatternFault::Structure)
        );
        assert_eq!(
            Pattern::new(2, vec![], vec![]),
            Err(PatternFault::Structure)
        );
        assert!(Pattern::from_entries(1, 1, &[(1, 0)]).is_err());
    }

    #[test]
    fn transposed_twice_is_the_same() {
        let (pattern, _) =
            Pattern::from_entries(3, 4, &[(2, 1), (0, 0), (1, 3), (1, 1), (2, 3)]).unwrap();
        let (there, slot) = pattern.transposed();
        assert_eq!((there.rows(), there.columns()), (4, 3));
        assert_eq!(there.transposed().0, pattern);
        assert_eq!(slot, [0, 1, 3, 2, 4]);
    }
}
