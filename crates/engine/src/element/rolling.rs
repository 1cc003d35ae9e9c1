//! Rolling: a round body on another, or inside a ring, in contact and without slip.
//!
//! With radii r₁, r₂ about the points P₁, P₂, R = r₁ + r₂ and e(ψ) = (cos ψ, sin ψ) from P₁ to the contact point:
//!
//! ```text
//! φ = P₁ + R e(ψ) − P₂,   R ψ = r₁ θ₁ + r₂ θ₂ − c                      (2)  [m]
//! J = [I, ρ₁⊥ + r₁ e⊥ | −I, −ρ₂⊥ + r₂ e⊥]
//! γ = ω₁² ρ₁ − ω₂² ρ₂ + (r₁ ω₁ + r₂ ω₂)²/R e
//! ```
//!
//! A negative radius is that of a ring, inside which the other body rolls: P₁ + r₁ e = P₂ − r₂ e is the contact point for all
//! signs. There body 1 moves with Ṗ₁ + ω₁ r₁ e⊥ and body 2 with Ṗ₂ − ω₂ r₂ e⊥. They are equal where Ṗ₂ − Ṗ₁ = R ψ̇ e⊥, which is
//! φ̇ = 0. As the angles say where the contact is, no turn of the line of centres has to be counted, and no carrier is needed.
//! (Rolling of pitch circles: Uicker, Pennock and Shigley, Theory of Machines and Mechanisms; the form of φ is ours.)
//!
//! λ is the force of the first body on the second in the contact point, of moment −r₂ e⊥·λ about P₂. The joint holds from both
//! sides: where R e·λ < 0, real bodies without teeth or a band would part.

use super::revolute::{is_of_place, point_entries};
use super::{
    Axis, BodyId, Constraint, Entry, Equations, Kinematics, Marker, Measure, Slope, abreast,
};
use linkdyn_linear::math::{Real, Vec2, Vector, perp};
use std::sync::Arc;

/// Two round bodies that roll on each other.
#[derive(Debug, Clone)]
pub struct Rolling<T = f64> {
    /// Centre of the first body.
    pub first: Marker<T>,
    /// Centre of the second body.
    pub second: Marker<T>,
    /// r₁ and r₂ \[m\]; negative of a ring. Their sum is not zero.
    pub radii: [T; 2],
    /// c \[m\].
    pub offset: T,
}

impl<T: Real> Rolling<T> {
    /// The same with what `number` makes of its numbers.
    pub(crate) fn map<U>(&self, number: &mut dyn FnMut(T) -> U) -> Rolling<U> {
        Rolling {
            first: self.first.map(number),
            second: self.second.map(number),
            radii: self.radii.map(&mut *number),
            offset: number(self.offset),
        }
    }

    fn distance(&self) -> T {
        self.radii[0] + self.radii[1]
    }

    /// r₁ u₁ + r₂ u₂ for two numbers of the bodies.
    fn weighted(&self, number: impl Fn(BodyId) -> T) -> T {
        let [first, second] = [self.first, self.second].map(|marker| number(marker.body));
        self.radii[0] * first + self.radii[1] * second
    }

    /// e(ψ).
    fn direction(&self, at: &Kinematics<T>) -> Vector<T> {
        let turned = self.weighted(|body| at.poses[body.0].theta) - self.offset;
        let (sin, cos) = (turned / self.distance()).simd_sin_cos();
        Vector::new(cos, sin)
    }
}

impl Rolling {
    /// c, with the centres on the line that they are on \[m\].
    pub fn rolled(&self, at: &Kinematics) -> f64 {
        let e = (self.second.place(at) - self.first.place(at)) / self.distance();
        self.weighted(|body| at.poses[body.0].theta) - self.distance() * e.y.atan2(e.x)
    }
}

impl<T: Real> Equations<T> for Rolling<T> {
    fn position(&self, at: &Kinematics<T>, phi: &mut [T]) {
        let span = self.direction(at) * self.distance();
        let gap = self.first.place(at) + span - self.second.place(at);
        phi.copy_from_slice(&[gap.x, gap.y]);
    }

    fn jacobian(&self, at: &Kinematics<T>, values: &mut [T]) {
        let across = perp(self.direction(at));
        let own = perp(self.first.rho(at)) + across * self.radii[0];
        let other = across * self.radii[1] - perp(self.second.rho(at));
        let one = T::one();
        values.copy_from_slice(&[one, own.x, one, own.y, -one, other.x, -one, other.y]);
    }

    fn rate(&self, _at: &Kinematics<T>, phi_t: &mut [T]) {
        phi_t.fill(T::zero());
    }

    fn gamma(&self, at: &Kinematics<T>, gamma: &mut [T]) {
        let speed = self.weighted(|body| at.twists[body.0].omega);
        let inwards = self.direction(at) * (speed * speed / self.distance());
        let g = self.second.centripetal(at) - self.first.centripetal(at) + inwards;
        gamma.copy_from_slice(&[g.x, g.y]);
    }
}

impl Constraint for Rolling {
    fn rows(&self) -> &'static [Measure] {
        &[Measure::Length, Measure::Length]
    }

    fn entries(&self) -> Vec<Entry> {
        point_entries(&self.first, &self.second)
    }

    fn curvature_pattern(&self) -> Vec<Slope> {
        let [own, other] = [self.first, self.second].map(|marker| (marker.body, Axis::Theta));
        vec![[own, own], [own, other], [other, other]]
    }

    fn bend(&self, at: &Kinematics, lambda: &[f64], values: &mut [f64]) {
        let force = Vec2::new(lambda[0], lambda[1]);
        let along = -self.direction(at).dot(&force) / self.distance();
        let [r1, r2] = self.radii;
        values.copy_from_slice(&[
            r1 * r1 * along - self.first.rho(at).dot(&force),
            r1 * r2 * along,
            r2 * r2 * along + self.second.rho(at).dot(&force),
        ]);
    }

    fn is_constant(&self, entry: usize) -> bool {
        is_of_place(entry)
    }

    abreast!();

    fn reaction(&self, at: &Kinematics, lambda: &[f64]) -> (Vec2, f64) {
        let force = Vec2::new(lambda[0], lambda[1]);
        let across = perp(self.direction(at));
        (force, -self.radii[1] * across.dot(&force))
    }

    fn between(&self, id: &dyn Fn(BodyId) -> BodyId) -> Option<Arc<dyn Constraint>> {
        Some(Arc::new(Rolling {
            first: self.first.of(id),
            second: self.second.of(id),
            ..self.clone()
        }))
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::super::tests::{Named, marker};
    use super::*;

    fn rolling(first: Marker, radii: [f64; 2]) -> Box<Rolling> {
        Box::new(Rolling {
            first,
            second: marker(2, -0.4, 0.1),
            radii,
            offset: 0.2,
        })
    }

    /// On a body, and in a ring of the ground.
    pub(in super::super) fn both() -> [Named; 2] {
        [
            ("rolling", rolling(marker(1, 0.3, -0.2), [0.3, 0.5])),
            (
                "rolling in a ring",
                rolling(marker(0, 0.5, 0.4), [-0.9, 0.2]),
            ),
        ]
    }
}
