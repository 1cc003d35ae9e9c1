//! `linkdyn run`: runs a model's analysis, writes the results, prints a short summary.

use std::path::PathBuf;
use std::time::{Duration, Instant};

use clap::Args;

use super::open::{ModelOptions, Opened};
use super::progress::Line;
use super::shape::shape;
use super::{BadInput, Exit, complain, interrupt, print, report, summary};
use linkdyn_engine::analysis::{self, Control, Outcome};
use linkdyn_model::Model;
use linkdyn_output::{Directory, Stage, Stopwatch, Summary, WriteError, csv};

const RESULTS: &str = "results.csv";
/// Rows between those of the results, where columns have their peaks.
pub const PEAKS: &str = "peaks.csv";
const SUMMARY: &str = "summary.json";
const REPORT: &str = "report.html";

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
        .map(|directory| write(&directory, &opened, &outcome))
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

/// Files that were written, and how long that took.
#[derive(Debug, Default)]
pub struct Written {
    pub paths: Vec<PathBuf>,
    pub time: Stage,
}

/// When `max_wall_time` is over; none where there is no such setting, or no clock can tell that instant.
pub fn deadline(model: &Model, started: Instant) -> Option<Instant> {
    let seconds = model.analysis.as_ref()?.solver.max_wall_time?;
    started.checked_add(Duration::try_from_secs_f64(seconds).ok()?)
}

/// The directory, tried before the run, so that nothing is computed in vain.
pub fn open_directory(path: &std::path::Path) -> Result<Directory, WriteError> {
    let directory = Directory::open(path)?;
    directory.expect_free(RESULTS)?;
    directory.expect_free(PEAKS)?;
    directory.expect_free(SUMMARY)?;
    directory.expect_free(REPORT)?;
    Ok(directory)
}

/// Writes all result files; the summary comes last, since it tells how long the others took.
pub fn write(
    directory: &Directory,
    opened: &Opened,
    outcome: &Outcome,
) -> Result<Written, WriteError> {
    let watch = Stopwatch::start();
    let results = directory.write_with(RESULTS, |file| csv::write(&outcome.trajectory, file))?;
    let peaks = outcome.wanted_peaks();
    let peaks = if peaks.is_empty() {
        // Those of an older run are not those of these results.
        directory.remove(PEAKS)?;
        None
    } else {
        Some(directory.write_with(PEAKS, |file| csv::write(&peaks, file))?)
    };
    let curves = outcome.curves();
    let shape = shape(&opened.loaded.model, outcome.all());
    let report = directory.write(REPORT, report::text(opened, outcome).as_bytes())?;
    let summary = Summary {
        model_name: &opened.name,
        model_sha256: &opened.sha256,
        settings: &outcome.settings,
        report: &outcome.report,
        trajectory: &curves,
        mechanism: shape.to_json(),
        drawing: shape.to_drawing(),
        load: opened.time,
        write: watch.read(),
    };
    let summary = directory.write(
        SUMMARY,
        linkdyn_output::summary::to_text(&summary).as_bytes(),
    )?;
    let paths = [Some(results), peaks, Some(summary), Some(report)]
        .into_iter()
        .flatten()
        .collect();
    Ok(Written {
        paths,
        time: watch.read(),
    })
}
