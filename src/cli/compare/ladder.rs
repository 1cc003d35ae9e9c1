//! Runs of one model, each with a rung of the ladder of clearance models.

use std::time::Instant;

use crate::cli::exit::{Exit, Failure};
use crate::cli::interrupt;
use crate::cli::open::ModelOptions;
use crate::cli::progress::Line;
use crate::files::{Page, open_directory, write};
use crate::questions::deadline;
use linkdyn_engine::analysis::{self, Control, Outcome};
use linkdyn_model::Checked;
use linkdyn_model::error::{Complaint, Complaints};
use linkdyn_output::{Channel, Directory};

/// What came of a model.
pub struct Rung {
    /// Word of the clearance model.
    pub model: &'static str,
    /// The run, or why there is none.
    pub ran: Result<Outcome, String>,
}

/// Runs with one clearance model, with the columns that are compared, and writes its results; inside, why it can't be run.
pub fn run(
    options: &ModelOptions,
    (joints, patterns): (&[String], &[String]),
    model: &str,
    directory: Option<&Directory>,
) -> Result<Result<Outcome, String>, Failure> {
    let started = Instant::now();
    let sets: Vec<String> = joints
        .iter()
        .map(|joint| format!("joints.{joint}.clearance.model={model}"))
        .collect();
    let mut opened = match options.open_with(&sets)? {
        Ok(opened) => opened,
        Err(complaints) => return Ok(Err(reason(&complaints))),
    };
    match asking(&opened.loaded.model, patterns) {
        Ok(model) => opened.loaded.model = model,
        Err(Complaints(complaints)) => return Ok(Err(reason(&complaints))),
    }
    let deadline = deadline(&opened.loaded.model, started);
    let control = Control {
        deadline,
        interrupted: interrupt::watch(),
        ..Control::default()
    };
    let progress = control.progress.clone();
    let line = Line::start(started, model, move || progress.share());
    let ran = analysis::run(&opened.loaded.model, &control);
    drop(line);
    let mut outcome = match ran {
        Ok(outcome) => outcome,
        Err(complaints) => return Ok(Err(reason(&complaints))),
    };
    outcome
        .report
        .warnings
        .splice(0..0, opened.loaded.warnings.iter().cloned());
    if let Some(directory) = directory {
        let directory = open_directory(&directory.path().join(model))?;
        write(&directory, opened.origin(), &outcome, Page::Wanted)?;
    }
    Ok(Ok(outcome))
}

/// The model that asks for columns that results have only then.
fn asking(model: &Checked, patterns: &[String]) -> Result<Checked, Complaints> {
    let waits = |pattern: &&String| {
        let channel = Channel::read(pattern);
        matches!(
            channel,
            Some((Channel::Relative(..) | Channel::Load(..), _))
        )
    };
    let asked: Vec<String> = patterns.iter().filter(waits).cloned().collect();
    if asked.is_empty() {
        return Ok(model.clone());
    }
    model.edit(|model| {
        if let Some(analysis) = &mut model.analysis {
            if analysis.columns.is_empty() {
                analysis.columns.push("*".to_owned());
            }
            analysis.columns.extend(asked);
        }
    })
}

/// Complaints as a line; where they stand in the file does not matter here.
fn reason(complaints: &[Complaint]) -> String {
    let said = complaints.iter().map(
        |Complaint {
             path,
             message,
             hint,
             ..
         }| {
            let hint = hint
                .as_ref()
                .map(|hint| format!(" ({hint})"))
                .unwrap_or_default();
            format!("{path}: {message}{hint}")
        },
    );
    said.collect::<Vec<_>>().join("; ")
}

/// What to tell of two ends: an interruption, then a stop, then bad input.
pub fn worse(a: Exit, b: Exit) -> Exit {
    let rank = |exit: Exit| match exit {
        Exit::Done => 0,
        Exit::Fault => 1,
        Exit::BadInput => 2,
        Exit::Stopped => 3,
        Exit::Unwritten => 4,
        Exit::Broken => 5,
        Exit::Interrupted => 6,
    };
    if rank(b) > rank(a) { b } else { a }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_worst_end_counts() {
        assert_eq!(worse(Exit::BadInput, Exit::Stopped), Exit::Stopped);
        assert_eq!(worse(Exit::Interrupted, Exit::BadInput), Exit::Interrupted);
        assert_eq!(worse(Exit::Done, Exit::Done), Exit::Done);
    }
}
