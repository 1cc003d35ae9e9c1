//! Sparse LU with a frozen pattern.
//!
//! ```text
//! P A Q = L U      A (n × n), L unit lower, U upper triangular
//! A x = b          L y = P b,   U z = y,    x = Q z
//! Aᵀ x = b         Uᵀ y = Qᵀ b, Lᵀ z = y,   x = Pᵀ z
//! ```
//!
//! Left-looking: column j of L and U follows from solving L x = A(:, q_j) with the columns of L found so far. The first
//! factorisation finds the pattern of x by a depth first search through L (Gilbert & Peierls, SIAM J. Sci. Stat.
//! Comput. 9, 1988) and picks pivots by threshold. Later ones keep pivots and pattern and only repeat the arithmetic (`frozen`),
//! as KLU does (Davis & Palamadai Natarajan, ACM TOMS 37, 2010, section 5), and start anew when the kept pivots have
//! become bad. Where we deviate from KLU: no block triangular form, no row scaling, preferred pivots from the pairing
//! of [`ColumnOrder::paired`], and small pivots are an error.
//!
//! Checked against dense LU on random matrices and linkages in `lu/tests.rs`.

mod abreast;
mod complex;
mod estimate;
mod factor;
mod frozen;
mod more;
mod pivot;
#[cfg(test)]
mod tests;

pub use abreast::LuAbreast;
pub use complex::{Complex, ComplexLu};
pub use pivot::{GROWTH_LIMIT, PIVOT_THRESHOLD, SINGULAR_RATIO};

use std::sync::Arc;

use thiserror::Error;

use super::order::ColumnOrder;
use super::pattern::Pattern;
use super::triangle::{NONE, Search, Triangle};
use frozen::{Frozen, Matrix};

/// The matrix cannot be factored.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[error("singular at column {column}: pivot ratio {ratio:e}")]
pub struct Singular {
    /// Original column that depends on others, or holds an entry that is not finite.
    pub column: usize,
    /// Original row that would have been the pivot, or of the entry that is not finite.
    pub row: Option<usize>,
    /// Best pivot over the largest entry of its column and row; NaN when something is not finite.
    pub ratio: f64,
}

/// LU factors of a square matrix whose pattern stays while its values change.
///
/// # Examples
/// ```
/// use linkdyn_linear::{ColumnOrder, Pattern, SparseLu};
/// // [2 1; 0 4]
/// let (pattern, _) = Pattern::from_entries(2, 2, &[(0, 0), (0, 1), (1, 1)])?;
/// let mut lu = SparseLu::new(pattern, ColumnOrder::natural(2));
/// lu.refactor(&[2.0, 1.0, 4.0])?;
/// let mut x = [4.0, 8.0];
/// lu.solve(&mut x);
/// assert_eq!(x, [1.0, 2.0]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct SparseLu {
    pattern: Arc<Pattern>,
    order: ColumnOrder,
    /// Pivot position of each original row.
    position: Vec<u32>,
    /// The factors.
    frozen: Frozen,
    /// They while pivots are chosen.
    lower: Triangle,
    upper: Triangle,
    /// Largest entry of the row of A at the last full factorisation, by pivot position.
    row_scale: Vec<f64>,
    /// Sign of the determinant of P times that of Q.
    permutation_sign: f64,
    factored: bool,
    growth: f64,
    fallbacks: usize,
    /// Vector being solved for; while pivots are chosen, of each row of A its largest entry, then the inverse of its pivot.
    vector: Vec<f64>,
    /// Its right-hand side when refining, none until then.
    residual: Vec<f64>,
    /// Vectors being solved for together, interleaved; none until several are requested.
    vectors: Vec<f64>,
    search: Search,
}

impl SparseLu {
    /// Workspace for matrices of this pattern, eliminated in this order.
    ///
    /// # Panics
    /// When the pattern is not square or the order is for another size.
    pub fn new(pattern: impl Into<Arc<Pattern>>, order: ColumnOrder) -> Self {
        let pattern = pattern.into();
        let n = pattern.columns();
        assert_eq!(pattern.rows(), n, "LU wants a square pattern");
        assert_eq!(order.len(), n, "order and pattern differ in size");
        SparseLu {
            pattern,
            order,
            position: vec![NONE; n],
            lower: Triangle::new(),
            upper: Triangle::new(),
            frozen: Frozen::new(),
            row_scale: vec![0.0; n],
            permutation_sign: 1.0,
            factored: false,
            growth: 0.0,
            fallbacks: 0,
            vector: vec![0.0; n],
            residual: Vec::new(),
            vectors: Vec::new(),
            search: Search::new(n),
        }
    }

    /// Factors new values with the pivots of the last factorisation; chooses pivots anew when there was none, or when
    /// an entry is not finite, a pivot tiny or the growth beyond [`GROWTH_LIMIT`].
    ///
    /// # Errors
    /// [`Singular`] when new pivots do not help either.
    pub fn refactor(&mut self, values: &[f64]) -> Result<(), Singular> {
        assert_eq!(
            values.len(),
            self.pattern.entries(),
            "one value per entry of the pattern"
        );
        if self.factored {
            if self.repeat(values) {
                return Ok(());
            }
            self.fallbacks += 1;
        }
        self.factor(values)
    }

    /// The arithmetic alone, on kept pivots and pattern; false when the result is not to be used.
    fn repeat(&mut self, values: &[f64]) -> bool {
        let matrix = Matrix {
            values,
            scales: &self.row_scale,
            pattern: &self.pattern,
            columns: self.order.columns(),
            position: &self.position,
        };
        let repeated = self.frozen.repeat(&matrix);
        self.growth = repeated.growth;
        self.factored = repeated.is_sound && self.growth <= GROWTH_LIMIT;
        self.factored
    }

    /// Overwrites b with the x of A x = b.
    ///
    /// # Panics
    /// Without factors, or when b is not as long as the matrix.
    pub fn solve(&mut self, b: &mut [f64]) {
        self.assert_ready(b.len());
        for (&at, &value) in self.position.iter().zip(&*b) {
            self.vector[at as usize] = value;
        }
        self.frozen.solve(self.vector.as_chunks_mut::<1>().0);
        for (&column, &value) in self.order.columns().iter().zip(&self.vector) {
            b[column as usize] = value;
        }
    }

    /// Overwrites b with the x of Aᵀ x = b.
    ///
    /// # Panics
    /// Without factors, or when b is not as long as the matrix.
    pub fn solve_transposed(&mut self, b: &mut [f64]) {
        self.assert_ready(b.len());
        for (&column, value) in self.order.columns().iter().zip(&mut self.vector) {
            *value = b[column as usize];
        }
        self.frozen
            .solve_transposed(self.vector.as_chunks_mut::<1>().0);
        for (&at, value) in self.position.iter().zip(b) {
            *value = self.vector[at as usize];
        }
    }

    fn assert_ready(&self, length: usize) {
        assert!(
            self.factored,
            "solve wants a successful factorisation before it"
        );
        assert_eq!(
            length,
            self.order.len(),
            "right-hand side and matrix differ in size"
        );
    }

    /// The pattern of A.
    pub fn pattern(&self) -> &Pattern {
        &self.pattern
    }

    /// Whether the last factorisation succeeded.
    pub fn is_factored(&self) -> bool {
        self.factored
    }

    /// Number of entries of L and U, diagonal once.
    pub fn fill(&self) -> usize {
        self.frozen.fill()
    }

    /// Largest entry of L in the last factorisation.
    pub fn growth(&self) -> f64 {
        self.growth
    }

    /// How often a refactorisation found the kept pivots bad.
    pub fn fallbacks(&self) -> usize {
        self.fallbacks
    }
}
