//! Osculating polynomials through values with two derivatives.
//!
//! Between two nodes: the quintic that meets q, q′, q″ at both. Through K nodes, once: Lagrange's form with every factor to the
//! third power, of degree 3K − 1, whose weights do not depend on the values:
//!
//! ```text
//! L(s) = Π (s − s_i)³/(s_j − s_i)³ = 1 + p t + r t² + …,  t = s − s_j
//! q_j:  L (1 − p t + (p² − r) t²)       q_j′:  L t (1 − p t)       q_j″:  L t²/2
//! ```
//!
//! Through many nodes, many times: Newton's form with every node counted three times (Stoer and Bulirsch, Introduction to
//! Numerical Analysis, 2002, §2.1.5).

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

/// Value, first and second derivative.
type Jet = [f64; 3];

fn product(a: Jet, b: Jet) -> Jet {
    [
        a[0] * b[0],
        a[0] * b[1] + a[1] * b[0],
        a[0] * b[2] + 2.0 * a[1] * b[1] + a[2] * b[0],
    ]
}

/// What q, q′, q″ of node j of K are multiplied by in the polynomial through all of them at `s`: the jets of three weights.
fn weights<const K: usize>(at: &[f64; K], j: usize, s: f64) -> [Jet; 3] {
    let t = s - at[j];
    let (mut all, mut slope, mut squares) = ([1.0, 0.0, 0.0], 0.0, 0.0);
    for (i, other) in at.iter().enumerate() {
        if i != j {
            let inverse = 1.0 / (at[j] - other);
            let factor = [(s - other) * inverse, inverse, 0.0];
            all = product(all, product(factor, product(factor, factor)));
            slope += 3.0 * inverse;
            squares += 3.0 * inverse * inverse;
        }
    }
    let bend = 0.5 * (slope * slope - squares);
    let (c1, c2) = (-slope, slope * slope - bend);
    [
        product(all, [1.0 + t * (c1 + t * c2), c1 + 2.0 * c2 * t, 2.0 * c2]),
        product(all, [t + c1 * t * t, 1.0 + 2.0 * c1 * t, 2.0 * c1]),
        product(all, [0.5 * t * t, t, 1.0]),
    ]
}

/// Evaluates the polynomial of degree 3K − 1 that meets q, q′, q″ at K distinct nodes, at `s`; q goes to `q`, its derivatives
/// to `d` and `dd`.
pub fn osculate<const K: usize>(nodes: [&Node; K], s: f64, [q, d, dd]: [&mut [f64]; 3]) {
    let at = nodes.map(|node| node.s);
    let nearest = (0..K).min_by(|&i, &j| (at[i] - s).abs().total_cmp(&(at[j] - s).abs()));
    // The weights of q add up to 1: differences from one node lose least.
    let base = &nodes[nearest.unwrap_or(0)].q;
    let weights: [[Jet; 3]; K] = std::array::from_fn(|j| weights(&at, j, s));
    let n = base.len();
    let values = nodes.map(|node| [&node.q[..n], &node.d[..n], &node.dd[..n]]);
    let to = q.iter_mut().zip(d).zip(dd).zip(base).enumerate();
    for (k, (((q, d), dd), base)) in to {
        let mut sum = [0.0; 3];
        for (values, weights) in values.iter().zip(&weights) {
            let own = [values[0][k] - base, values[1][k], values[2][k]];
            for (value, weight) in own.iter().zip(weights) {
                for (sum, weight) in sum.iter_mut().zip(weight) {
                    *sum += value * weight;
                }
            }
        }
        [*q, *d, *dd] = [base + sum[0], sum[1], sum[2]];
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
    fn osculating_polynomials_repeat_polynomials_of_their_degree() {
        let power = |s: f64, p: i32| {
            let slope = f64::from(p);
            [
                s.powi(p),
                slope * s.powi(p - 1),
                slope * (slope - 1.0) * s.powi(p - 2),
            ]
        };
        let at = |p: i32, s: f64| {
            let [q, d, dd] = power(s, p);
            Node {
                s,
                q: vec![1.0 + q],
                d: vec![d],
                dd: vec![dd],
            }
        };
        let (mut q, mut d, mut dd) = ([0.0], [0.0], [0.0]);
        for p in [2, 5, 8] {
            let nodes = [0.7, 1.0, 1.2].map(|s| at(p, s));
            osculate(
                [&nodes[0], &nodes[1], &nodes[2]],
                1.5,
                [&mut q, &mut d, &mut dd],
            );
            let want = power(1.5, p);
            for (k, got) in [q[0] - 1.0, d[0], dd[0]].into_iter().enumerate() {
                assert!(
                    (got / want[k] - 1.0).abs() < 1e-11,
                    "{p} {k}: {got} {want:?}"
                );
            }
        }
        let nodes = [0.7, 0.9, 1.2, 1.3].map(|s| at(11, s));
        osculate(
            [&nodes[0], &nodes[1], &nodes[2], &nodes[3]],
            1.05,
            [&mut q, &mut d, &mut dd],
        );
        let want = power(1.05, 11);
        for (k, got) in [q[0] - 1.0, d[0], dd[0]].into_iter().enumerate() {
            assert!((got / want[k] - 1.0).abs() < 1e-11, "{k}: {got} {want:?}");
        }
    }

    #[test]
    fn neville_repeats_a_polynomial() {
        let f = |x: f64| 1.0 - 2.0 * x + x.powi(3);
        let x = [-1.0, 0.5, 1.0, 2.0];
        assert!((interpolate(&x, &x.map(f), 0.3) - f(0.3)).abs() < 1e-14);
    }
}
