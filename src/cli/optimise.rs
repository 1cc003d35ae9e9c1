//! `linkdyn optimise`: values of parameters with which goals are met, an objective is least, or a point takes a path.

use std::path::PathBuf;

use clap::Args;

use super::exit::{Exit, Failure};
use super::open::ModelOptions;
use super::progress::Line;
use super::streams::{complain, json, tell, tell_json};
use super::{interrupt, replaced, threads};
use linkdyn_ask::optimise::Optimise;
use linkdyn_output::{Directory, replace};

const DOCUMENT: &str = "optimise.json";
const TABLE: &str = "evaluations.csv";
const PAGE: &str = "report.html";

#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub struct Options {
    #[command(flatten)]
    model: ModelOptions,
    /// A parameter that may change, as in "parameters.r=10 mm:60 mm" (lower and upper bound); without bounds a goal is looked for
    /// around its value
    #[arg(long, value_name = "PATH=RANGE")]
    vary: Vec<String>,
    /// An equation that must hold, as in "stroke = 80 mm"
    #[arg(long = "goal", value_name = "EQUATION")]
    goals: Vec<String>,
    /// What is to be least, as in "max(abs(driver.motor.effort))"
    #[arg(long, value_name = "EXPRESSION")]
    minimise: Vec<String>,
    /// What is to be greatest
    #[arg(long, value_name = "EXPRESSION")]
    maximise: Vec<String>,
    /// What must hold besides, as in "peak < 40 N*m"
    #[arg(long = "constraint", value_name = "COMPARISON")]
    constraints: Vec<String>,
    /// Let the objective get so many standard deviations worse, by the tolerances of parameters
    #[arg(long, value_name = "K")]
    robust: Option<f64>,
    /// How many starts there are, 8 where nobody says
    #[arg(long, value_name = "N")]
    starts: Option<u64>,
    /// Seed of the points from which they start, 1 where nobody says
    #[arg(long, value_name = "SEED")]
    seed: Option<u64>,
    /// Threads; by default one for each processor
    #[arg(long, value_name = "N")]
    threads: Option<usize>,
    /// Write the model with what was found to this file
    #[arg(long, value_name = "FILE")]
    write: Option<PathBuf>,
    /// Print optimise.json instead of the summary for people
    #[arg(long)]
    json: bool,
    /// Write optimise.json, evaluations.csv and the page report.html into this directory (made where missing)
    #[arg(short = 'o', long = "output", value_name = "DIR")]
    directory: Option<PathBuf>,
}

const HELP: &str = "  linkdyn optimise mine.json --vary parameters.crank --goal \"max(piston.x) - min(piston.x) = 80 mm\"
  linkdyn optimise mine.json --vary \"parameters.crank=20 mm:60 mm\" --minimise \"max(abs(driver.motor.effort))\" --constraint \"stroke > 70 mm\"
  linkdyn optimise mine.json --starts 20 --write best.json -o out

A curve is asked for in the model. How it searches, and what the files hold: linkdyn docs optimise.";

/// Looks, tells.
pub fn execute(options: &Options) -> Result<Exit, Failure> {
    let model = &options.model;
    let question = Optimise {
        vary: options.vary.clone(),
        goals: options.goals.clone(),
        minimise: options.minimise.clone(),
        maximise: options.maximise.clone(),
        constraints: options.constraints.clone(),
        robust: options.robust,
        starts: options.starts,
        seed: options.seed,
    };
    let control = interrupt::control();
    let search = question.of(&model.text()?, model.sets(), &control);
    let search = search.map_err(|why| model.refuse(why))?;
    let directory = options.directory.as_deref().map(Directory::open);
    let directory = directory.transpose()?;
    let pool = threads::pool(options.threads)?;
    let line = Line::watch(search.file.name(), &control);
    let found = pool.install(|| search.answer(directory.is_some()));
    drop(line);
    let found = found.map_err(|why| model.refuse(why))?;
    let mut written = Vec::new();
    if let Some(directory) = &directory {
        written.push(directory.write(DOCUMENT, json(&found)?.as_bytes())?);
        written.push(directory.write(TABLE, found.table().as_bytes())?);
        replaced::tell(directory.path(), "optimise", "replaced");
        written.push(directory.write(PAGE, found.html().as_bytes())?);
    }
    if let Some(path) = &options.write
        && let Some(best) = found.model().map_err(|why| model.refuse(why))?
    {
        replace(path, best.print().as_bytes())?;
        written.push(path.clone());
    }
    match options.json {
        true => tell_json(&found)?,
        false => tell(found.text(), &written)?,
    }
    let Some(why) = found.failure() else {
        return Ok(Exit::Done);
    };
    complain(&why);
    Ok(match found.is_stopped() {
        true => Exit::Interrupted,
        false => Exit::Stopped,
    })
}
