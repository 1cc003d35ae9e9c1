//! Questions to a model: each answer as JSON, in words and as a page.

use std::path::PathBuf;
use std::sync::Arc;

use linkdyn::ask::{
    Accuracy, Allocate, Assemblies, Check, Circuits, Compare, Levels, Method, Modes, Optimise,
    PathTime, Question, StateSpace, Study, Synthesise, Varied, Workspace,
};
use linkdyn::{Control, Error, bridge};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::answers::Answers;
use crate::errors::exception;
use crate::mechanism::Mechanism;
use crate::work::{Watch, at_once, watched};

/// JSON, words, and the page where there is one.
type Told = (String, String, Option<String>);

/// The request, and what stopped it from Python.
type Stopped<T> = (T, Option<PyErr>);

fn control(watch: &Watch) -> Control {
    Control {
        interrupted: Arc::clone(&watch.interrupted),
        progress: watch.progress.clone(),
        ..Control::default()
    }
}

/// Asks in another thread.
fn asked<T: Send + 'static>(
    py: Python<'_>,
    told: Option<&Bound<'_, PyAny>>,
    ask: impl FnOnce(&Control) -> Result<T, Error> + Send + 'static,
) -> PyResult<Stopped<Option<T>>> {
    let done = watched(py, told, move |watch| ask(&control(watch)))?;
    match done.value {
        Ok(value) => Ok((Some(value), done.stopped)),
        // What stopped it says more.
        Err(_) if done.stopped.is_some() => Ok((None, done.stopped)),
        Err(error) => Err(exception(py, &error)),
    }
}

/// The answer to a question.
fn answered<Q: Question + Send + 'static>(
    py: Python<'_>,
    model: &Mechanism,
    question: Q,
    told: fn(&Q::Answer) -> Told,
) -> PyResult<Stopped<Option<Told>>> {
    let mechanism = model.own();
    asked(py, None, move |control| {
        Ok(told(&mechanism.ask(&question, control)?))
    })
}

fn levels(word: &str) -> Result<Levels, Error> {
    match word {
        "first" => Ok(Levels::First),
        "worst" => Ok(Levels::Worst),
        "certified" => Ok(Levels::Certified),
        other => Err(Error::Question(vec![format!(
            "levels {other:?}: there are first, worst and certified"
        )])),
    }
}

/// The diagnosis.
#[pyfunction]
pub fn check(py: Python<'_>, model: &Mechanism) -> PyResult<Stopped<Option<Told>>> {
    answered(py, model, Check, |found| {
        bridge::told(found, found.text(), None)
    })
}

/// The modes about the equilibrium, or the assembled position.
#[pyfunction]
pub fn modes(py: Python<'_>, model: &Mechanism, pose: bool) -> PyResult<Stopped<Option<Told>>> {
    answered(py, model, Modes { pose }, |found| {
        let page = found.html().and_then(Result::ok);
        bridge::told(found, found.text(), page)
    })
}

/// Assemblies, and the model in which one of them is drawn.
type Taken = (Told, Option<Mechanism>);

/// All assemblies at an instant, and where one is asked for, counted from 1, the model in which it is drawn.
#[pyfunction]
pub fn assemblies(
    py: Python<'_>,
    model: &Mechanism,
    at: f64,
    most: usize,
    take: Option<usize>,
) -> PyResult<Stopped<Option<Taken>>> {
    let mechanism = model.own();
    asked(py, None, move |control| {
        let found = mechanism.ask(&Assemblies { at, most }, control)?;
        let taken = take.map(|number| found.drawn(number).map_err(Error::from));
        let taken = taken.transpose()?.map(bridge::mechanism).transpose()?;
        let page = found.html().and_then(Result::ok);
        let told = bridge::told(&found, found.text(), page);
        Ok((told, taken.map(Mechanism::of)))
    })
}

/// Linkages for the task of the file.
#[pyfunction]
pub fn synthesise(py: Python<'_>, model: &Mechanism) -> PyResult<Stopped<Option<Told>>> {
    answered(py, model, Synthesise, |found| {
        let page = found.html().and_then(Result::ok);
        bridge::told(found, found.text(), page)
    })
}

/// The circuits that a driver leads through.
#[pyfunction]
pub fn circuits(
    py: Python<'_>,
    model: &Mechanism,
    driver: Option<String>,
    values: Option<usize>,
    range: Option<[f64; 2]>,
) -> PyResult<Stopped<Option<Told>>> {
    let question = Circuits {
        driver,
        values,
        range,
        most: None,
    };
    answered(py, model, question, |found| {
        let page = found.html().and_then(Result::ok);
        bridge::told(found, found.text(), page)
    })
}

/// The map of two drivers.
#[pyfunction]
pub fn workspace(
    py: Python<'_>,
    model: &Mechanism,
    point: String,
    drivers: Option<[String; 2]>,
    values: Option<usize>,
) -> PyResult<Stopped<Option<Told>>> {
    let question = Workspace {
        point,
        drivers,
        values,
        most: None,
    };
    answered(py, model, question, |found| {
        bridge::told(found, found.text(), found.html().ok())
    })
}

/// The linear system about rest, or at instants of the motion.
#[pyfunction]
pub fn linearise(
    py: Python<'_>,
    model: &Mechanism,
    inputs: Vec<String>,
    outputs: Vec<String>,
    pose: bool,
    at: Vec<f64>,
) -> PyResult<Stopped<Option<Told>>> {
    let question = StateSpace {
        inputs,
        outputs,
        pose,
        at,
        frequencies: None,
    };
    answered(py, model, question, |found| {
        bridge::told(found, found.text(), None)
    })
}

/// What tolerances and clearances do to outputs.
#[pyfunction]
pub fn accuracy(
    py: Python<'_>,
    model: &Mechanism,
    outputs: Vec<String>,
    levels: Option<String>,
    threads: usize,
) -> PyResult<Stopped<Option<Told>>> {
    let mechanism = model.own();
    asked(py, None, move |control| {
        let question = Accuracy {
            outputs,
            levels: levels.as_deref().map(self::levels).transpose()?,
            threads: threads.try_into().ok(),
        };
        let found = mechanism.ask(&question, control)?;
        let page = Some(found.html());
        Ok(bridge::told(&found, found.text(), page))
    })
}

/// The cheapest tolerances that keep the limits of outputs, and the model with them.
#[pyfunction]
pub fn allocate(
    py: Python<'_>,
    model: &Mechanism,
    outputs: Vec<String>,
    squares: bool,
) -> PyResult<Stopped<Option<(Told, Mechanism)>>> {
    let mechanism = model.own();
    asked(py, None, move |control| {
        let found = mechanism.ask(&Allocate { outputs, squares }, control)?;
        let best = bridge::mechanism(found.model()?)?;
        let told = bridge::told(&found, found.text(), None);
        Ok((told, Mechanism::of(best)))
    })
}

/// The model with each model of a joint's clearance.
#[pyfunction]
pub fn compare(
    py: Python<'_>,
    model: &Mechanism,
    joints: Vec<String>,
    models: Vec<String>,
    columns: Vec<String>,
) -> PyResult<Stopped<Option<Told>>> {
    let question = Compare {
        joints,
        models,
        columns,
    };
    answered(py, model, question, |found| {
        bridge::told(found, found.text(), Some(found.html()))
    })
}

/// What was found, why it is not what was looked for, and the model with it.
type Optimum = (Told, Option<String>, Option<Mechanism>);

/// Values of parameters with which goals are met, or an objective is least or greatest.
#[pyfunction]
#[allow(clippy::too_many_arguments)]
pub fn optimise(
    py: Python<'_>,
    model: &Mechanism,
    vary: Vec<String>,
    goals: Vec<String>,
    minimise: Vec<String>,
    maximise: Vec<String>,
    constraints: Vec<String>,
    robust: Option<f64>,
    starts: Option<u64>,
    seed: Option<u64>,
    threads: usize,
) -> PyResult<Stopped<Option<Optimum>>> {
    let mechanism = model.own();
    let question = Optimise {
        vary,
        goals,
        minimise,
        maximise,
        constraints,
        robust,
        starts,
        seed,
    };
    asked(py, None, move |control| {
        let found = bridge::by_threads(threads, || mechanism.ask(&question, control))??;
        let best = found.model()?.map(bridge::mechanism).transpose()?;
        let told = bridge::told(&found, found.text(), None);
        Ok((told, found.failure(), best.map(Mechanism::of)))
    })
}

/// The fastest motion along a stroke, and the model with it.
#[pyfunction]
#[allow(clippy::too_many_arguments)]
pub fn path_time(
    py: Python<'_>,
    model: &Mechanism,
    driver: Option<String>,
    start: Option<String>,
    end: Option<String>,
    limits: Vec<String>,
    speed: Option<String>,
    acceleration: Option<String>,
    start_speed: Option<String>,
    end_speed: Option<String>,
    intervals: Option<u64>,
) -> PyResult<Stopped<Option<(Told, Mechanism)>>> {
    let mechanism = model.own();
    let question = PathTime {
        driver,
        from: start,
        to: end,
        limits,
        speed,
        acceleration,
        start_speed,
        end_speed,
        intervals,
    };
    asked(py, None, move |control| {
        let found = mechanism.ask(&question, control)?;
        let best = bridge::mechanism(found.model().clone())?;
        let page = found.html().ok();
        let told = bridge::told(&found, found.text(), page);
        Ok((told, Mechanism::of(best)))
    })
}

/// A study, whose shares anybody can compute.
#[pyclass(frozen, module = "linkdyn._linkdyn")]
pub struct Variants(Arc<bridge::Variants>);

/// What a study comes to; how each variant ended; names and units of the columns, and the table of their values.
type Table = (Told, Vec<String>, Vec<(String, String)>, Answers);

#[pymethods]
impl Variants {
    /// What is varied: `vary` has names and values; where nothing is, what the model says.
    #[new]
    #[allow(clippy::too_many_arguments)]
    fn new(
        py: Python<'_>,
        model: &Mechanism,
        vary: Vec<(String, String)>,
        samples: Option<u64>,
        method: &str,
        indices: bool,
        seed: Option<u64>,
        responses: Vec<String>,
    ) -> PyResult<Self> {
        let default = Study::default();
        let method = match method {
            "random" => Method::MonteCarlo,
            "sobol" => Method::Sobol { scrambled: true },
            "latin" => Method::LatinHypercube,
            other => {
                let told = format!("method {other:?}: there are random, sobol and latin");
                return Err(PyValueError::new_err(told));
            }
        };
        let varied = vary.iter().map(|(name, values)| Varied::new(name, values));
        let question = Study {
            varied: varied.collect(),
            samples,
            method,
            indices,
            seed: seed.unwrap_or(default.seed),
        };
        let is_own = question.varied.is_empty() && samples.is_none();
        let question = (!is_own).then_some(question);
        let mechanism = model.own();
        let made = at_once(py, || {
            bridge::Variants::new(&mechanism, question.as_ref(), seed, &responses)
        })?;
        let made = made.map_err(|error| exception(py, &error))?;
        Ok(Variants(Arc::new(made)))
    }

    /// `study.json` before anything was computed.
    fn plan(&self) -> String {
        self.0.plan()
    }

    /// Computes all variants.
    #[pyo3(signature = (page, threads, told=None))]
    fn run(
        &self,
        py: Python<'_>,
        page: bool,
        threads: usize,
        told: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Stopped<Option<Table>>> {
        let variants = Arc::clone(&self.0);
        asked(py, told, move |control| {
            let done = bridge::by_threads(threads, || variants.run(control, page))?;
            let (studied, rows) = done.ok_or(Error::Interrupted)?;
            let columns = variants.columns();
            let answers = Answers {
                values: Arc::new(rows.values),
                width: columns.len(),
            };
            let told = (studied.json, studied.text, studied.page);
            Ok((told, rows.statuses, columns, answers))
        })
    }

    /// Computes a share, from 1, into a directory; what is there already is kept.
    fn share(
        &self,
        py: Python<'_>,
        directory: PathBuf,
        share: [u64; 2],
        threads: usize,
    ) -> PyResult<Stopped<Option<bool>>> {
        let variants = Arc::clone(&self.0);
        asked(py, None, move |control| {
            bridge::by_threads(threads, || variants.share(&directory, share, control))?
        })
    }

    /// Computes what is missing in a directory, and writes all files.
    #[pyo3(signature = (directory, page, threads, told=None))]
    fn join(
        &self,
        py: Python<'_>,
        directory: PathBuf,
        page: bool,
        threads: usize,
        told: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Stopped<Option<Told>>> {
        let variants = Arc::clone(&self.0);
        asked(py, told, move |control| {
            let joined = bridge::by_threads(threads, || variants.join(&directory, page, control))?;
            let studied = joined?.ok_or(Error::Interrupted)?;
            Ok((studied.json, studied.text, studied.page))
        })
    }
}

/// What a text such as `90 mm` says in SI, and its SI unit.
#[pyfunction]
pub fn quantity(py: Python<'_>, text: &str) -> PyResult<(f64, String)> {
    let read = at_once(py, || bridge::quantity(text))?;
    read.map_err(|error| exception(py, &error))
}

/// The text of a model that another program wrote, and what that lacks: places and what is there.
#[pyfunction]
#[pyo3(signature = (name, source, format = None, length = None))]
pub fn imported(
    py: Python<'_>,
    name: &str,
    source: &[u8],
    format: Option<&str>,
    length: Option<String>,
) -> PyResult<(String, Vec<(String, String)>)> {
    let read = at_once(py, || bridge::imported(name, source, format, length))?;
    read.map_err(|error| exception(py, &error))
}

/// Names of the bundled models.
#[pyfunction]
pub fn bundled() -> Vec<String> {
    bridge::bundled()
}
