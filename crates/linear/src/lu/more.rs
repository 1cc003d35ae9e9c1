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
