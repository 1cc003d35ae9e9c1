//! The natural cubic spline.

use super::Jet;

/// Natural cubic spline: knots, values and second derivatives, all of length n ≥ 2.
#[derive(Debug, Clone, PartialEq)]
pub struct Spline {
    t: Vec<f64>,
    f: Vec<f64>,
    curvature: Vec<f64>,
}

impl Spline {
    /// Spline through points with strictly increasing times.
    pub fn natural(points: &[[f64; 2]]) -> Self {
        let n = points.len();
        let t: Vec<f64> = points.iter().map(|p| p[0]).collect();
        let f: Vec<f64> = points.iter().map(|p| p[1]).collect();
        let mut curvature = vec![0.0; n];
        // Tridiagonal system for the inner second derivatives, eliminated downwards.
        let mut factor = vec![0.0; n];
        for i in 1..n.saturating_sub(1) {
            let (h0, h1) = (t[i] - t[i - 1], t[i + 1] - t[i]);
            let rhs = 6.0 * ((f[i + 1] - f[i]) / h1 - (f[i] - f[i - 1]) / h0);
            let pivot = 2.0 * (h0 + h1) - h0 * factor[i - 1];
            factor[i] = h1 / pivot;
            curvature[i] = (rhs - h0 * curvature[i - 1]) / pivot;
        }
        for i in (1..n.saturating_sub(1)).rev() {
            curvature[i] -= factor[i] * curvature[i + 1];
        }
        Spline { t, f, curvature }
    }

    /// Value and two derivatives.
    pub fn jet(&self, t: f64) -> Jet {
        let last = self.t.len() - 1;
        // Beyond the ends: the end tangent (f″ = 0 there).
        for (inside, end) in [(t >= self.t[0], 0), (t <= self.t[last], last)] {
            if !inside {
                let edge = self.piece(end.min(last - 1), self.t[end]);
                return [edge[0] + edge[1] * (t - self.t[end]), edge[1], 0.0];
            }
        }
        let k = self.t.partition_point(|&knot| knot <= t).clamp(1, last) - 1;
        self.piece(k, t)
    }

    fn piece(&self, k: usize, t: f64) -> Jet {
        let h = self.t[k + 1] - self.t[k];
        let (a, b) = (self.t[k + 1] - t, t - self.t[k]);
        let (m0, m1) = (self.curvature[k], self.curvature[k + 1]);
        let slope = (self.f[k + 1] - self.f[k]) / h;
        [
            self.f[k] + slope * b
                - (m0 * (h * h - a * a) * a + m1 * (h * h - b * b) * b) / (6.0 * h),
            slope + (m1 * (3.0 * b * b - h * h) - m0 * (3.0 * a * a - h * h)) / (6.0 * h),
            (m0 * a + m1 * b) / h,
        ]
    }

    /// Times of its points.
    pub fn times(&self) -> &[f64] {
        &self.t
    }

    /// Values at its points.
    pub fn values(&self) -> &[f64] {
        &self.f
    }
}
