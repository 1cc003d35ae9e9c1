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

use super::super::math::Real;
use super::super::pattern::Pattern;
use super::super::triangle::Triangle;
use super::pivot::{SINGULAR_RATIO, magnitude};
use std::cell::Cell;

/// Products that are listed, at most: 16 MB of numbers.
const LISTED: u64 = 1 << 22;

/// Factors on a frozen pattern.
#[derive(Debug, Clone, Default)]
pub(super) struct Frozen<T = f64> {
    /// How many entries L(:, k) and U(k, :) have.
    pub lengths: Vec<[u32; 2]>,
    /// 1/x_kk; L by columns, each by rows upwards; U by rows, each by columns downwards. What becomes them stands in their places
    /// before. While pivots are chosen, a column to work in.
    pub numbers: Vec<T>,
    /// The row and the column of each entry of L, and the column of each of U.
    pub lower_places: Vec<[u32; 2]>,
    upper_places: Vec<u32>,
    /// Where each entry of A goes.
    pub slots: Vec<u32>,
    /// Where products go: for each k, for each u of its row, those with all l.
    pub targets: Vec<u32>,
    /// Where they are not listed.
    columns: Columns,
    /// Whether products are listed, and how many may be.
    is_listed: bool,
    most: u64,
}

/// What going by columns needs.
#[derive(Debug, Clone, Default)]
struct Columns {
    /// How many entries U(:, j) has, and their rows upwards, for each j.
    above: Vec<u32>,
    /// Where L(:, k) and U(k, :) begin.
    begin: Vec<[u32; 2]>,
    /// How many entries of a row are placed.
    placed: Vec<u32>,
    /// A column of zeros to work in.
    x: Vec<f64>,
}

impl Columns {
    /// For factors whose rows of U begin so.
    fn lay_out(&mut self, [lower, upper]: [&Triangle; 2], begin: &[u32]) {
        let n = begin.len();
        refill(&mut self.begin, n, [0; 2]);
        refill(&mut self.placed, n, 0);
        refill(&mut self.x, n, 0.0);
        let both = lower.start.iter().zip(begin);
        for (own, (of_lower, of_upper)) in self.begin.iter_mut().zip(both) {
            *own = [*of_lower, *of_upper];
        }
        self.above.clear();
        for j in 0..n as u32 {
            let column = upper.column(j);
            self.above.push(column.len() as u32);
            self.above.extend(column.iter().map(|u| u.row));
        }
    }

    fn take_over(&mut self, other: &Columns) {
        self.above.clone_from(&other.above);
        self.begin.clone_from(&other.begin);
        self.placed.clone_from(&other.placed);
        self.x.clone_from(&other.x);
    }
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

/// Room for four numbers of each pivot while factors are laid out.
pub(super) type Room<'a> = [&'a mut [u32]; 4];

impl Frozen {
    /// Nothing yet.
    pub fn new() -> Self {
        Frozen {
            most: LISTED,
            ..Frozen::default()
        }
    }

    /// Number of entries of L and U, diagonal once.
    pub fn fill(&self) -> usize {
        self.lengths.len() + self.lower_places.len() + self.upper_places.len()
    }

    /// Takes the factors of a choice of pivots, whose inverses stand by rows.
    pub fn take(
        &mut self,
        [lower, upper]: [&Triangle; 2],
        inverse_pivots: &[f64],
        matrix: &Matrix,
        room: Room,
    ) {
        let [at, placed, begin, products] = room;
        self.lay_out([lower, upper], [begin, products]);
        refill(&mut self.slots, matrix.pattern.entries(), 0);
        for (&step, inverse) in matrix.position.iter().zip(inverse_pivots) {
            self.numbers[step as usize] = *inverse;
        }
        placed.fill(0);
        let n = self.lengths.len();
        let behind = n + self.lower_places.len();
        for j in (0..n).rev() {
            let (above, below) = (upper.column(j as u32), lower.column(j as u32));
            let own = lower.start[j] as usize;
            at[j] = j as u32;
            for (place, l) in (own..).zip(below) {
                at[l.row as usize] = (n + place) as u32;
                self.numbers[n + place] = l.value;
                self.lower_places[place] = [l.row, j as u32];
            }
            for u in above {
                let k = u.row as usize;
                let place = (begin[k] + placed[k]) as usize;
                at[k] = (behind + place) as u32;
                self.numbers[behind + place] = u.value;
                self.upper_places[place] = j as u32;
            }
            for u in above.iter().filter(|_| self.is_listed) {
                let k = u.row as usize;
                let below = self.lengths[k][0];
                let from = (products[k] + placed[k] * below) as usize;
                let own = &mut self.targets[from..from + below as usize];
                for (target, l) in own.iter_mut().zip(lower.column(k as u32)) {
                    *target = at[l.row as usize];
                }
            }
            for u in above {
                placed[u.row as usize] += 1;
            }
            for (row, slot) in matrix.entries(j) {
                self.slots[slot] = at[row];
            }
        }
    }

    /// Lengths, room for what comes, and for each k where U(k, :) and its products begin.
    fn lay_out(&mut self, [lower, upper]: [&Triangle; 2], [begin, products]: [&mut [u32]; 2]) {
        let n = lower.start.len() - 1;
        refill(&mut self.lengths, n, [0; 2]);
        for (k, lengths) in self.lengths.iter_mut().enumerate() {
            lengths[0] = lower.column(k as u32).len() as u32;
        }
        for u in &upper.entries {
            self.lengths[u.row as usize][1] += 1;
        }
        let all = self.lengths.iter();
        let all = all.map(|[below, beside]| u64::from(*below) * u64::from(*beside));
        self.is_listed = all.sum::<u64>() <= self.most;
        let mut ends = [0; 2];
        let each = self.lengths.iter().zip(begin.iter_mut().zip(products));
        for ([below, beside], (begin, products)) in each {
            [*begin, *products] = ends;
            ends[0] += beside;
            ends[1] += if self.is_listed { below * beside } else { 0 };
        }
        let [below, beside] = [&lower.entries, &upper.entries].map(Vec::len);
        refill(&mut self.numbers, n + below + beside, 0.0);
        refill(&mut self.lower_places, below, [0; 2]);
        refill(&mut self.upper_places, beside, 0);
        refill(&mut self.targets, ends[1] as usize, 0);
        if self.is_listed {
            self.columns = Columns::default();
        } else {
            self.columns.lay_out([lower, upper], begin);
        }
    }

    /// The arithmetic for other values, by lists or by columns.
    pub fn repeat(&mut self, matrix: &Matrix) -> Repeated {
        match self.is_listed {
            true => self.repeat_lists(matrix),
            false => self.repeat_columns(matrix),
        }
    }

    /// By the lists.
    fn repeat_lists(&mut self, matrix: &Matrix) -> Repeated {
        self.numbers.fill(0.0);
        for (&slot, &value) in self.slots.iter().zip(matrix.values) {
            self.numbers[slot as usize] = value;
        }
        // What is done with one k is written to all that follows.
        let x = Cell::from_mut(&mut self.numbers[..]).as_slice_of_cells();
        let (pivots, rest) = x.split_at(self.lengths.len());
        let (mut lower, mut upper) = rest.split_at(self.lower_places.len());
        let mut targets = self.targets.iter();
        let (mut growth, mut spoilt, mut is_small) = (0, 0.0, false);
        for (k, (lengths, kept)) in self.lengths.iter().zip(pivots).enumerate() {
            let [below, beside] = lengths.map(|length| length as usize);
            let (column, row);
            (column, lower) = lower.split_at(below);
            (row, upper) = upper.split_at(beside);
            let pivot = kept.get();
            let inverse = 1.0 / pivot;
            kept.set(inverse);
            spoilt += 0.0 * pivot;
            is_small |= matrix.is_small(k, pivot);
            for l in column {
                let own = l.get() * inverse;
                l.set(own);
                growth = growth.max(magnitude(own));
            }
            for u in row {
                let u = u.get();
                spoilt += 0.0 * u;
                for (l, &target) in column.iter().zip(&mut targets) {
                    let to = &x[target as usize];
                    to.set(to.get() - l.get() * u);
                }
            }
        }
        Repeated {
            growth: f64::from_bits(growth),
            is_sound: !is_small && spoilt == 0.0,
        }
    }

    /// Takes over the factors of another one, without allocating where it is not larger.
    pub fn take_over(&mut self, other: &Frozen) {
        self.lengths.clone_from(&other.lengths);
        self.numbers.clone_from(&other.numbers);
        self.lower_places.clone_from(&other.lower_places);
        self.upper_places.clone_from(&other.upper_places);
        self.slots.clone_from(&other.slots);
        self.targets.clone_from(&other.targets);
        self.columns.take_over(&other.columns);
        (self.is_listed, self.most) = (other.is_listed, other.most);
    }

    /// The arithmetic for other values, column by column.
    fn repeat_columns(&mut self, matrix: &Matrix) -> Repeated {
        let (mut growth, mut spoilt, mut is_small) = (0, 0.0, false);
        let (pivots, rest) = self.numbers.split_at_mut(self.lengths.len());
        let (lower, upper) = rest.split_at_mut(self.lower_places.len());
        let Columns {
            above,
            begin,
            placed,
            x,
        } = &mut self.columns;
        // The last of a row stands first.
        for (placed, [_, beside]) in placed.iter_mut().zip(&self.lengths) {
            *placed = *beside;
        }
        let mut rows = above.as_slice();
        for j in 0..self.lengths.len() {
            for (row, slot) in matrix.entries(j) {
                x[row] = matrix.values[slot];
            }
            let own;
            (own, rows) = rows[1..].split_at(rows[0] as usize);
            for &k in own {
                let k = k as usize;
                let [of_lower, of_upper] = begin[k].map(|begin| begin as usize);
                placed[k] -= 1;
                let u = std::mem::take(&mut x[k]);
                upper[of_upper + placed[k] as usize] = u;
                spoilt += 0.0 * u;
                let own = of_lower..of_lower + self.lengths[k][0] as usize;
                for (l, [row, _]) in lower[own.clone()].iter().zip(&self.lower_places[own]) {
                    x[*row as usize] -= l * u;
                }
            }
            let pivot = std::mem::take(&mut x[j]);
            let inverse = 1.0 / pivot;
            pivots[j] = inverse;
            spoilt += 0.0 * pivot;
            is_small |= matrix.is_small(j, pivot);
            let from = begin[j][0] as usize;
            let own = from..from + self.lengths[j][0] as usize;
            for (l, [row, _]) in lower[own.clone()].iter_mut().zip(&self.lower_places[own]) {
                *l = std::mem::take(&mut x[*row as usize]) * inverse;
                growth = growth.max(magnitude(*l));
            }
        }
        Repeated {
            growth: f64::from_bits(growth),
            is_sound: !is_small && spoilt == 0.0,
        }
    }
}

impl<T: Real> Frozen<T> {
    /// 1/x_kk, L and U.
    fn parts(&self) -> [&[T]; 3] {
        let (pivots, rest) = self.numbers.split_at(self.lengths.len());
        let (lower, upper) = rest.split_at(self.lower_places.len());
        [pivots, lower, upper]
    }

    /// 1/x_kk.
    pub fn inverse_pivots(&self) -> &[T] {
        &self.numbers[..self.lengths.len()]
    }

    /// L z = y and U x = z for K right-hand sides together, in pivot order.
    pub fn solve<const K: usize>(&self, y: &mut [[T; K]]) {
        let [inverses, lower, mut upper] = self.parts();
        if lower.is_empty() && upper.is_empty() {
            let pivots = y.iter_mut().zip(inverses);
            return pivots.for_each(|(y, inverse)| *y = y.map(|y| y * *inverse));
        }
        for (&l, &[row, column]) in lower.iter().zip(&self.lower_places) {
            let factors = y[column as usize];
            subtract(&mut y[row as usize], l, &factors);
        }
        let mut places = self.upper_places.as_slice();
        let pivots = self.lengths.iter().zip(inverses);
        for (k, ([_, beside], inverse)) in pivots.enumerate().rev() {
            let begin = upper.len() - *beside as usize;
            let (own, columns);
            (upper, own) = upper.split_at(begin);
            (places, columns) = places.split_at(begin);
            let mut rest = y[k];
            for (&u, &column) in own.iter().zip(columns) {
                subtract(&mut rest, u, &y[column as usize]);
            }
            y[k] = rest.map(|rest| rest * *inverse);
        }
    }

    /// Uᵀ z = y and Lᵀ x = z for K right-hand sides together, in pivot order.
    pub fn solve_transposed<const K: usize>(&self, y: &mut [[T; K]]) {
        let [inverses, mut lower, mut upper] = self.parts();
        let mut places = self.upper_places.as_slice();
        let pivots = self.lengths.iter().zip(inverses);
        for (k, ([_, beside], inverse)) in pivots.enumerate() {
            let (own, columns);
            (own, upper) = upper.split_at(*beside as usize);
            (columns, places) = places.split_at(*beside as usize);
            let factors = y[k].map(|y| y * *inverse);
            y[k] = factors;
            for (&u, &column) in own.iter().zip(columns) {
                subtract(&mut y[column as usize], u, &factors);
            }
        }
        let mut places = self.lower_places.as_slice();
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
}

impl Frozen {
    /// How many there are.
    pub fn pivots(&self) -> usize {
        self.lengths.len()
    }

    /// Of other numbers, where products are listed.
    pub fn of<T: Real>(&self) -> Option<Frozen<T>> {
        self.is_listed.then(|| Frozen {
            lengths: self.lengths.clone(),
            numbers: vec![T::zero(); self.numbers.len()],
            lower_places: self.lower_places.clone(),
            upper_places: self.upper_places.clone(),
            slots: self.slots.clone(),
            targets: self.targets.clone(),
            columns: Columns::default(),
            is_listed: true,
            most: self.most,
        })
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
fn subtract<T: Real, const K: usize>(a: &mut [T; K], factor: T, b: &[T; K]) {
    a.iter_mut().zip(b).for_each(|(a, b)| *a -= factor * *b);
}
