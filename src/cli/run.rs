//! `linkdyn run`: runs a model's analysis, writes the results, prints a short summary.

use std::path::PathBuf;
use std::time::Instant;

use clap::Args;

use crate::files::{open_directory, write};
use crate::questions::deadline;

use super::exit::{BadInput, Exit};
use super::open::ModelOptions;
use super::progress::Line;
use super::streams::{complain, print};
use super::{interrupt, summary};
use linkdyn_engine::analysis::{self, Control};

#[derive(Debug, Args)]
pub struct Options {
    #[command(flatten)]
    model: ModelOptions,
    /// Write results.csv, summary.json and report.html into this directory (made where missing); of motions with contacts
    /// also peaks.csv
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
}

/// Runs, writes, tells.
pub fn execute(options: &Options) -> Result<Exit, BadInput> {
    let started = Instant::now();
    let opened = options.model.open()?;
    // Tried before the run, so that nothing is computed in vain.
    let directory = options.output.as_deref().map(open_directory).transpose()?;
    let model = &opened.loaded.model;
    let control = Control {
        deadline: deadline(model, started),
        interrupted: interrupt::watch(),
        ..Control::default()
    };
    let progress = control.progress.clone();
    let line = Line::start(started, &opened.name, move || progress.share());
    let outcome = analysis::run(model, &control);
    drop(line);
    let mut outcome = outcome.map_err(|complaints| opened.bad_input(complaints))?;
    outcome
        .report
        .warnings
        .splice(0..0, opened.loaded.warnings.iter().cloned());
    let written = directory
        .map(|directory| write(&directory, opened.origin(), &outcome))
        .transpose()?
        .unwrap_or_default();
    print(&summary::page(&opened, &outcome, &written))?;
    let status = outcome.report.status;
    let exit = Exit::from(status);
    if exit != Exit::Done {
        complain(outcome.report.message.as_deref().unwrap_or(status.word()));
    }
    Ok(exit)
}
