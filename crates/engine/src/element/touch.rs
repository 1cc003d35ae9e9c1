//! What a contact remembers from step to step, and what is read of it at an instant, whatever touches.

use crate::contact::{friction, normal};
use linkdyn_linear::math::{Vec2, perp};

/// Where a contact's memory stands in `Kinematics::contacts`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ContactId(pub usize);

/// What a contact is doing.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Phase {
    /// No force.
    #[default]
    Flight,
    /// It presses.
    Contact,
    /// Still overlaps, but the law's force would pull: none.
    Released,
    /// On the other side of the surface, where it is none.
    Behind,
}

/// A contact's memory.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Contact {
    /// What it is doing.
    pub phase: Phase,
    /// Speed at which this episode's contact was approached, δ̇₀ [m/s].
    pub approach: f64,
    /// Piece of the friction law that holds; of a rigid journal the way it slides, ±1, or 0 where it sticks.
    pub piece: i8,
    /// Bristles' deflection z of the friction law \[m\].
    pub bristle: f64,
    /// Where a rigid journal sticks: what its rolling keeps \[m\], see [`Sticking`](super::following::Sticking). Where a lock or a
    /// one-way clutch holds: the coordinate there [m or rad].
    pub anchor: f64,
}

/// Laws of a contact whose surfaces overlap.
#[derive(Debug, Clone)]
pub struct Compliant {
    /// Normal force.
    pub normal: normal::Law,
    /// Friction force.
    pub friction: friction::Law,
}

/// A contact at an instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reading {
    /// e of a journal \[m\]
    pub eccentricity: Vec2,
    /// n, from the second body into the first; of a stop none is meant.
    pub towards: Vec2,
    /// How far the contact is from where the surface ends \[m\], negative beyond; infinite of one that does not end.
    pub room: f64,
    /// δ \[m\], negative in flight, and δ̇ [m/s].
    pub penetration: f64,
    /// δ̇ [m/s].
    pub rate: f64,
    /// v_t [m/s]
    pub sliding: f64,
    /// N and T \[N\].
    pub normal: f64,
    /// T \[N\].
    pub tangential: f64,
    /// Force on the journal, ground frame \[N\].
    pub force: Vec2,
    /// Rate of the bristles' deflection [m/s].
    pub bristle_rate: f64,
    /// D' \[W\]
    pub dissipation: f64,
    /// Arms a_b and a_j of a journal \[m\].
    pub(super) arms: [f64; 2],
}

impl Default for Reading {
    fn default() -> Self {
        Reading {
            eccentricity: Vec2::zeros(),
            towards: Vec2::zeros(),
            room: f64::INFINITY,
            penetration: 0.0,
            rate: 0.0,
            sliding: 0.0,
            normal: 0.0,
            tangential: 0.0,
            force: Vec2::zeros(),
            bristle_rate: 0.0,
            dissipation: 0.0,
            arms: [0.0; 2],
        }
    }
}

impl Reading {
    /// Forces of a rigid journal that slides on its bearing's surface.
    pub fn slide(&mut self, normal: f64, tangential: f64) {
        (self.normal, self.tangential) = (normal, tangential);
        // The constraint tells the normal force among the reactions.
        self.force = perp(self.towards) * tangential;
        self.dissipation = -tangential * self.sliding;
    }

    /// Forces of a rigid journal that sticks there, which are among the reactions.
    pub fn stick(&mut self, [normal, tangential]: [f64; 2]) {
        (self.normal, self.tangential) = (normal, tangential);
    }
}
