//! `linkdyn compare`: one model with each model of a joint's clearance, and how far their results are apart.

mod columns;
mod figures;
mod json;
mod ladder;
mod page;
mod question;
mod report;
mod table;

use std::path::{Path, PathBuf};

use clap::Args;

use super::exit::{BadInput, Exit, Failure};
use super::interrupt;
use super::open::{ModelOptions, Opened};
use super::streams::{complain, print};
use columns::{compare, curves};
use ladder::{Rung, run, worse};
use linkdyn_output::{Directory, WriteError, csv};
use question::{joints, models};
use report::Report;

const TABLE: &str = "compare.csv";
const SUMMARY: &str = "compare.json";
const PAGE: &str = "compare.html";

#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub struct Options {
    #[command(flatten)]
    model: ModelOptions,
    /// Joint whose clearance model changes; may be given more than once, or `all` that have a clearance
    #[arg(long = "joint", value_name = "NAME", required = true)]
    joints: Vec<String>,
    /// Clearance models, the first is what the others are compared with [default: ideal, massless_link, two_state,
    /// three_state and contact, as far as the file has their parameters]
    #[arg(long, value_name = "MODEL,…", value_delimiter = ',')]
    models: Vec<String>,
    /// Result columns to compare: names without unit, `*` any text, `?` one character [default: drivers' efforts, forces in
    /// the joints, motion of the last body that is not driven]
    #[arg(long, value_name = "PATTERN,…", value_delimiter = ',')]
    columns: Vec<String>,
    /// Write each model's results into a directory of its name below this one, and compare.csv, compare.json, the
    /// page compare.html and a figure of each column (SVG)
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
}

const HELP: &str = "Only \"model\" of the joints' clearance changes from run to run. joint.NAME.force is the magnitude of a \
joint's force.\n\nExit status: that of the run that went worst: 3 where one stopped early, 2 where a model asked for by \
--models can't be run; models of the default ladder that can't be run are skipped.

What each model can and can't show: linkdyn docs theory.";

/// Runs all, writes, tells.
pub fn execute(options: &Options) -> Result<Exit, Failure> {
    let opened = options.model.open()?;
    let joints = joints(&opened, &options.joints)?;
    let models = models(&options.models)?;
    let directory = options.output.as_deref().map(open_output).transpose()?;
    let (rungs, exit) = run_all(options, &opened, &joints, &models, directory.as_ref())?;
    let comparison = compare(&opened.loaded.model, &joints, &rungs, &options.columns);
    let curves = curves(&joints, &rungs);
    let report = Report {
        opened: &opened,
        joints: &joints,
        rungs: &rungs,
        wanted: !options.models.is_empty(),
        comparison: &comparison,
        curves: &curves,
    };
    let written = match &directory {
        Some(directory) => write_all(directory, &report)?,
        None => Vec::new(),
    };
    print(&table::page(&report, &written))?;
    if rungs.len() < models.len() {
        complain(&format!(
            "interrupted: {} left out",
            models[rungs.len()..].join(", ")
        ));
    }
    complain_of(&report);
    Ok(exit)
}

/// Runs with each model, until there is nothing to compare; what came of them, and how the worst went.
fn run_all(
    options: &Options,
    opened: &Opened,
    joints: &[String],
    models: &[&'static str],
    directory: Option<&Directory>,
) -> Result<(Vec<Rung>, Exit), Failure> {
    let wanted = !options.models.is_empty();
    let mut rungs = Vec::new();
    let mut exit = Exit::Done;
    for &model in models {
        let rung = Rung {
            model,
            ran: run(&options.model, (joints, &options.columns), model, directory)?,
        };
        let ended = match &rung.ran {
            Ok(outcome) => Exit::from(outcome.report.status),
            Err(_) if wanted => Exit::BadInput,
            Err(_) => Exit::Done,
        };
        exit = worse(exit, ended);
        rungs.push(rung);
        // All runs have the columns of the first one, so that the others need not be waited for.
        if rungs.iter().filter(|rung| rung.ran.is_ok()).count() == 1 {
            let compared = compare(&opened.loaded.model, joints, &rungs, &options.columns);
            if !compared.unmatched.is_empty() {
                let unmatched = compared.unmatched.iter();
                return Err(BadInput(
                    unmatched.map(|pattern| no_column(pattern)).collect(),
                ));
            }
        }
        // Also between two runs, and where a run ended before it looked.
        if interrupt::is_set() && rungs.len() < models.len() {
            exit = Exit::Interrupted;
            break;
        }
    }
    if rungs.iter().all(|rung| rung.ran.is_err()) {
        let reasons = rungs
            .iter()
            .filter_map(|rung| Some((rung.model, rung.ran.as_ref().err()?)));
        return Err(BadInput(
            reasons
                .map(|(model, why)| format!("{}: {model}: {why}", opened.label))
                .collect(),
        ));
    }
    Ok((rungs, exit))
}

fn open_output(path: &Path) -> Result<Directory, Failure> {
    let directory = Directory::open(path)?;
    directory.expect_free(TABLE)?;
    directory.expect_free(SUMMARY)?;
    directory.expect_free(PAGE)?;
    Ok(directory)
}

/// Writes table, summary, page and figures.
fn write_all(directory: &Directory, report: &Report) -> Result<Vec<PathBuf>, WriteError> {
    let comparison = report.comparison;
    let table = directory.write_with(TABLE, |file| csv::write(&comparison.curves, file))?;
    let text = format!("{:#}\n", json::json(report));
    let mut written = vec![table, directory.write(SUMMARY, text.as_bytes())?];
    written.push(directory.write(PAGE, page::html(report).as_bytes())?);
    for (name, figure) in figures::figures(&comparison.columns, report.curves) {
        written.push(directory.write(&name, figure.as_bytes())?);
    }
    Ok(written)
}

/// Complains of models that can't be run though they were asked for, and of runs that stopped.
fn complain_of(report: &Report) {
    for rung in report.rungs {
        match &rung.ran {
            Err(why) if report.wanted => complain(&format!("{}: {why}", rung.model)),
            Ok(outcome) if Exit::from(outcome.report.status) != Exit::Done => {
                let status = outcome.report.status.word();
                complain(&format!(
                    "{}: {}",
                    rung.model,
                    outcome.report.message.as_deref().unwrap_or(status)
                ));
            }
            Ok(_) | Err(_) => {}
        }
    }
}

fn no_column(pattern: &str) -> String {
    format!("--columns {pattern:?}: matches no column (names without [unit], as in results.csv)")
}
