//! Where entries of the matrix stand while its pattern is laid out.

use crate::system::{Slopes, System};

/// The entries of M, of J and Jᵀ, and of the derivatives of forces and constraints, in this order.
#[derive(Clone, Default)]
pub(super) struct Entries {
    pub all: Vec<(usize, usize)>,
    /// By entry that is requested: its index and the mirrored one's in `all`.
    pub owned: Vec<Option<[usize; 2]>>,
}

impl Entries {
    /// Of the columns that have a place among those that move, and of these rows of J behind them.
    pub fn of(
        (system, layout): (&System, &Slopes),
        masses: &[(usize, usize, f64)],
        (moving, places): (usize, &[Option<usize>]),
        rows: &[u32],
    ) -> Self {
        let mut entries = Entries::default();
        let at = |column: Option<usize>| column.and_then(|column| places[column]);
        for (row, column, _) in masses {
            entries.push(places[*row], places[*column], false);
        }
        for entry in &system.entries {
            let row = rows.binary_search(&entry.row).ok();
            let row = row.map(|row| moving + row);
            entries.push(row, at(entry.column().map(|column| column as usize)), true);
        }
        for [row, column] in &layout.forces {
            entries.push(at(*row), at(*column), false);
        }
        for [row, column] in &layout.bends {
            entries.push(at(*row), at(*column), true);
        }
        entries
    }

    fn push(&mut self, row: Option<usize>, column: Option<usize>, mirrored: bool) {
        let place = row.zip(column).map(|(row, column)| {
            let at = self.all.len();
            self.all.push((row, column));
            if mirrored && row != column {
                self.all.push((column, row));
                [at, at + 1]
            } else {
                [at, usize::MAX]
            }
        });
        self.owned.push(place);
    }
}
