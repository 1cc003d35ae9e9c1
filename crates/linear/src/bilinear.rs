//! All roots of square systems of bilinear equations in two groups of complex unknowns.
//!
//! ```text
//! zᵀ Cₖ w = 0,   k = 1 … 2p,   z = (z₀, z₁ … z_p),  w = (w₀, w₁ … w_p),  Cₖ (p+1 × p+1) complex
//! ```
//!
//! Both groups are projective: roots with z₀ = 0 or w₀ = 0 lie at infinity. There are at most (2p over p) isolated roots: 2, 6, 20, 70, the
//! number of products z-linear × w-linear of which p factors of either kind vanish (multihomogeneous Bézout number; Sommese and Wampler,
//! The Numerical Solution of Systems of Polynomials, 2005, 8.4).
//!
//! p = 1 is a quadratic equation. Else the roots are followed from those of such products,
//!
//! ```text
//! zᵀ [(1 − t) γₖ lₖ mₖᵀ + t Cₖ] w = 0,   t from 0 to 1,   lₖ and mₖ random within the forms that equation k is made of
//! ```
//!
//! so that, with probability one, no two paths meet before t = 1 and each isolated root is the end of one (ibid., 8.3). Where the
//! equations are sparse, fewer products have a root, and as many paths fewer are followed. Steps are predicted by the cubic through the
//! last two points, and taken if Newton's first correction is small and its second far smaller.

use nalgebra::Complex;

/// A complex number.
pub type Number = Complex<f64>;

/// First corrections of a step that is taken, and of the tries after paths met.
const NEAR: [f64; 3] = [1e-4, 1e-6, 1e-8];
/// The second correction, as part of the first.
const FASTER: f64 = 0.05;
/// Corrections below this are round-off.
const ROUND_OFF: f64 = 1e-14;
/// Shortest step; what needs shorter ones ends in a singular root.
const SHORTEST: f64 = 1e-7;
const MOST_STEPS: usize = 20_000;
/// Size of z₀ or w₀, of a vector of norm 1, below which a root is at infinity.
const INFINITE: f64 = 1e-9;
/// The same of an end that was not reached.
const NEARLY_INFINITE: f64 = 1e-6;
/// Distance below which two roots are the same.
const SAME: f64 = 1e-7;
/// Steps that end nearer than this to t = 1 have found their root, if a singular one.
const AT_END: f64 = 1e-3;
/// Where double precision leads no further than this, the end is singular, but not known; most such ends are at infinity.
const NEAR_END: f64 = 0.3;

/// One equation.
#[derive(Debug, Clone)]
pub struct BilinearEquation {
    /// C by rows (p+1 × p+1).
    pub coefficients: Vec<Number>,
    /// Forms of z, and of w, of whose products the equation is a sum; one vanishes at the start of a path (p+1 each).
    pub factors: [Vec<Vec<Number>>; 2],
}

/// A root: z₁ … z_p, w₁ … w_p, with z₀ = w₀ = 1.
#[derive(Debug, Clone, PartialEq)]
pub struct Root {
    /// (p)
    pub z: Vec<Number>,
    /// (p)
    pub w: Vec<Number>,
}

/// What was found.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Roots {
    /// Isolated roots.
    pub regular: Vec<Root>,
    /// Ends where the Jacobian is singular: multiple roots, or points of curves of roots.
    pub singular: Vec<Root>,
    /// Whether singular ends are points of a curve of roots.
    pub is_curve: bool,
    /// Ends at infinity.
    pub infinite: usize,
    /// Paths whose end is singular and was not reached: nearly always at infinity. Where there are none, and none was lost, all isolated
    /// roots are there.
    pub stuck: usize,
    /// Paths that were lost on the way, or led to a root that another had found.
    pub lost: usize,
}

impl Roots {
    /// How many paths there were.
    pub fn paths(&self) -> usize {
        self.regular.len() + self.singular.len() + self.infinite + self.stuck + self.lost
    }
}

/// All roots of 2p equations.
///
/// # Panics
/// When there are not 2p equations of p + 1 unknowns each.
pub fn roots(equations: &[BilinearEquation], p: usize) -> Roots {
    assert_eq!(equations.len(), 2 * p, "a square system");
    match p {
        0 => Roots {
            regular: vec![Root {
                z: Vec::new(),
                w: Vec::new(),
            }],
            ..Roots::default()
        },
        1 => quadratic(equations),
        _ => followed(equations, p),
    }
}

/// The roots for p = 1: w is the vector across zᵀC₁, so that zᵀC₂w is quadratic in z.
fn quadratic(equations: &[BilinearEquation]) -> Roots {
    let scaled = |number: usize| -> [Number; 4] {
        let own = &equations[number].coefficients;
        let size = own.iter().fold(0.0, |most: f64, c| most.max(c.norm()));
        let size = if size > 0.0 { size } else { 1.0 };
        [own[0] / size, own[1] / size, own[2] / size, own[3] / size]
    };
    let (a, b) = (scaled(0), scaled(1));
    // (z₀a₀ + z₁a₂)(z₀b₁ + z₁b₃) − (z₀a₁ + z₁a₃)(z₀b₀ + z₁b₂), coefficients of z₀², z₀z₁, z₁²
    let c = [
        a[0] * b[1] - a[1] * b[0],
        a[0] * b[3] + a[2] * b[1] - a[1] * b[2] - a[3] * b[0],
        a[2] * b[3] - a[3] * b[2],
    ];
    let mut found = Roots::default();
    let size = c.iter().fold(0.0, |most: f64, c| most.max(c.norm()));
    if size <= ROUND_OFF {
        // A curve of roots: one equation follows from the other, or both vanish for some z.
        found.singular.extend(on_curve(&a, &b));
        found.is_curve = true;
        return found;
    }
    let discriminant = c[1] * c[1] - 4.0 * c[0] * c[2];
    let root = discriminant.sqrt();
    let half = match (c[1].conj() * root).re >= 0.0 {
        true => -0.5 * (c[1] + root),
        false => -0.5 * (c[1] - root),
    };
    let is_double = discriminant.norm().sqrt() <= 1e-7 * size;
    for [z1, z0] in [[half, c[2]], [c[0], half]] {
        // Both vanish only with c₁ and one of the others; the root is double, at 0 or at infinity.
        let [z1, z0] = match z1.norm().max(z0.norm()) <= ROUND_OFF * size {
            true if c[2].norm() > c[0].norm() => [Number::new(0.0, 0.0), Number::new(1.0, 0.0)],
            true => [Number::new(1.0, 0.0), Number::new(0.0, 0.0)],
            false => [z1, z0],
        };
        let norm = z1.norm().hypot(z0.norm());
        let (z1, z0) = (z1 / norm, z0 / norm);
        let rows = [a, b].map(|c| [z0 * c[0] + z1 * c[2], z0 * c[1] + z1 * c[3]]);
        let norms = rows.map(|[x, y]| x.norm().hypot(y.norm()));
        let row = rows[usize::from(norms[1] > norms[0])];
        let norm = norms[0].max(norms[1]);
        if norm <= ROUND_OFF {
            found
                .singular
                .extend(affine(&[z0, z1], &[Number::new(1.0, 0.0); 2], INFINITE));
            continue;
        }
        let w = [-row[1] / norm, row[0] / norm];
        match affine(&[z0, z1], &w, INFINITE) {
            None => found.infinite += 1,
            Some(root) if is_double => found.singular.push(root),
            Some(root) => found.regular.push(root),
        }
    }
    found
}

/// Some roots of a curve of roots.
fn on_curve(a: &[Number; 4], b: &[Number; 4]) -> Vec<Root> {
    let norm = |c: &[Number; 4]| c.iter().map(Number::norm_sqr).sum::<f64>();
    let c = if norm(a) >= norm(b) { a } else { b };
    let turns = [0.3, 2.2, 4.5].map(|angle: f64| Number::from_polar(1.0, angle));
    let on = turns.map(|z| {
        affine(
            &[1.0.into(), z],
            &[-(c[1] + z * c[3]), c[0] + z * c[2]],
            INFINITE,
        )
    });
    on.into_iter().flatten().collect()
}

/// A root by its homogeneous coordinates; `None` at infinity.
fn affine(z: &[Number], w: &[Number], least: f64) -> Option<Root> {
    let finite = |x: &[Number]| {
        let size = x.iter().map(Number::norm_sqr).sum::<f64>().sqrt();
        (x[0].norm() > least * size).then(|| x[1..].iter().map(|c| c / x[0]).collect())
    };
    Some(Root {
        z: finite(z)?,
        w: finite(w)?,
    })
}

/// The roots for larger p, by paths; again, with smaller steps, where two paths came to the same root or one was lost.
fn followed(equations: &[BilinearEquation], p: usize) -> Roots {
    let mut best = Roots::default();
    for (attempt, near) in NEAR.into_iter().enumerate() {
        let mut random = Random(0x9e37_79b9_7f4a_7c15 ^ ((attempt as u64) << 32));
        let homotopy = Homotopy::new(equations, p, &mut random);
        let found = homotopy.all(near);
        if attempt == 0 || found.lost < best.lost {
            best = found;
        }
        if best.lost == 0 {
            break;
        }
    }
    best
}

/// Random numbers that are always the same (Steele, Lea and Flood, OOPSLA 2014: SplitMix).
#[derive(Debug, Clone)]
pub struct Random(u64);

impl Random {
    /// From a seed.
    pub fn new(seed: u64) -> Self {
        Random(seed)
    }

    /// A number on the unit circle.
    pub fn turn(&mut self) -> Number {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        let part = (z ^ (z >> 31)) >> 11;
        Number::from_polar(
            1.0,
            part as f64 / (1_u64 << 53) as f64 * std::f64::consts::TAU,
        )
    }
}

/// The equations between start and target.
struct Homotopy {
    p: usize,
    /// (2p) of (p+1 × p+1)
    start: Vec<Vec<Number>>,
    target: Vec<Vec<Number>>,
    /// The factors of the start (2p) of (p+1).
    factors: [Vec<Vec<Number>>; 2],
    /// a·z = 1, b·w = 1.
    patch: [Vec<Number>; 2],
}

impl Homotopy {
    fn new(equations: &[BilinearEquation], p: usize, random: &mut Random) -> Self {
        let factor = |forms: &[Vec<Number>], random: &mut Random| {
            let mut sum = vec![Number::new(0.0, 0.0); p + 1];
            for form in forms {
                let weight = random.turn();
                let size = norm(form);
                if size > 0.0 {
                    let both = sum.iter_mut().zip(form);
                    both.for_each(|(sum, own)| *sum += weight * own / size);
                }
            }
            sum
        };
        let mut factors = [Vec::new(), Vec::new()];
        let (mut start, mut target) = (Vec::new(), Vec::new());
        for equation in equations {
            let [l, m] = equation
                .factors
                .each_ref()
                .map(|forms| factor(forms, random));
            let product = l.iter().flat_map(|l| m.iter().map(move |m| l * m));
            start.push(product.collect());
            let size = norm(&equation.coefficients);
            let size = if size > 0.0 { size } else { 1.0 };
            target.push(equation.coefficients.iter().map(|c| c / size).collect());
            factors[0].push(l);
            factors[1].push(m);
        }
        let patch = [0, 1].map(|_| (0..=p).map(|_| random.turn()).collect());
        Homotopy {
            p,
            start,
            target,
            factors,
            patch,
        }
    }

    /// The ends of all paths.
    fn all(&self, near: f64) -> Roots {
        let p = self.p;
        let mut found = Roots::default();
        let mut path = Path::new(self, near);
        // Bits say whose factor of z vanishes.
        for chosen in (0_u32..1 << (2 * p)).filter(|chosen| chosen.count_ones() as usize == p) {
            let pick = |of_z: bool| -> Vec<&[Number]> {
                let own = (0..2 * p).filter(|k| (chosen >> k & 1 == 1) == of_z);
                let side = usize::from(!of_z);
                own.map(|k| &self.factors[side][k][..]).collect()
            };
            let (Some(z), Some(w)) = (
                vanishing(&pick(true), &self.patch[0]),
                vanishing(&pick(false), &self.patch[1]),
            ) else {
                continue;
            };
            // Roots at infinity lead to none that is finite.
            if affine(&z, &w, INFINITE).is_none() {
                continue;
            }
            path.x[..=p].copy_from_slice(&z);
            path.x[p + 1..].copy_from_slice(&w);
            let end = path.follow();
            let least = if end == End::Regular {
                INFINITE
            } else {
                NEARLY_INFINITE
            };
            let root = affine(&path.x[..=p], &path.x[p + 1..], least);
            match (end, root) {
                (End::Lost, _) => found.lost += 1,
                (_, None) => found.infinite += 1,
                (End::Stuck, _) => found.stuck += 1,
                (End::Regular, Some(root)) => {
                    if found.regular.iter().any(|other| is_same(other, &root)) {
                        found.lost += 1;
                    } else {
                        found.regular.push(root);
                    }
                }
                (End::Singular, Some(root)) => found.singular.push(root),
            }
        }
        found
    }
}

fn is_same(a: &Root, b: &Root) -> bool {
    let apart = |a: &[Number], b: &[Number]| {
        let both = a.iter().zip(b);
        both.fold(0.0, |most: f64, (a, b)| {
            most.max((a - b).norm() / (1.0 + a.norm()))
        })
    };
    apart(&a.z, &b.z).max(apart(&a.w, &b.w)) < SAME
}

fn norm(x: &[Number]) -> f64 {
    x.iter().map(Number::norm_sqr).sum::<f64>().sqrt()
}

/// x with rows · x = 0 and patch · x = 1; `None` where that does not determine it.
fn vanishing(rows: &[&[Number]], patch: &[Number]) -> Option<Vec<Number>> {
    let n = patch.len();
    let mut matrix: Vec<Number> = rows.iter().flat_map(|row| row.iter().copied()).collect();
    matrix.extend_from_slice(patch);
    let mut x = vec![Number::new(0.0, 0.0); n];
    x[n - 1] = 1.0.into();
    solve(&mut matrix, &mut x, 1e-11).then_some(x)
}

/// Solves a x = b in place by elimination with partial pivoting; false where a pivot is smaller than `least` of the largest.
fn solve(a: &mut [Number], b: &mut [Number], least: f64) -> bool {
    let n = b.len();
    let mut largest: f64 = 0.0;
    for k in 0..n {
        let size = |row: usize| a[row * n + k].norm_sqr();
        let pivot = (k..n)
            .max_by(|i, j| size(*i).total_cmp(&size(*j)))
            .unwrap_or(k);
        let pivot_size = size(pivot).sqrt();
        largest = largest.max(pivot_size);
        if pivot_size.is_nan() || pivot_size <= least * largest {
            return false;
        }
        if pivot != k {
            for column in k..n {
                a.swap(k * n + column, pivot * n + column);
            }
            b.swap(k, pivot);
        }
        let inverse = a[k * n + k].inv();
        let (upper, lower) = a.split_at_mut((k + 1) * n);
        let row = &upper[k * n..];
        let own = b[k];
        for (other, b) in lower.chunks_exact_mut(n).zip(&mut b[k + 1..]) {
            let factor = other[k] * inverse;
            if factor == Number::new(0.0, 0.0) {
                continue;
            }
            let pairs = other[k + 1..].iter_mut().zip(&row[k + 1..]);
            pairs.for_each(|(other, own)| *other -= factor * own);
            *b -= factor * own;
        }
    }
    for k in (0..n).rev() {
        let known = (k + 1..n).map(|column| a[k * n + column] * b[column]);
        b[k] = (b[k] - known.sum::<Number>()) / a[k * n + k];
    }
    true
}

/// How a path ended.
#[derive(Debug, Clone, Copy, PartialEq)]
enum End {
    Regular,
    Singular,
    Stuck,
    Lost,
}

/// A path, with room to work in.
struct Path<'h> {
    homotopy: &'h Homotopy,
    near: f64,
    /// z, w (2p + 2), and its derivative by t.
    x: Vec<Number>,
    slope: Vec<Number>,
    before: (f64, Vec<Number>, Vec<Number>),
    trial: Vec<Number>,
    jacobian: Vec<Number>,
    step: Vec<Number>,
}

impl<'h> Path<'h> {
    fn new(homotopy: &'h Homotopy, near: f64) -> Self {
        let n = 2 * homotopy.p + 2;
        let zeros = || vec![Number::new(0.0, 0.0); n];
        Path {
            homotopy,
            near,
            x: zeros(),
            slope: zeros(),
            before: (0.0, zeros(), zeros()),
            trial: zeros(),
            jacobian: vec![Number::new(0.0, 0.0); n * n],
            step: zeros(),
        }
    }

    /// Jacobian at (x, t) into `jacobian`; −H, or −∂H/∂t, into `step`.
    fn evaluate(&mut self, at_trial: bool, t: f64, by_t: bool) {
        let (h, x) = (self.homotopy, if at_trial { &self.trial } else { &self.x });
        let m = h.p + 1;
        let n = 2 * m;
        let (z, w) = x.split_at(m);
        self.jacobian.fill(Number::new(0.0, 0.0));
        for (k, (start, target)) in h.start.iter().zip(&h.target).enumerate() {
            let mut value = Number::new(0.0, 0.0);
            let row = &mut self.jacobian[k * n..(k + 1) * n];
            let (of_z, of_w) = row.split_at_mut(m);
            for i in 0..m {
                let (start, target) = (&start[i * m..(i + 1) * m], &target[i * m..(i + 1) * m]);
                let mut sum = Number::new(0.0, 0.0);
                let mut change = Number::new(0.0, 0.0);
                for j in 0..m {
                    let c = start[j] * (1.0 - t) + target[j] * t;
                    sum += c * w[j];
                    of_w[j] += c * z[i];
                    if by_t {
                        change += (target[j] - start[j]) * w[j];
                    }
                }
                of_z[i] = sum;
                value += z[i] * if by_t { change } else { sum };
            }
            self.step[k] = -value;
        }
        for (side, part) in [z, w].into_iter().enumerate() {
            let row = n - 2 + side;
            let patch = &h.patch[side];
            let own = &mut self.jacobian[row * n + side * m..row * n + side * m + m];
            own.copy_from_slice(patch);
            let dot: Number = patch.iter().zip(part).map(|(a, x)| a * x).sum();
            self.step[row] = if by_t {
                Number::new(0.0, 0.0)
            } else {
                Number::new(1.0, 0.0) - dot
            };
        }
    }

    /// A step of Newton's method at `trial`; its size, by that of x.
    fn correct(&mut self, t: f64) -> Option<f64> {
        self.evaluate(true, t, false);
        if !solve(&mut self.jacobian, &mut self.step, 1e-14) {
            return None;
        }
        let both = self.trial.iter_mut().zip(&self.step);
        both.for_each(|(x, step)| *x += step);
        let size = norm(&self.step) / norm(&self.trial);
        size.is_finite().then_some(size)
    }

    /// dx/dt at x.
    fn turn(&mut self, t: f64) -> bool {
        self.evaluate(false, t, true);
        if !solve(&mut self.jacobian, &mut self.step, 1e-15) {
            return false;
        }
        self.slope.copy_from_slice(&self.step);
        true
    }

    /// From x at t = 0 to its end.
    fn follow(&mut self) -> End {
        let (mut t, mut h) = (0.0, 1e-2);
        let mut is_first = true;
        if !self.turn(t) {
            return End::Lost;
        }
        for _ in 0..MOST_STEPS {
            let next = if h >= 1.0 - t { 1.0 } else { t + h };
            self.predict(t, next, is_first);
            let taken = self.take(next);
            let (size, is_taken) = match taken {
                Some((first, is_taken)) => (first, is_taken),
                None => (f64::INFINITY, false),
            };
            let order = if is_first { 0.5 } else { 0.25 };
            let change = 0.9 * (self.near / size.max(1e-300)).powf(order);
            if is_taken {
                let (own_t, own_x, own_slope) = &mut self.before;
                *own_t = t;
                own_x.copy_from_slice(&self.x);
                own_slope.copy_from_slice(&self.slope);
                self.x.copy_from_slice(&self.trial);
                if next == 1.0 {
                    return End::Regular;
                }
                t = next;
                is_first = false;
                if !self.turn(t) {
                    break;
                }
                h *= change.clamp(0.3, 3.0);
            } else {
                h *= if change.is_finite() {
                    change.clamp(0.1, 0.5)
                } else {
                    0.1
                };
                if h < SHORTEST * (1.0 - t).max(1e-2) {
                    break;
                }
            }
        }
        match 1.0 - t {
            left if left < AT_END => End::Singular,
            left if left < NEAR_END => End::Stuck,
            _ => End::Lost,
        }
    }

    /// The trial at `next`, by the cubic through the last two points, or along the tangent.
    fn predict(&mut self, t: f64, next: f64, is_first: bool) {
        if is_first {
            let h = next - t;
            let along = self
                .x
                .iter()
                .zip(&self.slope)
                .map(|(x, slope)| x + slope * h);
            self.trial.clear();
            self.trial.extend(along);
            return;
        }
        let (before, from, from_slope) = &self.before;
        let gap = t - before;
        // Hermite's basis, s = 0 at the point before and 1 at the last.
        let s = (next - before) / gap;
        let (s2, r) = (s * s, s - 1.0);
        let weights = [
            (1.0 + 2.0 * s) * r * r,
            s * r * r * gap,
            s2 * (3.0 - 2.0 * s),
            s2 * r * gap,
        ];
        for (k, trial) in self.trial.iter_mut().enumerate() {
            *trial = from[k] * weights[0]
                + from_slope[k] * weights[1]
                + self.x[k] * weights[2]
                + self.slope[k] * weights[3];
        }
    }

    /// Corrects the trial: the size of the first correction, and whether the step may be taken.
    fn take(&mut self, next: f64) -> Option<(f64, bool)> {
        let first = self.correct(next)?;
        if first > self.near {
            return Some((first, false));
        }
        let second = self.correct(next)?;
        if second > FASTER * first && second > ROUND_OFF.sqrt() * self.near {
            return Some((first.max(4.0 * self.near), false));
        }
        if next == 1.0 {
            // To round-off; a singular root is not reached so.
            let mut last = second;
            for _ in 0..3 {
                if last <= ROUND_OFF {
                    break;
                }
                last = self.correct(next)?;
            }
            return Some((first, last <= 1e-10));
        }
        Some((first, true))
    }
}

#[cfg(test)]
mod tests;
