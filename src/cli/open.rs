//! MODEL: a path or a bundled model's name.

use std::path::{Path, PathBuf};

use clap::Args;
use sha2::{Digest, Sha256};

use super::exit::{BadInput, Failure};
use super::near::did_you_mean;
use crate::files::Origin;
use linkdyn_model::bundled::{self, NotBundled};
use linkdyn_model::error::{Complaint, Complaints};
use linkdyn_model::{self, Beside, Loaded};
use linkdyn_output::{Stage, Stopwatch};

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

/// A model that could be read.
#[derive(Debug)]
pub struct Opened {
    pub loaded: Loaded,
    /// Path or bundled name, as given.
    pub label: String,
    /// The model's own name, or the file's.
    pub name: String,
    /// Of the file's bytes, hexadecimal.
    pub sha256: String,
    pub time: Stage,
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

    /// Reads the model.
    ///
    /// # Errors
    /// When there is no such model, or it has faults.
    pub fn open(&self) -> Result<Opened, Failure> {
        let label = self.model.display().to_string();
        self.open_with(&[])?
            .map_err(|complaints| bad_input(&label, complaints))
    }

    /// The text of the model.
    ///
    /// # Errors
    /// When there is no such model.
    pub fn bytes(&self) -> Result<Vec<u8>, Failure> {
        read(&self.model)
    }

    /// How the command calls the model.
    pub fn label(&self) -> String {
        self.model.display().to_string()
    }

    /// Reads the model with more values set, after those of the command.
    ///
    /// # Errors
    /// When there is no such model; inside, its faults.
    pub fn open_with(&self, more: &[String]) -> Result<Result<Opened, Complaints>, Failure> {
        let watch = Stopwatch::start();
        let label = self.model.display().to_string();
        let bytes = read(&self.model)?;
        let sets = [self.sets.as_slice(), more].concat();
        let beside = Beside {
            path: self.model.clone(),
            allowed: self.allowed.clone(),
        };
        let loaded = match linkdyn_model::load_beside(&bytes, &sets, &beside) {
            Ok(loaded) => loaded,
            Err(complaints) => return Ok(Err(complaints)),
        };
        let stem = self
            .model
            .file_stem()
            .map_or_else(|| label.clone(), |stem| stem.to_string_lossy().into_owned());
        let name = loaded
            .model
            .name
            .clone()
            .filter(|name| !name.is_empty())
            .unwrap_or(stem);
        let sha256 = format!("{:x}", Sha256::digest(&bytes));
        Ok(Ok(Opened {
            loaded,
            label,
            name,
            sha256,
            time: watch.read(),
        }))
    }
}

/// A model by path or bundled name, as it is.
///
/// # Errors
/// When there is no such model, or it has faults.
pub fn model(path: &Path) -> Result<Loaded, Failure> {
    linkdyn_model::load_beside(&read(path)?, &[], &Beside::of(path))
        .map_err(|complaints| bad_input(&path.display().to_string(), complaints))
}

impl Opened {
    /// What the files of a run tell of the model.
    pub fn origin(&self) -> Origin<'_> {
        Origin {
            model: &self.loaded.model,
            name: &self.name,
            sha256: &self.sha256,
            load: self.time,
        }
    }

    /// Complaints about the model that came up after it was read.
    pub fn bad_input(&self, complaints: Complaints) -> Failure {
        bad_input(&self.label, self.loaded.source.place_all(complaints))
    }
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
