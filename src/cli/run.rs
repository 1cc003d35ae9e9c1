//! `linkdyn run`: runs a model's analysis, writes the results, prints a short summary.

use std::path::{Path, PathBuf};

use clap::Args;

use crate::files::{self, Written, open_directory, write};

use super::exit::{BadInput, Exit, Failure};
use super::live::Live;
use super::open::ModelOptions;
use super::progress::Line;
use super::streams::{complain, print, print_page, print_with, remark};
use super::watch::watch;
use super::{interrupt, replaced};
use linkdyn_ask::run::{Run, of_columns, text};
use linkdyn_ask::text::responses::is_missed;
use linkdyn_ask::text::{Page, names, seconds};
use linkdyn_ask::{ModelFile, Question, with_responses};
use linkdyn_engine::analysis::Outcome;
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
    /// End with exit status 4 where a response misses its limits
    #[arg(long)]
    strict: bool,
    /// Run again whenever the model file changes, until Ctrl-C
    #[arg(long)]
    watch: bool,
}

const HELP: &str = "  linkdyn run four-bar -o out
  linkdyn run mine.json -o out --watch
  linkdyn run four-bar --set parameters.crank=\"120 mm\" --json
  linkdyn run four-bar -o - > results.csv
  linkdyn run four-bar --response \"peak = max(abs(driver.motor.effort))\"
  linkdyn run mine.json --strict

Exit status: 4 with --strict, where a response misses its limits; the rest as of all commands (linkdyn --help).
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
        return Ok(run(options)?.exit);
    }
    let shown = options.output.as_deref().filter(|_| !options.no_report);
    let mut live = None;
    watch(options.model.path(), || {
        let ran = run(options);
        let Some(path) = shown else {
            return Ok((ran?.exit, String::new()));
        };
        let live = match &mut live {
            Some(live) => live,
            none => none.insert(Live::new(Directory::open(path)?, options.model.path())?),
        };
        if let Err(failure) = &ran {
            live.tell(failure.lines());
        }
        let ran = ran?;
        let word = live.show(ran.file, &ran.outcome);
        Ok((ran.exit, word))
    })
}

/// A run that has an outcome.
struct Ran {
    exit: Exit,
    file: ModelFile,
    outcome: Outcome,
}

/// Runs, writes, tells.
fn run(options: &Options) -> Result<Ran, Failure> {
    let (model, asked) = (&options.model, &options.responses);
    let file = with_responses(&model.text()?, model.sets(), asked);
    let file = file.map_err(|why| model.refuse(why))?;
    let target = match options.output.as_deref() {
        None => Target::Nowhere,
        Some(path) if path == Path::new("-") => Target::Stream,
        Some(path) => Target::Directory(open_directory(path)?),
    };
    let control = interrupt::control();
    let line = Line::watch(file.name(), &control);
    let outcome = match &target {
        Target::Directory(_) if !options.no_report => Run.answer(&file, &control),
        Target::Directory(_) | Target::Nowhere | Target::Stream => of_columns(&file, &control),
    };
    drop(line);
    let outcome = outcome.map_err(|why| model.refuse(why))?;
    let written = match &target {
        Target::Directory(directory) => {
            let (page, does) = if options.no_report {
                (files::Page::Unwanted, "removed")
            } else {
                (files::Page::Wanted, "replaced")
            };
            replaced::tell(directory.path(), "run", does);
            write(directory, file.origin(), &outcome, page)?
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
        (Target::Nowhere, true) => print(&file.origin().summary(&outcome, Stage::default()))?,
        (Target::Directory(_), true) => print(&written.summary)?,
        (Target::Nowhere | Target::Directory(_), false) => {
            print_page(&page(&file, &outcome, &written))?;
        }
    }
    Ok(Ran {
        exit: ended(options, &outcome),
        file,
        outcome,
    })
}

/// How it ended for the process; what is not as requested is told.
fn ended(options: &Options, outcome: &Outcome) -> Exit {
    let status = outcome.report.status;
    let exit = Exit::from(status);
    if exit != Exit::Done {
        complain(outcome.report.message.as_deref().unwrap_or(status.word()));
        return exit;
    }
    let missed = outcome.responses.iter().filter(|one| is_missed(one));
    let missed: Vec<String> = missed.map(|one| one.name.clone()).collect();
    if !options.strict || missed.is_empty() {
        return Exit::Done;
    }
    complain(&format!("limits are missed: {}", names(&missed)));
    Exit::Missed
}

/// The run in words, with what was written and how long that took.
fn page(file: &ModelFile, outcome: &Outcome, written: &Written) -> Page {
    let mut page = text(file, outcome);
    let paths = written.paths.iter().map(|path| path.display().to_string());
    page.rows("written", paths);
    let report = &outcome.report;
    let mut stages = vec![
        ("load", file.time),
        ("assemble", report.assemble),
        ("solve", report.solve),
    ];
    if !written.paths.is_empty() {
        stages.push(("write", written.time));
    }
    page.row("time", times(&stages));
    page
}

/// `load 0.3 ms, solve 12 ms (CPU 11 ms)`.
fn times(stages: &[(&str, Stage)]) -> String {
    let walls: Vec<String> = stages
        .iter()
        .map(|(name, stage)| format!("{name} {}", seconds(stage.wall)))
        .collect();
    let cpu: f64 = stages.iter().map(|(_, stage)| stage.cpu).sum();
    format!("{} (CPU {})", walls.join(", "), seconds(cpu))
}
