//! How a variant ended.

use linkdyn_output::Status;

/// How a variant ended.
#[derive(Debug, Clone, PartialEq)]
pub struct Ended {
    /// How the run ended.
    pub status: Status,
    /// Number of the first response without value.
    pub missing: Option<usize>,
}

impl Ended {
    /// Of a run that came to its end.
    pub(super) fn whole(responses: &[f64]) -> Self {
        Ended {
            status: Status::Completed,
            missing: responses.iter().position(|value| value.is_nan()),
        }
    }
}
