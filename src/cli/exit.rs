//! How a command ended: exit statuses, and whose fault it is, in words.

use std::io;

use linkdyn_output::{Status, WriteError};

/// How a command ended; of two ends the greater one is reported.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Exit {
    /// It did what was requested.
    Done,
    /// A check or validation found a fault.
    Fault,
    /// The input is bad.
    BadInput,
    /// The solver cannot continue.
    Stopped,
    /// A response misses its limits.
    Missed,
    /// The system takes no more: a full disk, a folder without permission, an output that is closed.
    Unwritten,
    /// A fault of linkdyn itself.
    Broken,
    /// The user wanted it to stop.
    Interrupted,
}

impl Exit {
    /// The exit status of the process.
    pub fn code(self) -> u8 {
        match self {
            Exit::Done => 0,
            Exit::Fault => 1,
            Exit::BadInput => 2,
            Exit::Stopped => 3,
            Exit::Missed => 4,
            Exit::Unwritten => 5,
            Exit::Broken => 6,
            Exit::Interrupted => 130,
        }
    }
}

impl From<Status> for Exit {
    fn from(status: Status) -> Self {
        match status {
            Status::Completed | Status::CompletedWithGaps => Exit::Done,
            Status::Interrupted => Exit::Interrupted,
            Status::DeadCentre
            | Status::AssemblyFailed
            | Status::StepTooSmall
            | Status::Singular
            | Status::TimeLimit => Exit::Stopped,
        }
    }
}

/// Why a command did not do what was asked: whose fault it is, and what to tell, a line each.
#[derive(Debug, PartialEq, Eq)]
pub enum Failure {
    /// That of the input.
    BadInput(Vec<String>),
    /// That of a solver that cannot continue.
    Stopped(String),
    /// That of the system, which does not take what is written.
    Unwritten(String),
    /// That of linkdyn.
    Broken(String),
}

pub use Failure::BadInput;

impl Failure {
    /// The lines to tell.
    pub fn lines(&self) -> &[String] {
        match self {
            Failure::BadInput(lines) => lines,
            Failure::Stopped(line) | Failure::Unwritten(line) | Failure::Broken(line) => {
                std::slice::from_ref(line)
            }
        }
    }

    /// What it is for the process, and the lines to tell.
    pub fn parts(self) -> (Exit, Vec<String>) {
        match self {
            Failure::BadInput(lines) => (Exit::BadInput, lines),
            Failure::Stopped(line) => (Exit::Stopped, vec![line]),
            Failure::Unwritten(line) => (Exit::Unwritten, vec![line]),
            Failure::Broken(line) => (Exit::Broken, vec![line]),
        }
    }
}

impl From<WriteError> for Failure {
    fn from(error: WriteError) -> Self {
        match error {
            // these would go another way with another -o
            WriteError::NotADirectory(_) | WriteError::InTheWay(_) => {
                BadInput(vec![error.to_string()])
            }
            WriteError::MakeDirectory { ref source, .. }
                if source.kind() == io::ErrorKind::NotADirectory =>
            {
                BadInput(vec![error.to_string()])
            }
            WriteError::MakeDirectory { .. }
            | WriteError::Write { .. }
            | WriteError::Replace { .. } => Failure::Unwritten(error.to_string()),
        }
    }
}

impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Self {
        Failure::Unwritten(format!("standard output can't be written: {error}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn statuses_have_the_exit_codes_of_the_contract() {
        for (status, code) in [
            (Status::Completed, 0),
            (Status::CompletedWithGaps, 0),
            (Status::DeadCentre, 3),
            (Status::AssemblyFailed, 3),
            (Status::StepTooSmall, 3),
            (Status::Singular, 3),
            (Status::TimeLimit, 3),
            (Status::Interrupted, 130),
        ] {
            assert_eq!(Exit::from(status).code(), code, "{status:?}");
        }
    }
}
