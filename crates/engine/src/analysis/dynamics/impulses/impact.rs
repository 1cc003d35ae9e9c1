//! Impacts: the impulses of a journal that strikes its bearing.
//!
//! ```text
//! r_n, r_t          generalized forces of unit forces at the contact, along −n and t on the journal   (n)
//! SᵀMS Δu̇ = Sᵀ P,   Δv = S Δu̇,   P = p_n r_n + p_t r_t
//! W = [r_n r_t]ᵀ S (SᵀMS)⁻¹ Sᵀ [r_n r_t]                                                              [1/kg]
//! ```
//!
//! (p_n, p_t) by [`crate::contact::impact`]. Sustained contacts take part as constraints; where the impulse would pull one
//! of them, they part, and the impulses of all come of one problem (see [`super::touching`]).

use super::grips::Grips;
use super::point::ContactPoint;
use super::touching::{Along, Touching};
use crate::analysis::dynamics::flow::Flow;
use crate::analysis::dynamics::state::Sums;
use crate::contact::impact::resolve;
use crate::element::pair::{Reading, Rigid};

/// Impulse by which a sustained contact may be pulled, or stick beyond its friction, in parts of the impact's.
const PULLED: f64 = 1e-9;

/// What an impact does.
pub(super) struct Strike {
    /// \[N·s\]
    pub impulse: [f64; 2],
    /// Its energy lost, normal impulse and sliding.
    pub sums: Sums,
    /// Sustained contacts part, or slide; the impulse is no more than a direction where they leave it no way.
    pub parts: bool,
}

impl Strike {
    /// The impact of a journal with the velocities of `reading`.
    pub fn new(flow: &mut Flow, point: &ContactPoint, law: &Rigid, reading: &Reading) -> Self {
        let velocity = [-reading.rate, reading.sliding];
        let found = resolve(
            point.mass,
            velocity,
            law.restitution,
            law.friction,
            law.sense,
        );
        if found.wedged {
            // Nothing can move between the sustained contacts, or friction holds it there.
            let ratio = -law.friction
                * if reading.sliding == 0.0 {
                    0.0
                } else {
                    reading.sliding.signum()
                };
            return Strike {
                impulse: [1.0, ratio],
                sums: Sums::default(),
                parts: true,
            };
        }
        let (impulse, change) = (
            point.sum(&point.forces, found.impulse),
            point.sum(&point.changes, found.impulse),
        );
        let strain = flow.strain(&impulse, &change);
        Strike {
            impulse: found.impulse,
            sums: Sums {
                dissipated: found.loss,
                impulse: found.impulse[0],
                sliding: found.sliding,
            },
            parts: strain > PULLED * found.impulse[0],
        }
    }

    /// p_t/p_n.
    pub fn ratio(&self) -> f64 {
        self.impulse[1] / self.impulse[0]
    }
}

/// Impulses of an impact from which sustained contacts part: they and the journal that strikes get p ≥ 0 all at once, so that
/// δ̇₊ ≤ −e δ̇₋ (e = 0 for all but that journal), and δ̇₊ = −e δ̇₋ where p > 0 (Moreau 1988). `ratio` is p_t/p_n where it strikes;
/// those that stick are held by their friction as far as it goes.
pub(super) fn together(
    flow: &Flow,
    touching: &Touching,
    striking: usize,
    restitution: f64,
    ratio: f64,
) -> Option<Vec<[f64; 2]>> {
    let mut wanted = touching.approaches(flow);
    let slidings = touching.slidings(flow);
    let struck = |k: usize| touching.contacts[k] == striking;
    for (k, rate) in wanted.iter_mut().enumerate() {
        if struck(k) {
            *rate *= 1.0 + restitution;
        }
    }
    let along = touching.along(flow);
    let smooth = vec![Along::Slides(0.0); touching.len()];
    let rough = along.iter().enumerate().map(|(k, along)| match along {
        _ if struck(k) => Along::Slides(ratio),
        Along::Slides(_) => Along::Slides(0.0),
        Along::Rests(most) => Along::Rests(*most),
    });
    // With friction there may be no such impulses, or some that give energy; without there are always some that take it.
    [rough.collect(), smooth].into_iter().find_map(|along| {
        let (_, pushes) = Grips::new(touching, &along, [&wanted, &slidings]).solve()?;
        let smooth = pushes.iter().all(|push| push[1] == 0.0);
        (smooth || touching.work(flow, &pushes) <= 0.0).then_some(pushes)
    })
}
