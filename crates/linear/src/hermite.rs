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
    for (q, jets) in q.iter_mut().zip(jets(a, b)) {
        let c = coefficients(h, jets);
        *q = c.iter().rev().fold(0.0, |sum, c| sum * u + c);
    }
    if let Some(d) = d {
        for (d, jets) in d.iter_mut().zip(jets(a, b)) {
            let c = coefficients(h, jets);
            *d = (1..6).rev().fold(0.0, |sum, j| sum * u + j as f64 * c[j]) / h;
        }
    }
}

/// q, q′ and q″ of each component at both.
#[inline(always)]
fn jets(a: &Node, b: &Node) -> impl Iterator<Item = [Jet<f64>; 2]> {
    let a = a.q.iter().zip(&a.d).zip(&a.dd);
    let b = b.q.iter().zip(&b.d).zip(&b.dd);
    a.zip(b)
        .map(|(((a, b), c), ((d, e), f))| [[*a, *b, *c], [*d, *e, *f]])
}

/// Of one component's quintic between nodes h apart, ascending in (s − a)/h. Within the loop over components, where several go
/// together.
#[inline(always)]
fn coefficients(h: f64, [a, b]: [Jet<f64>; 2]) -> [f64; 6] {
    let (v0, c0) = (h * a[1], 0.5 * h * h * a[2]);
    let gap = b[0] - (a[0] + v0 + c0);
    let slope = h * b[1] - (v0 + 2.0 * c0);
    let bend = h * h * b[2] - 2.0 * c0;
    let c3 = 10.0 * gap - 4.0 * slope + 0.5 * bend;
    let c4 = -15.0 * gap + 7.0 * slope - bend;
    let c5 = 6.0 * gap - 3.0 * slope + 0.5 * bend;
    [a[0], v0, c0, c3, c4, c5]
}

/// A number of each of K nodes.
type Each<const K: usize> = [f64; K];
/// Value, first and second derivative.
type Jet<T> = [T; 3];

#[inline(always)]
fn each<const K: usize>(number: impl Fn(usize) -> f64) -> Each<K> {
    std::array::from_fn(number)
}

#[inline(always)]
fn product<const K: usize>(a: &Jet<Each<K>>, b: Jet<Each<K>>) -> Jet<Each<K>> {
    [
        each(|j| a[0][j] * b[0][j]),
        each(|j| a[0][j] * b[1][j] + a[1][j] * b[0][j]),
        each(|j| a[0][j] * b[2][j] + 2.0 * a[1][j] * b[1][j] + a[2][j] * b[0][j]),
    ]
}

/// Of each node Π (s − s_i) over all others, from `distance(j, i)`.
#[inline(always)]
fn others<const K: usize>(distance: impl Fn(usize, usize) -> f64) -> Jet<Each<K>> {
    const { assert!(K > 2) };
    let next = |step: usize| each(|j| distance(j, (j + step) % K));
    let (one, two): (Each<K>, Each<K>) = (next(1), next(2));
    let mut jet = [
        each(|j| one[j] * two[j]),
        each(|j| one[j] + two[j]),
        [2.0; K],
    ];
    for step in 3..K {
        let own: Each<K> = next(step);
        let [p, d, dd] = jet;
        jet = [
            each(|j| p[j] * own[j]),
            each(|j| d[j] * own[j] + p[j]),
            each(|j| dd[j] * own[j] + 2.0 * d[j]),
        ];
    }
    jet
}

/// What q, q′, q″ of K nodes are multiplied by in the polynomial through all of them at `s`: the jets of three weights. Nodes
/// go side by side.
#[inline(always)]
fn weights<const K: usize>(at: &Each<K>, s: f64) -> [Jet<Each<K>>; 3] {
    // With P = Π (s − s_i): L = (P/P_j)³, p = 3 P_j′/P_j, p² − r = 6 (P_j′/P_j)² − 3/2 P_j″/P_j.
    let [all, slope, bend] = others::<K>(|j, i| at[j] - at[i]);
    let inverse: Each<K> = each(|j| 1.0 / all[j]);
    let slope: Each<K> = each(|j| slope[j] * inverse[j]);
    let c1: Each<K> = each(|j| -3.0 * slope[j]);
    let c2: Each<K> = each(|j| 6.0 * slope[j] * slope[j] - 1.5 * bend[j] * inverse[j]);
    let t: Each<K> = each(|j| s - at[j]);
    let [p, d, dd] = others::<K>(|_, i| t[i]);
    let p: Each<K> = each(|j| p[j] * inverse[j]);
    let d: Each<K> = each(|j| d[j] * inverse[j]);
    let dd: Each<K> = each(|j| dd[j] * inverse[j]);
    let squares: Each<K> = each(|j| 3.0 * p[j] * p[j]);
    let all = [
        each(|j| p[j] * p[j] * p[j]),
        each(|j| squares[j] * d[j]),
        each(|j| 6.0 * p[j] * d[j] * d[j] + squares[j] * dd[j]),
    ];
    let (one, ct): (Each<K>, Each<K>) = ([1.0; K], each(|j| c1[j] * t[j]));
    let cct: Each<K> = each(|j| c2[j] * t[j]);
    let of_q = [
        each(|j| 1.0 + t[j] * (c1[j] + cct[j])),
        each(|j| c1[j] + 2.0 * cct[j]),
        each(|j| 2.0 * c2[j]),
    ];
    let of_d = [
        each(|j| t[j] + t[j] * ct[j]),
        each(|j| 1.0 + 2.0 * ct[j]),
        each(|j| 2.0 * c1[j]),
    ];
    let of_dd = [each(|j| 0.5 * t[j] * t[j]), t, one];
    [
        product(&all, of_q),
        product(&all, of_d),
        product(&all, of_dd),
    ]
}

/// What the data of nodes are multiplied by in the polynomial that meets them, at `s`: of each node as many of q, q′, q″ as it
/// says, of all nodes behind each other.
pub fn value_weights(nodes: &[(f64, usize)], s: f64) -> Vec<f64> {
    let count = nodes.iter().map(|(_, count)| count).sum();
    let mut x = Vec::with_capacity(count);
    // where the data of the node of each begin
    let mut begin = Vec::with_capacity(count);
    for (at, own) in nodes {
        begin.resize(x.len() + own, x.len());
        x.resize(x.len() + own, *at);
    }
    if count == nodes.len() {
        // Lagrange's form
        let weight = |j: usize| {
            let others = (0..count).filter(|i| *i != j);
            others.fold(1.0, |product, i| product * ((s - x[i]) / (x[j] - x[i])))
        };
        return (0..count).map(weight).collect();
    }
    let mut column = vec![0.0; count];
    let mut weights = Vec::with_capacity(count);
    for datum in 0..count {
        // Newton's form of the polynomial of which this datum is 1, and all others are 0
        let (own, order) = (begin[datum], datum - begin[datum]);
        for (c, begin) in column.iter_mut().zip(&begin) {
            *c = f64::from(*begin == own && order == 0);
        }
        let mut factorial = 1.0;
        for width in 1..count {
            factorial *= width as f64;
            for i in (width..count).rev() {
                let gap = x[i] - x[i - width];
                column[i] = if gap == 0.0 {
                    f64::from(begin[i] == own && order == width) / factorial
                } else {
                    (column[i] - column[i - 1]) / gap
                };
            }
        }
        let terms = column.iter().zip(&x).rev();
        weights.push(terms.fold(0.0, |sum, (c, x)| sum * (s - x) + c));
    }
    weights
}

/// Components that are summed side by side, and from how many on it pays to spread the weights for that first.
const TOGETHER: usize = 2;
const MANY: usize = 48;

/// Evaluates the polynomial of degree 3K − 1 that meets q, q′, q″ at K distinct nodes, at `s`; q goes to `q`, its derivatives
/// to `d` and `dd`.
pub fn osculate<const K: usize>(nodes: [&Node; K], s: f64, [q, d, dd]: [&mut [f64]; 3]) {
    let at = nodes.map(|node| node.s);
    // The weights of q add up to 1: differences from one node lose least, those from the nearest.
    let nearest = (1..K).fold(0, |nearest: usize, j| {
        let is_nearer = (at[j] - s).abs() < (at[nearest] - s).abs();
        if is_nearer { j } else { nearest }
    });
    let weights = weights(&at, s);
    let n = q.len();
    let to = [q, &mut d[..n], &mut dd[..n]];
    let sums = Sums {
        values: nodes.map(|node| [&node.q[..n], &node.d[..n], &node.dd[..n]]),
        base: &nodes[nearest].q[..n],
    };
    if n < MANY {
        sums.put(to, |order, kind, j| [weights[kind][order][j]; TOGETHER]);
    } else {
        let spread = |weight: f64| [weight; TOGETHER];
        let wide = weights.map(|own| own.map(|own| own.map(spread)));
        sums.put(to, |order, kind, j| wide[kind][order][j]);
    }
}

/// q, q′, q″ of K nodes (n), and what q is taken from (n).
struct Sums<'a, const K: usize> {
    values: [[&'a [f64]; 3]; K],
    base: &'a [f64],
}

impl<const K: usize> Sums<'_, K> {
    /// Sums by weights, of an order of derivative, a kind of value and a node.
    #[inline(always)]
    fn put(
        &self,
        [q, d, dd]: [&mut [f64]; 3],
        weight: impl Fn(usize, usize, usize) -> [f64; TOGETHER],
    ) {
        let n = self.base.len();
        let mut k = 0;
        while k + TOGETHER <= n {
            let sums = self.some(k, &weight);
            q[k..k + TOGETHER].copy_from_slice(&sums[0]);
            d[k..k + TOGETHER].copy_from_slice(&sums[1]);
            dd[k..k + TOGETHER].copy_from_slice(&sums[2]);
            k += TOGETHER;
        }
        while k < n {
            let narrow = |order, kind, j| [weight(order, kind, j)[0]];
            [[q[k]], [d[k]], [dd[k]]] = self.some(k, &narrow);
            k += 1;
        }
    }

    /// W components from k on.
    #[inline(always)]
    fn some<const W: usize>(
        &self,
        k: usize,
        weight: &impl Fn(usize, usize, usize) -> [f64; W],
    ) -> Jet<[f64; W]> {
        let take = |from: &[f64]| -> [f64; W] { std::array::from_fn(|lane| from[k + lane]) };
        let base = take(self.base);
        let mut sums = [[0.0; W]; 3];
        for (j, values) in self.values.iter().enumerate() {
            let [mut q, d, dd] = values.map(take);
            q.iter_mut().zip(&base).for_each(|(q, base)| *q -= base);
            for (kind, own) in [q, d, dd].iter().enumerate() {
                for (order, sum) in sums.iter_mut().enumerate() {
                    let weight = weight(order, kind, j);
                    for ((sum, own), weight) in sum.iter_mut().zip(own).zip(&weight) {
                        *sum += own * weight;
                    }
                }
            }
        }
        let to = sums[0].iter_mut().zip(&base);
        to.for_each(|(q, base)| *q += base);
        sums
    }
}

/// Coordinates that nodes are added up for in turn: their sums stay near the processor.
const ABREAST: usize = 256;

/// As [`osculate`], to the last bit, for many coordinates: node by node.
///
/// On a curve that repeats itself nodes may stand for those of other turns: node j counts at `at[j]`, so many `turns` on from its own
/// place. What is given back is by what q, q′ and q″ grow where a turn adds 1 to a coordinate; nothing of that is in them yet.
pub fn osculate_abreast<const K: usize>(
    nodes: [&Node; K],
    (at, turns): ([f64; K], [f64; K]),
    s: f64,
    [q, d, dd]: [&mut [f64]; 3],
) -> [f64; 3] {
    let nearest = (0..K).min_by(|&i, &j| (at[i] - s).abs().total_cmp(&(at[j] - s).abs()));
    let nearest = nearest.unwrap_or(0);
    let base = &nodes[nearest].q[..];
    let weights = weights(&at, s);
    let mut grown = weights[0].map(|of| {
        let own = turns.iter().zip(&of);
        own.map(|(turns_on, weight)| (turns_on - turns[nearest]) * weight)
            .sum::<f64>()
    });
    grown[0] += turns[nearest];
    // By node: what its q, q′ and q″ are multiplied by.
    let weights: [[Jet<f64>; 3]; K] =
        std::array::from_fn(|j| std::array::from_fn(|kind| weights[kind].map(|of| of[j])));
    let to = q.chunks_mut(ABREAST).zip(d.chunks_mut(ABREAST));
    let to = to.zip(dd.chunks_mut(ABREAST)).zip(base.chunks(ABREAST));
    for (part, (((q, d), dd), base)) in to.enumerate() {
        let first = part * ABREAST;
        q.fill(0.0);
        d.fill(0.0);
        dd.fill(0.0);
        for (node, weights) in nodes.iter().zip(&weights) {
            let own = [&node.q[first..], &node.d[first..], &node.dd[first..]];
            add([q, d, dd], base, own, weights);
        }
        q.iter_mut().zip(base).for_each(|(q, base)| *q += base);
    }
    grown
}

/// Adds what a node weighs. By itself, so that it is known that what it writes is nothing that it reads.
#[inline(never)]
fn add(
    [q, d, dd]: [&mut [f64]; 3],
    base: &[f64],
    [own, slope, bend]: [&[f64]; 3],
    [values, slopes, bends]: &[Jet<f64>; 3],
) {
    let to = q.iter_mut().zip(d).zip(dd).zip(base);
    let from = own.iter().zip(slope).zip(bend);
    for ((((q, d), dd), base), ((own, slope), bend)) in to.zip(from) {
        let off = own - base;
        *q = *q + off * values[0] + slope * slopes[0] + bend * bends[0];
        *d = *d + off * values[1] + slope * slopes[1] + bend * bends[1];
        *dd = *dd + off * values[2] + slope * slopes[2] + bend * bends[2];
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
mod tests;
