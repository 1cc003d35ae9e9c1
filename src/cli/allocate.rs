//! `linkdyn allocate`: the cheapest tolerances that keep the limits of all outputs.

use std::path::PathBuf;

use clap::Args;

use super::exit::{Exit, Failure};
use super::interrupt;
use super::open::ModelOptions;
use super::streams::{tell, tell_json};
use linkdyn_ask::Question;
use linkdyn_ask::allocate::Allocate;
use linkdyn_output::replace;

#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub struct Options {
    #[command(flatten)]
    model: ModelOptions,
    /// Limits of an output of the model's `accuracy`, instead of all; may be given more than once
    #[arg(long = "output", value_name = "NAME")]
    outputs: Vec<String>,
    /// Add variances up, as for parts that scatter, and keep three standard deviations (99.73 %) within the limits, instead of all
    /// at their worst
    #[arg(long)]
    rss: bool,
    /// Print everything as JSON
    #[arg(long)]
    json: bool,
    /// Write the model with these tolerances to this file
    #[arg(long, value_name = "FILE")]
    write: Option<PathBuf>,
}

const HELP: &str = "  linkdyn allocate clamp.json
  linkdyn allocate clamp.json --rss --write cheap.json

A tolerance is chosen for each parameter that has a \"cost\" a; it costs a/t for ±t. How: linkdyn docs theory.";

/// Chooses, writes, tells.
pub fn execute(options: &Options) -> Result<Exit, Failure> {
    let file = options.model.open()?;
    let question = Allocate {
        outputs: options.outputs.clone(),
        squares: options.rss,
    };
    let found = question.answer(&file, &interrupt::control());
    let found = found.map_err(|why| options.model.refuse(why))?;
    if let Some(path) = &options.write {
        let model = found.model().map_err(|why| options.model.refuse(why))?;
        replace(path, model.print().as_bytes())?;
    }
    match options.json {
        true => tell_json(&found)?,
        false => tell(found.text(), options.write.as_slice())?,
    }
    Ok(Exit::Done)
}
