//! Joints, and locks of joints, that events close and open.

use super::System;
use crate::element::formula::Formula;
use crate::element::journal::Free;
use crate::element::pair::{ContactId, Hold, Pair, Shape};
use crate::element::{Constraint, Kinematics};
use std::sync::Arc;

/// Something that closes and opens.
#[derive(Clone)]
pub(crate) struct TimedData {
    /// What.
    pub contact: ContactId,
    /// Where it closes; none of what holds at the start.
    pub from: Option<Trigger>,
    /// Where it opens.
    pub until: Option<Trigger>,
}

/// An event: a function that is 1 where it has happened, else 0.
#[derive(Clone)]
pub(crate) struct Trigger {
    /// The function.
    pub formula: Arc<Formula>,
    /// Whether it happens from whichever side it is come to.
    pub either_way: bool,
}

impl Trigger {
    /// Whether it is true, by its values.
    pub fn is_true(&self, at: &Kinematics) -> bool {
        !self.either_way && self.by_values(at)
    }

    /// Whether it happens where its sides go from those that are held over to those of its values.
    pub fn happens(&self, at: &Kinematics) -> bool {
        let was = self.formula.value(at) > 0.5;
        let is = self.by_values(at);
        was != is && (is || self.either_way)
    }

    fn by_values(&self, at: &Kinematics) -> bool {
        let free = Kinematics { sides: &[], ..*at };
        self.formula.value(&free) > 0.5
    }
}

impl System {
    /// Whether anything of it begins to hold where it is, by events or by turning back.
    pub(crate) fn begins_to_hold(&self) -> bool {
        !self.timed.is_empty() || self.contacts.iter().any(Pair::is_one_way)
    }

    /// Which contacts hold from the start on, by no event.
    pub(crate) fn held_at_start(&self) -> impl Iterator<Item = usize> {
        let timed = self.timed.iter().filter(|timed| timed.from.is_none());
        timed.map(|timed| timed.contact.0)
    }

    /// The system in which all joints are open that may be; `None` if there are none.
    pub(crate) fn opened(&self) -> Option<System> {
        let clasps = self.contacts.iter().zip(self.contact_rows.iter());
        let clasps = clasps.filter(|(pair, _)| pair.clasp().is_some());
        let blocks = clasps.filter_map(|(_, rows)| rows.block);
        let open = blocks.map(|block| (block, Arc::new(Free) as Arc<dyn Constraint>));
        let open: Vec<_> = open.collect();
        (!open.is_empty()).then(|| self.with_rows(&vec![Hold::Free; self.contacts.len()], open))
    }

    /// The system at rest: locks and one-way clutches have the places that `place` tells, where they hold at the start.
    pub(crate) fn standing(&self, place: impl Fn(ContactId) -> f64) -> Option<System> {
        let has_kept = self.contacts.iter().any(|pair| {
            let stop = pair.stop();
            stop.is_some_and(|stop| stop.kept.is_some())
        });
        if !has_kept {
            return None;
        }
        let mut system = self.clone();
        for contact in 0..system.contacts.len() {
            let id = ContactId(contact);
            let is_open = self
                .timed
                .iter()
                .any(|timed| timed.contact == id && timed.from.is_some());
            let pair = &mut Arc::make_mut(&mut system.contacts)[contact];
            let Shape::Stop(stop) = &mut pair.shape else {
                continue;
            };
            if stop.kept.take().is_some() {
                // What is open is nowhere near.
                stop.limit = if is_open { f64::INFINITY } else { place(id) };
                system.rows_anew(id);
            }
        }
        Some(system)
    }
}
