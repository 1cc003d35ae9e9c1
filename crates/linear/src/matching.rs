//! Pairing of the rows of a matrix with its columns, each through an entry: a maximum matching in the bipartite graph.
//!
//! Large entries are tried first, then augmenting paths through large entries, then through all entries of the pattern
//! (Duff, ACM TOMS 7, 1981, with breadth first search instead of depth first). The number of pairs is the structural
//! rank: no values in this pattern can reach a higher rank.

use thiserror::Error;

use super::pattern::Pattern;
use super::triangle::NONE;

/// An entry is large when it is at least this times the largest of its column [-].
///
/// Only a preference: a joint arm a thousand times shorter than its neighbours should not carry a pivot if others can.
const LARGE_RATIO: f64 = 1e-3;

/// Rows and columns that find no partner: whatever the values, the matrix is singular.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("structurally singular: rows {rows:?} and columns {columns:?} find no partner")]
pub struct Unmatched {
    /// Rows without partner.
    pub rows: Vec<usize>,
    /// Columns without partner.
    pub columns: Vec<usize>,
}

/// Pairs of rows and columns.
#[derive(Debug, Clone)]
pub struct Matching {
    row_of_column: Vec<u32>,
    column_of_row: Vec<u32>,
}

impl Matching {
    /// A maximum matching of the pattern, preferring large values.
    pub(crate) fn maximum(pattern: &Pattern, values: &[f64]) -> Self {
        let mut matching = Matching::empty(pattern);
        matching.complete(pattern, values);
        matching
    }

    /// No pairs yet.
    pub(super) fn empty(pattern: &Pattern) -> Self {
        Matching {
            row_of_column: vec![NONE; pattern.columns()],
            column_of_row: vec![NONE; pattern.rows()],
        }
    }

    /// Pairs a free row with a free column.
    pub(super) fn pair(&mut self, row: usize, column: usize) {
        debug_assert!(self.row_of_column[column] == NONE && self.column_of_row[row] == NONE);
        self.row_of_column[column] = row as u32;
        self.column_of_row[row] = column as u32;
    }

    /// Adds pairs until there are no more, keeping matched rows and columns matched, though perhaps to others.
    pub(super) fn complete(&mut self, pattern: &Pattern, values: &[f64]) {
        assert_eq!(
            values.len(),
            pattern.entries(),
            "one value per entry of the pattern"
        );
        let candidates = Candidates::new(pattern, values);
        for column in 0..pattern.columns() {
            if self.row_of_column[column] != NONE {
                continue;
            }
            let free = |&&row: &&u32| self.column_of_row[row as usize] == NONE;
            if let Some(&row) = candidates.large(pattern, column).iter().find(free) {
                self.pair(row as usize, column);
            }
        }
        let mut search = Paths::new(pattern);
        for only_large in [true, false] {
            for column in 0..pattern.columns() {
                if self.row_of_column[column] == NONE {
                    search.augment(column as u32, self, |c| {
                        if only_large {
                            candidates.large(pattern, c)
                        } else {
                            candidates.all(pattern, c)
                        }
                    });
                }
            }
        }
    }

    /// Partner of a column.
    pub(crate) fn row_of(&self, column: usize) -> Option<usize> {
        let row = self.row_of_column[column];
        (row != NONE).then_some(row as usize)
    }

    /// Whether every row and every column has a partner.
    ///
    /// # Errors
    /// The ones without.
    pub(crate) fn check_perfect(&self) -> Result<(), Unmatched> {
        let lonely = |partners: &[u32]| -> Vec<usize> {
            (0..partners.len())
                .filter(|&i| partners[i] == NONE)
                .collect()
        };
        let (rows, columns) = (lonely(&self.column_of_row), lonely(&self.row_of_column));
        if rows.is_empty() && columns.is_empty() {
            Ok(())
        } else {
            Err(Unmatched { rows, columns })
        }
    }
}

/// Rows of each column, largest entry first.
struct Candidates {
    rows: Vec<u32>,
    large_count: Vec<u32>,
}

impl Candidates {
    fn new(pattern: &Pattern, values: &[f64]) -> Self {
        let mut rows = Vec::with_capacity(pattern.entries());
        let mut large_count = Vec::with_capacity(pattern.columns());
        let mut sorting: Vec<(f64, u32)> = Vec::new();
        for column in 0..pattern.columns() {
            sorting.clear();
            let sizes = values[pattern.span(column)].iter().map(|value| value.abs());
            sorting.extend(sizes.zip(pattern.column(column).iter().copied()));
            // Stable, so that equal entries keep the order of rows and runs repeat.
            sorting.sort_by(|a, b| b.0.total_cmp(&a.0));
            let limit = sorting
                .first()
                .map_or(0.0, |&(largest, _)| LARGE_RATIO * largest);
            large_count.push(
                sorting
                    .iter()
                    .filter(|&&(size, _)| size > 0.0 && size >= limit)
                    .count() as u32,
            );
            rows.extend(sorting.iter().map(|&(_, row)| row));
        }
        Candidates { rows, large_count }
    }

    fn all(&self, pattern: &Pattern, column: usize) -> &[u32] {
        &self.rows[pattern.span(column)]
    }

    fn large(&self, pattern: &Pattern, column: usize) -> &[u32] {
        &self.all(pattern, column)[..self.large_count[column] as usize]
    }
}

/// Breadth first search for the shortest augmenting path.
struct Paths {
    /// Number of the search that last saw a row.
    seen: Vec<u32>,
    /// Column from which a row was first seen.
    from: Vec<u32>,
    queue: Vec<u32>,
    searches: u32,
}

impl Paths {
    fn new(pattern: &Pattern) -> Self {
        Paths {
            seen: vec![0; pattern.rows()],
            from: vec![NONE; pattern.rows()],
            queue: Vec::new(),
            searches: 0,
        }
    }

    fn augment<'a>(
        &mut self,
        root: u32,
        matching: &mut Matching,
        rows_of: impl Fn(usize) -> &'a [u32],
    ) {
        self.searches += 1;
        self.queue.clear();
        self.queue.push(root);
        let mut head = 0;
        while head < self.queue.len() {
            let column = self.queue[head];
            head += 1;
            for &row in rows_of(column as usize) {
                if self.seen[row as usize] == self.searches {
                    continue;
                }
                self.seen[row as usize] = self.searches;
                self.from[row as usize] = column;
                match matching.column_of_row[row as usize] {
                    NONE => return self.flip(row, root, matching),
                    next => self.queue.push(next),
                }
            }
        }
    }

    /// Exchanges matched and unmatched entries along the path that ends at a free row.
    fn flip(&self, end: u32, root: u32, matching: &mut Matching) {
        let mut row = end;
        loop {
            let column = self.from[row as usize];
            let freed = matching.row_of_column[column as usize];
            matching.row_of_column[column as usize] = row;
            matching.column_of_row[row as usize] = column;
            if column == root {
                return;
            }
            row = freed;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn large_entries_are_preferred() {
        // [1 9; 9 1]: the anti-diagonal.
        let pattern = Pattern::new(2, vec![0, 2, 4], vec![0, 1, 0, 1]).unwrap();
        let matching = Matching::maximum(&pattern, &[1.0, 9.0, 9.0, 1.0]);
        assert_eq!((matching.row_of(0), matching.row_of(1)), (Some(1), Some(0)));
    }

    #[test]
    fn path_goes_through_taken_rows_and_momentary_zeros() {
        // Column 0 takes row 0; column 1 has row 0 only; column 0 must move to row 1, where it holds a zero.
        let pattern = Pattern::new(2, vec![0, 2, 3], vec![0, 1, 0]).unwrap();
        let matching = Matching::maximum(&pattern, &[1.0, 0.0, 1.0]);
        assert_eq!((matching.row_of(0), matching.row_of(1)), (Some(1), Some(0)));
        assert_eq!(matching.check_perfect(), Ok(()));
    }

    #[test]
    fn lonely_rows_and_columns_are_named() {
        // Columns 0 and 2 both live on row 1 alone; row 0 is empty.
        let pattern = Pattern::new(3, vec![0, 1, 3, 4], vec![1, 1, 2, 1]).unwrap();
        let matching = Matching::maximum(&pattern, &[1.0; 4]);
        assert_eq!(
            matching.check_perfect(),
            Err(Unmatched {
                rows: vec![0],
                columns: vec![2]
            })
        );
    }
}
