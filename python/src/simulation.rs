//! A simulation that Python steps.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, TryLockError};

use linkdyn::{Control, bridge};
use pyo3::buffer::PyBuffer;
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;

use crate::equations::Numbers;
use crate::errors::exception;
use crate::work::{BRIEF, Watch, at_once, in_place, watched};

/// A motion at an instant.
#[pyclass(frozen, module = "linkdyn._linkdyn")]
pub struct Simulation {
    inner: Arc<Mutex<linkdyn::Simulation>>,
    /// What a law of forces has raised.
    raised: Raised,
    /// Whether the last step was brief: then so is the next.
    is_brief: AtomicBool,
}

/// A point to which it can go back.
#[pyclass(frozen, module = "linkdyn._linkdyn")]
pub struct Checkpoint(linkdyn::Checkpoint);

/// The first exception that a law of forces has raised since the last step.
type Raised = Arc<Mutex<Option<PyErr>>>;

#[pymethods]
impl Simulation {
    /// The instant \[s\].
    #[getter]
    fn time(&self) -> PyResult<f64> {
        Ok(self.get()?.time())
    }

    /// Names of the coordinates (n).
    #[getter]
    fn coordinates(&self) -> PyResult<Vec<String>> {
        Ok(self.get()?.coordinates().to_vec())
    }

    /// q (n).
    #[getter]
    fn position(&self) -> PyResult<Numbers> {
        Ok(Numbers(self.get()?.position().to_vec()))
    }

    /// v (n).
    #[getter]
    fn velocity(&self) -> PyResult<Numbers> {
        Ok(Numbers(self.get()?.velocity().to_vec()))
    }

    /// The value of a result column.
    fn value(&self, py: Python<'_>, name: &str) -> PyResult<f64> {
        let simulation = self.get()?;
        let column = simulation.mechanism().column(name);
        Ok(simulation.value(column.map_err(|error| exception(py, &error))?))
    }

    /// F (n), constant from now on.
    fn set_forces(&self, py: Python<'_>, forces: PyBuffer<f64>) -> PyResult<()> {
        let mut simulation = self.get()?;
        let forces = forces.to_vec(py)?;
        fits(forces.len(), simulation.coordinates().len())?;
        simulation.set_forces(&forces);
        Ok(())
    }

    /// Names of the inputs.
    fn inputs(&self) -> PyResult<Vec<String>> {
        Ok(self.get()?.inputs().map(str::to_owned).collect())
    }

    /// The value of an input.
    fn input(&self, py: Python<'_>, name: &str) -> PyResult<f64> {
        let value = self.get()?.input(name);
        value.map_err(|error| exception(py, &error))
    }

    /// Sets an input.
    fn set_input(&self, py: Python<'_>, name: &str, value: f64) -> PyResult<()> {
        let set = self.get()?.set_input(name, value);
        set.map_err(|error| exception(py, &error))
    }

    /// Sets the acceleration of a driver that is steered.
    fn set_acceleration(&self, py: Python<'_>, driver: &str, acceleration: f64) -> PyResult<()> {
        let set = self.get()?.set_acceleration(driver, acceleration);
        set.map_err(|error| exception(py, &error))
    }

    /// F as a function of time, position and velocity, which gives doubles (n).
    fn set_law(&self, law: Py<PyAny>) -> PyResult<()> {
        let raised = Arc::clone(&self.raised);
        self.get()?.set_law(move |time, q, v, force| {
            let mut raised = raised
                .lock()
                .unwrap_or_else(|poisoned| poisoned.into_inner());
            if raised.is_none() {
                let asked = Python::attach(|py| asked(py, &law, time, [q, v]));
                match asked.and_then(|told| fits(told.len(), force.len()).map(|()| told)) {
                    Ok(told) => return force.copy_from_slice(&told),
                    Err(error) => *raised = Some(error),
                }
            }
            // The step is refused.
            force.fill(f64::NAN);
        });
        Ok(())
    }

    /// Steps to a later instant, or to the first event before it; what happened, each as in `summary.json`.
    fn step(
        &self,
        py: Python<'_>,
        time: f64,
        stops_at_events: bool,
    ) -> PyResult<(Vec<String>, Option<PyErr>)> {
        let inner = Arc::clone(&self.inner);
        let work = move |watch: &Watch| {
            let control = Control {
                interrupted: Arc::clone(&watch.interrupted),
                ..Control::default()
            };
            let mut simulation = inner.try_lock().map_err(|busy| is_busy(&busy))?;
            Ok::<_, PyErr>(simulation.step_under(time, stops_at_events, &control))
        };
        let done = if self.is_brief.load(Ordering::Relaxed) {
            in_place(py, work)
        } else {
            watched(py, None, work)
        }?;
        self.is_brief.store(done.took < BRIEF, Ordering::Relaxed);
        let raised = self.raised.lock();
        if let Some(error) = raised
            .unwrap_or_else(|poisoned| poisoned.into_inner())
            .take()
        {
            return Err(error);
        }
        if let (Some(stopped), Ok(Err(_))) = (&done.stopped, &done.value) {
            return Ok((Vec::new(), Some(stopped.clone_ref(py))));
        }
        let events = done.value?.map_err(|error| exception(py, &error))?;
        Ok((events.iter().map(bridge::event).collect(), done.stopped))
    }

    /// Keeps the motion as it is.
    fn checkpoint(&self, py: Python<'_>) -> PyResult<Checkpoint> {
        let mut simulation = self.get()?;
        let simulation = &mut *simulation;
        at_once(py, || Checkpoint(simulation.checkpoint()))
    }

    /// Goes back to where it was.
    fn restore(&self, py: Python<'_>, checkpoint: &Checkpoint) -> PyResult<()> {
        let restored = self.get()?.restore(&checkpoint.0);
        restored.map_err(|error| exception(py, &error))
    }
}

impl Simulation {
    pub fn new(
        py: Python<'_>,
        mechanism: &linkdyn::Mechanism,
        steered: &[String],
    ) -> PyResult<Self> {
        let steered: Vec<&str> = steered.iter().map(String::as_str).collect();
        let begun = at_once(py, || mechanism.steered_simulation(&steered))?;
        let simulation = begun.map_err(|error| exception(py, &error))?;
        Ok(Simulation {
            inner: Arc::new(Mutex::new(simulation)),
            raised: Raised::default(),
            is_brief: AtomicBool::new(true),
        })
    }

    /// The simulation, where nobody steps it.
    fn get(&self) -> PyResult<MutexGuard<'_, linkdyn::Simulation>> {
        self.inner.try_lock().map_err(|busy| is_busy(&busy))
    }
}

fn is_busy<T>(_: &TryLockError<T>) -> PyErr {
    PyRuntimeError::new_err("the simulation is being stepped")
}

fn fits(given: usize, wanted: usize) -> PyResult<()> {
    if given == wanted {
        return Ok(());
    }
    let told = format!("forces have {wanted} numbers, not {given}");
    Err(PyValueError::new_err(told))
}

/// What a law of forces says.
fn asked(py: Python<'_>, law: &Py<PyAny>, time: f64, state: [&[f64]; 2]) -> PyResult<Vec<f64>> {
    let [q, v] = state.map(|numbers| Numbers(numbers.to_vec()));
    let told = law.call1(py, (time, q, v))?;
    PyBuffer::<f64>::get(told.bind(py))?.to_vec(py)
}
