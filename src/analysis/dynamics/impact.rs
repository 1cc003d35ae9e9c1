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

    /// Journals that touch their bearings with speeds below `slow` lose what brings them nearer, all at once, and of those
    /// that stay the ones that press follow: with p, N ≥ 0 their impulses and normal forces, δ̇ = v − W p ≤ 0 and then
    /// δ̈ = b − W N − W_t T(N) ≤ 0, in each pair one of the two zero.
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
        let (stays, impulses) = complementary(&mass, &rates).ok_or(Failure::Singular)?;
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
                // What an impact has stopped may leave by round-off.
                let least = if were[contact] { slow } else { AT_REST };
                let at_rest = stays || motion.reading(contact).rate.abs() <= least;
                if at_rest { approach_acceleration(motion, contact, point) } else { f64::NEG_INFINITY }
            })
            .collect();
        let ratios: Vec<f64> = contacts.iter().map(|&contact| rubbing(motion, contact)).collect();
        let rubbed = DMatrix::from_fn(size, size, |i, j| {
            mass[(i, j)] + ratios[j] * dot(&points[i].forces[0], &points[j].changes[1])
        });
        let Some((presses, _)) = complementary(&rubbed, &free) else {
            self.jammed = contacts.into_iter().filter(|&contact| rubbing(motion, contact) != 0.0).collect();
            return Err(Failure::Singular);
        };
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
        if let Err(failure) = motion.follow(following, time) {
            if let Failure::Locked { .. } = failure {
                self.jammed = (0..following.len()).filter(|&contact| following[contact]).collect();
            }
            self.y.extend(tail);
            return Err(failure);
        }
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
        let start = self.sums(motion, contact);
        let angle = motion.contact_angle(contact, &reading);
        let height = self.solver.rtol.max(LOWEST) * journal.clearance;
        let strike = self.strike(motion, contact, &point, &law, &reading)?;
        // Where it comes back at once, it stays.
        let before = self.y.clone();
        point.apply(&mut self.y, strike.impulse);
        motion.evaluate(time, &self.y)?;
        let after = motion.reading(contact);
        let fall = approach_acceleration(motion, contact, &point);
        let stays = round >= MANY || (fall > 0.0 && after.rate * after.rate < 2.0 * fall * height);
        self.histories[contact].begin(time, &reading, start, angle);
        let mut strike = strike;
        if stays || strike.parts {
            self.y = before;
            motion.evaluate(time, &self.y)?;
        }
        if stays {
            strike = self.strike(motion, contact, &point, &plastic, &reading)?;
        }
        if strike.parts {
            let restitution = if stays { 0.0 } else { law.restitution };
            self.strike_all(motion, contact, restitution, strike.impulse[1] / strike.impulse[0], time)?;
        } else {
            if stays {
                point.apply(&mut self.y, strike.impulse);
                motion.evaluate(time, &self.y)?;
            }
            let (sums, component) = (motion.dissipated(contact), motion.work());
            self.y[sums] += strike.loss;
            self.y[sums + 1] += strike.impulse[0];
            self.y[component] += motion
                .impulsive_work(&point.sum(&point.forces, strike.impulse), &point.sum(&point.changes, strike.impulse));
        }
        if stays {
            motion.reduced.inputs.contacts[contact] =
                Contact { phase: Phase::Contact, approach: reading.rate, ..Contact::default() };
        } else {
            let (after, sums) = (motion.reading(contact), self.sums(motion, contact));
            self.histories[contact].rest(time, &after, sums);
            self.histories[contact].end();
        }
        if stays || strike.parts {
            let slow = if stays { (2.0 * fall.max(0.0) * height).sqrt().max(AT_REST) } else { AT_REST };
            self.settle(motion, slow, time)?;
            if motion.followers()[contact] {
                self.histories[contact].follow(time, height);
            }
        }
        Ok(())
    }

    /// Impulses of an impact and the energy that it takes [N·s, J], and whether a follower would be pulled by them.
    fn strike(
        &mut self,
        motion: &mut Motion,
        contact: usize,
        point: &Point,
        law: &Rigid,
        reading: &Reading,
    ) -> Result<Strike, Failure> {
        let velocity = [-reading.rate, reading.sliding];
        let found = resolve(point.mass, velocity, law.restitution, law.friction, law.sense);
        if found.wedged {
            return Err(Failure::Singular);
        }
        let (impulse, change) = (point.sum(&point.forces, found.impulse), point.sum(&point.changes, found.impulse));
        let pulled = motion.pulled(&impulse, &change);
        let parts = pulled.is_some_and(|(follower, pull)| follower != contact && pull < -PULLED * found.impulse[0]);
        Ok(Strike { impulse: found.impulse, loss: found.loss, parts })
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
        let contacts: Vec<usize> = (0..were.len()).filter(|&other| were[other] || other == contact).collect();
        let size = contacts.len();
        let points: Vec<Point> =
            contacts.iter().map(|&contact| Point::new(motion, contact, &motion.reading(contact))).collect();
        let directions: Vec<[f64; 2]> =
            contacts.iter().map(|&other| [1.0, if other == contact { ratio } else { 0.0 }]).collect();
        let changes: Vec<Vec<f64>> =
            points.iter().zip(&directions).map(|(point, &way)| point.sum(&point.changes, way)).collect();
        let mass = DMatrix::from_fn(size, size, |i, j| dot(&points[i].forces[0], &changes[j]));
        let wanted: Vec<f64> = contacts
            .iter()
            .map(|&other| {
                let rate = motion.reading(other).rate;
                if other == contact { (1.0 + restitution) * rate } else { rate }
            })
            .collect();
        let (_, impulses) = complementary(&mass, &wanted).ok_or(Failure::Singular)?;
        // Halfway between the velocities before and after: work is impulse times that.
        let mut halfway = motion.reduced.v.clone();
        for (change, impulse) in changes.iter().zip(&impulses) {
            halfway.iter_mut().zip(change).for_each(|(v, change)| *v += 0.5 * impulse * change);
        }
        for (k, point) in points.iter().enumerate() {
            let pushed = directions[k].map(|part| part * impulses[k]);
            let force = point.sum(&point.forces, pushed);
            let work = motion.impulsive_work(&force, &point.sum(&point.changes, pushed));
            let (sums, component) = (motion.dissipated(contacts[k]), motion.work());
            self.y[sums] -= dot(&force, &halfway);
            self.y[sums + 1] += impulses[k];
            self.y[component] += work;
            point.apply(&mut self.y, pushed);
        }
        motion.evaluate(time, &self.y)
    }
}

/// What an impact does.
struct Strike {
    /// [N·s]
    impulse: [f64; 2],
    /// [J]
    loss: f64,
    parts: bool,
}

/// T/N of a rigid journal that begins to follow its bearing.
fn rubbing(motion: &Motion, contact: usize) -> f64 {
    match &motion.system().contacts[contact].surface {
        Surface::Rigid(rigid) => rigid.friction_law().force(motion.reading(contact).sliding, 1.0, 0.0).force,
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

/// x ≥ 0 with b − W x ≤ 0, complementary: which are not zero, and x; none where there is no solution.
///
/// Principal pivoting by least index (Murty 1974), which ends for a positive definite W, in fewer rounds than there are
/// choices. Friction can make W another one, and that without a solution (Painlevé 1895).
fn complementary(mass: &DMatrix<f64>, free: &[f64]) -> Option<(Vec<bool>, Vec<f64>)> {
    let size = free.len();
    let mut pressing = vec![false; size];
    let scale = free.iter().filter(|b| b.is_finite()).fold(0.0, |most: f64, b| most.max(b.abs()));
    for _ in 0..1usize << size.min(12) {
        let chosen: Vec<usize> = (0..size).filter(|&k| pressing[k]).collect();
        let part = DMatrix::from_fn(chosen.len(), chosen.len(), |i, j| mass[(chosen[i], chosen[j])]);
        let right = DVector::from_fn(chosen.len(), |i, _| free[chosen[i]]);
        let forces = if chosen.is_empty() { right } else { part.lu().solve(&right)? };
        let wrong = (0..size).find(|&k| match chosen.iter().position(|&other| other == k) {
            Some(place) => forces[place] < 0.0,
            None => {
                let held: f64 = chosen.iter().zip(forces.iter()).map(|(&other, force)| mass[(k, other)] * force).sum();
                free[k] - held > EVEN * scale
            }
        });
        let Some(wrong) = wrong else {
            let mut x = vec![0.0; size];
            chosen.iter().zip(forces.iter()).for_each(|(&k, force)| x[k] = *force);
            return Some((pressing, x));
        };
        pressing[wrong] = !pressing[wrong];
    }
    None
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
