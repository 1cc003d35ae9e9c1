//! Complex factors on the pivots and the pattern of real ones.
//!
//! A matrix with complex values on the same pattern is eliminated as the real one was: nothing is searched for, and the
//! lists of rows are those that are there. Its pivots are good where both matrices are alike but for phases; where they are
//! not, the growth of the entries says so.

use super::{GROWTH_LIMIT, SparseLu};

/// A complex number: real and imaginary part.
pub type Complex = [f64; 2];

/// Values of factors whose pattern a [`SparseLu`] has.
#[derive(Debug, Clone, Default)]
pub struct ComplexLu {
    lower: Vec<Complex>,
    upper: Vec<Complex>,
    inverse_pivot: Vec<Complex>,
    column: Vec<Complex>,
    vector: Vec<Complex>,
    factored: bool,
}

impl ComplexLu {
    /// Makes room for factors on the pattern of `real`.
    pub fn reserve(&mut self, real: &SparseLu) {
        let (n, zero) = (real.order.len(), [0.0; 2]);
        self.lower.resize(real.lower.entries.len(), zero);
        self.upper.resize(real.upper.entries.len(), zero);
        for vector in [&mut self.inverse_pivot, &mut self.column, &mut self.vector] {
            vector.resize(n, zero);
        }
    }

    /// Factors values on the pattern of `real`, by the pivots of its last factorisation; false where these are bad.
    ///
    /// # Panics
    /// Without factors of `real`, or when there is not one value per entry of its pattern.
    pub fn factor(&mut self, real: &SparseLu, values: &[Complex]) -> bool {
        let n = real.order.len();
        real.assert_ready(n);
        assert_eq!(values.len(), real.pattern.entries(), "one value per entry");
        self.reserve(real);
        let x = &mut self.column[..n];
        let (mut growth, mut is_sound) = (0.0, true);
        for j in 0..n {
            let column = real.order.columns()[j] as usize;
            let rows = real.pattern.column(column).iter();
            for (&row, value) in rows.zip(&values[real.pattern.span(column)]) {
                x[real.position[row as usize] as usize] = *value;
            }
            let above = real.upper.start[j] as usize..real.upper.start[j + 1] as usize;
            for (entry, to) in real.upper.entries[above.clone()]
                .iter()
                .zip(&mut self.upper[above])
            {
                let k = entry.row as usize;
                let u = std::mem::take(&mut x[k]);
                *to = u;
                let column = real.lower.start[k] as usize..real.lower.start[k + 1] as usize;
                for (l, value) in real.lower.entries[column.clone()]
                    .iter()
                    .zip(&self.lower[column])
                {
                    subtract(&mut x[l.row as usize], *value, u);
                }
            }
            let inverse = inverse(std::mem::take(&mut x[j]));
            self.inverse_pivot[j] = inverse;
            is_sound &= inverse[0].is_finite() && inverse[1].is_finite();
            let below = real.lower.start[j] as usize..real.lower.start[j + 1] as usize;
            for (entry, to) in real.lower.entries[below.clone()]
                .iter()
                .zip(&mut self.lower[below])
            {
                *to = product(std::mem::take(&mut x[entry.row as usize]), inverse);
                growth = f64::max(growth, square(*to));
            }
        }
        // A maximum would lose what is no number, which spreads to the last pivot.
        self.factored = is_sound && growth <= GROWTH_LIMIT * GROWTH_LIMIT;
        if !self.factored {
            self.column.fill([0.0; 2]);
        }
        self.factored
    }

    /// Overwrites b with the x of A x = b; `real` is the one that the factors were made with.
    ///
    /// # Panics
    /// Without factors, or when b is not as long as the matrix.
    pub fn solve(&mut self, real: &SparseLu, b: &mut [Complex]) {
        let n = real.order.len();
        assert!(
            self.factored && b.len() == n,
            "solve wants factors of the same size before it"
        );
        let y = &mut self.vector[..n];
        for (&at, value) in real.position.iter().zip(&*b) {
            y[at as usize] = *value;
        }
        for j in 0..n {
            let factor = y[j];
            let column = real.lower.start[j] as usize..real.lower.start[j + 1] as usize;
            for (l, value) in real.lower.entries[column.clone()]
                .iter()
                .zip(&self.lower[column])
            {
                subtract(&mut y[l.row as usize], *value, factor);
            }
        }
        for j in (0..n).rev() {
            let factor = product(y[j], self.inverse_pivot[j]);
            y[j] = factor;
            let column = real.upper.start[j] as usize..real.upper.start[j + 1] as usize;
            for (u, value) in real.upper.entries[column.clone()]
                .iter()
                .zip(&self.upper[column])
            {
                subtract(&mut y[u.row as usize], *value, factor);
            }
        }
        for (&column, value) in real.order.columns().iter().zip(&*y) {
            b[column as usize] = *value;
        }
    }
}

fn product(a: Complex, b: Complex) -> Complex {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

/// a −= b c.
fn subtract(a: &mut Complex, b: Complex, c: Complex) {
    let bc = product(b, c);
    a[0] -= bc[0];
    a[1] -= bc[1];
}

fn square(a: Complex) -> f64 {
    a[0] * a[0] + a[1] * a[1]
}

fn inverse(a: Complex) -> Complex {
    // By the larger part, so that nothing overflows that need not.
    let size = a[0].abs().max(a[1].abs());
    let [re, im] = [a[0] / size, a[1] / size];
    let over = 1.0 / (size * square([re, im]));
    [re * over, -im * over]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linkage::{self, Random};
    use crate::{ColumnOrder, Pattern};

    #[test]
    fn solutions_satisfy_the_equations() {
        let (bodies, pins) = linkage::four_bar_chain(20, 0.8);
        let matrix = linkage::kkt(&linkage::jacobian(bodies, &pins, &[]), &mut Random(3));
        let (pattern, slots) =
            Pattern::from_entries(matrix.rows, matrix.columns, &matrix.positions()).unwrap();
        let mut real = vec![0.0; pattern.entries()];
        let mut values = vec![[0.0; 2]; pattern.entries()];
        let phase = [0.6, 0.8];
        for (&slot, &(row, column, value)) in slots.iter().zip(&matrix.entries) {
            real[slot as usize] += value;
            // Masses have another phase than the rest.
            let by = if row == column { phase } else { [1.0, 0.0] };
            values[slot as usize][0] += value * by[0];
            values[slot as usize][1] += value * by[1];
        }
        let order = ColumnOrder::paired(&pattern, &real).unwrap();
        let mut lu = SparseLu::new(pattern.clone(), order);
        lu.factor(&real).unwrap();
        let mut complex = ComplexLu::default();
        assert!(complex.factor(&lu, &values));
        let mut random = Random(5);
        let mut number = || random.below(1000) as f64 / 1000.0 - 0.5;
        let b: Vec<Complex> = (0..pattern.columns())
            .map(|_| [number(), number()])
            .collect();
        let mut x = b.clone();
        complex.solve(&lu, &mut x);
        let mut residual = b;
        for (column, factor) in x.iter().enumerate() {
            for (&row, slot) in pattern.column(column).iter().zip(pattern.span(column)) {
                subtract(&mut residual[row as usize], values[slot], *factor);
            }
        }
        let worst = residual
            .iter()
            .map(|r| square(*r).sqrt())
            .fold(0.0, f64::max);
        assert!(worst < 1e-11, "{worst:e}");
        // What has no pivot is reported, and factors that are sound follow.
        assert!(!complex.factor(&lu, &vec![[0.0; 2]; values.len()]));
        assert!(complex.factor(&lu, &values));
    }
}
