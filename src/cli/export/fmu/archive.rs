//! The ZIP file: the same bytes for the same content.

use std::io::{Cursor, Write};

use zip::write::{SimpleFileOptions, ZipWriter};
use zip::{CompressionMethod, DateTime};

use crate::cli::exit::Failure;

/// A file in it.
pub struct Entry {
    path: String,
    content: Vec<u8>,
}

impl Entry {
    /// With its path in the archive.
    pub fn new(path: impl Into<String>, content: impl Into<Vec<u8>>) -> Self {
        Entry {
            path: path.into(),
            content: content.into(),
        }
    }
}

/// The archive of these files, in this order.
///
/// # Errors
/// Where it can't be made.
pub fn zip(entries: Vec<Entry>) -> Result<Vec<u8>, Failure> {
    let failed = |why: &dyn std::fmt::Display| Failure::Unwritten(format!("the ZIP file: {why}"));
    let options = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Deflated)
        .last_modified_time(DateTime::default())
        .unix_permissions(0o644);
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for Entry { path, content } in entries {
        archive
            .start_file(path, options)
            .map_err(|why| failed(&why))?;
        archive.write_all(&content).map_err(|why| failed(&why))?;
    }
    let written = archive.finish().map_err(|why| failed(&why))?;
    Ok(written.into_inner())
}
