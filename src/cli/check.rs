//! `linkdyn check`: reads, assembles and diagnoses a model.

use std::path::PathBuf;

use clap::Args;

use super::exit::{Exit, Failure};
use super::interrupt;
use super::open::{ModelOptions, bad_input};
use super::streams::{complain, tell, tell_json};
use linkdyn_ask::check::{Check, refused_html};
use linkdyn_ask::text::Page;
use linkdyn_ask::{ModelFile, Question};
use linkdyn_model::error::Complaints;
use linkdyn_output::Directory;

/// The page's name.
const PAGE: &str = "check.html";

#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub struct Options {
    #[command(flatten)]
    model: ModelOptions,
    /// Print the diagnosis as JSON
    #[arg(long)]
    json: bool,
    /// Write check.html into this directory (made where missing): the model with its names, loops, and what is wrong at its place
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
}

const HELP: &str = "  linkdyn check mine.json
  linkdyn check lock --json

What a message means, and what to do: linkdyn docs messages.";

/// Diagnoses and tells.
pub fn execute(options: &Options) -> Result<Exit, Failure> {
    let text = options.model.text()?;
    let file = match ModelFile::read(text.clone(), options.model.sets().to_vec()) {
        Ok(file) => file,
        Err(complaints) => {
            if let Some(output) = &options.output {
                let html = refused_html(&text, &complaints);
                let written = Directory::open(output)?.write(PAGE, html.as_bytes())?;
                if !options.json {
                    tell(Page::default(), &[written])?;
                }
            }
            return Err(bad_input(&text.label, complaints));
        }
    };
    let directory = options.output.as_deref().map(Directory::open).transpose()?;
    let control = interrupt::control();
    let found = Check
        .answer(&file, &control)
        .map_err(|why| options.model.refuse(why))?;
    let written = directory
        .map(|directory| directory.write(PAGE, found.html_with_circuits(&control).as_bytes()));
    let written = written.transpose()?;
    match options.json {
        true => tell_json(&found)?,
        false => tell(found.text(), written.as_slice())?,
    }
    let check = found.found;
    for fault in &check.faults {
        complain(&format!("{}: {fault}", text.label));
    }
    if !check.refused.is_empty() {
        let refused = file.refused(Complaints(check.refused));
        return Err(options.model.refuse(refused));
    }
    match Exit::from(check.status) {
        Exit::Done if check.faults.is_empty() => Ok(Exit::Done),
        Exit::Done => Ok(Exit::Fault),
        exit => {
            complain(check.message.as_deref().unwrap_or(check.status.word()));
            Ok(exit)
        }
    }
}
