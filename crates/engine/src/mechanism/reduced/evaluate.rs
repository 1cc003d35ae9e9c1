//! Position, velocity and acceleration at one point of the motion.

use super::inertia::Inertia;
use super::place::{Given, Placed, PositionSource};
use super::{Reduced, wants_factors};
use crate::mechanism::driven::{Failure, LAST_STEP};

/// Contraction of Newton above which a point is refused: its branch is not certain.
const CONTRACTION: f64 = 0.35;
/// Largest distance from the prediction, in rad or sizes, for the same reason.
const FARTHEST: f64 = 0.3;
/// Factors of a position this near to the solution are those of the solution [rad or sizes].
const ROUND_OFF: f64 = 1e-13;

impl Reduced<'_> {
    /// q, v, a at (t, (u, u̇)).
    ///
    /// # Errors
    /// Where the position can't be solved on its branch, or the mass matrix is singular.
    pub fn evaluate(&mut self, time: f64, y: &[f64]) -> Result<(), Failure> {
        let evaluated = self.evaluate_places(time, y);
        self.tell();
        evaluated
    }

    /// The same within a step: what follows looks at ü alone. Where weights alone act, no place is worked out for it; elsewhere
    /// elements are told of the point where they make accelerations.
    ///
    /// # Errors
    /// As [`Reduced::evaluate`].
    pub fn evaluate_within(&mut self, time: f64, y: &[f64]) -> Result<(), Failure> {
        if !self.with_factors && self.evaluate_by_profile(y) {
            return Ok(());
        }
        self.evaluate_places(time, y)
    }

    /// ü alone, where it is known along the curve.
    fn evaluate_by_profile(&mut self, y: &[f64]) -> bool {
        let (Some(curve), &[u, rate]) = (self.chart.curve_mut(), y) else {
            return false;
        };
        let Some(tangents) = self.inertia.tangents() else {
            return false;
        };
        // Of the point at hand nothing is wanted any more.
        self.at = None;
        let room = [&mut self.v[..], &mut self.force];
        let along = [&mut tangents.s[..], &mut self.a];
        let (driven, tolerance) = (&self.driven, self.lag);
        let Some(acceleration) = curve.acceleration([u, rate], tolerance, driven, room, along)
        else {
            return false;
        };
        self.accelerations[0] = acceleration;
        true
    }

    /// q, v, a, which elements are given if one of them needs it.
    fn evaluate_places(&mut self, time: f64, y: &[f64]) -> Result<(), Failure> {
        self.is_told = true;
        if !self.with_factors && self.evaluate_straight(time, y) {
            return Ok(());
        }
        let system = self.driven.system;
        let f = self.freedom();
        self.at = None;
        self.inputs.set_time(system, time);
        let (u, rates) = y[..2 * f].split_at(f);
        if !self.solve_in_sequence(u, rates)? {
            self.solve_on_chart(time, u, rates)?;
        }
        self.driven
            .evaluation
            .eval_force(system, &self.inputs, &mut self.force);
        self.accelerate()?;
        self.at = Some(time);
        Ok(())
    }

    /// q and v from where positions come from, with the factors there.
    fn solve_on_chart(&mut self, time: f64, u: &[f64], rates: &[f64]) -> Result<(), Failure> {
        let given = Given {
            time,
            u,
            inputs: &self.inputs,
            accepted: &self.accepted,
            known_to: (!self.with_factors).then_some(self.lag),
        };
        let tangent = self.inertia.tangents();
        let tangent = tangent.map_or(&mut [][..], |tangents| &mut tangents.s);
        let to = [&mut self.q[..], tangent, &mut self.a];
        let placed = self.chart.place(given, &mut self.driven, to)?;
        // The last stage of an implicit step is at its end.
        let stages = self.stages.as_ref();
        if let Some(q) = stages.and_then(|stages| stages.position_at(time)) {
            self.q.copy_from_slice(q);
        }
        self.driven.give(u, rates);
        self.placed = placed;
        match placed {
            Placed::Guess | Placed::Close | Placed::Straight | Placed::InSequence => {
                self.solve_constraints(rates)?;
            }
            Placed::Known | Placed::Smooth => self.take_branch(rates[0]),
        }
        Ok(())
    }

    /// As [`Reduced::evaluate`], exactly onto the constraints, whatever the tolerance of the integration.
    ///
    /// # Errors
    /// As there.
    pub fn evaluate_exactly(&mut self, time: f64, y: &[f64]) -> Result<(), Failure> {
        let (lag, last_step) = (self.lag, self.driven.last_step);
        self.lag = 0.0;
        self.with_factors = true;
        self.driven.last_step = LAST_STEP;
        let solved = self.evaluate(time, y);
        (self.lag, self.driven.last_step) = (lag, last_step);
        self.with_factors = wants_factors(self.driven.system);
        solved
    }

    /// q by Newton from the guess at hand, then v.
    fn solve_constraints(&mut self, rates: &[f64]) -> Result<(), Failure> {
        if let Inertia::Sparse(sparse) = &mut self.inertia {
            sparse.slide(&mut self.driven, &mut self.q);
        }
        let correction = self.driven.correct_by_any_rows(&mut self.q, &self.inputs)?;
        if correction.contraction > CONTRACTION || correction.first_step > FARTHEST {
            return Err(Failure::Diverged {
                residual: correction.residual,
            });
        }
        let lag = match self.placed {
            Placed::Close => self.lag.max(ROUND_OFF),
            _ => self.lag,
        };
        if correction.last_step > lag {
            self.driven.refresh(&self.inputs)?;
        }
        let (driven, inputs) = (&mut self.driven, &self.inputs);
        self.inertia.velocity(driven, inputs, rates, &mut self.v);
        Ok(())
    }

    /// v and a₀ of the curve, on which q is, from S and S'.
    fn take_branch(&mut self, rate: f64) {
        let square = rate * rate;
        let along = self.inertia.known_tangents();
        for ((v, a), s) in self.v.iter_mut().zip(&mut self.a).zip(along) {
            (*v, *a) = (rate * s, square * *a);
        }
        self.is_told = false;
        if self.driven.system.looks_at_places() {
            self.tell();
        }
    }

    /// Tells the elements of the point at hand.
    pub fn tell(&mut self) {
        if !self.is_told {
            self.driven.evaluation.set_position(&self.q);
            self.driven.evaluation.set_velocity(&self.v);
            self.is_told = true;
        }
    }

    /// ü and a, with the forces that depend on multipliers.
    fn accelerate(&mut self) -> Result<(), Failure> {
        let to = [&mut self.a[..], &mut self.accelerations];
        let has_tangents = matches!(self.placed, Placed::Known | Placed::Smooth);
        match self.inertia.tangents().filter(|_| has_tangents) {
            Some(tangents) => tangents.accelerate(&self.driven, &self.force, to)?,
            None => {
                let (driven, inputs) = (&mut self.driven, &self.inputs);
                self.inertia.accelerate(driven, inputs, &self.force, to)?;
            }
        }
        if !self.driven.system.dependent_forces.is_empty() {
            self.react()?;
        }
        let own = self.driven.independent.iter_mut();
        own.zip(&self.accelerations)
            .for_each(|(coordinate, rate)| coordinate.jet[2] = *rate);
        Ok(())
    }

    /// Forces that depend on multipliers: with them ü, a and Q.
    fn react(&mut self) -> Result<(), Failure> {
        let system = self.driven.system;
        let mut dependent = std::mem::take(&mut self.driven.dependent_forces);
        let mut lambda = std::mem::take(&mut dependent.free);
        self.multipliers(&mut lambda);
        if lambda.iter().any(|lambda| lambda.is_nan()) {
            // In a change point itself there are none, nor what forces depend on them.
            dependent.free = lambda;
            self.driven.dependent_forces = dependent;
            return Err(Failure::Singular);
        }
        dependent.eval_units(system, &self.driven.evaluation, &self.inputs);
        for ((unit, response), change) in dependent.units_responses_and_changes() {
            self.inertia.respond(&self.driven, unit, change);
            self.driven
                .multipliers_of(|room| system.mass.residual(unit, change, room), response);
        }
        let solved = dependent.solve(system, &self.driven.evaluation, &self.inputs, &lambda);
        if solved.is_ok() {
            dependent.add_forces(&mut self.force);
            for (size, change) in dependent.sizes_and_changes() {
                let a = self.a.iter_mut().zip(change);
                a.for_each(|(a, change)| *a += size * change);
                let own = self.driven.independent.iter().zip(&mut self.accelerations);
                own.for_each(|(coordinate, rate)| *rate += size * change[coordinate.column]);
            }
        }
        dependent.free = lambda;
        self.driven.dependent_forces = dependent;
        solved
    }
}
