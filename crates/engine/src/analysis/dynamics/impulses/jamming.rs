//! Dynamic jamming: rigid journals slide on their bearings so that friction presses them on, and no normal forces answer the
//! motion.
//!
//! ```text
//! δ̈ = b − W̃ N ≤ 0,   W̃_ij = n_i·(n_j + ρ_j t_j),   ρ = T/N           of all contacts that touch                  [1/kg]
//! ```
//!
//! W̃ need not be positive definite, and this may have no solution (Painlevé 1895), though the velocities allow the motion. Then
//! impulses stop the sliding in no time, an **impact without collision** (Lecornu 1905; Génot and Brogliato 1999): while a contact k
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

use super::point::{at_rest, sticking};
use super::touching::Touching;
use crate::analysis::dynamics::flow::Flow;
use crate::mechanism::driven::Failure;
use linkdyn_linear::math::dot;
use nalgebra::{DMatrix, DVector};

/// Jams at one instant after which there is no end in sight.
const MANY: usize = 1000;
/// Pushes in a jam, and rounds to find one, per contact.
const ROUNDS: usize = 8;
/// Change of T/N, in parts of the coefficient, from which it is found.
const NEAR: f64 = 1e-3;

/// What is known of jams so far.
pub struct Jams {
    /// Rigid contacts, by number, that no forces answer.
    pub contacts: Vec<usize>,
    /// When there was one last, and how many then.
    last: (f64, usize),
}

impl Jams {
    /// None so far.
    pub fn new() -> Self {
        Jams {
            contacts: Vec::new(),
            last: (f64::NEG_INFINITY, 0),
        }
    }

    /// A jam begins.
    ///
    /// # Errors
    /// Where jams follow each other without end.
    pub(super) fn begin(
        &mut self,
        flow: &Flow,
        touching: &Touching,
        time: f64,
    ) -> Result<(), Failure> {
        let contacts = touching.contacts.iter().copied();
        self.contacts = contacts
            .filter(|&contact| flow.has_rigid_friction(contact))
            .collect();
        if self.last.0 != time {
            self.last = (time, 0);
        }
        self.last.1 += 1;
        if self.last.1 > MANY {
            return Err(Failure::Singular);
        }
        Ok(())
    }
}

/// Pushes after which the search for an end is given up.
pub(super) fn rounds(touching: &Touching) -> usize {
    ROUNDS * touching.len()
}

/// Pushes that end a jam.
pub(super) struct Way {
    /// Place of k among the contacts.
    pub leader: usize,
    /// z, 1 for k, and ρ.
    pub sizes: Vec<f64>,
    ratios: Vec<f64>,
    /// d, in parts of k's inverse mass.
    pub margin: f64,
}

impl Way {
    /// The pushes with the least d. Where a journal slides no faster than its threshold it sticks, if friction is enough for
    /// that.
    pub fn find(flow: &Flow, touching: &Touching) -> Option<Way> {
        let mut ratios = touching.friction_ratios(flow);
        let mut way = Way::with(touching, &ratios)?;
        for _ in 0..rounds(touching) {
            let mut change = 0.0_f64;
            for (k, &contact) in touching.contacts.iter().enumerate() {
                let Some(rigid) = sticking(flow, contact) else {
                    continue;
                };
                let (friction, point) = (rigid.friction, &touching.points[k]);
                let tangent = dot(&point.forces[1], &point.changes[1]) * way.sizes[k];
                if tangent > 0.0 {
                    let ratio = (ratios[k] - way.sliding_rate(touching, k) / tangent)
                        .clamp(-friction, friction);
                    change = change.max((ratio - ratios[k]).abs() / friction);
                    ratios[k] = ratio;
                }
            }
            if change < NEAR {
                break;
            }
            way = Way::with(touching, &ratios)?;
        }
        Some(way)
    }

    /// The pushes with the least d at these ρ.
    fn with(touching: &Touching, ratios: &[f64]) -> Option<Way> {
        let mass = touching.inverse_mass(ratios);
        let ways = touching.points.iter().enumerate().map(|(leader, point)| {
            let sizes = touching.pushed_by(leader, &mass);
            let parts = sizes.iter().enumerate();
            let d: f64 = parts.map(|(j, size)| mass[(leader, j)] * size).sum();
            Way {
                leader,
                margin: d / dot(&point.forces[0], &point.changes[0]),
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
    fn sliding_rate(&self, touching: &Touching, k: usize) -> f64 {
        let pushed = touching.points.iter().zip(self.pushes(1.0));
        pushed
            .map(|(point, push)| {
                dot(
                    &touching.points[k].forces[1],
                    &point.sum(&point.changes, push),
                )
            })
            .sum()
    }

    /// The pushes after which the first of the contacts slides no more.
    pub fn until_one_stops(&self, flow: &Flow, touching: &Touching) -> Option<Vec<[f64; 2]>> {
        let stops = touching
            .contacts
            .iter()
            .enumerate()
            .filter_map(|(k, &contact)| {
                if !flow.has_rigid_friction(contact)
                    || self.sizes[k] == 0.0
                    || sticking(flow, contact).is_some()
                {
                    return None;
                }
                let (sliding, rate) = (
                    flow.reading(contact).sliding,
                    self.sliding_rate(touching, k),
                );
                (sliding * rate < 0.0).then(|| -sliding / rate)
            });
        stops.min_by(f64::total_cmp).map(|size| self.pushes(size))
    }

    /// Pushes after which no contact comes nearer, and those that stick creep so that their friction is ρ.
    pub fn come_to_rest(&self, flow: &Flow, touching: &Touching) -> Option<Vec<[f64; 2]>> {
        let mut press: Vec<bool> = self.sizes.iter().map(|&size| size > 0.0).collect();
        loop {
            let pushes = self.rest(flow, touching, &press)?;
            let nearer = (0..press.len()).find(|&k| {
                let pushed = touching.points.iter().zip(&pushes);
                let change: f64 = pushed
                    .map(|(point, &push)| {
                        dot(
                            &touching.points[k].forces[0],
                            &point.sum(&point.changes, push),
                        )
                    })
                    .sum();
                !press[k] && flow.reading(touching.contacts[k]).rate - change > at_rest(flow)
            });
            let Some(nearer) = nearer else {
                return Some(pushes);
            };
            press[nearer] = true;
        }
    }

    /// Pushes at these contacts after which they come no nearer.
    fn rest(&self, flow: &Flow, touching: &Touching, press: &[bool]) -> Option<Vec<[f64; 2]>> {
        // Contact and its push; contact, way of its velocity, and the change of that.
        let mut unknowns: Vec<(usize, [f64; 2])> = Vec::new();
        let mut wanted: Vec<(usize, usize, f64)> = Vec::new();
        for k in (0..press.len()).filter(|&k| press[k]) {
            let reading = flow.reading(touching.contacts[k]);
            let sticks = sticking(flow, touching.contacts[k]);
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
            .map(|&(k, push)| touching.points[k].sum(&touching.points[k].changes, push))
            .collect();
        let mass = DMatrix::from_fn(wanted.len(), unknowns.len(), |i, j| {
            dot(
                &touching.points[wanted[i].0].forces[wanted[i].1],
                &changes[j],
            )
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
