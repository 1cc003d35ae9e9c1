//! Sustained contacts: rigid journals that stay on their bearings, as constraints of the motion.

use super::Flow;
use super::grip::{Grip, Sustained};
use crate::analysis::assembly::ranks;
use crate::element::pair::{Hold, Surface};
use crate::mechanism::driven::Failure;
use crate::mechanism::phases::{Exchanged, Windows};
use crate::system::{Block, Inputs, System};

impl Flow<'_> {
    /// How each contact is held.
    pub fn holds(&self) -> Vec<Hold> {
        let contacts = self.sustained.iter();
        let holds = contacts.map(|sustained| match sustained {
            None => Hold::Free,
            Some(Sustained {
                grip: Grip::Sticks(_),
                ..
            }) => Hold::Sticks,
            Some(_) => Hold::Slides,
        });
        holds.collect()
    }

    /// Whether any contact is sustained.
    pub fn has_sustained(&self) -> bool {
        self.sustained.iter().any(Option::is_some)
    }

    /// μ of a contact of rigid surfaces, 0 of any other.
    pub fn rigid_friction(&self, contact: usize) -> f64 {
        match &self.system().contacts[contact].surface {
            Surface::Rigid(rigid) => rigid.friction,
            Surface::Compliant(_) => 0.0,
        }
    }

    /// Whether a contact is one of rigid surfaces with friction.
    pub fn has_rigid_friction(&self, contact: usize) -> bool {
        self.rigid_friction(contact) > 0.0
    }

    /// Whether a contact has latched, and nothing pulls it open.
    pub fn is_latched(&self, contact: usize) -> bool {
        let system = self.system();
        let pair = &system.contacts[contact];
        let is_closed = self.sustained[contact].is_some() && self.is_in_contact(contact);
        pair.latch().is_some() && is_closed && {
            self.guard(contact, &self.reading(contact)) <= 0.0
        }
    }

    /// Goes on with contacts that are held so, from the position and velocities at hand.
    ///
    /// # Errors
    /// Where the constraints of these contacts are singular.
    pub fn hold(&mut self, holds: &[Hold], time: f64) -> Result<(), Failure> {
        let system: &System = self.phases.get(holds, &Windows::new(), Exchanged::new);
        let inputs = Inputs::at_time(system, time);
        let (_, all) = ranks(system, self.equations.position(), &inputs);
        self.equations = self
            .equations
            .with_rows(system, &all.free_columns, time, holds)?;
        // Directions of a journal's contact turn over lengths as short as its clearance.
        let held = system.contacts.iter().zip(holds);
        let held = held.filter(|(_, hold)| **hold != Hold::Free);
        let turn = held.fold(1.0, |least: f64, (pair, _)| {
            let over = pair.turns_over();
            over.map_or(least, |over| least.min(over / system.size))
        });
        self.equations.set_lag(turn * self.lag);
        self.layout.set_freedom(self.equations.freedom());
        self.lambda.resize(system.m(), 0.0);
        // Those of contacts stand behind the joints' own.
        let mut next = self.layout.forces();
        for (contact, hold) in holds.iter().enumerate() {
            let grip = match hold {
                Hold::Free => {
                    self.sustained[contact] = None;
                    continue;
                }
                Hold::Slides if self.has_rigid_friction(contact) => {
                    next += 1;
                    Grip::Slides(next - 1)
                }
                Hold::Slides => Grip::None,
                Hold::Sticks => Grip::Sticks(0.0),
            };
            // Where the contact goes on, the force of the last evaluation stands until the next.
            let before = self.sustained[contact].map_or(0.0, |before| before.normal_force);
            self.sustained[contact] = Some(Sustained {
                row: system.held_block(contact).map_or(0, Block::row),
                normal_force: before,
                grip,
            });
        }
        Ok(())
    }

    /// Normal forces of the sustained contacts at the point of the last evaluation.
    pub(super) fn eval_normal_forces(&mut self) {
        if self.has_sustained() {
            self.equations.multipliers(&mut self.lambda);
            let system = self.equations.system();
            let at = self.equations.kinematics();
            for (pair, sustained) in system.contacts.iter().zip(&mut self.sustained) {
                let Some(sustained) = sustained else { continue };
                sustained.normal_force = match pair.clasp() {
                    Some(clasp) => clasp.transmitted(&at, &self.lambda[sustained.row..]),
                    None => self.lambda[sustained.row],
                };
                if let Grip::Sticks(force) = &mut sustained.grip {
                    *force = self.lambda[sustained.row + 1];
                }
            }
        }
    }

    /// How far an impulse and its change of the velocities pull the sustained contacts beyond what they can take, at worst \[N·s\]: by
    /// a pull, or along the surface by more than friction holds of one that sticks.
    pub fn strain(&mut self, impulse: &[f64], change: &[f64]) -> f64 {
        if !self.has_sustained() {
            return 0.0;
        }
        self.equations
            .impulsive_multipliers(impulse, change, &mut self.lambda);
        let system = self.system();
        let strains = self.sustained.iter().enumerate().map(|(contact, held)| {
            let Some(held) = held else {
                return 0.0;
            };
            if system.contacts[contact].latch().is_some() {
                return 0.0;
            }
            let normal = self.lambda[held.row];
            match held.grip {
                Grip::None | Grip::Slides(_) => -normal,
                Grip::Sticks(_) => {
                    let most = self.rigid_friction(contact) * normal;
                    (-normal).max(self.lambda[held.row + 1].abs() - most)
                }
            }
        });
        strains.fold(0.0, f64::max)
    }
}
