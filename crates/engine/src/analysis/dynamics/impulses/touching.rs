//! The one complementarity problem of an instant: all contacts that touch, and what may not go on between them.
//!
//! ```text
//! p ≥ 0,   w = b − W̃ p ≤ 0,   p_k w_k = 0                                          of all contacts that touch
//! W̃_ij = n_i·(n_j + ρ_j t_j)    what a push on j does to i; ρ = T/N               (k, k)                [1/kg]
//!
//! impact             p impulses, b = (1 + e) δ̇       what approaches rebounds, the others part or stay   [m/s]
//! rest               p impulses, b = δ̇               the same with e = 0
//! sustained contact  with friction of what sticks, see [`super::grips`]                               [m/s²]
//! jam                p by unit push on k, b = −W̃_k    what the others do while contact k pushes           [1/kg]
//!                    impulses that stop sliding, see [`super::jamming`]                                   [m/s]
//! ```
//!
//! It is solved on the levels of velocities and accelerations one after the other, since the second's b depends on the
//! velocities that the first leaves. Only an impact at one point, with nothing else to part, is not one of them: sliding may
//! change within it, which no linear problem sees (see [`crate::contact::impact`]).
//!
//! J. J. Moreau, *Unilateral contact and dry friction in finite freedom dynamics*, 1988; F. Pfeiffer, C. Glocker, *Multibody
//! Dynamics with Unilateral Contacts*, 1996.

use super::point::{
    ContactPoint, approach_acceleration, approach_size, sliding_acceleration, still,
};
use crate::analysis::dynamics::flow::Flow;
use linkdyn_linear::complementary::complementary;
use linkdyn_linear::math::dot;
use nalgebra::DMatrix;

/// Part of the terms of an acceleration that is round-off.
const EVEN: f64 = 1e-12;

/// Contacts that touch, of which none is sustained in the equations of the moment.
pub(super) struct Touching {
    /// By number.
    pub contacts: Vec<usize>,
    /// What pushes at them do.
    pub points: Vec<ContactPoint>,
}

/// What a contact does along the surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Along {
    /// It slides: T/N is this.
    Slides(f64),
    /// It does not, and friction up to this T/N can hold it.
    Rests(f64),
}

/// Which contacts push, and how much.
pub(super) type ContactPushes = (Vec<bool>, Vec<f64>);

impl Touching {
    /// These contacts as they are at the last evaluation.
    pub fn new(flow: &mut Flow, contacts: Vec<usize>) -> Self {
        let points = contacts.iter();
        let points = points.map(|&contact| {
            let reading = flow.reading(contact);
            ContactPoint::new(flow, contact, &reading)
        });
        Touching {
            points: points.collect(),
            contacts,
        }
    }

    /// Number of contacts.
    pub fn len(&self) -> usize {
        self.contacts.len()
    }

    /// W̃ with these ρ.
    pub fn inverse_mass(&self, ratios: &[f64]) -> DMatrix<f64> {
        DMatrix::from_fn(self.len(), self.len(), |i, j| {
            let [normal, tangential] = self.points[j]
                .changes
                .each_ref()
                .map(|change| dot(&self.points[i].forces[0], change));
            normal + ratios[j] * tangential
        })
    }

    /// p with these ρ and b; `None` if there is no solution.
    pub fn solve(&self, ratios: &[f64], free: &[f64]) -> Option<ContactPushes> {
        complementary(&self.inverse_mass(ratios), free)
    }

    /// p of the others while contact `leader` pushes with 1; `None` if there is no solution.
    pub fn pushed_by(&self, leader: usize, inverse_mass: &DMatrix<f64>) -> Option<Vec<f64>> {
        let others: Vec<usize> = (0..self.len()).filter(|&other| other != leader).collect();
        let part = DMatrix::from_fn(others.len(), others.len(), |i, j| {
            inverse_mass[(others[i], others[j])]
        });
        let free: Vec<f64> = others
            .iter()
            .map(|&other| -inverse_mass[(other, leader)])
            .collect();
        let mut sizes = vec![0.0; self.len()];
        sizes[leader] = 1.0;
        let (_, answers) = complementary(&part, &free)?;
        let answers = others.iter().zip(answers);
        answers.for_each(|(&other, answer)| sizes[other] = answer);
        Some(sizes)
    }

    /// δ̇ of each, at the last evaluation [m/s].
    pub fn approaches(&self, flow: &Flow) -> Vec<f64> {
        let contacts = self.contacts.iter();
        contacts
            .map(|&contact| flow.reading(contact).rate)
            .collect()
    }

    /// ρ of each, where it slides as at the last evaluation; 0 of one at rest.
    pub fn friction_ratios(&self, flow: &Flow) -> Vec<f64> {
        let along = self.along(flow);
        let ratios = along.iter().map(|along| match along {
            Along::Slides(ratio) => *ratio,
            Along::Rests(_) => 0.0,
        });
        ratios.collect()
    }

    /// What each does along the surface at the last evaluation.
    pub fn along(&self, flow: &Flow) -> Vec<Along> {
        let contacts = self.contacts.iter().map(|&contact| {
            let friction = flow.rigid_friction(contact);
            let sliding = flow.reading(contact).sliding;
            match friction {
                0.0 => Along::Slides(0.0),
                _ if sliding.abs() <= still(flow) => Along::Rests(friction),
                _ => Along::Slides(-friction * sliding.signum()),
            }
        });
        contacts.collect()
    }

    /// What each does along the surface with impulses that end its sliding at once.
    pub fn at_rest(&self, flow: &Flow) -> Vec<Along> {
        let contacts = self.contacts.iter();
        let along = contacts.map(|&contact| match flow.rigid_friction(contact) {
            0.0 => Along::Slides(0.0),
            friction => Along::Rests(friction),
        });
        along.collect()
    }

    /// v_t of each, at the last evaluation [m/s].
    pub fn slidings(&self, flow: &Flow) -> Vec<f64> {
        let contacts = self.contacts.iter();
        contacts
            .map(|&contact| flow.reading(contact).sliding)
            .collect()
    }

    /// v̇_t of each at the last evaluation [m/s²].
    pub fn sliding_accelerations(&self, flow: &Flow) -> Vec<f64> {
        let contacts = self.contacts.iter().zip(&self.points);
        contacts
            .map(|(&contact, point)| sliding_acceleration(flow, contact, point))
            .collect()
    }

    /// δ̈ of each at the last evaluation, less what may be round-off [m/s²].
    pub fn approach_accelerations(&self, flow: &Flow) -> Vec<f64> {
        let contacts = self.contacts.iter().zip(&self.points).enumerate();
        contacts
            .map(|(k, (&contact, point))| {
                approach_acceleration(flow, contact, point) - self.round_off(flow, k)
            })
            .collect()
    }

    /// Contacts that leave with δ̇ = `rates`, and come back after a flight lower than `lowest` of their size, want to stay, too: with
    /// N of those that stay in `free`, the fall of contact k is a = δ̈ − W̃ₖ N, and its flight is δ̇²/(2 a) high.
    pub fn keep_low(
        &self,
        flow: &Flow,
        (rates, accelerations): (&[f64], &[f64]),
        lowest: f64,
        free: &mut [f64],
    ) {
        let leaving = (0..self.len()).filter(|&k| free[k] == f64::NEG_INFINITY && rates[k] < 0.0);
        let leaving: Vec<usize> = leaving.collect();
        if leaving.is_empty() {
            return;
        }
        let inverse_mass = self.inverse_mass(&self.friction_ratios(flow));
        for k in leaving {
            let Some((_, pushes)) = complementary(&inverse_mass, free) else {
                return;
            };
            let held: f64 = (0..self.len())
                .map(|j| inverse_mass[(k, j)] * pushes[j])
                .sum();
            let fall = accelerations[k] - held;
            let height = lowest * flow.system().contacts[self.contacts[k]].size();
            if rates[k] * rates[k] < 2.0 * fall * height {
                free[k] = accelerations[k];
            }
        }
    }

    /// What of δ̈ of a piece of an outline may be round-off [m/s²]: two of them may hold a tip from both sides, and must not both want
    /// to press.
    fn round_off(&self, flow: &Flow, k: usize) -> f64 {
        match flow.system().contacts[self.contacts[k]].edge() {
            Some(_) => EVEN * approach_size(flow, &self.points[k]),
            None => 0.0,
        }
    }

    /// Velocities halfway between those before and after these impulses: work is impulse times that.
    pub fn halfway(&self, flow: &Flow, pushes: &[[f64; 2]]) -> Vec<f64> {
        let mut halfway = flow.equations.velocity().to_vec();
        for (point, &push) in self.points.iter().zip(pushes) {
            let change = point.sum(&point.changes, push);
            halfway
                .iter_mut()
                .zip(&change)
                .for_each(|(v, change)| *v += 0.5 * change);
        }
        halfway
    }

    /// Work that these impulses do \[J\].
    pub fn work(&self, flow: &Flow, pushes: &[[f64; 2]]) -> f64 {
        let halfway = self.halfway(flow, pushes);
        let points = self.points.iter().zip(pushes);
        points
            .map(|(point, &push)| dot(&point.sum(&point.forces, push), &halfway))
            .sum()
    }
}
