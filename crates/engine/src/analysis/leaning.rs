//! Equilibria in which joints lean on their stops.
//!
//! A stop presses, N ≥ 0 at δ = 0 (or N = K δ where it yields), or it is left alone, N = 0 and δ ≤ 0. Which do what is searched for:
//! without any first, then with those that the mechanism has gone beyond, and without those that would pull. The
//! search stops where it first meets one, and goes on from there: the way behind may lead out again, as behind a thin outline, or to a
//! distance that a mechanism has twice.

use super::assembly::Assembled;
use super::control::{Control, Stop as Failed};
use super::ends::{BEYOND, seen};
use super::equilibrium::{balance, start};
use super::sample::{ContactSample, Sample};
use crate::element::Kinematics;
use crate::element::pair::{ContactId, Hold, Pair, Reading, Surface};
use crate::element::quantity::Measured;
use crate::element::stop::Stop;
use crate::element::yielding::Yielding;
use crate::mechanism::equilibrium::Balance;
use crate::mechanism::linearised_system::LinearisedSystem;
use crate::system::{ForceData, ForceRole, Owner, System};
use linkdyn_output::Status;
use std::sync::Arc;

/// Pull of a stop that is round-off, in parts of the mechanism's force.
const PULL: f64 = 1e-9;
/// Choices that are tried.
const MANY: usize = 64;

/// The mechanism with some of its stops pressed, at rest or on the way there.
struct Leaning<'s> {
    /// The whole mechanism, its stops included.
    whole: &'s System,
    pressed: Vec<ContactId>,
    /// Contacts from whose free side the search comes (by contact): pieces of outlines may be behind others.
    free: &'s [bool],
}

/// Calls `told` with the equilibrium, in which stops press where they have to, at a time; the mechanism begins at `q` (n).
///
/// Joints that begin at an end with a latch are latched.
///
/// # Errors
/// Those of [`start`] and [`balance`], and where no choice of stops gives an equilibrium.
pub fn rest<T>(
    system: &System,
    (q, time): (&[f64], f64),
    control: &Control,
    told: impl FnOnce(&Assembled, &mut LinearisedSystem, &Balance, &[ContactSample]) -> T,
) -> Result<T, Failed> {
    let free = seen(system, q, |at| free(system, at));
    let mut queue: Vec<Vec<ContactId>> = vec![latched(system, q)];
    let mut guess = None;
    let mut failure = None;
    let mut next = 0;
    while next < queue.len().min(MANY) {
        let leaning = Leaning {
            whole: system,
            pressed: queue[next].clone(),
            free: &free,
        };
        next += 1;
        let held_system = leaning.system(guess.as_deref());
        let begun = start(&held_system, time, false);
        let (assembled, mut held) = match begun {
            Ok(begun) => begun,
            // The first is the mechanism itself; others may hold more than there is.
            Err(failed) if next == 1 => return Err(failed),
            Err(_) => continue,
        };
        let depth = |held: &LinearisedSystem| leaning.depth(held);
        let balanced = balance(&mut held, &assembled, control, Some(&depth));
        let was_met = balanced.is_err() && depth(&held) > 0.0;
        let contacts = leaning.readings(&mut held);
        let others = leaning.others(&contacts);
        match balanced {
            Ok(balance) if others.is_empty() => {
                return Ok(told(&assembled, &mut held, &balance, &contacts));
            }
            Err(failed) if others.is_empty() => failure = failure.or(Some(failed)),
            Ok(_) | Err(_) => {}
        }
        if was_met {
            guess = Some(held.q.clone());
        } else if guess.is_none() {
            guess = Some(assembled.q.clone());
        }
        for other in others {
            if !queue.contains(&other) {
                queue.push(other);
            }
        }
    }
    Err(failure.unwrap_or_else(|| {
        let message = "no equilibrium found: neither with the stops of joints that are passed, nor without those that would pull";
        Failed::failed(Status::Singular, message.into())
    }))
}

/// Whether each contact is seen from its free side.
fn free(system: &System, at: &Kinematics) -> Vec<bool> {
    let of = |pair: &Pair| {
        pair.edge().is_none_or(|edge| {
            let reading = edge.read(at);
            reading.room > 0.0 && reading.penetration <= edge.deepest
        })
    };
    system.contacts.iter().map(of).collect()
}

/// Latches that are closed at a position.
fn latched(system: &System, q: &[f64]) -> Vec<ContactId> {
    let closed = |id: &ContactId, at: &Kinematics| {
        let pair = &system.contacts[id.0];
        let stop = pair.stop().filter(|_| pair.latch().is_some());
        stop.is_some_and(|stop| stop.read(at).penetration.abs() <= BEYOND * stop.size)
    };
    let all = (0..system.contacts.len()).map(ContactId);
    seen(system, q, |at| all.filter(|id| closed(id, at)).collect())
}

/// The mechanism held by the latches that are closed at a position; `None` if there are none.
pub fn latched_system(system: &System, q: &[f64]) -> Option<System> {
    let pressed = latched(system, q);
    let leaning = Leaning {
        whole: system,
        pressed,
        free: &[],
    };
    (!leaning.pressed.is_empty()).then(|| leaning.system(None))
}

impl Leaning<'_> {
    /// The mechanism with constraints and springs for the stops that are pressed.
    fn system(&self, guess: Option<&[f64]>) -> System {
        let mut holds = vec![Hold::Free; self.whole.contacts.len()];
        for id in &self.pressed {
            if matches!(self.whole.contacts[id.0].surface, Surface::Rigid(_)) {
                holds[id.0] = Hold::Slides;
            }
        }
        let mut system = self.whole.with_rows(&holds, Vec::new());
        for id in &self.pressed {
            let pair = &self.whole.contacts[id.0];
            if let Some(yielding) = Yielding::of(pair) {
                let [first, second] = match (pair.stop(), self.whole.owner_of(*id)) {
                    (None, Owner::Joint(joint)) => self.whole.joints[joint.0].points(),
                    (Some(stop), _) => [stop.first, stop.second],
                    // What forces have are stops.
                    (None, Owner::Force(_)) => continue,
                };
                let apart = Measured::Distance { first, second };
                // Beside its numbers: what belts and bushings exert stands behind those that have some.
                let place = system.force_data.len();
                system.forces.insert(place, Arc::new(yielding));
                system.force_data.push(ForceData {
                    name: self.whole.owner_name(*id).to_owned(),
                    role: ForceRole::Spring {
                        between: [first.body, second.body],
                        measured: pair.stop().map_or(apart, Stop::measured),
                        is_actuator: false,
                    },
                });
            }
        }
        if let Some(guess) = guess {
            // Where the search begins is said there.
            system.guess.copy_from_slice(guess);
            system.initial.clear();
        }
        system
    }

    /// Contacts where the mechanism is.
    fn readings(&self, held: &mut LinearisedSystem) -> Vec<ContactSample> {
        let mut sample = Sample::new(held.driven.system);
        held.driven.multipliers(&held.force, &mut sample.lambda);
        let at = held.driven.evaluation.kinematics(&held.inputs);
        let contacts = self.whole.contacts.iter().enumerate();
        let readings = contacts.map(|(contact, pair)| {
            let id = ContactId(contact);
            let is_pressed = self.pressed.contains(&id);
            if !pair.limits() {
                return ContactSample::default();
            }
            let mut reading = pair.shape.read(&at);
            if is_pressed {
                reading.normal = match &pair.surface {
                    Surface::Compliant(laws) => {
                        laws.normal.continued(reading.penetration, 0.0, 0.0)
                    }
                    Surface::Rigid(_) => {
                        let block = held.driven.system.held_block(contact);
                        block.map_or(0.0, |block| sample.lambda[block.row()])
                    }
                };
            }
            ContactSample {
                reading,
                state: f64::from(u8::from(is_pressed)),
            }
        });
        readings.collect()
    }

    /// Choices that this one leads to: `None` if nothing contradicts it.
    fn others(&self, contacts: &[ContactSample]) -> Vec<Vec<ContactId>> {
        let mut others = Vec::new();
        let pull = PULL * self.whole.scale.force();
        for id in &self.pressed {
            let held = self.whole.contacts[id.0].latch().unwrap_or(0.0);
            let reading = &contacts[id.0].reading;
            let has_left = reading.room < -BEYOND * self.whole.size;
            if reading.normal < -pull - held || has_left {
                let rest = self.pressed.iter().filter(|other| *other != id);
                others.push(rest.copied().collect());
            }
        }
        let mut passed: Vec<(f64, ContactId)> = contacts
            .iter()
            .enumerate()
            .map(|(contact, sample)| (self.passed(contact, &sample.reading), ContactId(contact)))
            .filter(|(depth, id)| *depth > BEYOND * self.whole.size && !self.pressed.contains(id))
            .collect();
        passed.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (_, id) in passed {
            others.push(vec![id]);
            if !self.pressed.is_empty() {
                let mut more = self.pressed.clone();
                more.push(id);
                more.sort_by_key(|id| id.0);
                others.push(more);
            }
        }
        others
    }

    /// How far the mechanism is beyond a contact \[m or rad\].
    fn passed(&self, contact: usize, reading: &Reading) -> f64 {
        match self.whole.contacts[contact].edge() {
            Some(edge) if !self.free[contact] => edge.depth(reading, self.whole.size),
            Some(_) | None => reading.penetration.min(reading.room),
        }
    }

    /// How far the mechanism is beyond those that do not press yet, more than round-off \[m\].
    fn depth(&self, held: &LinearisedSystem) -> f64 {
        let at = held.driven.evaluation.kinematics(&held.inputs);
        let contacts = self.whole.contacts.iter().enumerate();
        let others = contacts.filter(|(contact, pair)| {
            pair.limits() && !self.pressed.contains(&ContactId(*contact))
        });
        let depths = others.map(|(contact, pair)| self.passed(contact, &pair.shape.read(&at)));
        depths.fold(0.0, f64::max) - BEYOND * self.whole.size
    }
}
