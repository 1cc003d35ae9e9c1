//! Singular values, null spaces and least norm solutions of small dense matrices.
//!
//! ```text
//! A = U Σ Vᵀ              A (m × n), σ₁ ≥ σ₂ ≥ … ≥ 0
//! rank                    number of σ above tolerance · σ₁
//! right null space        last n − rank columns of V: motions that violate no row
//! left null space         last m − rank columns of U: combinations of rows that vanish
//! least norm solution     x = Σ vᵢ (uᵢᵀ b) / σᵢ over the rank
//! ```
//!
//! The cost is cubic, for a few hundred rows at most; [`super::rank`] serves larger ones. This and [`super::eigen`]
//! alone call faer's dense factorisations, with `f64`: its generics are compiled in the crate that uses them. faer
//! reports no rank and passes NaN through, so both are checked here.

use faer::MatRef;
use thiserror::Error;

/// A singular value below this times the largest counts as zero [-].
///
/// Rounding leaves about 1e-15 · √(m n); lengths in metres beside angles in radians spread regular values over some
/// four decades.
pub const RANK_TOLERANCE: f64 = 1e-10;

/// A dense matrix by rows.
#[derive(Debug, Clone, PartialEq)]
pub struct Dense {
    rows: usize,
    columns: usize,
    values: Vec<f64>,
}

/// Why a dense factorisation failed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum DenseFault {
    /// An entry is infinite or no number.
    #[error("entry in row {row}, column {column} is not finite")]
    NotFinite {
        /// Its row.
        row: usize,
        /// Its column.
        column: usize,
    },
    /// The iteration for singular values does not end.
    #[error("singular values did not converge")]
    NoConvergence,
}

/// Rank with the spaces that belong to it.
#[derive(Debug, Clone)]
pub struct SvdRank {
    /// Number of singular values that count.
    pub rank: usize,
    /// min(m, n) values, falling.
    pub singular_values: Vec<f64>,
    /// n × (n − rank), orthonormal columns.
    pub right_null: Dense,
    /// m × (m − rank), orthonormal columns.
    pub left_null: Dense,
}

/// The shortest of the vectors that solve best.
#[derive(Debug, Clone)]
pub struct LeastNorm {
    /// The vector.
    pub x: Vec<f64>,
    /// Number of singular values that count.
    pub rank: usize,
    /// |b − A x|, Euclidean: zero but for rounding when the equations are consistent.
    pub residual: f64,
}

impl Dense {
    /// Takes `rows` × `columns` values, row after row.
    ///
    /// # Panics
    /// When there are not that many values.
    pub fn new(rows: usize, columns: usize, values: Vec<f64>) -> Self {
        assert_eq!(
            values.len(),
            rows * columns,
            "a {rows} × {columns} matrix wants {} values",
            rows * columns
        );
        Dense {
            rows,
            columns,
            values,
        }
    }

    /// All zero.
    pub fn zeros(rows: usize, columns: usize) -> Self {
        Dense {
            rows,
            columns,
            values: vec![0.0; rows * columns],
        }
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Number of columns.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// One row.
    pub fn row(&self, row: usize) -> &[f64] {
        &self.values[row * self.columns..(row + 1) * self.columns]
    }

    /// A copy of one column.
    pub fn column(&self, column: usize) -> Vec<f64> {
        (0..self.rows).map(|row| self.get(row, column)).collect()
    }

    /// One entry.
    pub fn get(&self, row: usize, column: usize) -> f64 {
        self.row(row)[column]
    }

    /// Sets one entry.
    pub fn set(&mut self, row: usize, column: usize, value: f64) {
        assert!(
            row < self.rows && column < self.columns,
            "({row}, {column}) outside {} × {}",
            self.rows,
            self.columns
        );
        self.values[row * self.columns + column] = value;
    }

    fn view(&self) -> MatRef<'_, f64> {
        MatRef::from_row_major_slice(&self.values, self.rows, self.columns)
    }

    fn check_finite(&self) -> Result<(), DenseFault> {
        match self.values.iter().position(|value| !value.is_finite()) {
            Some(at) => Err(DenseFault::NotFinite {
                row: at / self.columns,
                column: at % self.columns,
            }),
            None => Ok(()),
        }
    }
}

/// U (m × m), singular values, V (n × n).
struct Svd {
    left: Dense,
    singular_values: Vec<f64>,
    right: Dense,
}

impl Svd {
    fn new(a: &Dense) -> Result<Self, DenseFault> {
        a.check_finite()?;
        // No entries: every vector is a null vector.
        if a.values.is_empty() {
            return Ok(Svd {
                left: identity(a.rows),
                singular_values: Vec::new(),
                right: identity(a.columns),
            });
        }
        let svd = a.view().svd().map_err(|_| DenseFault::NoConvergence)?;
        let singular_values: Vec<f64> = svd.S().column_vector().iter().copied().collect();
        if singular_values.iter().any(|value| !value.is_finite()) {
            return Err(DenseFault::NoConvergence);
        }
        Ok(Svd {
            left: copy(svd.U()),
            singular_values,
            right: copy(svd.V()),
        })
    }

    fn rank(&self, tolerance: f64) -> usize {
        let largest = self.singular_values.first().copied().unwrap_or(0.0);
        self.singular_values
            .iter()
            .filter(|&&value| value > 0.0 && value > tolerance * largest)
            .count()
    }
}

/// Rank, singular values and both null spaces; singular values up to `tolerance` times the largest count as zero.
///
/// # Errors
/// [`DenseFault`] on entries that are not finite.
pub fn svd_rank(a: &Dense, tolerance: f64) -> Result<SvdRank, DenseFault> {
    let svd = Svd::new(a)?;
    let rank = svd.rank(tolerance);
    let tail = |basis: &Dense| {
        let mut null = Dense::zeros(basis.rows, basis.columns - rank);
        for row in 0..null.rows {
            for column in 0..null.columns {
                null.set(row, column, basis.get(row, rank + column));
            }
        }
        null
    };
    let (right_null, left_null) = (tail(&svd.right), tail(&svd.left));
    Ok(SvdRank {
        rank,
        singular_values: svd.singular_values,
        right_null,
        left_null,
    })
}

/// The x of least norm among those that minimise |A x − b|, by the pseudo-inverse.
///
/// # Errors
/// [`DenseFault`] on entries of A or b that are not finite (those of b as column n).
///
/// # Panics
/// When b is not as long as A has rows.
pub fn least_norm_solve(a: &Dense, b: &[f64], tolerance: f64) -> Result<LeastNorm, DenseFault> {
    assert_eq!(b.len(), a.rows, "right-hand side and matrix differ in size");
    if let Some(row) = b.iter().position(|value| !value.is_finite()) {
        return Err(DenseFault::NotFinite {
            row,
            column: a.columns,
        });
    }
    let svd = Svd::new(a)?;
    let rank = svd.rank(tolerance);
    let mut x = vec![0.0; a.columns];
    for (index, sigma) in svd.singular_values[..rank].iter().enumerate() {
        let share = (0..a.rows)
            .map(|row| svd.left.get(row, index) * b[row])
            .sum::<f64>()
            / sigma;
        for (row, value) in x.iter_mut().enumerate() {
            *value += share * svd.right.get(row, index);
        }
    }
    let misfit = |row: usize| {
        b[row]
            - a.row(row)
                .iter()
                .zip(&x)
                .map(|(entry, value)| entry * value)
                .sum::<f64>()
    };
    let residual = (0..a.rows)
        .map(|row| misfit(row).powi(2))
        .sum::<f64>()
        .sqrt();
    Ok(LeastNorm { x, rank, residual })
}

/// Rank by QR with column pivoting: diagonal entries of R above `tolerance` times the first. Cheaper than [`svd_rank`],
/// and as good unless the matrix is built to deceive it.
///
/// # Errors
/// [`DenseFault`] on entries that are not finite.
pub fn qr_rank(a: &Dense, tolerance: f64) -> Result<usize, DenseFault> {
    a.check_finite()?;
    if a.values.is_empty() {
        return Ok(0);
    }
    let qr = a.view().col_piv_qr();
    let r = qr.thin_R();
    let diagonal = (0..r.nrows().min(r.ncols())).map(|i| r[(i, i)].abs());
    let largest = diagonal.clone().fold(0.0, f64::max);
    Ok(diagonal
        .filter(|&size| size > 0.0 && size > tolerance * largest)
        .count())
}

fn identity(n: usize) -> Dense {
    let mut identity = Dense::zeros(n, n);
    for i in 0..n {
        identity.set(i, i, 1.0);
    }
    identity
}

fn copy(matrix: MatRef<'_, f64>) -> Dense {
    let mut copy = Dense::zeros(matrix.nrows(), matrix.ncols());
    for row in 0..copy.rows {
        for column in 0..copy.columns {
            copy.set(row, column, matrix[(row, column)]);
        }
    }
    copy
}

#[cfg(test)]
mod tests;
