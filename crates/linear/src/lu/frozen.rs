//! Factors with kept pivots: which arithmetic to repeat, as lists that are gone through once.
//!
//! ```text
//! for k = 1 … n     l_ik = x_ik / x_kk         i in L(:, k)
//!                   x_ij −= l_ik u_kj          i in L(:, k), j in U(k, :)
//! ```
//!
//! x begins as P A Q. Where each product goes is found once, so that no column is spread out and gathered again: of linkages the
//! columns hold two or three entries, and loops over them would cost more than their arithmetic. There is a number for each product,
//! four bytes beside the eight of an entry. Of matrices that fill in there would be too many: they go column by column,
//!
//! ```text
//! for j = 1 … n     for k in U(:, j):  u_kj = x_k,  x_i −= l_ik u_kj,     then  l_ij = x_i / x_j
//! ```
//!
//! which does the same to each entry in the same order, to the last bit.

#[cfg(test)]
mod tests;

use super::super::pattern::Pattern;
use super::super::triangle::Triangle;
use super::{SINGULAR_RATIO, magnitude};

/// Products that are listed, at most: 16 MB of numbers.
const LISTED: u64 = 1 << 22;

/// Factors on a frozen pattern.
#[derive(Debug, Clone, Default)]
pub(super) struct Frozen {
    /// How many entries L(:, k) and U(k, :) have.
    lengths: Vec<[u32; 2]>,
    /// L by columns, each by rows upwards, and the row and the column of each entry.
    lower: Vec<f64>,
    lower_places: Vec<[u32; 2]>,
    /// U by rows, each by columns downwards, and these.
    upper: Vec<f64>,
    upper_places: Vec<u32>,
    /// 1/x_kk.
    pub inverse_pivot: Vec<f64>,
    /// x: for each k the pivot, what becomes L(:, k), and what becomes U(k, :).
    work: Vec<f64>,
    /// Where each entry of A goes.
    slots: Vec<u32>,
    /// Where products go: for each k, for each u of its row, those with all l, counted from behind what x has of k.
    targets: Vec<u32>,
    /// For each k where x, L and targets begin, and how many of its row are placed; then where rows of a column are.
    begin: Vec<[u32; 3]>,
    placed: Vec<u32>,
    at: Vec<u32>,
    /// Where they are not: how many entries U(:, j) has, and their rows upwards, for each j.
    columns: Vec<u32>,
    /// Whether products are listed, and how many may be.
    is_listed: bool,
    most: u64,
}

/// A matrix in pivot order, and what a pivot is small by.
pub(super) struct Matrix<'a> {
    /// By slots.
    pub values: &'a [f64],
    /// Of the rows.
    pub scales: &'a [f64],
    pub pattern: &'a Pattern,
    /// Columns in pivot order.
    pub columns: &'a [u32],
    /// Pivot position of each row.
    pub position: &'a [u32],
}

impl Matrix<'_> {
    /// Row in pivot order, and slot, of the entries of a column.
    fn entries(&self, step: usize) -> impl Iterator<Item = (usize, usize)> {
        let column = self.columns[step] as usize;
        let rows = self.pattern.column(column).iter();
        let rows = rows.map(|&row| self.position[row as usize] as usize);
        rows.zip(self.pattern.span(column))
    }

    /// Whether a pivot is too small to be one: by the scale of its row, or that of its column where that is less.
    #[inline]
    fn is_small(&self, step: usize, pivot: f64) -> bool {
        let is_enough = |scale: f64| pivot.abs() > SINGULAR_RATIO * scale;
        !is_enough(self.scales[step]) && !is_enough(self.scales[step].min(self.column_scale(step)))
    }

    #[cold]
    fn column_scale(&self, step: usize) -> f64 {
        let own = &self.values[self.pattern.span(self.columns[step] as usize)];
        let largest = |most, value: &f64| f64::max(most, value.abs());
        own.iter().fold(0.0, largest)
    }
}

/// What a repetition came to.
pub(super) struct Repeated {
    /// Largest entry of L.
    pub growth: f64,
    /// Whether all is finite, and no pivot too small.
    pub is_sound: bool,
}

impl Frozen {
    /// Room for n pivots.
    pub fn new(n: usize) -> Self {
        Frozen {
            inverse_pivot: vec![0.0; n],
            most: LISTED,
            ..Frozen::default()
        }
    }

    /// Number of entries of L and U, diagonal once.
    pub fn fill(&self) -> usize {
        self.work.len()
    }

    /// Takes the factors of a choice of pivots, those on the diagonal being here.
    pub fn take(&mut self, lower: &Triangle, upper: &Triangle, matrix: &Matrix) {
        self.lay_out(lower, upper);
        refill(&mut self.slots, matrix.pattern.entries(), 0);
        let n = self.inverse_pivot.len();
        for j in (0..n).rev() {
            let [begin, own, ..] = self.begin[j];
            let (above, below) = (upper.column(j as u32), lower.column(j as u32));
            self.at[j] = begin;
            for (l, index) in below.iter().zip(0..) {
                let place = (own + index) as usize;
                self.at[l.row as usize] = begin + 1 + index;
                self.lower[place] = l.value;
                self.lower_places[place] = [l.row, j as u32];
            }
            for u in above {
                let k = u.row as usize;
                let ([begin, ..], [below, _]) = (self.begin[k], self.lengths[k]);
                let place = self.row(k) + self.placed[k] as usize;
                self.at[k] = begin + 1 + below + self.placed[k];
                self.upper[place] = u.value;
                self.upper_places[place] = j as u32;
            }
            for u in above.iter().filter(|_| self.is_listed) {
                let k = u.row as usize;
                let ([.., targets], [below, _]) = (self.begin[k], self.lengths[k]);
                let from = (targets + self.placed[k] * below) as usize;
                let own = &mut self.targets[from..from + below as usize];
                for (target, l) in own.iter_mut().zip(lower.column(k as u32)) {
                    // Counted from behind what is of k.
                    *target = self.at[l.row as usize] - self.begin[k + 1][0];
                }
            }
            for u in above {
                self.placed[u.row as usize] += 1;
            }
            for (row, slot) in matrix.entries(j) {
                self.slots[slot] = self.at[row];
            }
        }
    }

    /// Where U(k, :) begins: the pivots and L before it are not in it.
    fn row(&self, k: usize) -> usize {
        let [all, lower, _] = self.begin[k];
        (all - lower) as usize - k
    }

    /// Lengths, and room for what comes.
    fn lay_out(&mut self, lower: &Triangle, upper: &Triangle) {
        let n = self.inverse_pivot.len();
        refill(&mut self.lengths, n, [0; 2]);
        for (k, lengths) in self.lengths.iter_mut().enumerate() {
            lengths[0] = lower.column(k as u32).len() as u32;
        }
        for u in &upper.entries {
            self.lengths[u.row as usize][1] += 1;
        }
        let products = self.lengths.iter();
        let products = products.map(|[below, beside]| u64::from(*below) * u64::from(*beside));
        self.is_listed = products.sum::<u64>() <= self.most;
        self.begin.clear();
        self.begin.reserve_exact(n + 1);
        let mut ends = [0; 3];
        for &[below, beside] in &self.lengths {
            self.begin.push(ends);
            let products = if self.is_listed { below * beside } else { 0 };
            let lengths = [1 + below + beside, below, products];
            let both = ends.iter_mut().zip(lengths);
            both.for_each(|(end, length)| *end += length);
        }
        self.begin.push(ends);
        let [all, below, products] = ends.map(|end| end as usize);
        let beside = all - n - below;
        refill(&mut self.work, all, 0.0);
        refill(&mut self.lower, below, 0.0);
        refill(&mut self.lower_places, below, [0; 2]);
        refill(&mut self.upper, beside, 0.0);
        refill(&mut self.upper_places, beside, 0);
        refill(&mut self.targets, products, 0);
        refill(&mut self.placed, n, 0);
        refill(&mut self.at, n, 0);
        self.columns.clear();
        for j in (0..n as u32).filter(|_| !self.is_listed) {
            let column = upper.column(j);
            self.columns.push(column.len() as u32);
            self.columns.extend(column.iter().map(|u| u.row));
        }
    }

    /// The arithmetic for other values, by lists or by columns.
    pub fn repeat(&mut self, matrix: &Matrix, column: &mut [f64]) -> Repeated {
        match self.is_listed {
            true => self.repeat_lists(matrix),
            false => self.repeat_columns(matrix, column),
        }
    }

    fn repeat_lists(&mut self, matrix: &Matrix) -> Repeated {
        self.work.fill(0.0);
        for (&slot, &value) in self.slots.iter().zip(matrix.values) {
            self.work[slot as usize] = value;
        }
        let (mut kept_lower, mut kept_upper) = (self.lower.iter_mut(), self.upper.iter_mut());
        let (mut x, mut targets) = (self.work.as_mut_slice(), self.targets.iter());
        let (mut growth, mut spoilt, mut is_small) = (0, 0.0, false);
        let pivots = self.lengths.iter().zip(&mut self.inverse_pivot);
        for (k, (lengths, inverse_pivot)) in pivots.enumerate() {
            let [below, beside] = lengths.map(|length| length as usize);
            let own;
            (own, x) = std::mem::take(&mut x).split_at_mut(1 + below + beside);
            let [pivot, own @ ..] = own else { break };
            let (lower, upper) = own.split_at_mut(below);
            let inverse = 1.0 / *pivot;
            *inverse_pivot = inverse;
            spoilt += 0.0 * *pivot;
            is_small |= matrix.is_small(k, *pivot);
            for (l, kept) in lower.iter_mut().zip(&mut kept_lower) {
                *l *= inverse;
                *kept = *l;
                growth = growth.max(magnitude(*l));
            }
            for (u, kept) in upper.iter().zip(&mut kept_upper) {
                *kept = *u;
                spoilt += 0.0 * *u;
                for (l, &target) in lower.iter().zip(&mut targets) {
                    x[target as usize] -= l * u;
                }
            }
        }
        Repeated {
            growth: f64::from_bits(growth),
            is_sound: !is_small && spoilt == 0.0,
        }
    }

    /// The same with a column of zeros to work in (n).
    fn repeat_columns(&mut self, matrix: &Matrix, x: &mut [f64]) -> Repeated {
        let (mut growth, mut spoilt, mut is_small) = (0, 0.0, false);
        // The last of a row stands first.
        for (placed, [_, beside]) in self.placed.iter_mut().zip(&self.lengths) {
            *placed = *beside;
        }
        let mut rows = self.columns.as_slice();
        for j in 0..self.lengths.len() {
            for (row, slot) in matrix.entries(j) {
                x[row] = matrix.values[slot];
            }
            let own;
            (own, rows) = rows[1..].split_at(rows[0] as usize);
            for &k in own {
                let k = k as usize;
                let [_, lower, _] = self.begin[k];
                self.placed[k] -= 1;
                let u = std::mem::take(&mut x[k]);
                let place = self.row(k) + self.placed[k] as usize;
                self.upper[place] = u;
                spoilt += 0.0 * u;
                let own = lower as usize..(lower + self.lengths[k][0]) as usize;
                for (l, [row, _]) in self.lower[own.clone()].iter().zip(&self.lower_places[own]) {
                    x[*row as usize] -= l * u;
                }
            }
            let pivot = std::mem::take(&mut x[j]);
            let inverse = 1.0 / pivot;
            self.inverse_pivot[j] = inverse;
            spoilt += 0.0 * pivot;
            is_small |= matrix.is_small(j, pivot);
            let own = self.begin[j][1] as usize..self.begin[j + 1][1] as usize;
            for (l, [row, _]) in self.lower[own.clone()]
                .iter_mut()
                .zip(&self.lower_places[own])
            {
                *l = std::mem::take(&mut x[*row as usize]) * inverse;
                growth = growth.max(magnitude(*l));
            }
        }
        Repeated {
            growth: f64::from_bits(growth),
            is_sound: !is_small && spoilt == 0.0,
        }
    }

    /// L z = y and U x = z for K right-hand sides together, in pivot order.
    pub fn solve<const K: usize>(&self, y: &mut [[f64; K]]) {
        if self.lower.is_empty() && self.upper.is_empty() {
            let pivots = y.iter_mut().zip(&self.inverse_pivot);
            return pivots.for_each(|(y, inverse)| *y = y.map(|y| y * inverse));
        }
        for (&l, &[row, column]) in self.lower.iter().zip(&self.lower_places) {
            let factors = y[column as usize];
            subtract(&mut y[row as usize], l, &factors);
        }
        let (mut upper, mut places) = (self.upper.as_slice(), self.upper_places.as_slice());
        let pivots = self.lengths.iter().zip(&self.inverse_pivot);
        for (k, ([_, beside], inverse)) in pivots.enumerate().rev() {
            let begin = upper.len() - *beside as usize;
            let (own, columns);
            (upper, own) = upper.split_at(begin);
            (places, columns) = places.split_at(begin);
            let mut rest = y[k];
            for (&u, &column) in own.iter().zip(columns) {
                subtract(&mut rest, u, &y[column as usize]);
            }
            y[k] = rest.map(|rest| rest * inverse);
        }
    }

    /// Uᵀ z = y and Lᵀ x = z for K right-hand sides together, in pivot order.
    pub fn solve_transposed<const K: usize>(&self, y: &mut [[f64; K]]) {
        let (mut upper, mut places) = (self.upper.as_slice(), self.upper_places.as_slice());
        let pivots = self.lengths.iter().zip(&self.inverse_pivot);
        for (k, ([_, beside], inverse)) in pivots.enumerate() {
            let (own, columns);
            (own, upper) = upper.split_at(*beside as usize);
            (columns, places) = places.split_at(*beside as usize);
            let factors = y[k].map(|y| y * inverse);
            y[k] = factors;
            for (&u, &column) in own.iter().zip(columns) {
                subtract(&mut y[column as usize], u, &factors);
            }
        }
        let (mut lower, mut places) = (self.lower.as_slice(), self.lower_places.as_slice());
        for (k, [below, _]) in self.lengths.iter().enumerate().rev() {
            let begin = lower.len() - *below as usize;
            let (own, rows);
            (lower, own) = lower.split_at(begin);
            (places, rows) = places.split_at(begin);
            let mut rest = y[k];
            for (&l, &[row, _]) in own.iter().zip(rows) {
                subtract(&mut rest, l, &y[row as usize]);
            }
            y[k] = rest;
        }
    }

    /// Takes over the factors of another one, without allocating where it is not larger.
    pub fn take_over(&mut self, other: &Frozen) {
        self.lengths.clone_from(&other.lengths);
        self.lower.clone_from(&other.lower);
        self.lower_places.clone_from(&other.lower_places);
        self.upper.clone_from(&other.upper);
        self.upper_places.clone_from(&other.upper_places);
        self.inverse_pivot.clone_from(&other.inverse_pivot);
        self.begin.clone_from(&other.begin);
        self.placed.clone_from(&other.placed);
        self.columns.clone_from(&other.columns);
        (self.is_listed, self.most) = (other.is_listed, other.most);
        self.work.resize(other.work.len(), 0.0);
        self.slots.clone_from(&other.slots);
        self.targets.clone_from(&other.targets);
    }
}

fn refill<T: Copy>(list: &mut Vec<T>, count: usize, value: T) {
    list.clear();
    // What is frozen does not grow, and pivots are seldom others: room for many more is given back.
    if list.capacity() > count + count / 2 {
        *list = Vec::new();
    }
    list.reserve_exact(count);
    list.resize(count, value);
}

/// a −= factor·b.
fn subtract<const K: usize>(a: &mut [f64; K], factor: f64, b: &[f64; K]) {
    a.iter_mut().zip(b).for_each(|(a, b)| *a -= factor * b);
}
