//! A model as it was read.

use std::sync::Arc;

use linkdyn_model::error::Complaints;
use linkdyn_model::{Checked, FileAccess, Loaded};
use linkdyn_output::{Stage, Stopwatch};
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use crate::unanswered::Unanswered;

/// The text of a model file, and where it is.
#[derive(Debug)]
pub struct Text {
    /// How the user calls the model: path or bundled name.
    pub label: String,
    /// The file's name without its ending, or that of a bundled model.
    pub stem: String,
    /// As it was read.
    pub bytes: Vec<u8>,
    /// Where the file is, and which files it may name.
    pub access: FileAccess,
    /// Of the bytes, hexadecimal.
    pub sha256: String,
}

/// A model that was read and checked, with values that were set. It can be read again with other values.
#[derive(Debug, Clone)]
pub struct ModelFile {
    /// What was read.
    pub text: Arc<Text>,
    /// What the user set, `PATH=VALUE`, in this order.
    pub sets: Vec<String>,
    /// What questions put into the model after that.
    puts: Vec<String>,
    /// The model and its parameters.
    pub loaded: Arc<Loaded>,
    /// Time that reading it took.
    pub time: Stage,
}

/// What a JSON answer says of its model.
#[derive(Debug, Clone, Serialize)]
pub struct Subject<'a> {
    name: &'a str,
    sha256: &'a str,
}

/// The model that is varied.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Varying {
    /// Its name.
    pub name: String,
    /// SHA-256 of its file, hexadecimal.
    pub sha256: String,
    /// What was set in it.
    pub set: Vec<String>,
}

impl Text {
    /// The text of a model file that is read and has this name.
    pub fn new(label: String, stem: String, bytes: Vec<u8>, access: FileAccess) -> Arc<Self> {
        Arc::new(Text {
            label,
            stem,
            sha256: format!("{:x}", Sha256::digest(&bytes)),
            bytes,
            access,
        })
    }
}

impl ModelFile {
    /// Reads a text with values set, each `PATH=VALUE`.
    ///
    /// # Errors
    /// All faults of the model.
    pub fn read(text: Arc<Text>, sets: Vec<String>) -> Result<Self, Complaints> {
        ModelFile::read_with(text, sets, Vec::new())
    }

    /// The same, with what a question puts into the model.
    pub(crate) fn read_with(
        text: Arc<Text>,
        sets: Vec<String>,
        puts: Vec<String>,
    ) -> Result<Self, Complaints> {
        let watch = Stopwatch::start();
        let all = [sets.as_slice(), &puts].concat();
        let loaded = linkdyn_model::load_with_access(&text.bytes, &all, &text.access)?;
        Ok(ModelFile {
            text,
            sets,
            puts,
            loaded: Arc::new(loaded),
            time: watch.read(),
        })
    }

    /// The same text with more values set by the user.
    ///
    /// # Errors
    /// All faults of the model.
    pub fn set(&self, more: Vec<String>) -> Result<Self, Complaints> {
        let (sets, puts) = ([self.sets.clone(), more].concat(), self.puts.clone());
        ModelFile::read_with(Arc::clone(&self.text), sets, puts)
    }

    /// The same text with more that a question puts into it.
    ///
    /// # Errors
    /// All faults of the model.
    pub fn with(&self, more: &[String]) -> Result<Self, Complaints> {
        let puts = [self.puts.as_slice(), more].concat();
        ModelFile::read_with(Arc::clone(&self.text), self.sets.clone(), puts)
    }

    /// The text of a file of the model as it is, with all that was set in it.
    pub fn print(&self) -> String {
        let document = self.loaded.source.print(&self.loaded.model);
        format!("{document:#}\n")
    }

    /// The model, all numbers in SI units.
    pub fn model(&self) -> &Checked {
        &self.loaded.model
    }

    /// The model's own name, or the file's.
    pub fn name(&self) -> &str {
        let own = self.loaded.model.name.as_deref();
        own.filter(|name| !name.is_empty())
            .unwrap_or(&self.text.stem)
    }

    /// How the user calls the model.
    pub fn label(&self) -> &str {
        &self.text.label
    }

    /// What a JSON answer says of the model.
    pub fn subject(&self) -> Subject<'_> {
        Subject {
            name: self.name(),
            sha256: &self.text.sha256,
        }
    }

    /// What the answer of a question that varies the model says of it.
    pub fn varying(&self) -> Varying {
        Varying {
            name: self.name().to_owned(),
            sha256: self.text.sha256.clone(),
            set: self.sets.clone(),
        }
    }

    /// Complaints that came up after the model was read, with their places.
    pub fn refused(&self, complaints: Complaints) -> Unanswered {
        Unanswered::Model(self.loaded.source.place_all(complaints))
    }
}
