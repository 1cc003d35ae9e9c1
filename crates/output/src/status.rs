//! How a run ended.

/// How a run ended; what was computed until then is always kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Status {
    /// Every output was computed.
    #[default]
    Completed,
    /// The run came to its end, and some outputs have no solution: see the events.
    CompletedWithGaps,
    /// A driver can't go on: its mechanism is stretched out or folded.
    DeadCentre,
    /// The mechanism can't be put together.
    AssemblyFailed,
    /// The tolerances ask for steps below what numbers resolve.
    StepTooSmall,
    /// The constraints lose rank, or no way on is found.
    Singular,
    /// The time that the user allows is over.
    TimeLimit,
    /// The user stopped it.
    Interrupted,
}

impl Status {
    /// The word for it in `summary.json`.
    pub fn word(self) -> &'static str {
        match self {
            Status::Completed => "completed",
            Status::CompletedWithGaps => "completed_with_gaps",
            Status::DeadCentre => "dead_centre",
            Status::AssemblyFailed => "assembly_failed",
            Status::StepTooSmall => "step_too_small",
            Status::Singular => "singular",
            Status::TimeLimit => "time_limit",
            Status::Interrupted => "interrupted",
        }
    }
}

impl std::fmt::Display for Status {
    fn fmt(&self, to: &mut std::fmt::Formatter) -> std::fmt::Result {
        to.write_str(self.word())
    }
}
