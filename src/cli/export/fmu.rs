//! `linkdyn export --fmu`: a functional mock-up unit.

use std::path::{Path, PathBuf};

use clap::Args;

use crate::cli::exit::{BadInput, Exit, Failure};
use crate::cli::open::ModelOptions;

/// Options of `--fmu`.
#[derive(Debug, Args)]
#[command(next_help_heading = "Options of --fmu")]
pub struct FmuOptions {
    /// Version of the interface: 2 or 3
    #[arg(long, value_name = "VERSION", default_value_t = 3, value_parser = clap::value_parser!(u8).range(2..=3), requires = "fmu")]
    fmi: u8,
    /// Result column that is an output; may be given more than once
    #[arg(long = "output", value_name = "COLUMN", requires = "fmu")]
    outputs: Vec<String>,
    /// Prebuilt library of the engine, where this command was built without it; once for each platform
    #[arg(long = "library", value_name = "FILE", requires = "fmu")]
    libraries: Vec<PathBuf>,
}

/// Writes the unit.
pub fn export(_model: &ModelOptions, _options: &FmuOptions, file: &Path) -> Result<Exit, Failure> {
    Err(BadInput(vec![format!(
        "{}: this command does not write FMUs yet",
        file.display()
    )]))
}
