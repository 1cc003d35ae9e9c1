//! Given loads: a force at a point (vector in the ground's or the body's frame), and a torque.
//!
//! ```text
//! force   F = (F_x(t), F_y(t)) or A F      [N] at the point
//! torque  T(t) on the body, −T on the other  [N·m]
//! ```

use super::{Applied, Axis, BodyId, Force, Kinematics, Marker, Slope};
use crate::motion::Law;
use linkdyn_linear::math::{Vec2, perp};

/// A force at a point.
#[derive(Debug, Clone)]
pub struct PointLoad {
    /// The point.
    pub at: Marker,
    /// Components \[N\].
    pub vector: [Law; 2],
    /// The vector turns with the body.
    pub follows_body: bool,
}

impl PointLoad {
    /// In the ground frame \[N\].
    fn force(&self, at: &Kinematics) -> Vec2 {
        let given = Vec2::new(
            self.vector[0].jet(at.time)[0],
            self.vector[1].jet(at.time)[0],
        );
        if self.follows_body {
            at.poses[self.at.body.0].turn(given)
        } else {
            given
        }
    }
}

impl Force for PointLoad {
    fn apply(&self, at: &Kinematics, to: &mut Applied) {
        to.add_force(at, &self.at, self.force(at));
    }

    fn slopes(&self) -> Vec<Slope> {
        let theta = (self.at.body, Axis::Theta);
        Axis::ALL.map(|axis| [(self.at.body, axis), theta]).to_vec()
    }

    fn slope(&self, at: &Kinematics, position: &mut [f64], velocity: &mut [f64]) {
        velocity.fill(0.0);
        let force = self.force(at);
        // A force that turns with its body has the same moment about the centre of mass.
        let by_turn = if self.follows_body {
            let turned = perp(force);
            [turned.x, turned.y, 0.0]
        } else {
            [0.0, 0.0, -self.at.rho(at).dot(&force)]
        };
        position.copy_from_slice(&by_turn);
    }

    fn potential(&self, _at: &Kinematics) -> f64 {
        0.0
    }

    fn is_conservative(&self) -> bool {
        false
    }

    fn supplied(&self, at: &Kinematics) -> f64 {
        self.force(at).dot(&self.at.velocity(at))
    }
}

/// A torque on a body.
#[derive(Debug, Clone)]
pub struct Torque {
    /// The body it acts on.
    pub body: BodyId,
    /// The body that it reacts on.
    pub relative_to: BodyId,
    /// [N·m]
    pub value: Law,
}

impl Force for Torque {
    fn apply(&self, at: &Kinematics, to: &mut Applied) {
        let torque = self.value.jet(at.time)[0];
        to.add(self.body, Vec2::zeros(), torque);
        to.add(self.relative_to, Vec2::zeros(), -torque);
    }

    fn slopes(&self) -> Vec<Slope> {
        Vec::new()
    }

    fn slope(&self, _at: &Kinematics, _position: &mut [f64], _velocity: &mut [f64]) {}

    fn potential(&self, _at: &Kinematics) -> f64 {
        0.0
    }

    fn is_conservative(&self) -> bool {
        false
    }

    fn supplied(&self, at: &Kinematics) -> f64 {
        self.value.jet(at.time)[0]
            * (at.twists[self.body.0].omega - at.twists[self.relative_to.0].omega)
    }
}
