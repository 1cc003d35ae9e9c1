//! What a pair is.

use super::{Pair, Reading, Shape};
use crate::element::Kinematics;
use crate::element::clasp::Clasp;
use crate::element::edge::Edge;
use crate::element::journal::Journal;
use crate::element::stop::{Stop, Travel};

/// A contact by functions that are as smooth as the motion, which are above zero together where δ and the room are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Level {
    /// A multiple of δ \[m\], at δ = 0 δ itself.
    pub value: f64,
    /// Its rate [m/s].
    pub rate: f64,
    /// How far the contact is from where its surface ends \[m\].
    pub rooms: [f64; 2],
}

impl Pair {
    /// The contact's level.
    ///
    /// A distance has a sharp bend where what is measured passes near, its square has none. With δ = ±(d − R), and R above
    /// zero where d > R touches:
    ///
    /// ```text
    /// (d² − R²)/2R = δ (1 + δ/2R)
    /// ```
    pub fn level(&self, at: &Kinematics, reading: &Reading) -> Level {
        let (depth, rate) = (reading.penetration, reading.rate);
        let radius = match &self.shape {
            Shape::Journal(journal) => journal.clearance,
            Shape::Stop(stop) if stop.way == Travel::Apart => stop.side.sign() * stop.limit,
            Shape::Edge(edge) => edge.bend(),
            Shape::Stop(_) | Shape::Clasp(_) => 0.0,
        };
        let bend = if radius == 0.0 { 0.0 } else { depth / radius };
        let rooms = self.edge().map(|edge| edge.level_rooms(at, reading));
        Level {
            value: depth * (1.0 + 0.5 * bend),
            rate: rate * (1.0 + bend),
            rooms: rooms.unwrap_or([f64::INFINITY; 2]),
        }
    }

    /// Its journal, where it is one in a bearing.
    pub fn journal(&self) -> Option<&Journal> {
        match &self.shape {
            Shape::Journal(journal) => Some(journal),
            Shape::Stop(_) | Shape::Edge(_) | Shape::Clasp(_) => None,
        }
    }

    /// Its stop, where it is one.
    pub fn stop(&self) -> Option<&Stop> {
        match &self.shape {
            Shape::Stop(stop) => Some(stop),
            Shape::Journal(_) | Shape::Edge(_) | Shape::Clasp(_) => None,
        }
    }

    /// The piece of an outline, where it is one.
    pub fn edge(&self) -> Option<&Edge> {
        match &self.shape {
            Shape::Edge(edge) => Some(edge),
            Shape::Journal(_) | Shape::Stop(_) | Shape::Clasp(_) => None,
        }
    }

    /// The joint that closes and opens as a whole, where it is one.
    pub fn clasp(&self) -> Option<&Clasp> {
        match &self.shape {
            Shape::Clasp(clasp) => Some(clasp),
            Shape::Journal(_) | Shape::Stop(_) | Shape::Edge(_) => None,
        }
    }

    /// Whether events close it, and not what it touches.
    pub fn is_timed(&self) -> bool {
        let is_lock = |stop: &Stop| stop.kept.is_some_and(|kept| kept.is_lock);
        self.clasp().is_some() || self.stop().is_some_and(is_lock)
    }

    /// Whether it is a one-way clutch, which touches always.
    pub fn is_one_way(&self) -> bool {
        let is_one_way = |stop: &Stop| stop.kept.is_some_and(|kept| !kept.is_lock);
        self.stop().is_some_and(is_one_way)
    }

    /// Whether the mechanism is put together with it: bodies at stops and outlines, but not journals, which their bearings hold.
    pub fn limits(&self) -> bool {
        self.journal().is_none()
    }
}
