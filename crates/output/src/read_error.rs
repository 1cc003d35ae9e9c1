//! Why a table of results can't be read.

use std::path::PathBuf;

use thiserror::Error;

/// Largest file that is read \[bytes\].
pub(super) const LARGEST: u64 = 1 << 30;

/// Why a table can't be read.
#[derive(Debug, Error)]
pub enum ReadError {
    /// There is nothing at this path.
    #[error("{}: no such file or directory", .0.display())]
    Missing(PathBuf),
    /// The directory has no such file.
    #[error("{}: a directory without {name} (linkdyn run … -o leaves one)", .path.display())]
    Without {
        /// The directory.
        path: PathBuf,
        /// The file that is wanted in it.
        name: &'static str,
    },
    /// The system refuses the file.
    #[error("{}: can't be read: {source}", .path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// The file is larger than is read.
    #[error("{}: larger than {LARGEST} bytes", .0.display())]
    TooLarge(PathBuf),
    /// The file has nothing in it.
    #[error("{}: the file is empty", .0.display())]
    Empty(PathBuf),
    /// The first line is no header of results.
    #[error("{}: not a table of results: its first line names no column as name[unit]", .0.display())]
    NoHeader(PathBuf),
    /// The cells are separated by another character.
    #[error("{}: its columns are separated by {separator:?}: commas are wanted, and points in numbers", .path.display())]
    Separator {
        /// The file.
        path: PathBuf,
        /// The character between its cells.
        separator: char,
    },
    /// The file is no text.
    #[error("{}: not a table of results: it is not text in UTF-8", .path.display())]
    NotText {
        /// The file.
        path: PathBuf,
        /// Where it ceases to be text.
        source: Box<dyn std::error::Error + Send + Sync>,
    },
    /// A line has more or fewer cells than the header.
    #[error("{}: line {line} has {cells} cells, the header has {columns}", .path.display())]
    Ragged {
        /// The file.
        path: PathBuf,
        /// The line, from 1.
        line: u64,
        /// Its cells.
        cells: usize,
        /// Those of the header.
        columns: usize,
    },
    /// A cell is no number.
    #[error("{}: line {line}: {cell:?} in column {column:?} is not a number", .path.display())]
    NotANumber {
        /// The file.
        path: PathBuf,
        /// The line, from 1.
        line: u64,
        /// The column, with its unit.
        column: String,
        /// The beginning of the cell.
        cell: String,
    },
}
