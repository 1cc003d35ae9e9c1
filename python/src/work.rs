//! Work without the interpreter's lock: other threads of Python go on, Ctrl-C stops it, and a panic becomes an exception.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::{Duration, Instant};

use linkdyn::bridge::Progress;
use pyo3::exceptions::PyOSError;
use pyo3::prelude::*;

use crate::errors::internal;
use crate::worker::Worker;

/// Between two looks at signals.
const INTERVAL: Duration = Duration::from_millis(50);
/// What takes less is over before anybody would look.
pub const BRIEF: Duration = Duration::from_millis(20);
/// What is said of a thread that ended without a word.
const GONE: &str = "the thread is gone";

/// What was done, and the exception that stopped it.
pub struct Done<T> {
    /// What came out, whole or not.
    pub value: T,
    /// How long the work itself took.
    pub took: Duration,
    /// What a handler of signals raised meanwhile, or who was told of the progress.
    pub stopped: Option<PyErr>,
}

/// What a work is told from outside, and tells.
#[derive(Clone, Default)]
pub struct Watch {
    /// Set when it is to stop.
    pub interrupted: Arc<AtomicBool>,
    /// How far it has come.
    pub progress: Progress,
}

/// Does what takes a moment only, in this thread.
pub fn at_once<T>(py: Python<'_>, work: impl FnOnce() -> T + Send) -> PyResult<T>
where
    T: Send,
{
    let done = py.detach(|| catch_unwind(AssertUnwindSafe(work)));
    done.map_err(|payload| internal(py, payload.as_ref()))
}

/// Does what is known to be brief, in this thread, since to wake another one costs a tenth of a millisecond.
pub fn in_place<T: Send>(
    py: Python<'_>,
    work: impl FnOnce(&Watch) -> T + Send,
) -> PyResult<Done<T>> {
    let (value, took) = at_once(py, || {
        let began = Instant::now();
        let value = work(&Watch::default());
        (value, began.elapsed())
    })?;
    Ok(Done {
        value,
        took,
        stopped: None,
    })
}

/// Does what may take long, in another thread, while this one looks after signals and tells the progress.
pub fn watched<T: Send + 'static>(
    py: Python<'_>,
    told: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(&Watch) -> T + Send + 'static,
) -> PyResult<Done<T>> {
    let watch = Watch::default();
    let (sender, mut receiver) = channel();
    let inner = watch.clone();
    let job = move || {
        let began = Instant::now();
        let done = catch_unwind(AssertUnwindSafe(|| work(&inner)));
        // Somebody waits for it, always.
        let _ = sender.send((done, began.elapsed()));
    };
    let worker = Worker::take().map_err(PyOSError::new_err)?;
    if !worker.give(Box::new(job)) {
        return Err(internal(py, &GONE));
    }
    let mut stopped = None;
    loop {
        let (given_back, done) = py.detach(move || {
            let done = receiver.recv_timeout(INTERVAL);
            (receiver, done)
        });
        receiver = given_back;
        match done {
            Ok((done, took)) => {
                worker.keep();
                let value = done.map_err(|payload| internal(py, payload.as_ref()))?;
                return Ok(Done {
                    value,
                    took,
                    stopped,
                });
            }
            Err(RecvTimeoutError::Disconnected) => return Err(internal(py, &GONE)),
            Err(RecvTimeoutError::Timeout) => {}
        }
        if stopped.is_none()
            && let Err(error) = look(py, &watch, told)
        {
            watch.interrupted.store(true, Ordering::SeqCst);
            stopped = Some(error);
        }
    }
}

/// Lets handlers of signals run, and tells how far the work is.
fn look(py: Python<'_>, watch: &Watch, told: Option<&Bound<'_, PyAny>>) -> PyResult<()> {
    py.check_signals()?;
    if let (Some(told), Some(share)) = (told, watch.progress.share()) {
        told.call1((share,))?;
    }
    Ok(())
}

/// Panics, for the tests: in this thread, or in that of a run.
#[pyfunction]
#[pyo3(name = "_panic")]
pub fn panic(py: Python<'_>, is_watched: bool) -> PyResult<()> {
    let fail = || -> () { panic!("injected") };
    if is_watched {
        watched(py, None, move |_| fail()).map(|done| done.value)
    } else {
        at_once(py, fail)
    }
}
