//! Values and rows of the result columns, from the motion at its last evaluation.

use super::contact::state;
use super::motion::Motion;
use crate::analysis::channels::Contents;
use crate::analysis::record::Recorder;
use crate::analysis::sample::{ContactSample, Sample};
use crate::system::System;

/// A sample, and the table that its rows go to.
pub struct Sampling {
    pub recorder: Recorder,
    pub sample: Sample,
}

impl Sampling {
    pub fn new(system: &System, contents: Contents, rows: usize) -> Self {
        Sampling {
            recorder: Recorder::new(system, contents, rows),
            sample: Sample::new(system),
        }
    }

    /// Motion, forces and contacts of the last evaluation; the energy of contacts is the caller's.
    pub fn take(&mut self, motion: &mut Motion) {
        for (contact, journal) in motion.system().contacts.iter().enumerate() {
            let memory = &motion.reduced.inputs.contacts[contact];
            self.sample.contacts[contact] = ContactSample {
                reading: motion.reading(contact),
                state: state(journal, memory),
            };
        }
        let reduced = &mut motion.reduced;
        let system = reduced.own().system;
        let Sample {
            q,
            v,
            a,
            lambda,
            force,
            dependent_forces,
            ..
        } = &mut self.sample;
        lambda.resize(system.m(), 0.0);
        q.copy_from_slice(&reduced.q);
        v.copy_from_slice(&reduced.v);
        a.copy_from_slice(&reduced.a);
        force.copy_from_slice(&reduced.force);
        reduced.reactions(lambda);
        // Of a journal that follows its bearing the friction is told with the contact.
        let told = dependent_forces.len();
        dependent_forces.copy_from_slice(&reduced.driven.dependent_forces.sizes()[..told]);
    }

    /// Appends the sample's row.
    pub fn push(&mut self, motion: &mut Motion) {
        let reduced = &mut motion.reduced;
        let system = reduced.own().system;
        self.recorder.push(
            system,
            &reduced.driven.evaluation,
            &reduced.inputs,
            &self.sample,
        );
    }
}
