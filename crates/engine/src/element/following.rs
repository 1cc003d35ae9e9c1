//! A rigid journal that stays on the surface of its bearing: a constraint, and the friction that goes with its multiplier.
//!
//! Symbols as in [`super::journal`].

use super::journal::{Contact, Journal};
use super::span::{BOTH, Span, all_pairs};
use super::{
    Applied, Axis, Constraint, ConstraintDependentForce, Entry, Kinematics, Marker, Measure, Slope,
    direction,
};
use crate::contact::friction;
use linkdyn_linear::math::{Vec2, perp};

/// A rigid journal on the surface of its bearing.
///
/// ```text
/// φ = |P₂ − P₁| − c                 (1)  [m]
/// J = [−n, −n·ρ₁⊥ | n, n·ρ₂⊥]
/// γ = −n·(−ω₂² ρ₂ + ω₁² ρ₁) − (t·ė)²/d
/// ```
///
/// The multiplier is the normal force N \[N\]: it presses where it is positive.
#[derive(Debug, Clone, Copy)]
pub struct Following {
    /// The bearing's centre.
    pub bearing: Marker,
    /// The journal's centre.
    pub journal: Marker,
    /// c \[m\]
    pub clearance: f64,
}

/// Friction of a rigid journal on the surface that it follows: T along t by the multiplier N, at the contact on both bodies.
#[derive(Debug, Clone)]
pub struct FollowingFriction {
    /// The journal and its bearing.
    pub journal: Journal,
    /// Friction between them.
    pub law: friction::Law,
}

impl ConstraintDependentForce for FollowingFriction {
    fn apply_unit(&self, at: &Kinematics, to: &mut Applied) {
        let reading = self.journal.read(at, &Contact::default());
        self.journal.press(at, &reading, [0.0, 1.0], to);
    }

    fn size(&self, at: &Kinematics, _memory: f64, lambda: &[f64], slope: &mut [f64]) -> f64 {
        let reading = self.journal.read(at, &Contact::default());
        let friction = self.law.force(reading.sliding, lambda[0], 0.0);
        slope[0] = friction.d_normal;
        friction.force
    }

    fn reaction(&self, at: &Kinematics, size: f64) -> (Vec2, f64) {
        let e = self.journal.journal.place(at) - self.journal.bearing.place(at);
        (
            direction(e).map_or(Vec2::zeros(), |(n, _)| perp(n) * size),
            0.0,
        )
    }

    fn memory_scale(&self) -> Option<f64> {
        None
    }

    fn memory_rate(&self, _at: &Kinematics, _memory: f64) -> f64 {
        0.0
    }
}

impl Journal {
    /// The constraint while a rigid journal follows the bearing's surface.
    pub fn following(&self) -> Following {
        Following {
            bearing: self.bearing,
            journal: self.journal,
            clearance: self.clearance,
        }
    }
}

/// Rows and columns of the upper half of a matrix over two bodies.
fn upper() -> impl Iterator<Item = (usize, usize)> {
    (0..BOTH).flat_map(|row| (row..BOTH).map(move |column| (row, column)))
}

impl Following {
    /// n and d.
    fn normal(&self, at: &Kinematics) -> (Vec2, f64) {
        let e = self.journal.place(at) - self.bearing.place(at);
        direction(e).unwrap_or((Vec2::x(), f64::MIN_POSITIVE))
    }
}

impl Constraint for Following {
    fn rows(&self) -> &'static [Measure] {
        &[Measure::Length]
    }

    fn entries(&self) -> Vec<Entry> {
        [self.bearing.body, self.journal.body]
            .into_iter()
            .flat_map(|body| {
                [
                    (0, body, Axis::X),
                    (0, body, Axis::Y),
                    (0, body, Axis::Theta),
                ]
            })
            .collect()
    }

    fn position(&self, at: &Kinematics, phi: &mut [f64]) {
        phi[0] = self.normal(at).1 - self.clearance;
    }

    fn jacobian(&self, at: &Kinematics, values: &mut [f64]) {
        let (n, _) = self.normal(at);
        let turned = |marker: &Marker| n.dot(&perp(marker.rho(at)));
        values.copy_from_slice(&[
            -n.x,
            -n.y,
            -turned(&self.bearing),
            n.x,
            n.y,
            turned(&self.journal),
        ]);
    }

    fn rate(&self, _at: &Kinematics, phi_t: &mut [f64]) {
        phi_t[0] = 0.0;
    }

    fn gamma(&self, at: &Kinematics, gamma: &mut [f64]) {
        let (n, distance) = self.normal(at);
        let across = perp(n).dot(&(self.journal.velocity(at) - self.bearing.velocity(at)));
        let along = n.dot(&(self.journal.centripetal(at) - self.bearing.centripetal(at)));
        gamma[0] = -along - across * across / distance;
    }

    fn bends(&self) -> Vec<Slope> {
        let pairs = all_pairs(&self.bearing, &self.journal);
        upper()
            .map(|(row, column)| pairs[row * BOTH + column])
            .collect()
    }

    fn bend(&self, at: &Kinematics, lambda: &[f64], values: &mut [f64]) {
        let (n, distance) = self.normal(at);
        let span = Span::at(at, &self.bearing, &self.journal);
        let mut block = [0.0; BOTH * BOTH];
        for column in 0..BOTH {
            let moved = span.spread(column);
            let across = (moved - n * n.dot(&moved)) * (lambda[0] / distance);
            span.add_force(across, column, &mut block);
        }
        span.add_turned(n * lambda[0], &mut block);
        for (value, (row, column)) in values.iter_mut().zip(upper()) {
            *value = block[row * BOTH + column];
        }
    }

    fn reaction(&self, at: &Kinematics, lambda: &[f64]) -> (Vec2, f64) {
        (self.normal(at).0 * -lambda[0], 0.0)
    }
}
