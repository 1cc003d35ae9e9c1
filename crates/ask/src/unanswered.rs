//! Why a question has no answer.

use linkdyn_model::error::Complaints;
use linkdyn_study::chunks::ChunkFault;
use thiserror::Error;

/// Why a question has no answer.
#[derive(Debug, Error)]
pub enum Unanswered {
    /// The model has faults, each with its place.
    #[error(transparent)]
    Model(#[from] Complaints),
    /// The question can't be asked of this model: what is wrong, a line each.
    #[error("{}", .0.join("\n"))]
    Question(Vec<String>),
    /// The solver cannot continue: why, in a sentence or two.
    #[error("{0}")]
    Failed(String),
    /// It was interrupted before it had an answer.
    #[error("interrupted")]
    Interrupted,
    /// Rows of a study can't be kept or read.
    #[error(transparent)]
    Rows(#[from] ChunkFault),
}

impl Unanswered {
    /// The question can't be asked, for this reason.
    pub fn question(why: impl Into<String>) -> Self {
        Unanswered::Question(vec![why.into()])
    }
}
