//! What a run leaves: columns by handle, how it ended, and files.

use std::path::{Path, PathBuf};

use linkdyn_engine::analysis::Outcome;
use linkdyn_output::{ColumnId, ColumnView, Report, Status};

use crate::error::Error;
use crate::files::Page;
use crate::handles::Column;
use crate::mechanism::Mechanism;

/// A finished run of a [`Mechanism`]: its results, and how it ended.
///
/// # Examples
/// ```
/// use linkdyn::prelude::*;
///
/// let mechanism = Mechanism::bundled("four-bar")?;
/// let torque = mechanism.column("driver.motor.effort")?;
/// let run = mechanism.run()?.complete()?;
/// let (time, torque) = (run.time(), run.column(torque));
/// assert_eq!(time.len(), torque.len());
/// assert!(torque.max_abs() > 0.0);
/// # Ok::<(), linkdyn::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Run {
    mechanism: Mechanism,
    outcome: Outcome,
}

/// The values of one column, row by row, without a copy.
///
/// NaN stands for a value that does not exist at this instant. Extremes also see the instants between the rows where
/// a column has its peaks, so that they do not depend on where the rows fall.
#[derive(Debug, Clone, Copy)]
pub struct Values<'r> {
    rows: ColumnView<'r>,
    peaks: ColumnView<'r>,
}

impl Run {
    pub(crate) fn new(mechanism: Mechanism, outcome: Outcome) -> Self {
        Run { mechanism, outcome }
    }

    /// The values of a column.
    ///
    /// # Panics
    /// Where the handle is one of a mechanism with other columns.
    pub fn column(&self, column: Column) -> Values<'_> {
        assert_eq!(
            column.table,
            self.mechanism.table(),
            "the column is one of a mechanism with other columns"
        );
        self.values(column.id)
    }

    /// The instants of the rows \[s\].
    pub fn time(&self) -> Values<'_> {
        self.values(ColumnId::at(0))
    }

    fn values(&self, id: ColumnId) -> Values<'_> {
        Values {
            rows: self.outcome.all().column(id),
            peaks: self.outcome.peaks.column(id),
        }
    }

    /// How the run ended.
    pub fn status(&self) -> Status {
        self.outcome.report.status
    }

    /// The run itself, where it came to its end; gaps in driven motions are allowed.
    ///
    /// # Errors
    /// [`Error::Early`] where it ended early.
    pub fn complete(self) -> Result<Self, Error> {
        match self.status() {
            Status::Completed | Status::CompletedWithGaps => Ok(self),
            status => Err(Error::Early {
                status,
                message: self.outcome.report.message.clone().unwrap_or_default(),
            }),
        }
    }
    /// Everything but the columns: status, mobility, quality, events, warnings, work done.
    pub fn report(&self) -> &Report {
        &self.outcome.report
    }

    pub(crate) fn outcome(&self) -> &Outcome {
        &self.outcome
    }

    /// The mechanism that ran.
    pub fn mechanism(&self) -> &Mechanism {
        &self.mechanism
    }

    /// The page `report.html`: one file with the mechanism in motion, plots and tables.
    ///
    /// # Examples
    /// ```
    /// use linkdyn::prelude::*;
    ///
    /// let page = Mechanism::bundled("four-bar")?.run()?.html();
    /// assert!(page.starts_with("<!doctype html>"));
    /// # Ok::<(), linkdyn::Error>(())
    /// ```
    pub fn html(&self) -> String {
        self.mechanism.origin().html(&self.outcome)
    }

    /// Writes `results.csv`, `summary.json`, `report.html` and, of motions with contacts, `peaks.csv`, as the command does.
    /// Returns their paths.
    ///
    /// # Errors
    /// [`Error::Write`] where the system refuses.
    pub fn write(&self, directory: impl AsRef<Path>) -> Result<Vec<PathBuf>, Error> {
        let directory = crate::files::open_directory(directory.as_ref())?;
        let origin = self.mechanism.origin();
        Ok(crate::files::write(&directory, origin, &self.outcome, Page::Wanted)?.paths)
    }
}

impl<'r> Values<'r> {
    /// Number of rows.
    pub fn len(self) -> usize {
        self.rows.len()
    }

    /// Whether there is no row.
    pub fn is_empty(self) -> bool {
        self.rows.is_empty()
    }

    /// The value of a row; none beyond the last one.
    pub fn get(self, row: usize) -> Option<f64> {
        self.rows.get(row)
    }

    /// Row by row.
    pub fn iter(self) -> impl ExactSizeIterator<Item = f64> + DoubleEndedIterator + Clone + 'r {
        self.rows.iter()
    }

    /// The memory that the values are in, and the distance from each to the next.
    pub fn strided(self) -> (&'r [f64], usize) {
        self.rows.strided()
    }

    /// A copy.
    pub fn to_vec(self) -> Vec<f64> {
        self.iter().collect()
    }

    /// Rows and peaks that exist.
    fn known(self) -> impl Iterator<Item = f64> + 'r {
        let all = self.rows.iter().chain(self.peaks.iter());
        all.filter(|value| !value.is_nan())
    }

    /// Largest value; NaN where none exists.
    pub fn max(self) -> f64 {
        self.known().fold(f64::NAN, f64::max)
    }

    /// Smallest value; NaN where none exists.
    pub fn min(self) -> f64 {
        self.known().fold(f64::NAN, f64::min)
    }

    /// Largest magnitude; NaN where no value exists.
    pub fn max_abs(self) -> f64 {
        self.known().map(f64::abs).fold(f64::NAN, f64::max)
    }

    /// Largest value minus smallest one; NaN where none exists.
    pub fn range(self) -> f64 {
        self.max() - self.min()
    }

    /// The value of the last row where it exists.
    pub fn last(self) -> Option<f64> {
        self.get(self.len().checked_sub(1)?)
            .filter(|value| !value.is_nan())
    }
}
