//! Prismatic joint: the second point stays on a line of the first body, the relative angle β is constant.
//!
//! With u the unit axis and n = u⊥, both turning with the first body, and d = P₂ − P₁:
//!
//! ```text
//! φ  = (−n·d, θ₁ + β − θ₂)                                   (2)  [m, rad]
//! J₁ = [nᵀ, u·(d + ρ₁) | −nᵀ, −u·ρ₂]
//! γ₁ = −ω₁² n·d − 2 ω₁ u·ḋ + n·(ω₁² ρ₁ − ω₂² ρ₂)
//! ```
//!
//! λ₁ n is the force and λ₂ the torque of the first body on the second, at the second body's point.

use super::algebra::Algebraic;
use super::{
    Axis, BodyId, Constraint, Entry, Equations, Kinematics, Marker, Measure, Slope, abreast, mapped,
};
use crate::motion::Jet;
use linkdyn_linear::math::{Real, Vec2, Vector, perp};
use std::sync::Arc;

/// A line fixed in the first body, and a point of the second body.
#[derive(Debug, Clone)]
pub struct Guide<T = f64> {
    /// A point of the guide, on the first body.
    pub first: Marker<T>,
    /// The point that it guides, on the second body.
    pub second: Marker<T>,
    /// Unit vector in the first body's frame.
    pub axis: Vector<T>,
}

/// The guide at an instant.
pub(super) struct Slide<T = f64> {
    /// Direction of the guide.
    pub u: Vector<T>,
    /// Direction across it.
    pub n: Vector<T>,
    /// From the first point to the second \[m\].
    pub d: Vector<T>,
    pub rho1: Vector<T>,
    pub rho2: Vector<T>,
}

impl Guide {
    /// The second point is on the line.
    pub(super) fn on_line(&self) -> Algebraic {
        let way = self.first.form_to(&self.second);
        Algebraic::along(self.first.body, perp(self.axis), way, 0.0)
    }
}

impl<T: Real> Guide<T> {
    /// The same guide between bodies with other numbers.
    pub(super) fn of(&self, id: &dyn Fn(BodyId) -> BodyId) -> Self {
        Guide {
            first: self.first.of(id),
            second: self.second.of(id),
            axis: self.axis,
        }
    }

    /// The same with what `number` makes of its numbers.
    pub(super) fn map<U>(&self, number: &mut dyn FnMut(T) -> U) -> Guide<U> {
        Guide {
            first: self.first.map(number),
            second: self.second.map(number),
            axis: mapped(&self.axis, number),
        }
    }

    pub(super) fn at(&self, at: &Kinematics<T>) -> Slide<T> {
        let u = at.poses[self.first.body.0].turn(self.axis);
        let d = self.second.place(at) - self.first.place(at);
        Slide {
            u,
            n: perp(u),
            d,
            rho1: self.first.rho(at),
            rho2: self.second.rho(at),
        }
    }

    /// u·d, the slide \[m\].
    pub fn slide(&self, at: &Kinematics<T>) -> T {
        let s = self.at(at);
        s.u.dot(&s.d)
    }

    /// φ₁ = −n·d, how far the second point is off the line \[m\].
    pub(super) fn across(&self, at: &Kinematics<T>) -> T {
        let s = self.at(at);
        -s.n.dot(&s.d)
    }

    /// Values of [`Guide::entries`] for φ₁.
    pub(super) fn across_jacobian(&self, at: &Kinematics<T>) -> [T; 6] {
        let Slide {
            u,
            n,
            d,
            rho1,
            rho2,
        } = self.at(at);
        [n.x, n.y, u.dot(&(d + rho1)), -n.x, -n.y, -u.dot(&rho2)]
    }

    /// γ₁ [m/s²].
    pub(super) fn across_gamma(&self, at: &Kinematics<T>) -> T {
        let Slide { u, n, d, .. } = self.at(at);
        let d_rate = self.second.velocity(at) - self.first.velocity(at);
        let omega = self.first.omega(at);
        let turn = self.second.centripetal(at) - self.first.centripetal(at);
        n.dot(&turn) - omega * omega * n.dot(&d) - T::splat(2.0) * omega * u.dot(&d_rate)
    }

    /// Where −n·d and −u·d bend.
    pub(super) fn curvature_pattern(&self) -> [Slope; 7] {
        let (a, b) = (self.first.body, self.second.body);
        let (a_turn, b_turn) = ((a, Axis::Theta), (b, Axis::Theta));
        [
            [(a, Axis::X), a_turn],
            [(a, Axis::Y), a_turn],
            [(b, Axis::X), a_turn],
            [(b, Axis::Y), a_turn],
            [a_turn, a_turn],
            [a_turn, b_turn],
            [b_turn, b_turn],
        ]
    }

    /// Values of [`Guide::bends`] for λ n·d, of a direction n that turns with the first body.
    pub(super) fn bend(&self, at: &Kinematics<T>, n: Vector<T>, lambda: T) -> [T; 7] {
        let Slide { d, rho1, rho2, .. } = self.at(at);
        let turned = perp(n) * lambda;
        let n = n * lambda;
        [
            -turned.x,
            -turned.y,
            turned.x,
            turned.y,
            -n.dot(&(d + rho1)),
            n.dot(&rho2),
            -n.dot(&rho2),
        ]
    }

    pub(super) fn entries(&self, row: usize) -> [Entry; 6] {
        let (a, b) = (self.first.body, self.second.body);
        [
            (row, a, Axis::X),
            (row, a, Axis::Y),
            (row, a, Axis::Theta),
            (row, b, Axis::X),
            (row, b, Axis::Y),
            (row, b, Axis::Theta),
        ]
    }
}

/// A body that slides along a guide without turning.
#[derive(Debug, Clone)]
pub struct Prismatic<T = f64> {
    /// The guide.
    pub guide: Guide<T>,
    /// β = θ₂ − θ₁ \[rad\].
    pub angle: T,
}

impl<T: Real> Prismatic<T> {
    /// The same with what `number` makes of its numbers.
    pub(crate) fn map<U>(&self, number: &mut dyn FnMut(T) -> U) -> Prismatic<U> {
        Prismatic {
            guide: self.guide.map(number),
            angle: number(self.angle),
        }
    }
}

impl<T: Real> Equations<T> for Prismatic<T> {
    fn position(&self, at: &Kinematics<T>, phi: &mut [T]) {
        let theta = |marker: &Marker<T>| at.poses[marker.body.0].theta;
        let turned = theta(&self.guide.first) + self.angle - theta(&self.guide.second);
        phi.copy_from_slice(&[self.guide.across(at), turned]);
    }

    fn jacobian(&self, at: &Kinematics<T>, values: &mut [T]) {
        values[..6].copy_from_slice(&self.guide.across_jacobian(at));
        values[6..].copy_from_slice(&[T::one(), -T::one()]);
    }

    fn rate(&self, _at: &Kinematics<T>, phi_t: &mut [T]) {
        phi_t.fill(T::zero());
    }

    fn gamma(&self, at: &Kinematics<T>, gamma: &mut [T]) {
        gamma.copy_from_slice(&[self.guide.across_gamma(at), T::zero()]);
    }
}

impl Constraint for Prismatic {
    fn rows(&self) -> &'static [Measure] {
        &[Measure::Length, Measure::Angle]
    }

    fn entries(&self) -> Vec<Entry> {
        let mut entries = self.guide.entries(0).to_vec();
        entries.extend([
            (1, self.guide.first.body, Axis::Theta),
            (1, self.guide.second.body, Axis::Theta),
        ]);
        entries
    }

    fn curvature_pattern(&self) -> Vec<Slope> {
        self.guide.curvature_pattern().to_vec()
    }

    fn bend(&self, at: &Kinematics, lambda: &[f64], values: &mut [f64]) {
        let n = self.guide.at(at).n;
        values.copy_from_slice(&self.guide.bend(at, n, -lambda[0]));
    }

    fn is_linear(&self, row: usize) -> bool {
        row == 1
    }

    fn algebra(&self, _drive: &[Jet]) -> Vec<Algebraic> {
        let [first, second] = [self.guide.first.body, self.guide.second.body];
        vec![
            self.guide.on_line(),
            Algebraic::tied(first, second, self.angle),
        ]
    }

    fn reaction(&self, at: &Kinematics, lambda: &[f64]) -> (Vec2, f64) {
        (self.guide.at(at).n * lambda[0], lambda[1])
    }

    fn is_constant(&self, entry: usize) -> bool {
        entry >= 6
    }

    abreast!();

    fn between(&self, id: &dyn Fn(BodyId) -> BodyId) -> Option<Arc<dyn Constraint>> {
        Some(Arc::new(Prismatic {
            guide: self.guide.of(id),
            angle: self.angle,
        }))
    }
}
