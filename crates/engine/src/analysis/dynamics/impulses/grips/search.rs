//! All choices of what contacts do, one by one, as a tree: what contacts that press share is eliminated once for all choices of the
//! others.
//!
//! ```text
//! u = b − A z       u (−δ̇ or v̇_t with its sign), z = (N, T) of all contacts, one after the other
//! ```
//!
//! A contact that presses exchanges its rows of u with its part of z (Gauss and Jordan); at the ends of the tree the signs of u and z are read off.
//! What may be a solution by these numbers is solved by itself, and counts by that alone.

use super::{Along, Attempt, CHOICES, ContactMode, Grips, NEAR, largest};
use nalgebra::DMatrix;

/// Pivots below this part of a contact's own inverse mass are not eliminated: all choices below are solved one by one.
const SMALL: f64 = 1e-6;
/// Part of the largest numbers by which a condition may be missed by the tree's round-off: far above it with such pivots.
const ROUGH: f64 = 1e-6;

/// Modes, and (N, T) of each.
pub(super) type ModesAndForces = (Vec<ContactMode>, Vec<[f64; 2]>);

/// What is left after elimination of contacts that press.
#[derive(Clone)]
struct Eliminated {
    /// A
    mass: DMatrix<f64>,
    /// u where the rest of z is zero, or z of what is eliminated.
    rest: Vec<f64>,
}

impl Eliminated {
    /// With contact k in this mode; `None` if that is not to be eliminated.
    fn with(&self, k: usize, mode: ContactMode, own: &DMatrix<f64>) -> Option<Eliminated> {
        let mut next = self.clone();
        let (normal, tangential) = (2 * k, 2 * k + 1);
        match mode {
            ContactMode::Leaves => {}
            ContactMode::Sticks => {
                next.exchange(normal, own)?;
                next.exchange(tangential, own)?;
            }
            ContactMode::Slips(ratio) => {
                for row in 0..next.rest.len() {
                    next.mass[(row, normal)] += ratio * next.mass[(row, tangential)];
                    next.mass[(row, tangential)] = 0.0;
                }
                next.exchange(normal, own)?;
            }
        }
        Some(next)
    }

    /// u of this row is zero, and z unknown.
    fn exchange(&mut self, place: usize, own: &DMatrix<f64>) -> Option<()> {
        let pivot = self.mass[(place, place)];
        if pivot.abs() <= SMALL * own[(place, place)] {
            return None;
        }
        let size = self.rest.len();
        self.rest[place] /= pivot;
        for column in 0..size {
            self.mass[(place, column)] /= pivot;
        }
        let known = self.rest[place];
        for row in (0..size).filter(|&row| row != place) {
            self.rest[row] -= self.mass[(row, place)] * known;
        }
        for column in (0..size).filter(|&column| column != place) {
            let by = self.mass[(place, column)];
            if by != 0.0 {
                for row in (0..size).filter(|&row| row != place) {
                    let part = self.mass[(row, place)] * by;
                    self.mass[(row, column)] -= part;
                }
            }
        }
        Some(())
    }

    /// Whether these modes may be a solution; `free` and `mass` are the largest numbers of theirs.
    fn may_hold(&self, modes: &[ContactMode], along: &[Along], [free, mass]: [f64; 2]) -> bool {
        let pushes = modes.iter().enumerate().map(|(k, mode)| match mode {
            ContactMode::Leaves => 0.0,
            ContactMode::Sticks => self.rest[2 * k].abs().max(self.rest[2 * k + 1].abs()),
            ContactMode::Slips(ratio) => self.rest[2 * k].abs() * ratio.abs().max(1.0),
        });
        let push = pushes.fold(0.0, f64::max);
        let near = ROUGH * push;
        let close = ROUGH * (free + mass * modes.len() as f64 * push);
        modes.iter().enumerate().all(|(k, &mode)| {
            let (normal, tangential) = (self.rest[2 * k], self.rest[2 * k + 1]);
            match (mode, along[k]) {
                (ContactMode::Leaves, _) => normal <= close,
                (ContactMode::Sticks, Along::Rests(most)) => {
                    normal >= -near
                        && tangential.abs() <= (1.0 + NEAR) * most * normal + (1.0 + most) * near
                }
                // u is −v̇_t there.
                (ContactMode::Slips(ratio), Along::Rests(_)) => {
                    normal >= -near && tangential * ratio.signum() >= -close
                }
                (ContactMode::Sticks | ContactMode::Slips(_), Along::Slides(_)) => normal >= -near,
            }
        })
    }
}

/// On the way through the tree.
struct TreeWalk<'g, 'a> {
    grips: &'g Grips<'a>,
    choices: Vec<Vec<ContactMode>>,
    modes: Vec<ContactMode>,
    /// Largest accelerations or velocities without forces, and inverse masses.
    largest: [f64; 2],
    /// Choices that may still be tried.
    left: usize,
}

impl TreeWalk<'_, '_> {
    /// The first solution, where contacts from `decided` on do what `modes` say.
    fn below(&mut self, decided: usize, tableau: Option<&Eliminated>) -> Option<ModesAndForces> {
        if self.left == 0 {
            return None;
        }
        let Some(k) = decided.checked_sub(1) else {
            self.left -= 1;
            let (modes, along) = (&self.modes, self.grips.along);
            if tableau.is_some_and(|tableau| !tableau.may_hold(modes, along, self.largest)) {
                return None;
            }
            return match self.grips.attempt(&self.modes) {
                Attempt::Solved(forces) => Some((self.modes.clone(), forces)),
                Attempt::Wrong(..) | Attempt::Singular => None,
            };
        };
        (0..self.choices[k].len()).find_map(|index| {
            let mode = self.choices[k][index];
            self.modes[k] = mode;
            match mode {
                ContactMode::Leaves => self.below(k, tableau),
                ContactMode::Sticks | ContactMode::Slips(_) => {
                    let own = &self.grips.mass;
                    let next = tableau.and_then(|tableau| tableau.with(k, mode, own));
                    self.below(k, next.as_ref())
                }
            }
        })
    }
}

impl Grips<'_> {
    /// The first of all choices that is a solution, in the order in which the first contact changes first.
    pub(super) fn search(&self) -> Option<ModesAndForces> {
        let count = self.along.len();
        let free = self.free.map(largest);
        let mut walk = TreeWalk {
            largest: [free[0].max(free[1]), self.mass.amax()],
            grips: self,
            choices: (0..count).map(|k| self.choices(k)).collect(),
            modes: vec![ContactMode::Leaves; count],
            left: CHOICES,
        };
        let wanted = (0..2 * count).map(|row| match row % 2 {
            0 => self.free[0][row / 2],
            _ => -self.free[1][row / 2],
        });
        let whole = Eliminated {
            mass: self.mass.clone(),
            rest: wanted.collect(),
        };
        walk.below(count, Some(&whole))
    }
}
