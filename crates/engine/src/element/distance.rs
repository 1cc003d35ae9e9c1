//! A driven length: a driver prescribes the distance of two points, as a hydraulic cylinder does.
//!
//! ```text
//! d = P₂ − P₁,  ℓ = |d|,  e = d/ℓ,  n = e⊥
//! φ = f − ℓ                            γ = −f″ + e·(ω₁² ρ₁ − ω₂² ρ₂) + (n·ḋ)²/ℓ             [m]
//! J = [eᵀ, e·ρ₁⊥ | −eᵀ, −e·ρ₂⊥]
//! ```
//!
//! λ e is the force on the second point, −λ e that on the first: the effort pushes the points apart where it is positive.

use super::driven::DriveId;
use super::span::{BOTH, Span, both_bodies, upper_pairs};
use super::{Constraint, Entry, Kinematics, Marker, Measure, Slope, direction};
use linkdyn_linear::math::{Vec2, perp};

/// Two points whose distance is driven.
#[derive(Debug, Clone)]
pub struct Distance {
    /// One end.
    pub first: Marker,
    /// The other end.
    pub second: Marker,
    /// The driver.
    pub drive: DriveId,
}

impl Distance {
    /// e and ℓ; any direction where the points coincide, so that an assembly can part them.
    fn line(&self, at: &Kinematics) -> (Vec2, f64) {
        let d = self.second.place(at) - self.first.place(at);
        direction(d).unwrap_or((Vec2::x(), f64::MIN_POSITIVE))
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

    fn position(&self, at: &Kinematics, phi: &mut [f64]) {
        phi[0] = at.drive[self.drive.0][0] - self.line(at).1;
    }

    fn jacobian(&self, at: &Kinematics, values: &mut [f64]) {
        let (e, _) = self.line(at);
        let span = Span::at(at, &self.first, &self.second);
        for (column, value) in values.iter_mut().enumerate() {
            *value = -e.dot(&span.spread(column));
        }
    }

    fn rate(&self, at: &Kinematics, phi_t: &mut [f64]) {
        phi_t[0] = at.drive[self.drive.0][1];
    }

    fn gamma(&self, at: &Kinematics, gamma: &mut [f64]) {
        let (e, length) = self.line(at);
        let across = perp(e).dot(&(self.second.velocity(at) - self.first.velocity(at)));
        let turn = self.second.centripetal(at) - self.first.centripetal(at);
        gamma[0] = e.dot(&turn) + across * across / length - at.drive[self.drive.0][2];
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
