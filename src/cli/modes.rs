//! `linkdyn modes`: natural frequencies, damping and shapes of small motions about the equilibrium.

use std::path::PathBuf;

use clap::Args;

use super::exit::{Exit, Failure};
use super::interrupt;
use super::open::ModelOptions;
use super::progress::Line;
use super::streams::{complain, json, tell, tell_json};
use linkdyn_ask::Question;
use linkdyn_ask::modes::Modes;
use linkdyn_output::{Directory, csv};

const TABLE: &str = "modes.csv";
const SUMMARY: &str = "modes.json";
const PAGE: &str = "modes.html";

#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub struct Options {
    #[command(flatten)]
    model: ModelOptions,
    /// Linearise about the assembled position instead of the equilibrium
    #[arg(long)]
    pose: bool,
    /// Print everything as JSON
    #[arg(long)]
    json: bool,
    /// Write modes.csv, modes.json, and modes.html, in which the shapes move, into this directory (made where missing)
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
}

const HELP: &str = "  linkdyn modes double-pendulum
  linkdyn modes scotch-yoke --set \"drivers={}\" -o out

How the equilibrium is found: linkdyn docs theory. What the files hold: linkdyn docs results.";

/// Linearises, writes, tells.
pub fn execute(options: &Options) -> Result<Exit, Failure> {
    let file = options.model.open()?;
    let directory = options.output.as_deref().map(Directory::open).transpose()?;
    let control = interrupt::control();
    let line = Line::watch(file.name(), &control);
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
    let exit = Exit::from(found.status);
    if exit == Exit::Done && interrupt::is_set() {
        complain("interrupted; the modes are complete all the same");
        return Ok(Exit::Interrupted);
    }
    if exit != Exit::Done {
        complain(found.message.as_deref().unwrap_or(found.status.word()));
    }
    Ok(exit)
}
