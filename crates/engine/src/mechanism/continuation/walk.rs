//! The march from node to node.

use super::super::driven::{Correction, Driven, Failure};
use super::{End, Parameter};
use crate::system::Inputs;
use linkdyn_linear::hermite::{Node, quintic};

/// Newton's second step by its first at most: Kantorovich's constant stays far below ½.
const CONTRACTION: f64 = 0.1;
/// Predicted tangent against the true one, times the step, by the prediction error: for the quintic it is about 6.
const TANGENT: f64 = 100.0;
/// Largest turn of a body (or move, in sizes) in one step: keeps sign tests between nodes meaningful.
const LARGEST_MOVE: f64 = 0.3;
/// A step this much smaller than the largest taken means that the path can't go on.
const SHORTEST_STEP: f64 = 1e-9;
/// Steps taken beyond the range, to see a singular position that lies just outside.
const BEYOND: usize = 3;
/// Inverse iterations for null vectors from nothing: they are wanted to a few percent.
const FIRST_ITERATIONS: usize = 3;

/// A step of the march with the signs that tell singular positions.
pub(super) struct Mark {
    pub(super) node: Node,
    /// A singular position lies between this node and the one before.
    pub(super) crossing: bool,
}

pub(super) struct Walker<'a, 's> {
    pub(super) driven: &'a mut Driven<'s>,
    pub(super) inputs: Inputs,
    pub(super) parameter: Parameter,
    pub(super) stop: &'a dyn Fn(f64) -> bool,
    pub(super) steps: u64,
    pub(super) rejected: u64,
}

/// Sign of the determinant and null vectors at a node, for the independent rows chosen there.
pub(super) struct Condition {
    pub(super) sign: f64,
    pub(super) right: Vec<f64>,
    pub(super) left: Vec<f64>,
    pub(super) test: f64,
}

impl Walker<'_, '_> {
    pub(super) fn set(&mut self, s: f64) {
        self.parameter.set(self.driven, s, &mut self.inputs);
    }

    /// Corrects a guess at `s` and differentiates there.
    pub(super) fn node(&mut self, s: f64, mut q: Vec<f64>) -> Result<(Node, Correction), Failure> {
        self.set(s);
        let correction = self.driven.correct(&mut q, &self.inputs)?;
        self.driven.factor(&self.inputs)?;
        let n = q.len();
        let (mut d, mut dd) = (vec![0.0; n], vec![0.0; n]);
        self.driven.velocity(&self.inputs, &mut d);
        self.driven.acceleration(&self.inputs, &mut dd);
        if !(d.iter().chain(&dd).all(|x| x.is_finite())) {
            return Err(Failure::Singular);
        }
        Ok((Node { s, q, d, dd }, correction))
    }

    /// Condition at the last factors; the one of the node before is a good start where the rows are the same.
    pub(super) fn condition(&mut self, before: Option<Condition>) -> Condition {
        let n = self.driven.system.n();
        let (iterations, mut right, mut left) = match before.filter(|_| !self.driven.is_redundant())
        {
            Some(before) => (1, before.right, before.left),
            None => (FIRST_ITERATIONS, vec![1.0; n], vec![1.0; n]),
        };
        self.driven
            .smallest_singular(iterations, &mut right, &mut left);
        let test = self.driven.test_function(&right, &left);
        Condition {
            sign: self.driven.determinant_sign(),
            right,
            left,
            test,
        }
    }

    /// The self-stress (m) of the dead centre that a node lies beside, by a solver of its own, so that it moves nothing; empty
    /// with a pin, or where it can't be had.
    pub(super) fn self_stress_beside(&mut self, node: &Node) -> Vec<f64> {
        if self.parameter == Parameter::Pin {
            return Vec::new();
        }
        self.set(node.s);
        let system = self.driven.system;
        let Ok(mut driven) = Driven::new(system, &node.q, &self.inputs) else {
            return Vec::new();
        };
        let (mut right, mut left) = (vec![1.0; system.n()], vec![1.0; system.n()]);
        driven.smallest_singular(FIRST_ITERATIONS, &mut right, &mut left);
        let mut self_stress = vec![0.0; system.m()];
        for (value, &row) in left.iter().zip(driven.active_rows()) {
            self_stress[row] = *value;
        }
        self_stress
    }

    /// Steps from `start` to `target` and a little beyond.
    pub(super) fn march(&mut self, start: &Node, target: f64, direction: f64) -> (Vec<Mark>, End) {
        let system = self.driven.system;
        let parameter = self.parameter;
        let prediction = parameter.prediction();
        let mut marks: Vec<Mark> = Vec::new();
        let mut current = start.clone();
        let mut previous: Option<Node> = None;
        // The factors must be those of the start.
        if self.node(start.s, start.q.clone()).is_err() {
            return (marks, End::Stuck { s: start.s });
        }
        let mut condition = self.condition(None);
        let speed = system.scaled_norm(&start.d);
        let span = (target - start.s).abs();
        let cap = |d: &[f64]| {
            let by_move = LARGEST_MOVE / system.scaled_norm(d);
            match parameter {
                Parameter::DriverValue | Parameter::Pin => by_move,
                Parameter::Time => by_move.min(span.max(f64::MIN_POSITIVE) / 20.0),
            }
        };
        let mut h = cap(&start.d).min(0.02 / speed);
        if !h.is_finite() || h <= 0.0 {
            h = (span / 100.0).max(f64::MIN_POSITIVE);
        }
        let mut largest = h;
        let mut beyond = 0;
        let mut q = vec![0.0; system.n()];
        let mut d = vec![0.0; system.n()];
        loop {
            let covered = (current.s - target) * direction >= 0.0;
            if covered && beyond >= BEYOND {
                return (marks, End::Reached);
            }
            if (self.stop)(current.s) {
                return (marks, End::Interrupted);
            }
            if h < SHORTEST_STEP * largest {
                if covered {
                    return (marks, End::Reached);
                }
                let end = self.dead_centre(&current, previous.as_ref(), direction);
                return (
                    marks,
                    end.map_or(End::Stuck { s: current.s }, |s| End::DeadCentre { s }),
                );
            }
            let s = current.s + direction * h;
            match &previous {
                Some(before) => quintic(before, &current, s, &mut q, Some(&mut d)),
                None => {
                    let step = s - current.s;
                    for k in 0..q.len() {
                        q[k] = current.q[k] + step * (current.d[k] + 0.5 * step * current.dd[k]);
                        d[k] = current.d[k] + step * current.dd[k];
                    }
                }
            }
            let outcome = self.node(s, q.clone());
            let accepted = outcome.ok().filter(|(node, correction)| {
                let off: Vec<f64> = node.d.iter().zip(&d).map(|(a, b)| (a - b) * h).collect();
                correction.first_step <= prediction
                    && correction.contraction <= CONTRACTION
                    && system.scaled_norm(&off) <= TANGENT * prediction
            });
            let Some((node, correction)) = accepted else {
                self.rejected += 1;
                h *= 0.5;
                continue;
            };
            self.steps += 1;
            // Signs under the rows chosen at the node before, then rows chosen anew.
            let sign = self.driven.determinant_sign();
            let test = self.driven.test_function(&condition.right, &condition.left);
            let crossing = sign != condition.sign || (test < 0.0) != (condition.test < 0.0);
            if self.driven.is_redundant() && self.driven.reselect(&self.inputs).is_err() {
                // Rank is lost right here: land elsewhere.
                self.rejected += 1;
                h *= 0.7;
                continue;
            }
            condition = self.condition(Some(condition));
            largest = largest.max(h);
            let order = if previous.is_some() { 6.0 } else { 3.0 };
            let grow = 0.8 * (prediction / correction.first_step.max(1e-30)).powf(1.0 / order);
            h = (h * grow.clamp(0.3, 2.0)).min(cap(&node.d));
            if covered {
                beyond += 1;
            }
            marks.push(Mark {
                node: node.clone(),
                crossing,
            });
            previous = Some(std::mem::replace(&mut current, node));
        }
    }
}
