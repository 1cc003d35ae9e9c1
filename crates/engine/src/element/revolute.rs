//! Revolute joint: the two points coincide, or keep a prescribed offset (clearance link).
//!
//! ```text
//! φ = P₁ + e(t) − P₂                (2)  [m]      e = 0 for the ideal joint
//! J = [I, ρ₁⊥ | −I, −ρ₂⊥]
//! φ_t = ė
//! γ = ω₁² ρ₁ − ω₂² ρ₂ − ë
//! ```
//!
//! λ is the force of the first body on the second, at the second body's point.
//! With an offset the joint is the massless equivalent clearance link of Earles and Wu (1972): e = journal − bearing.

use super::algebra::Algebraic;
use super::{
    Axis, BodyId, Constraint, Entry, Equations, Kinematics, Marker, Measure, Slope, abreast,
};
use crate::motion::Jet;
use linkdyn_linear::math::{Real, Vec2, Vector};
use std::sync::Arc;

/// Where a joint's prescribed offset stands in [`Kinematics::offset`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct OffsetId(pub u32);

/// Two points that coincide.
#[derive(Debug, Clone)]
pub struct Revolute<T = f64> {
    /// The point on the first body.
    pub first: Marker<T>,
    /// The point on the second body.
    pub second: Marker<T>,
    /// What keeps them apart, where a clearance link does.
    pub offset: Option<OffsetId>,
}

impl<T: Real> Revolute<T> {
    /// The same with what `number` makes of its numbers.
    pub(crate) fn map<U>(&self, number: &mut dyn FnMut(T) -> U) -> Revolute<U> {
        Revolute {
            first: self.first.map(number),
            second: self.second.map(number),
            offset: self.offset,
        }
    }

    fn offset(&self, at: &Kinematics<T>, derivative: usize) -> Vector<T> {
        self.offset
            .map_or(Vector::zeros(), |id| at.offset[id.0 as usize][derivative])
    }
}

/// Entries of "first point − second point" in rows 0 and 1, shared by all joints that hold points together.
pub(super) fn point_entries(first: &Marker, second: &Marker) -> Vec<Entry> {
    let mut entries = Vec::with_capacity(8);
    for marker in [first, second] {
        entries.extend([
            (0, marker.body, Axis::X),
            (0, marker.body, Axis::Theta),
            (1, marker.body, Axis::Y),
            (1, marker.body, Axis::Theta),
        ]);
    }
    entries
}

/// Which of [`point_entries`] are the same everywhere.
pub(super) fn is_of_place(entry: usize) -> bool {
    entry.is_multiple_of(2)
}

/// Values of [`point_entries`].
pub(super) fn point_jacobian<T: Real>(
    at: &Kinematics<T>,
    first: &Marker<T>,
    second: &Marker<T>,
    values: &mut [T],
) {
    let (a, b) = (first.rho(at), second.rho(at));
    let one = T::one();
    values.copy_from_slice(&[one, -a.y, one, a.x, -one, b.y, -one, -b.x]);
}

/// Where points that are held together bend: only by their bodies' angles.
pub(super) fn point_curvature_pattern(first: &Marker, second: &Marker) -> Vec<Slope> {
    [first, second]
        .map(|marker| [(marker.body, Axis::Theta); 2])
        .to_vec()
}

/// Values of [`point_curvature_pattern`].
pub(super) fn point_bend(
    at: &Kinematics,
    (first, second): (&Marker, &Marker),
    force: Vec2,
    values: &mut [f64],
) {
    values.copy_from_slice(&[-first.rho(at).dot(&force), second.rho(at).dot(&force)]);
}

impl<T: Real> Equations<T> for Revolute<T> {
    fn position(&self, at: &Kinematics<T>, phi: &mut [T]) {
        let gap = self.first.place(at) - self.second.place(at) + self.offset(at, 0);
        phi.copy_from_slice(&[gap.x, gap.y]);
    }

    fn jacobian(&self, at: &Kinematics<T>, values: &mut [T]) {
        point_jacobian(at, &self.first, &self.second, values);
    }

    fn rate(&self, at: &Kinematics<T>, phi_t: &mut [T]) {
        let rate = self.offset(at, 1);
        phi_t.copy_from_slice(&[rate.x, rate.y]);
    }

    fn gamma(&self, at: &Kinematics<T>, gamma: &mut [T]) {
        let g = self.second.centripetal(at) - self.first.centripetal(at) - self.offset(at, 2);
        gamma.copy_from_slice(&[g.x, g.y]);
    }
}

impl Constraint for Revolute {
    fn rows(&self) -> &'static [Measure] {
        &[Measure::Length, Measure::Length]
    }

    fn entries(&self) -> Vec<Entry> {
        point_entries(&self.first, &self.second)
    }

    fn curvature_pattern(&self) -> Vec<Slope> {
        point_curvature_pattern(&self.first, &self.second)
    }

    fn bend(&self, at: &Kinematics, lambda: &[f64], values: &mut [f64]) {
        let force = Vec2::new(lambda[0], lambda[1]);
        point_bend(at, (&self.first, &self.second), force, values);
    }

    fn algebra(&self, _drive: &[Jet]) -> Vec<Algebraic> {
        match self.offset {
            None => Algebraic::zero(self.first.form_to(&self.second)).to_vec(),
            Some(_) => Vec::new(),
        }
    }

    fn reaction(&self, _at: &Kinematics, lambda: &[f64]) -> (Vec2, f64) {
        (Vec2::new(lambda[0], lambda[1]), 0.0)
    }

    fn is_constant(&self, entry: usize) -> bool {
        is_of_place(entry)
    }

    abreast!();

    fn between(&self, id: &dyn Fn(BodyId) -> BodyId) -> Option<Arc<dyn Constraint>> {
        // An offset is prescribed from outside.
        let pin = Revolute {
            first: self.first.of(id),
            second: self.second.of(id),
            offset: None,
        };
        self.offset.is_none().then(|| Arc::new(pin) as _)
    }
}
