//! A driven length: a driver prescribes the distance of two points, as a hydraulic cylinder does.
//!
//! ```text
//! d = P₂ − P₁,  ℓ = |d|,  e = d/ℓ,  n = e⊥
//! φ = f − ℓ                            γ = −f″ + e·(ω₁² ρ₁ − ω₂² ρ₂) + (n·ḋ)²/ℓ             [m]
//! J = [eᵀ, e·ρ₁⊥ | −eᵀ, −e·ρ₂⊥]
//! ```
//!
//! λ e is the force on the second point, −λ e that on the first: the effort pushes the points apart where it is positive.

use super::algebra::Algebraic;
use super::driven::DriveId;
use super::span::{BOTH, Span, both_bodies, upper_pairs};
use super::{Constraint, Entry, Equations, Kinematics, Marker, Measure, Slope, abreast};
use crate::motion::Jet;
use linkdyn_linear::math::{Real, Vec2, Vector, perp};

/// Two points whose distance is driven.
#[derive(Debug, Clone)]
pub struct Distance<T = f64> {
    /// One end.
    pub first: Marker<T>,
    /// The other end.
    pub second: Marker<T>,
    /// The driver.
    pub drive: DriveId,
}

impl<T: Real> Distance<T> {
    /// The same with what `number` makes of its numbers.
    pub(crate) fn map<U>(&self, number: &mut dyn FnMut(T) -> U) -> Distance<U> {
        Distance {
            first: self.first.map(number),
            second: self.second.map(number),
            drive: self.drive,
        }
    }

    /// e and ℓ; any direction where the points coincide, so that an assembly can part them.
    fn line(&self, at: &Kinematics<T>) -> (Vector<T>, T) {
        let d = self.second.place(at) - self.first.place(at);
        let (length, least) = (d.norm(), T::splat(f64::MIN_POSITIVE));
        let is_apart = length.simd_gt(least);
        let e = Vector::new(
            (d.x / length).select(is_apart, T::one()),
            (d.y / length).select(is_apart, T::zero()),
        );
        (e, length.select(is_apart, least))
    }
}

impl<T: Real> Equations<T> for Distance<T> {
    fn position(&self, at: &Kinematics<T>, phi: &mut [T]) {
        phi[0] = at.drive[self.drive.0][0] - self.line(at).1;
    }

    fn jacobian(&self, at: &Kinematics<T>, values: &mut [T]) {
        let (e, _) = self.line(at);
        let turn = |marker: &Marker<T>| e.dot(&perp(marker.rho(at)));
        let (first, second) = (turn(&self.first), turn(&self.second));
        values.copy_from_slice(&[e.x, e.y, first, -e.x, -e.y, -second]);
    }

    fn rate(&self, at: &Kinematics<T>, phi_t: &mut [T]) {
        phi_t[0] = at.drive[self.drive.0][1];
    }

    fn gamma(&self, at: &Kinematics<T>, gamma: &mut [T]) {
        let (e, length) = self.line(at);
        let across = perp(e).dot(&(self.second.velocity(at) - self.first.velocity(at)));
        let turn = self.second.centripetal(at) - self.first.centripetal(at);
        gamma[0] = e.dot(&turn) + across * across / length - at.drive[self.drive.0][2];
    }
}

impl Constraint for Distance {
    fn rows(&self) -> &'static [Measure] {
        &[Measure::Length]
    }

    fn entries(&self) -> Vec<Entry> {
        let both = both_bodies(&self.first, &self.second).into_iter();
        both.map(|(body, axis)| (0, body, axis)).collect()
    }

    fn curvature_pattern(&self) -> Vec<Slope> {
        upper_pairs(&self.first, &self.second)
    }

    fn bend(&self, at: &Kinematics, lambda: &[f64], values: &mut [f64]) {
        let (e, length) = self.line(at);
        let n = perp(e);
        let span = Span::at(at, &self.first, &self.second);
        let second = span.bent(-e, |by| n * (-n.dot(&by) / length));
        let mut place = 0;
        for row in 0..BOTH {
            for value in &second[row][row..] {
                values[place] = lambda[0] * value;
                place += 1;
            }
        }
    }

    abreast!();

    fn algebra(&self, drive: &[Jet]) -> Vec<Algebraic> {
        let span = self.first.form_to(&self.second);
        vec![Algebraic::Length(span, drive[self.drive.0][0])]
    }

    fn reaction(&self, at: &Kinematics, lambda: &[f64]) -> (Vec2, f64) {
        (self.line(at).0 * lambda[0], 0.0)
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::super::tests::{Named, marker};
    use super::*;

    /// Between two bodies, and to the ground.
    pub(in super::super) fn both() -> [Named; 2] {
        let (second, drive) = (marker(2, -0.4, 0.1), DriveId(0));
        let of = |first: Marker| {
            Box::new(Distance {
                first,
                second,
                drive,
            })
        };
        [
            ("length", of(marker(1, 0.3, -0.2))),
            ("length to ground", of(marker(0, 1.5, 0.7))),
        ]
    }
}
