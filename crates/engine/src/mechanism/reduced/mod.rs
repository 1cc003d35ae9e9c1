//! Equations of motion in minimal coordinates, by partitioning (Wehage and Haug 1982).
//!
//! f coordinates u of the mechanism are chosen as independent; at every point they determine the others through
//! the constraints, so that positions and velocities never drift:
//!
//! ```text
//! q = q(u, t)                   by Newton, branch-safe from the path so far
//! v = S u̇ + v_t                 S = ∂q/∂u (n, f)
//! a = S ü + a₀                  a₀: accelerations with ü = 0
//! SᵀM S ü = Sᵀ (Q − M a₀)       the efforts on u vanish
//! ```
//!
//! Of much freedom S is large and dense, and SᵀMS costs as f³: there v comes of J v = −φ_t beside the given u̇, and a with λ of
//! one sparse matrix (`inertia`, `sparse`).
//!
//! With one degree of freedom and drivers at rest the positions are a curve q(u), which the continuation follows once:
//! then predictions come from it, and near a change point, where round-off of the equations grows as 1/δ³, so do S and
//! S′ = ∂²q/∂u² (a₀ = S′ u̇²), from its smooth branch. Closed curves (a coordinate that turns round and round) are followed
//! once around. Where weights alone act, accelerations within steps come from polynomials along the curve (`profile`), which cost
//! the same for any number of bodies.
//!
//! Multipliers are worked out only where they are wanted: for results, and where forces depend on them
//! (`dependent_forces`), which then become part of Q. Bodies may lack mass as long as SᵀMS is regular. The choice of u
//! is kept while it is good and changed between steps when another coordinate moves more.

mod accepted;
mod begin;
mod chart;
mod curve;
mod curves;
mod evaluate;
mod extrapolation;
mod implicit;
mod inertia;
mod keep;
mod multipliers;
mod nearest;
mod place;
mod profile;
mod saddle;
mod sequence;
mod sequenced;
mod sparse;
mod stages;
mod straight;
mod strained;
mod tangents;

use super::dependent_forces::DependentForces;
use super::driven::{Driven, Failure, Work};
use super::independent::better_of_all;
use super::parts::{Part, Parts};
use super::phases::Phases;
use crate::element::Kinematics;
use crate::element::pair::Hold;
use crate::system::{Evaluation, Inputs, System};
use accepted::Accepted;
use chart::Chart;
use curve::CoordinateCurve;
pub use curves::ChangePoint;
use extrapolation::Extrapolation;
use inertia::Inertia;
pub use inertia::Solver;
use place::{Placed, PositionSource};
use sequence::Sequence;
use stages::Stages;

/// A mechanism with freedom left.
#[derive(Clone)]
pub struct Reduced<'s> {
    /// Solver of the dependent coordinates.
    driven: Driven<'s>,
    /// What is prescribed, and what contacts remember.
    pub inputs: Inputs,
    /// Position, velocity and acceleration of the last evaluation (n).
    q: Vec<f64>,
    v: Vec<f64>,
    a: Vec<f64>,
    /// Q (n).
    force: Vec<f64>,
    /// Factors whose position is this far from the solution are taken for those of the solution [rad or sizes].
    lag: f64,
    /// Who was wanted to solve for ü, who does, and ü (f).
    wanted: Option<Solver>,
    inertia: Inertia,
    accelerations: Vec<f64>,
    /// What an implicit method needs, once one has asked.
    stages: Option<Box<Stages>>,
    /// The last accepted points.
    accepted: Accepted,
    /// Where q, v, a are.
    at: Option<f64>,
    /// Where positions come from.
    chart: Chart<'s>,
    /// The dependent coordinates one after the other, where they follow so.
    sequence: Option<Box<Sequence>>,
    /// What is known of the point at hand.
    placed: Placed,
    /// Evaluations make the equations' factors, even where the curve is known: multipliers depend on each other or on contacts, or
    /// are requested.
    with_factors: bool,
    /// Elements know the point at hand: where none looks at places, they are not told of those within steps.
    is_told: bool,
}

impl<'s> Reduced<'s> {
    /// At an assembled state; `columns` are coordinates that determine the rest there. Where no solver is wanted, that
    /// which costs least solves for accelerations; a curve has its tangent, whatever is wanted.
    ///
    /// # Errors
    /// When they do not.
    pub fn new(
        system: &'s System,
        columns: &[usize],
        (q, v, time): (&[f64], &[f64], f64),
        solver: Option<Solver>,
    ) -> Result<Self, Failure> {
        let inputs = Inputs::at_time(system, time);
        let is_curve = is_curve(system, columns.len());
        Reduced::with_inputs(system, columns, (q, v, inputs), (solver, is_curve))
    }

    /// The same with what contacts and forces remember.
    fn with_inputs(
        system: &'s System,
        columns: &[usize],
        (q, v, inputs): (&[f64], &[f64], Inputs),
        (solver, is_curve): (Option<Solver>, bool),
    ) -> Result<Self, Failure> {
        let time = inputs.time;
        let mut driven = Driven::with_independent(system, columns, q, &inputs)?;
        driven.measures_residual = false;
        let (n, f) = (system.n(), columns.len());
        let zero = vec![0.0; n];
        let chart = if is_curve {
            Chart::CoordinateCurve(Box::new(CoordinateCurve::new(
                system,
                Extrapolation::default(),
            )))
        } else {
            Chart::Coordinates(Extrapolation::default())
        };
        let mut reduced = Reduced {
            inertia: Inertia::of(
                &driven,
                if is_curve {
                    Some(Solver::Tangents)
                } else {
                    solver
                },
            ),
            driven,
            inputs,
            q: q.to_vec(),
            v: v.to_vec(),
            a: zero.clone(),
            force: zero,
            lag: 0.0,
            wanted: solver,
            accelerations: vec![0.0; f],
            stages: None,
            accepted: Accepted::new(time, q, v),
            at: None,
            chart,
            sequence: None,
            placed: Placed::Guess,
            with_factors: wants_factors(system),
            is_told: false,
        };
        reduced.choose(time)?;
        Ok(reduced)
    }

    /// The equations of the same mechanism with other rows in force, from the position and velocity at hand. Memories, work
    /// and parts go over to them.
    ///
    /// # Errors
    /// As [`Reduced::new`].
    pub fn with_rows(
        &mut self,
        system: &'s System,
        columns: &[usize],
        time: f64,
        holds: &[Hold],
    ) -> Result<Self, Failure> {
        let mut inputs = Inputs::at_time(system, time);
        let memories = inputs.memories.iter_mut().zip(&self.inputs.memories);
        memories.for_each(|(memory, was)| *memory = *was);
        inputs.contacts.clone_from(&self.inputs.contacts);
        inputs.sides.clone_from(&self.inputs.sides);
        inputs.states.clone_from(&self.inputs.states);
        inputs.steered.clone_from(&self.inputs.steered);
        inputs.set_time(system, time);
        inputs.pushes.clone_from(&self.inputs.pushes);
        // A journal that rolls round and round has no closed curve, and does so for a short time only.
        let is_curve = is_curve(system, columns.len()) && !holds.contains(&Hold::Sticks);
        let point = (&self.q[..], &self.v[..], inputs);
        let mut other = Reduced::with_inputs(system, columns, point, (self.solver(), is_curve))?;
        other.lag = self.lag;
        other.driven.done = self.driven.done;
        let parts = self.chart.exchange_bridge(None);
        let parts = parts.map(|parts| parts.with_holds(holds));
        other.chart.exchange_bridge(parts);
        Ok(other)
    }

    /// Who solves for accelerations where the rows change: with bridges there are tangents.
    fn solver(&self) -> Option<Solver> {
        match self.chart.bridge() {
            Some(_) => Some(Solver::Tangents),
            None => self.wanted,
        }
    }

    /// Takes the change points of these parts by their smooth branches.
    pub fn cross(&mut self, parts: &'s [Part], phases: &'s Phases<'s>) {
        let parts = (!parts.is_empty()).then(|| Parts::new(parts, phases));
        if parts.is_some() {
            self.sequence = None;
        }
        self.chart.exchange_bridge(parts);
    }

    /// Factors are kept where the position is this far from theirs [rad or sizes].
    pub fn set_lag(&mut self, lag: f64) {
        self.lag = lag;
    }

    /// The mechanism with the rows in force.
    pub fn system(&self) -> &'s System {
        self.driven.system
    }

    /// Position of the last evaluation (n).
    pub fn position(&self) -> &[f64] {
        &self.q
    }

    /// Its velocity (n).
    pub fn velocity(&self) -> &[f64] {
        &self.v
    }

    /// Its acceleration (n).
    pub fn acceleration(&self) -> &[f64] {
        &self.a
    }

    /// Its force Q, with those that depend on multipliers (n).
    pub fn force(&self) -> &[f64] {
        &self.force
    }

    /// What elements have evaluated there.
    pub fn evaluation(&self) -> &Evaluation {
        &self.driven.evaluation
    }

    /// Places, velocities and inputs there, for elements.
    pub fn kinematics(&self) -> Kinematics<'_> {
        self.driven.evaluation.kinematics(&self.inputs)
    }

    /// Holds formulas on the sides of their kinks on which they are there.
    pub fn take_sides(&mut self) {
        let (evaluation, system) = (&self.driven.evaluation, self.driven.system);
        evaluation.take_sides(system, &mut self.inputs);
    }

    /// The forces that depend on multipliers there.
    pub fn dependent_forces(&self) -> &DependentForces {
        &self.driven.dependent_forces
    }

    /// Work since it was made.
    pub fn work(&self) -> Work {
        self.driven.done
    }

    /// Columns of the independent coordinates.
    pub fn independent_columns(&self) -> impl Iterator<Item = usize> {
        self.driven
            .independent
            .iter()
            .map(|coordinate| coordinate.column)
    }

    /// Scaled residual of the mechanism's own constraints there [–].
    pub fn residual(&mut self) -> f64 {
        let system = self.own().system;
        let evaluation = &mut self.driven.evaluation;
        evaluation.set_position(&self.q);
        evaluation.eval_phi(system, &self.inputs);
        system.scaled_residual(&evaluation.phi)
    }

    /// The solver of the mechanism's own equations.
    pub(super) fn own(&mut self) -> &mut Driven<'s> {
        match self.chart.own() {
            Some(own) => own,
            None => &mut self.driven,
        }
    }

    /// The mechanism's own rows, where smooth branches of parts stand for some of them.
    pub fn own_system(&mut self) -> &'s System {
        self.own().system
    }

    /// Degrees of freedom f.
    pub fn freedom(&self) -> usize {
        self.driven.independent.len()
    }

    /// Exchanges independent coordinates until none moves less than half as much as another coordinate that it determines.
    fn choose(&mut self, time: f64) -> Result<(), Failure> {
        let system = self.driven.system;
        self.chart.forget();
        self.inputs.set_time(system, time);
        self.driven.evaluation.set_position(&self.q);
        self.driven.factor(&self.inputs)?;
        for _ in 0..10 * (self.freedom() + 1) {
            let Some((k, column)) = better_of_all(&mut self.driven) else {
                break;
            };
            let mut columns: Vec<usize> = self
                .driven
                .independent
                .iter()
                .map(|coordinate| coordinate.column)
                .collect();
            columns[k] = column;
            self.driven.choose(&columns, &self.inputs)?;
        }
        self.find_sequence();
        let mut state = vec![0.0; 2 * self.freedom()];
        self.state(&mut state);
        self.evaluate(time, &state)?;
        self.keep(time);
        Ok(())
    }

    /// Chooses other independent coordinates at the last accepted point where that is better; true if it was done, and the state vector is
    /// another one then.
    ///
    /// # Errors
    /// When the coordinates do not determine the rest any more.
    pub fn choose_better(&mut self) -> Result<bool, Failure> {
        if !self.has_better()? {
            return Ok(false);
        }
        self.recall()?;
        self.q.copy_from_slice(&self.accepted.here.q);
        self.v.copy_from_slice(&self.accepted.here.d);
        let before = self.accepted.set_aside();
        self.choose(self.accepted.here.s)?;
        self.accepted.take_back(before);
        Ok(true)
    }

    /// Whether another coordinate moves more than an independent one at the last accepted point.
    fn has_better(&mut self) -> Result<bool, Failure> {
        let Inertia::Sparse(sparse) = &mut self.inertia else {
            return Ok(self.accepted.has_better);
        };
        if !sparse.may_be_better(&mut self.driven, self.sequence.as_deref()) {
            return Ok(false);
        }
        self.at = None;
        self.inputs
            .set_time(self.driven.system, self.accepted.here.s);
        self.driven.evaluation.set_position(&self.accepted.here.q);
        self.driven.factor(&self.inputs)?;
        let found = better_of_all(&mut self.driven).is_some();
        sparse.note(found);
        Ok(found)
    }

    /// (u, u̇) of the position and velocity at hand.
    pub fn state(&self, y: &mut [f64]) {
        let f = self.freedom();
        for (k, coordinate) in self.driven.independent.iter().enumerate() {
            y[k] = self.q[coordinate.column];
            y[f + k] = self.v[coordinate.column];
        }
    }

    /// ü of the last evaluation.
    pub fn accelerations(&self) -> &[f64] {
        &self.accelerations
    }
}

/// Whether every point is wanted with the equations' factors: contacts and friction ask for multipliers there.
fn wants_factors(system: &System) -> bool {
    !(system.contacts.is_empty() && system.dependent_forces.is_empty())
}

/// Whether the positions of a mechanism with so many degrees of freedom are a curve of one coordinate.
pub fn is_curve(system: &System, freedom: usize) -> bool {
    let mut drivers = system.drivers.iter();
    freedom == 1 && drivers.all(|driver| driver.is_still())
}
