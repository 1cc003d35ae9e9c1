//! LU decomposition of small dense matrices, with rows exchanged for the largest pivot, in space allocated once.

/// A square matrix by rows, or the factors that took its place.
#[derive(Debug, Clone, Default)]
pub(super) struct Lu {
    n: usize,
    values: Vec<f64>,
    /// The row exchanged with row k in step k.
    exchanged: Vec<usize>,
}

impl Lu {
    /// Makes room for n rows.
    pub fn resize(&mut self, n: usize) {
        self.n = n;
        self.values.resize(n * n, 0.0);
        self.exchanged.resize(n, 0);
    }

    /// The entries by rows, to be filled before `factor`.
    pub fn values(&mut self) -> &mut [f64] {
        &mut self.values
    }

    /// Factors in place; false where the matrix is singular or not finite.
    pub fn factor(&mut self) -> bool {
        let (n, a) = (self.n, &mut self.values);
        for k in 0..n {
            let mut pivot = k;
            for i in k + 1..n {
                if a[i * n + k].abs() > a[pivot * n + k].abs() {
                    pivot = i;
                }
            }
            self.exchanged[k] = pivot;
            if pivot != k {
                for j in 0..n {
                    a.swap(k * n + j, pivot * n + j);
                }
            }
            let inverse = 1.0 / a[k * n + k];
            if !inverse.is_finite() {
                return false;
            }
            let (upper, lower) = a.split_at_mut((k + 1) * n);
            let upper = &upper[k * n..];
            for row in lower.chunks_exact_mut(n) {
                let factor = row[k] * inverse;
                row[k] = factor;
                if factor != 0.0 {
                    for (entry, above) in row[k + 1..].iter_mut().zip(&upper[k + 1..]) {
                        *entry -= factor * above;
                    }
                }
            }
        }
        true
    }

    /// Solves A x = b in place.
    pub fn solve(&self, b: &mut [f64]) {
        let n = self.n;
        for (k, &row) in self.exchanged.iter().enumerate() {
            b.swap(k, row);
        }
        for k in 1..n {
            let (known, rest) = b.split_at_mut(k);
            rest[0] -= linkdyn_linear::math::dot(&self.values[k * n..][..k], known);
        }
        for k in (0..n).rev() {
            let (rest, known) = b.split_at_mut(k + 1);
            let row = &self.values[k * n..][..n];
            rest[k] = (rest[k] - linkdyn_linear::math::dot(&row[k + 1..], known)) / row[k];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_where_rows_must_be_exchanged() {
        let a = [0.0, 2.0, 1.0, 1.0, -2.0, -3.0, -1.0, 1.0, 2.0];
        let x = [3.0, -1.0, 0.5];
        let mut b: Vec<f64> = a
            .chunks(3)
            .map(|row| linkdyn_linear::math::dot(row, &x))
            .collect();
        let mut lu = Lu::default();
        lu.resize(3);
        lu.values().copy_from_slice(&a);
        assert!(lu.factor());
        lu.solve(&mut b);
        for (b, x) in b.iter().zip(x) {
            assert!((b - x).abs() < 1e-14);
        }
    }

    #[test]
    fn singular_matrices_are_found() {
        let mut lu = Lu::default();
        lu.resize(2);
        lu.values().copy_from_slice(&[1.0, 2.0, 2.0, 4.0]);
        assert!(!lu.factor());
        lu.values().copy_from_slice(&[1.0, f64::NAN, 2.0, 4.0]);
        assert!(!lu.factor());
    }
}
