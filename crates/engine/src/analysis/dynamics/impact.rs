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
use super::jam::Jam;
use super::motion::Motion;
use crate::contact::impact::resolve;
use crate::element::Constraint;
use crate::element::journal::{Contact, Phase, Reading, Rigid, Surface};
use crate::element::{Applied, Kinematics};
use crate::mechanism::driven::Failure;
use linkdyn_linear::complementary::complementary;
use linkdyn_linear::math::dot;
use nalgebra::DMatrix;

/// Least height of a rebound, in parts of the clearance, whatever the tolerance.
const LOWEST: f64 = 1e-9;
/// Impacts one after the other at one instant after which the rest are one, without rebound.
const MANY: usize = 100;
/// Impulse by which a follower may be pulled, in parts of the impact's, before it lets go.
const PULLED: f64 = 1e-9;

/// Normal speed of a journal that stays where it is [L/T]: above what approaches by round-off.
const AT_REST: f64 = 1e-9;

/// The same in a motion [m/s].
pub(super) fn at_rest(motion: &Motion) -> f64 {
    AT_REST * motion.system().scale.velocity()
}

/// Directions of an impact and what unit impulses along them change.
pub(super) struct Point {
    pub(super) forces: [Vec<f64>; 2],
    rates: [Vec<f64>; 2],
    pub(super) changes: [Vec<f64>; 2],
    mass: [[f64; 2]; 2],
}

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

    /// Journals that touch their bearings with speeds below `slow` lose what brings them nearer, all at once, and of those
    /// that stay the ones that press follow: with p, N ≥ 0 their impulses and normal forces, δ̇ = v − W p ≤ 0 and then
    /// δ̈ = b − W N − W_t T(N) ≤ 0, in each pair one of the two zero.
    pub(super) fn settle(
        &mut self,
        motion: &mut Motion,
        slow: f64,
        time: f64,
    ) -> Result<(), Failure> {
        let were = motion.followers();
        self.go_on_as(motion, &vec![false; were.len()], time)?;
        let contacts: Vec<usize> = (0..were.len())
            .filter(|&contact| were[contact] || touches(motion, contact, slow))
            .collect();
        let points = Point::of(motion, &contacts);
        let mass = inverse_mass(&points, &vec![0.0; contacts.len()]);
        let rates: Vec<f64> = contacts
            .iter()
            .map(|&contact| motion.reading(contact).rate)
            .collect();
        let (stays, impulses) = complementary(&mass, &rates).ok_or(Failure::Singular)?;
        let pushes: Vec<[f64; 2]> = impulses.iter().map(|&impulse| [impulse, 0.0]).collect();
        self.push_all(motion, &contacts, &points, &pushes);
        motion.evaluate(time, &self.y)?;
        let free: Vec<f64> = contacts
            .iter()
            .zip(&points)
            .zip(&stays)
            .map(|((&contact, point), &stays)| {
                // What an impact has stopped may leave by round-off.
                let least = if were[contact] { slow } else { at_rest(motion) };
                let at_rest = stays || motion.reading(contact).rate.abs() <= least;
                if at_rest {
                    approach_acceleration(motion, contact, point)
                } else {
                    f64::NEG_INFINITY
                }
            })
            .collect();
        let ratios: Vec<f64> = contacts
            .iter()
            .map(|&contact| rubbing(motion, contact))
            .collect();
        let rubbed = inverse_mass(&points, &ratios);
        let jam = Jam {
            were: &were,
            contacts: &contacts,
            points: &points,
        };
        let Some((presses, _)) = complementary(&rubbed, &free) else {
            return self.unjam(motion, &jam, 0.0, time);
        };
        let mut following = vec![false; were.len()];
        contacts
            .iter()
            .zip(&presses)
            .for_each(|(&contact, &presses)| following[contact] = presses);
        match self.go_on(motion, &following, time) {
            // These forces answer the motion, but do not come of those without friction.
            Err(Failure::Locked { .. }) => self.unjam(motion, &jam, 0.0, time),
            gone => gone,
        }
    }

    /// Other followers, from the position and velocities at hand; those that were and are not any more end their episodes.
    pub(super) fn go_on(
        &mut self,
        motion: &mut Motion,
        following: &[bool],
        time: f64,
    ) -> Result<(), Failure> {
        self.go_on_as(motion, following, time)?;
        for (contact, &follows) in following.iter().enumerate() {
            let Surface::Rigid(rigid) = motion.system().contacts[contact].surface else {
                continue;
            };
            let (reading, sums) = (motion.reading(contact), self.sums(motion, contact));
            let history = &mut self.histories[contact];
            match (
                motion.reduced.inputs.contacts[contact].phase == Phase::Contact,
                follows,
            ) {
                (true, false) => {
                    history.go_on(&reading, sums, motion.contact_angle(contact, &reading));
                    history.rest(time, &reading, sums);
                    history.end();
                    motion.reduced.inputs.contacts[contact] = Contact::default();
                }
                (false, true) => {
                    history.begin(
                        time,
                        &reading,
                        sums,
                        motion.contact_angle(contact, &reading),
                    );
                    let memory = &mut motion.reduced.inputs.contacts[contact];
                    memory.phase = Phase::Contact;
                    memory.piece = rigid.friction_law().piece(reading.sliding);
                }
                (true, true) | (false, false) => {}
            }
        }
        Ok(())
    }

    /// The equations with these followers.
    pub(super) fn go_on_as(
        &mut self,
        motion: &mut Motion,
        following: &[bool],
        time: f64,
    ) -> Result<(), Failure> {
        let tail = self.y.split_off(2 * motion.reduced.freedom());
        if let Err(failure) = motion.follow(following, time) {
            if let Failure::Locked { .. } = failure {
                self.jammed = (0..following.len())
                    .filter(|&contact| following[contact])
                    .collect();
            }
            self.y.extend(tail);
            return Err(failure);
        }
        self.y.resize(2 * motion.reduced.freedom(), 0.0);
        self.y.extend(tail);
        motion.state(&mut self.y);
        motion.evaluate(time, &self.y)
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
        let strike = self.strike(motion, contact, &point, &rigid, reading)?;
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
        let mut strike = strike;
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
            let (sums, component) = (motion.dissipated(contact), motion.work());
            self.y[sums] += strike.loss;
            self.y[sums + 1] += strike.impulse[0];
            self.y[sums + 2] += strike.sliding;
            self.y[component] += motion.impulsive_work(
                &point.sum(&point.forces, strike.impulse),
                &point.sum(&point.changes, strike.impulse),
            );
        }
        if stays {
            motion.reduced.inputs.contacts[contact] = Contact {
                phase: Phase::Contact,
                approach: reading.rate,
                ..Contact::default()
            };
        } else {
            let (after, sums) = (motion.reading(contact), self.sums(motion, contact));
            self.histories[contact].go_on(&after, sums, angle);
            self.histories[contact].rest(time, &after, sums);
            self.histories[contact].end();
        }
        if stays || strike.parts || jams {
            let slow = if stays {
                (2.0 * fall.max(0.0) * height).sqrt().max(at_rest(motion))
            } else {
                at_rest(motion)
            };
            self.settle(motion, slow, time)?;
            if motion.followers()[contact] {
                self.histories[contact].follow(time, &motion.system().display.length_to(height, 2));
                motion.reduced.inputs.contacts[contact].piece =
                    rigid.friction_law().piece(motion.reading(contact).sliding);
            }
        }
        Ok(())
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

    /// Applies impulses at several contacts at once, none of which follows.
    pub(super) fn push_all(
        &mut self,
        motion: &mut Motion,
        contacts: &[usize],
        points: &[Point],
        pushes: &[[f64; 2]],
    ) {
        let halfway = halfway(motion, points, pushes);
        for ((&contact, point), &push) in contacts.iter().zip(points).zip(pushes) {
            let force = point.sum(&point.forces, push);
            let work = motion.impulsive_work(&force, &point.sum(&point.changes, push));
            let (sums, component) = (motion.dissipated(contact), motion.work());
            self.y[sums] -= dot(&force, &halfway);
            self.y[sums + 1] += push[0];
            self.y[sums + 2] += (push[0] * dot(&point.forces[1], &halfway)).abs();
            self.y[component] += work;
            point.apply(&mut self.y, push);
        }
    }
}

/// Velocities halfway between those before and after these impulses: work is impulse times that.
fn halfway(motion: &Motion, points: &[Point], pushes: &[[f64; 2]]) -> Vec<f64> {
    let mut halfway = motion.reduced.v.clone();
    for (point, &push) in points.iter().zip(pushes) {
        let change = point.sum(&point.changes, push);
        halfway
            .iter_mut()
            .zip(&change)
            .for_each(|(v, change)| *v += 0.5 * change);
    }
    halfway
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

/// T/N of a rigid journal that begins to follow its bearing.
pub(super) fn rubbing(motion: &Motion, contact: usize) -> f64 {
    match &motion.system().contacts[contact].surface {
        Surface::Rigid(rigid) => {
            rigid
                .friction_law()
                .force(motion.reading(contact).sliding, 1.0, 0.0)
                .force
        }
        Surface::Compliant(_) => 0.0,
    }
}

/// Whether a rigid journal is on its bearing's surface, slower than `slow`.
fn touches(motion: &Motion, contact: usize, slow: f64) -> bool {
    let journal = &motion.system().contacts[contact];
    let reading = motion.reading(contact);
    matches!(journal.surface, Surface::Rigid(_))
        && reading.penetration > -LOWEST * journal.clearance
        && reading.rate.abs() <= slow
}

/// W̃ (k, k) of contacts whose impulses or forces along t are `ratios` of those along −n: what each does to δ̇ of the others.
pub(super) fn inverse_mass(points: &[Point], ratios: &[f64]) -> DMatrix<f64> {
    DMatrix::from_fn(points.len(), points.len(), |i, j| {
        let [normal, tangential] = points[j]
            .changes
            .each_ref()
            .map(|change| dot(&points[i].forces[0], change));
        normal + ratios[j] * tangential
    })
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

/// δ̈ of a contact at the point of the last evaluation [m/s²].
fn approach_acceleration(motion: &Motion, contact: usize, point: &Point) -> f64 {
    let following = motion.system().contacts[contact].following();
    let reduced = &motion.reduced;
    let at: Kinematics = reduced.driven.evaluation.kinematics(&reduced.inputs);
    let mut gamma = [0.0];
    following.gamma(&at, &mut gamma);
    -dot(&point.forces[0], &reduced.a) - gamma[0]
}

impl Point {
    /// Of some contacts, as they are at the last evaluation.
    pub(super) fn of(motion: &Motion, contacts: &[usize]) -> Vec<Point> {
        contacts
            .iter()
            .map(|&contact| Point::new(motion, contact, &motion.reading(contact)))
            .collect()
    }

    fn new(motion: &Motion, contact: usize, reading: &Reading) -> Self {
        let system = motion.system();
        let reduced = &motion.reduced;
        let at = reduced.driven.evaluation.kinematics(&reduced.inputs);
        let (n, f) = (system.n(), reduced.freedom());
        let forces = [[1.0, 0.0], [0.0, 1.0]].map(|unit| {
            let mut force = vec![0.0; n];
            let mut applied = Applied::to(&mut force, &system.layout);
            system.contacts[contact].press(&at, reading, unit, &mut applied);
            force
        });
        let rates = forces.each_ref().map(|force| {
            let mut rates = vec![0.0; f];
            reduced.kick(force, &mut rates);
            rates
        });
        let changes = rates.each_ref().map(|rates| {
            let mut change = vec![0.0; n];
            reduced.spread(rates, &mut change);
            change
        });
        let coupling = dot(&forces[1], &changes[0]);
        let mass = [
            [dot(&forces[0], &changes[0]), coupling],
            [coupling, dot(&forces[1], &changes[1])],
        ];
        Point {
            forces,
            rates,
            changes,
            mass,
        }
    }

    /// What impulses make of `forces` or `changes`.
    pub(super) fn sum(&self, parts: &[Vec<f64>; 2], [normal, tangential]: [f64; 2]) -> Vec<f64> {
        parts[0]
            .iter()
            .zip(&parts[1])
            .map(|(n, t)| normal * n + tangential * t)
            .collect()
    }

    /// Changes the rates in y by impulses.
    fn apply(&self, y: &mut [f64], [normal, tangential]: [f64; 2]) {
        let f = self.rates[0].len();
        for (k, y) in y[f..2 * f].iter_mut().enumerate() {
            *y += normal * self.rates[0][k] + tangential * self.rates[1][k];
        }
    }
}
