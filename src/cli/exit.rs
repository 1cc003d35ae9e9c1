//! How a command ended: exit statuses, and bad input in words.

use std::io;

use linkdyn_output::{Status, WriteError};

/// How a command ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Exit {
    /// It did what was asked for.
    Done,
    /// A check or validation found a fault.
    Fault,
    /// The input is bad.
    BadInput,
    /// Numerics or geometry forbid to go on.
    Stopped,
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

/// Bad input: what to tell, a line each.
#[derive(Debug, PartialEq, Eq)]
pub struct BadInput(pub Vec<String>);

impl From<WriteError> for BadInput {
    fn from(error: WriteError) -> Self {
        BadInput(vec![error.to_string()])
    }
}

impl From<io::Error> for BadInput {
    fn from(error: io::Error) -> Self {
        BadInput(vec![format!("standard output can't be written: {error}")])
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
