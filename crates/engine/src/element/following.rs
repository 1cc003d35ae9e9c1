//! A rigid journal that stays on the surface of its bearing: it slides there, with friction by the multiplier of a constraint, or
//! it sticks and rolls, which is a second constraint.
//!
//! Symbols as in [`super::journal`], and φ_e the angle of e. On the surface δ = 0, and the arms R_b and r = R_b − c are constant.

use super::journal::Journal;
use super::span::{BOTH, Span, all_pairs};
use super::touch::ContactId;
use super::{
    Axis, BodyId, Constraint, Entry, Equations, Kinematics, Marker, Measure, Slope, direction,
};
use linkdyn_linear::math::{Vec2, perp};
use std::f64::consts::{PI, TAU};

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

/// A rigid journal that sticks to the surface of its bearing.
///
/// ```text
/// φ = [ |P₂ − P₁| − c ]                       (2)  [m]
///     [ A − (c φ_e + r θ₂ − R_b θ₁) ]         v_t = d(c φ_e + r θ₂ − R_b θ₁)/dt on the surface
/// γ₂ = (c/d) (t·(−ω₂² ρ₂ + ω₁² ρ₁) − 2 (t·ė)(n·ė)/d)
/// ```
///
/// No sliding is a holonomic constraint: what it keeps, A, is the anchor of [`Contact`](super::touch::Contact), of the instant at which sliding ended. The
/// multipliers are N and T \[N\]. Friction holds the journal while |T| ≤ μ N.
#[derive(Debug, Clone, Copy)]
pub struct Sticking {
    /// The journal on the surface.
    pub following: Following,
    /// R_b \[m\]
    pub bearing_radius: f64,
    /// Whose anchor it is.
    pub id: ContactId,
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

    /// The constraints while it sticks there.
    pub fn sticking(&self, id: ContactId) -> Sticking {
        self.following().stuck(self.bearing_radius, id)
    }
}

/// Rows and columns of the upper half of a matrix over two bodies.
fn upper() -> impl Iterator<Item = (usize, usize)> {
    (0..BOTH).flat_map(|row| (row..BOTH).map(move |column| (row, column)))
}

impl Following {
    /// The constraints of one that sticks.
    pub fn stuck(self, bearing_radius: f64, id: ContactId) -> Sticking {
        Sticking {
            following: self,
            bearing_radius,
            id,
        }
    }

    /// n and d.
    fn normal(&self, at: &Kinematics) -> (Vec2, f64) {
        let e = self.journal.place(at) - self.bearing.place(at);
        // As `Journal::side`.
        let side = 1.0_f64.copysign(self.clearance);
        direction(e).map_or((Vec2::x(), f64::MIN_POSITIVE), |(n, distance)| {
            (n * side, distance * side)
        })
    }
}

impl Equations for Following {
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

    fn curvature_pattern(&self) -> Vec<Slope> {
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

impl Sticking {
    /// c φ_e + r θ₂ − R_b θ₁ at an instant \[m\], with the angle φ_e of e within half a turn.
    pub fn rolled(&self, at: &Kinematics) -> f64 {
        self.following.clearance * self.angle(at) - self.turned(at)
    }

    /// φ_e, −π to π \[rad\].
    fn angle(&self, at: &Kinematics) -> f64 {
        let (n, _) = self.following.normal(at);
        n.y.atan2(n.x)
    }

    /// R_b θ₁ − r θ₂ \[m\].
    fn turned(&self, at: &Kinematics) -> f64 {
        let angle = |body: BodyId| at.poses[body.0].theta;
        let [bearing, journal] = [self.following.bearing, self.following.journal];
        self.bearing_radius * angle(bearing.body) - self.journal_radius() * angle(journal.body)
    }

    /// r \[m\]
    fn journal_radius(&self) -> f64 {
        self.bearing_radius - self.following.clearance
    }
}

impl Equations for Sticking {
    fn position(&self, at: &Kinematics, phi: &mut [f64]) {
        let c = self.following.clearance;
        self.following.position(at, &mut phi[..1]);
        // Of all turns of e the one that is nearest to what the bodies' angles say.
        let wanted = (at.contacts[self.id.0].anchor + self.turned(at)) / c;
        let off = (wanted - self.angle(at)).rem_euclid(TAU);
        phi[1] = c * if off > PI { off - TAU } else { off };
    }

    fn jacobian(&self, at: &Kinematics, values: &mut [f64]) {
        let (first, second) = values.split_at_mut(BOTH);
        self.following.jacobian(at, first);
        let (n, distance) = self.following.normal(at);
        let across = perp(n) * (-self.following.clearance / distance);
        let span = Span::at(at, &self.following.bearing, &self.following.journal);
        for (column, value) in second.iter_mut().enumerate() {
            *value = across.dot(&span.spread(column));
        }
        second[2] += self.bearing_radius;
        second[5] -= self.journal_radius();
    }

    fn rate(&self, _at: &Kinematics, phi_t: &mut [f64]) {
        phi_t.fill(0.0);
    }

    fn gamma(&self, at: &Kinematics, gamma: &mut [f64]) {
        let Following {
            bearing,
            journal,
            clearance,
        } = &self.following;
        self.following.gamma(at, &mut gamma[..1]);
        let (n, distance) = self.following.normal(at);
        let t = perp(n);
        let e_rate = journal.velocity(at) - bearing.velocity(at);
        let along = t.dot(&(journal.centripetal(at) - bearing.centripetal(at)));
        let turning = 2.0 * t.dot(&e_rate) * n.dot(&e_rate) / distance;
        gamma[1] = clearance / distance * (along - turning);
    }
}

impl Constraint for Sticking {
    fn rows(&self) -> &'static [Measure] {
        &[Measure::Length, Measure::Length]
    }

    fn entries(&self) -> Vec<Entry> {
        let first = self.following.entries();
        let second = first.iter().map(|&(_, body, axis)| (1, body, axis));
        first.iter().copied().chain(second).collect()
    }

    fn curvature_pattern(&self) -> Vec<Slope> {
        self.following.curvature_pattern()
    }

    fn bend(&self, at: &Kinematics, lambda: &[f64], values: &mut [f64]) {
        self.following.bend(at, &lambda[..1], values);
        let Following {
            bearing,
            journal,
            clearance,
        } = &self.following;
        let (n, distance) = self.following.normal(at);
        let t = perp(n);
        let span = Span::at(at, bearing, journal);
        // Of −c T ∂φ_e/∂e = −c T t/d.
        let size = -clearance * lambda[1] / distance;
        let mut block = [0.0; BOTH * BOTH];
        for column in 0..BOTH {
            let moved = span.spread(column) / distance;
            let turned = (n * t.dot(&moved) + t * n.dot(&moved)) * -size;
            span.add_force(turned, column, &mut block);
        }
        span.add_turned(t * size, &mut block);
        for (value, (row, column)) in values.iter_mut().zip(upper()) {
            *value += block[row * BOTH + column];
        }
    }

    fn reaction(&self, at: &Kinematics, lambda: &[f64]) -> (Vec2, f64) {
        let (n, distance) = self.following.normal(at);
        let along = perp(n) * (lambda[1] * self.following.clearance / distance);
        (along - n * lambda[0], self.journal_radius() * lambda[1])
    }
}
