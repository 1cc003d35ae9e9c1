//! The model of a search: scales, the quadratic program of a step, the Hessian that is learnt.

use crate::outcome::Bounds;
use crate::quadratic::{Kind, Quadratic, Step};

/// First trust region, by ranges.
const FIRST_RADIUS: f64 = 0.2;
/// First price of violations, where slopes of all functions are 1.
const FIRST_PRICE: f64 = 10.0;
/// Violations that cost more than this are not to be avoided.
const LAST_PRICE: f64 = 1e9;

/// Variables are parts of ranges, values are by their scales.
pub struct Search<'s> {
    pub kinds: &'s [Kind],
    pub bounds: &'s Bounds,
    pub kept: f64,
    pub x: Vec<f64>,
    /// As the function gives them.
    pub values: Vec<f64>,
    /// As differences give them (values, n).
    pub slopes: Vec<f64>,
    pub scales: Vec<f64>,
    pub hessian: Vec<f64>,
    pub multipliers: Vec<f64>,
    pub price: f64,
    pub radius: f64,
    /// Other pieces of the objective.
    pub pieces: Vec<Piece>,
    /// Where the last step led that was refused.
    pub refused: Option<(Vec<f64>, Vec<f64>)>,
    /// How many were refused in a row.
    pub refusals: usize,
    /// Scaled slope of the objective as its pieces count in the end.
    pub blend: Option<Vec<f64>>,
}

/// A linear model of the objective.
pub struct Piece {
    /// Where it touches.
    at: Vec<f64>,
    /// Scaled value there.
    value: f64,
    /// Scaled slopes over the ranges.
    slopes: Vec<f64>,
}

impl<'s> Search<'s> {
    /// At a point with its values and their slopes.
    pub fn new(
        kinds: &'s [Kind],
        bounds: &'s Bounds,
        kept: f64,
        (x, values): (Vec<f64>, Vec<f64>),
        slopes: Vec<f64>,
    ) -> Self {
        Search {
            scales: scales(&slopes, bounds, values.len()),
            hessian: identity(x.len()),
            multipliers: vec![0.0; kinds.len()],
            price: FIRST_PRICE,
            radius: FIRST_RADIUS,
            pieces: Vec::new(),
            refused: None,
            refusals: 0,
            blend: None,
            kinds,
            bounds,
            kept,
            x,
            values,
            slopes,
        }
    }

    pub fn scaled(&self, values: &[f64]) -> Vec<f64> {
        values
            .iter()
            .zip(&self.scales)
            .map(|(value, scale)| value / scale)
            .collect()
    }

    pub fn merit(&self, values: &[f64]) -> f64 {
        let scaled = self.scaled(values);
        let violations = self.kinds.iter().zip(&scaled[1..]);
        scaled[0]
            + self.price
                * violations
                    .map(|(kind, value)| kind.violation(*value))
                    .sum::<f64>()
    }

    /// Scaled slopes of a value.
    pub fn row(&self, slopes: &[f64], row: usize) -> Vec<f64> {
        let n = self.x.len();
        let part = &slopes[row * n..(row + 1) * n];
        let parts = part.iter().enumerate();
        parts
            .map(|(k, slope)| slope * self.bounds.width(k) / self.scales[row])
            .collect()
    }

    /// Value of a piece here less that of the objective, at most 0 as one of a convex function is, and its slopes.
    fn plane(&self, piece: &Piece) -> (f64, Vec<f64>) {
        let moved = (0..self.x.len())
            .map(|k| piece.slopes[k] * (self.x[k] - piece.at[k]) / self.bounds.width(k));
        let value = piece.value + moved.sum::<f64>() - self.values[0] / self.scales[0];
        (value.min(0.0), piece.slopes.clone())
    }

    fn planes(&self) -> Vec<(f64, Vec<f64>)> {
        self.pieces.iter().map(|piece| self.plane(piece)).collect()
    }

    /// Takes the linear model at a point as another piece; the oldest gives way.
    pub fn add_piece(&mut self, at: Vec<f64>, values: &[f64], slopes: &[f64]) {
        if self.pieces.len() > self.x.len() {
            self.pieces.remove(0);
        }
        self.pieces.push(Piece {
            value: values[0] / self.scales[0],
            slopes: self.row(slopes, 0),
            at,
        });
    }

    /// Drops pieces that touch far away: they say nothing of the objective here.
    pub fn forget(&mut self) {
        const FAR: f64 = 20.0;
        let near = FAR * self.radius;
        let (x, bounds) = (&self.x, self.bounds);
        self.pieces.retain(|piece| {
            let off = |k: usize| (x[k] - piece.at[k]).abs() / bounds.width(k);
            (0..x.len()).all(|k| off(k) <= near)
        });
    }

    /// Slopes of the objective as its pieces count.
    pub fn blended(&self, weights: &[f64]) -> Vec<f64> {
        let own = self.row(&self.slopes, 0);
        let mut sum: Vec<f64> = own.iter().map(|slope| weights[0] * slope).collect();
        for (piece, weight) in self.pieces.iter().zip(&weights[1..]) {
            let slopes = sum.iter_mut().zip(&piece.slopes);
            slopes.for_each(|(sum, slope)| *sum += weight * slope);
        }
        sum
    }

    /// The program of a step; one that is `feasible` only sees to the constraints.
    pub fn program(&self, values: &[f64], feasible: bool) -> Quadratic {
        let n = self.x.len();
        let room = |k: usize| {
            let [lower, upper] = self.bounds.of(k);
            let width = self.bounds.width(k);
            let below = ((lower - self.x[k]) / width).min(0.0);
            let above = ((upper - self.x[k]) / width).max(0.0);
            [below.max(-self.radius), above.min(self.radius)]
        };
        // A trace of the model makes the solution unique.
        let trace = || self.hessian.iter().map(|entry| 1e-6 * entry).collect();
        Quadratic {
            gradient: if feasible {
                vec![0.0; n]
            } else {
                self.row(&self.slopes, 0)
            },
            planes: if feasible { Vec::new() } else { self.planes() },
            hessian: if feasible {
                trace()
            } else {
                self.hessian.clone()
            },
            constraints: (self.kinds.iter().enumerate())
                .map(|(i, kind)| (*kind, values[i + 1], self.row(&self.slopes, i + 1)))
                .collect(),
            room: (0..n).map(room).collect(),
            price: if feasible { 1.0 } else { self.price },
        }
    }

    /// The step, with a price that makes the constraints as good as they can get.
    pub fn priced(&mut self, values: &[f64]) -> Option<Step> {
        let mut program = self.program(values, false);
        let mut step = program.solve()?;
        let small = 0.1 * self.kept.min(1e-9);
        if step.violation <= small {
            return Some(step);
        }
        let now = program.violation(&vec![0.0; self.x.len()]);
        let best = self.program(values, true).solve()?.violation;
        while self.price < LAST_PRICE && now - step.violation < 0.9 * (now - best) - small {
            self.price *= 10.0;
            program.price = self.price;
            step = program.solve()?;
        }
        Some(step)
    }

    /// What the model promises of the merit.
    pub fn expected(&self, step: &Step) -> f64 {
        let program = self.program(&self.scaled(&self.values), false);
        let now = program.violation(&vec![0.0; self.x.len()]);
        self.price * (now - step.violation) - program.model(&step.d)
    }

    /// The step with constraints that bend as they were seen to.
    pub fn corrected(&self, step: &Step, values: &[f64]) -> Option<Step> {
        let mut shifted = self.scaled(values);
        for (i, value) in shifted.iter_mut().enumerate().skip(1) {
            let row = self.row(&self.slopes, i);
            *value -= row
                .iter()
                .zip(&step.d)
                .map(|(slope, d)| slope * d)
                .sum::<f64>();
        }
        self.program(&shifted, false).solve()
    }

    /// ∇f + Σ multiplier ∇c.
    pub fn lagrangian(&self, slopes: &[f64], multipliers: &[f64]) -> Vec<f64> {
        let mut sum = self.row(slopes, 0);
        for (i, multiplier) in multipliers.iter().enumerate() {
            let row = self.row(slopes, i + 1);
            sum.iter_mut()
                .zip(row)
                .for_each(|(sum, slope)| *sum += multiplier * slope);
        }
        sum
    }

    /// Largest slope of the Lagrangian that no bound holds.
    pub fn slope(&self) -> f64 {
        let mut all = self.lagrangian(&self.slopes, &self.multipliers);
        if let Some(blend) = &self.blend {
            let own = self.row(&self.slopes, 0);
            for (sum, (blend, own)) in all.iter_mut().zip(blend.iter().zip(own)) {
                *sum += blend - own;
            }
        }
        let all = all.into_iter().enumerate();
        let free = all.filter(|(k, slope)| match self.bounds.end(*k, self.x[*k]) {
            Some(crate::End::Lower) => *slope < 0.0,
            Some(crate::End::Upper) => *slope > 0.0,
            None => true,
        });
        free.map(|(_, slope)| slope.abs()).fold(0.0, f64::max)
    }

    /// Powell's damped update of B.
    pub fn learn(&mut self, to: &[f64], slopes: &[f64], multipliers: &[f64]) {
        let n = self.x.len();
        let s: Vec<f64> = (0..n)
            .map(|k| (to[k] - self.x[k]) / self.bounds.width(k))
            .collect();
        let (after, before) = (
            self.lagrangian(slopes, multipliers),
            self.lagrangian(&self.slopes, multipliers),
        );
        let mut y: Vec<f64> = after.iter().zip(before).map(|(a, b)| a - b).collect();
        let bs: Vec<f64> = self
            .hessian
            .chunks_exact(n)
            .map(|row| dot(row, &s))
            .collect();
        let (sbs, mut sy) = (dot(&s, &bs), dot(&s, &y));
        if sbs <= f64::MIN_POSITIVE {
            return;
        }
        if sy < 0.2 * sbs {
            let part = 0.8 * sbs / (sbs - sy);
            for (y, bs) in y.iter_mut().zip(&bs) {
                *y = part * *y + (1.0 - part) * bs;
            }
            sy = dot(&s, &y);
        }
        for i in 0..n {
            for j in 0..n {
                self.hessian[i * n + j] += y[i] * y[j] / sy - bs[i] * bs[j] / sbs;
            }
        }
    }
}

fn identity(n: usize) -> Vec<f64> {
    (0..n * n)
        .map(|k| if k % (n + 1) == 0 { 1.0 } else { 0.0 })
        .collect()
}

/// Length of the slopes of each value over the ranges; 1 where there are none.
fn scales(slopes: &[f64], bounds: &Bounds, rows: usize) -> Vec<f64> {
    let n = bounds.len();
    let scale = |row: usize| {
        let all = (0..n).map(|k| slopes[row * n + k] * bounds.width(k));
        let length = all.map(|slope| slope * slope).sum::<f64>().sqrt();
        if length > 0.0 { length } else { 1.0 }
    };
    (0..rows).map(scale).collect()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
