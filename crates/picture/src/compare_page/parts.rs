//! What the page is made of.

use linkdyn_output::comparison::Comparison;
use linkdyn_output::{Event, Status, Trajectory};

/// What the page is made of.
#[derive(Debug)]
pub struct ComparePage<'a> {
    /// Name of the model.
    pub model: &'a str,
    /// What the model is about.
    pub about: Option<&'a str>,
    /// What changes from run to run.
    pub changes: String,
    /// The columns that are compared, and how far the runs are apart.
    pub comparison: &'a Comparison,
    /// The runs, that which the others are compared with first among those that ran.
    pub runs: Vec<ComparedRun<'a>>,
}

/// A run of the comparison.
#[derive(Debug)]
pub struct ComparedRun<'a> {
    /// What it is called.
    pub name: &'a str,
    /// How it ended; `None` if it was not run.
    pub status: Option<Status>,
    /// How it ended, in a word.
    pub ended: String,
    /// How it went, or why there is none, in a line.
    pub facts: String,
    /// What the reader should know.
    pub notes: &'a [String],
    /// Its outputs and the peaks between them.
    pub table: Option<&'a Trajectory>,
    /// What happened.
    pub events: &'a [Event],
}
