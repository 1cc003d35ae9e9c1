//! Which of the contacts that touch press, and which of these stick: Coulomb's friction at an instant, as one complementarity
//! problem.
//!
//! ```text
//! δ̈ = b − W_nn N − W_nt T,   v̇_t = c + W_tn N + W_tt T       of all contacts that touch
//!
//! leaves     N = T = 0                  δ̈ ≤ 0
//! sticks     δ̈ = 0, v̇_t = 0             N ≥ 0, |T| ≤ μ N        where it does not slide already
//! slips      δ̈ = 0, T = ρ N             N ≥ 0; ρ = −μ s by the way s in which it slides, or will: s v̇_t ≥ 0
//! ```
//!
//! With impulses and velocities for forces and accelerations it is the problem of an impact from which contacts part. The contact
//! that contradicts first changes over to what it asks for, by Murty's least index as in
//! [`linkdyn_linear::complementary`]; where that goes round in a circle the choices are tried one by one (see [`search`]). Without
//! friction there is one solution. With it there may be several, of which the first counts, or none: a jam (see
//! [`super::jamming`]).
//!
//! F. Pfeiffer, C. Glocker, *Multibody Dynamics with Unilateral Contacts*, 1996, ch. 8.

mod search;

use super::touching::{Along, Touching};
use linkdyn_linear::math::dot;
use nalgebra::{DMatrix, DVector};

/// Parts of the largest number in a condition that are round-off.
const EVEN: f64 = 1e-12;
/// The same of friction.
const GRIP: f64 = 1e-10;
/// Friction beyond its cone, in parts of it, that may stop a contact: where normal forces grow beyond all bounds, it is just not
/// enough.
const NEAR: f64 = 1e-3;
/// Pivots below this part of the largest number are none: what is held twice.
const TWICE: f64 = 1e-11;
/// Changes, per contact, before all choices are tried, and most choices then.
const CHANGES: usize = 8;
const CHOICES: usize = 1 << 14;

/// What a contact does from the instant on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum ContactMode {
    /// It presses no more.
    Leaves,
    /// It presses and does not slide.
    Sticks,
    /// It presses and slides, or begins to; T/N.
    Slips(f64),
}

/// Contacts that touch, what they do along the surface, and b and c.
pub(super) struct Grips<'a> {
    along: &'a [Along],
    free: [&'a [f64]; 2],
    /// W by contacts: what a push of contact j, normal or tangential, changes at contact i.
    mass: DMatrix<f64>,
    /// One that has to stick.
    held: Option<usize>,
}

impl<'a> Grips<'a> {
    /// Of these contacts.
    pub fn new(touching: &Touching, along: &'a [Along], free: [&'a [f64]; 2]) -> Self {
        let size = 2 * touching.len();
        let mass = DMatrix::from_fn(size, size, |i, j| {
            let (to, by) = (&touching.points[i / 2], &touching.points[j / 2]);
            dot(&to.forces[i % 2], &by.changes[j % 2])
        });
        Grips::with_mass(mass, along, free)
    }

    /// The same with this W.
    pub fn with_mass(mass: DMatrix<f64>, along: &'a [Along], free: [&'a [f64]; 2]) -> Self {
        Grips {
            along,
            free,
            mass,
            held: None,
        }
    }

    /// The same where one of them has to stick.
    pub fn holding(self, contact: usize) -> Self {
        Grips {
            held: Some(contact),
            ..self
        }
    }

    /// What contacts do along the surface.
    pub fn along(&self) -> &[Along] {
        self.along
    }

    /// W by contacts, normal and tangential.
    pub fn mass(&self) -> &DMatrix<f64> {
        &self.mass
    }

    /// What they do, with (N, T) of each; `None` if there is no solution.
    pub fn solve(&self) -> Option<(Vec<ContactMode>, Vec<[f64; 2]>)> {
        // Nothing presses at first, and where that leads nowhere, all that can.
        (0..2)
            .find_map(|start| self.from(start))
            .or_else(|| self.search())
    }

    /// The same from one of the choices of each.
    fn from(&self, start: usize) -> Option<(Vec<ContactMode>, Vec<[f64; 2]>)> {
        let first = (0..self.along.len()).map(|k| {
            let choices = self.choices(k);
            choices[start.min(choices.len() - 1)]
        });
        let mut modes: Vec<ContactMode> = first.collect();
        for _ in 0..CHANGES * (modes.len() + 1) {
            match self.attempt(&modes) {
                Attempt::Solved(forces) => return Some((modes, forces)),
                Attempt::Wrong(k, _) if self.held == Some(k) => break,
                Attempt::Wrong(k, mode) => modes[k] = mode,
                Attempt::Singular => break,
            }
        }
        None
    }

    fn choices(&self, k: usize) -> Vec<ContactMode> {
        if self.free[0][k] == f64::NEG_INFINITY {
            return vec![ContactMode::Leaves];
        }
        match self.along[k] {
            _ if self.held == Some(k) => vec![ContactMode::Sticks],
            Along::Slides(ratio) => vec![ContactMode::Leaves, ContactMode::Slips(ratio)],
            Along::Rests(most) => vec![
                ContactMode::Leaves,
                ContactMode::Sticks,
                ContactMode::Slips(most),
                ContactMode::Slips(-most),
            ],
        }
    }

    /// Impulses after which what presses comes no nearer, what sticks does not slide, and what begins to slide does not slide the
    /// other way, be it by round-off: that would be an event at once, and another one.
    pub fn resting(&self, modes: &[ContactMode]) -> Option<Vec<[f64; 2]>> {
        let slides_back = |k: usize, ratio: f64| {
            matches!(self.along[k], Along::Rests(_)) && self.free[1][k] * ratio > 0.0
        };
        let smooth = |stops: bool| {
            let modes = modes.iter().enumerate().map(|(k, mode)| match *mode {
                ContactMode::Slips(ratio) if stops && slides_back(k, ratio) => ContactMode::Sticks,
                ContactMode::Slips(_) => ContactMode::Slips(0.0),
                ContactMode::Leaves | ContactMode::Sticks => *mode,
            });
            self.forces(&modes.collect::<Vec<ContactMode>>())
        };
        smooth(true).or_else(|| smooth(false))
    }

    /// (N, T) in these modes, and whether nothing contradicts them.
    fn attempt(&self, modes: &[ContactMode]) -> Attempt {
        let Some(forces) = self.forces(modes) else {
            return Attempt::Singular;
        };
        let pushes = DVector::from_iterator(2 * forces.len(), forces.iter().flatten().copied());
        let changed = &self.mass * &pushes;
        let sizes = self.mass.abs() * pushes.abs();
        let scale = largest(self.free[0]);
        for (k, &mode) in modes.iter().enumerate() {
            let [normal, tangential] = forces[k];
            let wrong = match (mode, self.along[k]) {
                (ContactMode::Leaves, along) => {
                    let presses = self.free[0][k] - changed[2 * k] > EVEN * scale;
                    presses.then_some(match along {
                        Along::Slides(ratio) => ContactMode::Slips(ratio),
                        Along::Rests(_) => ContactMode::Sticks,
                    })
                }
                (ContactMode::Sticks | ContactMode::Slips(_), _) if normal < 0.0 => {
                    Some(ContactMode::Leaves)
                }
                (ContactMode::Sticks, Along::Rests(most)) => {
                    let beyond = if self.held == Some(k) { NEAR } else { GRIP };
                    (tangential.abs() > (1.0 + beyond) * most * normal)
                        .then_some(ContactMode::Slips(most * tangential.signum()))
                }
                (ContactMode::Slips(ratio), Along::Rests(_)) => {
                    let rate = self.free[1][k] + changed[2 * k + 1];
                    let even = EVEN * self.free[1][k].abs().max(sizes[2 * k + 1]);
                    (rate * ratio.signum() > even).then_some(ContactMode::Sticks)
                }
                (ContactMode::Sticks | ContactMode::Slips(_), Along::Slides(_)) => None,
            };
            if let Some(mode) = wrong {
                return Attempt::Wrong(k, mode);
            }
        }
        Attempt::Solved(forces)
    }

    /// (N, T) in these modes; `None` if they hold something twice.
    pub fn forces(&self, modes: &[ContactMode]) -> Option<Vec<[f64; 2]>> {
        // Rows of W that are conditions: contact and way.
        let conditions: Vec<usize> = (0..2 * modes.len())
            .filter(|row| match modes[row / 2] {
                ContactMode::Leaves => false,
                ContactMode::Sticks => true,
                ContactMode::Slips(_) => row % 2 == 0,
            })
            .collect();
        if conditions.is_empty() {
            return Some(vec![[0.0; 2]; modes.len()]);
        }
        let ratio = |column: usize| match modes[column / 2] {
            ContactMode::Slips(ratio) => ratio,
            ContactMode::Leaves | ContactMode::Sticks => 0.0,
        };
        let mass = DMatrix::from_fn(conditions.len(), conditions.len(), |i, j| {
            let (row, column) = (conditions[i], conditions[j]);
            let own = self.mass[(row, column)];
            if column % 2 == 0 {
                own + ratio(column) * self.mass[(row, column + 1)]
            } else {
                own
            }
        });
        let wanted = conditions.iter().map(|&row| match row % 2 {
            0 => self.free[0][row / 2],
            _ => -self.free[1][row / 2],
        });
        let wanted = DVector::from_iterator(conditions.len(), wanted);
        let most = mass.amax();
        let factors = mass.lu();
        let pivots = factors.u().diagonal();
        if pivots.iter().any(|pivot| pivot.abs() <= TWICE * most) {
            return None;
        }
        let found = factors.solve(&wanted)?;
        let mut forces = vec![[0.0; 2]; modes.len()];
        for (&row, force) in conditions.iter().zip(found.iter()) {
            forces[row / 2][row % 2] = *force;
            if let ContactMode::Slips(ratio) = modes[row / 2] {
                forces[row / 2][1] = ratio * force;
            }
        }
        let finite = forces.iter().flatten().all(|force| force.is_finite());
        finite.then_some(forces)
    }
}

enum Attempt {
    Solved(Vec<[f64; 2]>),
    /// The first that contradicts, and what it asks for.
    Wrong(usize, ContactMode),
    Singular,
}

fn largest(values: &[f64]) -> f64 {
    let finite = values.iter().filter(|value| value.is_finite());
    finite.fold(0.0, |most: f64, value| most.max(value.abs()))
}

#[cfg(test)]
mod tests;
