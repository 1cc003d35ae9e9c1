//! The elimination of one row after the other by those kept before, left-looking.

use std::collections::VecDeque;

use super::rows::SparseRows;
use crate::triangle::{Entry, NONE, Search, Triangle};

/// Pivots may be this times smaller than the largest candidate [-].
const PIVOT_THRESHOLD: f64 = 0.5;

/// Shares of a combination below this times the largest entry of the dependent row are noise [-].
const SHARE_TOLERANCE: f64 = 1e-9;

/// The triangular factors of the rows kept so far.
pub(super) struct Elimination<'a> {
    rows: &'a SparseRows,
    /// Number of rows that use a coordinate.
    use_count: Vec<u32>,
    /// Row kept that has its pivot at a coordinate, counting rows kept.
    position: Vec<u32>,
    pub(super) lower: Triangle,
    pub(super) upper: Triangle,
    pivot: Vec<f64>,
    /// Largest entry of each row kept.
    scale: Vec<f64>,
    /// Row being eliminated, by coordinates; zero between rows.
    work: Vec<f64>,
    search: Search,
    /// Number of eliminations, of which a row may take several.
    searches: u32,
}

impl<'a> Elimination<'a> {
    pub(super) fn new(rows: &'a SparseRows) -> Self {
        let n = rows.columns();
        let mut use_count = vec![0; n];
        for row in 0..rows.rows() {
            for &coordinate in rows.transposed.column(row) {
                use_count[coordinate as usize] += 1;
            }
        }
        Elimination {
            rows,
            use_count,
            position: vec![NONE; n],
            lower: Triangle::new(),
            upper: Triangle::new(),
            pivot: Vec::new(),
            scale: Vec::new(),
            work: vec![0.0; n],
            search: Search::new(n),
            searches: 0,
        }
    }

    /// Rows with a coordinate of their own that no other row uses once the rows before them are gone, as from the open end of
    /// a chain on: no row depends on them, and kept first they fill nothing.
    pub(super) fn open_ends(&self) -> Vec<(usize, u32)> {
        let row_of = |row: usize| self.rows.transposed.column(row);
        let mut use_count = self.use_count.clone();
        // The exclusive or of the rows that use a coordinate: where one is left, it is that.
        let mut users = vec![0; use_count.len()];
        for row in 0..self.rows.rows() {
            for &coordinate in row_of(row) {
                users[coordinate as usize] ^= row;
            }
        }
        let all = 0..use_count.len() as u32;
        let mut open: VecDeque<u32> = all.filter(|c| use_count[*c as usize] == 1).collect();
        let mut ends = Vec::new();
        while let Some(own) = open.pop_front() {
            let row = users[own as usize];
            let values = &self.rows.values[self.rows.transposed.span(row)];
            let mut entries = row_of(row).iter().zip(values);
            let is_large = |(coordinate, value): (&u32, &f64)| {
                *coordinate == own && value.abs() >= PIVOT_THRESHOLD * self.row_scale(row)
            };
            if use_count[own as usize] != 1 || !entries.any(is_large) {
                continue;
            }
            ends.push((row, own));
            for coordinate in row_of(row).iter().map(|own| *own as usize) {
                use_count[coordinate] -= 1;
                users[coordinate] ^= row;
                if use_count[coordinate] == 1 {
                    open.push_back(coordinate as u32);
                }
            }
        }
        ends
    }

    fn row_scale(&self, row: usize) -> f64 {
        self.rows.values[self.rows.transposed.span(row)]
            .iter()
            .fold(0.0, |m, value| m.max(value.abs()))
    }

    /// Subtracts the rows kept; gives the largest entry left over the largest there was.
    pub(super) fn eliminate(&mut self, row: usize) -> f64 {
        let coordinates = self.rows.transposed.column(row);
        self.search
            .find(self.searches, coordinates, &self.position, &self.lower);
        self.searches += 1;
        let x = &mut self.work;
        for (&coordinate, &value) in coordinates
            .iter()
            .zip(&self.rows.values[self.rows.transposed.span(row)])
        {
            x[coordinate as usize] = value;
        }
        let mut left = 0.0f64;
        for &coordinate in self.search.reach().iter().rev() {
            let k = self.position[coordinate as usize];
            if k == NONE {
                continue;
            }
            let u = std::mem::take(&mut x[coordinate as usize]);
            self.upper.entries.push(Entry { row: k, value: u });
            for l in self.lower.column(k) {
                x[l.row as usize] -= l.value * u;
            }
        }
        for &coordinate in self.search.reach() {
            left = left.max(x[coordinate as usize].abs());
        }
        let scale = self.row_scale(row);
        self.scale.push(scale);
        if scale == 0.0 { 0.0 } else { left / scale }
    }

    /// Makes what is left a column of L.
    pub(super) fn keep(&mut self) {
        let free = || {
            self.search
                .reach()
                .iter()
                .filter(|&&c| self.position[c as usize] == NONE)
        };
        let largest = free().fold(0.0f64, |m, &c| m.max(self.work[c as usize].abs()));
        let chosen = free()
            .filter(|&&c| self.work[c as usize].abs() >= PIVOT_THRESHOLD * largest)
            .min_by_key(|&&c| (self.use_count[c as usize], c));
        if let Some(&chosen) = chosen {
            self.keep_at(chosen);
        }
    }

    /// The same, with its pivot at a coordinate.
    pub(super) fn keep_at(&mut self, chosen: u32) {
        let pivot = std::mem::take(&mut self.work[chosen as usize]);
        self.position[chosen as usize] = self.pivot.len() as u32;
        self.pivot.push(pivot);
        for &coordinate in self.search.reach() {
            let value = std::mem::take(&mut self.work[coordinate as usize]);
            // What cancelled exactly leads nowhere.
            if value != 0.0 {
                self.lower.entries.push(Entry {
                    row: coordinate,
                    value: value / pivot,
                });
            }
        }
        self.lower.close_column();
        self.upper.close_column();
    }

    /// Solves U c = u for the row just eliminated.
    pub(super) fn combination(&self, row: usize, kept: &[usize]) -> Vec<(usize, f64)> {
        let mut c = vec![0.0; self.pivot.len()];
        for entry in &self.upper.entries[self.open_column()..] {
            c[entry.row as usize] = entry.value;
        }
        for k in (0..c.len()).rev() {
            let factor = c[k] / self.pivot[k];
            c[k] = factor;
            if factor != 0.0 {
                for u in self.upper.column(k as u32) {
                    c[u.row as usize] -= u.value * factor;
                }
            }
        }
        let noise = SHARE_TOLERANCE * self.row_scale(row);
        let counts = |&k: &usize| (c[k] * self.scale[k]).abs() > noise;
        let mut shares: Vec<(usize, f64)> = (0..c.len())
            .filter(counts)
            .map(|k| (kept[k], c[k]))
            .collect();
        shares.sort_unstable_by_key(|&(row, _)| row);
        shares
    }

    /// Forgets the row just eliminated.
    pub(super) fn drop_row(&mut self) {
        for &coordinate in self.search.reach() {
            self.work[coordinate as usize] = 0.0;
        }
        let end = self.open_column();
        self.upper.entries.truncate(end);
        self.scale.pop();
    }

    /// Where the entries of U that belong to no row kept begin.
    fn open_column(&self) -> usize {
        self.upper.start.last().map_or(0, |&end| end as usize)
    }

    /// Whether no row kept has its pivot in a column.
    pub(super) fn is_free(&self, column: usize) -> bool {
        self.position[column] == NONE
    }

    /// A vector that all rows kept take to zero: with Jᵀ = L U and U regular, J x = 0 is Lᵀ x = 0, so that the free columns'
    /// components are chosen and the others follow from the last pivot to the first.
    pub(super) fn null_vector(&self) -> Vec<f64> {
        let mut coordinates = vec![0; self.pivot.len()];
        let mut x = vec![0.0; self.position.len()];
        for (column, &position) in self.position.iter().enumerate() {
            if position == NONE {
                // No two alike and none small, so that nothing cancels by chance.
                x[column] = 0.5 + 0.5 * (column as f64 + 1.0).sin().abs();
            } else {
                coordinates[position as usize] = column;
            }
        }
        for (k, &column) in coordinates.iter().enumerate().rev() {
            x[column] = -self
                .lower
                .column(k as u32)
                .iter()
                .map(|l| l.value * x[l.row as usize])
                .sum::<f64>();
        }
        x
    }
}
