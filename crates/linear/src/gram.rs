//! B Bᵀ x = b for a B on a frozen pattern with independent rows, and what is least by it.
//!
//! ```text
//! L D Lᵀ = P (B Bᵀ) Pᵀ                         L unit lower triangular
//! |z − z₀| least with B z = c:   B Bᵀ λ = B z₀ − c,   z = z₀ − Bᵀ λ
//! ```
//!
//! A matrix of rows has as many rows as constraints, which are fewer than the coordinates and the constraints together, it is
//! symmetric, and no pivot has to be chosen: minimum degree says in which order to eliminate, and both the products of B's entries,
//! column by column, and those of the elimination are lists that are gone through once, as in `lu`. What is lost is accuracy, since
//! B Bᵀ has the square of B's condition. So one correction is made where c is not met (Björck, Stability analysis of the method of
//! seminormal equations, 1987), and rows of which almost nothing is left after the others are said to be weak.
//!
//! Checked against the sparse LU of the whole in `gram/tests.rs`.

#[cfg(test)]
mod tests;

use super::order::ColumnOrder;
use super::pattern::square;

/// What is left of a row by what it was, below which it is weak: a thousandth of its length.
const WEAK: f64 = 1e-6;
/// A residual that is not round-off, by what it is the difference of.
const UNMET: f64 = 1e-13;

/// Rows are dependent, or nearly.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Weak;

/// Factors of B Bᵀ.
#[derive(Debug, Clone)]
pub struct Gram {
    /// Row, in the order of elimination, and column of each entry of B; its values, and how many each column has.
    places: Vec<[u32; 2]>,
    values: Vec<f64>,
    columns: Vec<u32>,
    /// Where products of two entries of a column go: for each entry, that with itself and those with the entries behind it.
    products: Vec<u32>,
    /// Position of each row in the order of elimination.
    position: Vec<u32>,
    /// Entries below the diagonal of each column of L.
    lengths: Vec<u32>,
    /// What is being eliminated: for each column the diagonal and what is below it.
    work: Vec<f64>,
    /// Where products of the elimination go: for each column, for each entry, those with it and the entries below it; counted from
    /// behind the column.
    targets: Vec<u32>,
    /// L by columns, and row and column of each entry.
    lower: Vec<f64>,
    lower_places: Vec<[u32; 2]>,
    inverse: Vec<f64>,
    /// The right-hand side, and λ.
    right: Vec<f64>,
}

impl Gram {
    /// Of B (rows, columns) with entries at these places, each once, by columns.
    ///
    /// # Panics
    /// When entries do not stand by columns.
    pub fn new([rows, columns]: [usize; 2], places: &[[u32; 2]]) -> Self {
        assert!(
            places.is_sorted_by_key(|place| place[1]),
            "entries stand by columns"
        );
        let pairs = || {
            let columns = places.chunk_by(|a, b| a[1] == b[1]);
            columns.flat_map(|own| {
                let first = own.iter().enumerate();
                first.flat_map(|(k, a)| own[k..].iter().map(|b| [a[0] as usize, b[0] as usize]))
            })
        };
        let entries: Vec<_> = pairs()
            .flat_map(|[a, b]| [(a, b), (b, a)])
            .chain((0..rows).map(|row| (row, row)))
            .collect();
        let (pattern, _) = square(rows, &entries);
        let order = ColumnOrder::amd(&pattern);
        let mut position = vec![0; rows];
        for (step, &row) in order.columns().iter().enumerate() {
            position[row as usize] = step as u32;
        }
        let steps = order.columns().iter().enumerate();
        let below = steps.map(|(step, &column)| {
            let rows = pattern.column(column as usize).iter();
            let rows = rows.map(|&row| position[row as usize]);
            rows.filter(|row| *row as usize > step).collect()
        });
        let below = filled(below.collect());
        let mut begin = Vec::with_capacity(rows);
        let mut end = 0;
        for column in &below {
            begin.push(end);
            end += 1 + column.len() as u32;
        }
        let place = |row: u32, column: u32| {
            let [row, column] = [row.max(column), row.min(column)];
            let above = below[column as usize].partition_point(|own| *own < row) as u32;
            begin[column as usize] + if row == column { 0 } else { 1 + above }
        };
        let products = pairs().map(|[a, b]| place(position[a], position[b]));
        let products = products.collect();
        let mut targets = Vec::new();
        let mut lower_places = Vec::new();
        for (column, own) in below.iter().enumerate() {
            let behind = begin[column] + 1 + own.len() as u32;
            for (index, &other) in own.iter().enumerate() {
                let rows = own[index..].iter();
                targets.extend(rows.map(|&row| place(row, other) - behind));
                lower_places.push([other, column as u32]);
            }
        }
        let mut lengths = vec![0; columns];
        for [_, column] in places {
            lengths[*column as usize] += 1;
        }
        let own = places.iter();
        let own = own.map(|&[row, column]| [position[row as usize], column]);
        Gram {
            places: own.collect(),
            values: vec![0.0; places.len()],
            columns: lengths,
            products,
            position,
            lengths: below.iter().map(|column| column.len() as u32).collect(),
            work: vec![0.0; end as usize],
            targets,
            lower: vec![0.0; lower_places.len()],
            lower_places,
            inverse: vec![0.0; rows],
            right: vec![0.0; rows],
        }
    }

    /// The entries of B in the order of their places, to be written before [`Gram::factor`].
    pub fn values_mut(&mut self) -> &mut [f64] {
        &mut self.values
    }

    /// Factors B Bᵀ.
    ///
    /// # Errors
    /// [`Weak`], also where an entry is not finite; there are no factors then.
    pub fn factor(&mut self) -> Result<(), Weak> {
        self.multiply();
        // What rows are by themselves, before others are taken from them.
        let mut begin = 0;
        for (own, length) in self.right.iter_mut().zip(&self.lengths) {
            *own = self.work[begin];
            begin += 1 + *length as usize;
        }
        let (mut x, mut targets) = (self.work.as_mut_slice(), self.targets.as_slice());
        let mut lower = self.lower.as_mut_slice();
        let mut is_weak = false;
        let pivots = self.inverse.iter_mut().zip(&self.right);
        for (&length, (inverse, whole)) in self.lengths.iter().zip(pivots) {
            let own;
            (own, x) = std::mem::take(&mut x).split_at_mut(1 + length as usize);
            let [pivot, below @ ..] = own else { break };
            is_weak |= !(*pivot > WEAK * whole && *pivot < f64::INFINITY);
            *inverse = 1.0 / *pivot;
            let (kept, places);
            (kept, lower) = std::mem::take(&mut lower).split_at_mut(below.len());
            (places, targets) = targets.split_at(below.len() * (below.len() + 1) / 2);
            let to = (kept, places, &mut *x);
            // Chains and loops have few below, and the compiler writes out loops whose length it knows.
            match below.len() {
                0 => {}
                1 => eliminate::<1>(below, *inverse, to),
                2 => eliminate::<2>(below, *inverse, to),
                3 => eliminate::<3>(below, *inverse, to),
                4 => eliminate::<4>(below, *inverse, to),
                _ => eliminate_many(below, *inverse, to),
            }
        }
        if is_weak { Err(Weak) } else { Ok(()) }
    }

    /// B Bᵀ, to be eliminated.
    fn multiply(&mut self) {
        self.work.fill(0.0);
        let (mut values, mut targets) = (self.values.as_slice(), self.products.as_slice());
        let x = self.work.as_mut_slice();
        for &length in &self.columns {
            let (own, places);
            (own, values) = values.split_at(length as usize);
            (places, targets) = targets.split_at(own.len() * (own.len() + 1) / 2);
            // As of L: pins have two entries in a place, and four in an angle.
            match own.len() {
                1 => multiply::<1>(own, places, x),
                2 => multiply::<2>(own, places, x),
                4 => multiply::<4>(own, places, x),
                _ => multiply_many(own, places, x),
            }
        }
    }

    /// Takes z₀ (columns) to the z nearest to it with B z = c (rows).
    pub fn project(&mut self, z: &mut [f64], c: &[f64]) {
        let off = self.residual(z, c);
        self.shift(z);
        if self.residual(z, c) > UNMET * off {
            self.shift(z);
        }
    }

    /// Puts B z − c to the right-hand side, in the order of elimination; its largest part.
    fn residual(&mut self, z: &[f64], c: &[f64]) -> f64 {
        for (c, &at) in c.iter().zip(&self.position) {
            self.right[at as usize] = -c;
        }
        let right = self.right.as_mut_slice();
        for (&[row, column], value) in self.places.iter().zip(&self.values) {
            right[row as usize] += value * z[column as usize];
        }
        let right = self.right.iter();
        right.map(|right| right.abs()).fold(
            0.0,
            |most, right| {
                if right > most { right } else { most }
            },
        )
    }

    /// z −= Bᵀ λ, with λ of the right-hand side.
    fn shift(&mut self, z: &mut [f64]) {
        let y = self.right.as_mut_slice();
        for (l, &[row, column]) in self.lower.iter().zip(&self.lower_places) {
            y[row as usize] -= l * y[column as usize];
        }
        for (y, inverse) in y.iter_mut().zip(&self.inverse) {
            *y *= inverse;
        }
        for (l, &[row, column]) in self.lower.iter().zip(&self.lower_places).rev() {
            y[column as usize] -= l * y[row as usize];
        }
        for (&[row, column], value) in self.places.iter().zip(&self.values) {
            z[column as usize] -= value * y[row as usize];
        }
    }
}

/// Adds the products of a column of B with itself.
#[inline(always)]
fn multiply_many(own: &[f64], places: &[u32], x: &mut [f64]) {
    let mut begin = 0;
    for (index, value) in own.iter().enumerate() {
        let behind = &own[index..];
        for (other, &target) in behind.iter().zip(&places[begin..][..behind.len()]) {
            x[target as usize] += value * other;
        }
        begin += behind.len();
    }
}

/// The same of N entries.
fn multiply<const N: usize>(own: &[f64], places: &[u32], x: &mut [f64]) {
    multiply_many(&own[..N], &places[..N * (N + 1) / 2], x);
}

/// A column of L, where its products go, and what is behind the column.
type Column<'a> = (&'a mut [f64], &'a [u32], &'a mut [f64]);

/// Makes a column of L from what is below its pivot, and takes its products from what is behind.
#[inline(always)]
fn eliminate_many(below: &[f64], inverse: f64, (kept, places, x): Column) {
    let mut begin = 0;
    for (index, kept) in kept.iter_mut().enumerate().take(below.len()) {
        let (own, l) = (&below[index..], below[index] * inverse);
        *kept = l;
        for (other, &target) in own.iter().zip(&places[begin..][..own.len()]) {
            x[target as usize] -= other * l;
        }
        begin += own.len();
    }
}

/// The same of N.
fn eliminate<const N: usize>(below: &[f64], inverse: f64, (kept, places, x): Column) {
    let places = &places[..N * (N + 1) / 2];
    eliminate_many(&below[..N], inverse, (&mut kept[..N], places, x));
}

/// Rows of the columns of L from those of the matrix, both in the order of elimination and ascending: a column hands what it has below
/// its first row on to that column.
fn filled(mut below: Vec<Vec<u32>>) -> Vec<Vec<u32>> {
    for column in 0..below.len() {
        below[column].sort_unstable();
        below[column].dedup();
        if let [first, rest @ ..] = below[column].as_slice() {
            let (first, rest) = (*first as usize, rest.to_vec());
            below[first].extend(rest);
        }
    }
    below
}
