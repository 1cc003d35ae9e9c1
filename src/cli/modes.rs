//! `linkdyn modes`: natural frequencies, damping and shapes of small motions about the equilibrium; the linear state space.

use std::path::PathBuf;

use clap::Args;

use super::exit::{Exit, Failure};
use super::interrupt;
use super::measures::range;
use super::open::ModelOptions;
use super::progress::Line;
use super::streams::{complain, json, tell, tell_json};
use linkdyn_ask::ModelFile;
use linkdyn_ask::Question;
use linkdyn_ask::modes::Modes;
use linkdyn_ask::state_space::{Linearisation, StateSpace};
use linkdyn_engine::analysis::Control;
use linkdyn_output::{Directory, Status, csv};

const TABLE: &str = "modes.csv";
const SUMMARY: &str = "modes.json";
const PAGE: &str = "modes.html";
const STATE_SPACE: &str = "state-space.json";

#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub struct Options {
    #[command(flatten)]
    model: ModelOptions,
    /// Linearise about the assembled position instead of the equilibrium
    #[arg(long)]
    pose: bool,
    /// Give the linear state space x' = A x + B w, y = C x + D w instead of the modes
    #[arg(long)]
    state_space: bool,
    /// Inputs w: driver.NAME, driver.NAME.acceleration, input.NAME, force.NAME, BODY.POINT.fx, BODY.POINT.fy, BODY.torque
    #[arg(long, value_name = "INPUT", num_args = 1.., requires = "state_space")]
    inputs: Vec<String>,
    /// Outputs y: columns of results, * stands for any text; the positions of the states where none are given
    #[arg(long, value_name = "COLUMN", num_args = 1.., requires = "state_space")]
    outputs: Vec<String>,
    /// About the motion of the analysis at this time \[s\], instead of rest; may be given more than once
    #[arg(
        long,
        value_name = "TIME",
        requires = "state_space",
        conflicts_with = "pose"
    )]
    at: Vec<f64>,
    /// Range of the frequency responses \[Hz\]; from the poles where it is not given
    #[arg(long, value_name = "A:B", requires = "state_space", value_parser = range)]
    frequencies: Option<[f64; 2]>,
    /// Print everything as JSON
    #[arg(long)]
    json: bool,
    /// Write modes.csv, modes.json, and modes.html, in which the shapes move, into this directory (made where missing); of the state
    /// space state-space.json, bode.svg and nyquist.svg
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
}

const HELP: &str = "  linkdyn modes double-pendulum
  linkdyn modes scotch-yoke --set \"drivers={}\" -o out
  linkdyn modes four-bar --state-space --inputs driver.motor --outputs rocker.angle joint.b.fx --at 0.3

How the equilibrium is found: linkdyn docs theory. What the files hold: linkdyn docs results.";

/// Linearises, writes, tells.
pub fn execute(options: &Options) -> Result<Exit, Failure> {
    let file = options.model.open()?;
    let directory = options.output.as_deref().map(Directory::open).transpose()?;
    let control = interrupt::control();
    let line = Line::watch(file.name(), &control);
    if options.state_space {
        return linearise(options, &file, directory, (&control, line));
    }
    let question = Modes { pose: options.pose };
    let found = question.answer(&file, &control);
    drop(line);
    let mut found = found.map_err(|why| options.model.refuse(why))?;
    let mut written = Vec::new();
    if let Some(directory) = directory {
        let page = found.html().transpose().unwrap_or_else(|fault| {
            let warning = format!("{PAGE} is not written: {fault}");
            found.found.warnings.push(warning);
            None
        });
        written.push(directory.write_with(TABLE, |out| csv::write(&found.table(), out))?);
        written.push(directory.write(SUMMARY, json(&found)?.as_bytes())?);
        match page {
            Some(html) => written.push(directory.write(PAGE, html.as_bytes())?),
            None => directory.remove(PAGE)?,
        }
    }
    match options.json {
        true => tell_json(&found)?,
        false => tell(found.text(), &written)?,
    }
    let found = found.found;
    Ok(ended(
        found.status,
        found.message.as_deref(),
        "the modes are",
    ))
}

/// How the command ends; `what` is complete all the same where it was interrupted too late.
fn ended(status: Status, message: Option<&str>, what: &str) -> Exit {
    let exit = Exit::from(status);
    if exit == Exit::Done && interrupt::is_set() {
        complain(&format!("interrupted; {what} complete all the same"));
        return Exit::Interrupted;
    }
    if exit != Exit::Done {
        complain(message.unwrap_or(status.word()));
    }
    exit
}

/// The linear state space.
fn linearise(
    options: &Options,
    file: &ModelFile,
    directory: Option<Directory>,
    (control, line): (&Control, Line),
) -> Result<Exit, Failure> {
    let question = StateSpace {
        inputs: options.inputs.clone(),
        outputs: options.outputs.clone(),
        pose: options.pose,
        at: options.at.clone(),
        frequencies: options.frequencies,
    };
    let found = question.answer(file, control);
    drop(line);
    let mut found = found.map_err(|why| options.model.refuse(why))?;
    let mut written = Vec::new();
    if let Some(directory) = directory {
        let figures = match found.figures() {
            Ok((figures, more)) => {
                found.warnings.extend(more);
                figures
            }
            Err(fault) => {
                found
                    .warnings
                    .push(format!("the figures are not written: {fault}"));
                Vec::new()
            }
        };
        written.push(directory.write(STATE_SPACE, json(&found)?.as_bytes())?);
        for name in Linearisation::figure_files() {
            match figures.iter().find(|(figure, _)| *figure == name) {
                Some((_, svg)) => written.push(directory.write(name, svg.as_bytes())?),
                None => directory.remove(name)?,
            }
        }
    }
    match options.json {
        true => tell_json(&found)?,
        false => tell(found.text(), &written)?,
    }
    Ok(ended(
        found.status,
        found.message.as_deref(),
        "the state space is",
    ))
}
