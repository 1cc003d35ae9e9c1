//! Fixed joint: the points coincide and the relative angle β is constant.
//!
//! ```text
//! φ = (P₁ − P₂, θ₁ + β − θ₂)        (3)  [m, m, rad]
//! γ = (ω₁² ρ₁ − ω₂² ρ₂, 0)
//! ```
//!
//! λ is force and torque of the first body on the second, at the second body's point.

use super::algebra::Algebraic;
use super::revolute::{
    is_of_place, point_bend, point_curvature_pattern, point_entries, point_jacobian,
};
use super::{
    Axis, BodyId, Constraint, Entry, Equations, Kinematics, Marker, Measure, Slope, abreast,
};
use crate::motion::Jet;
use linkdyn_linear::math::{Real, Vec2};
use std::sync::Arc;

/// Two bodies that hold each other at a point.
#[derive(Debug, Clone)]
pub struct Fixed<T = f64> {
    /// The point on the first body.
    pub first: Marker<T>,
    /// The point on the second body.
    pub second: Marker<T>,
    /// β = θ₂ − θ₁ \[rad\].
    pub angle: T,
}

impl<T: Real> Fixed<T> {
    /// The same with what `number` makes of its numbers.
    pub(crate) fn map<U>(&self, number: &mut dyn FnMut(T) -> U) -> Fixed<U> {
        Fixed {
            first: self.first.map(number),
            second: self.second.map(number),
            angle: number(self.angle),
        }
    }
}

impl<T: Real> Equations<T> for Fixed<T> {
    fn position(&self, at: &Kinematics<T>, phi: &mut [T]) {
        let gap = self.first.place(at) - self.second.place(at);
        let turn =
            at.poses[self.first.body.0].theta + self.angle - at.poses[self.second.body.0].theta;
        phi.copy_from_slice(&[gap.x, gap.y, turn]);
    }

    fn jacobian(&self, at: &Kinematics<T>, values: &mut [T]) {
        point_jacobian(at, &self.first, &self.second, &mut values[..8]);
        values[8..].copy_from_slice(&[T::one(), -T::one()]);
    }

    fn rate(&self, _at: &Kinematics<T>, phi_t: &mut [T]) {
        phi_t.fill(T::zero());
    }

    fn gamma(&self, at: &Kinematics<T>, gamma: &mut [T]) {
        let g = self.second.centripetal(at) - self.first.centripetal(at);
        gamma.copy_from_slice(&[g.x, g.y, T::zero()]);
    }
}

impl Constraint for Fixed {
    fn rows(&self) -> &'static [Measure] {
        &[Measure::Length, Measure::Length, Measure::Angle]
    }

    fn entries(&self) -> Vec<Entry> {
        let mut entries = point_entries(&self.first, &self.second);
        entries.extend([
            (2, self.first.body, Axis::Theta),
            (2, self.second.body, Axis::Theta),
        ]);
        entries
    }

    fn curvature_pattern(&self) -> Vec<Slope> {
        point_curvature_pattern(&self.first, &self.second)
    }

    fn bend(&self, at: &Kinematics, lambda: &[f64], values: &mut [f64]) {
        let force = Vec2::new(lambda[0], lambda[1]);
        point_bend(at, (&self.first, &self.second), force, values);
    }

    fn is_linear(&self, row: usize) -> bool {
        row == 2
    }

    fn algebra(&self, _drive: &[Jet]) -> Vec<Algebraic> {
        let mut rows = Algebraic::zero(self.first.form_to(&self.second)).to_vec();
        rows.push(Algebraic::tied(
            self.first.body,
            self.second.body,
            self.angle,
        ));
        rows
    }

    fn reaction(&self, _at: &Kinematics, lambda: &[f64]) -> (Vec2, f64) {
        (Vec2::new(lambda[0], lambda[1]), lambda[2])
    }

    fn is_constant(&self, entry: usize) -> bool {
        entry >= 8 || is_of_place(entry)
    }

    abreast!();

    fn between(&self, id: &dyn Fn(BodyId) -> BodyId) -> Option<Arc<dyn Constraint>> {
        Some(Arc::new(Fixed {
            first: self.first.of(id),
            second: self.second.of(id),
            angle: self.angle,
        }))
    }
}
