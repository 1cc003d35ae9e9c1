//! `linkdyn accuracy`: what tolerances and clearances do to the outputs of a mechanism.

mod files;
mod json;
mod levels;
mod page;
mod text;

use std::path::PathBuf;
use std::time::Instant;

use clap::{Args, ValueEnum};

use super::exit::{Exit, Failure};
use super::interrupt;
use super::open::{ModelOptions, Opened};
use super::progress::Line;
use super::replaced;
use super::streams::{complain, print, print_with};
use super::threads::threads;
use linkdyn_engine::analysis::Control;
use linkdyn_engine::analysis::accuracy::{Accuracy, Levels, Parameters, Refusal, Scope, accuracy};
use linkdyn_model::{Checked, Parameter};
use linkdyn_output::Directory;

#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub struct Options {
    #[command(flatten)]
    model: ModelOptions,
    /// An output of the model's `accuracy`, instead of all; may be given more than once
    #[arg(long = "output", value_name = "NAME")]
    outputs: Vec<String>,
    /// How much to work out: the first order alone, with the worst found, or with the certified bound [default: what the model's
    /// `accuracy` says, else certified]
    #[arg(long, value_enum, value_name = "LEVELS")]
    levels: Option<Asked>,
    /// Threads that share the poses of a stroke; by default, or where it is 0, one for each processor
    #[arg(long, value_name = "N")]
    threads: Option<usize>,
    /// Print everything as JSON
    #[arg(long)]
    json: bool,
    /// Write accuracy.csv, contributions.csv, accuracy.json and report.html into this directory (made where missing)
    #[arg(short = 'o', value_name = "DIR")]
    directory: Option<PathBuf>,
}

/// How much is worked out.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum Asked {
    First,
    Worst,
    Certified,
}

impl From<Asked> for Levels {
    fn from(asked: Asked) -> Self {
        match asked {
            Asked::First => Levels::First,
            Asked::Worst => Levels::Worst,
            Asked::Certified => Levels::Certified,
        }
    }
}

const HELP: &str = "  linkdyn accuracy lock
  linkdyn accuracy lock --output closed -o out
  linkdyn accuracy lock --levels first

What the levels mean: linkdyn docs theory. What the files hold: linkdyn docs results.";

/// Asks, writes, tells.
pub fn execute(options: &Options) -> Result<Exit, Failure> {
    let opened = options.model.open()?;
    let directory = options
        .directory
        .as_deref()
        .map(Directory::open)
        .transpose()?;
    let control = Control {
        interrupted: interrupt::watch(),
        ..Control::default()
    };
    let line = Line::start(Instant::now(), &opened.name, || None);
    let threads = threads(options.threads);
    let scope = Scope {
        outputs: &options.outputs,
        levels: options.levels.map(Into::into),
        threads: Some(threads),
    };
    let found = answer(&opened, scope, &control);
    drop(line);
    let found = match found {
        Ok(found) => found,
        Err(refusal) => return refuse(&opened, refusal),
    };
    let mut written = Vec::new();
    if let Some(directory) = directory {
        replaced::tell(directory.path(), "accuracy", "replaced");
        written = files::write(&directory, &opened, &found, threads.get())?;
    }
    if options.json {
        print_with(|out| json::write(&opened, &found, out))?;
    } else {
        print(&text::page(&opened, &found, &written))?;
    }
    Ok(Exit::Done)
}

/// Why there is no answer.
pub fn refuse(opened: &Opened, refusal: Refusal) -> Result<Exit, Failure> {
    match refusal {
        Refusal::Input(complaints) => Err(opened.bad_input(complaints)),
        Refusal::Failed(message) => {
            complain(&message);
            Ok(Exit::Stopped)
        }
    }
}

/// The answer of the engine, with all that follows from the parameters.
///
/// # Errors
/// Why there is none.
pub fn answer(opened: &Opened, scope: Scope, control: &Control) -> Result<Accuracy, Refusal> {
    answer_with(opened, &opened.loaded.parameters, scope, control)
}

/// The same with other tolerances of the parameters.
///
/// # Errors
/// Why there is none.
pub fn answer_with(
    opened: &Opened,
    known: &[Parameter],
    scope: Scope,
    control: &Control,
) -> Result<Accuracy, Refusal> {
    let loaded = &opened.loaded;
    let limits: Vec<[f64; 2]> = known
        .iter()
        .map(|parameter| {
            let tolerance = parameter.tolerance.as_ref();
            tolerance.map_or([0.0; 2], |tolerance| {
                [tolerance.lower.min(0.0), tolerance.upper.max(0.0)]
            })
        })
        .collect();
    let with = |by: &[(usize, f64)]| -> Option<Checked> {
        let named: Vec<(&str, f64)> = by
            .iter()
            .map(|&(index, by)| (known[index].name.as_str(), by))
            .collect();
        loaded.source.with_deviations(&named).ok()
    };
    let dependence = loaded.source.dependence();
    let parameters = Parameters {
        all: known,
        derivatives: &dependence.at(&[]),
        enclosed: &|| dependence.within(&limits),
        with: &with,
    };
    accuracy(&loaded.model, &parameters, scope, control)
}
