//! Position, velocity and acceleration at one point of the motion.

use super::Reduced;
use super::place::{Given, Place, Placed};
use crate::mechanism::driven::Failure;
use linkdyn_linear::small::cholesky_solve;

/// Contraction of Newton above which a point is refused: its branch is not certain.
const CONTRACTION: f64 = 0.35;
/// Largest distance from the prediction, in rad or sizes, for the same reason.
const FARTHEST: f64 = 0.3;

impl Reduced<'_> {
    /// q, v, a at (t, (u, u̇)).
    ///
    /// # Errors
    /// Where the position can't be solved on its branch, or the mass matrix is singular.
    pub fn evaluate(&mut self, time: f64, y: &[f64]) -> Result<(), Failure> {
        let system = self.driven.system;
        let f = self.freedom();
        self.at = None;
        self.inputs.set_time(system, time);
        let (u, rates) = y[..2 * f].split_at(f);
        let given = Given {
            time,
            u,
            inputs: &self.inputs,
            accepted: &self.accepted,
        };
        let placed = self.chart.place(given, &mut self.driven, &mut self.q)?;
        let given = u.iter().zip(rates);
        for (coordinate, (u, rate)) in self.driven.independent.iter_mut().zip(given) {
            coordinate.jet = [*u, *rate, 0.0];
        }
        self.is_smooth = placed == Placed::Smooth;
        match placed {
            Placed::Guess => self.solve_constraints(rates)?,
            Placed::Smooth => self.take_branch(rates[0]),
        }
        self.driven
            .evaluation
            .eval_force(system, &self.inputs, &mut self.force);
        self.eval_balance();
        self.finish(time)
    }

    /// q by Newton from the guess at hand, then S, v and a₀.
    fn solve_constraints(&mut self, rates: &[f64]) -> Result<(), Failure> {
        let correction = self.driven.correct_by_any_rows(&mut self.q, &self.inputs)?;
        if correction.contraction > CONTRACTION || correction.first_step > FARTHEST {
            return Err(Failure::Diverged {
                residual: correction.residual,
            });
        }
        if correction.last_step > self.lag {
            self.driven.factor(&self.inputs)?;
        }
        self.eval_velocity(rates);
        self.driven.acceleration(&self.inputs, &mut self.a);
        Ok(())
    }

    /// S, v and a₀ of the smooth branch near a change point, on which q is.
    fn take_branch(&mut self, rate: f64) {
        let Some(curve) = self.chart.curve() else {
            return;
        };
        for (v, s) in self.v.iter_mut().zip(&curve.tangent) {
            *v = rate * s;
        }
        for (a, bend) in self.a.iter_mut().zip(&curve.bend) {
            *a = rate * rate * bend;
        }
        self.tangents.copy_from_slice(&curve.tangent);
        self.driven.evaluation.set_position(&self.q);
        self.driven.evaluation.set_velocity(&self.v);
    }

    /// S and v = S u̇ + v_t.
    fn eval_velocity(&mut self, rates: &[f64]) {
        let n = self.v.len();
        let (driven, tangents) = (&mut self.driven, &mut self.tangents);
        if self.still {
            driven.tangents(tangents);
            self.v.fill(0.0);
        } else {
            driven.tangents_and_drift(&self.inputs, tangents, &mut self.v);
        }
        for (tangent, rate) in tangents.chunks_exact(n.max(1)).zip(rates) {
            self.v
                .iter_mut()
                .zip(tangent)
                .for_each(|(v, s)| *v += rate * s);
        }
        driven.evaluation.set_velocity(&self.v);
    }

    /// ü, a and the marks of a finished evaluation.
    fn finish(&mut self, time: f64) -> Result<(), Failure> {
        let system = self.driven.system;
        self.solve_freedom()?;
        let n = system.n();
        for (k, s) in self.tangents.chunks_exact(n.max(1)).enumerate() {
            self.driven.independent[k].jet[2] = self.rhs[k];
            for (a, s) in self.a.iter_mut().zip(s) {
                *a += self.rhs[k] * s;
            }
        }
        if !system.dependent_forces.is_empty() {
            self.react()?;
        }
        self.at = Some(time);
        Ok(())
    }

    /// Forces that depend on multipliers: with them ü, a and Q.
    fn react(&mut self) -> Result<(), Failure> {
        let system = self.driven.system;
        let n = system.n();
        let mut dependent = std::mem::take(&mut self.driven.dependent_forces);
        let mut lambda = std::mem::take(&mut dependent.free);
        self.multipliers(&mut lambda);
        dependent.eval_units(system, &self.driven.evaluation, &self.inputs);
        for ((unit, response), rates) in dependent.units_responses_and_rates() {
            for (rate, s) in rates.iter_mut().zip(self.tangents.chunks_exact(n)) {
                *rate = linkdyn_linear::math::dot(s, unit);
            }
            cholesky_solve(&self.mass, rates);
            self.balance.copy_from_slice(unit);
            for (rate, s) in rates.iter().zip(self.tangents.chunks_exact(n)) {
                system.mass.subtract(*rate, s, &mut self.balance);
            }
            self.driven.multipliers(&self.balance, response);
        }
        let solved = dependent.solve(system, &self.driven.evaluation, &self.inputs, &lambda);
        if solved.is_ok() {
            dependent.add_forces(&mut self.force);
            for (size, rates) in dependent.sizes_and_rates() {
                for (k, (rate, s)) in rates.iter().zip(self.tangents.chunks_exact(n)).enumerate() {
                    self.rhs[k] += size * rate;
                    self.driven.independent[k].jet[2] = self.rhs[k];
                    self.a
                        .iter_mut()
                        .zip(s)
                        .for_each(|(a, s)| *a += size * rate * s);
                }
            }
        }
        dependent.free = lambda;
        self.driven.dependent_forces = dependent;
        solved
    }
}
