//! The mechanism at an instant at which contacts act at once: its state, its constraints, and the books on both.

use super::grips::ContactMode;
use super::jamming::Jams;
use super::point::ContactPoint;
use super::touching::Touching;
use crate::analysis::dynamics::flow::Flow;
use crate::analysis::dynamics::ledger::{Entry, Ledger};
use crate::analysis::dynamics::state::{State, Sums};
use crate::element::pair::{Contact, ContactId, Hold, Phase, Reading, Surface};
use crate::mechanism::driven::Failure;
use linkdyn_linear::math::dot;

/// The mechanism at an instant.
pub struct Instant<'a, 's> {
    /// \[s\]
    pub time: f64,
    /// The mechanism, evaluated at `state`.
    pub flow: &'a mut Flow<'s>,
    /// y.
    pub state: &'a mut State,
    /// What contacts do.
    pub ledger: &'a mut Ledger,
    /// What is known of jams.
    pub jams: &'a mut Jams,
}

impl Instant<'_, '_> {
    /// The mechanism at the state at hand.
    pub(super) fn evaluate(&mut self) -> Result<(), Failure> {
        self.flow.evaluate(self.time, self.state.as_slice())
    }

    /// The same, and whether forces answer the motion where nothing else is wrong.
    pub(super) fn is_answered(&mut self) -> Result<bool, Failure> {
        match self.evaluate() {
            Err(Failure::Locked { .. }) => Ok(false),
            other => other.map(|()| true),
        }
    }

    /// A contact with this reading, for the ledger.
    pub(super) fn entry(&self, contact: usize, reading: &Reading) -> Entry {
        self.ledger
            .entry((self.flow, self.state), contact, reading, self.time)
    }

    /// Impulses at one contact, which dissipate and slide so much.
    pub(super) fn push(
        &mut self,
        contact: usize,
        point: &ContactPoint,
        impulse: [f64; 2],
        sums: Sums,
    ) {
        point.apply(self.state.rates_mut(), impulse);
        self.count(contact, point, impulse, sums);
    }

    /// What impulses have done goes into the sums of their contact and the work.
    pub(super) fn count(
        &mut self,
        contact: usize,
        point: &ContactPoint,
        impulse: [f64; 2],
        sums: Sums,
    ) {
        self.state.add_sums(contact, sums);
        let (force, change) = (
            point.sum(&point.forces, impulse),
            point.sum(&point.changes, impulse),
        );
        self.state
            .add_work(self.flow.impulsive_work(&force, &change));
    }

    /// Impulses at several contacts at once.
    ///
    /// # Errors
    /// Where the mechanism can't be evaluated with the velocities after them.
    pub(super) fn push_all(
        &mut self,
        touching: &Touching,
        pushes: &[[f64; 2]],
    ) -> Result<(), Failure> {
        let halfway = touching.halfway(self.flow, pushes);
        let contacts = touching.contacts.iter().zip(&touching.points);
        for ((&contact, point), &push) in contacts.zip(pushes) {
            let sums = Sums {
                dissipated: -dot(&point.sum(&point.forces, push), &halfway),
                impulse: push[0],
                sliding: (push[0] * dot(&point.forces[1], &halfway)).abs(),
            };
            self.push(contact, point, push, sums);
        }
        self.evaluate()
    }

    /// The journal is off its bearing again at once after an impact at `angle`.
    pub(super) fn leave(&mut self, contact: usize, angle: f64) {
        let entry = Entry {
            angle,
            ..self.entry(contact, &self.flow.reading(contact))
        };
        let history = self.ledger.history(contact);
        history.go_on(&entry);
        history.rest(&entry);
        history.end();
    }

    /// No contact is sustained from here, but for latches that hold; how they were held, `Free` of these latches.
    pub(super) fn release_all(&mut self) -> Result<Vec<Hold>, Failure> {
        let mut were = self.flow.holds();
        let mut holds = vec![Hold::Free; were.len()];
        for contact in 0..were.len() {
            if self.flow.is_latched(contact) {
                holds[contact] = std::mem::take(&mut were[contact]);
            }
        }
        self.exchange_rows(&holds)?;
        Ok(were)
    }

    /// A contact latches: it is sustained from here, whatever pulls.
    pub(super) fn latch(&mut self, contact: usize, is_event: bool) -> Result<(), Failure> {
        let mut holds = self.flow.holds();
        holds[contact] = Hold::Slides;
        let pair = &self.flow.system().contacts[contact];
        let at = self.flow.equations.kinematics();
        let anchor = pair
            .stop()
            .map_or(0.0, |_| pair.anchor(&at, ContactId(contact)));
        let memory = self.flow.memory_mut(contact);
        (memory.phase, memory.anchor) = (Phase::Contact, anchor);
        self.exchange_rows(&holds)?;
        if is_event {
            self.ledger.history(contact).latch(self.time, true);
        }
        Ok(())
    }

    /// The equations with contacts that are held so, from the position and velocities at hand.
    fn exchange_rows(&mut self, holds: &[Hold]) -> Result<(), Failure> {
        if let Err(failure) = self.flow.hold(holds, self.time) {
            if let Failure::Locked { .. } = failure {
                self.jams.contacts = (0..holds.len())
                    .filter(|&contact| holds[contact] != Hold::Free)
                    .collect();
            }
            return Err(failure);
        }
        self.state.set_freedom(self.flow.layout().freedom());
        self.flow.store(self.state);
        self.evaluate()
    }

    /// All contacts do this from here, which were held so before; those that leave end their episodes.
    pub(super) fn take(&mut self, were: &[Hold], modes: &[ContactMode]) -> Result<(), Failure> {
        // Latches that hold are held already.
        let mut holds = self.flow.holds();
        for (contact, mode) in modes.iter().enumerate() {
            if holds[contact] != Hold::Free {
                continue;
            }
            let pair = &self.flow.system().contacts[contact];
            let (hold, way, anchor) = match *mode {
                ContactMode::Leaves => continue,
                // It holds where it has begun to.
                ContactMode::Slips(_) if pair.is_one_way() && were[contact] == Hold::Slides => {
                    (Hold::Slides, 0, self.flow.memories()[contact].anchor)
                }
                ContactMode::Slips(_) if pair.is_one_way() => {
                    let at = self.flow.equations.kinematics();
                    (Hold::Slides, 0, pair.anchor(&at, ContactId(contact)))
                }
                ContactMode::Slips(ratio) => (Hold::Slides, -sign(ratio), 0.0),
                ContactMode::Sticks if were[contact] == Hold::Sticks => {
                    (Hold::Sticks, 0, self.flow.memories()[contact].anchor)
                }
                ContactMode::Sticks => {
                    let at = self.flow.equations.kinematics();
                    let anchor = pair.anchor(&at, ContactId(contact));
                    (Hold::Sticks, 0, anchor)
                }
            };
            holds[contact] = hold;
            let memory = self.flow.memory_mut(contact);
            (memory.piece, memory.anchor) = (way, anchor);
        }
        self.exchange_rows(&holds)?;
        self.hand_over(were, &holds);
        for (contact, &hold) in holds.iter().enumerate() {
            // What surfaces that yield do is not for impulses to say.
            if matches!(
                self.flow.system().contacts[contact].surface,
                Surface::Compliant(_)
            ) {
                continue;
            }
            let stays = hold != Hold::Free;
            let reading = self.flow.reading(contact);
            let entry = self.entry(contact, &reading);
            let history = self.ledger.history(contact);
            match (self.flow.is_in_contact(contact), stays) {
                (true, false) => {
                    if self.flow.system().contacts[contact].latch().is_some() {
                        history.latch(self.time, false);
                    }
                    history.go_on(&entry);
                    history.rest(&entry);
                    history.end();
                    *self.flow.memory_mut(contact) = Contact::default();
                }
                (false, true) => {
                    history.begin(&entry);
                    self.flow.memory_mut(contact).phase = Phase::Contact;
                }
                (true, true) if were[contact] != Hold::Free && were[contact] != hold => {
                    history.switch(self.time, hold == Hold::Sticks);
                }
                (true, true) | (false, false) => {}
            }
        }
        Ok(())
    }
}

impl Instant<'_, '_> {
    /// Touches go over to the next piece of their outline where that is held from now on.
    fn hand_over(&mut self, were: &[Hold], holds: &[Hold]) {
        for (from, hold) in holds.iter().enumerate() {
            if !self.flow.is_in_contact(from) || *hold != Hold::Free {
                continue;
            }
            let next = self.flow.next_piece(from);
            let next = next.filter(|&to| !self.flow.is_in_contact(to) && holds[to] != Hold::Free);
            let Some(to) = next else { continue };
            let approach = self.flow.memories()[from].approach;
            *self.flow.memory_mut(from) = Contact::default();
            let memory = self.flow.memory_mut(to);
            (memory.phase, memory.approach) = (Phase::Contact, approach);
            let reading = self.flow.reading(to);
            self.ledger.hand_over(self.state, [from, to], &reading);
            if were[from] != Hold::Free && were[from] != holds[to] {
                let sticks = holds[to] == Hold::Sticks;
                self.ledger.history(to).switch(self.time, sticks);
            }
        }
    }
}

/// −1, 0 or 1.
fn sign(x: f64) -> i8 {
    i8::from(x > 0.0) - i8::from(x < 0.0)
}
