//! Factors of small dense matrices, in place and in space allocated once.
//!
//! ```text
//! P A = L U          rows exchanged for the largest pivot        A (n, n) by rows       [`SmallLu`]
//! A   = L Lᵀ         A symmetric, positive definite              lower half             [`cholesky`]
//! ```
//!
//! The step loop solves such systems at every evaluation (stages of Radau, forces that depend on multipliers, the reduced
//! mass matrix), with n from 1 to some dozens that only the model tells. nalgebra's factors of matrices whose size is not
//! known to the compiler are allocated anew each time, and a step may not allocate; that is why these are our own.
//! (Golub and Van Loan, Matrix Computations, 2013, §3.4 and §4.2.)

use crate::math::dot;

/// A square matrix by rows, or the factors that took its place.
#[derive(Debug, Clone, Default)]
pub struct SmallLu {
    n: usize,
    values: Vec<f64>,
    /// The row exchanged with row k in step k.
    exchanged: Vec<usize>,
    determinant: f64,
}

impl SmallLu {
    /// Room for n rows.
    pub fn new(n: usize) -> Self {
        let mut lu = SmallLu::default();
        lu.resize(n);
        lu
    }

    /// Makes room for n rows.
    pub fn resize(&mut self, n: usize) {
        self.n = n;
        self.values.resize(n * n, 0.0);
        self.exchanged.resize(n, 0);
    }

    /// The entries by rows, to be filled before each [`SmallLu::factor`].
    pub fn values(&mut self) -> &mut [f64] {
        &mut self.values
    }

    /// Factors in place; false where the matrix is singular or not finite.
    pub fn factor(&mut self) -> bool {
        let (n, a) = (self.n, &mut self.values);
        self.determinant = 0.0;
        let mut determinant = 1.0;
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
                determinant = -determinant;
            }
            determinant *= a[k * n + k];
            let inverse = 1.0 / a[k * n + k];
            if !inverse.is_finite() || inverse == 0.0 {
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
        self.determinant = determinant;
        true
    }

    /// det A of the last factors; 0 where there are none.
    pub fn determinant(&self) -> f64 {
        self.determinant
    }

    /// Solves Aᵀ x = b in place.
    pub fn solve_transposed(&self, b: &mut [f64]) {
        let n = self.n;
        for k in 0..n {
            let (known, rest) = b.split_at_mut(k + 1);
            let row = &self.values[k * n..][..n];
            known[k] /= row[k];
            for (b, above) in rest.iter_mut().zip(&row[k + 1..]) {
                *b -= known[k] * above;
            }
        }
        for k in (1..n).rev() {
            let (rest, known) = b.split_at_mut(k);
            for (b, left) in rest.iter_mut().zip(&self.values[k * n..][..k]) {
                *b -= known[0] * left;
            }
        }
        for (k, &row) in self.exchanged.iter().enumerate().rev() {
            b.swap(k, row);
        }
    }

    /// Solves A x = b in place.
    pub fn solve(&self, b: &mut [f64]) {
        let n = self.n;
        for (k, &row) in self.exchanged.iter().enumerate() {
            b.swap(k, row);
        }
        for k in 1..n {
            let (known, rest) = b.split_at_mut(k);
            rest[0] -= dot(&self.values[k * n..][..k], known);
        }
        for k in (0..n).rev() {
            let (rest, known) = b.split_at_mut(k + 1);
            let row = &self.values[k * n..][..n];
            rest[k] = (rest[k] - dot(&row[k + 1..], known)) / row[k];
        }
    }
}

/// Whether all leading minors of a matrix (n, n) by rows are positive, which it is not any more afterwards.
///
/// Of a matrix without positive entries beside its diagonal that says that its inverse has no negative ones (an
/// M-matrix; Berman and Plemmons 1994, ch. 6).
pub fn leading_minors_are_positive(a: &mut [f64], n: usize) -> bool {
    for p in 0..n {
        if a[p * n + p] <= 0.0 {
            return false;
        }
        for i in p + 1..n {
            let factor = a[i * n + p] / a[p * n + p];
            for j in p + 1..n {
                a[i * n + j] -= factor * a[p * n + j];
            }
        }
    }
    true
}

/// Puts L in the lower half of A (n, n), of which that half alone is read; false where a pivot is not above `least` times
/// its diagonal entry.
pub fn cholesky(a: &mut [f64], n: usize, least: f64) -> bool {
    for i in 0..n {
        for j in 0..=i {
            let sum: f64 = (0..j).map(|k| a[i * n + k] * a[j * n + k]).sum();
            let rest = a[i * n + j] - sum;
            if i == j {
                if rest.is_nan() || rest <= least * a[i * n + i].abs() {
                    return false;
                }
                a[i * n + i] = rest.sqrt();
            } else {
                a[i * n + j] = rest / a[j * n + j];
            }
        }
    }
    true
}

/// x ← (L Lᵀ)⁻¹ x, with L in the lower half of `a` (n, n).
pub fn cholesky_solve(a: &[f64], x: &mut [f64]) {
    let n = x.len();
    for i in 0..n {
        let sum: f64 = (0..i).map(|k| a[i * n + k] * x[k]).sum();
        x[i] = (x[i] - sum) / a[i * n + i];
    }
    for i in (0..n).rev() {
        let sum: f64 = (i + 1..n).map(|k| a[k * n + i] * x[k]).sum();
        x[i] = (x[i] - sum) / a[i * n + i];
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linkage::Random;
    use faer::linalg::solvers::Solve;
    use faer::{Mat, MatRef};

    fn random(n: usize, random: &mut Random) -> Vec<f64> {
        (0..n * n).map(|_| random.signed()).collect()
    }

    #[test]
    fn solves_where_rows_must_be_exchanged() {
        let a = [0.0, 2.0, 1.0, 1.0, -2.0, -3.0, -1.0, 1.0, 2.0];
        let x = [3.0, -1.0, 0.5];
        let mut b: Vec<f64> = a.chunks(3).map(|row| dot(row, &x)).collect();
        let mut lu = SmallLu::new(3);
        lu.values().copy_from_slice(&a);
        assert!(lu.factor());
        assert!((lu.determinant() - 1.0).abs() < 1e-14);
        lu.solve(&mut b);
        for (b, x) in b.iter().zip(x) {
            assert!((b - x).abs() < 1e-14);
        }
    }

    #[test]
    fn singular_matrices_are_found() {
        let mut lu = SmallLu::new(2);
        lu.values().copy_from_slice(&[1.0, 2.0, 2.0, 4.0]);
        assert!(!lu.factor() && lu.determinant() == 0.0);
        lu.values().copy_from_slice(&[1.0, f64::NAN, 2.0, 4.0]);
        assert!(!lu.factor() && lu.determinant() == 0.0);
        let mut none = SmallLu::new(0);
        assert!(none.factor() && none.determinant() == 1.0);
        none.solve(&mut []);
        none.solve_transposed(&mut []);
    }

    #[test]
    fn agrees_with_faer() {
        let mut numbers = Random(7);
        for n in 1..12 {
            for _ in 0..20 {
                let a = random(n, &mut numbers);
                let x: Vec<f64> = (0..n).map(|_| numbers.signed()).collect();
                let reference = MatRef::from_row_major_slice(&a, n, n);
                let mut lu = SmallLu::new(n);
                lu.values().copy_from_slice(&a);
                assert!(lu.factor());
                let determinant = reference.determinant();
                assert!(
                    (lu.determinant() - determinant).abs() <= 1e-12,
                    "{} {determinant}",
                    lu.determinant()
                );
                let right = Mat::from_fn(n, 1, |i, _| x[i]);
                let wanted = reference.partial_piv_lu().solve(&right);
                let mut found = x.clone();
                lu.solve(&mut found);
                let mut across = x.clone();
                lu.solve_transposed(&mut across);
                let most = across.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
                for (column, b) in x.iter().enumerate() {
                    let sum: f64 = (0..n).map(|i| a[i * n + column] * across[i]).sum();
                    assert!((sum - b).abs() <= 1e-13 * (1.0 + most), "{sum} {b}");
                }
                // Both are solutions of matrices that differ from this one by rounding: by that they may differ.
                let size = found.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
                for (row, b) in x.iter().enumerate() {
                    let misfit = dot(&a[row * n..(row + 1) * n], &found) - b;
                    assert!(misfit.abs() <= 1e-13 * (1.0 + size), "{misfit}");
                    let other: f64 = (0..n).map(|j| a[row * n + j] * wanted[(j, 0)]).sum();
                    assert!((other - b).abs() <= 1e-13 * (1.0 + size), "{other} {b}");
                }
            }
        }
    }

    #[test]
    fn positive_definite_matrices_have_roots() {
        let mut numbers = Random(11);
        for n in 1..9 {
            let root = random(n, &mut numbers);
            let square = |i: usize, j: usize| {
                dot(&root[i * n..(i + 1) * n], &root[j * n..(j + 1) * n])
                    + if i == j { 0.1 } else { 0.0 }
            };
            let a: Vec<f64> = (0..n * n).map(|k| square(k / n, k % n)).collect();
            let mut factor = a.clone();
            assert!(cholesky(&mut factor, n, 1e-13));
            let b: Vec<f64> = (0..n).map(|_| numbers.signed()).collect();
            let mut x = b.clone();
            cholesky_solve(&factor, &mut x);
            for (row, b) in b.iter().enumerate() {
                let misfit = dot(&a[row * n..(row + 1) * n], &x) - b;
                assert!(misfit.abs() < 1e-12, "{misfit}");
            }
            let mut minors = a.clone();
            assert!(leading_minors_are_positive(&mut minors, n));
            // An eigenvalue below zero is found by both.
            let mut indefinite = a.clone();
            indefinite[n * n - 1] -= 100.0;
            assert!(!cholesky(&mut indefinite.clone(), n, 1e-13));
            assert!(!leading_minors_are_positive(&mut indefinite, n));
        }
        let mut loose = [1.0, 1.0, 1.0, 1.0 + 1e-15];
        assert!(!cholesky(&mut loose, 2, 1e-13));
    }
}
