//! What impulses change.

use super::Reduced;

impl Reduced<'_> {
    /// What a generalized impulse P (n) changes at the point of the last evaluation: the rates u̇ (f), SᵀMS Δu̇ = Sᵀ P, and
    /// the velocities (n).
    pub fn impulsive_change(&mut self, impulse: &[f64], rates: &mut [f64], change: &mut [f64]) {
        self.inertia.respond(&self.driven, impulse, change);
        let own = self.driven.independent.iter().zip(rates);
        own.for_each(|(coordinate, rate)| *rate = change[coordinate.column]);
    }
}
