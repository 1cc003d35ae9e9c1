//! The linear systems of equations that don't solve their own, at order 5: J by differences, and dense factors.

use linkdyn_linear::math::dot;
use linkdyn_linear::small::SmallLu;

/// J = ∂f/∂y, and the factors of s − J for a real s and a complex one.
///
/// f depends on the leading m of the n components only: the other columns of J are zero, and the other rows are solved one by one.
#[derive(Debug, Clone, Default)]
pub(super) struct Dense {
    pub n: usize,
    pub m: usize,
    /// J without its zero columns (n × m) by rows.
    pub jacobian: Vec<f64>,
    /// The real s.
    real: f64,
    /// The complex one: real and imaginary part.
    complex: [f64; 2],
    real_factors: SmallLu,
    /// The complex system, by its real and imaginary parts.
    complex_factors: SmallLu,
    /// Room for real and imaginary parts of the components that f depends on (2 × m).
    pair: Vec<f64>,
}

impl Dense {
    /// Makes room for n components, of which f depends on the first m.
    pub(super) fn reserve(&mut self, n: usize, m: usize) {
        (self.n, self.m) = (n, m);
        self.jacobian.resize(n * m, 0.0);
        self.pair.resize(2 * m, 0.0);
        self.real_factors.resize(m);
        self.complex_factors.resize(2 * m);
    }

    /// Factors s − J for a real s and a complex one a + ib, as [a − J, −b; b, a − J]; false if one is singular.
    pub(super) fn factor(&mut self, real: f64, [a, b]: [f64; 2]) -> bool {
        let (n, jacobian) = (self.m, &self.jacobian);
        (self.real, self.complex) = (real, [a, b]);
        let values = self.real_factors.values();
        for i in 0..n {
            for j in 0..n {
                values[i * n + j] = -jacobian[i * n + j];
            }
            values[i * n + i] += real;
        }
        let values = self.complex_factors.values();
        values.fill(0.0);
        for i in 0..n {
            for j in 0..n {
                let entry = -jacobian[i * n + j];
                values[i * 2 * n + j] = entry;
                values[(i + n) * 2 * n + j + n] = entry;
            }
            values[i * 2 * n + i] += a;
            values[(i + n) * 2 * n + i + n] += a;
            values[i * 2 * n + i + n] = -b;
            values[(i + n) * 2 * n + i] = b;
        }
        self.real_factors.factor() && self.complex_factors.factor()
    }

    /// Overwrites b with the x of (s − J) x = b, of the real s.
    pub(super) fn solve(&self, b: &mut [f64]) {
        let (asked, others) = b.split_at_mut(self.m);
        self.real_factors.solve(asked);
        for (k, b) in others.iter_mut().enumerate() {
            *b = (*b + dot(self.row(self.m + k), asked)) / self.real;
        }
    }

    /// The same of the complex s; real and imaginary parts of b, and of x.
    pub(super) fn solve_complex(&mut self, [real, imaginary]: [&mut [f64]; 2]) {
        let m = self.m;
        let mut pair = std::mem::take(&mut self.pair);
        pair[..m].copy_from_slice(&real[..m]);
        pair[m..].copy_from_slice(&imaginary[..m]);
        self.complex_factors.solve(&mut pair);
        real[..m].copy_from_slice(&pair[..m]);
        imaginary[..m].copy_from_slice(&pair[m..]);
        let [a, b] = self.complex;
        let size = a * a + b * b;
        let others = real[m..].iter_mut().zip(&mut imaginary[m..]);
        for (k, (real, imaginary)) in others.enumerate() {
            let row = self.row(m + k);
            let (x, y) = (
                *real + dot(row, &pair[..m]),
                *imaginary + dot(row, &pair[m..]),
            );
            *real = (a * x + b * y) / size;
            *imaginary = (a * y - b * x) / size;
        }
        self.pair = pair;
    }

    fn row(&self, i: usize) -> &[f64] {
        &self.jacobian[i * self.m..][..self.m]
    }
}
