//! A primal-dual interior point method whose matrices have three diagonals.
//!
//! ```text
//! minimise f(β),  h_i(β) + s_i = 0,  s_i ≥ 0          h of a number: u;  of a size: (u² + v² − 1)/2
//! (∇²f + Σ z ∇²h + Σ (z/s) ∇h ∇hᵀ) Δβ = −∇f − Σ ∇h (z + (z r − σμ + …)/s)
//! ```
//!
//! With Mehrotra's predictor and corrector (1992) and a search along the step for the residuals (Boyd and Vandenberghe, Convex
//! Optimization, 2004, 11.7). Where ∇f + Σ z ∇h vanishes, β minimises the Lagrangian, so Σ s z is the distance from the dual value.

use super::{Row, Scaled, Term, Terms};

/// Gap and residuals at which it ends, by f and by the largest slope \[–\]: some digits above round-off.
const ACCURACY: f64 = 1e-11;
/// The same where no step improves them any more.
const ENOUGH: f64 = 1e-9;
/// T, in the unit that follows from the limits, below which nothing bounds the speed.
const LEAST: f64 = 1e-3;
const MOST_ITERATIONS: usize = 100;
/// Part of the way to the boundary that a step may go.
const INSIDE: f64 = 0.995;
/// Shortest part of a step that is tried.
const SHORTEST: f64 = 1e-6;

/// Part of the room of b at which it starts, and slope of b there, by the room over the whole path.
const PART: f64 = 0.6;
const STEEP: f64 = 1.0;

/// What it ends with.
pub(super) struct Found {
    /// β of the nodes between the ends.
    pub inner: Vec<f64>,
    /// Multipliers of the rows.
    pub weights: Vec<f64>,
    /// Σ s z.
    pub gap: f64,
    pub iterations: usize,
}

/// Value, gradient and Hessian of a row by its two unknowns.
struct Local {
    value: f64,
    gradient: [f64; 2],
    hessian: [f64; 3],
}

impl Row {
    fn local(&self, [from, to]: [f64; 2]) -> Local {
        let at = |u: &Term| u[0] + u[1] * from + u[2] * to;
        match &self.of {
            Terms::Below(u) => Local {
                value: at(u),
                gradient: [u[1], u[2]],
                hessian: [0.0; 3],
            },
            Terms::Within(all) => {
                let mut local = Local {
                    value: -0.5,
                    gradient: [0.0; 2],
                    hessian: [0.0; 3],
                };
                for u in all {
                    let size = at(u);
                    local.value += 0.5 * size * size;
                    for k in 0..2 {
                        local.gradient[k] += size * u[k + 1];
                    }
                    let products = [u[1] * u[1], u[1] * u[2], u[2] * u[2]];
                    (local.hessian.iter_mut().zip(products)).for_each(|(own, one)| *own += one);
                }
                local
            }
        }
    }
}

/// A symmetric matrix with three diagonals over all nodes; the ends are held.
struct Tridiagonal {
    diagonal: Vec<f64>,
    beside: Vec<f64>,
}

impl Tridiagonal {
    fn add(&mut self, k: usize, [first, mixed, second]: [f64; 3]) {
        self.diagonal[k] += first;
        self.beside[k] += mixed;
        self.diagonal[k + 1] += second;
    }

    /// L D Lᵀ in place; whether it is positive definite.
    fn factor(&mut self) -> bool {
        let last = self.diagonal.len() - 1;
        for end in [0, last] {
            self.diagonal[end] = 1.0;
        }
        (self.beside[0], self.beside[last - 1]) = (0.0, 0.0);
        for k in 1..=last {
            let off = self.beside[k - 1];
            self.beside[k - 1] = off / self.diagonal[k - 1];
            self.diagonal[k] -= off * self.beside[k - 1];
        }
        self.diagonal.iter().all(|d| *d > 0.0 && d.is_finite())
    }

    fn solve(&self, x: &mut [f64]) {
        let last = x.len() - 1;
        (x[0], x[last]) = (0.0, 0.0);
        for k in 1..=last {
            x[k] -= self.beside[k - 1] * x[k - 1];
        }
        x.iter_mut().zip(&self.diagonal).for_each(|(x, d)| *x /= d);
        for k in (0..last).rev() {
            x[k] -= self.beside[k] * x[k + 1];
        }
    }
}

/// Unknowns, slacks and multipliers.
#[derive(Clone)]
struct Iterate {
    beta: Vec<f64>,
    slack: Vec<f64>,
    weight: Vec<f64>,
}

/// What is at a point.
struct Standing {
    value: f64,
    rows: Vec<Local>,
    matrix: Tridiagonal,
    /// ∇f + Σ z ∇h
    slope: Vec<f64>,
    /// h + s
    residual: Vec<f64>,
    mean: f64,
}

impl Standing {
    fn new(scaled: &Scaled, point: &Iterate) -> Self {
        let beta = &point.beta;
        let mut matrix = Tridiagonal {
            diagonal: vec![0.0; beta.len()],
            beside: vec![0.0; beta.len() - 1],
        };
        let mut slope = vec![0.0; beta.len()];
        let mut value = 0.0;
        for (k, span) in scaled.spans.iter().enumerate() {
            // T = 2 Δ/(r + q), r² and q² the two β
            let [r, q] = [beta[k].sqrt(), beta[k + 1].sqrt()];
            let sum = r + q;
            value += 2.0 * span / sum;
            let by = span / (sum * sum);
            let cubic = |own: f64| 0.5 * by * (1.0 / own + 2.0 / sum) / (own * own);
            // An end at rest has no slope, and needs none.
            let inner = |own: f64, of: f64| if own > 0.0 { of } else { 0.0 };
            slope[k] -= inner(r, by / r);
            slope[k + 1] -= inner(q, by / q);
            matrix.add(
                k,
                [
                    inner(r, cubic(r)),
                    inner(r * q, by / (sum * r * q)),
                    inner(q, cubic(q)),
                ],
            );
        }
        let rows: Vec<Local> = (scaled.rows.iter())
            .map(|row| row.local([beta[row.interval], beta[row.interval + 1]]))
            .collect();
        let pairs = point.slack.iter().zip(&point.weight);
        let mean = pairs.map(|(s, z)| s * z).sum::<f64>() / rows.len() as f64;
        for ((row, local), z) in scaled.rows.iter().zip(&rows).zip(&point.weight) {
            let k = row.interval;
            slope[k] += z * local.gradient[0];
            slope[k + 1] += z * local.gradient[1];
            matrix.add(k, local.hessian.map(|own| z * own));
        }
        let last = slope.len() - 1;
        (slope[0], slope[last]) = (0.0, 0.0);
        let residual = rows.iter().zip(&point.slack).map(|(row, s)| row.value + s);
        Standing {
            value,
            residual: residual.collect(),
            rows,
            matrix,
            slope,
            mean,
        }
    }

    /// Sums of squares of the residuals, complementarity with a target.
    fn merit(&self, point: &Iterate, target: f64) -> f64 {
        let squares = |all: &[f64]| all.iter().map(|x| x * x).sum::<f64>();
        let pairs = point.slack.iter().zip(&point.weight);
        let products = pairs.map(|(s, z)| (s * z - target) * (s * z - target));
        squares(&self.slope) + squares(&self.residual) + products.sum::<f64>()
    }

    /// How far it is from a solution: gap by value, residuals.
    fn distance(&self) -> f64 {
        let largest = |all: &[f64]| all.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        let gap = self.mean * self.rows.len() as f64 / self.value;
        gap.max(largest(&self.residual)).max(largest(&self.slope))
    }
}

/// A step of all unknowns, and the part of it that stays inside.
struct Direction {
    beta: Vec<f64>,
    slack: Vec<f64>,
    weight: Vec<f64>,
}

impl Direction {
    /// s z + Δ(s z) = target − what a step before made of it.
    fn new(
        scaled: &Scaled,
        state: &Standing,
        point: &Iterate,
        target: f64,
        before: Option<&Direction>,
    ) -> Self {
        let mut beta: Vec<f64> = state.slope.iter().map(|slope| -slope).collect();
        let product = |i: usize| {
            let more = before.map_or(0.0, |step| step.slack[i] * step.weight[i]);
            point.slack[i] * point.weight[i] + more - target
        };
        for (i, (row, local)) in scaled.rows.iter().zip(&state.rows).enumerate() {
            let push = (point.weight[i] * state.residual[i] - product(i)) / point.slack[i];
            beta[row.interval] -= push * local.gradient[0];
            beta[row.interval + 1] -= push * local.gradient[1];
        }
        state.matrix.solve(&mut beta);
        let mut step = Direction {
            slack: Vec::with_capacity(state.rows.len()),
            weight: Vec::with_capacity(state.rows.len()),
            beta,
        };
        for (i, (row, local)) in scaled.rows.iter().zip(&state.rows).enumerate() {
            let [from, to] = [step.beta[row.interval], step.beta[row.interval + 1]];
            let slack = -state.residual[i] - local.gradient[0] * from - local.gradient[1] * to;
            let weight = -(product(i) + point.weight[i] * slack) / point.slack[i];
            step.slack.push(slack);
            step.weight.push(weight);
        }
        step
    }

    /// The part that keeps everything positive.
    fn inside(&self, point: &Iterate) -> f64 {
        let pairs = [
            (&point.beta, &self.beta),
            (&point.slack, &self.slack),
            (&point.weight, &self.weight),
        ];
        let all = pairs.into_iter().flat_map(|(x, dx)| x.iter().zip(dx));
        let parts = all.filter(|(_, dx)| **dx < 0.0).map(|(x, dx)| -x / dx);
        parts.fold(1.0 / INSIDE, f64::min)
    }

    fn from(&self, point: &Iterate, part: f64) -> Iterate {
        let go = |x: &[f64], dx: &[f64]| x.iter().zip(dx).map(|(x, dx)| x + part * dx).collect();
        Iterate {
            beta: go(&point.beta, &self.beta),
            slack: go(&point.slack, &self.slack),
            weight: go(&point.weight, &self.weight),
        }
    }
}

/// The solution; `None` if it is not found.
pub(super) fn solve(scaled: &Scaled) -> Option<Found> {
    let mut point = start(scaled);
    let mut state = Standing::new(scaled, &point);
    for iterations in 1..=MOST_ITERATIONS {
        if state.value < LEAST {
            return None;
        }
        if state.distance() <= ACCURACY {
            return Some(found(point, &state, iterations - 1));
        }
        let Standing { matrix, rows, .. } = &mut state;
        for (i, row) in scaled.rows.iter().enumerate() {
            let (by, [from, to]) = (point.weight[i] / point.slack[i], rows[i].gradient);
            matrix.add(
                row.interval,
                [by * from * from, by * from * to, by * to * to],
            );
        }
        if !matrix.factor() {
            break;
        }
        let predictor = Direction::new(scaled, &state, &point, 0.0, None);
        let ahead = predictor.from(&point, INSIDE.min(predictor.inside(&point)));
        let pairs = ahead.slack.iter().zip(&ahead.weight);
        let mean = pairs.map(|(s, z)| s * z).sum::<f64>() / scaled.rows.len() as f64;
        let target = state.mean * (mean / state.mean).clamp(0.0, 1.0).powi(3);
        let step = Direction::new(scaled, &state, &point, target, Some(&predictor));
        let mut part = INSIDE * step.inside(&point);
        let before = state.merit(&point, target);
        loop {
            let next = step.from(&point, part);
            let there = Standing::new(scaled, &next);
            // No residual grows much, so far from the solution the step may be long.
            if there.merit(&next, target) <= 1.02 * before {
                (point, state) = (next, there);
                break;
            }
            part *= 0.5;
            if part < SHORTEST {
                return (state.distance() <= ENOUGH).then(|| found(point, &state, iterations));
            }
        }
    }
    (state.distance() <= ENOUGH).then(|| found(point, &state, MOST_ITERATIONS))
}

fn found(point: Iterate, state: &Standing, iterations: usize) -> Found {
    let Iterate { beta, weight, .. } = point;
    Found {
        inner: beta[1..beta.len() - 1].to_vec(),
        weights: weight,
        gap: state.mean * state.rows.len() as f64,
        iterations,
    }
}

/// Well within the room of each node, without steep flanks.
fn start(scaled: &Scaled) -> Iterate {
    let last = scaled.room.len() - 1;
    let room = scaled.room.iter().map(|room| PART * room.clamp(1e-6, 1.0));
    let mut beta: Vec<f64> = room.collect();
    (beta[0], beta[last]) = (scaled.ends[0], scaled.ends[1]);
    for k in 1..last {
        beta[k] = beta[k].min(beta[k - 1] + STEEP * scaled.spans[k - 1]);
    }
    for k in (1..last).rev() {
        beta[k] = beta[k].min(beta[k + 1] + STEEP * scaled.spans[k]);
    }
    let rows = scaled.rows.iter();
    let values = rows.map(|row| {
        row.local([beta[row.interval], beta[row.interval + 1]])
            .value
    });
    let slack: Vec<f64> = values.map(|value| (-value).max(0.1)).collect();
    let weight = slack.iter().map(|s| 0.1 / s).collect();
    Iterate {
        beta,
        slack,
        weight,
    }
}
