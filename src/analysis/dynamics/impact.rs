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

use super::contact::worst_guard;
use super::integration::Integration;
use super::motion::Motion;
use crate::contact::impact::resolve;
use crate::element::Constraint;
use crate::element::journal::{Contact, Phase, Reading, Rigid, Surface};
use crate::element::{Applied, Instant};
use crate::math::dot;
use crate::solve::driven::Failure;
use nalgebra::{DMatrix, DVector};

/// Least height of a rebound, in parts of the clearance, whatever the tolerance.
const LOWEST: f64 = 1e-9;
/// Impacts at one instant after which the rest are taken as plastic.
const MANY: usize = 100;
/// Impulse by which a follower may be pulled, in parts of the impact's, before it lets go.
const PULLED: f64 = 1e-9;

/// Normal speed of a journal that stays where it is [m/s].
const AT_REST: f64 = 1e-9;
/// Acceleration, in parts of the largest, that is round-off.
const EVEN: f64 = 1e-12;

/// Directions of an impact and what unit impulses along them change.
struct Point {
    forces: [Vec<f64>; 2],
    rates: [Vec<f64>; 2],
    changes: [Vec<f64>; 2],
    mass: [[f64; 2]; 2],
}

impl Integration {
    /// Resolves what rigid contacts do at `time`: impacts, and journals that let go. The mechanism is at `y` there, before
    /// and after.
    pub(super) fn collide(&mut self, motion: &mut Motion, time: f64) -> Result<(), Failure> {
        for round in 0.. {
            let Some(contact) = acting(motion) else { break };
            if motion.reduced.inputs.contacts[contact].phase == Phase::Contact {
                self.settle(motion, AT_REST, time)?;
            } else {
                self.impact(motion, contact, time, round)?;
            }
            if round > 2 * MANY {
                return Err(Failure::Singular);
            }
        }
        Ok(())
    }

    /// A follower leaves its bearing.
    fn let_go(&mut self, motion: &mut Motion, contact: usize, time: f64) -> Result<(), Failure> {
        let mut following = motion.followers();
        following[contact] = false;
        self.go_on(motion, &following, time)
    }

    /// Journals that touch their bearings with speeds below `slow` lose what brings them nearer, all at once, and of those
    /// that stay the ones that press follow: with p, N ≥ 0 their impulses and normal forces, δ̇ = v − W p ≤ 0 and then
    /// δ̈ = b − W N ≤ 0, in each pair one of the two zero.
    fn settle(&mut self, motion: &mut Motion, slow: f64, time: f64) -> Result<(), Failure> {
        let were = motion.followers();
        self.go_on_as(motion, &vec![false; were.len()], time)?;
        let contacts: Vec<usize> =
            (0..were.len()).filter(|&contact| were[contact] || touches(motion, contact, slow)).collect();
        let size = contacts.len();
        let points: Vec<Point> =
            contacts.iter().map(|&contact| Point::new(motion, contact, &motion.reading(contact))).collect();
        let mass = DMatrix::from_fn(size, size, |i, j| dot(&points[i].forces[0], &points[j].changes[0]));
        let rates: Vec<f64> = contacts.iter().map(|&contact| motion.reading(contact).rate).collect();
        let (stays, impulses) = complementary(&mass, &rates);
        for (k, point) in points.iter().enumerate() {
            if impulses[k] > 0.0 {
                let held: f64 = (0..size).map(|j| mass[(k, j)] * impulses[j]).sum();
                let sums = motion.dissipated(contacts[k]);
                // From v to v − W p at a force that is p in all.
                self.y[sums] += impulses[k] * (rates[k] - 0.5 * held);
                self.y[sums + 1] += impulses[k];
                let pushed = [impulses[k], 0.0];
                let work = motion.impulsive_work(&point.sum(&point.forces, pushed), &point.sum(&point.changes, pushed));
                let component = motion.work();
                self.y[component] += work;
                point.apply(&mut self.y, pushed);
            }
        }
        motion.evaluate(time, &self.y)?;
        let free: Vec<f64> = contacts
            .iter()
            .zip(&points)
            .zip(&stays)
            .map(|((&contact, point), &stays)| {
                let at_rest = stays || were[contact] && motion.reading(contact).rate.abs() <= slow;
                if at_rest { approach_acceleration(motion, contact, point) } else { f64::NEG_INFINITY }
            })
            .collect();
        let (presses, _) = complementary(&mass, &free);
        let mut following = vec![false; were.len()];
        for (&contact, &presses) in contacts.iter().zip(&presses) {
            following[contact] = presses;
            if presses && motion.reduced.inputs.contacts[contact].phase == Phase::Flight {
                let (reading, sums) = (motion.reading(contact), self.sums(motion, contact));
                let angle = motion.contact_angle(contact, &reading);
                self.histories[contact].begin(time, &reading, sums, angle);
            }
        }
        self.go_on(motion, &following, time)
    }

    /// Other followers, from the position and velocities at hand; those that were and are not any more end their episodes.
    fn go_on(&mut self, motion: &mut Motion, following: &[bool], time: f64) -> Result<(), Failure> {
        for (contact, &follows) in following.iter().enumerate() {
            let memory = &motion.reduced.inputs.contacts[contact];
            if matches!(motion.system().contacts[contact].surface, Surface::Compliant(_)) {
                continue;
            }
            if memory.phase == Phase::Contact && !follows {
                let (reading, sums) = (motion.reading(contact), self.sums(motion, contact));
                self.histories[contact].rest(time, &reading, sums);
                self.histories[contact].end();
                motion.reduced.inputs.contacts[contact] = Contact::default();
            } else if follows {
                motion.reduced.inputs.contacts[contact].phase = Phase::Contact;
            }
        }
        self.go_on_as(motion, following, time)
    }

    /// The equations with these followers.
    fn go_on_as(&mut self, motion: &mut Motion, following: &[bool], time: f64) -> Result<(), Failure> {
        let tail = self.y.split_off(2 * motion.reduced.freedom());
        motion.follow(following, time)?;
        self.y.resize(2 * motion.reduced.freedom(), 0.0);
        self.y.extend(tail);
        motion.state(&mut self.y);
        motion.evaluate(time, &self.y)
    }

    fn impact(&mut self, motion: &mut Motion, contact: usize, time: f64, round: usize) -> Result<(), Failure> {
        let system = motion.system();
        let journal = &system.contacts[contact];
        let Surface::Rigid(rigid) = journal.surface else { return Ok(()) };
        let reading = motion.reading(contact);
        let point = Point::new(motion, contact, &reading);
        let plastic = Rigid { restitution: 0.0, ..rigid };
        let law = if round >= MANY { plastic } else { rigid };
        let resolved = self.strike(motion, contact, &point, &law, &reading, time)?;
        let Some((pushed, loss)) = resolved else { return Ok(()) };
        // Where it comes back at once, it stays.
        let before = self.y.clone();
        point.apply(&mut self.y, pushed);
        motion.evaluate(time, &self.y)?;
        let after = motion.reading(contact);
        let fall = approach_acceleration(motion, contact, &point);
        let height = self.solver.rtol.max(LOWEST) * journal.clearance;
        let stays = round >= MANY || (fall > 0.0 && after.rate * after.rate < 2.0 * fall * height);
        let start = self.sums(motion, contact);
        let angle = motion.contact_angle(contact, &reading);
        self.histories[contact].begin(time, &reading, start, angle);
        let (pushed, loss) = if stays {
            self.y = before;
            motion.evaluate(time, &self.y)?;
            let resolved = self.strike(motion, contact, &point, &plastic, &reading, time)?;
            let Some(resolved) = resolved else { return Ok(()) };
            point.apply(&mut self.y, resolved.0);
            motion.evaluate(time, &self.y)?;
            resolved
        } else {
            (pushed, loss)
        };
        let sums = motion.dissipated(contact);
        self.y[sums] += loss;
        self.y[sums + 1] += pushed[0];
        let work = motion.work();
        self.y[work] += motion.impulsive_work(&point.sum(&point.forces, pushed), &point.sum(&point.changes, pushed));
        if stays {
            motion.reduced.inputs.contacts[contact] =
                Contact { phase: Phase::Contact, approach: reading.rate, ..Contact::default() };
            let slow = (2.0 * fall.max(0.0) * height).sqrt().max(AT_REST);
            self.settle(motion, slow, time)?;
            if motion.followers()[contact] {
                self.histories[contact].follow(time, height);
            }
        } else {
            let (after, sums) = (motion.reading(contact), self.sums(motion, contact));
            self.histories[contact].rest(time, &after, sums);
            self.histories[contact].end();
        }
        Ok(())
    }

    /// Impulses of an impact and the energy that it takes [N·s, J]; none where a follower has to let go first, which it then
    /// has.
    fn strike(
        &mut self,
        motion: &mut Motion,
        contact: usize,
        point: &Point,
        law: &Rigid,
        reading: &Reading,
        time: f64,
    ) -> Result<Option<([f64; 2], f64)>, Failure> {
        let velocity = [-reading.rate, reading.sliding];
        let found = resolve(point.mass, velocity, law.restitution, law.friction, law.sense);
        if found.wedged {
            return Err(Failure::Singular);
        }
        let (impulse, change) = (point.sum(&point.forces, found.impulse), point.sum(&point.changes, found.impulse));
        let pulled = motion.pulled(&impulse, &change);
        if let Some((follower, pull)) = pulled
            && pull < -PULLED * found.impulse[0]
            && follower != contact
        {
            self.let_go(motion, follower, time)?;
            return Ok(None);
        }
        Ok(Some((found.impulse, found.loss)))
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

/// x ≥ 0 with b − W x ≤ 0, complementary: which are not zero, and x.
///
/// Principal pivoting by least index (Murty 1974), which ends for a positive definite W; more rounds than it can need end it
/// for a singular one.
fn complementary(mass: &DMatrix<f64>, free: &[f64]) -> (Vec<bool>, Vec<f64>) {
    let size = free.len();
    let (mut pressing, mut x) = (vec![false; size], vec![0.0; size]);
    let scale = free.iter().filter(|b| b.is_finite()).fold(0.0, |most: f64, b| most.max(b.abs()));
    for _ in 0..1usize << size.min(12) {
        let chosen: Vec<usize> = (0..size).filter(|&k| pressing[k]).collect();
        let part = DMatrix::from_fn(chosen.len(), chosen.len(), |i, j| mass[(chosen[i], chosen[j])]);
        let right = DVector::from_fn(chosen.len(), |i, _| free[chosen[i]]);
        let solved = if chosen.is_empty() { Some(right) } else { part.lu().solve(&right) };
        let Some(forces) = solved else { break };
        let wrong = (0..size).find(|&k| match chosen.iter().position(|&other| other == k) {
            Some(place) => forces[place] < 0.0,
            None => {
                let held: f64 = chosen.iter().zip(forces.iter()).map(|(&other, force)| mass[(k, other)] * force).sum();
                free[k] - held > EVEN * scale
            }
        });
        let Some(wrong) = wrong else {
            chosen.iter().zip(forces.iter()).for_each(|(&k, force)| x[k] = *force);
            break;
        };
        pressing[wrong] = !pressing[wrong];
    }
    (pressing, x)
}

/// A rigid contact whose guard is positive.
fn acting(motion: &Motion) -> Option<usize> {
    let system = motion.system();
    (0..system.contacts.len()).find(|&contact| {
        let journal = &system.contacts[contact];
        matches!(journal.surface, Surface::Rigid(_))
            && worst_guard(journal, &motion.reduced.inputs.contacts[contact], &motion.reading(contact)) > 0.0
    })
}

/// δ̈ of a contact at the point of the last evaluation [m/s²].
fn approach_acceleration(motion: &Motion, contact: usize, point: &Point) -> f64 {
    let following = motion.system().contacts[contact].following();
    let reduced = &motion.reduced;
    let at: Instant = reduced.driven.evaluation.instant(&reduced.inputs);
    let mut gamma = [0.0];
    following.gamma(&at, &mut gamma);
    -dot(&point.forces[0], &reduced.a) - gamma[0]
}

impl Point {
    fn new(motion: &Motion, contact: usize, reading: &Reading) -> Self {
        let system = motion.system();
        let reduced = &motion.reduced;
        let at = reduced.driven.evaluation.instant(&reduced.inputs);
        let (n, f) = (system.n(), reduced.freedom());
        let forces = [[1.0, 0.0], [0.0, 1.0]].map(|unit| {
            let mut force = vec![0.0; n];
            system.contacts[contact].press(&at, reading, unit, &mut Applied { q: &mut force });
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
        let mass = [[dot(&forces[0], &changes[0]), coupling], [coupling, dot(&forces[1], &changes[1])]];
        Point { forces, rates, changes, mass }
    }

    /// What impulses make of `forces` or `changes`.
    fn sum(&self, parts: &[Vec<f64>; 2], [normal, tangential]: [f64; 2]) -> Vec<f64> {
        parts[0].iter().zip(&parts[1]).map(|(n, t)| normal * n + tangential * t).collect()
    }

    /// Changes the rates in y by impulses.
    fn apply(&self, y: &mut [f64], [normal, tangential]: [f64; 2]) {
        let f = self.rates[0].len();
        for (k, y) in y[f..2 * f].iter_mut().enumerate() {
            *y += normal * self.rates[0][k] + tangential * self.rates[1][k];
        }
    }
}
