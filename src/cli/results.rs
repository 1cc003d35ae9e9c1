//! RESULTS: a `results.csv`, or a directory that `run -o` has left; and columns by name or pattern.

use std::path::{Path, PathBuf};

use serde_json::Value;

use super::exit::{BadInput, Failure};
use crate::files::PEAKS;
use linkdyn_model::bundled;
use linkdyn_output::matches;
use linkdyn_output::read::{ReadColumn, ReadError, read_file};
use linkdyn_output::{Directory, Table, WriteError};

/// The rows of a study.
const VARIANTS: &str = "variants.csv";
/// Names that are suggested at most.
const MOST_NAMES: usize = 3;
/// Longer names are not compared \[bytes\].
const LONGEST: usize = 200;
/// Names that are listed where none is near.
const MOST_LISTED: usize = 8;

/// A run's results.
#[derive(Debug)]
pub struct Results {
    pub table: Table,
    /// As given.
    pub path: PathBuf,
    /// `summary.json` beside the table, where there is a sound one.
    pub summary: Option<Value>,
}

impl From<ReadError> for Failure {
    fn from(error: ReadError) -> Self {
        BadInput(vec![error.to_string()])
    }
}

impl Results {
    /// Reads table and summary.
    ///
    /// # Errors
    /// When there is no table, or one without rows.
    pub fn open(path: &Path) -> Result<Self, Failure> {
        let of_study = path.join(VARIANTS);
        let is_study = path.is_dir() && !path.join("results.csv").exists() && of_study.exists();
        let file = if is_study { &of_study } else { path };
        let table = Table::read(file).map_err(|error| match (&error, is_model(path)) {
            (ReadError::Missing(_) | ReadError::NoHeader(_), true) => {
                let path = path.display();
                BadInput(vec![format!(
                    "{path}: a model, not its results (run it first: linkdyn run {path} -o out; then name out)"
                )])
            }
            _ => error.into(),
        })?;
        if table.is_empty() {
            let path = table.path.display();
            return Err(BadInput(vec![format!(
                "{path}: there is a header and no row: the run gave no result"
            )]));
        }
        let summary = read_file(&table.path.with_file_name("summary.json"), "");
        let summary = summary
            .ok()
            .and_then(|(_, bytes)| serde_json::from_slice(&bytes).ok());
        Ok(Results {
            table,
            path: path.to_owned(),
            summary,
        })
    }

    /// Puts the rows of `peaks.csv` beside `results.csv` among its own, where there is such a file and it has the same columns:
    /// curves pass through peaks between the outputs then.
    pub fn take_peaks(&mut self) {
        if self
            .table
            .path
            .file_name()
            .is_some_and(|name| name == "results.csv")
            && let Ok(peaks) = Table::read(&self.table.path.with_file_name(PEAKS))
        {
            self.table.insert(&peaks);
        }
    }

    /// The model's name, from the summary.
    pub fn model_name(&self) -> Option<&str> {
        self.summary.as_ref()?.get("model")?.get("name")?.as_str()
    }

    /// The directory's name, or the file's where it is not called `results.csv`.
    pub fn file_name(&self) -> String {
        let file = &self.table.path;
        let named = match file.file_name() {
            Some(name) if name == "results.csv" || name == VARIANTS => {
                file.parent().and_then(Path::file_name).or(file.file_name())
            }
            name => name,
        };
        let stem = |name: &std::ffi::OsStr| {
            Path::new(name)
                .file_stem()
                .unwrap_or(name)
                .to_string_lossy()
                .into_owned()
        };
        match named {
            Some(name) if file.parent().and_then(Path::file_name) == Some(name) => {
                name.to_string_lossy().into_owned()
            }
            Some(name) => stem(name),
            None => self.path.display().to_string(),
        }
    }

    /// Columns that a name (with or without its `[unit]`) or a pattern (`*`, `?`) stands for.
    pub fn columns(&self, name: &str) -> Vec<&ReadColumn> {
        if let Some(column) = self.table.column(name) {
            return vec![column];
        }
        if !name.contains(['*', '?']) {
            return Vec::new();
        }
        self.table
            .columns
            .iter()
            .filter(|column| matches(name, column.name.trim()))
            .collect()
    }

    /// What to say about a name or pattern that stands for nothing.
    pub fn unknown(&self, option: &str, name: &str) -> String {
        let columns = &self.table.columns;
        let similarity = |column: &ReadColumn| {
            // Nobody's slip of the pen, and slow to compare.
            if name.len().max(column.name.len()) > LONGEST {
                return 0.0;
            }
            let plain = name.to_lowercase();
            let known = column.name.to_lowercase();
            let part = if plain.len() > 2 && known.contains(&plain) {
                0.3
            } else {
                0.0
            };
            strsim::normalized_damerau_levenshtein(&plain, &known)
                .max(strsim::jaro_winkler(&plain, &known) - 0.2)
                + part
        };
        let mut near: Vec<(f64, &str)> = columns
            .iter()
            .map(|column| (similarity(column), column.name.as_str()))
            .collect();
        near.sort_by(|a, b| b.0.total_cmp(&a.0));
        let near: Vec<String> = near
            .iter()
            .take_while(|(similarity, _)| *similarity >= 0.6)
            .take(MOST_NAMES)
            .map(|(_, name)| format!("{name:?}"))
            .collect();
        let hint = match near.split_last() {
            Some((last, [])) => format!("did you mean {last}?"),
            Some((last, before)) => format!("did you mean {} or {last}?", before.join(", ")),
            None => {
                let listed: Vec<&str> = columns
                    .iter()
                    .take(MOST_LISTED)
                    .map(|column| column.name.as_str())
                    .collect();
                let more = columns.len().saturating_sub(MOST_LISTED);
                let rest = if more > 0 {
                    format!(" and {more} more")
                } else {
                    String::new()
                };
                format!("there are: {}{rest}", listed.join(", "))
            }
        };
        format!(
            "{}: {option} {name}: no column of that name ({hint})",
            self.table.path.display()
        )
    }
}

/// Whether a name is that of a model: a bundled one, or a file of JSON.
fn is_model(path: &Path) -> bool {
    let is_bundled = || {
        path.to_str()
            .is_some_and(|name| bundled::text(name).is_ok())
    };
    if path.exists() {
        extension(path) == "json"
    } else {
        is_bundled()
    }
}

/// Writes the one file requested; its directory is made where missing.
pub fn write_file(path: &Path, content: &[u8]) -> Result<PathBuf, WriteError> {
    let folder = path
        .parent()
        .filter(|folder| !folder.as_os_str().is_empty())
        .unwrap_or(Path::new("."));
    match path.file_name().and_then(|name| name.to_str()) {
        Some(name) => Directory::open(folder)?.write(name, content),
        None => Err(WriteError::InTheWay(path.to_owned())),
    }
}

/// The extension of a file to be written, lower case.
pub fn extension(path: &Path) -> String {
    path.extension()
        .map(|extension| extension.to_string_lossy().to_lowercase())
        .unwrap_or_default()
}
