//! Touches that pass along an outline: over the seams of its pieces, behind it, and, by a fault, into its material.
//!
//! At any instant a tip touches an outline as one body. Where one piece ends and the next goes on smoothly or around a corner
//! (see [`End`](crate::element::edge::End)) the touch goes over to that: its phase, its laws' memory and its books. No force
//! changes, and nothing begins or ends.

use super::fault::Fault;
use super::flow::Flow;
use super::modes::{is_past, passes};
use super::simulation::Simulation;
use crate::element::Kinematics;
use crate::element::pair::{Contact, Phase, Surface};

/// Pieces in a row that are so short that a tip may pass over them at once.
const SHORT: usize = 8;
/// Depth of a tip in the material, in parts of the mechanism, that is more than any touch leaves unseen.
const WITHIN: f64 = 1e-6;

fn touches(memory: &Contact) -> bool {
    matches!(memory.phase, Phase::Contact | Phase::Released)
}

impl Flow<'_> {
    /// Whether a neighbour of a piece of an outline that yields carries the touch, which goes over to it sooner or later.
    pub fn is_carried(&self, contact: usize) -> bool {
        let pair = &self.system().contacts[contact];
        let (Some(edge), Surface::Compliant(_)) = (pair.edge(), &pair.surface) else {
            return false;
        };
        let mut next = edge.ends.iter().filter_map(|end| end.next);
        let carries = next.any(|next| touches(&self.memories()[next.0]));
        carries && !touches(&self.memories()[contact])
    }

    /// The piece to which the touch of a piece goes over, at whose end the tip is; `None` if the outline does not go on.
    pub fn next_piece(&self, contact: usize) -> Option<usize> {
        let at = self.equations.kinematics();
        let mut here = contact;
        let mut side = self.side(contact, &at)?;
        for _ in 0..SHORT {
            let contacts = &self.system().contacts;
            let next = contacts[here].edge()?.ends[side].next?.0;
            let edge = contacts[next].edge()?;
            if !is_past(&contacts[next], &self.reading(next)) {
                return (next != contact).then_some(next);
            }
            // Out by its other end.
            let back = edge.ends[0].next.is_some_and(|first| first.0 == here);
            let other = usize::from(back);
            if self.side(next, &at) != Some(other) {
                return None;
            }
            (here, side) = (next, other);
        }
        None
    }

    /// The end beyond which the tip is.
    fn side(&self, contact: usize, at: &Kinematics) -> Option<usize> {
        let pair = &self.system().contacts[contact];
        let reading = self.reading(contact);
        let edge = pair.edge().filter(|_| is_past(pair, &reading))?;
        Some(edge.nearer_end(at, &reading))
    }
}

impl Simulation<'_> {
    /// Touches of outlines that yield go over to the next piece.
    pub(super) fn hand_over(&mut self) {
        for from in 0..self.flow.memories().len() {
            let memory = self.flow.memories()[from];
            let is_yielding = matches!(
                self.flow.system().contacts[from].surface,
                Surface::Compliant(_)
            );
            if !is_yielding || !touches(&memory) {
                continue;
            }
            let Some(to) = self.flow.next_piece(from) else {
                continue;
            };
            if touches(&self.flow.memories()[to]) {
                continue;
            }
            *self.flow.memory_mut(from) = Contact::default();
            *self.flow.memory_mut(to) = memory;
            self.state.hand_bristle([from, to]);
            let reading = self.flow.reading(to);
            self.ledger.hand_over(&self.state, [from, to], &reading);
        }
    }

    /// Tips that have gone behind an outline, or have come out from there.
    pub(super) fn pass(&mut self) {
        for (contact, pair) in self.flow.system().contacts.iter().enumerate() {
            if self.flow.is_carried(contact) {
                continue;
            }
            let reading = self.flow.reading(contact);
            passes(pair, self.flow.memory_mut(contact), &reading);
        }
    }

    /// Whether a tip is in the material of a closed outline that it does not touch, where the mechanism was evaluated last.
    pub(super) fn check_outlines(&self) -> Result<(), Fault> {
        let system = self.flow.system();
        let at = self.flow.equations.kinematics();
        for enclosure in &system.enclosures {
            let edges = enclosure.edges.clone();
            let memories = &self.flow.memories()[edges.clone()];
            if memories.iter().any(touches) || !enclosure.has_inside(&at) {
                continue;
            }
            let near = system.contacts[edges.clone()].iter();
            let near = near.filter_map(|pair| Some(pair.edge()?.near(&at)?[0]));
            if near.fold(f64::INFINITY, f64::min) > WITHIN * system.size {
                return Err(Fault::Inside {
                    contact: edges.start,
                });
            }
        }
        Ok(())
    }
}
