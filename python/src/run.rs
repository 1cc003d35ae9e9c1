//! A run, and its columns where they stand in memory.

use std::sync::Arc;
use std::time::Duration;

use linkdyn::{Status, bridge};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::errors::exception;
use crate::work::at_once;

/// What a run left.
#[pyclass(frozen, module = "linkdyn._linkdyn")]
pub struct Run(Arc<linkdyn::Run>, Duration);

/// The values of a column, in the memory of its run. NumPy reads them in place, and keeps this alive.
#[pyclass(frozen, module = "linkdyn._linkdyn")]
pub struct Column {
    run: Arc<linkdyn::Run>,
    column: linkdyn::Column,
}

#[pymethods]
impl Run {
    /// The word of `summary.json` for how it ended.
    #[getter]
    fn status(&self) -> &'static str {
        self.0.status().word()
    }

    /// Whether it came to its end.
    #[getter]
    fn is_complete(&self) -> bool {
        matches!(
            self.0.status(),
            Status::Completed | Status::CompletedWithGaps
        )
    }

    /// Why it ended early.
    #[getter]
    fn message(&self) -> Option<String> {
        self.0.report().message.clone()
    }

    /// What was suspicious.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.0.report().warnings.clone()
    }

    /// How long the library took for it \[s\].
    #[getter]
    fn _took(&self) -> f64 {
        self.1.as_secs_f64()
    }

    /// Name and SI unit of each column of `results.csv`.
    #[getter]
    fn columns(&self) -> Vec<(String, &'static str)> {
        let columns = bridge::wanted(&self.0).iter();
        columns
            .map(|column| (column.name.clone(), column.unit))
            .collect()
    }

    /// A column that was computed, whether it stands in `results.csv` or not.
    fn column(&self, py: Python<'_>, name: &str) -> PyResult<Column> {
        let column = self.0.mechanism().column(name);
        let column = column.map_err(|error| exception(py, &error))?;
        Ok(Column {
            run: Arc::clone(&self.0),
            column,
        })
    }

    /// The text of `summary.json`.
    fn summary(&self, py: Python<'_>) -> PyResult<String> {
        at_once(py, || bridge::summary(&self.0))
    }

    /// The text of `report.html`.
    fn html(&self, py: Python<'_>) -> PyResult<String> {
        at_once(py, || self.0.html())
    }

    /// Writes the files of the command; their paths.
    fn write(
        &self,
        py: Python<'_>,
        directory: std::path::PathBuf,
    ) -> PyResult<Vec<std::path::PathBuf>> {
        let written = at_once(py, || self.0.write(directory))?;
        written.map_err(|error| exception(py, &error))
    }
}

impl Run {
    pub fn new(run: linkdyn::Run, took: Duration) -> Self {
        Run(Arc::new(run), took)
    }
}

#[pymethods]
impl Column {
    /// Where the values are, for NumPy: they never change, and live as long as this does.
    #[getter]
    fn __array_interface__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let values = self.run.column(self.column);
        let (memory, stride) = values.strided();
        let strides = (stride * size_of::<f64>(),);
        interface(
            py,
            "<f8",
            (memory.as_ptr().addr(), (values.len(),)),
            Some(strides),
        )
    }

    /// Smallest value, peaks between the rows included.
    fn min(&self) -> f64 {
        self.run.column(self.column).min()
    }

    /// Largest value, peaks between the rows included.
    fn max(&self) -> f64 {
        self.run.column(self.column).max()
    }
}

/// The dictionary by which NumPy finds memory that it must not write.
pub fn interface<'py, S: IntoPyObject<'py>>(
    py: Python<'py>,
    kind: &str,
    (address, shape): (usize, S),
    strides: Option<(usize,)>,
) -> PyResult<Bound<'py, PyDict>> {
    let told = PyDict::new(py);
    told.set_item("version", 3)?;
    // Of the machine's own order of bytes, which is the lower one first wherever linkdyn is built.
    told.set_item("typestr", kind)?;
    told.set_item("shape", shape)?;
    told.set_item("data", (address, true))?;
    told.set_item("strides", strides)?;
    Ok(told)
}
