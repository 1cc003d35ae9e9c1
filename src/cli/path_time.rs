//! `linkdyn path-time`: the fastest motion along a stroke under limits of effort, speed and joint forces.

use std::path::PathBuf;

use clap::Args;

use super::exit::{Exit, Failure};
use super::open::ModelOptions;
use super::streams::{json, tell, tell_json};
use super::{interrupt, replaced};
use linkdyn_ask::Question;
use linkdyn_ask::path_time::PathTime;
use linkdyn_output::{Directory, replace};

const DOCUMENT: &str = "path-time.json";
const TABLE: &str = "law.csv";
const MODEL: &str = "fastest.json";
const PAGE: &str = "report.html";

#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub struct Options {
    #[command(flatten)]
    model: ModelOptions,
    /// The driver that moves; needed if there are several
    #[arg(long, value_name = "DRIVER")]
    driver: Option<String>,
    /// Where the stroke begins, as in "0 deg"; by default where the driver's motion begins
    #[arg(long, value_name = "VALUE", allow_hyphen_values = true)]
    from: Option<String>,
    /// Where it ends; by default where the driver's motion ends
    #[arg(long, value_name = "VALUE", allow_hyphen_values = true)]
    to: Option<String>,
    /// A limit of result columns, to both sides or with both ends, as in "driver.motor.effort=-2 N*m:5 N*m"; "joint.*=300 N" limits the
    /// size of the force in each joint
    #[arg(long = "limit", value_name = "COLUMN=LIMIT")]
    limits: Vec<String>,
    /// The greatest speed of the driver, as in "10 rad/s"
    #[arg(long, value_name = "VALUE")]
    speed: Option<String>,
    /// The greatest acceleration of the driver, to both sides
    #[arg(long, value_name = "VALUE")]
    acceleration: Option<String>,
    /// Speed along the stroke at its start; by default at rest
    #[arg(long, value_name = "VALUE", allow_hyphen_values = true)]
    start_speed: Option<String>,
    /// Speed along the stroke at its end; by default at rest
    #[arg(long, value_name = "VALUE", allow_hyphen_values = true)]
    end_speed: Option<String>,
    /// Intervals of constant acceleration, 400 where nobody says
    #[arg(long, value_name = "N")]
    intervals: Option<u64>,
    /// Write the model with the law of motion to this file
    #[arg(long, value_name = "FILE")]
    write: Option<PathBuf>,
    /// Print path-time.json instead of the summary for people
    #[arg(long)]
    json: bool,
    /// Write path-time.json, law.csv, fastest.json (the model with the law of motion) and the page report.html into this directory (made
    /// where missing)
    #[arg(short = 'o', long = "output", value_name = "DIR")]
    directory: Option<PathBuf>,
}

const HELP: &str = "  linkdyn path-time mine.json --from \"0 deg\" --to \"90 deg\" --limit \"driver.motor.effort=5 N*m\"
  linkdyn path-time mine.json --limit \"driver.motor.effort=-2 N*m:5 N*m\" --limit \"joint.*=300 N\" --speed \"10 rad/s\" -o out

How it is computed, and what the files hold: linkdyn docs path-time.";

/// Computes, tells.
pub fn execute(options: &Options) -> Result<Exit, Failure> {
    let model = &options.model;
    let question = PathTime {
        driver: options.driver.clone(),
        from: options.from.clone(),
        to: options.to.clone(),
        limits: options.limits.clone(),
        speed: options.speed.clone(),
        acceleration: options.acceleration.clone(),
        start_speed: options.start_speed.clone(),
        end_speed: options.end_speed.clone(),
        intervals: options.intervals,
    };
    let file = model.open()?;
    let directory = options.directory.as_deref().map(Directory::open);
    let directory = directory.transpose()?;
    let found = question.answer(&file, &interrupt::control());
    let found = found.map_err(|why| model.refuse(why))?;
    let mut written = Vec::new();
    if let Some(directory) = &directory {
        written.push(directory.write(DOCUMENT, json(&found)?.as_bytes())?);
        written.push(directory.write(TABLE, found.table().as_bytes())?);
        written.push(directory.write(MODEL, found.model().print().as_bytes())?);
        replaced::tell(directory.path(), "path-time", "replaced");
        let page = found
            .html()
            .map_err(|why| Failure::Stopped(why.to_string()))?;
        written.push(directory.write(PAGE, page.as_bytes())?);
    }
    if let Some(path) = &options.write {
        replace(path, found.model().print().as_bytes())?;
        written.push(path.clone());
    }
    match options.json {
        true => tell_json(&found)?,
        false => tell(found.text(), &written)?,
    }
    Ok(Exit::Done)
}
