//! What the command does, in this process: studies, accuracy, optimisation, comparisons, diagnoses.

use std::ffi::OsString;
use std::sync::Arc;

use pyo3::prelude::*;

use crate::work::watched;

/// What a command left.
#[pyclass(frozen, get_all, module = "linkdyn._linkdyn")]
pub struct Said {
    /// Its exit status.
    status: u8,
    /// What it printed.
    stdout: String,
    /// What it complained of.
    stderr: String,
}

/// Runs the command with these arguments; what stopped it from Python comes second.
#[pyfunction]
pub fn command(py: Python<'_>, arguments: Vec<OsString>) -> PyResult<(Said, Option<PyErr>)> {
    let done = watched(py, None, |watch| {
        let arguments = std::iter::once(OsString::from("linkdyn")).chain(arguments);
        linkdyn::cli::hosted(arguments, Arc::clone(&watch.interrupted))
    })?;
    let linkdyn::cli::Said {
        status,
        stdout,
        stderr,
    } = done.value;
    Ok((
        Said {
            status,
            stdout,
            stderr,
        },
        done.stopped,
    ))
}
