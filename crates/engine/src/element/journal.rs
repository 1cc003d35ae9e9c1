//! Journal in a bearing: what remains of a revolute joint whose clearance is modelled by a contact force.
//!
//! The first body holds the bearing (radius R_b, centre P₁), the second the journal (centre P₂); c is the radial
//! clearance.
//!
//! ```text
//! e = P₂ − P₁,  d = |e|                         eccentricity [m]
//! n = e/d,  t = n⊥                              normal from the bearing's centre to the contact, tangent
//! δ = d − c,  δ̇ = n·ė                           penetration [m], its rate [m/s]; contact where δ > 0
//! a_b = R_b + δ/2,  a_j = a_b − d               arms of the contact point (middle of the overlap) [m]
//! v_t = t·ė + ω₂ a_j − ω₁ a_b                   sliding velocity, journal over bearing [m/s]
//! f = −N n + T t                                force of the bearing on the journal [N], at the contact point
//! D' = (N − N_e) δ̇ − T v_t                      power that the contact dissipates [W]; N_e its elastic part
//! ```
//!
//! With c and R_b below zero the first body is a disc that the second touches from outside, n = −e/d and d = n·e < 0: nothing else
//! changes (see [`super::edge`]).
//!
//! N by `crate::contact::normal`, T by `crate::contact::friction` (see [`super::pair`]).

use super::span::{BOTH, Span, all_pairs};
use super::touch::{Compliant, Contact, Reading};
use super::{
    Applied, BodyId, Constraint, Entry, Equations, Kinematics, Marker, Measure, Slope, direction,
};
use linkdyn_linear::math::{Vec2, perp};

/// A joint with clearance as a contact.
#[derive(Debug, Clone)]
pub struct Journal {
    /// The bearing's centre.
    pub bearing: Marker,
    /// The journal's centre.
    pub journal: Marker,
    /// c \[m\]
    pub clearance: f64,
    /// R_b \[m\]
    pub bearing_radius: f64,
}

impl Journal {
    /// 1 of a bearing that holds the journal, −1 of a disc or a corner that it touches from outside, whose c and R_b are negative.
    pub(super) fn side(&self) -> f64 {
        1.0_f64.copysign(self.clearance)
    }

    /// n and n·e.
    fn normal(&self, e: Vec2) -> Option<(Vec2, f64)> {
        let side = self.side();
        direction(e).map(|(n, distance)| (n * side, distance * side))
    }

    /// Geometry and velocities.
    pub fn read(&self, at: &Kinematics) -> Reading {
        let e = self.journal.place(at) - self.bearing.place(at);
        let e_rate = self.journal.velocity(at) - self.bearing.velocity(at);
        // At the centre no direction is meant; it is never in contact there.
        let (n, distance) = self.normal(e).unwrap_or((Vec2::x(), 0.0));
        let t = perp(n);
        let penetration = distance - self.clearance;
        let rate = n.dot(&e_rate);
        let arm = self.bearing_radius + 0.5 * penetration;
        let arms = [arm, arm - distance];
        let sliding =
            t.dot(&e_rate) + self.journal.omega(at) * arms[1] - self.bearing.omega(at) * arms[0];
        Reading {
            eccentricity: e,
            towards: n,
            penetration,
            rate,
            sliding,
            arms,
            ..Reading::default()
        }
    }

    /// Where the derivatives of the contact's forces can be non-zero, in the order [`Journal::slope`] writes.
    pub fn slopes(&self) -> Vec<Slope> {
        all_pairs(&self.bearing, &self.journal)
    }

    /// Their values, of surfaces without bristles.
    ///
    /// ```text
    /// ∂n = t (t·∂e)/d,  ∂t = −n (t·∂e)/d,  ∂δ̇ = n·∂ė + (t·ė)(t·∂e)/d
    /// ∂v_t = t·∂ė − (n·ė)(t·∂e)/d + a_j ∂ω₂ − a_b ∂ω₁ − (ω₁ + ω₂) ∂δ/2
    /// ```
    pub fn slope(
        &self,
        at: &Kinematics,
        (memory, laws): (&Contact, &Compliant),
        reading: &Reading,
        position: &mut [f64],
        velocity: &mut [f64],
    ) {
        let e = self.journal.place(at) - self.bearing.place(at);
        let Some((n, distance)) = self.normal(e) else {
            return;
        };
        let t = perp(n);
        let e_rate = self.journal.velocity(at) - self.bearing.velocity(at);
        let [by_depth, by_rate] =
            laws.normal
                .continued_slopes(reading.penetration, reading.rate, memory.approach);
        let [by_sliding, by_normal] =
            laws.friction
                .slopes_on_piece(memory.piece, reading.sliding, reading.normal);
        let spin = self.journal.omega(at) + self.bearing.omega(at);
        let span = Span::at(at, &self.bearing, &self.journal);
        for column in 0..BOTH {
            let (moved, turned) = (span.spread(column), span.turn(column));
            let (deeper, angle) = (n.dot(&moved), t.dot(&moved) / distance);
            let rate = n.dot(&turned) + t.dot(&e_rate) * angle;
            let sliding = t.dot(&turned) - n.dot(&e_rate) * angle - 0.5 * spin * deeper;
            let normal = by_depth * deeper + by_rate * rate;
            let tangential = by_sliding * sliding + by_normal * normal;
            let change = t * (tangential - reading.normal * angle)
                - n * (normal + reading.tangential * angle);
            span.add_force(change, column, position);
            position[5 * BOTH + column] +=
                reading.arms[1] * tangential - 0.5 * deeper * reading.tangential;
            position[2 * BOTH + column] -=
                reading.arms[0] * tangential + 0.5 * deeper * reading.tangential;

            let spun = match column {
                2 => -reading.arms[0],
                5 => reading.arms[1],
                _ => 0.0,
            };
            let normal = by_rate * deeper;
            let tangential = by_sliding * (t.dot(&moved) + spun) + by_normal * normal;
            span.add_force(t * tangential - n * normal, column, velocity);
            velocity[5 * BOTH + column] += reading.arms[1] * tangential;
            velocity[2 * BOTH + column] -= reading.arms[0] * tangential;
        }
        span.add_turned(reading.force, position);
    }

    /// Adds a normal and a tangential force at the contact of a reading, on both bodies.
    pub fn press(
        &self,
        at: &Kinematics,
        reading: &Reading,
        [normal, tangential]: [f64; 2],
        to: &mut Applied,
    ) {
        let n = reading.towards;
        let force = perp(n) * tangential - n * normal;
        to.add_force(at, &self.journal, force);
        to.add_force(at, &self.bearing, -force);
        // Both act at the contact point, an arm away from the centres along n.
        to.add(
            self.journal.body,
            Vec2::zeros(),
            reading.arms[1] * tangential,
        );
        to.add(
            self.bearing.body,
            Vec2::zeros(),
            -reading.arms[0] * tangential,
        );
    }

    /// Angle of the contact in the bearing's body \[rad\].
    pub fn bearing_angle(&self, at: &Kinematics, reading: &Reading) -> f64 {
        let own = if self.bearing.body == BodyId::GROUND {
            0.0
        } else {
            at.poses[self.bearing.body.0].theta
        };
        reading.eccentricity.y.atan2(reading.eccentricity.x) - own
    }
}

/// Radii of a joint with clearance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bearing {
    /// c \[m\]
    pub clearance: f64,
    /// R_b \[m\]
    pub bearing_radius: f64,
}

impl Bearing {
    /// A joint whose model lets the journal neither fly nor overlap: ideal, or a clearance link with its offset. `force` is
    /// that on the journal \[N\]; the contact lies where it comes from.
    pub fn held(
        &self,
        at: &Kinematics,
        points: &[Marker; 2],
        offset: Option<&[Vec2; 3]>,
        force: Vec2,
    ) -> Reading {
        let zero = [Vec2::zeros(); 3];
        let [e, e_rate, _] = offset.unwrap_or(&zero);
        let n = direction(*e)
            .or(direction(-force))
            .map_or(Vec2::x(), |(n, _)| n);
        let [bearing, journal] = points;
        let arms = [self.bearing_radius, self.bearing_radius - self.clearance];
        let sliding =
            perp(n).dot(e_rate) + journal.omega(at) * arms[1] - bearing.omega(at) * arms[0];
        Reading {
            eccentricity: *e,
            towards: n,
            rate: n.dot(e_rate),
            sliding,
            normal: -force.dot(&n),
            tangential: force.dot(&perp(n)),
            force,
            arms,
            ..Reading::default()
        }
    }
}

/// A joint that is open: it holds nothing.
#[derive(Debug, Clone, Copy)]
pub struct Free;

impl Equations for Free {
    fn position(&self, _at: &Kinematics, _phi: &mut [f64]) {}

    fn jacobian(&self, _at: &Kinematics, _values: &mut [f64]) {}

    fn rate(&self, _at: &Kinematics, _phi_t: &mut [f64]) {}

    fn gamma(&self, _at: &Kinematics, _gamma: &mut [f64]) {}
}

impl Constraint for Free {
    fn rows(&self) -> &'static [Measure] {
        &[]
    }

    fn entries(&self) -> Vec<Entry> {
        Vec::new()
    }

    fn reaction(&self, _at: &Kinematics, _lambda: &[f64]) -> (Vec2, f64) {
        (Vec2::zeros(), 0.0)
    }
}
