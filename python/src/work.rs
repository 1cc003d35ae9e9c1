//! Work without the interpreter's lock: other threads of Python go on, Ctrl-C stops it, and a panic becomes an exception.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

use linkdyn::bridge::Progress;
use pyo3::exceptions::PyOSError;
use pyo3::prelude::*;

use crate::errors::internal;

/// Between two looks at signals.
const INTERVAL: Duration = Duration::from_millis(50);
/// As much room as a main thread has: text of a model may be nested deeply \[bytes\].
const STACK: usize = 8 << 20;

/// What was done, and the exception that stopped it.
pub struct Done<T> {
    /// What came out, whole or not.
    pub value: T,
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

/// Does what may take long, in a thread of its own, while this one looks after signals and tells the progress.
pub fn watched<T: Send>(
    py: Python<'_>,
    told: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(&Watch) -> T + Send,
) -> PyResult<Done<T>> {
    let watch = Watch::default();
    let stopped = thread::scope(|scope| {
        let (sender, receiver) = channel();
        let inner = watch.clone();
        let run = move || {
            let done = catch_unwind(AssertUnwindSafe(|| work(&inner)));
            // Somebody waits for it, always.
            let _ = sender.send(done);
        };
        let builder = thread::Builder::new()
            .name("linkdyn".into())
            .stack_size(STACK);
        builder
            .spawn_scoped(scope, run)
            .map_err(PyOSError::new_err)?;
        let mut receiver = receiver;
        let mut stopped = None;
        loop {
            let (given_back, done) = py.detach(move || {
                let done = receiver.recv_timeout(INTERVAL);
                (receiver, done)
            });
            receiver = given_back;
            match done {
                Ok(Ok(value)) => return Ok(Done { value, stopped }),
                Ok(Err(payload)) => return Err(internal(py, payload.as_ref())),
                Err(RecvTimeoutError::Disconnected) => {
                    return Err(internal(py, &"the thread is gone"));
                }
                Err(RecvTimeoutError::Timeout) => {}
            }
            if stopped.is_none()
                && let Err(error) = look(py, &watch, told)
            {
                watch.interrupted.store(true, Ordering::SeqCst);
                stopped = Some(error);
            }
        }
    })?;
    Ok(stopped)
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
        watched(py, None, |_| fail()).map(|done| done.value)
    } else {
        at_once(py, fail)
    }
}
