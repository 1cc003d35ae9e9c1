//! `linkdyn synthesise`: linkages for a wanted path, motion or function.

use std::path::PathBuf;

use clap::Args;

use super::answer_files;
use super::exit::{Exit, Failure};
use super::interrupt;
use super::open::ModelOptions;
use super::progress::Line;
use super::streams::{complain, json, print, tell, tell_json};
use super::threads::pool;
use linkdyn_ask::Question;
use linkdyn_ask::synthesise::Synthesise;
use linkdyn_output::{Directory, Status};

const FILES: [&str; 2] = ["synthesis.json", "synthesis.html"];

#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub struct Options {
    #[command(flatten)]
    task: ModelOptions,
    /// Print the model of linkage N
    #[arg(long, value_name = "N", conflicts_with_all = ["json", "output"])]
    take: Option<usize>,
    /// Print everything as JSON
    #[arg(long)]
    json: bool,
    /// Write synthesis.json, and synthesis.html, in which the linkages move, into this directory (made where missing)
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Threads that share the work; one for each processor where nothing is said
    #[arg(long, value_name = "N")]
    threads: Option<usize>,
}

const HELP: &str = "  linkdyn synthesise task.json -o out
  linkdyn synthesise task.json --take 1 > mine.json
  linkdyn synthesise task.json --set 'synthesise.linkages=[\"watt_1\"]'

What a task says, and how linkages are found: linkdyn docs synthesis.";

/// Finds, writes, tells.
pub fn execute(options: &Options) -> Result<Exit, Failure> {
    let task = &options.task;
    let file = task.open()?;
    let directory = options.output.as_deref().map(Directory::open).transpose()?;
    let control = interrupt::control();
    let line = Line::watch(file.name(), &control);
    let found = pool(options.threads)?.install(|| Synthesise.answer(&file, &control));
    drop(line);
    let found = found.map_err(|why| task.refuse(why))?;
    if let Some(number) = options.take {
        let text = found.print(number).map_err(|why| task.refuse(why))?;
        print(&text)?;
        return Ok(Exit::Done);
    }
    let page = found.html().transpose();
    let written = answer_files::write(directory.as_ref(), FILES, &json(&found)?, page)?;
    match options.json {
        true => tell_json(&found)?,
        false => tell(found.text(), &written)?,
    }
    if found.is_stopped {
        return Ok(Exit::Interrupted);
    }
    if found.count() == 0 {
        complain(
            "no linkage does what is wanted: the lines above tell what stood in the way of each kind",
        );
        return Ok(Exit::from(Status::AssemblyFailed));
    }
    Ok(Exit::Done)
}
