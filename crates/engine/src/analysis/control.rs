//! Outside influence on a run, and why one stops.

use super::progress::Progress;
use linkdyn_model::error::Complaint;
use linkdyn_output::Status;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use thiserror::Error;
use web_time::Instant;

/// Outside influence on a run.
#[derive(Debug, Clone, Default)]
pub struct Control {
    /// When to give up (`max_wall_time`).
    pub deadline: Option<Instant>,
    /// Set when the user wants the run to stop.
    pub interrupted: Arc<AtomicBool>,
    /// How far the run has come.
    pub progress: Progress,
}

impl Control {
    /// The reason to stop now, if there is one.
    pub fn stop(&self) -> Option<Status> {
        if self.interrupted.load(Ordering::Relaxed) {
            return Some(Status::Interrupted);
        }
        self.deadline
            .is_some_and(|deadline| Instant::now() >= deadline)
            .then_some(Status::TimeLimit)
    }
}

/// Why a run can't go on.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Stop {
    /// The input is bad.
    #[error("{}", sentences(.0))]
    Input(Vec<Complaint>),
    /// The solver cannot continue.
    #[error("{message}")]
    Failed {
        /// How the run ends.
        status: Status,
        /// Why, in a sentence or two.
        message: String,
    },
}

impl Stop {
    /// The solver cannot continue.
    pub fn failed(status: Status, message: String) -> Self {
        Stop::Failed { status, message }
    }

    /// Whether a run ends like this.
    pub(super) fn is_of(&self, of: Status) -> bool {
        matches!(self, Stop::Failed { status, .. } if *status == of)
    }
}

impl From<Complaint> for Stop {
    fn from(complaint: Complaint) -> Self {
        Stop::Input(vec![complaint])
    }
}

/// Complaints, one per line.
fn sentences(complaints: &[Complaint]) -> String {
    let lines: Vec<String> = complaints.iter().map(Complaint::to_string).collect();
    lines.join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stop_is_an_error_that_says_why() {
        let complaints = ["drivers", "bodies"].map(|path| Complaint::new(path, "missing"));
        let input: Box<dyn std::error::Error> = Box::new(Stop::Input(complaints.into()));
        assert_eq!(input.to_string(), "drivers: missing\nbodies: missing");
        let failed = Stop::failed(Status::Singular, "no way on".into());
        assert_eq!(failed.to_string(), "no way on");
    }
}
