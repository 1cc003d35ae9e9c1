//! Impacts of rigid journals, and the journals that follow their bearings from there or leave them.
//!
//! ```text
//! r_n, r_t          generalized forces of unit forces at the contact, along −n and t on the journal   (n)
//! SᵀMS Δu̇ = Sᵀ P,   Δv = S Δu̇,   P = p_n r_n + p_t r_t
//! W = [r_n r_t]ᵀ S (SᵀMS)⁻¹ Sᵀ [r_n r_t]                                                              [1/kg]
//! ```
//!
//! (p_n, p_t) by [`crate::contact::impact`]. Journals that follow take part as constraints; where the impulse would pull one
//! to its bearing, that one lets go first. Several impacts at one instant are taken one after the other until none
//! approaches. An impact whose rebound would come back after a flight lower than a small part of the clearance, v²/(2 δ̈), is
//! one of infinitely many in a finite time: the journal loses its normal velocity and follows the surface.

use super::contact::{lets_go, worst_guard};
use super::integration::Integration;
use super::motion::Motion;
use super::point::{LOWEST, Point, approach_acceleration, at_rest, halfway, inverse_mass, touches};
use crate::contact::impact::resolve;
use crate::element::journal::{Contact, Phase, Reading, Rigid, Surface};
use crate::mechanism::driven::Failure;
use linkdyn_linear::complementary::complementary;
use linkdyn_linear::math::dot;

/// Impacts one after the other at one instant after which the rest are one, without rebound.
const MANY: usize = 100;
/// Impulse by which a follower may be pulled, in parts of the impact's, before it lets go.
const PULLED: f64 = 1e-9;

impl Integration {
    /// Resolves what rigid contacts do at `time`: impacts, and journals that let go. The mechanism is at `y` there, before
    /// and after.
    pub(super) fn collide(&mut self, motion: &mut Motion, time: f64) -> Result<(), Failure> {
        for round in 0.. {
            let Some(contact) = acting(motion) else { break };
            if round >= MANY {
                self.settle(motion, f64::INFINITY, time)?;
            } else if motion.reduced.inputs.contacts[contact].phase == Phase::Contact {
                self.settle(motion, at_rest(motion), time)?;
            } else {
                let reading = motion.reading(contact);
                self.impact(motion, contact, &reading, time)?;
            }
            if round > 2 * MANY {
                let touching = (0..self.histories.len())
                    .filter(|&contact| touches(motion, contact, f64::INFINITY));
                self.jammed = touching.filter(|&contact| motion.rubs(contact)).collect();
                return Err(Failure::Singular);
            }
        }
        Ok(())
    }

    /// An impact of `contact`, which is in flight, with the velocities of `reading`.
    pub(super) fn impact(
        &mut self,
        motion: &mut Motion,
        contact: usize,
        reading: &Reading,
        time: f64,
    ) -> Result<(), Failure> {
        let system = motion.system();
        let journal = &system.contacts[contact];
        let Surface::Rigid(rigid) = journal.surface else {
            return Ok(());
        };
        let point = Point::new(motion, contact, reading);
        let plastic = Rigid {
            restitution: 0.0,
            ..rigid
        };
        let start = self.sums(motion, contact);
        let angle = motion.contact_angle(contact, reading);
        let height = self.wanted.rtol.max(LOWEST) * journal.clearance;
        let mut strike = self.strike(motion, contact, &point, &rigid, reading)?;
        // Where it comes back at once, it stays.
        let before = self.y.clone();
        point.apply(&mut self.y, strike.impulse);
        // Followers that jam at the new velocities are free again before it goes on.
        let jams = !answered(motion.evaluate(time, &self.y))?;
        let after = motion.reading(contact);
        let fall = if jams {
            0.0
        } else {
            approach_acceleration(motion, contact, &point)
        };
        let stays = fall > 0.0 && after.rate * after.rate < 2.0 * fall * height;
        self.histories[contact].begin(time, reading, start, angle);
        if stays || strike.parts {
            self.y = before;
            motion.evaluate(time, &self.y)?;
        }
        if stays {
            strike = self.strike(motion, contact, &point, &plastic, reading)?;
        }
        if strike.parts {
            let restitution = if stays { 0.0 } else { rigid.restitution };
            self.strike_all(
                motion,
                contact,
                restitution,
                strike.impulse[1] / strike.impulse[0],
                time,
            )?;
        } else {
            if stays {
                point.apply(&mut self.y, strike.impulse);
                answered(motion.evaluate(time, &self.y))?;
            }
            self.count(motion, contact, &point, &strike);
        }
        if stays {
            motion.reduced.inputs.contacts[contact] = Contact {
                phase: Phase::Contact,
                approach: reading.rate,
                ..Contact::default()
            };
        } else {
            self.leave(motion, contact, angle, time);
        }
        if stays || strike.parts || jams {
            let slow = if stays {
                (2.0 * fall.max(0.0) * height).sqrt().max(at_rest(motion))
            } else {
                at_rest(motion)
            };
            self.settle(motion, slow, time)?;
            if motion.followers()[contact] {
                self.stay(motion, contact, &rigid, height, time);
            }
        }
        Ok(())
    }

    /// The journal follows its bearing after an impact whose rebound would be lower than `height`.
    fn stay(&mut self, motion: &mut Motion, contact: usize, law: &Rigid, height: f64, time: f64) {
        self.histories[contact].follow(time, &motion.system().display.length_to(height, 2));
        motion.reduced.inputs.contacts[contact].piece =
            law.friction_law().piece(motion.reading(contact).sliding);
    }

    /// The journal is off its bearing again at once after an impact at `angle`.
    fn leave(&mut self, motion: &Motion, contact: usize, angle: f64, time: f64) {
        let (after, sums) = (motion.reading(contact), self.sums(motion, contact));
        self.histories[contact].go_on(&after, sums, angle);
        self.histories[contact].rest(time, &after, sums);
        self.histories[contact].end();
    }

    /// Adds what an impact dissipates and does to the sums of its contact and the work.
    fn count(&mut self, motion: &mut Motion, contact: usize, point: &Point, strike: &Strike) {
        let (sums, component) = (motion.dissipated(contact), motion.work());
        self.y[sums] += strike.loss;
        self.y[sums + 1] += strike.impulse[0];
        self.y[sums + 2] += strike.sliding;
        self.y[component] += motion.impulsive_work(
            &point.sum(&point.forces, strike.impulse),
            &point.sum(&point.changes, strike.impulse),
        );
    }

    /// Impulses of an impact and the energy that it takes [N·s, J], and whether a follower would be pulled by them;
    /// where there are none against the followers, their direction.
    fn strike(
        &mut self,
        motion: &mut Motion,
        contact: usize,
        point: &Point,
        law: &Rigid,
        reading: &Reading,
    ) -> Result<Strike, Failure> {
        let velocity = [-reading.rate, reading.sliding];
        let found = resolve(
            point.mass,
            velocity,
            law.restitution,
            law.friction,
            law.sense,
        );
        if found.wedged {
            // Nothing can move between the followers, or friction holds it there.
            let ratio = -law.friction
                * if reading.sliding == 0.0 {
                    0.0
                } else {
                    reading.sliding.signum()
                };
            return Ok(Strike {
                impulse: [1.0, ratio],
                loss: 0.0,
                sliding: 0.0,
                parts: true,
            });
        }
        let (impulse, change) = (
            point.sum(&point.forces, found.impulse),
            point.sum(&point.changes, found.impulse),
        );
        let pulled = motion.pulled(&impulse, &change);
        let parts = pulled.is_some_and(|(follower, pull)| {
            follower != contact && pull < -PULLED * found.impulse[0]
        });
        Ok(Strike {
            impulse: found.impulse,
            loss: found.loss,
            sliding: found.sliding,
            parts,
        })
    }

    /// An impact from which followers part: they and the journal that strikes get their impulses p ≥ 0 all at once, so that
    /// δ̇₊ ≤ −e δ̇₋ (e = 0 for followers), and δ̇₊ = −e δ̇₋ where p > 0 (Moreau 1988). `ratio` is p_t/p_n where it strikes.
    fn strike_all(
        &mut self,
        motion: &mut Motion,
        contact: usize,
        restitution: f64,
        ratio: f64,
        time: f64,
    ) -> Result<(), Failure> {
        let were = motion.followers();
        self.go_on_as(motion, &vec![false; were.len()], time)?;
        let contacts: Vec<usize> = (0..were.len())
            .filter(|&other| were[other] || other == contact)
            .collect();
        let points = Point::of(motion, &contacts);
        let wanted: Vec<f64> = contacts
            .iter()
            .map(|&other| {
                let rate = motion.reading(other).rate;
                if other == contact {
                    (1.0 + restitution) * rate
                } else {
                    rate
                }
            })
            .collect();
        // With friction there may be no such impulses, or some that give energy; without there are always some that take it.
        let pushes = [ratio, 0.0].into_iter().find_map(|ratio| {
            let ratios: Vec<f64> = contacts
                .iter()
                .map(|&other| if other == contact { ratio } else { 0.0 })
                .collect();
            let (_, impulses) = complementary(&inverse_mass(&points, &ratios), &wanted)?;
            let pushes: Vec<[f64; 2]> = ratios
                .iter()
                .zip(&impulses)
                .map(|(ratio, impulse)| [*impulse, ratio * impulse])
                .collect();
            let halfway = halfway(motion, &points, &pushes);
            let work: f64 = points
                .iter()
                .zip(&pushes)
                .map(|(point, &push)| dot(&point.sum(&point.forces, push), &halfway))
                .sum();
            (ratio == 0.0 || work <= 0.0).then_some(pushes)
        });
        let pushes = pushes.ok_or(Failure::Singular)?;
        self.push_all(motion, &contacts, &points, &pushes);
        motion.evaluate(time, &self.y)
    }
}

/// What an impact does.
struct Strike {
    /// [N·s]
    impulse: [f64; 2],
    /// \[J\]
    loss: f64,
    /// ∫|v_t| dp_n [N·m]
    sliding: f64,
    parts: bool,
}

/// Whether forces answer the motion, where nothing else is wrong.
fn answered(evaluated: Result<(), Failure>) -> Result<bool, Failure> {
    match evaluated {
        Err(Failure::Locked { .. }) => Ok(false),
        other => other.map(|()| true),
    }
}

/// A rigid contact whose guard is positive.
fn acting(motion: &Motion) -> Option<usize> {
    let system = motion.system();
    (0..system.contacts.len()).find(|&contact| {
        let journal = &system.contacts[contact];
        let (memory, reading) = (
            &motion.reduced.inputs.contacts[contact],
            motion.reading(contact),
        );
        // What friction does asks for no impulse.
        let guard = if memory.phase == Phase::Contact {
            lets_go(&system.scale, &reading)
        } else {
            worst_guard(&system.scale, journal, memory, &reading)
        };
        matches!(journal.surface, Surface::Rigid(_)) && guard > 0.0
    })
}
