//! Factors of matrices that fill in: column by column.

use super::super::super::triangle::Triangle;
use super::super::magnitude;
use super::{Frozen, Matrix, Repeated, refill};

/// What going by columns needs.
#[derive(Debug, Clone, Default)]
pub(super) struct Columns {
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
    pub(super) fn lay_out(&mut self, [lower, upper]: [&Triangle; 2], begin: &[u32]) {
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

    pub(super) fn take_over(&mut self, other: &Columns) {
        self.above.clone_from(&other.above);
        self.begin.clone_from(&other.begin);
        self.placed.clone_from(&other.placed);
        self.x.clone_from(&other.x);
    }
}

impl Frozen {
    /// The arithmetic for other values, column by column.
    pub(super) fn repeat_columns(&mut self, matrix: &Matrix) -> Repeated {
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
