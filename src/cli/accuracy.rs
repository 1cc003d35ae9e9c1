//! `linkdyn accuracy`: what tolerances and clearances do to the outputs of a mechanism.

use std::io::{BufWriter, Write};
use std::panic::resume_unwind;
use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::exit::{Exit, Failure};
use super::open::ModelOptions;
use super::progress::Line;
use super::streams::{print_with, tell};
use super::threads::threads;
use super::{interrupt, replaced};
use linkdyn_ask::Question;
use linkdyn_ask::accuracy::{Accuracy, Deviations};
use linkdyn_output::{Directory, WriteError};
use linkdyn_variation::Levels;

const TABLE: &str = "accuracy.csv";
const CONTRIBUTIONS: &str = "contributions.csv";
const SUMMARY: &str = "accuracy.json";
const PAGE: &str = "report.html";
/// Size of the pieces that are written \[bytes\].
const PIECE: usize = 1 << 16;

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
    let file = options.model.open()?;
    let directory = options.directory.as_deref().map(Directory::open);
    let directory = directory.transpose()?;
    let threads = threads(options.threads);
    let question = Accuracy {
        outputs: options.outputs.clone(),
        levels: options.levels.map(Into::into),
        threads: Some(threads),
    };
    let control = interrupt::control();
    let line = Line::watch(file.name(), &control);
    let found = question.answer(&file, &control);
    drop(line);
    let found = found.map_err(|why| options.model.refuse(why))?;
    let mut written = Vec::new();
    if let Some(directory) = directory {
        replaced::tell(directory.path(), "accuracy", "replaced");
        written = write(&directory, &found, threads.get())?;
    }
    match options.json {
        true => print_with(|out| found.write(out))?,
        false => tell(found.text(), &written)?,
    }
    Ok(Exit::Done)
}

/// Writes all files, on two threads where more than one is allowed: it takes longer than to work them out.
fn write(
    directory: &Directory,
    found: &Deviations,
    threads: usize,
) -> Result<Vec<PathBuf>, WriteError> {
    let everything = || {
        directory.write_with(SUMMARY, |out| {
            let mut out = BufWriter::with_capacity(PIECE, out);
            found.write(&mut out)?;
            out.flush()
        })
    };
    let others = || -> Result<[PathBuf; 3], WriteError> {
        Ok([
            directory.write(TABLE, &found.table())?,
            directory.write_with(CONTRIBUTIONS, |out| found.contributions(out))?,
            directory.write(PAGE, found.html().as_bytes())?,
        ])
    };
    let (everything, others) = if threads > 1 {
        std::thread::scope(|scope| {
            let everything = scope.spawn(everything);
            let others = others();
            let everything = everything.join();
            (
                everything.unwrap_or_else(|panic| resume_unwind(panic)),
                others,
            )
        })
    } else {
        (everything(), others())
    };
    let [table, contributions, page] = others?;
    Ok(vec![table, contributions, everything?, page])
}
