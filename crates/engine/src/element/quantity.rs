//! Quantities of the motion that forces may depend on, with their derivatives.
//!
//! ```text
//! along      s = a·d               a = A₁ e, of length one; d = P₂ − P₁          [m]
//! distance   s = |d|                                                            [m]
//! turn       s = θ₂ − θ₁ + from                                                 [rad]
//! ```
//!
//! each with its rate ṡ. A coordinate of a point is one along an axis of the ground from the ground's origin. With the columns
//! B, D of `super::span`, a⊥ = ∂a/∂θ₁, and u, P as in [`super::spring`]:
//!
//! ```text
//! along      ∂s = a·B + a⊥·d [θ₁]         ∂ṡ/∂q = a·D + ω₁ a⊥·B + (a⊥·ḋ − ω₁ a·d) [θ₁]
//! distance   ∂s = u·B                     ∂ṡ/∂q = u·D + ḋ·P B/|d|
//! any        ∂ṡ/∂v = ∂s/∂q
//! ```

use super::span::{BOTH, Span};
use super::{Axis, BodyId, Kinematics, Marker, direction};
use linkdyn_linear::math::{Vec2, perp};

/// What a quantity measures.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Measured {
    /// How far the second point is from the first along an axis of the first body.
    Along {
        /// The point that it is measured from.
        first: Marker,
        /// The point that is measured.
        second: Marker,
        /// In the first body's frame, of length one.
        axis: Vec2,
    },
    /// How far two points are apart.
    Distance {
        /// One point.
        first: Marker,
        /// The other one.
        second: Marker,
    },
    /// The angle of the second body in the first.
    Turn {
        /// The body that it is measured from.
        first: BodyId,
        /// The body that is measured.
        second: BodyId,
        /// What is added, as where directions of the bodies are measured and not their frames \[rad\].
        from: f64,
    },
}

/// A quantity of the motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Quantity {
    /// Time \[s\].
    Time,
    /// The value of the driver with this index \[rad or m\].
    Drive(usize),
    /// The number from outside, or behind these the integrated state, with this index.
    State(usize),
    /// Something measured.
    Value(Measured),
    /// Its rate.
    Rate(Measured),
}

impl Measured {
    fn bodies(&self) -> [BodyId; 2] {
        match self {
            Measured::Along { first, second, .. } | Measured::Distance { first, second } => {
                [first.body, second.body]
            }
            Measured::Turn { first, second, .. } => [*first, *second],
        }
    }

    /// s and ṡ.
    pub(crate) fn value(&self, at: &Kinematics) -> [f64; 2] {
        let apart = |first: &Marker, second: &Marker| {
            let rate = second.velocity(at) - first.velocity(at);
            (second.place(at) - first.place(at), rate)
        };
        match self {
            Measured::Along {
                first,
                second,
                axis,
            } => {
                let (d, rate) = apart(first, second);
                let a = at.poses[first.body.0].turn(*axis);
                [a.dot(&d), a.dot(&rate) + first.omega(at) * perp(a).dot(&d)]
            }
            Measured::Distance { first, second } => {
                let (d, rate) = apart(first, second);
                direction(d).map_or([0.0; 2], |(u, length)| [length, u.dot(&rate)])
            }
            Measured::Turn {
                first,
                second,
                from,
            } => [
                at.poses[second.0].theta - at.poses[first.0].theta + from,
                at.twists[second.0].omega - at.twists[first.0].omega,
            ],
        }
    }

    /// ∂s/∂q by body: the generalized force of a force of size 1 that lengthens it.
    pub(crate) fn gradient(&self, at: &Kinematics) -> [(BodyId, [f64; 3]); 2] {
        let [x1, y1, theta1, x2, y2, theta2] = self.slopes(at)[0];
        let [first, second] = self.bodies();
        [(first, [x1, y1, theta1]), (second, [x2, y2, theta2])]
    }

    /// ∂s/∂q and ∂ṡ/∂q.
    pub(super) fn slopes(&self, at: &Kinematics) -> [[f64; BOTH]; 2] {
        let mut of_value = [0.0; BOTH];
        let mut of_rate = [0.0; BOTH];
        match self {
            Measured::Along {
                first,
                second,
                axis,
            } => {
                let span = Span::at(at, first, second);
                let a = at.poses[first.body.0].turn(*axis);
                let (across, omega) = (perp(a), first.omega(at));
                let d = second.place(at) - first.place(at);
                let rate = second.velocity(at) - first.velocity(at);
                for column in 0..BOTH {
                    let (moved, turned) = (span.spread(column), span.turn(column));
                    of_value[column] = a.dot(&moved);
                    of_rate[column] = a.dot(&turned) + omega * across.dot(&moved);
                }
                of_value[2] += across.dot(&d);
                of_rate[2] += across.dot(&rate) - omega * a.dot(&d);
            }
            Measured::Distance { first, second } => {
                let span = Span::at(at, first, second);
                let d = second.place(at) - first.place(at);
                let rate = second.velocity(at) - first.velocity(at);
                let Some((u, length)) = direction(d) else {
                    return [of_value, of_rate];
                };
                for column in 0..BOTH {
                    let (moved, turned) = (span.spread(column), span.turn(column));
                    let across = (moved - u * u.dot(&moved)) / length;
                    of_value[column] = u.dot(&moved);
                    of_rate[column] = u.dot(&turned) + rate.dot(&across);
                }
            }
            Measured::Turn { .. } => (of_value[2], of_value[5]) = (-1.0, 1.0),
        }
        [of_value, of_rate]
    }
}

impl Quantity {
    /// Its value in SI.
    pub fn value(&self, at: &Kinematics) -> f64 {
        match self {
            Quantity::Time => at.time,
            Quantity::Drive(driver) => at.drive[*driver][0],
            Quantity::State(state) => at.states[*state],
            Quantity::Value(measured) => measured.value(at)[0],
            Quantity::Rate(measured) => measured.value(at)[1],
        }
    }

    /// The coordinates that change it.
    pub fn columns(&self) -> Vec<(BodyId, Axis)> {
        match self {
            Quantity::Time | Quantity::Drive(_) | Quantity::State(_) => Vec::new(),
            Quantity::Value(measured) | Quantity::Rate(measured) => {
                let of = |body| Axis::ALL.map(|axis| (body, axis));
                measured.bodies().map(of).concat()
            }
        }
    }

    /// Its derivatives by these coordinates and their rates, each as many.
    pub fn slopes(&self, at: &Kinematics, position: &mut [f64], velocity: &mut [f64]) {
        match self {
            Quantity::Time | Quantity::Drive(_) | Quantity::State(_) => {}
            Quantity::Value(measured) => {
                position.copy_from_slice(&measured.slopes(at)[0]);
                velocity.fill(0.0);
            }
            Quantity::Rate(measured) => {
                let [of_value, of_rate] = measured.slopes(at);
                position.copy_from_slice(&of_rate);
                velocity.copy_from_slice(&of_value);
            }
        }
    }
}
