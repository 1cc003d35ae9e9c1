//! What the command is told.

use std::path::PathBuf;

use clap::{Args, Subcommand};

use crate::cli::open::ModelOptions;

#[derive(Debug, Args)]
#[command(after_help = HELP, args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
pub struct Options {
    #[command(subcommand)]
    pub(super) merge: Option<Merge>,
    #[command(flatten)]
    pub(super) model: Option<ModelOptions>,
    /// Vary a parameter over a grid, as in "parameters.r=40 mm:60 mm:21" (from, to, count) or "parameters.r=40 mm, 50 mm"; several
    /// multiply
    #[arg(long, value_name = "PATH=VALUES")]
    pub(super) vary: Vec<String>,
    /// Draw so many samples of all parameters that have a tolerance
    #[arg(long, value_name = "N")]
    pub(super) samples: Option<u64>,
    /// Take scrambled Sobol points instead of random ones
    #[arg(long, requires = "samples", conflicts_with = "latin")]
    pub(super) sobol: bool,
    /// Take a Latin hypercube instead of random points
    #[arg(long, requires = "samples")]
    pub(super) latin: bool,
    /// Take the rows that Sobol indices need, inputs + 2 for each sample
    #[arg(long, requires = "samples")]
    pub(super) indices: bool,
    /// Seed of the samples [default: 1]
    #[arg(long, value_name = "SEED")]
    pub(super) seed: Option<u64>,
    /// A number that comes out of each variant, as in "stroke = max(piston.x) - min(piston.x)", besides those of the model
    #[arg(long = "response", value_name = "NAME = EXPRESSION")]
    pub(super) responses: Vec<String>,
    /// Compute share I of N only, as in 2/7, or what Slurm's array task is to do: slurm
    #[arg(long, value_name = "I/N", requires = "directory")]
    pub(super) shard: Option<String>,
    /// Threads; by default one for each processor
    #[arg(long, value_name = "N")]
    pub(super) threads: Option<usize>,
    /// Print study.json instead of the summary for people
    #[arg(long)]
    pub(super) json: bool,
    /// Keep chunks of rows in this directory (made where missing), go on from those that are there, and write variants.csv,
    /// study.json and report.html
    #[arg(short = 'o', long = "output", value_name = "DIR")]
    pub(super) directory: Option<PathBuf>,
    /// Write no report.html, and remove an older one from DIR
    #[arg(long, requires = "directory")]
    pub(super) no_report: bool,
    /// Write variants.parquet, too
    #[arg(long, requires = "directory")]
    pub(super) parquet: bool,
}

#[derive(Debug, Subcommand)]
pub(super) enum Merge {
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
