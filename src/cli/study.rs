//! `linkdyn study`: many variants of a model, what comes out of each, and what that comes to.

use std::path::{Path, PathBuf};

use clap::{Args, Subcommand};

use super::exit::{BadInput, Exit, Failure};
use super::open::{ModelOptions, refuse};
use super::progress::Line;
use super::streams::{complain, print, tell, tell_json};
use super::{interrupt, replaced, threads};
use crate::error::Error;
use crate::studies::{Files, Kept};
use linkdyn_ask::study::{Studied, Study, Variants, Varied};
use linkdyn_ask::{ModelFile, Unanswered, with_responses};
use linkdyn_engine::analysis::Control;
use linkdyn_study::chunks::Shard;
use linkdyn_study::design::Method;

#[derive(Debug, Args)]
#[command(after_help = HELP, args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
pub struct Options {
    #[command(subcommand)]
    merge: Option<Merge>,
    #[command(flatten)]
    model: Option<ModelOptions>,
    /// Vary a parameter over a grid, as in "parameters.r=40 mm:60 mm:21" (from, to, count) or "parameters.r=40 mm, 50 mm"; several
    /// multiply
    #[arg(long, value_name = "PATH=VALUES")]
    vary: Vec<String>,
    /// Draw so many samples of all parameters that have a tolerance
    #[arg(long, value_name = "N")]
    samples: Option<u64>,
    /// Take scrambled Sobol points instead of random ones
    #[arg(long, requires = "samples", conflicts_with = "latin")]
    sobol: bool,
    /// Take a Latin hypercube instead of random points
    #[arg(long, requires = "samples")]
    latin: bool,
    /// Take the rows that Sobol indices need, inputs + 2 for each sample
    #[arg(long, requires = "samples")]
    indices: bool,
    /// Seed of the samples [default: 1]
    #[arg(long, value_name = "SEED")]
    seed: Option<u64>,
    /// A number that comes out of each variant, as in "stroke = max(piston.x) - min(piston.x)", besides those of the model
    #[arg(long = "response", value_name = "NAME = EXPRESSION")]
    responses: Vec<String>,
    /// Compute share I of N only, as in 2/7, or what Slurm's array task is to do: slurm
    #[arg(long, value_name = "I/N", requires = "directory")]
    shard: Option<String>,
    /// Threads; by default one for each processor
    #[arg(long, value_name = "N")]
    threads: Option<usize>,
    /// Print study.json instead of the summary for people
    #[arg(long)]
    json: bool,
    /// Keep chunks of rows in this directory (made where missing), go on from those that are there, and write variants.csv,
    /// study.json and report.html
    #[arg(short = 'o', long = "output", value_name = "DIR")]
    directory: Option<PathBuf>,
    /// Write no report.html, and remove an older one from DIR
    #[arg(long, requires = "directory")]
    no_report: bool,
    /// Write variants.parquet, too
    #[arg(long, requires = "directory")]
    parquet: bool,
}

#[derive(Debug, Subcommand)]
enum Merge {
    /// Join the chunks that shards have written into a directory
    Merge {
        /// The directory of the study
        #[arg(value_name = "DIR")]
        directory: PathBuf,
        /// Print study.json instead of the summary for people
        #[arg(long)]
        json: bool,
        /// Write no report.html, and remove an older one from DIR
        #[arg(long)]
        no_report: bool,
        /// Write variants.parquet, too
        #[arg(long)]
        parquet: bool,
    },
}

const HELP: &str = "  linkdyn study mine.json --vary \"parameters.r=40 mm:60 mm:21\" --response \"peak = max(abs(driver.motor.effort))\" -o out
  linkdyn study mine.json --samples 100000 --sobol -o out
  linkdyn study mine.json --samples 100000 -o out --shard 2/7
  linkdyn study merge out

What responses may say: linkdyn docs format. What the files hold: linkdyn docs studies.";

/// Runs all variants, sums up, tells.
pub fn execute(options: &Options) -> Result<Exit, Failure> {
    let of_merge = matches!(options.merge, Some(Merge::Merge { parquet: true, .. }));
    if (options.parquet || of_merge) && !cfg!(feature = "parquet") {
        let why = "--parquet: this command was built without it; build it with --features dist, or read variants.csv";
        return Err(BadInput(vec![why.into()]));
    }
    if let Some(Merge::Merge {
        directory,
        json,
        no_report,
        parquet,
    }) = &options.merge
    {
        let files = Files {
            page: !no_report,
            parquet: *parquet,
        };
        return merge(directory, files, *json);
    }
    let Some(model) = &options.model else {
        return Err(BadInput(vec![
            "which model? as in: linkdyn study mine.json --samples 1000".into(),
        ]));
    };
    let shard = options.shard.as_deref().map(shard).transpose()?;
    let file = with_responses(&model.text()?, model.sets(), &options.responses);
    let variants = file.and_then(|file| question(options, &file)?.variants(&file));
    let variants = variants.map_err(|why| model.refuse(why))?;
    let pool = threads::pool(options.threads)?;
    let control = interrupt::control();
    let line = Line::watch(variants.file.name(), &control);
    let done = pool.install(|| compute(options, &variants, shard, &control));
    drop(line);
    match done.map_err(|why| model.refuse(why))? {
        Some((studied, written)) => answer(&studied, &written, options.json),
        None if interrupt::is_set() => {
            complain(match options.directory {
                Some(_) => "interrupted; the same command goes on from the variants that are done",
                None => "interrupted; with -o DIR a study goes on from what is done",
            });
            Ok(Exit::Interrupted)
        }
        None => {
            if let (Some(shard), Some(directory)) = (&options.shard, &options.directory) {
                print(&format!(
                    "shard {shard} of {} variants is done; when all are: linkdyn study merge {}\n",
                    variants.head.variants,
                    directory.display()
                ))?;
            }
            Ok(Exit::Done)
        }
    }
}

/// What the options ask for; what the model says, where these do not say what is varied.
fn question(options: &Options, file: &ModelFile) -> Result<Study, Unanswered> {
    if options.vary.is_empty()
        && options.samples.is_none()
        && let Some(own) = Study::of_model(file, options.seed)
    {
        return Ok(own);
    }
    let varied = options.vary.iter().map(|text| Varied::read(text));
    let default = Study::default();
    Ok(Study {
        varied: varied.collect::<Result<_, _>>()?,
        samples: options.samples,
        method: match (options.sobol, options.latin) {
            (true, _) => Method::Sobol { scrambled: true },
            (_, true) => Method::LatinHypercube,
            _ => default.method,
        },
        indices: options.indices,
        seed: options.seed.unwrap_or(default.seed),
    })
}

type Done = Option<(Studied, Vec<PathBuf>)>;

/// What the variants come to, and the files that were written; `None` if it is interrupted, or is a shard.
fn compute(
    options: &Options,
    variants: &Variants,
    shard: Option<Shard>,
    control: &Control,
) -> Result<Done, Error> {
    let Some(path) = &options.directory else {
        let studied = variants.answer(control, |_| ());
        return Ok(studied.map(|studied| (studied, Vec::new())));
    };
    let kept = Kept::begin(path, variants)?;
    let whole = Shard::WHOLE;
    if !kept.fill(variants, shard.unwrap_or(whole), control)?
        || shard.is_some_and(|own| own != whole)
    {
        return Ok(None);
    }
    let files = Files {
        page: !options.no_report,
        parquet: options.parquet,
    };
    tell_replaced(path, files);
    kept.join(Some((variants, control)), files).map(Some)
}

fn tell_replaced(path: &Path, files: Files) {
    let does = if files.page { "replaced" } else { "removed" };
    replaced::tell(path, "study", does);
}

/// Joins what shards have left.
fn merge(path: &Path, files: Files, json: bool) -> Result<Exit, Failure> {
    let joined = Kept::read(path).and_then(|kept| {
        tell_replaced(path, files);
        kept.join(None, files)
    });
    let (studied, written) = joined.map_err(|why| refuse("", why))?;
    answer(&studied, &written, json)
}

fn answer(studied: &Studied, written: &[PathBuf], json: bool) -> Result<Exit, Failure> {
    match json {
        true => tell_json(studied)?,
        false => tell(studied.text(), written)?,
    }
    Ok(Exit::Done)
}

/// `I/N`, or what Slurm says.
pub fn shard(text: &str) -> Result<Shard, Failure> {
    let bad = |why: String| BadInput(vec![format!("--shard {text}: {why}")]);
    if text != "slurm" {
        return text.parse().map_err(|fault| bad(format!("{fault}")));
    }
    let number = |name: &str| -> Result<u64, Failure> {
        let value = std::env::var(name).map_err(|_| {
            bad(format!(
                "{name} is not set: this is no task of a Slurm array"
            ))
        })?;
        value
            .parse()
            .map_err(|_| bad(format!("{name} is {value:?}, no number")))
    };
    let (task, first) = (
        number("SLURM_ARRAY_TASK_ID")?,
        number("SLURM_ARRAY_TASK_MIN")?,
    );
    let count = number("SLURM_ARRAY_TASK_COUNT")?;
    let index = task.saturating_sub(first) + 1;
    Shard::new(index, count).map_err(|fault| bad(format!("{fault}")))
}
