//! `linkdyn run`: runs a model's analysis, writes the results, prints a short summary.

use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::Args;

use crate::files::{self, Written, open_directory, summary_text, write};
use crate::questions::deadline;

use super::exit::{BadInput, Exit, Failure};
use super::live::Live;
use super::open::{ModelOptions, Opened};
use super::progress::Line;
use super::streams::{complain, print, print_with, remark};
use super::watch::watch;
use super::{interrupt, replaced, responses, summary};
use linkdyn_engine::analysis::{self, Control, Outcome};
use linkdyn_output::{Directory, Stage, csv};

#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub struct Options {
    #[command(flatten)]
    model: ModelOptions,
    /// Write results.csv, summary.json and report.html into this directory (made where missing); of motions with contacts
    /// also peaks.csv. `-` prints results.csv instead of the summary
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Print summary.json instead of the summary for people
    #[arg(long)]
    json: bool,
    /// Write no report.html, and remove an older one from DIR
    #[arg(long, requires = "output")]
    no_report: bool,
    /// Ask for a named number of the run, as in "stroke = max(piston.x) - min(piston.x)"; may be given more than once
    #[arg(long = "response", value_name = "NAME = EXPRESSION")]
    responses: Vec<String>,
    /// Run again whenever the model file changes, until Ctrl-C
    #[arg(long)]
    watch: bool,
}

const HELP: &str = "  linkdyn run four-bar -o out
  linkdyn run mine.json -o out --watch
  linkdyn run four-bar --set parameters.crank=\"120 mm\" --json
  linkdyn run four-bar -o - > results.csv
  linkdyn run four-bar --response \"peak = max(abs(driver.motor.effort))\"

What the columns mean: linkdyn docs results. What a message means: linkdyn docs messages.";

/// Where the results go.
enum Target {
    /// Only the summary is printed.
    Nowhere,
    /// The rows go to standard output.
    Stream,
    Directory(Directory),
}

/// Runs once, or again and again.
pub fn execute(options: &Options) -> Result<Exit, Failure> {
    let is_stream = options.output.as_deref() == Some(Path::new("-"));
    let clash = [("--json", options.json), ("--watch", options.watch)];
    let clash: Vec<String> = clash
        .iter()
        .filter(|(_, given)| is_stream && *given)
        .map(|(option, _)| {
            format!("{option}: not with -o -, which prints the rows (name a directory)")
        })
        .collect();
    if !clash.is_empty() {
        return Err(BadInput(clash));
    }
    if !options.watch {
        return once(options);
    }
    let shown = options.output.as_deref().filter(|_| !options.no_report);
    let mut live = None;
    watch(options.model.path(), || {
        let exit = once(options)?;
        let Some(path) = shown else {
            return Ok((exit, String::new()));
        };
        let live = match &mut live {
            Some(live) => live,
            // Its directory is there since the run has written into it.
            none => none.insert(Live::new(Directory::open(path)?)),
        };
        let page = live.show()?;
        Ok((exit, format!("; {page} shows the report of each run")))
    })
}

/// Runs, writes, tells.
fn once(options: &Options) -> Result<Exit, Failure> {
    let started = Instant::now();
    let opened = responses::open(&options.model, &options.responses)?;
    // Tried before the run, so that nothing is computed in vain.
    let target = match options.output.as_deref() {
        None => Target::Nowhere,
        Some(path) if path == Path::new("-") => Target::Stream,
        Some(path) => Target::Directory(open_directory(path)?),
    };
    let outcome = solve(&opened, started)?;
    let origin = opened.origin();
    let written = match &target {
        Target::Directory(directory) => {
            let (page, does) = if options.no_report {
                (files::Page::Unwanted, "removed")
            } else {
                (files::Page::Wanted, "replaced")
            };
            replaced::tell(directory.path(), "run", does);
            write(directory, origin, &outcome, page)?
        }
        Target::Nowhere | Target::Stream => Written::default(),
    };
    match (&target, options.json) {
        (Target::Stream, _) => {
            print_with(|mut out| csv::write(&outcome.trajectory, &mut out))?;
            for warning in &outcome.report.warnings {
                remark(&format!("warning: {warning}"));
            }
        }
        (Target::Nowhere, true) => print(&summary_text(origin, &outcome, Stage::default()))?,
        (Target::Directory(_), true) => print(&written.summary)?,
        (Target::Nowhere | Target::Directory(_), false) => {
            print(&summary::page(&opened, &outcome, &written))?;
        }
    }
    let status = outcome.report.status;
    let exit = Exit::from(status);
    if exit != Exit::Done {
        complain(outcome.report.message.as_deref().unwrap_or(status.word()));
    }
    Ok(exit)
}

/// The outcome of the analysis; the warnings of the file come before its own.
fn solve(opened: &Opened, started: Instant) -> Result<Outcome, Failure> {
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
    let warnings = opened.loaded.warnings.iter().cloned();
    outcome.report.warnings.splice(0..0, warnings);
    Ok(outcome)
}
