//! Multipliers of the constraints: reactions of joints, efforts of drivers, and what impulses make of them.

use super::Reduced;
use super::place::Placed;

impl Reduced<'_> {
    /// What a generalized impulse P (n) changes at the point of the last evaluation: the rates u̇ (f), SᵀMS Δu̇ = Sᵀ P, and
    /// the velocities (n).
    pub fn impulsive_change(&mut self, impulse: &[f64], rates: &mut [f64], change: &mut [f64]) {
        self.inertia.respond(&self.driven, impulse, change);
        let own = self.driven.independent.iter().zip(rates);
        own.for_each(|(coordinate, rate)| *rate = change[coordinate.column]);
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
        self.tell();
        if matches!(
            self.placed,
            Placed::Known | Placed::Smooth | Placed::Straight | Placed::InSequence
        ) {
            let ready = self.driven.prepare(&self.q, &self.inputs).is_ok()
                && self.driven.factor(&self.inputs).is_ok();
            if !ready {
                lambda.fill(f64::NAN);
                return;
            }
            if self.placed != Placed::Smooth {
                self.placed = Placed::Close;
            }
        }
        self.eval_balance();
        self.driven.multipliers(&self.balance, lambda);
    }

    /// The same for all joints; near a change point of a part, where they can't be computed, they are NaN.
    pub fn reactions(&mut self, lambda: &mut [f64]) {
        self.eval_balance();
        let Some(own) = self.chart.own() else {
            return self.multipliers(lambda);
        };
        own.evaluation.set_position(&self.q);
        if own.factor(&self.inputs).is_err() {
            lambda.fill(f64::NAN);
            return;
        }
        own.multipliers(&self.balance, lambda);
    }

    /// Power that moving drivers bring in \[W\]: that of all constraints, −λᵀ J v = (M a − Q)ᵀ v, for which no λ is needed.
    pub fn constraint_power(&mut self) -> f64 {
        self.eval_balance();
        -linkdyn_linear::math::dot(&self.balance, &self.v)
    }

    /// Q − M a.
    pub(super) fn eval_balance(&mut self) {
        let mass = &self.driven.system.mass;
        mass.residual(&self.force, &self.a, &mut self.balance);
    }
}
