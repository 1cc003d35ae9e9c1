//! The rows of a run.

use super::cams::Watch;
use super::channels::{Channels, Contents};
use super::sample::Sample;
use crate::system::{Evaluation, Inputs, System};
use linkdyn_output::{Column, Trajectory};

/// The channels of a run, and the table that they fill.
#[derive(Clone)]
pub struct Recorder {
    channels: Channels,
    /// The rows so far.
    pub trajectory: Trajectory,
    /// What is seen of cams; `None` if there are none.
    cams: Option<Watch>,
    reactions: bool,
}

impl Recorder {
    /// Of all channels, with room for `rows` rows.
    pub fn new(system: &System, contents: Contents, rows: usize) -> Self {
        Recorder::keeping(system, contents, None, rows)
    }

    /// The same of these channels alone, where some are given.
    pub fn keeping(
        system: &System,
        contents: Contents,
        kept: Option<&[Column]>,
        rows: usize,
    ) -> Self {
        let all = || contents.columns(system);
        let channels = Channels::of(kept.map_or_else(all, <[Column]>::to_vec));
        let mut trajectory = Trajectory::with_columns(channels.columns());
        trajectory.reserve(rows);
        Recorder {
            channels,
            trajectory,
            cams: (system.joints.iter())
                .any(|joint| joint.extras().cam.is_some())
                .then(Watch::default),
            reactions: contents.reactions,
        }
    }

    /// Appends a row; `evaluation` has the sample's position and velocity.
    pub fn push(
        &mut self,
        system: &System,
        evaluation: &Evaluation,
        inputs: &Inputs,
        sample: &Sample,
    ) {
        if let Some(cams) = &mut self.cams {
            let lambda = self.reactions.then_some(sample.lambda.as_slice());
            cams.note(system, &evaluation.kinematics(inputs), lambda);
        }
        let rows = &mut self.trajectory.data;
        self.channels
            .push_row(system, evaluation, inputs, sample, rows);
    }

    /// What is to be said of cams.
    pub fn warnings(&self, system: &System) -> Vec<String> {
        let cams = self.cams.as_ref();
        cams.map_or_else(Vec::new, |cams| cams.warnings(system))
    }

    /// Appends a row at an instant without solution: time and driver values only.
    pub fn push_gap(&mut self, inputs: &Inputs) {
        self.channels.push_gap(inputs, &mut self.trajectory.data);
    }
}
