//! Position, velocity and acceleration at one point of the motion.

use super::Reduced;
use crate::mechanism::continuation::Source;
use crate::mechanism::driven::Failure;
use linkdyn_linear::hermite::quintic;
use linkdyn_linear::small::cholesky_solve;

/// Contraction of Newton above which a point is refused: its branch is not certain.
const CONTRACTION: f64 = 0.35;
/// Largest distance from the prediction, in rad or sizes, for the same reason.
const FARTHEST: f64 = 0.3;

impl Reduced<'_> {
    /// Predicts the position at `time` with the pins at their values.
    fn predict(&mut self, time: f64) {
        match &self.before {
            Some(before) if before.s < self.here.s => {
                quintic(before, &self.here, time, &mut self.q, None)
            }
            _ => {
                let h = time - self.here.s;
                for (q, ((q0, d), dd)) in self
                    .q
                    .iter_mut()
                    .zip(self.here.q.iter().zip(&self.here.d).zip(&self.here.dd))
                {
                    *q = q0 + h * (d + 0.5 * h * dd);
                }
            }
        }
        let n = self.q.len();
        for (k, pin) in self.driven.pins.iter().enumerate() {
            let off = pin.jet[0] - self.q[pin.column];
            for (q, s) in self
                .q
                .iter_mut()
                .zip(&self.here_motions[k * n..(k + 1) * n])
            {
                *q += off * s;
            }
        }
    }

    /// q, v, a at (t, (u, u̇)).
    ///
    /// # Errors
    /// Where the position can't be solved on its branch, or the mass matrix is singular.
    pub fn evaluate(&mut self, time: f64, y: &[f64]) -> Result<(), Failure> {
        let system = self.driven.system;
        let f = self.freedom();
        self.at = None;
        let source = if self.has_curve() {
            self.on_curve(y[0])
        } else {
            None
        };
        self.inputs.set_time(system, time);
        for (k, pin) in self.driven.pins.iter_mut().enumerate() {
            pin.jet = [y[k], y[f + k], 0.0];
        }
        self.bridged = false;
        match source {
            Some(Source::Regular) => {}
            Some(Source::Bridged { .. }) => {
                self.bridged = true;
                return self.evaluate_bridged(time, y[1]);
            }
            None => {
                self.predict(time);
                if let Some(parts) = &mut self.parts {
                    parts.enter(&mut self.driven, &self.q, &self.here, &self.inputs)?;
                }
            }
        }
        let correction = self.driven.correct_by_any_rows(&mut self.q, &self.inputs)?;
        if correction.contraction > CONTRACTION || correction.first_step > FARTHEST {
            return Err(Failure::Diverged {
                residual: correction.residual,
            });
        }
        if correction.last_step > self.lag {
            self.driven.factor(&self.inputs)?;
        }
        self.eval_motions();
        if self.still {
            self.combine_motions(&y[f..]);
        } else {
            self.driven.velocity(&self.inputs, &mut self.v);
        }
        self.driven.acceleration(&self.inputs, &mut self.a);
        self.driven
            .evaluation
            .eval_force(system, &self.inputs, &mut self.force);
        self.eval_balance();
        self.finish(time)
    }

    /// v = S u̇, which spares a solution with the factors.
    fn combine_motions(&mut self, rates: &[f64]) {
        let n = self.v.len();
        self.v.fill(0.0);
        for (motion, rate) in self.motions.chunks_exact(n.max(1)).zip(rates) {
            self.v
                .iter_mut()
                .zip(motion)
                .for_each(|(v, s)| *v += rate * s);
        }
        self.driven.evaluation.set_velocity(&self.v);
    }

    /// ü, a and the marks of a finished evaluation.
    pub(super) fn finish(&mut self, time: f64) -> Result<(), Failure> {
        let system = self.driven.system;
        self.solve_freedom()?;
        let n = system.n();
        for (k, s) in self.motions.chunks_exact(n.max(1)).enumerate() {
            self.driven.pins[k].jet[2] = self.rhs[k];
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
            for (rate, s) in rates.iter_mut().zip(self.motions.chunks_exact(n)) {
                *rate = linkdyn_linear::math::dot(s, unit);
            }
            cholesky_solve(&self.mass, rates);
            self.balance.copy_from_slice(unit);
            for (rate, s) in rates.iter().zip(self.motions.chunks_exact(n)) {
                system.mass.subtract(*rate, s, &mut self.balance);
            }
            self.driven.multipliers(&self.balance, response);
        }
        let solved = dependent.solve(system, &self.driven.evaluation, &self.inputs, &lambda);
        if solved.is_ok() {
            dependent.add_forces(&mut self.force);
            for (size, rates) in dependent.sizes_and_rates() {
                for (k, (rate, s)) in rates.iter().zip(self.motions.chunks_exact(n)).enumerate() {
                    self.rhs[k] += size * rate;
                    self.driven.pins[k].jet[2] = self.rhs[k];
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
