//! Rigid journals that follow their bearings, as constraints of the motion.

use super::motion::Motion;
use crate::analysis::assembly::ranks;
use crate::element::journal::Surface;
use crate::mechanism::driven::Failure;
use crate::mechanism::phases::{Exchanged, Windows};
use crate::mechanism::reduced::Reduced;
use crate::system::Inputs;

impl Motion<'_> {
    /// Rigid contacts whose journals follow their bearings, by contact.
    pub fn followers(&self) -> Vec<bool> {
        self.following.iter().map(Option::is_some).collect()
    }

    /// Whether a contact is one of rigid surfaces with friction.
    pub fn rubs(&self, contact: usize) -> bool {
        matches!(&self.system().contacts[contact].surface, Surface::Rigid(rigid) if rigid.friction > 0.0)
    }

    /// First row of a contact that follows its bearing.
    pub fn following_row(&self, contact: usize) -> Option<usize> {
        self.following[contact]
    }

    /// Goes on with other rigid journals on their bearings' surfaces, from the position and velocities at hand.
    ///
    /// # Errors
    /// Where the constraints of these contacts are singular.
    pub fn follow(&mut self, following: &[bool], time: f64) -> Result<(), Failure> {
        let system = self.phases.get(following, &Windows::new(), Exchanged::new);
        let inputs = Inputs::at_time(system, time);
        let (q, v) = (&self.reduced.q, &self.reduced.v);
        let (_, all) = ranks(system, q, &inputs);
        let mut reduced = Reduced::new(system, &all.free_columns, q, v, time)?;
        reduced
            .inputs
            .contacts
            .clone_from(&self.reduced.inputs.contacts);
        for (memory, was) in reduced
            .inputs
            .memories
            .iter_mut()
            .zip(&self.reduced.inputs.memories)
        {
            *memory = *was;
        }
        reduced.lag = self.reduced.lag;
        reduced.driven.done = self.reduced.driven.done;
        reduced.cross_as(&mut self.reduced, following);
        self.reduced = reduced;
        self.lambda.resize(system.m(), 0.0);
        let rows = system
            .joints
            .iter()
            .zip(&system.blocks)
            .filter(|(joint, _)| joint.contact.is_some());
        // Those of contacts stand behind the joints' own.
        let mut next = self.memories.len();
        for (contact, (_, block)) in rows.enumerate() {
            self.following[contact] = following[contact].then_some(block.row);
            let rubs = self.rubs(contact);
            self.rubbing[contact] = (following[contact] && rubs).then_some(next);
            next += usize::from(following[contact] && rubs);
        }
        Ok(())
    }

    /// The follower that an impulse and its change of the velocities pull most towards its bearing, and its own impulse.
    pub fn pulled(&mut self, impulse: &[f64], change: &[f64]) -> Option<(usize, f64)> {
        self.following.iter().any(Option::is_some).then(|| {
            self.reduced
                .impulsive_multipliers(impulse, change, &mut self.lambda);
        })?;
        let rows = self
            .following
            .iter()
            .enumerate()
            .filter_map(|(contact, row)| Some((contact, (*row)?)));
        rows.map(|(contact, row)| (contact, self.lambda[row]))
            .min_by(|a, b| a.1.total_cmp(&b.1))
    }
}
