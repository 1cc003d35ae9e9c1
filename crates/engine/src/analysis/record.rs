//! The rows of a run.

use super::bent;
use super::cams::Watch;
use super::channels::{Channels, Contents, larger};
use super::sample::Sample;
use super::section;
use crate::system::{Evaluation, Inputs, System};
use linkdyn_output::{Column, Report, Trajectory};

/// The channels of a run, and the table that they fill.
#[derive(Clone)]
pub struct Recorder {
    channels: Channels,
    /// The rows so far.
    pub trajectory: Trajectory,
    /// What is seen of cams; `None` if there are none.
    cams: Option<Watch>,
    reactions: bool,
    /// What was left over on links with a cross-section, and the size of all forces on them \[N\].
    unbalanced: [f64; 2],
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
            unbalanced: [0.0; 2],
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
        let unbalanced = self
            .channels
            .push_row(system, evaluation, inputs, sample, rows);
        self.unbalanced = larger(self.unbalanced, unbalanced);
    }

    /// What is to be said of cams and of links with a cross-section.
    pub fn close(&self, system: &System, report: &mut Report) {
        report.warnings.extend(self.warnings(system));
        let sections = section::warnings(system, &self.trajectory);
        report.warnings.extend(sections);
        let steps = report.statistics.steps;
        let bent = bent::warnings(system, &self.trajectory, steps as usize);
        report.warnings.extend(bent);
        let [rest, size] = self.unbalanced;
        report.quality.section_imbalance = (size > 0.0).then(|| rest / size);
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
