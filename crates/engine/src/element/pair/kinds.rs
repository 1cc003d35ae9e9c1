//! What a pair is.

use super::{Pair, Shape};
use crate::element::clasp::Clasp;
use crate::element::edge::Edge;
use crate::element::journal::Journal;
use crate::element::stop::Stop;

impl Pair {
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
