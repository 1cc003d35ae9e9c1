//! Torsion spring–damper between two bodies.
//!
//! ```text
//! T = k (θ₂ − θ₁ − β₀) + c (ω₂ − ω₁)    [N·m] on the first body, −T on the second;   V = ½ k (θ₂ − θ₁ − β₀)²
//! ```

use super::{Applied, Axis, BodyId, Force, Kinematics, Slope};
use crate::motion::Law;
use linkdyn_linear::math::Vec2;

/// A spring and damper between two bodies.
#[derive(Debug, Clone)]
pub struct TorsionSpring {
    /// One end.
    pub first: BodyId,
    /// The other end.
    pub second: BodyId,
    /// k [N·m/rad]
    pub stiffness: f64,
    /// c [N·m·s/rad]
    pub damping: f64,
    /// β₀ \[rad\]
    pub free_angle: Law,
}

impl TorsionSpring {
    /// ω₂ − ω₁ [rad/s].
    fn rate(&self, at: &Kinematics) -> f64 {
        at.twists[self.second.0].omega - at.twists[self.first.0].omega
    }

    /// From the free angle \[rad\].
    fn twist(&self, at: &Kinematics) -> f64 {
        at.poses[self.second.0].theta
            - at.poses[self.first.0].theta
            - self.free_angle.value(at.time)
    }
}

impl Force for TorsionSpring {
    fn apply(&self, at: &Kinematics, to: &mut Applied) {
        let torque = self.stiffness * self.twist(at) + self.damping * self.rate(at);
        to.add(self.first, Vec2::zeros(), torque);
        to.add(self.second, Vec2::zeros(), -torque);
    }

    fn slopes(&self) -> Vec<Slope> {
        let [a, b] = [self.first, self.second].map(|body| (body, Axis::Theta));
        vec![[a, a], [a, b], [b, a], [b, b]]
    }

    fn slope(&self, _at: &Kinematics, position: &mut [f64], velocity: &mut [f64]) {
        let block = |by: f64| [-by, by, by, -by];
        position.copy_from_slice(&block(self.stiffness));
        velocity.copy_from_slice(&block(self.damping));
    }

    fn potential(&self, at: &Kinematics) -> f64 {
        let twist = self.twist(at);
        0.5 * self.stiffness * twist * twist
    }

    fn is_conservative(&self) -> bool {
        self.damping == 0.0 && self.free_angle.is_constant()
    }

    fn supplied(&self, at: &Kinematics) -> f64 {
        let rate = self.rate(at);
        -self.damping * rate * rate
            - self.stiffness * self.twist(at) * self.free_angle.jet(at.time)[1]
    }
}
