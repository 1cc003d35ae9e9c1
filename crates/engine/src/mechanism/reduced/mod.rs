//! Equations of motion in minimal coordinates, by partitioning (Wehage and Haug 1982).
//!
//! f coordinates u of the mechanism are chosen as independent (its pins); at every point they determine the others through
//! the constraints, so that positions and velocities never drift:
//!
//! ```text
//! q = q(u, t)                   by Newton, branch-safe from the path so far
//! v = S u̇ + v_t                 S = ∂q/∂u (n, f)
//! a = S ü + a₀                  a₀: accelerations with ü = 0
//! SᵀM S ü = Sᵀ (Q − M a₀)       the pins' efforts vanish
//! ```
//!
//! With one degree of freedom and drivers at rest the positions are a curve q(u), which the continuation follows once:
//! then predictions come from it, and near a change point, where round-off of the equations grows as 1/δ³, so do S and
//! S′ = ∂²q/∂u² (a₀ = S′ u̇²), from its smooth branch. Closed curves (a coordinate that turns round and round) are followed
//! once around.
//!
//! Multipliers are worked out only where they are wanted: for results, and where forces depend on them
//! (`dependent_forces`), which then become part of Q. Bodies may lack mass as long as SᵀMS is regular. The choice of u
//! is kept while it is good and changed between steps when another coordinate moves more.

mod curve;
mod evaluate;
mod mass;

use super::continuation::{Path, SingularKind};
use super::driven::{Driven, Failure};
use super::parts::{Part, Parts};
use super::phases::Phases;
use super::pins::better_pin;
use crate::system::{Inputs, System};
use linkdyn_linear::hermite::Node;

/// A mechanism with freedom left.
pub struct Reduced<'s> {
    /// Solver of the dependent coordinates.
    pub driven: Driven<'s>,
    /// What is prescribed, and what contacts remember.
    pub inputs: Inputs,
    /// Position of the last evaluation (n).
    pub q: Vec<f64>,
    /// Its velocity (n).
    pub v: Vec<f64>,
    /// Its acceleration (n).
    pub a: Vec<f64>,
    /// Q (n) and Q − M a (n).
    pub force: Vec<f64>,
    /// Q − M a (n).
    pub balance: Vec<f64>,
    /// Factors whose position is this far from the solution are taken for those of the solution [rad or sizes].
    pub lag: f64,
    /// S, one motion after the other (f × n).
    motions: Vec<f64>,
    /// SᵀMS (f × f) and its factor; Sᵀ(Q − M a₀) and ü (f).
    mass: Vec<f64>,
    rhs: Vec<f64>,
    /// M S of one motion, where it is not zero: column and value.
    momenta: Vec<(usize, f64)>,
    /// The last accepted points, and S at the later one.
    here: Node,
    before: Option<Node>,
    here_motions: Vec<f64>,
    /// Where q, v, a are.
    at: Option<f64>,
    /// Positions over the pin, where there is one pin and nothing else moves.
    curve: Option<Path>,
    /// Drivers are at rest, so that all motion is that of the pins.
    still: bool,
    /// S and S′ of the curve at the point at hand (n).
    tangent: Vec<f64>,
    bend: Vec<f64>,
    /// The point at hand is on a bridged stretch, where the equations have no trustworthy factors.
    bridged: bool,
    /// Parts that have curves of their own, where the whole has none.
    parts: Option<Parts<'s>>,
    /// When a step first passed a change point with forces that depend on multipliers, which have no bound there.
    passed: Option<f64>,
}

impl<'s> Reduced<'s> {
    /// At an assembled state; `columns` are coordinates that determine the rest there.
    ///
    /// # Errors
    /// When they do not.
    pub fn new(
        system: &'s System,
        columns: &[usize],
        q: &[f64],
        v: &[f64],
        time: f64,
    ) -> Result<Self, Failure> {
        let inputs = Inputs::at_time(system, time);
        let driven = Driven::pinned(system, columns, q, &inputs)?;
        let (n, f) = (system.n(), columns.len());
        let zero = vec![0.0; n];
        let here = Node {
            s: time,
            q: q.to_vec(),
            d: v.to_vec(),
            dd: zero.clone(),
        };
        let mut reduced = Reduced {
            driven,
            inputs,
            q: q.to_vec(),
            v: v.to_vec(),
            a: zero.clone(),
            force: zero.clone(),
            balance: zero,
            lag: 0.0,
            motions: vec![0.0; f * n],
            mass: vec![0.0; f * f],
            rhs: vec![0.0; f],
            momenta: Vec::with_capacity(n),
            here,
            before: None,
            here_motions: vec![0.0; f * n],
            at: None,
            curve: None,
            still: system.drivers.iter().all(|driver| driver.law.is_constant()),
            tangent: vec![0.0; n],
            bend: vec![0.0; n],
            bridged: false,
            parts: None,
            passed: None,
        };
        reduced.choose(time)?;
        Ok(reduced)
    }

    /// Whether the positions are a curve of one coordinate.
    pub fn has_curve(&self) -> bool {
        self.still && self.freedom() == 1
    }

    /// Takes the change points of these parts by their smooth branches.
    pub fn cross(&mut self, parts: &'s [Part], phases: &'s Phases<'s>) {
        self.parts = (!parts.is_empty()).then(|| Parts::new(parts, phases));
    }

    /// Takes over the parts of the mechanism with other contacts as constraints, those of `sustained`.
    pub fn cross_as(&mut self, other: &mut Reduced<'s>, sustained: &[bool]) {
        let parts = other.parts.take();
        self.parts = parts.map(|parts| parts.with_sustained(sustained));
    }

    /// The solver of the mechanism's own equations.
    pub fn own(&mut self) -> &mut Driven<'s> {
        match self.parts.as_mut().and_then(Parts::own) {
            Some(own) => own,
            None => &mut self.driven,
        }
    }

    /// Degrees of freedom f.
    pub fn freedom(&self) -> usize {
        self.driven.pins.len()
    }

    /// Exchanges pins until none moves less than half as much as another coordinate that it determines.
    fn choose(&mut self, time: f64) -> Result<(), Failure> {
        let system = self.driven.system;
        self.curve = None;
        self.inputs.set_time(system, time);
        self.driven.evaluation.set_position(&self.q);
        self.driven.factor(&self.inputs)?;
        self.eval_motions();
        for _ in 0..10 * (self.freedom() + 1) {
            let Some((k, column)) = better_pin(&self.driven, &self.motions) else {
                break;
            };
            let mut columns: Vec<usize> = self.driven.pins.iter().map(|pin| pin.column).collect();
            columns[k] = column;
            self.driven.pin(&columns, &self.inputs)?;
            self.eval_motions();
        }
        let mut state = vec![0.0; 2 * self.freedom()];
        self.state(&mut state);
        self.evaluate(time, &state)?;
        self.keep(time);
        Ok(())
    }

    /// Chooses other pins at the last accepted point where that is better; true if it was done, and the state vector is
    /// another one then.
    ///
    /// # Errors
    /// When the coordinates do not determine the rest any more.
    pub fn repin(&mut self) -> Result<bool, Failure> {
        if better_pin(&self.driven, &self.here_motions).is_none() {
            return Ok(false);
        }
        self.q.copy_from_slice(&self.here.q);
        self.v.copy_from_slice(&self.here.d);
        let before = self.before.take();
        self.choose(self.here.s)?;
        self.before = before;
        Ok(true)
    }

    /// (u, u̇) of the position and velocity at hand.
    pub fn state(&self, y: &mut [f64]) {
        let f = self.freedom();
        for (k, pin) in self.driven.pins.iter().enumerate() {
            y[k] = self.q[pin.column];
            y[f + k] = self.v[pin.column];
        }
    }

    fn eval_motions(&mut self) {
        let n = self.driven.system.n();
        for k in 0..self.freedom() {
            self.driven
                .pin_motion(k, &mut self.motions[k * n..(k + 1) * n]);
        }
    }

    /// S of the last evaluation, one motion after the other (f × n).
    pub fn motions(&self) -> &[f64] {
        &self.motions
    }

    /// Rows (of joints and drivers) that take the largest part in what is nearest to a self-stress at the last accepted
    /// point; none where even that can't be factored.
    pub fn strained_rows(&mut self) -> Vec<usize> {
        let system = self.driven.system;
        self.driven.evaluation.set_position(&self.here.q);
        if self.driven.factor(&self.inputs).is_err() {
            return Vec::new();
        }
        let n = system.n();
        let (mut right, mut left) = (vec![1.0; n], vec![1.0; n]);
        self.driven
            .smallest_singular(STRAIN_ITERATIONS, &mut right, &mut left);
        let largest = linkdyn_linear::math::max_abs(&left);
        let rows = self.driven.active_rows().iter().zip(&left);
        rows.filter(|(row, part)| **row < system.m() && part.abs() > STRAINED * largest)
            .map(|(row, _)| *row)
            .collect()
    }

    /// ü of the last evaluation.
    pub fn accelerations(&self) -> &[f64] {
        &self.rhs
    }

    /// Impulses of the constraints (m) that go with an impulse P and the change of the velocities that it brings about.
    pub fn impulsive_multipliers(&mut self, impulse: &[f64], change: &[f64], lambda: &mut [f64]) {
        let mass = &self.driven.system.mass;
        mass.residual(impulse, change, &mut self.balance);
        self.driven.multipliers(&self.balance, lambda);
    }

    /// Multipliers λ (m) of the last evaluation; Q − M a is left in `balance`.
    ///
    /// Where a part's smooth branch stands for its joints, theirs mean nothing; see [`Reduced::reactions`]. Near a change
    /// point of the whole, where they can't be computed, they are NaN.
    pub fn multipliers(&mut self, lambda: &mut [f64]) {
        if self.bridged {
            let ready = self.driven.prepare(&self.q, &self.inputs).is_ok()
                && self.driven.factor(&self.inputs).is_ok();
            if !ready {
                lambda.fill(f64::NAN);
                return;
            }
        }
        self.eval_balance();
        self.driven.multipliers(&self.balance, lambda);
    }

    /// The same for all joints; near a change point of a part, where they can't be computed, they are NaN.
    pub fn reactions(&mut self, lambda: &mut [f64]) {
        self.eval_balance();
        let Some(own) = self.parts.as_mut().and_then(Parts::own) else {
            return self.multipliers(lambda);
        };
        own.evaluation.set_position(&self.q);
        if own.factor(&self.inputs).is_err() {
            lambda.fill(f64::NAN);
            return;
        }
        own.multipliers(&self.balance, lambda);
    }

    /// Q − M a.
    fn eval_balance(&mut self) {
        let mass = &self.driven.system.mass;
        mass.residual(&self.force, &self.a, &mut self.balance);
    }

    /// (t, (u, u̇)) is the end of an accepted step: it serves for predictions from now on.
    pub fn accept(&mut self, time: f64, y: &[f64]) {
        // First-same-as-last methods have just been there.
        let f = self.freedom();
        let there = self.at == Some(time)
            && self
                .driven
                .pins
                .iter()
                .enumerate()
                .all(|(k, pin)| pin.jet[0] == y[k] && pin.jet[1] == y[f + k]);
        if there || self.evaluate(time, y).is_ok() {
            self.keep(time);
        }
    }

    /// When a step first passed a change point with forces that depend on multipliers.
    pub fn passed_change_point(&self) -> Option<f64> {
        self.passed
    }

    fn keep(&mut self, time: f64) {
        if self.passed.is_none()
            && !self.driven.system.dependent_forces.is_empty()
            && let Some(curve) = &self.curve
        {
            let column = self.driven.pins[0].column;
            let (from, to) = (self.here.q[column], self.q[column]);
            let between = curve.singular_between(from.min(to), from.max(to));
            self.passed = between
                .iter()
                .any(|position| position.kind == SingularKind::ChangePoint)
                .then_some(time);
        }
        if self.here.s != time {
            let before = self.before.get_or_insert_with(|| self.here.clone());
            std::mem::swap(before, &mut self.here);
        }
        self.here.s = time;
        self.here.q.copy_from_slice(&self.q);
        self.here.d.copy_from_slice(&self.v);
        self.here.dd.copy_from_slice(&self.a);
        self.here_motions.copy_from_slice(&self.motions);
        if !self.bridged && self.driven.is_redundant() {
            // Where that fails, the next evaluation chooses rows anew.
            let _ = self.driven.exchange_rows();
        }
    }
}

/// Part, relative to the largest, from which a row belongs to a near self-stress.
const STRAINED: f64 = 0.1;
/// Inverse iterations for that self-stress: near a singular position one is enough, three are safe.
const STRAIN_ITERATIONS: usize = 3;
