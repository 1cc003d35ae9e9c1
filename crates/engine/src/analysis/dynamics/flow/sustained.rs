//! Sustained contacts: rigid journals that stay on their bearings, as constraints of the motion.

use super::Flow;
use crate::analysis::assembly::ranks;
use crate::element::journal::Surface;
use crate::mechanism::driven::Failure;
use crate::mechanism::phases::{Exchanged, Windows};
use crate::system::{Inputs, System};

/// A contact that is a constraint.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sustained {
    /// First row: the distance of the surfaces.
    pub row: usize,
    /// Its multiplier at the point of the last evaluation \[N\].
    pub normal_force: f64,
    /// Its friction, as a force that depends on multipliers.
    pub friction: Option<usize>,
}

impl Flow<'_> {
    /// Whether each contact is sustained.
    pub fn sustained(&self) -> Vec<bool> {
        self.sustained.iter().map(Option::is_some).collect()
    }

    /// Whether any contact is sustained.
    pub fn has_sustained(&self) -> bool {
        self.sustained.iter().any(Option::is_some)
    }

    /// Whether a contact is one of rigid surfaces with friction.
    pub fn has_rigid_friction(&self, contact: usize) -> bool {
        matches!(&self.system().contacts[contact].surface, Surface::Rigid(rigid) if rigid.friction > 0.0)
    }

    /// Goes on with these sustained contacts, from the position and velocities at hand.
    ///
    /// # Errors
    /// Where the constraints of these contacts are singular.
    pub fn sustain(&mut self, sustained: &[bool], time: f64) -> Result<(), Failure> {
        let system: &System = self.phases.get(sustained, &Windows::new(), Exchanged::new);
        let inputs = Inputs::at_time(system, time);
        let (_, all) = ranks(system, self.equations.position(), &inputs);
        self.equations = self
            .equations
            .with_rows(system, &all.free_columns, time, sustained)?;
        self.layout.set_freedom(self.equations.freedom());
        self.lambda.resize(system.m(), 0.0);
        let rows = system.joints.iter().zip(&system.blocks);
        let rows = rows.filter(|(joint, _)| joint.contact.is_some());
        // Those of contacts stand behind the joints' own.
        let mut next = self.layout.forces();
        for (contact, (_, block)) in rows.enumerate() {
            let has_friction = sustained[contact] && self.has_rigid_friction(contact);
            // Where the contact goes on, the force of the last evaluation stands until the next.
            let before = self.sustained[contact].map_or(0.0, |before| before.normal_force);
            self.sustained[contact] = sustained[contact].then_some(Sustained {
                row: block.row,
                normal_force: before,
                friction: has_friction.then_some(next),
            });
            next += usize::from(has_friction);
        }
        Ok(())
    }

    /// Normal forces of the sustained contacts at the point of the last evaluation.
    pub(super) fn eval_normal_forces(&mut self) {
        if self.has_sustained() {
            self.equations.multipliers(&mut self.lambda);
            for sustained in self.sustained.iter_mut().flatten() {
                sustained.normal_force = self.lambda[sustained.row];
            }
        }
    }

    /// The sustained contact that an impulse and its change of the velocities pull most, and its own impulse.
    pub fn pulled(&mut self, impulse: &[f64], change: &[f64]) -> Option<(usize, f64)> {
        self.has_sustained().then(|| {
            self.equations
                .impulsive_multipliers(impulse, change, &mut self.lambda);
        })?;
        let contacts = self.sustained.iter().enumerate();
        let pulls = contacts
            .filter_map(|(contact, sustained)| Some((contact, self.lambda[(*sustained)?.row])));
        pulls.min_by(|a, b| a.1.total_cmp(&b.1))
    }
}
