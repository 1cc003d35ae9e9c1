//! A contact: two things that may touch, and what happens where they do, whatever they are.
//!
//! ```text
//! δ(q), δ̇          penetration, negative in flight, and its rate          [m, m/s]
//! v_t              sliding velocity where the shape has one               [m/s]
//! N, T             forces along −∂δ/∂q and along the surface              [N]
//! Q = −(∂δ/∂q)ᵀ N + (∂v_t/∂v)ᵀ T
//! D' = (N − N_e) δ̇ − T v_t                      power that the contact dissipates [W]; N_e its elastic part
//! ```
//!
//! The **shape** says what δ and v_t are; the **surface** what follows: N and T by [`crate::contact`] where they overlap, impacts
//! and a constraint where they do not.
//!
//! What a contact has to remember (whether it touches, with what speed it was approached) is not kept here but in [`Contact`],
//! which the analysis changes between steps only: within a step every law is the analytic branch that the phase says, also a
//! little beyond its end, so that steps are smooth and their events can be located.

mod kinds;

pub use super::touch::{Compliant, Contact, ContactId, Phase, Reading};

use super::clasp::Clasp;
use super::edge::Edge;
use super::journal::Journal;
use super::stop::Stop;
use super::{Applied, Constraint, Kinematics, Slope};
use crate::contact::friction;
use crate::contact::impact::Sense;
use linkdyn_linear::math::perp;
use std::sync::Arc;

/// Two things that may touch.
#[derive(Debug, Clone)]
pub struct Pair {
    /// What they are.
    pub shape: Shape,
    /// What happens where they meet.
    pub surface: Surface,
}

/// What may touch.
#[derive(Debug, Clone)]
pub enum Shape {
    /// A journal and its bearing.
    Journal(Journal),
    /// A joint and an end of its way.
    Stop(Stop),
    /// A tip and a piece of an outline.
    Edge(Edge),
    /// A joint that closes and opens.
    Clasp(Clasp),
}

/// How rigid surfaces stay together.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Hold {
    /// They do not.
    #[default]
    Free,
    /// One slides along the other.
    Slides,
    /// One rolls on the other.
    Sticks,
}

/// What happens where they meet.
#[derive(Debug, Clone)]
pub enum Surface {
    /// They overlap, and forces follow from the overlap.
    Compliant(Compliant),
    /// They do not overlap: impacts, and constraints while they stay together.
    Rigid(Rigid),
}

/// Impacts, and what surfaces that stay together need besides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rigid {
    /// e, 0 to 1 [–].
    pub restitution: f64,
    /// μ [–].
    pub friction: f64,
    /// What e compares.
    pub sense: Sense,
    /// The pull \[N\] that the surfaces hold once they have met: they stay together up to it, and meet without rebound. None of
    /// those that hold no pull.
    pub latch: Option<f64>,
}

impl Pair {
    /// Whether it has friction.
    pub fn rubs(&self) -> bool {
        match &self.surface {
            Surface::Rigid(rigid) => rigid.friction > 0.0,
            Surface::Compliant(laws) => !matches!(laws.friction, friction::Law::None),
        }
    }

    /// Geometry, velocities and forces; in the phase that `memory` says.
    pub fn read(&self, at: &Kinematics, memory: &Contact) -> Reading {
        let mut reading = self.shape.read(at);
        if self.is_timed() && memory.phase != Phase::Contact {
            reading.penetration = -self.size();
        }
        if let (Phase::Contact, Surface::Compliant(laws)) = (memory.phase, &self.surface) {
            let (depth, rate) = (reading.penetration, reading.rate);
            let normal = laws.normal.continued(depth, rate, memory.approach);
            let friction =
                laws.friction
                    .on_piece(memory.piece, reading.sliding, normal, memory.bristle);
            reading.normal = normal;
            reading.tangential = friction.force;
            reading.bristle_rate = friction.bristle_rate;
            let n = reading.towards;
            reading.force = perp(n) * friction.force - n * normal;
            let elastic = laws.normal.elastic_continued(depth);
            reading.dissipation = (normal - elastic) * rate - friction.force * reading.sliding;
        }
        reading
    }

    /// Adds the contact's forces.
    pub fn apply(&self, at: &Kinematics, memory: &Contact, to: &mut Applied) {
        if memory.phase != Phase::Contact {
            return;
        }
        let reading = self.read(at, memory);
        self.press(at, &reading, [reading.normal, reading.tangential], to);
    }

    /// Adds a normal and a tangential force at the contact of a reading, on both bodies.
    pub fn press(&self, at: &Kinematics, reading: &Reading, forces: [f64; 2], to: &mut Applied) {
        self.shape.press(at, reading, forces, to);
    }

    /// Where the derivatives of the contact's forces can be non-zero, in the order [`Pair::slope`] writes.
    pub fn slopes(&self) -> Vec<Slope> {
        match &self.shape {
            Shape::Journal(journal) => journal.slopes(),
            Shape::Stop(stop) => stop.slopes(),
            Shape::Edge(edge) => edge.slopes(),
            Shape::Clasp(_) => Vec::new(),
        }
    }

    /// Their values, of surfaces without bristles.
    pub fn slope(
        &self,
        at: &Kinematics,
        memory: &Contact,
        position: &mut [f64],
        velocity: &mut [f64],
    ) {
        position.fill(0.0);
        velocity.fill(0.0);
        let (Phase::Contact, Surface::Compliant(laws)) = (memory.phase, &self.surface) else {
            return;
        };
        let reading = self.read(at, memory);
        match &self.shape {
            Shape::Journal(journal) => {
                journal.slope(at, (memory, laws), &reading, position, velocity);
            }
            Shape::Stop(stop) => stop.slope(at, (memory, laws), &reading, position, velocity),
            Shape::Edge(edge) => edge.slope(at, (memory, laws), &reading, position, velocity),
            // It is rigid.
            Shape::Clasp(_) => {}
        }
    }

    /// Elastic energy of the contact \[J\].
    pub fn potential(&self, at: &Kinematics, memory: &Contact) -> f64 {
        match memory.phase {
            Phase::Contact => {
                let depth = self.read(at, &Contact::default()).penetration;
                self.stored(depth, memory)
            }
            Phase::Flight | Phase::Released | Phase::Behind => 0.0,
        }
    }

    /// Elastic energy at a penetration already read \[J\].
    pub fn stored(&self, penetration: f64, memory: &Contact) -> f64 {
        match (memory.phase, &self.surface) {
            (Phase::Contact, Surface::Compliant(laws)) => laws.normal.elastic_energy(penetration),
            (Phase::Flight | Phase::Contact | Phase::Released | Phase::Behind, _) => 0.0,
        }
    }

    /// What penetrations are measured against: the clearance of a journal, the size of the mechanism for others \[m\].
    pub fn size(&self) -> f64 {
        match &self.shape {
            Shape::Journal(journal) => journal.clearance,
            Shape::Stop(stop) => stop.size,
            Shape::Edge(edge) => edge.size,
            Shape::Clasp(clasp) => clasp.size,
        }
    }

    /// The length over which the direction of the contact turns \[m\], where that is short.
    pub fn turns_over(&self) -> Option<f64> {
        match &self.shape {
            Shape::Journal(journal) => Some(journal.clearance),
            Shape::Edge(edge) => edge.turns_over(),
            Shape::Stop(_) | Shape::Clasp(_) => None,
        }
    }

    /// The pull that it holds \[N\], where it latches.
    pub fn latch(&self) -> Option<f64> {
        match &self.surface {
            Surface::Rigid(rigid) => rigid.latch,
            Surface::Compliant(_) => None,
        }
    }

    /// Angle of the contact in the bearing's body \[rad\]; 0 of a stop.
    pub fn angle(&self, at: &Kinematics, reading: &Reading) -> f64 {
        self.journal()
            .map_or(0.0, |journal| journal.bearing_angle(at, reading))
    }

    /// The constraint of rigid surfaces that stay together: its multiplier is N.
    pub fn sustained(&self) -> Arc<dyn Constraint> {
        match &self.shape {
            Shape::Journal(journal) => Arc::new(journal.following()),
            Shape::Stop(stop) => Arc::new(stop.clone()),
            Shape::Edge(edge) => edge.sustained(),
            Shape::Clasp(clasp) => clasp.constraint.clone(),
        }
    }

    /// The constraints of those that do not slide, either: N and T. Nothing slides at a stop.
    pub fn stuck(&self, id: ContactId) -> Arc<dyn Constraint> {
        match &self.shape {
            Shape::Journal(journal) => Arc::new(journal.sticking(id)),
            Shape::Stop(stop) => Arc::new(stop.clone()),
            Shape::Edge(edge) => edge.stuck(id),
            Shape::Clasp(clasp) => clasp.constraint.clone(),
        }
    }

    /// What a contact that begins to stick keeps \[m\].
    pub fn anchor(&self, at: &Kinematics, id: ContactId) -> f64 {
        match &self.shape {
            Shape::Journal(journal) => journal.sticking(id).rolled(at),
            Shape::Edge(edge) => edge.anchor(at, id),
            Shape::Stop(stop) => stop.kept.map_or(0.0, |_| stop.coordinate(at)),
            Shape::Clasp(_) => 0.0,
        }
    }
}

impl Shape {
    /// Geometry and velocities.
    pub fn read(&self, at: &Kinematics) -> Reading {
        match self {
            Shape::Journal(journal) => journal.read(at),
            Shape::Stop(stop) => stop.read(at),
            Shape::Edge(edge) => edge.read(at),
            Shape::Clasp(clasp) => clasp.read(),
        }
    }

    /// Adds a normal and a tangential force at the contact of a reading, on both bodies.
    pub fn press(&self, at: &Kinematics, reading: &Reading, forces: [f64; 2], to: &mut Applied) {
        match self {
            Shape::Journal(journal) => journal.press(at, reading, forces, to),
            Shape::Stop(stop) => stop.press(at, forces[0], to),
            Shape::Edge(edge) => edge.press(at, reading, forces, to),
            // Nothing presses there: it holds by all its rows or not at all.
            Shape::Clasp(_) => {}
        }
    }
}
