//! A straight piece of an outline under a round tip, and the tip that rolls on it.
//!
//! Symbols as in [`super::edge`]. With A of [`Contact`], a tip that rolls keeps
//!
//! ```text
//! φ = [ δ ]                                          (2)  [m]
//!     [ A − (t·(P − E) + r (θ₂ − θ₁)) ]
//! ```

use super::prismatic::Guide;
use super::quantity::Measured;
use super::span::BOTH;
use super::stop::{BENT, Side, Stop, Travel, index};
use super::touch::{Compliant, Contact, ContactId, Reading};
use super::{Applied, Constraint, Entry, Equations, Kinematics, Marker, Measure, Slope};
use linkdyn_linear::math::{Vec2, perp};

/// A straight piece.
#[derive(Debug, Clone)]
pub struct Straight {
    /// δ as an end of the tip's way along n, which is how it presses.
    pub stop: Stop,
    /// r \[m\]
    pub radius: f64,
    /// Its length \[m\].
    pub length: f64,
}

impl Straight {
    /// A straight from one point of the first body to another \[m\], with the tip's centre.
    pub fn new([from, to]: [Marker; 2], tip: Marker, radius: f64, size: f64) -> Self {
        let way = to.s - from.s;
        let length = way.norm();
        let stop = Stop {
            first: from,
            second: tip,
            way: Travel::Along(perp(way / length)),
            side: Side::Upper,
            limit: -radius,
            arm: 1.0,
            size,
            kept: None,
        };
        Straight {
            stop,
            radius,
            length,
        }
    }

    /// t·(P − E)
    pub(super) fn along(&self) -> Measured {
        Measured::Along {
            first: self.stop.first,
            second: self.stop.second,
            axis: self.guide().axis,
        }
    }

    /// E, P, and t in the first body's frame.
    fn guide(&self) -> Guide {
        let axis = self.stop.axis().map_or(Vec2::x(), perp);
        Guide {
            first: self.stop.first,
            second: self.stop.second,
            axis,
        }
    }

    /// r − δ/2
    fn arm(&self, reading: &Reading) -> f64 {
        self.radius - 0.5 * reading.penetration
    }

    fn spin(&self, at: &Kinematics) -> f64 {
        self.stop.second.omega(at) - self.stop.first.omega(at)
    }

    pub(super) fn read(&self, at: &Kinematics) -> Reading {
        let mut reading = self.stop.read(at);
        let inward = self.stop.axis().unwrap_or(Vec2::x());
        reading.towards = at.poses[self.stop.first.body.0].turn(inward);
        let [_, rate] = self.along().value(at);
        reading.sliding = rate + self.arm(&reading) * self.spin(at);
        reading
    }

    /// How far the tip's centre is from the beginning and from the end, along the straight \[m\].
    pub(super) fn rooms(&self, at: &Kinematics) -> [f64; 2] {
        // The way along it is against t.
        let way = -self.along().value(at)[0];
        [way, self.length - way]
    }

    /// ∂v_t/∂v and ∂v_t/∂q.
    fn slidings(
        &self,
        at: &Kinematics,
        reading: &Reading,
        deeper: &[f64; BOTH],
    ) -> [[f64; BOTH]; 2] {
        let [mut by_rate, mut by_place] = self.along().slopes(at);
        let arm = self.arm(reading);
        by_rate[2] -= arm;
        by_rate[5] += arm;
        let spin = 0.5 * self.spin(at);
        for (slope, deeper) in by_place.iter_mut().zip(deeper) {
            *slope -= spin * deeper;
        }
        [by_rate, by_place]
    }

    pub(super) fn press(
        &self,
        at: &Kinematics,
        reading: &Reading,
        forces: [f64; 2],
        to: &mut Applied,
    ) {
        let [normal, tangential] = forces;
        self.stop.press(at, normal, to);
        let along = reading.towards;
        let force = perp(along) * tangential;
        let Stop { first, second, .. } = &self.stop;
        to.add_force(at, second, force);
        to.add_force(at, first, -force);
        // Of both at the contact point, an arm from the tip's centre along n.
        let reach = along.dot(&(second.place(at) - first.place(at))) + self.arm(reading);
        to.add(second.body, Vec2::zeros(), self.arm(reading) * tangential);
        to.add(first.body, Vec2::zeros(), -reach * tangential);
    }

    /// ```text
    /// ∂Q/∂q = −g ⊗ ∂N − N ∂²δ/∂q² + s ⊗ ∂T + T (∂²(t·(P − E))/∂q² − ½ (e_θ₂ − e_θ₁) ⊗ g),   g = ∂δ/∂q,  s = ∂v_t/∂v
    /// ```
    pub(super) fn slope(
        &self,
        at: &Kinematics,
        (memory, laws): (&Contact, &Compliant),
        reading: &Reading,
        position: &mut [f64],
        velocity: &mut [f64],
    ) {
        self.stop
            .slope(at, (memory, laws), reading, position, velocity);
        let [by_depth, by_rate] =
            laws.normal
                .continued_slopes(reading.penetration, reading.rate, memory.approach);
        let [by_sliding, by_normal] =
            laws.friction
                .slopes_on_piece(memory.piece, reading.sliding, reading.normal);
        let [g, rates] = self.stop.measured().slopes(at);
        let [s, places] = self.slidings(at, reading, &g);
        let arm = [0.0, 0.0, 0.5, 0.0, 0.0, -0.5];
        for row in 0..BOTH {
            for column in 0..BOTH {
                let place = row * BOTH + column;
                let pressed = by_depth * g[column] + by_rate * rates[column];
                position[place] += s[row] * (by_sliding * places[column] + by_normal * pressed)
                    + reading.tangential * arm[row] * g[column];
                velocity[place] +=
                    s[row] * (by_sliding * s[column] + by_normal * by_rate * g[column]);
            }
        }
        self.bend(at, reading.tangential, position);
    }

    /// Adds T ∂²(t·(P − E))/∂q² to a matrix by rows (6 × 6).
    fn bend(&self, at: &Kinematics, tangential: f64, to: &mut [f64]) {
        let guide = self.guide();
        let along = at.poses[guide.first.body.0].turn(guide.axis);
        let values = guide.bend(at, along, tangential);
        for (&[row, column], value) in BENT.iter().zip(values) {
            let (row, column) = (index(row), index(column));
            to[row * BOTH + column] += value;
            if row != column {
                to[column * BOTH + row] += value;
            }
        }
    }
}

impl Straight {
    /// t·(P − E) + r (θ₂ − θ₁) \[m\].
    pub(super) fn rolled(&self, at: &Kinematics) -> f64 {
        let angle = |marker: &Marker| at.poses[marker.body.0].theta;
        let turned = angle(&self.stop.second) - angle(&self.stop.first);
        self.along().value(at)[0] + self.radius * turned
    }
}

/// A tip that rolls on a straight piece of an outline.
#[derive(Debug, Clone)]
pub struct RollingTip {
    /// The straight.
    pub straight: Straight,
    /// Whose anchor it is.
    pub id: ContactId,
}

impl Equations for RollingTip {
    fn position(&self, at: &Kinematics, phi: &mut [f64]) {
        self.straight.stop.position(at, &mut phi[..1]);
        phi[1] = at.contacts[self.id.0].anchor - self.straight.rolled(at);
    }

    fn jacobian(&self, at: &Kinematics, values: &mut [f64]) {
        let (first, second) = values.split_at_mut(BOTH);
        self.straight.stop.jacobian(at, first);
        let [by_place, _] = self.straight.along().slopes(at);
        for (value, slope) in second.iter_mut().zip(by_place) {
            *value = -slope;
        }
        second[2] += self.straight.radius;
        second[5] -= self.straight.radius;
    }

    fn rate(&self, _at: &Kinematics, phi_t: &mut [f64]) {
        phi_t.fill(0.0);
    }

    fn gamma(&self, at: &Kinematics, gamma: &mut [f64]) {
        let stop = &self.straight.stop;
        stop.gamma(at, &mut gamma[..1]);
        let [_, by_place] = self.straight.along().slopes(at);
        gamma[1] = stop.along_velocities(at, &by_place);
    }
}

impl Constraint for RollingTip {
    fn rows(&self) -> &'static [Measure] {
        &[Measure::Length, Measure::Length]
    }

    fn entries(&self) -> Vec<Entry> {
        let first = self.straight.stop.entries();
        let second = first.iter().map(|&(_, body, axis)| (1, body, axis));
        first.iter().copied().chain(second).collect()
    }

    fn curvature_pattern(&self) -> Vec<Slope> {
        self.straight.stop.curvature_pattern()
    }

    fn bend(&self, at: &Kinematics, lambda: &[f64], values: &mut [f64]) {
        self.straight.stop.bend(at, &lambda[..1], values);
        let guide = self.straight.guide();
        let along = at.poses[guide.first.body.0].turn(guide.axis);
        let more = guide.bend(at, along, -lambda[1]);
        values
            .iter_mut()
            .zip(more)
            .for_each(|(value, more)| *value += more);
    }

    fn reaction(&self, at: &Kinematics, lambda: &[f64]) -> (Vec2, f64) {
        let guide = self.straight.guide();
        let along = at.poses[guide.first.body.0].turn(guide.axis);
        let (force, torque) = self.straight.stop.reaction(at, &lambda[..1]);
        let torque = torque + self.straight.radius * lambda[1];
        (force + along * lambda[1], torque)
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::element::tests::marker;

    /// A straight under a tip, for checks by differences.
    pub(in crate::element) fn straight() -> Straight {
        let ends = [marker(1, 0.3, -0.2), marker(1, -0.5, 0.4)];
        Straight::new(ends, marker(2, -0.4, 0.1), 0.3, 0.7)
    }
}
