//! Spring–damper along the line of two points.
//!
//! ```text
//! d = P₂ − P₁,  l = |d|,  u = d/l,  l̇ = u·ḋ
//! S = k (l − l₀) + c l̇                 [N], pulls the points together
//! force on the first body +S u, on the second −S u;   V = ½ k (l − l₀)²
//! ∂(S u) = u (k u·∂d + c (u·∂ḋ + ḋ·P ∂d/l)) + S P ∂d/l,   P = I − u uᵀ
//! ```

use super::span::{BOTH, Span, all_pairs};
use super::{Applied, Force, Kinematics, Marker, Slope, direction};
use crate::motion::Law;

/// A spring and damper between two points.
#[derive(Debug, Clone)]
pub struct Spring {
    /// One end.
    pub first: Marker,
    /// The other end.
    pub second: Marker,
    /// k [N/m]
    pub stiffness: f64,
    /// c [N·s/m]
    pub damping: f64,
    /// l₀ \[m\]
    pub free_length: Law,
}

impl Force for Spring {
    fn apply(&self, at: &Kinematics, to: &mut Applied) {
        let [first, second] = [self.first.body, self.second.body];
        let (one, other) = (&at.poses[first.0], &at.poses[second.0]);
        let (rho, other_rho) = (one.turn(self.first.s), other.turn(self.second.s));
        // Points that coincide have no line: the pull has no direction there and is left out.
        let Some((u, length)) = direction((other.r + other_rho) - (one.r + rho)) else {
            return;
        };
        let mut pull = self.stiffness * (length - self.free_length.value(at.time));
        // Most springs have no damper.
        if self.damping != 0.0 {
            pull += self.damping * u.dot(&(self.second.velocity(at) - self.first.velocity(at)));
        }
        to.add_beside(first, rho, u * pull);
        to.add_beside(second, other_rho, u * -pull);
    }

    fn slopes(&self) -> Vec<Slope> {
        all_pairs(&self.first, &self.second)
    }

    fn slope(&self, at: &Kinematics, position: &mut [f64], velocity: &mut [f64]) {
        position.fill(0.0);
        velocity.fill(0.0);
        let d = self.second.place(at) - self.first.place(at);
        let Some((u, length)) = direction(d) else {
            return;
        };
        let d_rate = self.second.velocity(at) - self.first.velocity(at);
        let stretch = length - self.free_length.value(at.time);
        let pull = self.stiffness * stretch + self.damping * u.dot(&d_rate);
        let span = Span::at(at, &self.first, &self.second);
        for column in 0..BOTH {
            let (moved, turned) = (span.spread(column), span.turn(column));
            let across = (moved - u * u.dot(&moved)) / length;
            let along = self.stiffness * u.dot(&moved)
                + self.damping * (u.dot(&turned) + d_rate.dot(&across));
            span.add_force(-(u * along + across * pull), column, position);
            let damped = u * (-self.damping * u.dot(&moved));
            span.add_force(damped, column, velocity);
        }
        span.add_turned(u * -pull, position);
    }

    fn potential(&self, at: &Kinematics) -> f64 {
        let length = (self.second.place(at) - self.first.place(at)).norm();
        let stretch = length - self.free_length.value(at.time);
        0.5 * self.stiffness * stretch * stretch
    }

    fn is_conservative(&self) -> bool {
        self.damping == 0.0 && self.free_length.is_constant()
    }

    fn supplied(&self, at: &Kinematics) -> f64 {
        let d = self.second.place(at) - self.first.place(at);
        let Some((u, length)) = direction(d) else {
            return 0.0;
        };
        let rate = u.dot(&(self.second.velocity(at) - self.first.velocity(at)));
        let free = self.free_length.jet(at.time);
        -self.damping * rate * rate - self.stiffness * (length - free[0]) * free[1]
    }
}
