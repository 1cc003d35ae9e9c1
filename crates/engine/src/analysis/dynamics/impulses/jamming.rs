//! Dynamic jamming: rigid journals slide on their bearings so that friction presses them on, and no normal forces answer the
//! motion.
//!
//! ```text
//! δ̈ = b − W̃ N ≤ 0,   W̃_ij = n_i·(n_j + ρ_j t_j),   ρ = T/N           of all contacts that touch                  [1/kg]
//! ```
//!
//! W̃ need not be positive definite, and this may have no solution (Painlevé 1895), though the velocities allow the motion. Then
//! impulses stop the sliding in no time, an **impact without collision** (Lecornu 1905; Génot and Brogliato 1999): one of the contacts
//! that slide does not any more,
//!
//! ```text
//! v⁺ = v + W p:   δ̇⁺ = 0, v_t⁺ = 0, |p_t| ≤ μ p_n      of that one
//!                 δ̇⁺ ≤ 0 and Coulomb's law with v_t⁺     of the others                                            [`super::grips`]
//! ```
//!
//! These impulses do work ½ p·(v + v⁺) ≤ −½ p·W p, which is lost. Of all contacts that may stop so it is the one with which least is
//! lost. Where none may, it is the impulses of a time step that goes to zero, which are there wherever forces are not (see [`super::vanishing`]); and
//! where these vanish, contacts are pushed along the way z below until the first slides no more. While there is a solution the motion may still come
//! to where there is none, N growing beyond all bounds:
//!
//! ```text
//! z ≥ 0,   w_j = W̃_jk + Σ W̃_ji z_i ≥ 0,   z_j w_j = 0,   d = W̃_kk + Σ W̃_ki z_i → 0      while contact k pushes with 1
//! ```
//!
//! A contact by itself is an impact like any other, from δ̇ = 0, with its restitution (see [`crate::contact::impact`]); several at
//! once give nothing back.

use super::grips::Grips;
use super::touching::{Along, Touching};
use super::vanishing::vanishing;
use crate::analysis::dynamics::flow::Flow;
use crate::analysis::dynamics::words::TIGHT;
use crate::mechanism::driven::Failure;
use linkdyn_linear::math::dot;

/// Jams at one instant after which there is no end in sight.
const MANY: usize = 1000;

/// What is known of jams so far.
#[derive(Clone)]
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

/// Pushes in a jam.
pub(super) struct JamPushes {
    /// Place of k among the contacts.
    pub leader: usize,
    /// z, 1 for k.
    pub sizes: Vec<f64>,
    /// ρ.
    ratios: Vec<f64>,
    /// d, in parts of k's inverse mass.
    pub margin: f64,
}

impl JamPushes {
    /// The pushes with the least d.
    pub fn find(flow: &Flow, touching: &Touching) -> Option<JamPushes> {
        let ratios = touching.friction_ratios(flow);
        let mass = touching.inverse_mass(&ratios);
        let ways = touching
            .points
            .iter()
            .enumerate()
            .filter_map(|(leader, point)| {
                let sizes = touching.pushed_by(leader, &mass)?;
                let parts = sizes.iter().enumerate();
                let d: f64 = parts.map(|(j, size)| mass[(leader, j)] * size).sum();
                Some(JamPushes {
                    leader,
                    margin: d / dot(&point.forces[0], &point.changes[0]),
                    sizes,
                    ratios: ratios.clone(),
                })
            });
        ways.filter(|way| way.margin.is_finite())
            .min_by(|a, b| a.margin.total_cmp(&b.margin))
    }

    /// The pushes after which the first of the contacts slides no more.
    fn until_one_stops(&self, flow: &Flow, touching: &Touching) -> Option<Vec<[f64; 2]>> {
        let pushes = |size: f64| -> Vec<[f64; 2]> {
            let parts = self.sizes.iter().zip(&self.ratios);
            parts
                .map(|(part, ratio)| [part * size, ratio * part * size])
                .collect()
        };
        let unit = pushes(1.0);
        let rates = touching.points.iter().map(|to| {
            let changes = touching.points.iter().zip(&unit);
            changes
                .map(|(by, &push)| dot(&to.forces[1], &by.sum(&by.changes, push)))
                .sum::<f64>()
        });
        let slidings = touching.slidings(flow).into_iter().zip(&self.ratios);
        let stops = slidings.zip(rates).zip(&self.sizes);
        let stops = stops.filter(|(((sliding, ratio), rate), part)| {
            **ratio != 0.0 && **part != 0.0 && sliding * rate < 0.0
        });
        let stops = stops.map(|(((sliding, _), rate), _)| -sliding / rate);
        stops.min_by(f64::total_cmp).map(pushes)
    }

    /// Whether the leader jams by itself.
    pub fn is_alone(&self) -> bool {
        let pushing = self.sizes.iter().filter(|size| **size != 0.0);
        self.margin < 0.0 && pushing.count() == 1
    }
}

/// Impulses that end a jam: one of the contacts that slide stops, or what a time step that goes to zero leaves, or they are pushed along the way.
pub(super) fn stop(
    flow: &Flow,
    touching: &Touching,
    way: Option<&JamPushes>,
) -> Option<Vec<[f64; 2]>> {
    let way = || way.filter(|way| way.margin <= TIGHT);
    stop_one(flow, touching)
        .or_else(|| vanishing(flow, touching))
        .or_else(|| way()?.until_one_stops(flow, touching))
}

/// Impulses after which one of the contacts that slide does not, of all such the ones with which least is lost.
fn stop_one(flow: &Flow, touching: &Touching) -> Option<Vec<[f64; 2]>> {
    let (rates, slidings) = (touching.approaches(flow), touching.slidings(flow));
    let (along, slides) = (touching.at_rest(flow), touching.along(flow));
    let sliding =
        (0..touching.len()).filter(|&k| matches!(slides[k], Along::Slides(ratio) if ratio != 0.0));
    let ways = sliding.filter_map(|k| {
        let grips = Grips::new(touching, &along, [&rates, &slidings]);
        let (_, pushes) = grips.holding(k).solve()?;
        Some((touching.work(flow, &pushes), pushes))
    });
    let least = ways.max_by(|a, b| a.0.total_cmp(&b.0));
    least.map(|(_, pushes)| pushes)
}
