//! What contacts of rigid surfaces do at an instant: impacts, sustained contacts that begin, stick, slip and end, and jams.
//!
//! Several impacts at one instant are taken one after the other until none approaches. An impact whose rebound would come back
//! after a flight lower than a small part of the clearance, v²/(2 δ̈), is one of infinitely many in a finite time: the journal
//! loses its normal velocity and stays on the surface, as a sustained contact. So do those that its impact throws off no higher
//! while the others hold: two walls that hold a tip would else pass it to and fro.

mod closing;
mod grips;
mod impact;
mod instant;
mod jamming;
mod loosening;
mod point;
mod touching;
mod vanishing;

use super::flow::Flow;
use super::modes::{creep, is_past, is_there};
use super::state::Sums;
use crate::analysis::ends;
use crate::element::pair::{Contact, Hold, Phase, Reading, Rigid, Surface};
use crate::mechanism::driven::Failure;
use grips::{ContactMode, Grips};
use impact::Strike;
use jamming::JamPushes;
use point::{ContactPoint, LOWEST, acting, acting_of, approach_acceleration, touches};
use touching::Touching;

pub use instant::Instant;
pub use jamming::Jams;
pub use point::at_rest;

/// Impacts one after the other at one instant after which the rest are one, without rebound.
const MANY: usize = 100;

/// Part of an impact's work that is round-off.
const EVEN: f64 = 1e-9;

/// Determinant of the friction's equations, 1 without friction, below which round-off decides which forces answer a motion.
const UNDETERMINED: f64 = 1e-9;

/// Resolves what contacts do at an instant.
pub struct Impulses<'a, 's> {
    at: Instant<'a, 's>,
    /// Least height of a rebound, in parts of the clearance.
    lowest: f64,
}

/// The last impact at a contact that is sustained from there.
struct Last {
    /// u₋ [m/s]
    speed: f64,
    /// a [m/s²]
    fall: f64,
    /// e [–]
    restitution: f64,
}

impl<'a, 's> Impulses<'a, 's> {
    /// At an instant of a motion with this relative tolerance.
    pub fn new(at: Instant<'a, 's>, rtol: f64) -> Self {
        Impulses {
            at,
            lowest: rtol.max(LOWEST),
        }
    }

    /// Resolves what rigid contacts do: impacts, and contacts that let go. The mechanism is at the state before and after.
    ///
    /// # Errors
    /// Where no impulses answer the motion.
    pub fn resolve(&mut self) -> Result<(), Failure> {
        let resolved = self.try_to_resolve();
        resolved.map_err(|failure| self.of_contacts(failure))
    }

    /// What locks by the friction of contacts is a jam: the joints' own forces stand in every phase, those of contacts do not.
    fn of_contacts(&self, failure: Failure) -> Failure {
        match failure {
            Failure::Locked { force } if force >= self.at.flow.layout().forces() => {
                Failure::Singular
            }
            other => other,
        }
    }

    /// Contacts at rest go on as what they are: those that press are sustained.
    ///
    /// # Errors
    /// As in [`Impulses::resolve`].
    pub fn rest(&mut self) -> Result<(), Failure> {
        for contact in 0..self.at.flow.memories().len() {
            let pair = &self.at.flow.system().contacts[contact];
            if pair.latch().is_some() && rests(self.at.flow, contact) {
                let reading = self.at.flow.reading(contact);
                let entry = self.at.entry(contact, &reading);
                self.at.ledger.history(contact).begin(&entry);
                self.at.latch(contact, true)?;
            }
        }
        let settled = self.settle(at_rest(self.at.flow));
        settled.map_err(|failure| self.of_contacts(failure))
    }

    fn try_to_resolve(&mut self) -> Result<(), Failure> {
        for round in 0.. {
            let Some(contact) = acting(self.at.flow) else {
                break;
            };
            if round >= MANY {
                self.settle(f64::INFINITY)?;
            } else if self.at.flow.is_in_contact(contact) {
                self.settle(at_rest(self.at.flow))?;
            } else {
                let reading = self.at.flow.reading(contact);
                self.impact(contact, &reading)?;
            }
            if round > 2 * MANY {
                let flow = &*self.at.flow;
                let contacts = 0..flow.memories().len();
                self.at.jams.contacts = contacts
                    .filter(|&contact| touches(flow, contact, f64::INFINITY))
                    .filter(|&contact| flow.has_rigid_friction(contact))
                    .collect();
                return Err(Failure::Singular);
            }
        }
        Ok(())
    }

    /// An impact of `contact`, which is in flight, with the velocities of `reading`.
    fn impact(&mut self, contact: usize, reading: &Reading) -> Result<(), Failure> {
        let pair = &self.at.flow.system().contacts[contact];
        let Surface::Rigid(rigid) = pair.surface else {
            return Ok(());
        };
        let point = ContactPoint::new(self.at.flow, contact, reading);
        let entry = self.at.entry(contact, reading);
        let height = self.lowest * pair.size();
        let mut strike = Strike::new(self.at.flow, &point, &rigid, reading);
        // Where it comes back at once, it stays.
        let before = self.at.state.clone();
        point.apply(self.at.state.rates_mut(), strike.impulse);
        // Sustained contacts that jam at the new velocities are free again before it goes on.
        let jams = !self.at.is_answered()?;
        let after = self.at.flow.reading(contact);
        let fall = if jams {
            0.0
        } else {
            approach_acceleration(self.at.flow, contact, &point)
        };
        let latches = rigid.latch.is_some();
        let stays = latches || fall > 0.0 && after.rate * after.rate < 2.0 * fall * height;
        self.at.ledger.history(contact).begin(&entry);
        if stays || strike.parts {
            *self.at.state = before;
            self.at.evaluate()?;
        }
        let law = Rigid {
            restitution: if stays { 0.0 } else { rigid.restitution },
            ..rigid
        };
        if stays {
            strike = Strike::new(self.at.flow, &point, &law, reading);
        }
        if strike.parts {
            self.strike_together(contact, law.restitution, strike.ratio())?;
        } else {
            if stays {
                point.apply(self.at.state.rates_mut(), strike.impulse);
                self.at.is_answered()?;
            }
            self.at.count(contact, &point, strike.impulse, strike.sums);
            self.note_gain(contact, reading, &strike.sums);
        }
        if stays {
            *self.at.flow.memory_mut(contact) = Contact {
                phase: Phase::Contact,
                approach: reading.rate,
                ..Contact::default()
            };
        } else {
            self.at.leave(contact, entry.angle);
        }
        if latches {
            self.at.latch(contact, true)?;
            return self.settle(at_rest(self.at.flow));
        }
        if stays || strike.parts || jams {
            let slow = if stays {
                (2.0 * fall.max(0.0) * height)
                    .sqrt()
                    .max(at_rest(self.at.flow))
            } else {
                at_rest(self.at.flow)
            };
            self.settle(slow)?;
            if self.at.flow.holds()[contact] != Hold::Free {
                let last = Last {
                    speed: reading.rate,
                    fall,
                    restitution: rigid.restitution,
                };
                self.note_sustained(contact, (height, last));
            }
        }
        Ok(())
    }

    /// Tells the ledger of an impact that gains energy, beyond round-off of the work that it does.
    fn note_gain(&mut self, contact: usize, reading: &Reading, sums: &Sums) {
        if sums.dissipated < -EVEN * sums.impulse * reading.rate {
            let (system, time) = (self.at.flow.system(), self.at.time);
            self.at.ledger.gain(system, contact, time, -sums.dissipated);
        }
    }

    /// The contact is sustained after an impact whose rebound would be lower than `height`.
    ///
    /// Those of a stop are summed up: with the acceleration −a of the flights, and u₋ the speed of the last impact, they take
    /// 2 e u₋/a (1 + e + e² + …) = 2 e u₋/(a (1 − e)).
    fn note_sustained(&mut self, contact: usize, (height, last): (f64, Last)) {
        let system = self.at.flow.system();
        let Last {
            speed,
            fall,
            restitution,
        } = last;
        let pair = &system.contacts[contact];
        let rest = match pair.limits() {
            false => 0.0,
            // Without rebound there is nothing that dies away.
            true if restitution == 0.0 => return,
            true => {
                let rest = 2.0 * restitution * speed / (fall * (1.0 - restitution));
                // They have no end where nothing is lost.
                if rest.is_finite() { rest } else { 0.0 }
            }
        };
        let height = ends::depth(pair, &system.display, height, 2);
        let history = self.at.ledger.history(contact);
        history.sustain(self.at.time + rest, &height);
    }

    /// An impact from which sustained contacts part. `ratio` is p_t/p_n where it strikes.
    fn strike_together(
        &mut self,
        contact: usize,
        restitution: f64,
        ratio: f64,
    ) -> Result<(), Failure> {
        let were = self.at.release_all()?;
        let contacts = (0..were.len()).filter(|&k| were[k] != Hold::Free || k == contact);
        let touching = Touching::new(self.at.flow, contacts.collect());
        let pushes = impact::together(self.at.flow, &touching, contact, restitution, ratio);
        self.at
            .push_all(&touching, &pushes.ok_or(Failure::Singular)?)
    }

    /// Journals that touch their bearings with speeds below `slow` lose what brings them nearer, all at once, and of those
    /// that stay the ones that press are sustained: with p, N ≥ 0 their impulses and normal forces, δ̇ = v − W p ≤ 0 and then
    /// δ̈ = b − W N − W_t T ≤ 0, in each pair one of the two zero, and T
    /// by [`grips`].
    fn settle(&mut self, slow: f64) -> Result<(), Failure> {
        let were = self.at.release_all()?;
        self.settle_from(&were, slow)
    }

    /// The same where contacts were held so, and none is but latches.
    fn settle_from(&mut self, were: &[Hold], slow: f64) -> Result<(), Failure> {
        let flow = &*self.at.flow;
        let latched = flow.holds();
        let held = (0..were.len()).filter(|&k| were[k] != Hold::Free);
        let handed: Vec<usize> = held.filter_map(|k| flow.next_piece(k)).collect();
        let contacts = (0..were.len()).filter(|&k| {
            let pair = &flow.system().contacts[k];
            let (held, reading) = (were[k] != Hold::Free, flow.reading(k));
            let goes_on = (held || handed.contains(&k)) && is_there(pair, &reading);
            // Also where round-off would have it there once more.
            let has_left = held && is_past(pair, &reading);
            let acts = !has_left && (goes_on || touches(flow, k, slow));
            latched[k] == Hold::Free && !pair.is_timed() && acts
        });
        let contacts = contacts.collect();
        let touching = Touching::new(self.at.flow, contacts);
        let rates = self.to_stop(&touching);
        let (stays, impulses) = touching
            .solve(&vec![0.0; touching.len()], &rates)
            .ok_or(Failure::Singular)?;
        let pushes: Vec<[f64; 2]> = impulses.iter().map(|&impulse| [impulse, 0.0]).collect();
        self.at.push_all(&touching, &pushes)?;
        let flow = &*self.at.flow;
        let rates = touching.approaches(flow);
        let accelerations = touching.approach_accelerations(flow);
        let mut free: Vec<f64> = (0..touching.len())
            .map(|k| {
                // What an impact has stopped may leave by round-off.
                let contact = touching.contacts[k];
                let was = were[contact] != Hold::Free || handed.contains(&contact);
                let least = if was { slow } else { at_rest(flow) };
                if stays[k] || rates[k].abs() <= least {
                    accelerations[k]
                } else {
                    f64::NEG_INFINITY
                }
            })
            .collect();
        let parting = free.clone();
        touching.keep_low(flow, (&rates, &accelerations), self.lowest, &mut free);
        let (along, slides) = (touching.along(flow), touching.sliding_accelerations(flow));
        let solve = |free: &[f64]| Grips::new(&touching, &along, [free, &slides]).solve();
        // What leaves slowly does so where no forces would keep it.
        let parts = || (parting != free).then(|| solve(&parting)).flatten();
        let found = solve(&free).or_else(parts);
        let Some((found, _)) = found else {
            let way = JamPushes::find(self.at.flow, &touching);
            return self.end_jam(&touching, way);
        };
        // What is left of the velocities where an event was located goes by impulses too, which take no energy.
        let left = [
            touching.approaches(self.at.flow),
            touching.slidings(self.at.flow),
        ];
        let pushes = Grips::new(&touching, &along, [&left[0], &left[1]]).resting(&found);
        if let Some(pushes) = pushes {
            self.at.push_all(&touching, &pushes)?;
        }
        let mut modes = vec![ContactMode::Leaves; were.len()];
        let contacts = touching.contacts.iter().zip(found);
        contacts.for_each(|(&contact, mode)| modes[contact] = mode);
        match self.at.take(were, &modes) {
            // These forces answer the motion, but do not come of those without friction.
            Err(Failure::Locked { .. }) => {
                let way = JamPushes::find(self.at.flow, &touching);
                self.end_jam(&touching, way)
            }
            Ok(()) if self.is_contradicted(&modes) => {
                self.at.release_all()?;
                let touching = Touching::new(self.at.flow, touching.contacts);
                let way = JamPushes::find(self.at.flow, &touching);
                self.end_jam(&touching, way)
            }
            gone => gone,
        }
    }

    /// Whether contacts that press by these modes are pulled, where their forces are all but undetermined: d is zero then but for
    /// round-off, and no forces answer the motion.
    fn is_contradicted(&self, modes: &[ContactMode]) -> bool {
        let flow = &*self.at.flow;
        let presses = |contact: usize| modes[contact] != ContactMode::Leaves;
        flow.equations.dependent_forces().margin().abs() <= UNDETERMINED
            && acting_of(flow, presses).is_some()
    }

    /// δ̇ that impulses have to stop. Outlines may hold a tip from two sides at once, where round-off would ask for what can't be:
    /// what is none leaves them room.
    fn to_stop(&self, touching: &Touching) -> Vec<f64> {
        let flow = &*self.at.flow;
        let room = creep(&flow.system().scale);
        let rates = touching.approaches(flow);
        let contacts = touching.contacts.iter().zip(rates);
        contacts
            .map(
                |(&contact, rate)| match flow.system().contacts[contact].edge() {
                    Some(_) if rate <= room => rate - room,
                    _ => rate,
                },
            )
            .collect()
    }
}

/// Whether rigid surfaces touch, at rest against each other.
pub fn rests(flow: &Flow, contact: usize) -> bool {
    touches(flow, contact, at_rest(flow))
}
