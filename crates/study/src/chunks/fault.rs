//! Why a chunk can't be read, written or joined.

use std::io;
use std::ops::Range;
use std::path::PathBuf;

use thiserror::Error;

/// Missing ranges that a complaint names, at most.
const NAMED: usize = 8;

/// Why a chunk can't be read, written or joined.
#[derive(Debug, Error)]
pub enum ChunkFault {
    /// The system refuses to read.
    #[error("{}: can't be read: {source}", .path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// The system refuses to write.
    #[error("{}: can't be written: {source}", .path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// Something else, or another format.
    #[error("{}: not a chunk of a study, or one of another format (move it away)", .0.display())]
    Foreign(PathBuf),
    /// The file ends early, or goes on after its end.
    #[error("{}: {found} bytes, where {expected} belong (delete it, so that it is computed again)", .path.display())]
    Length {
        /// The file.
        path: PathBuf,
        /// Its length.
        found: u64,
        /// What its header says.
        expected: u64,
    },
    /// The bytes are not those that were written.
    #[error("{}: damaged, its checksum does not fit (delete it, so that it is computed again)", .0.display())]
    Damaged(PathBuf),
    /// Another study.
    #[error("{}: a chunk of another study ({found}, this one is {expected}): choose another directory, or delete it", .path.display())]
    Study {
        /// The file.
        path: PathBuf,
        /// Its study.
        found: String,
        /// This study.
        expected: String,
    },
    /// Another version.
    #[error("{}: computed by {found}, this is {expected}: results of two versions are not joined (choose another directory, or delete it)", .path.display())]
    Engine {
        /// The file.
        path: PathBuf,
        /// What computed it.
        found: String,
        /// What runs.
        expected: String,
    },
    /// Other variants than belong there.
    #[error("{}: variants {} to {}, where {} to {} belong (chunks of another size: choose another directory, or delete it)",
        .path.display(), .found.start, .found.end.saturating_sub(1), .expected.start, .expected.end.saturating_sub(1))]
    Rows {
        /// The file.
        path: PathBuf,
        /// Its variants.
        found: Range<u64>,
        /// Those that belong there.
        expected: Range<u64>,
    },
    /// Other columns than the study has.
    #[error("{}: columns {found}, where {expected} belong (choose another directory, or delete it)", .path.display())]
    Columns {
        /// The file.
        path: PathBuf,
        /// Its columns.
        found: String,
        /// Those of the study.
        expected: String,
    },
    /// Not all chunks are there.
    #[error("{chunks} of {of} chunks are missing: variants {} (run the study, or the shards that have them)", named(.ranges))]
    Incomplete {
        /// How many are missing.
        chunks: u64,
        /// How many there are.
        of: u64,
        /// The variants that are missing.
        ranges: Vec<Range<u64>>,
    },
    /// What takes the joined rows refuses.
    #[error("joined rows can't be written: {0}")]
    Join(#[from] io::Error),
}

/// `0 to 9, 40 to 49 and 3 more ranges`.
fn named(ranges: &[Range<u64>]) -> String {
    let texts = ranges.iter().take(NAMED);
    let texts = texts.map(|range| format!("{} to {}", range.start, range.end.saturating_sub(1)));
    let text = texts.collect::<Vec<_>>().join(", ");
    match ranges.len().saturating_sub(NAMED) {
        0 => text,
        1 => format!("{text} and 1 more range"),
        more => format!("{text} and {more} more ranges"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_ranges_are_not_all_named() {
        let ranges: Vec<Range<u64>> = (0..10).map(|k| 20 * k..20 * k + 10).collect();
        let expected =
            "0 to 9, 20 to 29, 40 to 49, 60 to 69, 80 to 89, 100 to 109, 120 to 129, 140 to 149";
        assert_eq!(named(&ranges[..8]), expected);
        assert_eq!(named(&ranges[..9]), format!("{expected} and 1 more range"));
        assert_eq!(named(&ranges), format!("{expected} and 2 more ranges"));
    }
}
