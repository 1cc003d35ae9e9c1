//! MODEL: a path or a bundled model's name.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::Args;

use super::exit::{BadInput, Failure};
use crate::error::Error;
use linkdyn_ask::near::did_you_mean;
use linkdyn_ask::{ModelFile, Text};
use linkdyn_model::bundled::{self, NotBundled};
use linkdyn_model::error::{Complaint, Complaints};
use linkdyn_model::{FileAccess, Loaded};

/// The model and what is changed in it.
#[derive(Debug, Args)]
pub struct ModelOptions {
    /// Path of a model file, or name of a bundled model
    #[arg(value_name = "MODEL")]
    model: PathBuf,
    /// Override a value of the model, as in parameters.crank="120 mm"; may be given more than once
    #[arg(long = "set", value_name = "PATH=VALUE")]
    sets: Vec<String>,
    /// Let the model name files below this folder, besides those below its own; may be given more than once
    #[arg(long = "allow-files", value_name = "DIR")]
    allowed: Vec<PathBuf>,
}

impl ModelOptions {
    /// The path or name, as given.
    pub fn path(&self) -> &Path {
        &self.model
    }

    /// What is set, as given.
    pub fn sets(&self) -> &[String] {
        &self.sets
    }

    /// How the command calls the model.
    pub fn label(&self) -> String {
        self.model.display().to_string()
    }

    /// The text of the model.
    ///
    /// # Errors
    /// When there is no such model.
    pub fn text(&self) -> Result<Arc<Text>, Failure> {
        let bytes = read(&self.model)?;
        let label = self.label();
        let stem = self.model.file_stem();
        let stem = stem.map_or_else(|| label.clone(), |stem| stem.to_string_lossy().into_owned());
        let access = FileAccess {
            path: self.model.clone(),
            allowed: self.allowed.clone(),
        };
        Ok(Text::new(label, stem, bytes, access))
    }

    /// Reads the model.
    ///
    /// # Errors
    /// When there is no such model, or it has faults.
    pub fn open(&self) -> Result<ModelFile, Failure> {
        let file = ModelFile::read(self.text()?, self.sets.clone());
        file.map_err(|complaints| bad_input(&self.label(), complaints))
    }

    /// Whose fault it is that something could not be done, in lines.
    pub fn refuse(&self, why: impl Into<Error>) -> Failure {
        refuse(&self.label(), why.into())
    }
}

/// Whose fault it is that something could not be done with a model, in lines.
pub fn refuse(label: &str, why: Error) -> Failure {
    match why {
        Error::Model(complaints) => bad_input(label, complaints),
        Error::Question(lines) => BadInput(lines),
        Error::Failed(line) => Failure::Stopped(line),
        Error::Write(error) => error.into(),
        Error::Rows(_) if why.is_unwritten() => Failure::Unwritten(why.to_string()),
        other => BadInput(vec![other.to_string()]),
    }
}

/// A model by path or bundled name, as it is.
///
/// # Errors
/// When there is no such model, or it has faults.
pub fn model(path: &Path) -> Result<Loaded, Failure> {
    linkdyn_model::load_with_access(&read(path)?, &[], &FileAccess::of(path))
        .map_err(|complaints| bad_input(&path.display().to_string(), complaints))
}

/// Most complaints about one model; the rest is only counted.
const MOST_COMPLAINTS: usize = 100;

/// A line per complaint, each with the model's name.
pub fn bad_input(label: &str, complaints: Complaints) -> Failure {
    let line = |complaint: &Complaint| format!("{label}: {complaint}");
    // The loader's own list ends with such a count.
    let most = if complaints.len() > MOST_COMPLAINTS + 1 {
        MOST_COMPLAINTS
    } else {
        complaints.len()
    };
    let mut lines: Vec<String> = complaints[..most].iter().map(line).collect();
    if complaints.len() > most {
        lines.push(format!(
            "{label}: and {} more faults",
            complaints.len() - most
        ));
    }
    BadInput(lines)
}

/// The bytes of a model: of a file where there is one, else of a bundled model.
fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    let bundled = path
        .to_str()
        .map_or(Err(NotBundled::Unknown), bundled::text);
    // A directory may well have the name of a bundled model: the one its results are in.
    let no_file = !path.exists() || path.is_dir();
    match (bundled, no_file) {
        (Ok(text), true) => return Ok(text.into_owned().into_bytes()),
        (Err(why @ (NotBundled::OneSize(_) | NotBundled::BadSize)), true) => {
            return Err(BadInput(vec![format!("{}: {why}", path.display())]));
        }
        (Err(_) | Ok(_), _) => {}
    }
    linkdyn_model::read_file(path).map_err(|error| {
        let label = path.display();
        BadInput(vec![match error.kind() {
            std::io::ErrorKind::NotFound => {
                let hint = did_you_mean(
                    &label.to_string(),
                    bundled::names(),
                    "`linkdyn models` lists them",
                );
                format!("{label}: no such file, and no bundled model of that name ({hint})")
            }
            _ if path.is_dir() => format!("{label}: a directory, not a model file"),
            _ => format!("{label}: can't be read: {error}"),
        }])
    })
}
