//! How a driven mechanism changes at an instant, with a parameter or with time.
//!
//! The equations of the instant, with q the position, v, a and λ what follows from it, are differentiated along their solution
//! (the implicit function theorem; Haug and Arora, Applied Optimal Design, 1979):
//!
//! ```text
//! φ(q; p) = 0               J q_p = −∂φ
//! J v + φ_t = 0             J v_p = −∂(J v + φ_t)         ∂ along p and q_p at v held
//! J a − γ = 0               J a_p = −∂(J a − γ)           along p, q_p, v_p at a held
//! M a + Jᵀ λ − Q = 0        Jᵀ λ_p = −∂(M a + Jᵀ λ − Q)   along p, q_p, v_p, a_p at λ held
//! column                    ∂ along all of them
//! ```
//!
//! one back substitution each, with the factors of the instant. Nothing is iterated in ∂, so that its places give it to
//! round-off (`stencil`); a parameter may stand in points, masses, springs, loads and motions at once. Time is a parameter
//! with q_t = v and v_t = a.

use super::around::Around;
use super::stencil::{PLACES, STEP, Sums};
use crate::analysis::channels::Channels;
use crate::analysis::sample::Sample;
use crate::mechanism::driven::Driven;
use crate::system::{Evaluation, Inputs, System};

/// Along what.
pub enum Along<'a> {
    /// A parameter.
    Parameter(&'a Around),
    /// Time, in steps \[s\].
    Time(f64),
}

/// How much of an instant is wanted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Depth {
    /// Positions.
    Positions,
    /// Velocities and accelerations, too.
    Motion,
    /// Multipliers, too.
    Forces,
}

/// The columns that are wanted: channels, and the place of each want in their row.
#[derive(Clone, Copy)]
pub struct Wanted<'a> {
    pub channels: &'a Channels,
    pub places: &'a [usize],
    pub depth: Depth,
}

/// Room for it.
pub struct Slopes {
    evaluation: Evaluation,
    inputs: Inputs,
    sample: Sample,
    /// q_p, v_p, a_p (n), λ_p (m).
    position: Vec<f64>,
    velocity: Vec<f64>,
    acceleration: Vec<f64>,
    lambda: Vec<f64>,
    rows: Sums,
    forces: Sums,
    columns: Sums,
    /// (m), (m), (n).
    product: Vec<f64>,
    other: Vec<f64>,
    pull: Vec<f64>,
    row: Vec<f64>,
    picked: Vec<f64>,
}

/// The mechanism and the time at a place.
fn neighbour<'s>(along: &Along<'s>, system: &'s System, index: usize) -> (&'s System, f64, f64) {
    let place = PLACES[index];
    match along {
        Along::Parameter(around) => (&around.systems[index], place * around.step, 0.0),
        Along::Time(step) => (system, place * step, place * step),
    }
}

impl Along<'_> {
    fn step(&self) -> f64 {
        match self {
            Along::Parameter(around) => around.step,
            Along::Time(step) => *step,
        }
    }
}

impl Slopes {
    /// Of mechanisms like this one, and so many columns.
    pub fn new(system: &System, columns: usize) -> Self {
        let (n, m) = (system.n(), system.m());
        Slopes {
            evaluation: Evaluation::new(system),
            inputs: Inputs::still(system),
            sample: Sample::new(system),
            position: vec![0.0; n],
            velocity: vec![0.0; n],
            acceleration: vec![0.0; n],
            lambda: vec![0.0; m],
            rows: Sums::new(m),
            forces: Sums::new(n),
            columns: Sums::new(columns),
            product: vec![0.0; m],
            other: vec![0.0; m],
            pull: vec![0.0; n],
            row: Vec::new(),
            picked: Vec::new(),
        }
    }

    /// A step in time \[s\] over which the mechanism moves by a small part of its size.
    pub fn time_step(system: &System, sample: &Sample) -> f64 {
        let speed = system.scaled_norm(&sample.v);
        let change = system.scaled_norm(&sample.a).sqrt();
        STEP / speed.max(change).max(1e-9)
    }

    /// Derivatives of the wanted columns at an instant, with its factors in `driven`; NaN of one that is not smooth there. None
    /// where the equations are not, or are not differentiated: with forces that depend on multipliers.
    pub fn along(
        &mut self,
        driven: &mut Driven,
        (inputs, sample): (&Inputs, &Sample),
        along: &Along,
        wanted: Wanted,
    ) -> Option<Vec<f64>> {
        let system = driven.system;
        self.inputs.time = inputs.time;
        if driven.is_redundant() || !system.contacts.is_empty() {
            return None;
        }
        self.positions(driven, sample, along)?;
        if wanted.depth > Depth::Positions {
            self.velocities(driven, sample, along)?;
            self.accelerations(driven, sample, along)?;
        }
        if wanted.depth == Depth::Forces {
            if !system.dependent_forces.is_empty() {
                return None;
            }
            self.multipliers(driven, sample, along)?;
        }
        Some(self.read(system, sample, (inputs.time, along), wanted))
    }

    /// Takes the inputs of a place.
    fn enter<'s>(
        &mut self,
        system: &'s System,
        (along, time): (&Along<'s>, f64),
        index: usize,
    ) -> (&'s System, f64) {
        let (near, by, later) = neighbour(along, system, index);
        self.inputs.set_time(near, time + later);
        (near, by)
    }

    fn positions(&mut self, driven: &mut Driven, sample: &Sample, along: &Along) -> Option<()> {
        let system = driven.system;
        if let Along::Time(_) = along {
            self.position.copy_from_slice(&sample.v);
            return Some(());
        }
        let time = self.inputs.time;
        self.rows.begin(along.step());
        self.evaluation.set_position(&sample.q);
        for (index, place) in PLACES.into_iter().enumerate() {
            let (near, _) = self.enter(system, (along, time), index);
            self.evaluation.eval_phi(near, &self.inputs);
            self.rows.take(place, &self.evaluation.phi);
        }
        self.solve(driven, time, 1.0, |own| &mut own.position)
    }

    fn velocities(&mut self, driven: &mut Driven, sample: &Sample, along: &Along) -> Option<()> {
        let system = driven.system;
        if let Along::Time(_) = along {
            self.velocity.copy_from_slice(&sample.a);
            return Some(());
        }
        let time = self.inputs.time;
        self.rows.begin(along.step());
        for (index, place) in PLACES.into_iter().enumerate() {
            let (near, by) = self.enter(system, (along, time), index);
            moved(&mut self.sample.q, &sample.q, &self.position, by);
            self.evaluation.set_position(&self.sample.q);
            self.evaluation.eval_jacobian(near, &self.inputs);
            self.evaluation.product(near, &sample.v, &mut self.product);
            self.evaluation
                .eval_rate(near, &self.inputs, &mut self.other);
            add(&mut self.product, &self.other, 1.0);
            self.rows.take(place, &self.product);
        }
        let speed = system.scaled_norm(&sample.v);
        self.solve(driven, time, speed, |own| &mut own.velocity)
    }

    fn accelerations(&mut self, driven: &mut Driven, sample: &Sample, along: &Along) -> Option<()> {
        let system = driven.system;
        let time = self.inputs.time;
        self.rows.begin(along.step());
        for (index, place) in PLACES.into_iter().enumerate() {
            let (near, by) = self.enter(system, (along, time), index);
            moved(&mut self.sample.q, &sample.q, &self.position, by);
            moved(&mut self.sample.v, &sample.v, &self.velocity, by);
            self.evaluation.set_position(&self.sample.q);
            self.evaluation.set_velocity(&self.sample.v);
            self.evaluation.eval_jacobian(near, &self.inputs);
            self.evaluation.product(near, &sample.a, &mut self.product);
            self.evaluation
                .eval_gamma(near, &self.inputs, &mut self.other);
            add(&mut self.product, &self.other, -1.0);
            self.rows.take(place, &self.product);
        }
        let speed = system.scaled_norm(&sample.v);
        let size = system.scaled_norm(&sample.a).max(speed * speed);
        self.solve(driven, time, size, |own| &mut own.acceleration)
    }

    /// Puts −J⁻¹ of the rows' derivatives to a place; none where they are not smooth.
    fn solve(
        &mut self,
        driven: &mut Driven,
        time: f64,
        typical: f64,
        to: impl FnOnce(&mut Self) -> &mut Vec<f64>,
    ) -> Option<()> {
        let system = driven.system;
        let scale = |row: usize| system.row_scale(row);
        if !self.rows.are_smooth(scale, typical) {
            return None;
        }
        self.inputs.time = time;
        let mut right = std::mem::take(&mut self.rows.slopes);
        right.iter_mut().for_each(|r| *r = -*r);
        let found = to(self);
        driven.answer(&right, found);
        let is_finite = found.iter().all(|own| own.is_finite());
        self.rows.slopes = right;
        is_finite.then_some(())
    }

    fn multipliers(&mut self, driven: &mut Driven, sample: &Sample, along: &Along) -> Option<()> {
        let system = driven.system;
        let time = self.inputs.time;
        self.forces.begin(along.step());
        for (index, place) in PLACES.into_iter().enumerate() {
            let (near, by) = self.enter(system, (along, time), index);
            self.carry(near, sample, by);
            self.evaluation.eval_jacobian(near, &self.inputs);
            self.evaluation
                .transposed_product(near, &sample.lambda, &mut self.pull);
            add(&mut self.pull, &self.sample.balance, -1.0);
            self.forces.take(place, &self.pull);
        }
        self.inputs.time = time;
        // A torque is a force at the size of the mechanism.
        let scale = |column: usize| 1.0 / system.column_scale(column);
        let of = |k: usize| sample.force[k].abs().max(sample.balance[k].abs());
        let force = (0..system.n()).map(|k| of(k) / scale(k));
        if !self.forces.are_smooth(scale, force.fold(0.0, f64::max)) {
            return None;
        }
        self.pull.copy_from_slice(&self.forces.slopes);
        self.pull.iter_mut().for_each(|r| *r = -*r);
        driven.multipliers(&self.pull, &mut self.lambda);
        let is_finite = self.lambda.iter().all(|own| own.is_finite());
        is_finite.then_some(())
    }

    /// Moves position, velocity and acceleration, and works out what the constraints carry there.
    fn carry(&mut self, near: &System, sample: &Sample, by: f64) {
        moved(&mut self.sample.q, &sample.q, &self.position, by);
        moved(&mut self.sample.v, &sample.v, &self.velocity, by);
        moved(&mut self.sample.a, &sample.a, &self.acceleration, by);
        self.evaluation.set_position(&self.sample.q);
        self.evaluation.set_velocity(&self.sample.v);
        self.evaluation
            .eval_force(near, &self.inputs, &mut self.sample.force);
        let Sample {
            force, a, balance, ..
        } = &mut self.sample;
        near.mass.residual(force, a, balance);
    }

    /// Derivatives of the columns.
    fn read(
        &mut self,
        system: &System,
        sample: &Sample,
        (time, along): (f64, &Along),
        wanted: Wanted,
    ) -> Vec<f64> {
        self.columns.begin(along.step());
        for (index, place) in PLACES.into_iter().enumerate() {
            let (near, by) = self.enter(system, (along, time), index);
            match wanted.depth {
                Depth::Positions => {
                    moved(&mut self.sample.q, &sample.q, &self.position, by);
                    self.evaluation.set_position(&self.sample.q);
                }
                Depth::Motion => {
                    moved(&mut self.sample.q, &sample.q, &self.position, by);
                    moved(&mut self.sample.v, &sample.v, &self.velocity, by);
                    moved(&mut self.sample.a, &sample.a, &self.acceleration, by);
                    self.evaluation.set_position(&self.sample.q);
                    self.evaluation.set_velocity(&self.sample.v);
                }
                Depth::Forces => {
                    self.carry(near, sample, by);
                    moved(&mut self.sample.lambda, &sample.lambda, &self.lambda, by);
                }
            }
            self.row.clear();
            wanted.channels.push_row(
                near,
                &self.evaluation,
                &self.inputs,
                &self.sample,
                &mut self.row,
            );
            self.picked.clear();
            let places = wanted.places.iter();
            self.picked.extend(places.map(|&place| self.row[place]));
            self.columns.take(place, &self.picked);
        }
        let columns = &self.columns;
        let one = |index: usize| match columns.is_smooth(index) {
            true => columns.slopes[index],
            false => f64::NAN,
        };
        (0..wanted.places.len()).map(one).collect()
    }
}

/// x + h x′.
fn moved(to: &mut [f64], from: &[f64], slope: &[f64], by: f64) {
    for ((to, from), slope) in to.iter_mut().zip(from).zip(slope) {
        *to = from + by * slope;
    }
}

fn add(to: &mut [f64], other: &[f64], factor: f64) {
    to.iter_mut()
        .zip(other)
        .for_each(|(to, other)| *to += factor * other);
}
