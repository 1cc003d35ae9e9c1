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
    /// The system refuses to replace a file that stands.
    #[error("{}: can't be written: {source} (the file is as it was)", .path.display())]
    Replace {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
}

/// Writes a file of the user's own, at once: a reader meets the old file or the new one, whole, also after a crash. Symbolic links
/// are followed; a file that stands there keeps its permissions and, where the system lets us, its owner.
///
/// # Errors
/// When the system refuses; the older file is then still whole.
pub fn replace(path: &Path, content: &[u8]) -> Result<(), WriteError> {
    let there = fs::metadata(path).ok();
    let is_kept = there.as_ref().is_some_and(fs::Metadata::is_file);
    let written = match &there {
        // A device or a pipe takes what it is given, and a directory refuses.
        Some(there) if !there.is_file() => fs::write(path, content),
        there => followed(path).and_then(|path| put(&path, content, there.as_ref())),
    };
    let path = path.to_owned();
    written.map_err(|source| match is_kept {
        true => WriteError::Replace { path, source },
        false => WriteError::Write { path, source },
    })
}

/// Writes beside a file first, and then puts that in its place.
fn put(path: &Path, content: &[u8], there: Option<&fs::Metadata>) -> io::Result<()> {
    let (Some(folder), Some(name)) = (path.parent(), path.file_name()) else {
        return Err(io::ErrorKind::IsADirectory.into());
    };
    if there.is_some() {
        // One that is protected stays so.
        File::options().write(true).open(path)?;
    }
    let temporary = temporary(folder, &name.to_string_lossy());
    let written = File::create(&temporary).and_then(|mut file| {
        file.write_all(content)?;
        if let Some(there) = there {
            own(&file, there);
            file.set_permissions(there.permissions())?;
        }
        file.sync_all()
    });
    let put = written.and_then(|()| fs::rename(&temporary, path));
    if put.is_err() {
        let _ = fs::remove_file(&temporary);
    } else if let Ok(folder) = File::open(folder) {
        // The new name outlasts a crash, too, on systems that write directories when they are told.
        let _ = folder.sync_all();
    }
    put
}

/// Gives a file the owner of another one, where that is allowed.
#[cfg(unix)]
fn own(file: &File, there: &fs::Metadata) {
    use std::os::unix::fs::{MetadataExt, fchown};
    let _ = fchown(file, Some(there.uid()), Some(there.gid()));
}

#[cfg(not(unix))]
fn own(_: &File, _: &fs::Metadata) {}

/// Symbolic links that lead one to the other, at most, as systems have it.
const MOST_LINKS: usize = 40;

/// Where a path leads to through symbolic links, also where nothing stands there yet.
fn followed(path: &Path) -> io::Result<PathBuf> {
    let mut path = path.to_owned();
    for _ in 0..MOST_LINKS {
        let Ok(next) = fs::read_link(&path) else {
            return Ok(match path.parent() {
                Some(folder) if folder.as_os_str().is_empty() => Path::new(".").join(path),
                Some(_) | None => path,
            });
        };
        path.pop();
        path.push(next);
    }
    fs::canonicalize(path)
}

/// A name nobody else uses at the same time.
fn temporary(folder: &Path, name: &str) -> PathBuf {
    folder.join(format!(".{name}.{}.part", std::process::id()))
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

    fn temporary(&self, name: &str) -> PathBuf {
        temporary(&self.path, name)
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

    #[cfg(unix)]
    #[test]
    fn a_file_of_the_user_is_replaced_behind_its_links_with_its_permissions() {
        use std::os::unix::fs::{PermissionsExt, symlink};
        let path = scratch("own");
        fs::create_dir_all(path.join("kept")).expect("made");
        let model = path.join("kept/model.json");
        fs::write(&model, b"old").expect("written");
        fs::set_permissions(&model, fs::Permissions::from_mode(0o640)).expect("set");
        symlink("kept/model.json", path.join("link")).expect("linked");
        symlink("link", path.join("again")).expect("linked");
        replace(&path.join("again"), b"new").expect("replaced");
        assert_eq!(fs::read(&model).expect("there"), b"new");
        let there = fs::metadata(&model).expect("there");
        assert_eq!(there.permissions().mode() & 0o777, 0o640);
        assert!(
            fs::symlink_metadata(path.join("again"))
                .expect("there")
                .is_symlink()
        );
        // A link to what is not there yet is followed, too; one to itself is refused.
        symlink("kept/fresh.json", path.join("ahead")).expect("linked");
        replace(&path.join("ahead"), b"first").expect("written");
        assert_eq!(
            fs::read(path.join("kept/fresh.json")).expect("there"),
            b"first"
        );
        symlink("round", path.join("round")).expect("linked");
        replace(&path.join("round"), b"").expect_err("no end");
        replace(&path.join("kept"), b"").expect_err("a directory");
        replace(Path::new("/dev/null"), b"gone").expect("a device takes it");
        let left = fs::read_dir(path.join("kept"))
            .expect("a directory")
            .count();
        assert_eq!(left, 2, "nothing else is left");
        fs::remove_dir_all(&path).expect("removed");
    }
}
