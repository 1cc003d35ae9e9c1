//! The full factorisation: reach, elimination, choice of pivots, and the frozen lists for the ones that follow.

use super::super::triangle::{Entry, NONE};
use super::frozen::Matrix;
use super::pivot::{PIVOT_THRESHOLD, SINGULAR_RATIO, magnitude};
use super::{Singular, SparseLu};

impl SparseLu {
    /// Factors with a new choice of pivots, which [`SparseLu::refactor`] then keeps.
    ///
    /// # Errors
    /// [`Singular`] with the first column, in elimination order, that depends on those before it, or with the first
    /// entry that is not finite. No factors are left then.
    pub fn factor(&mut self, values: &[f64]) -> Result<(), Singular> {
        assert_eq!(
            values.len(),
            self.pattern.entries(),
            "one value per entry of the pattern"
        );
        self.factored = false;
        self.scan(values)?;
        self.start();
        // Where the factors were there is room.
        let (mut x, n) = (std::mem::take(&mut self.frozen.numbers), self.order.len());
        x.resize(x.len().max(n), 0.0);
        let eliminated = self.eliminate_all(values, &mut x[..n]);
        self.frozen.numbers = x;
        eliminated?;
        self.freeze(values);
        self.check_finite()?;
        self.factored = true;
        Ok(())
    }

    /// All columns; `x` (n) is one to work in.
    fn eliminate_all(&mut self, values: &[f64], x: &mut [f64]) -> Result<(), Singular> {
        x.fill(0.0);
        for step in 0..self.order.len() {
            let column = self.order.columns()[step] as usize;
            self.search.find(
                step as u32,
                self.pattern.column(column),
                &self.position,
                &self.lower,
            );
            let scale = self.eliminate(step, values, x);
            let pivot_row = self.choose_pivot(step, scale, x)?;
            self.store(step, pivot_row, x);
        }
        Ok(())
    }

    /// Largest entry of each row; refuses what is not finite.
    fn scan(&mut self, values: &[f64]) -> Result<(), Singular> {
        let scale = &mut self.vector;
        scale.fill(0.0);
        for column in 0..self.pattern.columns() {
            for (&row, value) in self
                .pattern
                .column(column)
                .iter()
                .zip(&values[self.pattern.span(column)])
            {
                if !value.is_finite() {
                    return Err(Singular {
                        column,
                        row: Some(row as usize),
                        ratio: f64::NAN,
                    });
                }
                let row = row as usize;
                scale[row] = scale[row].max(value.abs());
            }
        }
        Ok(())
    }

    fn start(&mut self) {
        self.position.fill(NONE);
        self.search.restart();
        self.growth = 0.0;
        self.lower.restart(self.order.len());
        self.upper.restart(self.order.len());
    }

    /// Solves L x = A(:, q_j) along the reach; U(:, j) is what pivot rows hold, the rest stays in x. Gives the largest entry of the column
    /// of A.
    fn eliminate(&mut self, step: usize, values: &[f64], x: &mut [f64]) -> f64 {
        let column = self.order.columns()[step] as usize;
        let mut scale = 0.0f64;
        for (&row, &value) in self
            .pattern
            .column(column)
            .iter()
            .zip(&values[self.pattern.span(column)])
        {
            x[row as usize] = value;
            scale = scale.max(value.abs());
        }
        for &row in self.search.reach().iter().rev() {
            let k = self.position[row as usize];
            if k == NONE {
                continue;
            }
            let u = std::mem::take(&mut x[row as usize]);
            self.upper.entries.push(Entry { row: k, value: u });
            for l in self.lower.column(k) {
                x[l.row as usize] -= l.value * u;
            }
        }
        self.upper.close_column();
        scale
    }

    /// The preferred row when it is large enough, else the row with the largest entry.
    fn choose_pivot(&self, step: usize, scale: f64, x: &[f64]) -> Result<u32, Singular> {
        let column = self.order.columns()[step];
        let preferred = self.order.preferred()[column as usize];
        let (mut best, mut largest, mut partner) = (NONE, 0.0, 0.0);
        for &row in self.search.reach() {
            if self.position[row as usize] != NONE {
                continue;
            }
            let size = x[row as usize].abs();
            // NaN is taken, and refused below.
            if best == NONE || size > largest || size.is_nan() {
                (best, largest) = (row, size);
            }
            if row == preferred {
                partner = size;
            }
        }
        if best == NONE {
            return Err(Singular {
                column: column as usize,
                row: None,
                ratio: 0.0,
            });
        }
        if partner > 0.0 && partner >= PIVOT_THRESHOLD * largest {
            (best, largest) = (preferred, partner);
        }
        let scale = scale.min(self.vector[best as usize]);
        let ratio = if largest == 0.0 { 0.0 } else { largest / scale };
        if ratio.is_nan()
            || ratio <= SINGULAR_RATIO
            || !largest.is_finite()
            || !(1.0 / largest).is_finite()
        {
            let ratio = if largest.is_finite() { ratio } else { f64::NAN };
            return Err(Singular {
                column: column as usize,
                row: Some(best as usize),
                ratio,
            });
        }
        Ok(best)
    }

    /// Takes the pivot and L(:, j) out of x, which is zero again after. The pivot's inverse takes the place of the row's scale.
    fn store(&mut self, step: usize, pivot_row: u32, x: &mut [f64]) {
        let inverse = 1.0 / std::mem::take(&mut x[pivot_row as usize]);
        self.position[pivot_row as usize] = step as u32;
        self.row_scale[step] = std::mem::replace(&mut self.vector[pivot_row as usize], inverse);
        for &row in self.search.reach() {
            if self.position[row as usize] == NONE {
                let value = std::mem::take(&mut x[row as usize]) * inverse;
                self.growth = self.growth.max(value.abs());
                self.lower.entries.push(Entry { row, value });
            }
        }
        self.lower.close_column();
    }

    /// Renumbers L by pivots, sorts both factors, and lists the arithmetic.
    fn freeze(&mut self, values: &[f64]) {
        for entry in &mut self.lower.entries {
            entry.row = self.position[entry.row as usize];
        }
        self.lower.sort_columns();
        self.upper.sort_columns();
        self.lower.shrink();
        self.upper.shrink();
        let matrix = Matrix {
            values,
            scales: &self.row_scale,
            pattern: &self.pattern,
            columns: self.order.columns(),
            position: &self.position,
        };
        let factors = [&self.lower, &self.upper];
        let room = self.search.room();
        self.frozen.take(factors, &self.vector, &matrix, room);
        self.permutation_sign = parity(&self.position, self.search.marks())
            * parity(self.order.columns(), self.search.marks());
    }

    /// Products can overflow although entries and pivots do not.
    fn check_finite(&self) -> Result<(), Singular> {
        for (step, span) in self.upper.start.windows(2).enumerate() {
            let column = &self.upper.entries[span[0] as usize..span[1] as usize];
            let largest = column
                .iter()
                .chain(self.lower.column(step as u32))
                .fold(0, |m, e| m.max(magnitude(e.value)));
            if !f64::from_bits(largest).is_finite() {
                return Err(Singular {
                    column: self.order.columns()[step] as usize,
                    row: None,
                    ratio: f64::NAN,
                });
            }
        }
        Ok(())
    }
}

/// +1 for an even permutation, −1 for an odd one: each cycle of even length turns the sign.
fn parity(permutation: &[u32], seen: &mut [u32]) -> f64 {
    seen.fill(NONE);
    let mut sign = 1.0;
    for first in 0..permutation.len() {
        let mut at = first;
        let mut length = 0;
        while seen[at] == NONE {
            seen[at] = 0;
            at = permutation[at] as usize;
            length += 1;
        }
        if length > 0 && length % 2 == 0 {
            sign = -sign;
        }
    }
    sign
}
