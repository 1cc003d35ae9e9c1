//! The march from node to node.

use super::super::driven::{Correction, Driven, Failure};
use super::parameter::{End, Parameter};
use crate::system::Inputs;
use linkdyn_linear::hermite::{Node, osculate, quintic};

/// Newton's second step by its first at most: Kantorovich's constant stays far below ½.
const CONTRACTION: f64 = 0.1;
/// Predicted tangent against the true one, times the step, by the prediction error: for the quintic it is about 6.
const TANGENT: f64 = 100.0;
/// Largest turn of a body (or move, in sizes) in one step: keeps sign tests between nodes meaningful.
const LARGEST_MOVE: f64 = 0.3;
/// A step this much smaller than the largest taken means that the path can't go on.
const SHORTEST_STEP: f64 = 1e-9;
/// Prediction error accepted of the first step, which starts with little and goes nowhere near another branch.
const FIRST_PREDICTION: f64 = 1e-6;
/// Largest growth from step to step, and where three nodes predict: they must not lie too close together for that.
const GROWTH: f64 = 2.0;
const GROWTH_OF_THREE: f64 = 1.5;
/// The first step moves the mechanism by this, in rad or sizes.
const FIRST_MOVE: f64 = 0.02;
/// Where time is the parameter, the way takes at least so many steps.
const LEAST_STEPS: f64 = 20.0;
/// A prediction error of zero counts as this, so that it can be divided by.
const NO_ERROR: f64 = 1e-30;
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
#[derive(Debug, Default)]
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

    /// What the parameter is measured by: 1 rad, the mechanism's length or its time.
    pub(super) fn unit(&self) -> f64 {
        let system = self.driven.system;
        match self.parameter {
            Parameter::DriverValue => system.measure_scale(system.drivers[0].measure),
            Parameter::Coordinate => system.column_scale(self.driven.independent[0].column),
            Parameter::Time => system.scale.time,
        }
    }

    /// Corrects a guess at `s` and differentiates there.
    pub(super) fn node(&mut self, s: f64, mut q: Vec<f64>) -> Result<(Node, Correction), Failure> {
        let correction = self.corrected(s, &mut q)?;
        let n = q.len();
        let (mut d, mut dd) = (vec![0.0; n], vec![0.0; n]);
        self.driven.velocity(&self.inputs, &mut d);
        self.driven.acceleration(&self.inputs, &mut dd);
        if !(d.iter().chain(&dd).all(|x| x.is_finite())) {
            return Err(Failure::Singular);
        }
        Ok((Node { s, q, d, dd }, correction))
    }

    /// The same where a march begins: the independent rows are those of that position, wherever the solver was before.
    ///
    /// # Errors
    /// See [`Failure`].
    pub(super) fn first_node(&mut self, s: f64, q: Vec<f64>) -> Result<Node, Failure> {
        self.set(s);
        self.driven.prepare(&q, &self.inputs)?;
        Ok(self.node(s, q)?.0)
    }

    /// Corrects a guess at `s`, where the factors are then.
    pub(super) fn corrected(&mut self, s: f64, q: &mut [f64]) -> Result<Correction, Failure> {
        self.set(s);
        self.driven.chord = self.parameter.chord();
        let correction = self.driven.correct(q, &self.inputs);
        self.driven.chord = 0.0;
        let correction = correction?;
        self.driven.factor(&self.inputs)?;
        Ok(correction)
    }

    /// Condition at the last factors; the one of a node before is a good start where the rows are the same.
    pub(super) fn condition(&mut self, before: Option<Condition>) -> Condition {
        let n = self.driven.system.n();
        let (iterations, mut right, mut left) = match before {
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
    /// with an independent coordinate, or where it can't be had.
    pub(super) fn self_stress_beside(&mut self, node: &Node) -> Vec<f64> {
        if self.parameter == Parameter::Coordinate {
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
        let mut marks = Vec::new();
        // The factors must be those of the start.
        if self.first_node(start.s, start.q.clone()).is_err() {
            return (marks, End::Stuck { s: start.s });
        }
        let mut march = March::new(self, start, target, direction);
        loop {
            match march.step() {
                MarchStep::Taken(mark) => marks.push(mark),
                MarchStep::Rejected => {}
                MarchStep::Ended(end) => return (marks, end),
            }
        }
    }
}

/// A march on its way.
struct March<'w, 'a, 's> {
    walker: &'w mut Walker<'a, 's>,
    target: f64,
    /// 1 or −1.
    direction: f64,
    /// Length of the way.
    span: f64,
    current: Node,
    /// The nodes before.
    previous: Option<Node>,
    earlier: Option<Node>,
    condition: Condition,
    /// Next step, and the largest taken.
    h: f64,
    largest: f64,
    /// Steps beyond the target.
    beyond: usize,
    /// Predicted q and q′, and room for q″.
    q: Vec<f64>,
    d: Vec<f64>,
    dd: Vec<f64>,
}

/// What became of one step.
enum MarchStep {
    Taken(Mark),
    /// To be tried again, shorter.
    Rejected,
    Ended(End),
}

impl<'w, 'a, 's> March<'w, 'a, 's> {
    /// From `start`, where the factors at hand are.
    fn new(walker: &'w mut Walker<'a, 's>, start: &Node, target: f64, direction: f64) -> Self {
        let condition = walker.condition(None);
        let n = walker.driven.system.n();
        let mut march = March {
            walker,
            target,
            direction,
            span: (target - start.s).abs(),
            current: start.clone(),
            previous: None,
            earlier: None,
            condition,
            h: 0.0,
            largest: 0.0,
            beyond: 0,
            q: vec![0.0; n],
            d: vec![0.0; n],
            dd: vec![0.0; n],
        };
        let speed = march.walker.driven.system.scaled_norm(&start.d);
        march.h = march.cap(&start.d).min(FIRST_MOVE / speed);
        if !march.h.is_finite() || march.h <= 0.0 {
            march.h = (march.span / 100.0).max(f64::MIN_POSITIVE);
        }
        march.largest = march.h;
        march
    }

    /// Longest step where the tangent is `d`.
    fn cap(&self, d: &[f64]) -> f64 {
        let by_move = LARGEST_MOVE / self.walker.driven.system.scaled_norm(d);
        match self.walker.parameter {
            Parameter::DriverValue | Parameter::Coordinate => by_move,
            Parameter::Time => by_move.min(self.span.max(f64::MIN_POSITIVE) / LEAST_STEPS),
        }
    }

    /// One attempt.
    fn step(&mut self) -> MarchStep {
        let covered = (self.current.s - self.target) * self.direction >= 0.0;
        if covered && self.beyond >= BEYOND {
            return MarchStep::Ended(End::Reached);
        }
        if (self.walker.stop)(self.current.s) {
            return MarchStep::Ended(End::Interrupted);
        }
        if self.h < SHORTEST_STEP * self.largest {
            return MarchStep::Ended(self.end_of_path(covered));
        }
        let s = self.current.s + self.direction * self.h;
        self.predict(s);
        let outcome = self.walker.node(s, self.q.clone());
        let accepted = outcome.ok().filter(|(node, correction)| {
            let off = node.d.iter().zip(&self.d).map(|(a, b)| (a - b) * self.h);
            let off: Vec<f64> = off.collect();
            let prediction = self.prediction();
            correction.first_step <= prediction
                && correction.contraction <= CONTRACTION
                && self.walker.driven.system.scaled_norm(&off) <= TANGENT * prediction
        });
        match accepted {
            Some((node, correction)) => self.accept(node, correction, covered),
            None => self.reject(0.5),
        }
    }

    /// Prediction error accepted.
    fn prediction(&self) -> f64 {
        match self.previous {
            Some(_) => self.walker.parameter.prediction(),
            None => FIRST_PREDICTION,
        }
    }

    /// Why no step is small enough.
    fn end_of_path(&mut self, covered: bool) -> End {
        if covered {
            return End::Reached;
        }
        let s = self.current.s;
        let before = self.previous.as_ref();
        match self
            .walker
            .dead_centre(&self.current, before, self.direction)
        {
            Some(s) => End::DeadCentre { s },
            None => End::Stuck { s },
        }
    }

    /// q and q′ at `s` from the nodes behind.
    fn predict(&mut self, s: f64) {
        let current = &self.current;
        match (&self.previous, &self.earlier) {
            (Some(before), Some(earlier)) => {
                let to = [&mut self.q[..], &mut self.d, &mut self.dd];
                osculate([earlier, before, current], s, to);
            }
            (Some(before), None) => quintic(before, current, s, &mut self.q, Some(&mut self.d)),
            (None, _) => {
                let step = s - current.s;
                for k in 0..self.q.len() {
                    self.q[k] = current.q[k] + step * (current.d[k] + 0.5 * step * current.dd[k]);
                    self.d[k] = current.d[k] + step * current.dd[k];
                }
            }
        }
    }

    /// Takes a node that was solved.
    fn accept(&mut self, node: Node, correction: Correction, covered: bool) -> MarchStep {
        let walker = &mut *self.walker;
        walker.steps += 1;
        // Signs under the rows chosen at the node before, then rows chosen anew.
        let before = &self.condition;
        let sign = walker.driven.determinant_sign();
        let test = walker.driven.test_function(&before.right, &before.left);
        let crossing = sign != before.sign || (test < 0.0) != (before.test < 0.0);
        if walker.driven.is_redundant() && walker.driven.reselect(&walker.inputs).is_err() {
            // Rank is lost right here: land elsewhere.
            return self.reject(0.7);
        }
        let start = (!walker.driven.is_redundant()).then(|| std::mem::take(&mut self.condition));
        self.condition = walker.condition(start);
        self.largest = self.largest.max(self.h);
        let (order, growth) = match (&self.previous, &self.earlier) {
            (Some(_), Some(_)) => (9.0, GROWTH_OF_THREE),
            (Some(_), None) => (6.0, GROWTH),
            (None, _) => (3.0, GROWTH),
        };
        let error = correction.first_step.max(NO_ERROR);
        let grow = 0.8 * (self.prediction() / error).powf(1.0 / order);
        self.h = (self.h * grow.clamp(0.3, growth)).min(self.cap(&node.d));
        if covered {
            self.beyond += 1;
        }
        let mark = Mark {
            node: node.clone(),
            crossing,
        };
        let before = self
            .previous
            .replace(std::mem::replace(&mut self.current, node));
        if self.walker.parameter.predictors() > 2 {
            self.earlier = before;
        }
        MarchStep::Taken(mark)
    }

    fn reject(&mut self, shorten: f64) -> MarchStep {
        self.walker.rejected += 1;
        self.h *= shorten;
        MarchStep::Rejected
    }
}
