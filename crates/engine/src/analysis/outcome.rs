//! What a run leaves.

use super::responses::Answer;
use linkdyn_output::{Report, Trajectory};
use std::borrow::Cow;

/// What a run leaves.
#[derive(Debug, Clone)]
pub struct Outcome {
    /// The columns that are wanted.
    pub trajectory: Trajectory,
    /// All columns, where `analysis.columns` leaves some out.
    pub complete: Option<Trajectory>,
    /// Rows between the outputs, by time, all columns: of motions with contacts those where columns have extremes, and where
    /// contacts begin, press most and end.
    pub peaks: Trajectory,
    /// The named numbers of the run.
    pub responses: Vec<Answer>,
    /// How it went.
    pub report: Report,
    /// The analysis as resolved, for the summary.
    pub settings: serde_json::Value,
}

impl Outcome {
    /// All columns that were computed, wanted or not.
    pub fn all(&self) -> &Trajectory {
        self.complete.as_ref().unwrap_or(&self.trajectory)
    }

    /// The columns that are wanted, with the rows of peaks among the outputs: what extremes and curves come from.
    pub fn curves(&self) -> Cow<'_, Trajectory> {
        self.trajectory.with_rows(&self.peaks)
    }

    /// The rows of peaks, with the columns that are wanted.
    pub fn wanted_peaks(&self) -> Trajectory {
        Trajectory::with_columns(&self.trajectory.columns)
            .with_rows(&self.peaks)
            .into_owned()
    }

    /// All columns, with the rows of peaks among the outputs.
    pub fn all_curves(&self) -> Cow<'_, Trajectory> {
        self.all().with_rows(&self.peaks)
    }
}
