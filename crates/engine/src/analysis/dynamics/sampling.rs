//! Values and rows of the result columns, from the motion at its last evaluation.

use super::flow::Flow;
use super::modes::state;
use crate::analysis::channels::Contents;
use crate::analysis::record::Recorder;
use crate::analysis::sample::{ContactSample, Sample};
use crate::system::System;

/// A sample, and the table that its rows go to.
#[derive(Clone)]
pub struct Sampling {
    pub recorder: Recorder,
    pub sample: Sample,
}

impl Sampling {
    pub fn new(system: &System, contents: Contents, rows: usize) -> Self {
        Sampling::with(system, Recorder::new(system, contents, rows))
    }

    /// Whose rows go to a table.
    pub fn with(system: &System, recorder: Recorder) -> Self {
        Sampling {
            recorder,
            sample: Sample::new(system),
        }
    }

    /// Motion, forces and contacts of the last evaluation; the energy of contacts is the caller's.
    pub fn take(&mut self, flow: &mut Flow) {
        for (contact, journal) in flow.system().contacts.iter().enumerate() {
            self.sample.contacts[contact] = ContactSample {
                reading: flow.reading(contact),
                state: state(journal, &flow.memories()[contact]),
            };
        }
        let equations = &mut flow.equations;
        let system = equations.own_system();
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
        q.copy_from_slice(equations.position());
        v.copy_from_slice(equations.velocity());
        a.copy_from_slice(equations.acceleration());
        force.copy_from_slice(equations.force());
        equations.reactions(lambda);
        // Behind those of joints stand those of sustained contacts.
        let sizes = equations.dependent_forces().sizes();
        dependent_forces.clear();
        dependent_forces.extend_from_slice(sizes);
    }

    /// Appends the sample's row.
    pub fn push(&mut self, flow: &mut Flow) {
        let equations = &mut flow.equations;
        let system = equations.own_system();
        let evaluation = equations.evaluation();
        self.recorder
            .push(system, evaluation, &equations.inputs, &self.sample);
    }
}
