//! A mechanism at rest in minimal coordinates u: where it is, what pulls at it, and the linear terms about it.
//!
//! ```text
//! q = q(u)                                  by Newton from the position at hand, drivers held at their values
//! g = SᵀQ                                   S = ∂q/∂u (n, f); equilibrium where g = 0
//! K = −∂g/∂u  = −Sᵀ (∂Q/∂q) S − Σ Q ∂²q/∂u²   elastic and geometric stiffness (f, f)
//! C = −∂g/∂u̇  = −Sᵀ (∂Q/∂v) S               damping (f, f)
//! M̂ = SᵀMS                                  (f, f)
//! ```
//!
//! The second derivatives of q are the accelerations at u̇ = eᵢ ± eⱼ, ü = 0, so the geometric part has no error but
//! round-off. ∂Q/∂q along a tangent is a central difference, extrapolated (Ridders 1982). No mass is divided by.

use super::driven::{Driven, Failure};
use super::independent::better_coordinate;
use crate::system::{Evaluation, Inputs, Slopes, System};
use linkdyn_linear::math::{dot, max_abs};

/// Contraction of Newton above which a position is refused: its branch is not certain.
const CONTRACTION: f64 = 0.35;
/// Largest distance from the prediction, in rad or sizes, for the same reason.
const FARTHEST: f64 = 0.3;
/// First step of the differences of Q, in rad or sizes, and how often it is halved: springs a thousand times shorter than
/// the mechanism are still resolved.
const DIFFERENCE: f64 = 0.02;
const HALVINGS: usize = 11;

/// Part, relative to the largest, from which a row belongs to a near self-stress, and inverse iterations for that.
const STRAINED: f64 = 1e-2;
const STRAIN_ITERATIONS: usize = 3;

/// A mechanism held at its minimal coordinates.
pub struct LinearisedSystem<'s> {
    /// Solver of the position.
    pub driven: Driven<'s>,
    /// Drivers at their values, at rest.
    pub inputs: Inputs,
    /// Position (n).
    pub q: Vec<f64>,
    /// Q (n).
    pub force: Vec<f64>,
    /// S, one tangent after the other (f × n).
    tangents: Vec<f64>,
    /// Scaled residual of the constraints [–].
    pub residual: f64,
}

impl<'s> LinearisedSystem<'s> {
    /// At an assembled position at a time; `columns` are coordinates that determine the rest there.
    ///
    /// # Errors
    /// When they do not.
    pub fn new(
        system: &'s System,
        columns: &[usize],
        q: &[f64],
        time: f64,
    ) -> Result<Self, Failure> {
        let mut inputs = Inputs::at_time(system, time);
        inputs
            .drive
            .iter_mut()
            .for_each(|jet| *jet = [jet[0], 0.0, 0.0]);
        let driven = Driven::with_independent(system, columns, q, &inputs)?;
        let n = system.n();
        let mut held = LinearisedSystem {
            driven,
            inputs,
            q: q.to_vec(),
            force: vec![0.0; n],
            tangents: vec![0.0; columns.len() * n],
            residual: 0.0,
        };
        held.settle()?;
        held.exchange()?;
        Ok(held)
    }

    /// Degrees of freedom f.
    pub fn freedom(&self) -> usize {
        self.driven.independent.len()
    }

    /// The columns of the minimal coordinates.
    pub fn columns(&self) -> Vec<usize> {
        let coordinates = self.driven.independent.iter();
        coordinates.map(|coordinate| coordinate.column).collect()
    }

    /// Scale of a minimal coordinate [m or 1].
    pub fn scale(&self, k: usize) -> f64 {
        self.driven
            .system
            .column_scale(self.driven.independent[k].column)
    }

    /// ∂q/∂u_k (n).
    pub fn tangent(&self, k: usize) -> &[f64] {
        let n = self.q.len();
        &self.tangents[k * n..(k + 1) * n]
    }

    /// Σ S_k d_k (n).
    pub fn along(&self, d: &[f64]) -> Vec<f64> {
        let mut sum = vec![0.0; self.q.len()];
        for (k, d) in d.iter().enumerate() {
            sum.iter_mut()
                .zip(self.tangent(k))
                .for_each(|(sum, s)| *sum += d * s);
        }
        sum
    }

    /// g (f) [N or N·m].
    pub fn pull(&self) -> Vec<f64> {
        (0..self.freedom())
            .map(|k| dot(self.tangent(k), &self.force))
            .collect()
    }

    /// Rows (of joints and drivers) that take part in what is nearest to a self-stress; `None` if that can't be had.
    pub fn strained_rows(&mut self) -> Vec<usize> {
        let n = self.q.len();
        self.driven.evaluation.set_position(&self.q);
        if self.driven.factor(&self.inputs).is_err() {
            return Vec::new();
        }
        let (mut right, mut left) = (vec![1.0; n], vec![1.0; n]);
        self.driven
            .smallest_singular(STRAIN_ITERATIONS, &mut right, &mut left);
        let largest = max_abs(&left);
        let m = self.driven.system.m();
        let rows = self.driven.active_rows().iter().zip(&left);
        rows.filter(|(row, part)| **row < m && part.abs() > STRAINED * largest)
            .map(|(row, _)| *row)
            .collect()
    }

    /// Goes back to a position that it had.
    ///
    /// # Errors
    /// When its coordinates do not determine the rest there.
    pub fn return_to(&mut self, q: &[f64]) -> Result<(), Failure> {
        self.q.copy_from_slice(q);
        self.settle()
    }

    /// Moves u by `d`, or leaves everything as it is.
    ///
    /// # Errors
    /// Where the position there can't be solved on its branch.
    pub fn advance(&mut self, d: &[f64]) -> Result<(), Failure> {
        let before = self.q.clone();
        let step = self.along(d);
        for (coordinate, d) in self.driven.independent.iter_mut().zip(d) {
            coordinate.jet = [before[coordinate.column] + d, 0.0, 0.0];
        }
        self.q.iter_mut().zip(&step).for_each(|(q, s)| *q += s);
        let placed = self.place();
        if placed.is_err() {
            self.return_to(&before)?;
        }
        placed
    }

    /// Chooses other coordinates where some move more than those at hand; g, K … are by the new ones then.
    ///
    /// # Errors
    /// When the coordinates do not determine the rest.
    pub fn exchange(&mut self) -> Result<(), Failure> {
        for _ in 0..10 * (self.freedom() + 1) {
            let Some((k, column)) = better_coordinate(&self.driven, &self.tangents) else {
                break;
            };
            let mut columns = self.columns();
            columns[k] = column;
            self.driven.choose(&columns, &self.inputs)?;
            self.settle()?;
        }
        Ok(())
    }

    /// Takes the position at hand, moved onto the constraints.
    fn settle(&mut self) -> Result<(), Failure> {
        for coordinate in &mut self.driven.independent {
            coordinate.jet = [self.q[coordinate.column], 0.0, 0.0];
        }
        self.place()
    }

    /// Solves the position from the prediction in `q`, and evaluates Q and S there.
    fn place(&mut self) -> Result<(), Failure> {
        // Rows that are independent at one position need not be so at another.
        self.driven.prepare(&self.q, &self.inputs)?;
        let correction = self.driven.correct(&mut self.q, &self.inputs)?;
        if correction.contraction > CONTRACTION || correction.first_step > FARTHEST {
            return Err(Failure::Diverged {
                residual: correction.residual,
            });
        }
        self.residual = correction.residual;
        self.driven.factor(&self.inputs)?;
        self.rest();
        self.driven
            .evaluation
            .eval_force(self.driven.system, &self.inputs, &mut self.force);
        self.driven.tangents(&mut self.tangents);
        Ok(())
    }

    fn rest(&mut self) {
        let still = vec![0.0; self.q.len()];
        self.driven.evaluation.set_velocity(&still);
    }

    /// K (f × f, by rows) [N/m, N·m …].
    pub fn stiffness(&mut self) -> Vec<f64> {
        let f = self.freedom();
        let mut stiffness = vec![0.0; f * f];
        for j in 0..f {
            let change = self.force_gradient(j);
            for i in 0..f {
                stiffness[i * f + j] = -dot(self.tangent(i), &change);
            }
        }
        for i in 0..f {
            for j in 0..=i {
                let bend = self.bend(i, j);
                stiffness[i * f + j] -= bend;
                if i != j {
                    stiffness[j * f + i] -= bend;
                }
            }
        }
        self.rest();
        stiffness
    }

    /// Q · ∂²q/∂u_i∂u_j by polarisation, for which both rates have the size of their coordinates.
    fn bend(&mut self, i: usize, j: usize) -> f64 {
        let (a, b) = (self.scale(i), self.scale(j));
        if i == j {
            return self.curvature(&[(i, a)]) / (a * a);
        }
        0.25 * (self.curvature(&[(i, a), (j, b)]) - self.curvature(&[(i, a), (j, -b)])) / (a * b)
    }

    /// Q · a at the rates given, ü = 0.
    fn curvature(&mut self, rates: &[(usize, f64)]) -> f64 {
        self.driven
            .independent
            .iter_mut()
            .for_each(|coordinate| coordinate.jet[1] = 0.0);
        for &(k, rate) in rates {
            self.driven.independent[k].jet[1] = rate;
        }
        let mut a = vec![0.0; self.q.len()];
        self.driven.velocity(&self.inputs, &mut a);
        self.driven.acceleration(&self.inputs, &mut a);
        self.driven
            .independent
            .iter_mut()
            .for_each(|coordinate| coordinate.jet[1] = 0.0);
        dot(&self.force, &a)
    }

    /// (∂Q/∂q) S_j (n) at rest.
    fn force_gradient(&self, j: usize) -> Vec<f64> {
        let system = self.driven.system;
        if system.forces.is_empty() {
            return vec![0.0; self.q.len()];
        }
        let scale = self.scale(j);
        let direction: Vec<f64> = self.tangent(j).iter().map(|s| s * scale).collect();
        let mut evaluation = Evaluation::new(system);
        let (mut q, mut force) = (self.q.clone(), self.force.clone());
        let mut at = |h: f64| {
            q.iter_mut()
                .zip(&self.q)
                .zip(&direction)
                .for_each(|((q, here), d)| *q = here + h * d);
            evaluation.set_position(&q);
            evaluation.eval_force(system, &self.inputs, &mut force);
            force.clone()
        };
        let noise = f64::EPSILON * max_abs(&self.force);
        let mut gradient = derivative(noise, |h| {
            let (ahead, behind) = (at(h), at(-h));
            ahead
                .iter()
                .zip(&behind)
                .map(|(a, b)| (a - b) / (2.0 * h))
                .collect()
        });
        gradient.iter_mut().for_each(|g| *g /= scale);
        gradient
    }

    /// C (f × f, by rows), exact at rest.
    pub fn damping(&self) -> Vec<f64> {
        let (f, system) = (self.freedom(), self.driven.system);
        let slopes = Slopes::of(system);
        let mut by_position = vec![0.0; slopes.forces.len()];
        let mut by_velocity = by_position.clone();
        let evaluation = &self.driven.evaluation;
        let at = (system, &self.inputs);
        slopes.eval_forces(evaluation, at, &mut by_position, &mut by_velocity);
        let mut damping = vec![0.0; f * f];
        for (place, slope) in slopes.forces.iter().zip(&by_velocity) {
            let &[Some(row), Some(column)] = place else {
                continue;
            };
            for i in 0..f {
                for j in 0..f {
                    damping[i * f + j] -= self.tangent(i)[row] * slope * self.tangent(j)[column];
                }
            }
        }
        damping
    }

    /// M̂ (f × f, by rows).
    pub fn mass(&self) -> Vec<f64> {
        let f = self.freedom();
        let mass = &self.driven.system.mass;
        let product = |i: usize, j: usize| mass.product(self.tangent(i), self.tangent(j));
        (0..f * f)
            .map(|k| product((k / f).max(k % f), (k / f).min(k % f)))
            .collect()
    }
}

/// Limit h → 0 of a central difference quotient (even in h) of values known to `noise`, by Ridders' extrapolation.
fn derivative(noise: f64, mut quotient: impl FnMut(f64) -> Vec<f64>) -> Vec<f64> {
    let mut h = DIFFERENCE;
    let mut row = vec![quotient(h)];
    let (mut best, mut least) = (row[0].clone(), f64::INFINITY);
    for _ in 0..HALVINGS {
        h *= 0.5;
        let mut next = vec![quotient(h)];
        let mut power = 1.0;
        for k in 0..row.len() {
            power *= 4.0;
            let improved: Vec<f64> = next[k]
                .iter()
                .zip(&row[k])
                .map(|(fine, coarse)| fine + (fine - coarse) / (power - 1.0))
                .collect();
            let apart = |other: &[f64]| {
                max_abs(
                    &improved
                        .iter()
                        .zip(other)
                        .map(|(a, b)| a - b)
                        .collect::<Vec<_>>(),
                )
            };
            let error = apart(&next[k]).max(apart(&row[k])) + noise / h;
            if error <= least {
                least = error;
                best.clone_from(&improved);
            }
            next.push(improved);
        }
        row = next;
    }
    best
}
