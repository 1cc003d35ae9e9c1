//! A model that was read and checked.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use linkdyn::{Control, bridge};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::equations::Equations;
use crate::errors::exception;
use crate::family::Family;
use crate::run::Run;
use crate::simulation::Simulation;
use crate::work::{BRIEF, Watch, at_once, in_place, watched};

/// A model that was read and checked.
#[pyclass(frozen, module = "linkdyn._linkdyn")]
pub struct Mechanism {
    mechanism: linkdyn::Mechanism,
    /// Whether its last run was brief: then so is the next, which does the same.
    is_brief: AtomicBool,
}

#[pymethods]
impl Mechanism {
    /// Reads the text of a model file that has this name, and is at a path, beside which its tables are.
    #[staticmethod]
    #[pyo3(signature = (stem, text, path = "", allowed = Vec::new()))]
    fn read(
        py: Python<'_>,
        stem: &str,
        text: &[u8],
        path: &str,
        allowed: Vec<PathBuf>,
    ) -> PyResult<Self> {
        Mechanism::new(py, || bridge::read(stem, text, Path::new(path), allowed))
    }

    /// A bundled model.
    #[staticmethod]
    fn bundled(py: Python<'_>, name: &str) -> PyResult<Self> {
        Mechanism::new(py, || linkdyn::Mechanism::bundled(name))
    }

    /// The mechanism with values set, each as `PATH=VALUE`.
    fn set(&self, py: Python<'_>, sets: Vec<String>) -> PyResult<Self> {
        Mechanism::new(py, || bridge::set(&self.mechanism, sets))
    }

    /// The model's own name, or the file's.
    #[getter]
    fn name(&self) -> &str {
        self.mechanism.name()
    }

    /// What is allowed in the model and yet probably a slip.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.mechanism.warnings().to_vec()
    }

    /// Name, value in SI and SI unit of each parameter.
    #[getter]
    fn parameters(&self) -> Vec<(String, f64, String)> {
        let parameters = self.mechanism.parameters();
        let told = parameters
            .map(|(name, parameter)| (name.to_owned(), parameter.nominal().si(), parameter.unit()));
        told.collect()
    }

    /// Name and SI unit of each result column.
    #[getter]
    fn columns(&self) -> Vec<(String, &'static str)> {
        let columns = self.mechanism.columns();
        columns
            .map(|(name, column)| (name.to_owned(), column.unit()))
            .collect()
    }

    /// The model as a file.
    fn to_json(&self, py: Python<'_>) -> PyResult<String> {
        at_once(py, || self.mechanism.to_json())
    }

    /// Name, number in the file's unit and this unit of each parameter that has a number of its own.
    fn knobs(&self, py: Python<'_>) -> PyResult<Vec<(String, f64, String)>> {
        let found = at_once(py, || bridge::knobs(&self.mechanism))?;
        found.map_err(|error| exception(py, &error))
    }

    /// The text of the file with other numbers for such parameters.
    fn rewritten(&self, py: Python<'_>, values: Vec<(String, f64)>) -> PyResult<String> {
        let values: Vec<(&str, f64)> = values
            .iter()
            .map(|(name, value)| (&**name, *value))
            .collect();
        let text = at_once(py, || bridge::rewritten(&self.mechanism, &values))?;
        text.map_err(|error| exception(py, &error))
    }

    /// Runs the analysis; what stopped it from Python comes second.
    #[pyo3(signature = (timeout=None, told=None))]
    fn run(
        &self,
        py: Python<'_>,
        timeout: Option<f64>,
        told: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<(Run, Option<PyErr>)> {
        let deadline = timeout.map(deadline).transpose()?;
        let mechanism = self.mechanism.clone();
        let work = move |watch: &Watch| {
            let control = Control {
                deadline,
                interrupted: Arc::clone(&watch.interrupted),
                progress: watch.progress.clone(),
            };
            mechanism.run_under(&control)
        };
        let done = if self.is_brief.load(Ordering::Relaxed) {
            in_place(py, work)
        } else {
            watched(py, told, work)
        }?;
        self.is_brief.store(done.took < BRIEF, Ordering::Relaxed);
        let run = done.value.map_err(|error| exception(py, &error))?;
        Ok((Run::new(run, done.took), done.stopped))
    }

    /// How long a run by the library alone takes, in this thread \[s\]: what a run from Python is held against.
    fn _native(&self, py: Python<'_>) -> PyResult<f64> {
        let (ended, took) = at_once(py, || {
            let began = Instant::now();
            let run = self.mechanism.run();
            let took = began.elapsed();
            (run.map(|_| ()), took)
        })?;
        ended.map_err(|error| exception(py, &error))?;
        Ok(took.as_secs_f64())
    }

    /// The equations that the model is compiled to.
    fn equations(&self, py: Python<'_>) -> PyResult<Equations> {
        Equations::new(py, &self.mechanism)
    }

    /// The motion at t = 0, to be stepped.
    fn simulation(&self, py: Python<'_>, steered: Vec<String>) -> PyResult<Simulation> {
        Simulation::new(py, &self.mechanism, &steered)
    }

    /// The family of mechanisms in which these parameters take other values.
    fn family(&self, py: Python<'_>, parameters: Vec<String>) -> PyResult<Family> {
        let made = at_once(py, || {
            let handles = parameters.iter().map(|name| self.mechanism.parameter(name));
            let handles = handles.collect::<Result<Vec<_>, _>>()?;
            self.mechanism.family(&handles)
        })?;
        let family = made.map_err(|error| exception(py, &error))?;
        Ok(Family::new(family, parameters))
    }
}

impl Mechanism {
    /// The same for another thread.
    pub fn own(&self) -> linkdyn::Mechanism {
        self.mechanism.clone()
    }

    pub fn of(mechanism: linkdyn::Mechanism) -> Self {
        Mechanism {
            mechanism,
            is_brief: AtomicBool::new(false),
        }
    }

    fn new(
        py: Python<'_>,
        make: impl FnOnce() -> Result<linkdyn::Mechanism, linkdyn::Error> + Send,
    ) -> PyResult<Self> {
        let made = at_once(py, make)?;
        let made = made.map_err(|error| exception(py, &error))?;
        Ok(Mechanism::of(made))
    }
}

/// So many seconds from now.
fn deadline(seconds: f64) -> PyResult<Instant> {
    let wait = Duration::try_from_secs_f64(seconds).ok();
    let end = wait.and_then(|wait| Instant::now().checked_add(wait));
    end.ok_or_else(|| {
        PyValueError::new_err(format!("a timeout is a time in seconds, not {seconds}"))
    })
}
