//! The files of an answer: its document, and its page where it has one.

use std::path::PathBuf;

use super::exit::Failure;
use linkdyn_output::Directory;
use linkdyn_picture::Fault;

/// Writes the document of an answer, and its page where it has one; the paths. An older page goes where there is none now.
///
/// # Errors
/// Where a file can't be written, or the page can't be drawn.
pub fn write(
    directory: Option<&Directory>,
    [document, page]: [&str; 2],
    json: &str,
    html: Result<Option<String>, Fault>,
) -> Result<Vec<PathBuf>, Failure> {
    let Some(directory) = directory else {
        return Ok(Vec::new());
    };
    let mut written = vec![directory.write(document, json.as_bytes())?];
    match html.map_err(|fault| Failure::Stopped(format!("{page} is not written: {fault}")))? {
        Some(html) => written.push(directory.write(page, html.as_bytes())?),
        None => directory.remove(page)?,
    }
    Ok(written)
}
