//! What came out of many variants, where NumPy reads it in place.

use std::sync::Arc;

use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::run::interface;

/// The table of responses, row by row.
#[pyclass(frozen, module = "linkdyn._linkdyn")]
pub struct Answers {
    pub values: Arc<Vec<f64>>,
    pub width: usize,
}

/// How each variant ended: numbers of words.
#[pyclass(frozen, module = "linkdyn._linkdyn")]
pub struct Statuses(pub Vec<u8>);

#[pymethods]
impl Answers {
    /// (variants, responses)
    #[getter]
    fn __array_interface__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let rows = self.values.len().checked_div(self.width).unwrap_or(0);
        interface(
            py,
            "<f8",
            (self.values.as_ptr().addr(), (rows, self.width)),
            None,
        )
    }
}

#[pymethods]
impl Statuses {
    /// (variants)
    #[getter]
    fn __array_interface__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        interface(py, "|u1", (self.0.as_ptr().addr(), (self.0.len(),)), None)
    }
}
