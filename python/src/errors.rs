//! Faults as exceptions, whose classes stand in `linkdyn/errors.py`.

use std::any::Any;

use linkdyn::{Complaint, Error};
use pyo3::prelude::*;
use pyo3::types::PyTuple;

/// Makes an exception of a class of `linkdyn.errors`.
fn raised<'py>(
    py: Python<'py>,
    class: &str,
    arguments: impl IntoPyObject<
        'py,
        Target = PyTuple,
        Output = Bound<'py, PyTuple>,
        Error: Into<PyErr>,
    >,
) -> PyErr {
    let made = || {
        let arguments = arguments.into_pyobject(py).map_err(Into::into)?;
        py.import("linkdyn.errors")?
            .getattr(class)?
            .call1(arguments)
    };
    match made() {
        Ok(exception) => PyErr::from_value(exception),
        Err(error) => error,
    }
}

/// What a complaint says: path, line, column, the offending text, what is wrong, what would mend it, and all that in one line.
type Words = (
    String,
    Option<usize>,
    Option<usize>,
    Option<String>,
    String,
    Option<String>,
    String,
);

fn words(complaint: &Complaint) -> Words {
    let text = complaint.to_string();
    let Complaint {
        path,
        place,
        found,
        message,
        hint,
    } = complaint.clone();
    let (line, column) = (
        place.map(|place| place.line),
        place.map(|place| place.column),
    );
    (path, line, column, found, message, hint, text)
}

/// The exception of an error.
pub fn exception(py: Python<'_>, error: &Error) -> PyErr {
    let text = error.to_string();
    let class = match error {
        Error::Model(complaints) => {
            let complaints: Vec<Words> = complaints.iter().map(words).collect();
            return raised(py, "ModelError", (text, complaints));
        }
        Error::Foreign(refused) => {
            let (place, mend) = (refused.place.clone(), Some(refused.mend.clone()));
            let cause = refused.cause.clone();
            let complaint: Words = (place, None, None, None, cause, mend, text.clone());
            return raised(py, "ModelError", (text, vec![complaint]));
        }
        Error::Question(lines) => {
            let of_line = |line: &String| {
                (
                    String::new(),
                    None,
                    None,
                    None,
                    line.clone(),
                    None,
                    line.clone(),
                )
            };
            let complaints: Vec<Words> = lines.iter().map(of_line).collect();
            return raised(py, "ModelError", (text, complaints));
        }
        Error::Failed(_) => "SolveError",
        Error::Interrupted => "Interrupted",
        Error::Rows(_) if error.is_unwritten() => {
            return pyo3::exceptions::PyOSError::new_err(text);
        }
        Error::Rows(_) => "ModelError",
        Error::Read { path, cause } => {
            let (path, number) = (path.display().to_string(), cause.raw_os_error());
            return match number {
                Some(number) => pyo3::exceptions::PyOSError::new_err((number, text, path)),
                None => pyo3::exceptions::PyOSError::new_err(text),
            };
        }
        Error::Write(_) => return pyo3::exceptions::PyOSError::new_err(text),
        Error::Bundled { .. } => "UnknownModel",
        Error::Unknown { .. } => "UnknownName",
        Error::Early { .. } => "SolveError",
        Error::Dimension { .. } | Error::Unit(_) => "UnitError",
        _ => "LinkdynError",
    };
    raised(py, class, (text,))
}

/// The exception of a fault of linkdyn itself.
pub fn internal(py: Python<'_>, payload: &(dyn Any + Send)) -> PyErr {
    let said = payload
        .downcast_ref::<&str>()
        .map(|text| (*text).to_owned());
    let said = said.or_else(|| payload.downcast_ref::<String>().cloned());
    raised(
        py,
        "InternalError",
        (said.unwrap_or_else(|| "a panic without words".to_owned()),),
    )
}
