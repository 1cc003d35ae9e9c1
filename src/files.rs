//! The files of a run: `results.csv`, `peaks.csv`, `summary.json` and `report.html`.

use std::path::{Path, PathBuf};

use crate::profiles;
use linkdyn_ask::run::Origin;
use linkdyn_engine::analysis::Outcome;
use linkdyn_output::{Directory, Stage, Stopwatch, WriteError, csv};

const RESULTS: &str = "results.csv";
/// Rows between those of the results, where columns have their peaks.
pub(crate) const PEAKS: &str = "peaks.csv";
const SUMMARY: &str = "summary.json";
const REPORT: &str = "report.html";

/// Files that were written, and how long that took.
#[derive(Debug, Default)]
pub(crate) struct Written {
    pub paths: Vec<PathBuf>,
    /// The text of `summary.json`.
    pub summary: String,
    pub time: Stage,
}

/// A directory in which nothing stands in the way of the files.
pub(crate) fn open_directory(path: &Path) -> Result<Directory, WriteError> {
    let directory = Directory::open(path)?;
    for name in [RESULTS, PEAKS, SUMMARY, REPORT] {
        directory.expect_free(name)?;
    }
    Ok(directory)
}

/// Whether the page `report.html` is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Page {
    Wanted,
    /// Not written, and one of an older run removed: it would show other results.
    Unwanted,
}

/// Writes all files of a run; the summary comes last, since it tells how long the others took.
pub(crate) fn write(
    directory: &Directory,
    origin: Origin,
    outcome: &Outcome,
    page: Page,
) -> Result<Written, WriteError> {
    let watch = Stopwatch::start();
    let results = directory.write_with(RESULTS, |file| csv::write(&outcome.trajectory, file))?;
    let peaks = outcome.wanted_peaks();
    let peaks = if peaks.is_empty() {
        // Those of an older run are not those of these results.
        directory.remove(PEAKS)?;
        None
    } else {
        Some(directory.write_with(PEAKS, |file| csv::write(&peaks, file))?)
    };
    let report = match page {
        Page::Wanted => {
            Some(directory.write_with(REPORT, |file| origin.write_page(outcome, file))?)
        }
        Page::Unwanted => {
            directory.remove(REPORT)?;
            None
        }
    };
    let text = origin.summary(outcome, watch.read());
    let summary = directory.write(SUMMARY, text.as_bytes())?;
    let paths = [Some(results), peaks, Some(summary), report].into_iter();
    let cams = profiles::write(directory, origin.model)?;
    Ok(Written {
        summary: text,
        paths: paths.flatten().chain(cams).collect(),
        time: watch.read(),
    })
}
