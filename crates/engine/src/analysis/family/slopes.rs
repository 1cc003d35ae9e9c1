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

mod rest;

use super::around::Around;
use super::needs::{Depth, Needs, Room, State};
use super::stencil::{PLACES, STEP, StencilSums};
use crate::analysis::derived::Derived;
use crate::analysis::sample::Sample;
use crate::mechanism::driven::Driven;
use crate::system::{Evaluation, Inputs, System};

/// Along what.
pub enum Along<'a> {
    /// A parameter.
    Parameter(&'a Around),
    /// Time, in steps \[s\].
    Time(f64),
    /// A motion of the mechanism at rest, in steps [–].
    Motion(f64),
}

/// The columns that are wanted.
#[derive(Clone, Copy)]
pub struct WantedColumns<'n> {
    pub needs: &'n Needs,
    pub depth: Depth,
}

/// What makes of rows what follows from them: of the mechanism at each place, one where that is the same at all of them, none
/// where nothing follows.
pub type Readers<'r, 's> = &'r mut [Derived<'s>];

/// An instant of a mechanism.
#[derive(Clone, Copy)]
struct SlopeInstant<'a> {
    system: &'a System,
    time: f64,
    sample: &'a Sample,
}

/// What is differentiated: the equations in their order, then the columns.
enum Differentiated<'a, 's> {
    /// φ (m)
    Positions,
    /// J v + φ_t (m)
    Velocities,
    /// J a − γ (m)
    Accelerations,
    /// M a + Jᵀ λ − Q (n)
    Forces,
    Columns(Depth, Readers<'a, 's>),
}

/// Room for it.
pub struct Slopes<'n> {
    wanted: WantedColumns<'n>,
    evaluation: Evaluation,
    inputs: Inputs,
    sample: Sample,
    /// q_p, v_p, a_p (n), λ_p (m).
    position: Vec<f64>,
    velocity: Vec<f64>,
    acceleration: Vec<f64>,
    lambda: Vec<f64>,
    rows: StencilSums,
    forces: StencilSums,
    columns: StencilSums,
    /// (m), (m), (n).
    product: Vec<f64>,
    other: Vec<f64>,
    pull: Vec<f64>,
    room: Room,
}

impl Along<'_> {
    fn step(&self) -> f64 {
        match self {
            Along::Parameter(around) => around.step,
            Along::Time(step) | Along::Motion(step) => *step,
        }
    }

    /// The mechanism at a place, and how far along and how much later that is.
    fn place<'s>(&'s self, system: &'s System, index: usize) -> (&'s System, f64, f64) {
        let by = PLACES[index] * self.step();
        match self {
            Along::Parameter(around) => (&around.systems[index], by, 0.0),
            Along::Time(_) => (system, by, by),
            Along::Motion(_) => (system, by, 0.0),
        }
    }
}

impl<'n> Slopes<'n> {
    /// Of mechanisms like this one.
    pub fn new(system: &System, wanted: WantedColumns<'n>) -> Self {
        let (n, m) = (system.n(), system.m());
        Slopes {
            wanted,
            evaluation: Evaluation::new(system),
            inputs: Inputs::still(system),
            sample: Sample::new(system),
            position: vec![0.0; n],
            velocity: vec![0.0; n],
            acceleration: vec![0.0; n],
            lambda: vec![0.0; m],
            rows: StencilSums::new(m),
            forces: StencilSums::new(n),
            columns: StencilSums::new(wanted.needs.count()),
            product: vec![0.0; m],
            other: vec![0.0; m],
            pull: vec![0.0; n],
            room: wanted.needs.room(),
        }
    }

    /// A step in time \[s\] over which the mechanism moves by a small part of its size.
    pub fn time_step(system: &System, sample: &Sample) -> f64 {
        let speed = system.scaled_norm(&sample.v);
        let change = system.scaled_norm(&sample.a).sqrt();
        STEP / speed.max(change).max(1e-9)
    }

    /// Derivatives of the wanted columns at an instant, with its factors in `driven`; NaN of one that is not smooth there, and of
    /// what is carried where forces are not, or depend on multipliers. `None` if the motion is not smooth.
    pub fn along(
        &mut self,
        driven: &mut Driven,
        (inputs, sample): (&Inputs, &Sample),
        along: &Along,
        readers: Readers,
    ) -> Option<Vec<f64>> {
        let system = driven.system;
        if driven.is_redundant() || system.has_journals() {
            return None;
        }
        let time = inputs.time;
        let instant = SlopeInstant {
            system,
            time,
            sample,
        };
        self.motion(driven, &instant, along)?;
        let is_known = system.dependent_forces.is_empty();
        let depth = self.carried(is_known, driven, &instant, along);
        Some(self.read(depth, &instant, along, readers))
    }

    /// q_p, v_p and a_p, as far as they are wanted.
    fn motion(&mut self, driven: &mut Driven, instant: &SlopeInstant, along: &Along) -> Option<()> {
        let depth = self.wanted.depth;
        let Sample { v, a, .. } = instant.sample;
        let speed = instant.system.scaled_norm(v);
        if let Along::Time(_) = along {
            self.position.copy_from_slice(v);
            self.velocity.copy_from_slice(a);
        } else {
            self.differentiate(Differentiated::Positions, instant, along);
            self.solve(driven, 1.0, |own| &mut own.position)?;
            if depth > Depth::Positions {
                self.differentiate(Differentiated::Velocities, instant, along);
                self.solve(driven, speed, |own| &mut own.velocity)?;
            }
        }
        if depth > Depth::Positions {
            self.differentiate(Differentiated::Accelerations, instant, along);
            let size = instant.system.scaled_norm(a).max(speed * speed);
            self.solve(driven, size, |own| &mut own.acceleration)?;
        }
        Some(())
    }

    /// Takes what a stage is of at all places.
    fn differentiate(&mut self, mut stage: Differentiated, instant: &SlopeInstant, along: &Along) {
        let mut sums = std::mem::take(self.sums(&stage));
        sums.begin(along.step());
        for (index, place) in PLACES.into_iter().enumerate() {
            let (near, by, later) = along.place(instant.system, index);
            self.inputs.set_time(near, instant.time + later);
            let value = self.value(&mut stage, (near, index), instant.sample, by);
            sums.take(place, value);
        }
        *self.sums(&stage) = sums;
    }

    fn sums(&mut self, stage: &Differentiated) -> &mut StencilSums {
        match stage {
            Differentiated::Positions
            | Differentiated::Velocities
            | Differentiated::Accelerations => &mut self.rows,
            Differentiated::Forces => &mut self.forces,
            Differentiated::Columns(..) => &mut self.columns,
        }
    }

    /// What a stage is of at one place.
    fn value(
        &mut self,
        stage: &mut Differentiated,
        (near, index): (&System, usize),
        sample: &Sample,
        by: f64,
    ) -> &[f64] {
        match stage {
            Differentiated::Positions => {
                self.evaluation.set_position(&sample.q);
                self.evaluation.eval_phi(near, &self.inputs);
                &self.evaluation.phi
            }
            Differentiated::Velocities => {
                self.go(Depth::Positions, sample, by);
                self.rates(near, &sample.v);
                self.evaluation
                    .eval_rate(near, &self.inputs, &mut self.other);
                add(&mut self.product, &self.other, 1.0);
                &self.product
            }
            Differentiated::Accelerations => {
                self.go(Depth::Positions, sample, by);
                moved(&mut self.sample.v, &sample.v, &self.velocity, by);
                self.evaluation.set_velocity(&self.sample.v);
                self.rates(near, &sample.a);
                self.evaluation
                    .eval_gamma(near, &self.inputs, &mut self.other);
                add(&mut self.product, &self.other, -1.0);
                &self.product
            }
            Differentiated::Forces => {
                self.carry(near, sample, by);
                self.evaluation.eval_jacobian(near, &self.inputs);
                self.evaluation
                    .transposed_product(near, &sample.lambda, &mut self.pull);
                add(&mut self.pull, &self.sample.balance, -1.0);
                &self.pull
            }
            Differentiated::Columns(depth, readers) => {
                match depth {
                    Depth::Positions | Depth::Motion => self.go(*depth, sample, by),
                    Depth::Forces => {
                        self.carry(near, sample, by);
                        moved(&mut self.sample.lambda, &sample.lambda, &self.lambda, by);
                    }
                }
                let last = readers.len().saturating_sub(1);
                self.pick(near, readers.get_mut(index.min(last)))
            }
        }
    }

    /// J x at the place to `product`.
    fn rates(&mut self, near: &System, x: &[f64]) {
        self.evaluation.eval_jacobian(near, &self.inputs);
        self.evaluation.product(near, x, &mut self.product);
    }

    /// Moves position and, where they are wanted, velocity and acceleration.
    fn go(&mut self, depth: Depth, sample: &Sample, by: f64) {
        moved(&mut self.sample.q, &sample.q, &self.position, by);
        self.evaluation.set_position(&self.sample.q);
        if depth > Depth::Positions {
            moved(&mut self.sample.v, &sample.v, &self.velocity, by);
            moved(&mut self.sample.a, &sample.a, &self.acceleration, by);
            self.evaluation.set_velocity(&self.sample.v);
        }
    }

    /// Moves position, velocity and acceleration, and works out what the constraints carry there.
    fn carry(&mut self, near: &System, sample: &Sample, by: f64) {
        self.go(Depth::Motion, sample, by);
        self.evaluation
            .eval_force(near, &self.inputs, &mut self.sample.force);
        let Sample {
            force, a, balance, ..
        } = &mut self.sample;
        near.mass.residual(force, a, balance);
    }

    /// The wanted columns of the place.
    fn pick(&mut self, near: &System, derived: Option<&mut Derived>) -> &[f64] {
        let state = State {
            system: near,
            evaluation: &self.evaluation,
            inputs: &self.inputs,
            sample: &self.sample,
        };
        self.wanted.needs.read(state, derived, &mut self.room);
        &self.room.values
    }

    /// Puts −J⁻¹ of the rows' derivatives to a place; `None` if they are not smooth.
    fn solve(
        &mut self,
        driven: &mut Driven,
        typical: f64,
        to: impl FnOnce(&mut Self) -> &mut Vec<f64>,
    ) -> Option<()> {
        let system = driven.system;
        let scale = |row: usize| system.row_scale(row);
        if !self.rows.are_smooth(scale, typical) {
            return None;
        }
        let mut right = std::mem::take(&mut self.rows.slopes);
        right.iter_mut().for_each(|r| *r = -*r);
        let found = to(self);
        driven.answer(&right, found);
        let is_finite = found.iter().all(|own| own.is_finite());
        self.rows.slopes = right;
        is_finite.then_some(())
    }

    /// λ_p, where it is wanted and can be had; what is known then.
    fn carried(
        &mut self,
        is_known: bool,
        driven: &mut Driven,
        instant: &SlopeInstant,
        along: &Along,
    ) -> Depth {
        if self.wanted.depth < Depth::Forces {
            return self.wanted.depth;
        }
        if !is_known {
            return Depth::Motion;
        }
        self.differentiate(Differentiated::Forces, instant, along);
        self.pull.copy_from_slice(&self.forces.slopes);
        self.pull.iter_mut().for_each(|r| *r = -*r);
        driven.multipliers(&self.pull, &mut self.lambda);
        let is_finite = self.lambda.iter().all(|own| own.is_finite());
        match is_finite && self.are_forces_smooth(instant) {
            true => Depth::Forces,
            false => Depth::Motion,
        }
    }

    fn are_forces_smooth(&self, instant: &SlopeInstant) -> bool {
        let SlopeInstant { system, sample, .. } = instant;
        // A torque is a force at the size of the mechanism.
        let scale = |column: usize| 1.0 / system.column_scale(column);
        let of = |k: usize| sample.force[k].abs().max(sample.balance[k].abs());
        let force = (0..system.n()).map(|k| of(k) / scale(k));
        self.forces.are_smooth(scale, force.fold(0.0, f64::max))
    }

    /// Derivatives of the columns, as far as the instant is known.
    fn read(
        &mut self,
        depth: Depth,
        instant: &SlopeInstant,
        along: &Along,
        readers: Readers,
    ) -> Vec<f64> {
        self.differentiate(Differentiated::Columns(depth, readers), instant, along);
        let (columns, needs) = (&self.columns, self.wanted.needs);
        let is_known = |index: usize| depth == Depth::Forces || !needs.is_carried(index);
        let one = |index: usize| match columns.is_smooth(index) && is_known(index) {
            true => columns.slopes[index],
            false => f64::NAN,
        };
        (0..needs.count()).map(one).collect()
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
