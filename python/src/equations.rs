//! The equations that a model is compiled to, for solvers of others.

use linkdyn::bridge::{self, System};
use pyo3::buffer::PyBuffer;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::errors::exception;
use crate::run::interface;
use crate::work::at_once;

/// The equations of a model.
#[pyclass(frozen, module = "linkdyn._linkdyn")]
pub struct Equations {
    mechanism: linkdyn::Mechanism,
}

/// Numbers in a row, which NumPy reads in place.
#[pyclass(frozen, module = "linkdyn._linkdyn")]
pub struct Numbers(pub Vec<f64>);

/// Rows and columns of J, its values, φ, φ_t, γ, Q and the diagonal of M.
type Told = (Vec<usize>, Vec<usize>, [Numbers; 6]);

#[pymethods]
impl Equations {
    /// Names of the coordinates (n).
    #[getter]
    fn coordinates(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        Ok(self.system(py)?.coordinates())
    }

    /// Where the file draws the bodies: coordinates (n).
    #[getter]
    fn guess(&self, py: Python<'_>) -> PyResult<Vec<f64>> {
        Ok(self.system(py)?.guess.clone())
    }

    /// Number of constraint rows m, and of those that joints make, which are the first.
    #[getter]
    fn rows(&self, py: Python<'_>) -> PyResult<(usize, usize)> {
        let system = self.system(py)?;
        Ok((system.m(), system.joint_rows()))
    }

    /// The terms at coordinates and velocities (n) and a time \[s\].
    fn terms(
        &self,
        py: Python<'_>,
        q: PyBuffer<f64>,
        v: PyBuffer<f64>,
        time: f64,
    ) -> PyResult<Told> {
        let system = self.system(py)?;
        let (q, v) = (q.to_vec(py)?, v.to_vec(py)?);
        if q.len() != system.n() || v.len() != system.n() {
            let told = format!(
                "q and v have {} numbers each, not {} and {}",
                system.n(),
                q.len(),
                v.len()
            );
            return Err(PyValueError::new_err(told));
        }
        let terms = at_once(py, || system.terms(&q, &v, time))?;
        let rows = terms.jacobian.iter().map(|entry| entry.0).collect();
        let columns = terms.jacobian.iter().map(|entry| entry.1).collect();
        let values = terms.jacobian.iter().map(|entry| entry.2).collect();
        let told = [
            values,
            terms.phi,
            terms.rate,
            terms.gamma,
            terms.force,
            terms.mass,
        ];
        Ok((rows, columns, told.map(Numbers)))
    }
}

impl Equations {
    pub fn new(py: Python<'_>, mechanism: &linkdyn::Mechanism) -> PyResult<Self> {
        let mechanism = mechanism.clone();
        at_once(py, || bridge::system(&mechanism).map(|_| ()))?
            .map_err(|error| exception(py, &error))?;
        Ok(Equations { mechanism })
    }

    fn system(&self, py: Python<'_>) -> PyResult<&System> {
        bridge::system(&self.mechanism).map_err(|error| exception(py, &error))
    }
}

#[pymethods]
impl Numbers {
    /// (count)
    #[getter]
    fn __array_interface__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        interface(py, "<f8", (self.0.as_ptr().addr(), (self.0.len(),)), None)
    }
}
