//! Bushing: a pin in rubber, which yields in all directions of the plane.
//!
//! ```text
//! e = A₁ᵀ (P₂ − P₁)          the second point in the frame of the first body [m]
//! F = −A₁ (K e + C ė)        on the second body at its point, −F on the first at the same place [N]
//! T = −k (θ₂ − θ₁ − β₀) − c (ω₂ − ω₁)                on the second body, −T on the first [N·m]
//! Q = Wᵀ F + [−T, T] by θ    W = A₁ ∂e/∂q = B − [0, 0, d⊥ | 0]       d = P₂ − P₁, B of [`super::span`]
//! V = ½ eᵀ K e + ½ k (θ₂ − θ₁ − β₀)²
//! ```
//!
//! K and C are diagonal in the axes of the first body. Q = −(∂V/∂q)ᵀ where nothing is damped, so that the moment of F on the
//! first body has the arm d, too: forces are opposite, equal and in one line, and angular momentum stays. With r = ḋ − ω₁ d⊥,
//! which is A₁ ė:
//!
//! ```text
//! ∂F/∂q = F⊥ [θ₁] − A₁ (K A₁ᵀ W + C A₁ᵀ (D − ω₁ B⊥ − r⊥ [θ₁]))        ∂F/∂v = −A₁ C A₁ᵀ W
//! ∂Q/∂q = Wᵀ ∂F/∂q + diag(0, 0, ρ₁·F | 0, 0, −ρ₂·F) − (B⊥·F in the row of θ₁)
//! ```
//!
//! The element is the plane form of the linear bushing of multibody programs (Blundell and Harty, The Multibody Systems Approach
//! to Vehicle Dynamics, 2004, ch. 3: force components along the axes of one body); derivatives ours.

use super::span::{BOTH, Span, all_pairs};
use super::{Applied, Force, Kinematics, Marker, Slope};
use linkdyn_linear::math::{Vec2, perp};

/// A pin in rubber.
#[derive(Debug, Clone, Copy)]
pub struct Bushing {
    /// The point of the body in whose axes stiffness and damping are given.
    pub first: Marker,
    /// The point of the other body.
    pub second: Marker,
    /// Diagonal of K [N/m].
    pub stiffness: Vec2,
    /// Diagonal of C [N·s/m].
    pub damping: Vec2,
    /// k [N·m/rad] and c [N·m·s/rad].
    pub torsion: [f64; 2],
    /// β₀ \[rad\]
    pub free_angle: f64,
}

/// Where the points are.
struct Separation {
    /// d \[m\]
    apart: Vec2,
    /// ḋ − ω₁ d⊥ [m/s]
    rate: Vec2,
    /// F \[N\]
    force: Vec2,
}

impl Bushing {
    /// A₁ G A₁ᵀ a of a diagonal G.
    fn along_axes(&self, at: &Kinematics, diagonal: Vec2, a: Vec2) -> Vec2 {
        let pose = &at.poses[self.first.body.0];
        let x = pose.turn(Vec2::x());
        x * (diagonal.x * x.dot(&a)) + perp(x) * (diagonal.y * perp(x).dot(&a))
    }

    fn place(&self, at: &Kinematics) -> Separation {
        let apart = self.second.place(at) - self.first.place(at);
        let omega = self.first.omega(at);
        let rate = self.second.velocity(at) - self.first.velocity(at) - perp(apart) * omega;
        let elastic = self.along_axes(at, self.stiffness, apart);
        Separation {
            apart,
            rate,
            force: -elastic - self.along_axes(at, self.damping, rate),
        }
    }

    /// θ₂ − θ₁ − β₀ \[rad\] and its rate.
    fn twist(&self, at: &Kinematics) -> [f64; 2] {
        let angle = |marker: &Marker| at.poses[marker.body.0].theta;
        [
            angle(&self.second) - angle(&self.first) - self.free_angle,
            self.second.omega(at) - self.first.omega(at),
        ]
    }

    /// Force at its point \[N\] and torque [N·m] on the second body.
    pub fn wrench(&self, at: &Kinematics) -> (Vec2, f64) {
        let [twist, rate] = self.twist(at);
        let [k, c] = self.torsion;
        (self.place(at).force, -k * twist - c * rate)
    }
}

impl Force for Bushing {
    fn apply(&self, at: &Kinematics, to: &mut Applied) {
        let (force, torque) = self.wrench(at);
        to.add_force(at, &self.second, force);
        to.add(self.second.body, Vec2::zeros(), torque);
        let apart = self.second.place(at) - self.first.place(at);
        to.add_force(at, &self.first, -force);
        let moment = -perp(apart).dot(&force);
        to.add(self.first.body, Vec2::zeros(), moment - torque);
    }

    fn slopes(&self) -> Vec<Slope> {
        all_pairs(&self.first, &self.second)
    }

    fn slope(&self, at: &Kinematics, position: &mut [f64], velocity: &mut [f64]) {
        position.fill(0.0);
        velocity.fill(0.0);
        let span = Span::at(at, &self.first, &self.second);
        let Separation { apart, rate, force } = self.place(at);
        let omega = self.first.omega(at);
        let across = |column: usize| match column {
            2 => perp(apart),
            _ => Vec2::zeros(),
        };
        let seen = |column: usize| span.spread(column) - across(column);
        for column in 0..BOTH {
            let spread = span.spread(column);
            let mut turned = span.turn(column) - perp(spread) * omega;
            let mut change = Vec2::zeros();
            if column == 2 {
                turned -= perp(rate);
                change = perp(force);
            }
            change -= self.along_axes(at, self.stiffness, seen(column));
            change -= self.along_axes(at, self.damping, turned);
            let damped = -self.along_axes(at, self.damping, seen(column));
            for row in 0..BOTH {
                position[row * BOTH + column] += seen(row).dot(&change);
                velocity[row * BOTH + column] += seen(row).dot(&damped);
            }
            position[2 * BOTH + column] -= perp(spread).dot(&force);
        }
        span.add_turned(force, position);
        for (to, by) in [position, velocity].into_iter().zip(self.torsion) {
            for (row, column, sign) in [(2, 2, -1.0), (2, 5, 1.0), (5, 2, 1.0), (5, 5, -1.0)] {
                to[row * BOTH + column] += sign * by;
            }
        }
    }

    fn potential(&self, at: &Kinematics) -> f64 {
        let apart = self.second.place(at) - self.first.place(at);
        let [twist, _] = self.twist(at);
        let stretched = apart.dot(&self.along_axes(at, self.stiffness, apart));
        0.5 * (stretched + self.torsion[0] * twist * twist)
    }

    fn is_conservative(&self) -> bool {
        self.damping == Vec2::zeros() && self.torsion[1] == 0.0
    }

    fn supplied(&self, at: &Kinematics) -> f64 {
        let rate = self.place(at).rate;
        let [_, spin] = self.twist(at);
        -rate.dot(&self.along_axes(at, self.damping, rate)) - self.torsion[1] * spin * spin
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::element::tests::marker;

    /// One with other numbers along each axis, for checks by differences.
    pub(in crate::element) fn bushing(first: usize) -> Bushing {
        Bushing {
            first: marker(first, 0.3, -0.2),
            second: marker(2, -0.4, 0.1),
            stiffness: Vec2::new(12.0, 5.0),
            damping: Vec2::new(0.7, 1.9),
            torsion: [3.0, 0.4],
            free_angle: 0.2,
        }
    }
}
