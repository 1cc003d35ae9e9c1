//! The files of a run: `results.csv`, `peaks.csv`, `summary.json` and `report.html`.

use std::path::{Path, PathBuf};

use crate::profiles;
use linkdyn_engine::analysis::responses::to_json;
use linkdyn_engine::analysis::{Outcome, derived, derived::derived};
use linkdyn_model::Checked;
use linkdyn_output::{Directory, Stage, Stopwatch, Summary, TIME, Trajectory, WriteError, csv};
use linkdyn_picture::{Report, Shape};

const RESULTS: &str = "results.csv";
/// Rows between those of the results, where columns have their peaks.
pub(crate) const PEAKS: &str = "peaks.csv";
const SUMMARY: &str = "summary.json";
const REPORT: &str = "report.html";

/// What the files tell of a model beside its results.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Origin<'a> {
    pub model: &'a Checked,
    /// The model's own name, or the file's.
    pub name: &'a str,
    /// Of the file's bytes, hexadecimal.
    pub sha256: &'a str,
    /// Time that reading it took.
    pub load: Stage,
}

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
        Page::Wanted => Some(directory.write(REPORT, html(origin, outcome).as_bytes())?),
        Page::Unwanted => {
            directory.remove(REPORT)?;
            None
        }
    };
    let text = summary_text(origin, outcome, watch.read());
    let summary = directory.write(SUMMARY, text.as_bytes())?;
    let paths = [Some(results), peaks, Some(summary), report].into_iter();
    let cams = profiles::write(directory, origin.model)?;
    Ok(Written {
        summary: text,
        paths: paths.flatten().chain(cams).collect(),
        time: watch.read(),
    })
}

/// The text of `summary.json`; `write` is the time that the other files took.
pub(crate) fn summary_text(origin: Origin, outcome: &Outcome, write: Stage) -> String {
    let shape = shape(origin.model, outcome.all());
    let curves = outcome.curves();
    linkdyn_output::summary::to_text(&Summary {
        mechanism: shape.to_json(),
        drawing: shape.to_drawing(),
        write,
        ..origin.summary(outcome, &curves)
    })
}

/// The text of `report.html`.
pub(crate) fn html(origin: Origin, outcome: &Outcome) -> String {
    let (curves, complete) = (outcome.curves(), outcome.all_curves());
    let summary = origin.summary(outcome, &curves);
    let (derived, mut notes) = derived(origin.model, &complete);
    if !outcome.peaks.is_empty() {
        notes.push(format!(
            "Besides the {} outputs this page has {} instants between them: where columns have their smallest or largest value, \
             and where contacts begin, press most and end.",
            outcome.trajectory.len(),
            outcome.peaks.len()
        ));
    }
    let report = Report {
        derived: Some(&derived),
        notes,
        shape: profiles::shape(origin.model),
        ..Report::new(origin.model, &summary, &complete)
    };
    report.html()
}

/// The shape of a model; its loads at the instants of a table that has the poses of all bodies.
pub(crate) fn shape(model: &Checked, results: &Trajectory) -> Shape {
    let mut shape = profiles::shape(model);
    if shape.loads.is_empty() {
        return shape;
    }
    if let Some((times, loads)) = results.values(TIME).zip(derived::loads(model, results)) {
        shape.take_loads(&times, &loads);
    }
    shape
}

impl<'a> Origin<'a> {
    /// The summary of a run, without the mechanism's shape and the time of writing.
    fn summary(self, outcome: &'a Outcome, curves: &'a Trajectory) -> Summary<'a> {
        Summary {
            model_name: self.name,
            model_sha256: self.sha256,
            settings: &outcome.settings,
            responses: to_json(&outcome.responses),
            report: &outcome.report,
            trajectory: curves,
            mechanism: serde_json::Value::Null,
            drawing: serde_json::Value::Null,
            load: self.load,
            write: Stage::default(),
        }
    }
}
