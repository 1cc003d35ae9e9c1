//! Given loads: a force at a point (vector in the ground's or the body's frame), and a torque.
//!
//! ```text
//! force   F = (F_x, F_y) or A (F_x, F_y)   [N] at the point
//! torque  T on the body, −T on the other   [N·m]
//! ```
//!
//! F_x, F_y, T are laws of time or functions of what moves (see [`super::formula`]).

use super::formula::Strength;
use super::{Applied, Axis, BodyId, Force, Kinematics, Marker, Slope};

use linkdyn_linear::math::{Vec2, perp};

/// A force at a point.
#[derive(Debug, Clone)]
pub struct PointLoad {
    /// The point.
    pub at: Marker,
    /// Components \[N\].
    pub vector: [Strength; 2],
    /// The vector turns with the body.
    pub follows_body: bool,
}

impl PointLoad {
    /// In the ground frame \[N\].
    fn force(&self, at: &Kinematics) -> Vec2 {
        let [x, y] = &self.vector;
        self.turned(at, Vec2::new(x.value(at), y.value(at)))
    }
}

impl PointLoad {
    /// A vector of its frame in the ground's.
    fn turned(&self, at: &Kinematics, given: Vec2) -> Vec2 {
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
        let of_strengths = self.vector.iter().flat_map(Strength::columns);
        let columns = [theta].into_iter().chain(of_strengths);
        columns
            .flat_map(|column| Axis::ALL.map(|axis| [(self.at.body, axis), column]))
            .collect()
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
        position[..3].copy_from_slice(&by_turn);
        let rho = self.at.rho(at);
        let mut place = 3;
        for (strength, unit) in self.vector.iter().zip([Vec2::x(), Vec2::y()]) {
            let unit = self.turned(at, unit);
            let rows = [unit.x, unit.y, rho.x * unit.y - rho.y * unit.x];
            strength.each_slope(at, |[of_q, of_v]| {
                for row in rows {
                    (position[place], velocity[place]) = (row * of_q, row * of_v);
                    place += 1;
                }
            });
        }
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
    pub value: Strength,
}

impl Force for Torque {
    fn apply(&self, at: &Kinematics, to: &mut Applied) {
        let torque = self.value.value(at);
        to.add(self.body, Vec2::zeros(), torque);
        to.add(self.relative_to, Vec2::zeros(), -torque);
    }

    fn slopes(&self) -> Vec<Slope> {
        let rows = [self.body, self.relative_to].map(|body| (body, Axis::Theta));
        let columns = self.value.columns().into_iter();
        columns
            .flat_map(|column| rows.map(|row| [row, column]))
            .collect()
    }

    fn slope(&self, at: &Kinematics, position: &mut [f64], velocity: &mut [f64]) {
        let mut place = 0;
        self.value.each_slope(at, |[of_q, of_v]| {
            for sign in [1.0, -1.0] {
                (position[place], velocity[place]) = (sign * of_q, sign * of_v);
                place += 1;
            }
        });
    }

    fn potential(&self, _at: &Kinematics) -> f64 {
        0.0
    }

    fn is_conservative(&self) -> bool {
        false
    }

    fn supplied(&self, at: &Kinematics) -> f64 {
        self.value.value(at) * (at.twists[self.body.0].omega - at.twists[self.relative_to.0].omega)
    }
}
