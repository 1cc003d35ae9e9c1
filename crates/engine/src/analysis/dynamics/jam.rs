//! Jams: rigid journals that slide on their bearings so that friction presses them on, and no normal forces answer the motion.
//!
//! ```text
//! δ̈ = b − W̃ N ≤ 0,   W̃_ij = n_i·(n_j + ρ_j t_j),   ρ = T/N           of all contacts that touch                  [1/kg]
//! ```
//!
//! W̃ need not be positive definite, and this may have no solution (Painlevé 1895), though the velocities allow the motion. Then
//! impulses stop the sliding in no time, without a collision before (Lecornu 1905; Génot and Brogliato 1999): while a contact k
//! pushes with p_k, the others with z_j p_k so that they stay or leave, where
//!
//! ```text
//! z ≥ 0,   w_j = W̃_jk + Σ W̃_ji z_i ≥ 0,   z_j w_j = 0,   d = W̃_kk + Σ W̃_ki z_i ≤ 0
//! ```
//!
//! the journal comes nearer, δ̇_k = −d p_k, until one of them slides no more. It sticks if friction can hold it, and so on until
//! d > 0; from there impulses end the approach. A contact by itself is an impact like any other, from δ̇ = 0, with its restitution
//! (see [`crate::contact::impact`]); several at once give nothing back. The same ends a motion in which N grows beyond all
//! bounds, d → 0.

use super::integration::Integration;
use super::motion::Motion;
use super::point::{Point, at_rest, inverse_mass, rubbing};
use super::words::TIGHT;
use crate::element::journal::{Rigid, Surface};
use crate::mechanism::driven::Failure;
use linkdyn_linear::complementary::complementary;
use linkdyn_linear::math::dot;
use nalgebra::{DMatrix, DVector};

/// Jams at one instant after which there is no end in sight.
const MANY: usize = 1000;
/// Pushes in a jam, and rounds to find one, per contact.
const ROUNDS: usize = 8;
/// Change of T/N, in parts of the coefficient, from which it is found.
const NEAR: f64 = 1e-3;

/// Contacts at one instant, of which none follows in the equations of the moment.
pub(super) struct Jam<'a> {
    /// Those that did follow, of all.
    pub were: &'a [bool],
    /// Those that touch, by number, and what pushes at them do.
    pub contacts: &'a [usize],
    pub points: &'a [Point],
}

impl Integration {
    /// Impulses that stop sliding in a jam, and what comes of them. `loose` is the largest d, in parts of k's inverse mass.
    ///
    /// # Errors
    /// Where no such impulse is found, or jams follow each other without end.
    pub(super) fn unjam(
        &mut self,
        motion: &mut Motion,
        jam: &Jam,
        loose: f64,
        time: f64,
    ) -> Result<(), Failure> {
        let contacts = jam.contacts;
        self.jammed = contacts
            .iter()
            .copied()
            .filter(|&contact| motion.rubs(contact))
            .collect();
        if self.last_jam.0 != time {
            self.last_jam = (time, 0);
        }
        self.last_jam.1 += 1;
        if self.last_jam.1 > MANY {
            return Err(Failure::Singular);
        }
        let mut way = Way::find(motion, jam).ok_or(Failure::Singular)?;
        let leader = contacts[way.leader];
        // One contact by itself is an impact from its beginning, and restitution gives back of all that it presses in.
        let alone = way.margin < 0.0 && way.sizes.iter().filter(|size| **size != 0.0).count() == 1;
        let mut most = loose;
        for _ in 0..if alone { 0 } else { ROUNDS * contacts.len() } {
            if way.margin > most {
                break;
            }
            let Some(pushes) = way.until_one_stops(motion, jam) else {
                break;
            };
            self.push_all(motion, contacts, jam.points, &pushes);
            motion.evaluate(time, &self.y)?;
            (way, most) = (Way::find(motion, jam).ok_or(Failure::Singular)?, 0.0);
        }
        if alone {
            self.go_on(motion, &vec![false; jam.were.len()], time)?;
            let mut reading = motion.reading(leader);
            reading.rate = 0.0;
            self.impact(motion, leader, &reading, time)?;
        } else {
            let pushes = way.come_to_rest(motion, jam).ok_or(Failure::Singular)?;
            self.push_all(motion, contacts, jam.points, &pushes);
            motion.evaluate(time, &self.y)?;
            self.settle(motion, at_rest(motion), time)?;
        }
        self.jammed.clear();
        Ok(())
    }

    /// Ends a jam at the last accepted point, where the next step would be none; whether there was one.
    pub(super) fn loosen(&mut self, motion: &mut Motion, time: f64) -> bool {
        let were = motion.followers();
        if !(0..were.len()).any(|contact| were[contact] && motion.rubs(contact)) {
            return false;
        }
        self.y.resize(self.stepper.y().len(), 0.0);
        self.y.copy_from_slice(self.stepper.y());
        let ended = motion.evaluate(time, &self.y).and_then(|()| {
            self.go_on_as(motion, &vec![false; were.len()], time)?;
            let contacts: Vec<usize> = (0..were.len()).filter(|&contact| were[contact]).collect();
            let points = Point::of(motion, &contacts);
            self.unjam(
                motion,
                &Jam {
                    were: &were,
                    contacts: &contacts,
                    points: &points,
                },
                TIGHT,
                time,
            )?;
            self.collide(motion, time)
        });
        ended.is_ok()
    }
}

/// Pushes that end a jam.
struct Way {
    /// Place of k among the contacts.
    leader: usize,
    /// z, 1 for k, and ρ.
    sizes: Vec<f64>,
    ratios: Vec<f64>,
    /// d, in parts of k's inverse mass.
    margin: f64,
}

impl Way {
    /// That with the least d. Where a journal slides no faster than its threshold it sticks, if friction is enough for that.
    fn find(motion: &Motion, jam: &Jam) -> Option<Way> {
        let mut ratios: Vec<f64> = jam
            .contacts
            .iter()
            .map(|&contact| rubbing(motion, contact))
            .collect();
        let mut way = Way::with(jam, &ratios)?;
        for _ in 0..ROUNDS * ratios.len() {
            let mut change = 0.0_f64;
            for (k, &contact) in jam.contacts.iter().enumerate() {
                let Some(Rigid { friction, .. }) = sticking(motion, contact) else {
                    continue;
                };
                let tangent =
                    dot(&jam.points[k].forces[1], &jam.points[k].changes[1]) * way.sizes[k];
                if tangent > 0.0 {
                    let ratio =
                        (ratios[k] - way.sliding_rate(jam, k) / tangent).clamp(-friction, friction);
                    change = change.max((ratio - ratios[k]).abs() / friction);
                    ratios[k] = ratio;
                }
            }
            if change < NEAR {
                break;
            }
            way = Way::with(jam, &ratios)?;
        }
        Some(way)
    }

    /// That with the least d at these ρ.
    fn with(jam: &Jam, ratios: &[f64]) -> Option<Way> {
        let (points, size) = (jam.points, jam.points.len());
        let rubbed = inverse_mass(points, ratios);
        let ways = (0..size).map(|leader| {
            let others: Vec<usize> = (0..size).filter(|&other| other != leader).collect();
            let part = DMatrix::from_fn(others.len(), others.len(), |i, j| {
                rubbed[(others[i], others[j])]
            });
            let free: Vec<f64> = others
                .iter()
                .map(|&other| -rubbed[(other, leader)])
                .collect();
            let mut sizes = vec![0.0; size];
            sizes[leader] = 1.0;
            // Where the others would jam too, they come nearer as well.
            if let Some((_, answers)) = complementary(&part, &free) {
                others
                    .iter()
                    .zip(answers)
                    .for_each(|(&other, answer)| sizes[other] = answer);
            }
            let d: f64 = (0..size).map(|j| rubbed[(leader, j)] * sizes[j]).sum();
            Way {
                leader,
                margin: d / dot(&points[leader].forces[0], &points[leader].changes[0]),
                sizes,
                ratios: ratios.to_vec(),
            }
        });
        ways.filter(|way| way.margin.is_finite())
            .min_by(|a, b| a.margin.total_cmp(&b.margin))
    }

    fn pushes(&self, size: f64) -> Vec<[f64; 2]> {
        self.sizes
            .iter()
            .zip(&self.ratios)
            .map(|(part, ratio)| [part * size, ratio * part * size])
            .collect()
    }

    /// dv_t/dp of a contact.
    fn sliding_rate(&self, jam: &Jam, k: usize) -> f64 {
        let pushed = jam.points.iter().zip(self.pushes(1.0));
        pushed
            .map(|(point, push)| dot(&jam.points[k].forces[1], &point.sum(&point.changes, push)))
            .sum()
    }

    /// The pushes after which the first of the contacts slides no more.
    fn until_one_stops(&self, motion: &Motion, jam: &Jam) -> Option<Vec<[f64; 2]>> {
        let stops = jam.contacts.iter().enumerate().filter_map(|(k, &contact)| {
            if !motion.rubs(contact) || self.sizes[k] == 0.0 || sticking(motion, contact).is_some()
            {
                return None;
            }
            let (sliding, rate) = (motion.reading(contact).sliding, self.sliding_rate(jam, k));
            (sliding * rate < 0.0).then(|| -sliding / rate)
        });
        stops.min_by(f64::total_cmp).map(|size| self.pushes(size))
    }

    /// Pushes after which no contact comes nearer, and those that stick creep so that their friction is ρ.
    fn come_to_rest(&self, motion: &Motion, jam: &Jam) -> Option<Vec<[f64; 2]>> {
        let mut press: Vec<bool> = self.sizes.iter().map(|&size| size > 0.0).collect();
        loop {
            let pushes = self.rest(motion, jam, &press)?;
            let nearer = (0..press.len()).find(|&k| {
                let pushed = jam.points.iter().zip(&pushes);
                let change: f64 = pushed
                    .map(|(point, &push)| {
                        dot(&jam.points[k].forces[0], &point.sum(&point.changes, push))
                    })
                    .sum();
                !press[k] && motion.reading(jam.contacts[k]).rate - change > at_rest(motion)
            });
            let Some(nearer) = nearer else {
                return Some(pushes);
            };
            press[nearer] = true;
        }
    }

    /// Pushes at these contacts after which they come no nearer.
    fn rest(&self, motion: &Motion, jam: &Jam, press: &[bool]) -> Option<Vec<[f64; 2]>> {
        // Contact and its push; contact, way of its velocity, and the change of that.
        let mut unknowns: Vec<(usize, [f64; 2])> = Vec::new();
        let mut wanted: Vec<(usize, usize, f64)> = Vec::new();
        for k in (0..press.len()).filter(|&k| press[k]) {
            let reading = motion.reading(jam.contacts[k]);
            let sticks = sticking(motion, jam.contacts[k]);
            unknowns.push((
                k,
                [
                    1.0,
                    if sticks.is_some() {
                        0.0
                    } else {
                        self.ratios[k]
                    },
                ],
            ));
            wanted.push((k, 0, reading.rate));
            if let Some(rigid) = sticks {
                let creeping = -self.ratios[k] / rigid.friction * rigid.threshold;
                unknowns.push((k, [0.0, 1.0]));
                wanted.push((k, 1, creeping - reading.sliding));
            }
        }
        let changes: Vec<Vec<f64>> = unknowns
            .iter()
            .map(|&(k, push)| jam.points[k].sum(&jam.points[k].changes, push))
            .collect();
        let mass = DMatrix::from_fn(wanted.len(), unknowns.len(), |i, j| {
            dot(&jam.points[wanted[i].0].forces[wanted[i].1], &changes[j])
        });
        let found = mass.lu().solve(&DVector::from_iterator(
            wanted.len(),
            wanted.iter().map(|&(_, _, change)| change),
        ))?;
        let mut pushes = vec![[0.0; 2]; press.len()];
        for (&(k, push), size) in unknowns.iter().zip(found.iter()) {
            pushes[k] = [pushes[k][0] + size * push[0], pushes[k][1] + size * push[1]];
        }
        pushes
            .iter()
            .flatten()
            .all(|push| push.is_finite())
            .then_some(pushes)
    }
}

/// The surfaces of a journal that slides no faster than its threshold, where there is friction.
fn sticking(motion: &Motion, contact: usize) -> Option<Rigid> {
    let Surface::Rigid(rigid) = motion.system().contacts[contact].surface else {
        return None;
    };
    (rigid.friction > 0.0 && motion.reading(contact).sliding.abs() <= rigid.threshold)
        .then_some(rigid)
}
