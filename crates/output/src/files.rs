//! Files of a run: written under another name first, then renamed, so that a reader never meets half a file.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use thiserror::Error;

/// Why results could not be written.
#[derive(Debug, Error)]
pub enum WriteError {
    /// A file stands where the directory would be.
    #[error("{}: not a directory, so results can't be written into it (choose another with -o)", .0.display())]
    NotADirectory(PathBuf),
    /// The system refuses the directory.
    #[error("{}: the directory can't be made: {source} (choose another with -o)", .path.display())]
    MakeDirectory {
        /// The directory.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// A directory stands where a file would be.
    #[error("{}: a directory stands where a result file would go (move it away, or choose another with -o)", .0.display())]
    InTheWay(PathBuf),
    /// The system refuses the file.
    #[error("{}: can't be written: {source}", .path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
}

/// A directory that takes results; made where missing.
#[derive(Debug, Clone)]
pub struct Directory {
    path: PathBuf,
}

impl Directory {
    /// Makes the directory and tries it, so that a run does not compute for minutes what it then can't write.
    ///
    /// # Errors
    /// When it can't be made, is a file, or takes no files.
    pub fn open(path: &Path) -> Result<Self, WriteError> {
        if path.exists() && !path.is_dir() {
            return Err(WriteError::NotADirectory(path.to_owned()));
        }
        fs::create_dir_all(path).map_err(|source| WriteError::MakeDirectory {
            path: path.to_owned(),
            source,
        })?;
        let directory = Directory {
            path: path.to_owned(),
        };
        let probe = directory.temporary("probe");
        fs::write(&probe, b"").map_err(|source| WriteError::Write {
            path: path.to_owned(),
            source,
        })?;
        // A probe that can't be removed is an empty hidden file: no reason to refuse.
        let _ = fs::remove_file(&probe);
        Ok(directory)
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Refuses when a directory stands where the file `name` would go.
    ///
    /// # Errors
    /// [`WriteError::InTheWay`].
    pub fn expect_free(&self, name: &str) -> Result<(), WriteError> {
        let path = self.path.join(name);
        if path.is_dir() {
            Err(WriteError::InTheWay(path))
        } else {
            Ok(())
        }
    }

    /// Writes a file, replacing one of that name; returns its path.
    ///
    /// # Errors
    /// When the system refuses; an older file of that name is then still whole.
    pub fn write(&self, name: &str, content: &[u8]) -> Result<PathBuf, WriteError> {
        self.write_with(name, |file| file.write_all(content))
    }

    /// The same for content that is written piece by piece.
    ///
    /// # Errors
    /// As [`Directory::write`].
    pub fn write_with(
        &self,
        name: &str,
        content: impl FnOnce(&mut File) -> io::Result<()>,
    ) -> Result<PathBuf, WriteError> {
        self.expect_free(name)?;
        let path = self.path.join(name);
        let temporary = self.temporary(name);
        let written = File::create(&temporary).and_then(|mut file| content(&mut file));
        written
            .and_then(|()| fs::rename(&temporary, &path))
            .map_err(|source| {
                let _ = fs::remove_file(&temporary);
                WriteError::Write {
                    path: path.clone(),
                    source,
                }
            })?;
        Ok(path)
    }

    /// Removes a file of that name, where there is one.
    ///
    /// # Errors
    /// When the system refuses.
    pub fn remove(&self, name: &str) -> Result<(), WriteError> {
        let path = self.path.join(name);
        match fs::remove_file(&path) {
            Err(source) if source.kind() != io::ErrorKind::NotFound => {
                Err(WriteError::Write { path, source })
            }
            Ok(()) | Err(_) => Ok(()),
        }
    }

    /// A name nobody else uses at the same time.
    fn temporary(&self, name: &str) -> PathBuf {
        self.path
            .join(format!(".{name}.{}.part", std::process::id()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scratch(name: &str) -> PathBuf {
        let path =
            std::env::temp_dir().join(format!("linkdyn-files-{}-{name}", std::process::id()));
        let _ = fs::remove_dir_all(&path);
        path
    }

    #[test]
    fn files_replace_older_ones_and_leave_nothing_else() {
        let path = scratch("replace");
        let directory = Directory::open(&path.join("deep/er")).expect("made");
        directory.write("a.csv", b"one").expect("written");
        directory.write("a.csv", b"two").expect("written again");
        directory.write("b.csv", b"").expect("written");
        directory.remove("b.csv").expect("removed");
        directory.remove("b.csv").expect("nothing to remove");
        assert_eq!(fs::read(path.join("deep/er/a.csv")).expect("there"), b"two");
        assert_eq!(
            fs::read_dir(directory.path()).expect("a directory").count(),
            1
        );
        fs::remove_dir_all(&path).expect("removed");
    }

    #[test]
    fn a_file_or_directory_in_the_way_is_named() {
        let path = scratch("way");
        fs::create_dir_all(path.join("results.csv")).expect("made");
        fs::write(path.join("file"), b"").expect("written");
        let said = Directory::open(&path.join("file"))
            .expect_err("a file")
            .to_string();
        assert!(said.contains("not a directory"), "{said}");
        let said = Directory::open(&path.join("file/below"))
            .expect_err("below a file")
            .to_string();
        assert!(said.contains("can't be made"), "{said}");
        let directory = Directory::open(&path).expect("fine");
        let said = directory
            .write("results.csv", b"")
            .expect_err("a directory")
            .to_string();
        assert!(said.contains("stands where a result file"), "{said}");
        fs::remove_dir_all(&path).expect("removed");
    }
}
