//! Rack and pinion: a wheel, the first body, rolls on a straight line of the second.
//!
//! With a the unit axis and n = a⊥, both turning with the rack, C the wheel's centre, R the rack's point, d = C − R:
//!
//! ```text
//! φ = a·d + r (θ₁ − θ₂) − c                                            (1)  [m]
//! J = [aᵀ, r − n·ρ₁ | −aᵀ, n·(d + ρ₂) − r]
//! γ = a·(ω₁² ρ₁ − ω₂² ρ₂) − 2 ω₂ n·ḋ + ω₂² a·d
//! ```
//!
//! The pitch point is P = C − r n, on the side of the centre that the sign of r says. A point of the wheel there moves along
//! a with a·Ċ + r ω₁. One of the rack moves with a·Ṙ + ω₂ (r − n·d), for a·(P − R)⊥ = −n·(P − R). Both are the same where
//! φ̇ = 0, for ȧ·d = ω₂ n·d: so (1) is rolling without slip at P whatever the rack and the wheel do, and Jᵀλ is a pair of
//! forces λ a at P, nothing else. (Rolling of pitch lines: Uicker, Pennock and Shigley, Theory of Machines and Mechanisms; the
//! form of φ is ours.)
//!
//! Joints hold the wheel and the rack so that P stays on a line of the rack; where the rack's point is on it, n·d = r.
//! λ a is the force of the wheel on the rack, of moment λ (r − n·d) about its point. Teeth with a pressure angle also press the
//! two apart, along n: no motion or torque depends on it, and it is left out, as with gears.

use super::{
    Axis, BodyId, Constraint, Entry, Equations, Kinematics, Marker, Measure, Slope, abreast, mapped,
};
use linkdyn_linear::math::{Real, Vec2, Vector, perp};
use std::sync::Arc;

/// A wheel that rolls on a line of another body.
#[derive(Debug, Clone)]
pub struct Rack<T = f64> {
    /// Centre of the wheel.
    pub first: Marker<T>,
    /// Point of the rack.
    pub second: Marker<T>,
    /// a in the rack's frame, length one.
    pub axis: Vector<T>,
    /// r \[m\], signed.
    pub radius: T,
    /// c \[m\].
    pub offset: T,
}

impl<T: Real> Rack<T> {
    /// The same with what `number` makes of its numbers.
    pub(crate) fn map<U>(&self, number: &mut dyn FnMut(T) -> U) -> Rack<U> {
        Rack {
            first: self.first.map(number),
            second: self.second.map(number),
            axis: mapped(&self.axis, number),
            radius: number(self.radius),
            offset: number(self.offset),
        }
    }

    /// a, n and d.
    fn directions(&self, at: &Kinematics<T>) -> [Vector<T>; 3] {
        let a = at.poses[self.second.body.0].turn(self.axis);
        [a, perp(a), self.first.place(at) - self.second.place(at)]
    }

    /// n·d, which is r where the pitch line goes through the rack's point \[m\].
    pub fn height(&self, at: &Kinematics<T>) -> T {
        let [_, n, d] = self.directions(at);
        n.dot(&d)
    }

    /// a·d + r (θ₁ − θ₂), which is c \[m\].
    pub fn rolled(&self, at: &Kinematics<T>) -> T {
        let [a, _, d] = self.directions(at);
        let theta = |body: BodyId| at.poses[body.0].theta;
        a.dot(&d) + self.radius * (theta(self.first.body) - theta(self.second.body))
    }
}

impl<T: Real> Equations<T> for Rack<T> {
    fn position(&self, at: &Kinematics<T>, phi: &mut [T]) {
        phi[0] = self.rolled(at) - self.offset;
    }

    fn jacobian(&self, at: &Kinematics<T>, values: &mut [T]) {
        let [a, n, d] = self.directions(at);
        let (rho1, rho2) = (self.first.rho(at), self.second.rho(at));
        values.copy_from_slice(&[
            a.x,
            a.y,
            self.radius - n.dot(&rho1),
            -a.x,
            -a.y,
            n.dot(&(d + rho2)) - self.radius,
        ]);
    }

    fn rate(&self, _at: &Kinematics<T>, phi_t: &mut [T]) {
        phi_t.fill(T::zero());
    }

    fn gamma(&self, at: &Kinematics<T>, gamma: &mut [T]) {
        let [a, n, d] = self.directions(at);
        let omega = self.second.omega(at);
        let d_rate = self.first.velocity(at) - self.second.velocity(at);
        let turn = self.second.centripetal(at) - self.first.centripetal(at);
        gamma[0] =
            a.dot(&turn) - T::splat(2.0) * omega * n.dot(&d_rate) + omega * omega * a.dot(&d);
    }
}

impl Constraint for Rack {
    fn rows(&self) -> &'static [Measure] {
        &[Measure::Length]
    }

    fn entries(&self) -> Vec<Entry> {
        let all = [Axis::X, Axis::Y, Axis::Theta];
        let of = |body: BodyId| all.map(|axis| (0, body, axis));
        [of(self.first.body), of(self.second.body)].concat()
    }

    fn curvature_pattern(&self) -> Vec<Slope> {
        let turn = |body: BodyId| (body, Axis::Theta);
        let (wheel, rack) = (turn(self.first.body), turn(self.second.body));
        let place = |body: BodyId| [Axis::X, Axis::Y].map(|axis| [(body, axis), rack]);
        let mut bends = [place(self.first.body), place(self.second.body)].concat();
        bends.extend([[wheel, wheel], [wheel, rack], [rack, rack]]);
        bends
    }

    fn bend(&self, at: &Kinematics, lambda: &[f64], values: &mut [f64]) {
        let [a, n, d] = self.directions(at).map(|part| part * lambda[0]);
        let along = self.directions(at)[0].dot(&d);
        let (own, other) = (a.dot(&self.first.rho(at)), a.dot(&self.second.rho(at)));
        values.copy_from_slice(&[n.x, n.y, -n.x, -n.y, -own, own, -along - other]);
    }

    abreast!();

    fn reaction(&self, at: &Kinematics, lambda: &[f64]) -> (Vec2, f64) {
        let [a, n, d] = self.directions(at);
        (a * lambda[0], lambda[0] * (self.radius - n.dot(&d)))
    }

    fn between(&self, id: &dyn Fn(BodyId) -> BodyId) -> Option<Arc<dyn Constraint>> {
        Some(Arc::new(Rack {
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

    fn rack(first: Marker, second: Marker) -> Box<Rack> {
        Box::new(Rack {
            first,
            second,
            axis: Vec2::new(0.6, 0.8),
            radius: -0.3,
            offset: 0.2,
        })
    }

    /// On a body, and on the ground.
    pub(in super::super) fn both() -> [Named; 2] {
        let (wheel, bar) = (marker(1, 0.3, -0.2), marker(2, -0.4, 0.1));
        [
            ("rack", rack(wheel, bar)),
            (
                "rack with a wheel on ground",
                rack(marker(0, 0.5, 0.4), bar),
            ),
        ]
    }
}
