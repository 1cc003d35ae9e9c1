//! An end of a joint's way: a stop.
//!
//! ```text
//! s                  angle θ₂ − θ₁ of a turning joint [rad], slide a·(P₂ − P₁) along an axis of the first body [m], or length |P₂ − P₁|
//!                    of a spring or an actuator [m]
//! δ = σ L (s − s_σ)  penetration [m], σ = 1 at the upper end, −1 at the lower
//! Q = −N ∂δ/∂q       N L is a torque [N·m] or force [N] on the second body against σ, and back on the first
//! ```
//!
//! L is 1 of a slide, and of an angle the length of an arm at whose end it is measured, so that all contacts of a mechanism are
//! alike: metres, and newtons.
//!
//! As a constraint φ = δ = 0 of a rigid stop that is pressed:
//!
//! ```text
//! J = ∂δ/∂q,   γ = −(∂δ̇/∂q) v,   λ = N          (1)  [m]
//! ```
//!
//! with the derivatives of [`super::quantity`].
//!
//! A **lock** and a **one-way clutch** are stops that have no place of their own: s_σ is where the joint was when they began to hold,
//! and while they do not, δ = 0. A lock holds from both sides, N of either sign, from one event until another; a one-way clutch
//! holds against δ̇ > 0 alone, N ≥ 0.

use super::prismatic::Guide;
use super::quantity::Measured;
use super::span::{BOTH, Span, all_pairs, upper_pairs};
use super::touch::{Compliant, Contact, ContactId, Reading};
use super::{
    Applied, Axis, Constraint, Entry, Equations, Kinematics, Marker, Measure, Slope, direction,
};
use linkdyn_linear::math::Vec2;

/// Which end of the way it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// Where the coordinate is least.
    Lower,
    /// Where it is greatest.
    Upper,
}

impl Side {
    /// σ
    pub fn sign(self) -> f64 {
        match self {
            Side::Lower => -1.0,
            Side::Upper => 1.0,
        }
    }

    /// Its place in a pair of lower and upper.
    pub fn index(self) -> usize {
        match self {
            Side::Lower => 0,
            Side::Upper => 1,
        }
    }

    /// The word for it.
    pub fn word(self) -> &'static str {
        match self {
            Side::Lower => "lower",
            Side::Upper => "upper",
        }
    }
}

/// What a stop is an end of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Travel {
    /// The angle of the second body in the first.
    Turn,
    /// The slide of the second point along an axis of the first body, in its frame, of length one.
    Along(Vec2),
    /// The distance of both points.
    Apart,
}

/// An end of a joint's way, or of the stroke of a spring or an actuator.
#[derive(Debug, Clone)]
pub struct Stop {
    /// The joint's point of the first body.
    pub first: Marker,
    /// Its point of the second body.
    pub second: Marker,
    /// What it ends.
    pub way: Travel,
    /// Which end it is.
    pub side: Side,
    /// s_σ [m or rad]
    pub limit: f64,
    /// L \[m\] of an angle, 1 of what is a length.
    pub arm: f64,
    /// What penetrations are measured against \[m\].
    pub size: f64,
    /// Where its place is kept, of one that has none of its own.
    pub kept: Option<HeldStop>,
}

/// A stop that holds where the joint was when it began to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct HeldStop {
    /// Whose memory has the place.
    pub id: ContactId,
    /// Whether it is a lock; else it is a one-way clutch.
    pub is_lock: bool,
}

impl Stop {
    /// s, as a quantity of the motion.
    pub fn measured(&self) -> Measured {
        let (first, second) = (self.first, self.second);
        match self.way {
            Travel::Turn => Measured::Turn {
                first: first.body,
                second: second.body,
                from: 0.0,
            },
            Travel::Along(axis) => Measured::Along {
                first,
                second,
                axis,
            },
            Travel::Apart => Measured::Distance { first, second },
        }
    }

    /// Direction of a slide.
    pub fn axis(&self) -> Option<Vec2> {
        match self.way {
            Travel::Along(axis) => Some(axis),
            Travel::Turn | Travel::Apart => None,
        }
    }

    /// Whether s is an angle.
    pub fn turns(&self) -> bool {
        self.way == Travel::Turn
    }

    /// ∂²s/∂q² of a length, by the coordinates of both bodies.
    fn bent(&self, at: &Kinematics) -> [[f64; BOTH]; BOTH] {
        let d = self.second.place(at) - self.first.place(at);
        let Some((u, length)) = direction(d) else {
            return [[0.0; BOTH]; BOTH];
        };
        let span = Span::at(at, &self.first, &self.second);
        span.bent(u, |a| (a - u * u.dot(&a)) / length)
    }

    fn guide(&self) -> Option<Guide> {
        Some(Guide {
            first: self.first,
            second: self.second,
            axis: self.axis()?,
        })
    }

    /// The same at another turn \[rad\].
    pub fn turned(&self, by: f64) -> Stop {
        Stop {
            limit: self.limit + by,
            ..self.clone()
        }
    }

    /// The word for it in results.
    pub fn word(&self) -> &'static str {
        match self.kept {
            None => self.side.word(),
            Some(HeldStop { is_lock: true, .. }) => "lock",
            Some(HeldStop { is_lock: false, .. }) => "one_way",
        }
    }

    /// s_σ, where it holds [m or rad].
    fn place(&self, at: &Kinematics) -> f64 {
        self.kept
            .map_or(self.limit, |kept| at.contacts[kept.id.0].anchor)
    }

    /// σ L
    fn factor(&self) -> f64 {
        self.side.sign() * self.arm
    }

    /// s [m or rad].
    pub fn coordinate(&self, at: &Kinematics) -> f64 {
        self.measured().value(at)[0]
    }

    /// Torque [N·m] or force \[N\] on the second body, along s, of a normal force N \[N\].
    pub fn pushed(&self, normal: f64) -> f64 {
        -self.factor() * normal
    }

    /// Penetration and its rate.
    pub fn read(&self, at: &Kinematics) -> Reading {
        let [s, rate] = self.measured().value(at);
        let penetration = match self.kept {
            None => self.factor() * (s - self.limit),
            Some(_) => 0.0,
        };
        Reading {
            penetration,
            rate: self.factor() * rate,
            ..Reading::default()
        }
    }

    /// ∂δ/∂q and ∂δ̇/∂q.
    fn gradients(&self, at: &Kinematics) -> [[f64; BOTH]; 2] {
        let slopes = self.measured().slopes(at);
        slopes.map(|slope| slope.map(|value| self.factor() * value))
    }

    /// Slopes by the coordinates of both bodies, along their velocities.
    pub(super) fn along_velocities(&self, at: &Kinematics, slopes: &[f64; BOTH]) -> f64 {
        let velocities = [self.first.body, self.second.body].map(|body| {
            let twist = &at.twists[body.0];
            [twist.v.x, twist.v.y, twist.omega]
        });
        let velocities = velocities.as_flattened().iter();
        slopes
            .iter()
            .zip(velocities)
            .map(|(slope, rate)| slope * rate)
            .sum::<f64>()
    }

    /// Adds the force of the stop.
    pub fn press(&self, at: &Kinematics, normal: f64, to: &mut Applied) {
        let [g, _] = self.gradients(at);
        to.add(
            self.first.body,
            Vec2::new(-g[0], -g[1]) * normal,
            -g[2] * normal,
        );
        to.add(
            self.second.body,
            Vec2::new(-g[3], -g[4]) * normal,
            -g[5] * normal,
        );
    }

    /// Where the derivatives of its force can be non-zero.
    pub fn slopes(&self) -> Vec<Slope> {
        all_pairs(&self.first, &self.second)
    }

    /// Their values, of a stop that yields.
    pub fn slope(
        &self,
        at: &Kinematics,
        (memory, laws): (&Contact, &Compliant),
        reading: &Reading,
        position: &mut [f64],
        velocity: &mut [f64],
    ) {
        let slopes =
            laws.normal
                .continued_slopes(reading.penetration, reading.rate, memory.approach);
        self.spread(at, reading.normal, slopes, position, velocity);
    }

    /// Derivatives of the force where N has these by δ and δ̇.
    ///
    /// ```text
    /// ∂Q/∂q = −g ⊗ (N_δ g + N_δ̇ ∂δ̇/∂q) − N ∂²δ/∂q²,   ∂Q/∂v = −N_δ̇ g ⊗ g,   g = ∂δ/∂q
    /// ```
    fn spread(
        &self,
        at: &Kinematics,
        normal: f64,
        [by_depth, by_rate]: [f64; 2],
        position: &mut [f64],
        velocity: &mut [f64],
    ) {
        let [g, by_position] = self.gradients(at);
        for row in 0..BOTH {
            for column in 0..BOTH {
                let change = by_depth * g[column] + by_rate * by_position[column];
                position[row * BOTH + column] = -g[row] * change;
                velocity[row * BOTH + column] = -by_rate * g[row] * g[column];
            }
        }
        if self.way == Travel::Apart {
            let bent = self.bent(at);
            for (to, bent) in position.iter_mut().zip(bent.as_flattened()) {
                *to -= self.factor() * normal * bent;
            }
        }
        let Some(guide) = self.guide() else {
            return;
        };
        let along = at.poses[self.first.body.0].turn(guide.axis);
        let values = guide.bend(at, along, -self.factor() * normal);
        for (&[row, column], value) in BENT.iter().zip(values) {
            let (row, column) = (index(row), index(column));
            position[row * BOTH + column] += value;
            if row != column {
                position[column * BOTH + row] += value;
            }
        }
    }
}

/// Place of a coordinate among those of both bodies.
pub(super) fn index((end, axis): (usize, Axis)) -> usize {
    3 * end + axis as usize
}

/// Coordinates of [`Guide::bends`]: side of the joint and axis.
pub(super) const BENT: [[(usize, Axis); 2]; 7] = [
    [(0, Axis::X), (0, Axis::Theta)],
    [(0, Axis::Y), (0, Axis::Theta)],
    [(1, Axis::X), (0, Axis::Theta)],
    [(1, Axis::Y), (0, Axis::Theta)],
    [(0, Axis::Theta), (0, Axis::Theta)],
    [(0, Axis::Theta), (1, Axis::Theta)],
    [(1, Axis::Theta), (1, Axis::Theta)],
];

impl Equations for Stop {
    fn position(&self, at: &Kinematics, phi: &mut [f64]) {
        phi[0] = self.factor() * (self.coordinate(at) - self.place(at));
    }

    fn jacobian(&self, at: &Kinematics, values: &mut [f64]) {
        values.copy_from_slice(&self.gradients(at)[0]);
    }

    fn rate(&self, _at: &Kinematics, phi_t: &mut [f64]) {
        phi_t[0] = 0.0;
    }

    fn gamma(&self, at: &Kinematics, gamma: &mut [f64]) {
        let [_, by_position] = self.gradients(at);
        gamma[0] = -self.along_velocities(at, &by_position);
    }
}

impl Constraint for Stop {
    fn rows(&self) -> &'static [Measure] {
        &[Measure::Length]
    }

    fn entries(&self) -> Vec<Entry> {
        let bodies = [self.first.body, self.second.body];
        let of = |body| Axis::ALL.map(|axis| (0, body, axis));
        bodies.map(of).concat()
    }

    fn curvature_pattern(&self) -> Vec<Slope> {
        if self.way == Travel::Apart {
            return upper_pairs(&self.first, &self.second);
        }
        self.guide()
            .map_or_else(Vec::new, |guide| guide.curvature_pattern().to_vec())
    }

    fn bend(&self, at: &Kinematics, lambda: &[f64], values: &mut [f64]) {
        if self.way == Travel::Apart {
            let bent = self.bent(at);
            let pairs = (0..BOTH).flat_map(|row| (row..BOTH).map(move |column| (row, column)));
            for (value, (row, column)) in values.iter_mut().zip(pairs) {
                *value = self.factor() * lambda[0] * bent[row][column];
            }
        }
        if let Some(guide) = self.guide() {
            let along = at.poses[self.first.body.0].turn(guide.axis);
            values.copy_from_slice(&guide.bend(at, along, self.factor() * lambda[0]));
        }
    }

    fn reaction(&self, at: &Kinematics, lambda: &[f64]) -> (Vec2, f64) {
        let pressed = self.pushed(lambda[0]);
        match self.way {
            Travel::Turn => (Vec2::zeros(), pressed),
            Travel::Along(axis) => (at.poses[self.first.body.0].turn(axis) * pressed, 0.0),
            Travel::Apart => {
                let d = self.second.place(at) - self.first.place(at);
                let along = direction(d).map_or_else(Vec2::zeros, |(u, _)| u);
                (along * pressed, 0.0)
            }
        }
    }
}

#[cfg(test)]
pub(super) mod tests;
