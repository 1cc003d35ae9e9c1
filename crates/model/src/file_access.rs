//! Which files a model may name: those below its own folder, and below folders that its user allows.
//!
//! A model may come from anywhere. So what it names is looked for nowhere else, links are followed before that is decided, and no
//! message tells what a file holds, or whether there is one elsewhere.

use std::fs::{self, File};
use std::io::{ErrorKind, Read};
use std::path::{Component, Path, PathBuf};

/// Largest file that is read \[bytes\].
const LARGEST: u64 = 16 * 1024 * 1024;

/// What is wrong with a file, and what would mend it.
pub(super) type Refusal = (String, Option<String>);

/// Where a model's text is from, and which files it may name.
#[derive(Debug, Clone, Default)]
pub struct FileAccess {
    /// The model's own file, in whose folder the others are; without one it is the folder that the process runs in.
    pub path: PathBuf,
    /// Folders besides that one.
    pub allowed: Vec<PathBuf>,
}

impl FileAccess {
    /// Of a model in this file, which may name no others than those below its folder.
    pub fn of(path: &Path) -> Self {
        FileAccess {
            path: path.to_owned(),
            allowed: Vec::new(),
        }
    }

    /// The text of a file that the model names.
    pub(super) fn read(&self, name: &str) -> Result<String, Refusal> {
        let path = self.find(name)?;
        let refuse = |error| plainly(format!("the file cannot be read: {error}"));
        // devices and pipes may have no end
        if !fs::metadata(&path).map_err(refuse)?.is_file() {
            return Err(plainly("this is no file"));
        }
        let file = File::open(&path).map_err(refuse)?;
        let mut bytes = Vec::new();
        file.take(LARGEST + 1)
            .read_to_end(&mut bytes)
            .map_err(refuse)?;
        if u64::try_from(bytes.len()).unwrap_or(u64::MAX) > LARGEST {
            let most = LARGEST >> 20;
            return Err(plainly(format!("a table's file has at most {most} MB")));
        }
        let text = String::from_utf8(bytes).map_err(|_| plainly("the file is not UTF-8 text"))?;
        Ok(text.trim_start_matches('\u{feff}').to_owned())
    }

    /// The whole path of a file that may be read.
    fn find(&self, name: &str) -> Result<PathBuf, Refusal> {
        let own = match self.path.parent() {
            Some(folder) if !folder.as_os_str().is_empty() => folder,
            Some(_) | None => Path::new("."),
        };
        let path = own.join(name);
        let parts = Path::new(name).components();
        let is_inside =
            { parts }.all(|part| matches!(part, Component::Normal(_) | Component::CurDir));
        let folders = is_inside.then_some(own).into_iter();
        let folders = folders.chain(self.allowed.iter().map(PathBuf::as_path));
        let folders: Vec<PathBuf> = folders
            .filter_map(|folder| folder.canonicalize().ok())
            .collect();
        let is_below = |path: &Path| folders.iter().any(|folder| path.starts_with(folder));
        match path.canonicalize() {
            Ok(whole) if is_below(&whole) => Ok(whole),
            Err(error) if error.kind() == ErrorKind::NotFound => {
                let folder = path.parent().map(Path::canonicalize);
                if is_inside || matches!(folder, Some(Ok(folder)) if is_below(&folder)) {
                    let looked = format!("looked for at {}", path.display());
                    return Err(("there is no such file".to_owned(), Some(looked)));
                }
                Err(outside())
            }
            Ok(_) | Err(_) => Err(outside()),
        }
    }
}

fn outside() -> Refusal {
    let hint = "put it beside the model, or allow its folder with --allow-files DIR";
    let message = "the file is not below the model's own folder";
    (message.to_owned(), Some(hint.to_owned()))
}

pub(super) fn plainly(message: impl Into<String>) -> Refusal {
    (message.into(), None)
}
