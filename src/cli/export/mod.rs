//! `linkdyn export`: the model for other programs, one kind of file at a time.
//!
//! | file  | kind                                                |
//! | ----- | --------------------------------------------------- |
//! | `fmu` | a functional mock-up unit (FMI) for co-simulation   |

mod fmu;

use std::path::PathBuf;

use clap::Args;

use super::exit::{Exit, Failure};
use super::open::ModelOptions;

#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub struct Options {
    #[command(flatten)]
    model: ModelOptions,
    #[command(flatten)]
    kind: ExportKind,
    /// File to write
    #[arg(short, value_name = "FILE")]
    output: PathBuf,
    #[command(flatten)]
    fmu: fmu::FmuOptions,
}

/// What is written: one of these.
#[derive(Debug, Args)]
#[group(required = true, multiple = false)]
struct ExportKind {
    /// A functional mock-up unit (FMI 3.0 or 2.0) for co-simulation, with all that it needs to run
    #[arg(long)]
    fmu: bool,
}

const HELP: &str = "  linkdyn export pendulum --fmu -o pendulum.fmu
  linkdyn export pendulum --fmu --fmi 2 --output rod.angle -o pendulum.fmu";

/// Reads the model, and writes what is requested.
pub fn execute(options: &Options) -> Result<Exit, Failure> {
    // clap has seen to it that there is one.
    let ExportKind { fmu: _ } = options.kind;
    fmu::export(&options.model, &options.fmu, &options.output)
}
