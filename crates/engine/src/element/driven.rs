//! Drivers: a prescribed angle or slide.
//!
//! ```text
//! rotation      φ = θ_rel + f − θ_body          γ = −f″                       [rad]
//! translation   φ = f − u·d                     γ = −f″ + u·(ω₁² ρ₁ − ω₂² ρ₂) + 2 ω₁ n·ḋ − ω₁² u·d    [m]
//! ```
//!
//! with u, n, d of the guide (see `prismatic`); φ_t = f′. λ is the effort: torque on the body, or force on the second
//! body along u.

use super::algebra::Algebraic;
use super::prismatic::{Guide, Slide};
use super::{Axis, BodyId, Constraint, Entry, Equations, Kinematics, Measure, Slope, abreast};
use crate::motion::Jet;
use linkdyn_linear::math::{Real, Vec2};

/// Where a driver's value stands in [`Kinematics::drive`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct DriveId(pub usize);

/// A body turned by a driver.
#[derive(Debug, Clone)]
pub struct Rotation {
    /// The body that is turned.
    pub body: BodyId,
    /// The body from which the angle is counted.
    pub relative_to: BodyId,
    /// The driver.
    pub drive: DriveId,
}

impl Rotation {
    /// The same: it has no numbers.
    fn map<T, U>(&self, _number: &mut dyn FnMut(T) -> U) -> Self {
        self.clone()
    }
}

impl<T: Real> Equations<T> for Rotation {
    fn position(&self, at: &Kinematics<T>, phi: &mut [T]) {
        phi[0] = at.poses[self.relative_to.0].theta + at.drive[self.drive.0][0]
            - at.poses[self.body.0].theta;
    }

    fn jacobian(&self, _at: &Kinematics<T>, values: &mut [T]) {
        values.copy_from_slice(&[T::one(), -T::one()]);
    }

    fn rate(&self, at: &Kinematics<T>, phi_t: &mut [T]) {
        phi_t[0] = at.drive[self.drive.0][1];
    }

    fn gamma(&self, at: &Kinematics<T>, gamma: &mut [T]) {
        gamma[0] = -at.drive[self.drive.0][2];
    }
}

impl Constraint for Rotation {
    fn rows(&self) -> &'static [Measure] {
        &[Measure::Angle]
    }

    fn entries(&self) -> Vec<Entry> {
        vec![
            (0, self.relative_to, Axis::Theta),
            (0, self.body, Axis::Theta),
        ]
    }

    fn is_constant(&self, _entry: usize) -> bool {
        true
    }

    abreast!();

    fn algebra(&self, drive: &[Jet]) -> Vec<Algebraic> {
        let angle = drive[self.drive.0][0];
        vec![Algebraic::tied(self.relative_to, self.body, angle)]
    }

    fn reaction(&self, _at: &Kinematics, lambda: &[f64]) -> (Vec2, f64) {
        (Vec2::zeros(), lambda[0])
    }
}

/// A guide moved along by a driver.
#[derive(Debug, Clone)]
pub struct Translation<T = f64> {
    /// The guide.
    pub guide: Guide<T>,
    /// The driver.
    pub drive: DriveId,
}

impl<T: Real> Translation<T> {
    /// The same with what `number` makes of its numbers.
    pub(crate) fn map<U>(&self, number: &mut dyn FnMut(T) -> U) -> Translation<U> {
        Translation {
            guide: self.guide.map(number),
            drive: self.drive,
        }
    }
}

impl<T: Real> Equations<T> for Translation<T> {
    fn position(&self, at: &Kinematics<T>, phi: &mut [T]) {
        phi[0] = at.drive[self.drive.0][0] - self.guide.slide(at);
    }

    fn jacobian(&self, at: &Kinematics<T>, values: &mut [T]) {
        let Slide {
            u,
            n,
            d,
            rho1,
            rho2,
        } = self.guide.at(at);
        values.copy_from_slice(&[u.x, u.y, -n.dot(&(d + rho1)), -u.x, -u.y, n.dot(&rho2)]);
    }

    fn rate(&self, at: &Kinematics<T>, phi_t: &mut [T]) {
        phi_t[0] = at.drive[self.drive.0][1];
    }

    fn gamma(&self, at: &Kinematics<T>, gamma: &mut [T]) {
        let Slide { u, n, d, .. } = self.guide.at(at);
        let d_rate = self.guide.second.velocity(at) - self.guide.first.velocity(at);
        let omega = self.guide.first.omega(at);
        let turn = self.guide.second.centripetal(at) - self.guide.first.centripetal(at);
        gamma[0] = u.dot(&turn) + T::splat(2.0) * omega * n.dot(&d_rate)
            - omega * omega * u.dot(&d)
            - at.drive[self.drive.0][2];
    }
}

impl Constraint for Translation {
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
        let n = self.guide.at(at).u;
        values.copy_from_slice(&self.guide.bend(at, n, -lambda[0]));
    }

    abreast!();

    fn algebra(&self, drive: &[Jet]) -> Vec<Algebraic> {
        let Guide {
            first,
            second,
            axis,
        } = &self.guide;
        let slide = drive[self.drive.0][0];
        vec![Algebraic::along(
            first.body,
            *axis,
            first.form_to(second),
            slide,
        )]
    }

    fn reaction(&self, at: &Kinematics, lambda: &[f64]) -> (Vec2, f64) {
        (self.guide.at(at).u * lambda[0], 0.0)
    }
}
