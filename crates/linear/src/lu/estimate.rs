//! What the factors tell beyond solutions: refinement, determinant, nearness to singularity.

use super::SparseLu;

impl SparseLu {
    /// Solves A x = b and refines once: x += A⁻¹ (b − A x), with the values that were factored.
    ///
    /// Brings the backward error of a factorisation with grown entries back to rounding level.
    ///
    /// # Panics
    /// As [`SparseLu::solve`].
    pub fn solve_refined(&mut self, values: &[f64], b: &mut [f64]) {
        self.refine(b, Self::solve, |lu, x, residual| {
            lu.pattern.subtract_product(values, x, residual)
        });
    }

    /// As [`SparseLu::solve_refined`] for Aᵀ x = b.
    ///
    /// # Panics
    /// As [`SparseLu::solve_transposed`].
    pub fn solve_transposed_refined(&mut self, values: &[f64], b: &mut [f64]) {
        self.refine(b, Self::solve_transposed, |lu, x, residual| {
            lu.pattern.subtract_transposed_product(values, x, residual);
        });
    }

    fn refine(
        &mut self,
        b: &mut [f64],
        solve: fn(&mut Self, &mut [f64]),
        subtract_product: impl Fn(&Self, &[f64], &mut [f64]),
    ) {
        self.assert_ready(b.len());
        // The buffer leaves the struct while both are needed; an empty vector in its place does not allocate.
        let mut residual = std::mem::take(&mut self.residual);
        residual.clear();
        residual.extend_from_slice(b);
        solve(self, b);
        subtract_product(self, b, &mut residual);
        solve(self, &mut residual);
        for (x, correction) in b.iter_mut().zip(&residual) {
            *x += correction;
        }
        self.residual = residual;
    }

    /// Sign and natural logarithm of the absolute value of det A.
    ///
    /// Along a path the sign turns where the configuration passes through a singular one.
    ///
    /// # Panics
    /// Without factors.
    pub fn determinant(&self) -> (f64, f64) {
        assert!(
            self.factored,
            "determinant wants a successful factorisation before it"
        );
        let pivots = self.frozen.inverse_pivots().iter();
        let ln_abs: f64 = pivots.map(|inverse| -inverse.abs().ln()).sum();
        (self.determinant_sign(), ln_abs)
    }

    /// Sign of det A of the last factors.
    pub fn determinant_sign(&self) -> f64 {
        let pivots = self.frozen.inverse_pivots().iter();
        pivots.fold(self.permutation_sign, |sign, inverse| {
            sign * inverse.signum()
        })
    }

    /// Smallest pivot over the largest entry of its column and row, whichever is smaller [-], of the values that were factored.
    ///
    /// The figure that [`super::SINGULAR_RATIO`] is held against, with the rows' scales of the last full factorisation; infinite for an
    /// empty matrix.
    pub fn smallest_pivot_ratio(&self, values: &[f64]) -> f64 {
        let columns = self.order.columns().iter().map(|&column| {
            let own = values[self.pattern.span(column as usize)].iter();
            own.fold(0.0, |largest, value| f64::max(largest, value.abs()))
        });
        let pivots = self.frozen.inverse_pivots().iter();
        pivots
            .zip(columns.zip(&self.row_scale))
            .map(|(inverse, (column, &row))| 1.0 / (inverse.abs() * column.min(row)))
            .fold(f64::INFINITY, f64::min)
    }

    /// Smallest pivot over largest pivot [-]: a cheap and crude reciprocal condition number.
    ///
    /// Mixed units make it small on sound matrices too; compare it along a path, not with a fixed number.
    pub fn pivot_spread(&self) -> f64 {
        let (smallest, largest) = self
            .frozen
            .inverse_pivots()
            .iter()
            .map(|inverse| inverse.abs())
            .fold((f64::INFINITY, 0.0), |(low, high), size| {
                (size.min(low), size.max(high))
            });
        if largest == 0.0 {
            1.0
        } else {
            smallest / largest
        }
    }

    /// Estimates the smallest singular value σ of A by inverse iterations, with unit vectors A · right ≈ σ · left.
    ///
    /// ```text
    /// right ← A⁻¹ left / |A⁻¹ left|,   left ← A⁻ᵀ right / |A⁻ᵀ right|,   σ ≈ 1 / |A⁻ᵀ right|
    /// ```
    ///
    /// Never below the true value but for rounding, and near it after two iterations when the next singular value is
    /// well apart. At a dead point `right` is the motion that becomes free and `left` the combination of rows that
    /// vanishes.
    ///
    /// # Panics
    /// Without factors, or when a vector is not as long as the matrix.
    pub fn smallest_singular(
        &mut self,
        iterations: usize,
        right: &mut [f64],
        left: &mut [f64],
    ) -> f64 {
        self.assert_ready(right.len());
        self.assert_ready(left.len());
        // Start from a vector without pattern, so that it is not orthogonal to a smooth or alternating one.
        for (index, value) in left.iter_mut().enumerate() {
            let golden = (index as f64 + 1.0) * 0.618_033_988_749_894_9;
            *value = 2.0 * golden.fract() - 1.0 + f64::EPSILON;
        }
        normalise(left);
        let mut sigma = f64::INFINITY;
        for _ in 0..iterations.max(1) {
            right.copy_from_slice(left);
            self.solve(right);
            normalise(right);
            left.copy_from_slice(right);
            self.solve_transposed(left);
            sigma = 1.0 / normalise(left);
        }
        sigma
    }
}

/// Scales to unit length and returns the length before, safe against overflow of the squares.
fn normalise(vector: &mut [f64]) -> f64 {
    let largest = vector.iter().fold(0.0f64, |m, v| m.max(v.abs()));
    if largest == 0.0 || !largest.is_finite() {
        return largest;
    }
    let sum: f64 = vector.iter().map(|v| (v / largest) * (v / largest)).sum();
    let length = largest * sum.sqrt();
    for value in vector {
        *value /= length;
    }
    length
}
