//! Slot (pin in slot): the second point stays on a line of the first body, the bodies may turn against each other.
//!
//! With u the unit axis and n = u⊥, both turning with the first body, and d = P₂ − P₁:
//!
//! ```text
//! φ = −n·d                                                  (1)  [m]
//! J = [nᵀ, u·(d + ρ₁) | −nᵀ, −u·ρ₂]
//! γ = −ω₁² n·d − 2 ω₁ u·ḋ + n·(ω₁² ρ₁ − ω₂² ρ₂)
//! ```
//!
//! λ n is the force of the first body on the second, at the second body's point.
//! The row is the first of a prismatic joint with the same guide.

use super::algebra::Algebraic;
use super::prismatic::Guide;
use super::{BodyId, Constraint, Entry, Equations, Kinematics, Measure, Slope, abreast};
use crate::motion::Jet;
use linkdyn_linear::math::{Real, Vec2};
use std::sync::Arc;

/// A point that slides along a guide.
#[derive(Debug, Clone)]
pub struct Slot<T = f64> {
    /// The guide.
    pub guide: Guide<T>,
}

impl<T: Real> Slot<T> {
    /// The same with what `number` makes of its numbers.
    pub(crate) fn map<U>(&self, number: &mut dyn FnMut(T) -> U) -> Slot<U> {
        Slot {
            guide: self.guide.map(number),
        }
    }
}

impl<T: Real> Equations<T> for Slot<T> {
    fn position(&self, at: &Kinematics<T>, phi: &mut [T]) {
        phi[0] = self.guide.across(at);
    }

    fn jacobian(&self, at: &Kinematics<T>, values: &mut [T]) {
        values.copy_from_slice(&self.guide.across_jacobian(at));
    }

    fn rate(&self, _at: &Kinematics<T>, phi_t: &mut [T]) {
        phi_t.fill(T::zero());
    }

    fn gamma(&self, at: &Kinematics<T>, gamma: &mut [T]) {
        gamma[0] = self.guide.across_gamma(at);
    }
}

impl Constraint for Slot {
    fn rows(&self) -> &'static [Measure] {
        &[Measure::Length]
    }

    fn entries(&self) -> Vec<Entry> {
        self.guide.entries(0).to_vec()
    }

    fn curvature_pattern(&self) -> Vec<Slope> {
        self.guide.curvature_pattern().to_vec()
    }

    fn bend(&self, at: &Kinematics, lambda: &[f64], values: &mut [f64]) {
        let n = self.guide.at(at).n;
        values.copy_from_slice(&self.guide.bend(at, n, -lambda[0]));
    }

    fn algebra(&self, _drive: &[Jet]) -> Vec<Algebraic> {
        vec![self.guide.on_line()]
    }

    fn reaction(&self, at: &Kinematics, lambda: &[f64]) -> (Vec2, f64) {
        (self.guide.at(at).n * lambda[0], 0.0)
    }

    abreast!();

    fn between(&self, id: &dyn Fn(BodyId) -> BodyId) -> Option<Arc<dyn Constraint>> {
        Some(Arc::new(Slot {
            guide: self.guide.of(id),
        }))
    }
}
