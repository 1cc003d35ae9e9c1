//! Osculating polynomials through values with two derivatives.
//!
//! Between two nodes: the quintic that meets q, q′, q″ at both. Through many nodes: Newton's form with every node
//! counted three times (Stoer and Bulirsch, Introduction to Numerical Analysis, 2002, §2.1.5).

/// q, q′, q″ at a parameter value, each (n).
#[derive(Debug, Clone, PartialEq)]
pub struct Node {
    /// Parameter.
    pub s: f64,
    /// Values.
    pub q: Vec<f64>,
    /// First derivatives.
    pub d: Vec<f64>,
    /// Second derivatives.
    pub dd: Vec<f64>,
}

/// Evaluates the quintic through two nodes at `s` (inside or outside); q goes to `q`, q′ to `d`.
pub fn quintic(a: &Node, b: &Node, s: f64, q: &mut [f64], d: Option<&mut [f64]>) {
    let h = b.s - a.s;
    let u = (s - a.s) / h;
    let coefficients = |k: usize| {
        let (v0, c0) = (h * a.d[k], 0.5 * h * h * a.dd[k]);
        let gap = b.q[k] - (a.q[k] + v0 + c0);
        let slope = h * b.d[k] - (v0 + 2.0 * c0);
        let bend = h * h * b.dd[k] - 2.0 * c0;
        let c3 = 10.0 * gap - 4.0 * slope + 0.5 * bend;
        let c4 = -15.0 * gap + 7.0 * slope - bend;
        let c5 = 6.0 * gap - 3.0 * slope + 0.5 * bend;
        [a.q[k], v0, c0, c3, c4, c5]
    };
    for (k, q) in q.iter_mut().enumerate() {
        *q = coefficients(k).iter().rev().fold(0.0, |sum, c| sum * u + c);
    }
    if let Some(d) = d {
        for (k, d) in d.iter_mut().enumerate() {
            let c = coefficients(k);
            *d = (1..6).rev().fold(0.0, |sum, j| sum * u + j as f64 * c[j]) / h;
        }
    }
}

/// Polynomial of degree 3N − 1 through N nodes.
#[derive(Debug, Clone)]
pub struct Osculating {
    centre: f64,
    scale: f64,
    /// Abscissae, each three times (3N).
    x: Vec<f64>,
    /// Newton coefficients (3N × n), row-major.
    coefficients: Vec<f64>,
    n: usize,
}

impl Osculating {
    /// Through `nodes` (distinct s), scaled so that they lie within [−1, 1] around `centre`.
    pub fn new(nodes: &[Node], centre: f64) -> Self {
        let n = nodes[0].q.len();
        let scale = nodes
            .iter()
            .fold(0.0, |m: f64, node| m.max((node.s - centre).abs()));
        let x: Vec<f64> = nodes
            .iter()
            .flat_map(|node| [(node.s - centre) / scale; 3])
            .collect();
        let size = x.len();
        let mut coefficients = vec![0.0; size * n];
        for k in 0..n {
            let mut column: Vec<f64> = nodes.iter().flat_map(|node| [node.q[k]; 3]).collect();
            for order in 1..size {
                for i in (order..size).rev() {
                    let width = x[i] - x[i - order];
                    let node = &nodes[i / 3];
                    column[i] = if width == 0.0 {
                        match order {
                            1 => node.d[k] * scale,
                            _ => 0.5 * node.dd[k] * scale * scale,
                        }
                    } else {
                        (column[i] - column[i - 1]) / width
                    };
                }
            }
            for (i, value) in column.into_iter().enumerate() {
                coefficients[i * n + k] = value;
            }
        }
        Osculating {
            centre,
            scale,
            x,
            coefficients,
            n,
        }
    }

    /// q, q′, q″ at `s`.
    pub fn eval(&self, s: f64, q: &mut [f64], d: &mut [f64], dd: &mut [f64]) {
        for k in 0..self.n {
            [q[k], d[k], dd[k]] = self.jet(k, s);
        }
    }

    /// q_k, q_k′, q_k″ at `s`.
    pub fn jet(&self, k: usize, s: f64) -> [f64; 3] {
        let x = (s - self.centre) / self.scale;
        let mut jet = [0.0; 3];
        for (i, node) in self.x.iter().enumerate().rev() {
            let step = x - node;
            jet = [
                jet[0] * step + self.coefficients[i * self.n + k],
                jet[1] * step + jet[0],
                jet[2] * step + 2.0 * jet[1],
            ];
        }
        [
            jet[0],
            jet[1] / self.scale,
            jet[2] / (self.scale * self.scale),
        ]
    }
}

/// Value at `s` of the polynomial through (x, f) (Neville).
pub fn interpolate(x: &[f64], f: &[f64], s: f64) -> f64 {
    let mut p = f.to_vec();
    for order in 1..x.len() {
        for i in 0..x.len() - order {
            p[i] = ((s - x[i + order]) * p[i] + (x[i] - s) * p[i + 1]) / (x[i] - x[i + order]);
        }
    }
    p[0]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn node(s: f64) -> Node {
        Node {
            s,
            q: vec![s.sin(), (2.0 * s).exp()],
            d: vec![s.cos(), 2.0 * (2.0 * s).exp()],
            dd: vec![-s.sin(), 4.0 * (2.0 * s).exp()],
        }
    }

    #[test]
    fn quintic_is_of_sixth_order() {
        let error = |h: f64| {
            let (mut q, mut d) = ([0.0; 2], [0.0; 2]);
            quintic(
                &node(0.3),
                &node(0.3 + h),
                0.3 + 2.0 * h,
                &mut q,
                Some(&mut d),
            );
            let want = node(0.3 + 2.0 * h);
            ((q[0] - want.q[0]).abs(), (d[0] - want.d[0]).abs())
        };
        let (coarse, fine) = (error(0.2), error(0.1));
        let order = (coarse.0 / fine.0).log2();
        assert!((order - 6.0).abs() < 0.4, "{order}");
        let order = (coarse.1 / fine.1).log2();
        assert!((order - 5.0).abs() < 0.4, "{order}");
    }

    #[test]
    fn osculating_polynomial_meets_a_smooth_function() {
        let nodes: Vec<Node> = [-0.3, -0.2, -0.1, 0.1, 0.2, 0.3].map(node).to_vec();
        let p = Osculating::new(&nodes, 0.0);
        let (mut q, mut d, mut dd) = ([0.0; 2], [0.0; 2], [0.0; 2]);
        for s in [0.0, 0.05, -0.25] {
            p.eval(s, &mut q, &mut d, &mut dd);
            let want = node(s);
            for k in 0..2 {
                assert!((q[k] - want.q[k]).abs() < 1e-14, "{s}: {q:?} {want:?}");
                assert!(
                    (d[k] - want.d[k]).abs() < 1e-12 && (dd[k] - want.dd[k]).abs() < 1e-10,
                    "{s}: {dd:?} {want:?}"
                );
            }
        }
    }

    #[test]
    fn neville_repeats_a_polynomial() {
        let f = |x: f64| 1.0 - 2.0 * x + x.powi(3);
        let x = [-1.0, 0.5, 1.0, 2.0];
        assert!((interpolate(&x, &x.map(f), 0.3) - f(0.3)).abs() < 1e-14);
    }
}
