//! The rows of a run.

use super::channels::{Channels, Contents};
use super::sample::Sample;
use crate::system::{Evaluation, Inputs, System};
use linkdyn_output::Trajectory;

/// The channels of a run, and the table that they fill.
pub struct Recorder {
    channels: Channels,
    /// The rows so far.
    pub trajectory: Trajectory,
}

impl Recorder {
    /// Of all channels, with room for `rows` rows.
    pub fn new(system: &System, contents: Contents, rows: usize) -> Self {
        let channels = Channels::new(system, contents);
        let mut trajectory = Trajectory::with_columns(channels.columns());
        trajectory.reserve(rows);
        Recorder {
            channels,
            trajectory,
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
        let rows = &mut self.trajectory.data;
        self.channels
            .push_row(system, evaluation, inputs, sample, rows);
    }

    /// Appends a row at an instant without solution: time and driver values only.
    pub fn push_gap(&mut self, inputs: &Inputs) {
        self.channels.push_gap(inputs, &mut self.trajectory.data);
    }
}
