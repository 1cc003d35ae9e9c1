//! A mechanism at one instant, with some of its drivers let go: what it does under given states and inputs.
//!
//! ```text
//! p = (u, s)                  minimal coordinates, and the values of drivers that are let go                 (f)
//! q = q(p, t)                 by Newton;  v = S ṗ + v_t,  S = ∂q/∂p (n, f)
//! SᵀM S p̈ = Sᵀ(Q + F − M a₀) + (0, τ)         a₀: accelerations with p̈ = 0; τ: efforts of these drivers
//! a = S p̈ + a₀,   Jᵀ λ = Q + F − M a           λ of a driver that is let go is its τ
//! ```
//!
//! A driver has φ = s − (what it measures), so that J ∂q/∂s = −1 in its row. It stays a row: what is free is its value, and what is
//! given is its multiplier. Friction of joints follows λ as in [`super::dependent_forces`].

use super::driven::{Driven, Failure};
use crate::system::{Inputs, System};
use linkdyn_linear::math::dot;
use linkdyn_linear::small::{cholesky, cholesky_solve};

/// A pivot of SᵀMS that loses more than this of its size means freedom without mass.
const MASSLESS: f64 = 1e-13;
/// Part of a self-stress below which it goes through no driver.
const UNDRIVEN: f64 = 1e-9;

/// What is given beside the inputs of the instant.
#[derive(Debug, Clone, Copy)]
pub struct GivenPoint<'a> {
    /// p, u first (f).
    pub positions: &'a [f64],
    /// ṗ (f).
    pub rates: &'a [f64],
    /// Efforts of the drivers that are let go, in their order [N or N·m].
    pub efforts: &'a [f64],
    /// F (n).
    pub force: &'a [f64],
}

/// The mechanism, and what it does at the point of the last evaluation.
pub struct Released<'s> {
    /// Solver of the position; its independent coordinates are u.
    pub driven: Driven<'s>,
    /// What is prescribed: the jets of drivers that are not let go, states, memories, time.
    pub inputs: Inputs,
    /// Drivers that are let go.
    pub free: Vec<usize>,
    /// Whether joints have friction.
    pub rubs: bool,
    /// q, v, a (n), Q + F (n), and what the constraints carry, Q + F − M a (n).
    pub q: Vec<f64>,
    pub v: Vec<f64>,
    pub a: Vec<f64>,
    pub force: Vec<f64>,
    pub balance: Vec<f64>,
    /// λ (m).
    pub lambda: Vec<f64>,
    /// p̈ (f).
    pub accelerations: Vec<f64>,
    /// S (f × n).
    tangents: Vec<f64>,
    /// SᵀMS and its factor (f × f).
    mass: Vec<f64>,
    /// The position from which others are found, with p and S there.
    from: Vec<f64>,
    at: Vec<f64>,
    along: Vec<f64>,
}

impl<'s> Released<'s> {
    /// At a position that closes, where `columns` and all drivers determine it.
    ///
    /// # Errors
    /// When they do not.
    pub fn new(
        system: &'s System,
        columns: &[usize],
        (q, inputs): (&[f64], Inputs),
        (free, rubs): (Vec<usize>, bool),
    ) -> Result<Self, Failure> {
        let driven = Driven::with_independent(system, columns, q, &inputs)?;
        let (n, f) = (system.n(), columns.len() + free.len());
        let values = columns.iter().map(|column| q[*column]);
        let at = values.chain(free.iter().map(|driver| inputs.drive[*driver][0]));
        let mut released = Released {
            driven,
            at: at.collect(),
            inputs,
            free,
            rubs: rubs && !system.dependent_forces.is_empty(),
            q: q.to_vec(),
            v: vec![0.0; n],
            a: vec![0.0; n],
            force: vec![0.0; n],
            balance: vec![0.0; n],
            lambda: vec![0.0; system.m()],
            accelerations: vec![0.0; f],
            tangents: vec![0.0; f * n],
            mass: vec![0.0; f * f],
            from: q.to_vec(),
            along: vec![0.0; f * n],
        };
        released.driven.factor(&released.inputs)?;
        released.eval_tangents();
        released.along.clone_from(&released.tangents);
        Ok(released)
    }

    /// Degrees of freedom f.
    pub fn freedom(&self) -> usize {
        self.accelerations.len()
    }

    /// p at the beginning (f).
    pub fn start(&self) -> &[f64] {
        &self.at
    }

    /// The first driver that shares the work with other rows: its value can't change alone.
    pub fn sharing(&mut self, drivers: &[usize]) -> Option<usize> {
        let first = self.driven.system.joint_rows();
        let stresses = self.driven.self_stress();
        let shares = |driver: &&usize| {
            let mut parts = stresses.iter().map(|stress| stress[first + **driver].abs());
            parts.any(|part| part > UNDRIVEN)
        };
        drivers.iter().find(shares).copied()
    }

    /// Efforts of all drivers at the point of the last evaluation.
    pub fn efforts(&self) -> &[f64] {
        &self.lambda[self.driven.system.driver_rows()]
    }

    /// Sᵀ of a force at the point of the last evaluation (f).
    pub fn pull(&self, force: &[f64]) -> Vec<f64> {
        let tangents = self.tangents.chunks_exact(self.q.len().max(1));
        tangents.map(|tangent| dot(tangent, force)).collect()
    }

    /// Everything at one point.
    ///
    /// # Errors
    /// Where there is no such position, friction locks, or what is free has no mass.
    pub fn evaluate(&mut self, given: &GivenPoint) -> Result<(), Failure> {
        self.place(given)?;
        let system = self.driven.system;
        let (driven, inputs) = (&mut self.driven, &self.inputs);
        driven.velocity(inputs, &mut self.v);
        driven
            .evaluation
            .eval_force(system, inputs, &mut self.force);
        let forces = self.force.iter_mut().zip(given.force);
        forces.for_each(|(own, more)| *own += more);
        driven.acceleration(inputs, &mut self.a);
        self.eval_tangents();
        self.accelerate(given.efforts)?;
        self.react()
    }

    /// q and the factors there, with rates given.
    fn place(&mut self, given: &GivenPoint) -> Result<(), Failure> {
        let own = self.driven.independent.len();
        let jets = given.positions.iter().zip(given.rates);
        for (k, (value, rate)) in jets.enumerate() {
            let jet = [*value, *rate, 0.0];
            match k.checked_sub(own) {
                None => self.driven.independent[k].jet = jet,
                Some(driver) => self.inputs.drive[self.free[driver]] = jet,
            }
        }
        self.q.copy_from_slice(&self.from);
        let moved = given.positions.iter().zip(&self.at).map(|(to, at)| to - at);
        let along = self.along.chunks_exact(self.q.len().max(1));
        for (by, tangent) in moved.zip(along) {
            let q = self.q.iter_mut().zip(tangent);
            q.for_each(|(q, s)| *q += by * s);
        }
        self.driven.prepare(&self.q, &self.inputs)?;
        self.driven.correct(&mut self.q, &self.inputs)?;
        self.driven.factor(&self.inputs)
    }

    /// S at the last factors.
    fn eval_tangents(&mut self) {
        let (n, own) = (self.q.len(), self.driven.independent.len());
        let (of_coordinates, of_drivers) = self.tangents.split_at_mut(own * n);
        self.driven.tangents(of_coordinates);
        let system = self.driven.system;
        let mut rows = vec![0.0; system.m()];
        for (driver, tangent) in self.free.iter().zip(of_drivers.chunks_exact_mut(n.max(1))) {
            let row = system.joint_rows() + driver;
            rows[row] = -1.0;
            self.driven.answer(&rows, tangent);
            rows[row] = 0.0;
        }
    }

    /// p̈, a and λ without friction.
    fn accelerate(&mut self, efforts: &[f64]) -> Result<(), Failure> {
        let (system, n) = (self.driven.system, self.q.len());
        let (f, own) = (self.freedom(), self.driven.independent.len());
        system
            .mass
            .residual(&self.force, &self.a, &mut self.balance);
        let mut p = self.pull(&self.balance);
        let let_go = p[own..].iter_mut().zip(efforts);
        let_go.for_each(|(pull, effort)| *pull += effort);
        let tangent = |k: usize| &self.tangents[k * n..(k + 1) * n];
        for i in 0..f {
            for j in 0..=i {
                self.mass[i * f + j] = system.mass.product(tangent(i), tangent(j));
            }
        }
        if !cholesky(&mut self.mass, f, MASSLESS) {
            return Err(Failure::Singular);
        }
        cholesky_solve(&self.mass, &mut p);
        self.accelerations.copy_from_slice(&p);
        self.finish();
        Ok(())
    }

    /// a and λ of p̈, from the a₀ that `a` has.
    fn finish(&mut self) {
        let (system, n) = (self.driven.system, self.q.len());
        let along = self
            .accelerations
            .iter()
            .zip(self.tangents.chunks_exact(n.max(1)));
        for (rate, tangent) in along {
            let a = self.a.iter_mut().zip(tangent);
            a.for_each(|(a, s)| *a += rate * s);
        }
        system
            .mass
            .residual(&self.force, &self.a, &mut self.balance);
        self.driven.multipliers(&self.balance, &mut self.lambda);
    }

    /// Adds the friction of joints.
    fn react(&mut self) -> Result<(), Failure> {
        if !self.rubs {
            return Ok(());
        }
        let (system, n) = (self.driven.system, self.q.len());
        let mut dependent = std::mem::take(&mut self.driven.dependent_forces);
        dependent.eval_units(system, &self.driven.evaluation, &self.inputs);
        for ((unit, response), change) in dependent.units_responses_and_changes() {
            let mut rates = self.pull(unit);
            cholesky_solve(&self.mass, &mut rates);
            change.fill(0.0);
            for (rate, tangent) in rates.iter().zip(self.tangents.chunks_exact(n.max(1))) {
                let change = change.iter_mut().zip(tangent);
                change.for_each(|(change, s)| *change += rate * s);
            }
            self.driven
                .multipliers_of(|room| system.mass.residual(unit, change, room), response);
        }
        let solved = dependent.solve(system, &self.driven.evaluation, &self.inputs, &self.lambda);
        if solved.is_ok() {
            let mut pull = vec![0.0; n];
            dependent.add_forces(&mut pull);
            let mut more = self.pull(&pull);
            cholesky_solve(&self.mass, &mut more);
            let force = self.force.iter_mut().zip(&pull);
            force.for_each(|(own, more)| *own += more);
            let before = std::mem::replace(&mut self.accelerations, more);
            self.driven.dependent_forces = dependent;
            self.finish();
            let all = self.accelerations.iter_mut().zip(before);
            all.for_each(|(own, before)| *own += before);
            return Ok(());
        }
        self.driven.dependent_forces = dependent;
        solved
    }
}
