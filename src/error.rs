//! What can go wrong before a run.

use std::path::PathBuf;

use linkdyn_ask::Unanswered;
use linkdyn_model::error::{Complaint, Complaints};
use linkdyn_output::WriteError;
use linkdyn_study::chunks::ChunkFault;
use thiserror::Error as ThisError;

/// Why something could not be done. How a run ended is no error: see [`Run::status`](crate::Run::status).
#[derive(Debug, ThisError)]
#[non_exhaustive]
pub enum Error {
    /// The model has faults; all of them, in the order of the lines.
    #[error(transparent)]
    Model(Complaints),
    /// A file can't be read.
    #[error("{}: can't be read: {cause}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system says.
        #[source]
        cause: std::io::Error,
    },
    /// A result file can't be written.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// No bundled model has this name.
    #[error("{name}: {cause}")]
    Bundled {
        /// As requested.
        name: String,
        /// Why there is none.
        cause: linkdyn_model::bundled::NotBundled,
    },
    /// No parameter or column has this name.
    #[error("no {what} is called {name:?}{}", nearest.as_ref().map_or(String::new(), |near| format!("; did you mean {near:?}?")))]
    Unknown {
        /// `parameter` or `column`.
        what: &'static str,
        /// As requested.
        name: String,
        /// The most similar name that there is.
        nearest: Option<String>,
    },
    /// A value has another dimension than its parameter.
    #[error("the parameter {parameter:?} is in {expected}, not in {given}")]
    Dimension {
        /// Name of the parameter.
        parameter: String,
        /// SI unit of the parameter.
        expected: String,
        /// SI unit of the value.
        given: String,
    },
    /// A text is no unit.
    #[error("{0:?} is no unit")]
    Unit(String),
    /// A file of another program can't be read.
    #[error(transparent)]
    Foreign(#[from] linkdyn_exchange::Refused),
    /// A question can't be asked of this model: what is wrong, a line each.
    #[error("{}", .0.join("\n"))]
    Question(Vec<String>),
    /// A question has no answer, as the solver cannot continue.
    #[error("{0}")]
    Failed(String),
    /// A question was interrupted before it had an answer.
    #[error("interrupted")]
    Interrupted,
    /// Rows of a study can't be kept or read.
    #[error(transparent)]
    Rows(ChunkFault),
    /// A run ended early; what was computed until then can be had from [`Run`](crate::Run).
    #[error("the run ended early ({}): {message}", status.word())]
    Early {
        /// How it ended.
        status: linkdyn_output::Status,
        /// Why, in a sentence or two.
        message: String,
    },
}

impl Error {
    /// The faults of the model, each with path, place, cause and mend; empty of other errors.
    pub fn complaints(&self) -> &[Complaint] {
        match self {
            Error::Model(complaints) => complaints,
            _ => &[],
        }
    }
}

impl Error {
    /// Whether the system does not take what is written.
    pub fn is_unwritten(&self) -> bool {
        matches!(
            self,
            Error::Write(_) | Error::Rows(ChunkFault::Write { .. } | ChunkFault::Join(_))
        )
    }
}

impl From<Complaints> for Error {
    fn from(complaints: Complaints) -> Self {
        Error::Model(complaints)
    }
}

impl From<Unanswered> for Error {
    fn from(why: Unanswered) -> Self {
        match why {
            Unanswered::Model(complaints) => Error::Model(complaints),
            Unanswered::Question(lines) => Error::Question(lines),
            Unanswered::Failed(why) => Error::Failed(why),
            Unanswered::Interrupted => Error::Interrupted,
            Unanswered::Rows(fault) => Error::Rows(fault),
        }
    }
}
