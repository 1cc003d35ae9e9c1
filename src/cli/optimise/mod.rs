//! `linkdyn optimise`: values of parameters with which goals are met, an objective is least, or a point takes a path.
//!
//! | file       | does                                                                  |
//! | ---------- | --------------------------------------------------------------------- |
//! | `asked`    | options, put into the model's `optimise`                              |
//! | `question` | what is looked for                                                    |
//! | `variants` | what a variant gives: the one place where the search meets the engine |
//! | `guarded`  | variants among which one with a fault of linkdyn has no value         |
//! | `path`     | the model whose motion gives a path, and its nodes                    |
//! | `timing`   | the analysis that gives a path                                        |
//! | `problem`  | a variant as the search sees it                                       |
//! | `slopes`   | its derivatives                                                       |
//! | `search`   | the starts                                                            |
//! | `told`     | what they come to                                                     |
//! | `text`     | the same for people                                                   |
//! | `words`    | what a model looks for, for `check`                                   |

mod asked;
mod guarded;
mod path;
mod problem;
mod question;
mod search;
mod slopes;
mod text;
mod timing;
mod told;
mod variants;
mod words;

pub use words::rows;

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Instant;

use clap::Args;
use serde_json::{Value, json};

use super::exit::{Exit, Failure};
use super::interrupt;
use super::open::{ModelOptions, Opened};
use super::progress::Line;
use super::streams::{complain, print};
use super::threads;
use guarded::Guarded;
use linkdyn_model::Unit;
use linkdyn_output::{Directory, replace};
use question::{Aim, Question, Variable};
use search::Search;
use timing::Timing;
use told::Told;
use variants::{Found, Runs};

const DOCUMENT: &str = "optimise.json";
const TABLE: &str = "evaluations.csv";

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
    /// Write optimise.json and evaluations.csv into this directory (made where missing)
    #[arg(short = 'o', long = "output", value_name = "DIR")]
    directory: Option<PathBuf>,
}

const HELP: &str = "  linkdyn optimise mine.json --vary parameters.crank --goal \"max(piston.x) - min(piston.x) = 80 mm\"
  linkdyn optimise mine.json --vary \"parameters.crank=20 mm:60 mm\" --minimise \"max(abs(driver.motor.effort))\" --constraint \"stroke > 70 mm\"
  linkdyn optimise mine.json --starts 20 --write best.json -o out

A curve is asked for in the model. How it searches, and what the files hold: linkdyn docs optimise.";

/// Looks, tells.
pub fn execute(options: &Options) -> Result<Exit, Failure> {
    let (plain, sets) = asked::open(&options.model, options)?;
    let (question, opened) = Question::new(&options.model, &sets, &plain)?;
    let timing = Timing::new(&options.model, &sets, &question, &opened)?;
    let runs = Runs::new(
        &options.model,
        &sets,
        &question,
        &opened,
        timing.as_ref(),
        interrupt::watch(),
    )?;
    let mut search = Search {
        question: &question,
        variants: &Guarded(&runs),
        timing: timing.as_ref(),
        scales: Vec::new(),
        keep: options.directory.is_some(),
    };
    let directory = options
        .directory
        .as_deref()
        .map(Directory::open)
        .transpose()?;
    let pool = threads::pool(options.threads)?;
    let as_it_is = pool.install(|| search.as_it_is())?;
    let done = Arc::new(AtomicU64::new(0));
    let line = progress(&opened, &question, &done);
    let ended = pool.install(|| search.run(&done));
    drop(line);
    let ended = ended?;
    let told = Told::new(&question, &ended, &search.scales);
    let document = told.to_json(head(options, &opened));
    let mut written = Vec::new();
    if let Some(directory) = &directory {
        written.push(directory.write(DOCUMENT, format!("{document:#}\n").as_bytes())?);
        written.push(directory.write(TABLE, told::table(&question, &ended).as_bytes())?);
    }
    if let (Some(path), Some((best, _))) = (&options.write, told.found()) {
        write(options, &plain, &question.variables, &best.x, path)?;
        written.push(path.clone());
    }
    print(&if options.json {
        format!("{document:#}\n")
    } else {
        text::page(&opened, &told, &written)
    })?;
    Ok(exit(&told, &as_it_is))
}

/// How far it has come.
fn progress(opened: &Opened, question: &Question, done: &Arc<AtomicU64>) -> Line {
    let all = match question.aim {
        Aim::Goal => 1,
        Aim::Goals | Aim::Objective | Aim::Curve | Aim::ConstrainedCurve => question.starts,
    };
    let done = Arc::clone(done);
    Line::start(Instant::now(), &opened.name, move || {
        Some(done.load(Ordering::Relaxed) as f64 / all as f64)
    })
}

fn head(options: &Options, opened: &Opened) -> Value {
    json!({
        "engine": env!("CARGO_PKG_VERSION"),
        "model": { "name": opened.name, "sha256": opened.sha256, "set": options.model.sets() },
    })
}

/// The exit status, with the reason where nothing was found.
fn exit<T>(told: &Told, as_it_is: &Found<T>) -> Exit {
    match told.status() {
        "interrupted" => {
            complain("interrupted: this is the best so far");
            Exit::Interrupted
        }
        "found" => Exit::Done,
        "no_values" => {
            complain(&match as_it_is {
                Found::None(why) => format!("no variant has a result; the model as it is: {why}"),
                Found::Some(_) | Found::Stopped => "no variant has a result".to_owned(),
            });
            Exit::Stopped
        }
        _ => {
            complain(match told.question.aim {
                Aim::Goal => "the goal is not reached; this is the nearest",
                Aim::Goals => "not all goals are reached; these are the nearest",
                Aim::Objective | Aim::Curve | Aim::ConstrainedCurve => {
                    "no variant was found that keeps all constraints; this is the nearest"
                }
            });
            Exit::Stopped
        }
    }
}

/// Writes the model with what was found, everything else as it is.
fn write(
    options: &Options,
    opened: &Opened,
    variables: &[Variable],
    x: &[f64],
    path: &Path,
) -> Result<(), Failure> {
    let all = variables.iter().zip(x);
    let sets: Vec<String> = all
        .map(|(own, x)| format!("parameters.{}={}", own.parameter.name, said(own, *x)))
        .collect();
    let with = options.model.open_with(&sets)?;
    let with = with.map_err(|said| opened.bad_input(said))?;
    let model = with.loaded.source.print(&with.loaded.model);
    Ok(replace(path, format!("{model:#}\n").as_bytes())?)
}

/// Digits with which values are written: what is beyond them is not known of an optimum.
const DIGITS: usize = 12;

/// A value as the file would say it, in the unit of the parameter where that is read so, else in SI.
fn said(variable: &Variable, x: f64) -> String {
    let parameter = &variable.parameter;
    let rounded = |x: f64| format!("{x:.*e}", DIGITS - 1).parse::<f64>().unwrap_or(x);
    if parameter.unit.is_empty() {
        return rounded(x).to_string();
    }
    let text = parameter.text.trim();
    let is_number = |c: char| c.is_ascii_digit() || "+-.eE".contains(c);
    let unit = text.trim_start_matches(is_number).trim();
    if let Ok(known) = Unit::parse(unit)
        && let Some(size) = known.convert(1.0, Unit::si(known.powers))
    {
        return format!("\"{} {unit}\"", rounded(x / size));
    }
    format!("\"{} {}\"", rounded(x), parameter.unit)
}
