//! `linkdyn compare`: one model with each model of a joint's clearance, and how far their results are apart.

use std::path::PathBuf;

use clap::Args;

use super::exit::{Exit, Failure};
use super::interrupt;
use super::open::ModelOptions;
use super::progress::Line;
use super::streams::{complain, json, tell};
use crate::files::{Page, open_directory, write};
use linkdyn_ask::compare::{Compare, Compared};
use linkdyn_output::{Directory, csv};

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
    let file = options.model.open()?;
    let directory = options.output.as_deref().map(Directory::open).transpose()?;
    for name in [TABLE, SUMMARY, PAGE] {
        directory.iter().try_for_each(|own| own.expect_free(name))?;
    }
    let question = Compare {
        joints: options.joints.clone(),
        models: options.models.clone(),
        columns: options.columns.clone(),
    };
    let control = interrupt::control();
    let begin = |model: &str| Line::watch(model, &control);
    let found = question.answer_model_by_model(&file, &control, begin);
    let found = found.map_err(|why| options.model.refuse(why))?;
    let written = match &directory {
        Some(directory) => write_all(directory, &found)?,
        None => Vec::new(),
    };
    tell(found.text(), &written)?;
    Ok(complain_of(&found))
}

/// Writes the results of each model, table, summary, page and figures.
fn write_all(directory: &Directory, found: &Compared) -> Result<Vec<PathBuf>, Failure> {
    for rung in &found.rungs {
        if let Ok((file, outcome)) = &rung.ran {
            let own = open_directory(&directory.path().join(rung.model))?;
            write(&own, file.origin(), outcome, Page::Wanted)?;
        }
    }
    let table = &found.comparison.curves;
    let mut written = vec![
        directory.write_with(TABLE, |out| csv::write(table, out))?,
        directory.write(SUMMARY, json(found)?.as_bytes())?,
        directory.write(PAGE, found.html().as_bytes())?,
    ];
    for (name, figure) in found.figures() {
        written.push(directory.write(&name, figure.as_bytes())?);
    }
    Ok(written)
}

/// Complains of models that can't be run though they were requested, and of runs that stopped; how the worst went.
fn complain_of(found: &Compared) -> Exit {
    let mut worst = Exit::Done;
    if !found.left_out.is_empty() {
        let left_out = found.left_out.join(", ");
        complain(&format!("interrupted: {left_out} left out"));
        worst = Exit::Interrupted;
    }
    for rung in &found.rungs {
        let (exit, why) = match &rung.ran {
            Err(why) if found.is_chosen => (Exit::BadInput, why.as_str()),
            Err(_) => continue,
            Ok((_, outcome)) => {
                let report = &outcome.report;
                let why = report.message.as_deref();
                (report.status.into(), why.unwrap_or(report.status.word()))
            }
        };
        if exit != Exit::Done {
            complain(&format!("{}: {why}", rung.model));
        }
        worst = worst.max(exit);
    }
    worst
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_worst_end_counts() {
        assert_eq!(Exit::BadInput.max(Exit::Stopped), Exit::Stopped);
        assert_eq!(Exit::Interrupted.max(Exit::BadInput), Exit::Interrupted);
    }
}
