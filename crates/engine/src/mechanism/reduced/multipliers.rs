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
        self.driven
            .multipliers_of(|room| mass.residual(impulse, change, room), lambda);
    }

    /// Multipliers λ (m) of the last evaluation.
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
        let (mass, force, a) = (&self.driven.system.mass, &self.force, &self.a);
        self.driven
            .multipliers_of(|room| mass.residual(force, a, room), lambda);
    }

    /// The same for all joints; near a change point of a part, where they can't be computed, they are NaN.
    pub fn reactions(&mut self, lambda: &mut [f64]) {
        let Some(own) = self.chart.own() else {
            return self.multipliers(lambda);
        };
        own.evaluation.set_position(&self.q);
        if own.factor(&self.inputs).is_err() {
            lambda.fill(f64::NAN);
            return;
        }
        let (mass, force, a) = (&self.driven.system.mass, &self.force, &self.a);
        own.multipliers_of(|room| mass.residual(force, a, room), lambda);
    }

    /// Power that moving drivers bring in \[W\]: that of all constraints, −λᵀ J v = (M a − Q)ᵀ v, for which no λ is needed.
    pub fn constraint_power(&self) -> f64 {
        let mass = &self.driven.system.mass;
        -mass.pull(&self.v, &self.force, &self.a)
    }
}
