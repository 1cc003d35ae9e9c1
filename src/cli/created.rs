//! Files that are new: one that is there stays, unless it may be overwritten.

use std::fs::OpenOptions;
use std::io::{ErrorKind, Write};
use std::path::Path;

use super::exit::{BadInput, Failure};

/// Writes a new file; `example` is a name that it might have.
///
/// # Errors
/// Where there is such a file and `overwrites` is not set, or where it can't be written.
pub fn create(path: &Path, bytes: &[u8], overwrites: bool, example: &str) -> Result<(), Failure> {
    let shown = path.display();
    let mut how = OpenOptions::new();
    // Without --force a file that is there is never touched, not even one that appears this very moment.
    if overwrites {
        how.write(true).create(true).truncate(true)
    } else {
        how.write(true).create_new(true)
    };
    let written = how.open(path).and_then(|mut file| file.write_all(bytes));
    written.map_err(|error| {
        let said = match error.kind() {
            _ if path.is_dir() => {
                format!(
                    "{shown}: a directory (name a file, such as {})",
                    path.join(example).display()
                )
            }
            ErrorKind::AlreadyExists => {
                format!("{shown}: there is such a file already (--force overwrites it)")
            }
            ErrorKind::NotFound if !folder_of(path).is_dir() => {
                format!("{shown}: its folder does not exist (make it first)")
            }
            _ => return Failure::Unwritten(format!("{shown}: can't be written: {error}")),
        };
        BadInput(vec![said])
    })
}

/// The folder that a file is in.
fn folder_of(path: &Path) -> &Path {
    path.parent()
        .filter(|folder| !folder.as_os_str().is_empty())
        .unwrap_or(Path::new("."))
}

/// The path as one word for a shell.
pub fn quoted(path: &str) -> String {
    let plain = |c: char| c.is_alphanumeric() || "/\\._-:".contains(c);
    if path.chars().all(plain) {
        path.to_string()
    } else {
        format!("'{}'", path.replace('\'', r"'\''"))
    }
}

#[cfg(test)]
mod tests {
    use super::quoted;

    #[test]
    fn paths_are_quoted_where_they_must_be() {
        assert_eq!(quoted("a/four-bar.json"), "a/four-bar.json");
        assert_eq!(quoted("my bar's.json"), r"'my bar'\''s.json'");
    }
}
