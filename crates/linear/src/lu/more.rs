//! More than one right-hand side, and factors in more than one place.

use super::SparseLu;

impl SparseLu {
    /// Overwrites K right-hand sides with their x of A x = b: `b[i]` has component i of each. One pass through the factors
    /// does for all, and gives each what [`SparseLu::solve`] does.
    ///
    /// # Panics
    /// As there.
    pub fn solve_together<const K: usize>(&mut self, b: &mut [[f64; K]]) {
        self.assert_ready(b.len());
        let n = self.order.len();
        // One of them has room already.
        let room = match K {
            1 => &mut self.vector,
            _ => &mut self.vectors,
        };
        if room.len() < K * n {
            room.resize(K * n, 0.0);
        }
        let y = room[..K * n].as_chunks_mut::<K>().0;
        for (&at, value) in self.position.iter().zip(&*b) {
            y[at as usize] = *value;
        }
        self.frozen.solve(y);
        for (&column, value) in self.order.columns().iter().zip(&*y) {
            b[column as usize] = *value;
        }
    }

    /// Rows of A⁻¹, K at a time: of the first K columns k of A that are wanted, `(A⁻¹)_kr` of every row r of A in turn, then of the
    /// next K of them. Where fewer than K are left, the others are zero.
    ///
    /// # Panics
    /// Without factors, or when `rows` has not n for each K that are wanted.
    pub fn inverse_rows<const K: usize>(&mut self, wanted: &[usize], rows: &mut [[f64; K]]) {
        let n = self.order.len();
        self.assert_ready(n);
        assert_eq!(
            rows.len(),
            n * wanted.len().div_ceil(K),
            "n for each few rows that are wanted"
        );
        if self.vectors.len() < K * n {
            self.vectors.resize(K * n, 0.0);
        }
        let y = self.vectors[..K * n].as_chunks_mut::<K>().0;
        for (wanted, rows) in wanted.chunks(K).zip(rows.chunks_exact_mut(n.max(1))) {
            y.fill([0.0; K]);
            for (lane, &column) in wanted.iter().enumerate() {
                let mut columns = self.order.columns().iter();
                if let Some(step) = columns.position(|&own| own as usize == column) {
                    y[step][lane] = 1.0;
                }
            }
            self.frozen.solve_transposed(y);
            for (row, &at) in rows.iter_mut().zip(&self.position) {
                *row = y[at as usize];
            }
        }
    }

    /// Takes over the factors of another one, whose work space stays where it is: of matrices of the same size nothing is allocated.
    pub fn take_over(&mut self, other: &SparseLu) {
        self.pattern.clone_from(&other.pattern);
        if self.order != other.order {
            self.order.clone_from(&other.order);
        }
        self.position.clone_from(&other.position);
        self.frozen.take_over(&other.frozen);
        self.row_scale.clone_from(&other.row_scale);
        self.permutation_sign = other.permutation_sign;
        self.factored = other.factored;
        self.growth = other.growth;
        let n = self.order.len();
        self.vector.resize(n, 0.0);
    }
}
