//! Many variants of one mechanism, by all processors.

use std::sync::Arc;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

use linkdyn::{Control, Error, Status, bridge};
use pyo3::buffer::PyBuffer;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::answers::{Answers, Statuses};
use crate::errors::exception;
use crate::work::{Watch, watched};

/// Words by which variants are reported to have ended, in the order of their numbers; behind them are [`REFUSED`] and [`FAILED`].
const WORDS: [Status; 8] = [
    Status::Completed,
    Status::CompletedWithGaps,
    Status::DeadCentre,
    Status::AssemblyFailed,
    Status::StepTooSmall,
    Status::Singular,
    Status::TimeLimit,
    Status::Interrupted,
];
/// The number of a variant that the model's check refuses.
const REFUSED: u8 = 8;
/// The number of a variant that met a fault of linkdyn itself.
const FAILED: u8 = 9;
/// Rows that a thread takes at once: few enough that all end together.
const PORTION: usize = 16;

/// A mechanism whose parameters take many values.
#[pyclass(frozen, module = "linkdyn._linkdyn")]
pub struct Family {
    family: Arc<linkdyn::Family>,
    parameters: Vec<String>,
    responses: Vec<(String, String)>,
}

/// What came out: the table, how each variant ended, the first fault, and what stopped it from Python; the derivatives where they
/// are wanted.
type Out = (
    Answers,
    Statuses,
    Option<(usize, String)>,
    Option<PyErr>,
    Answers,
);

#[pymethods]
impl Family {
    /// Words of the numbers that tell how variants ended.
    #[classattr]
    #[pyo3(name = "WORDS")]
    fn words() -> Vec<&'static str> {
        let words = WORDS.iter().map(|status| status.word());
        words.chain(["refused", "failed"]).collect()
    }

    /// Names of the parameters.
    #[getter]
    fn parameters(&self) -> Vec<String> {
        self.parameters.clone()
    }

    /// Names and SI units of the responses.
    #[getter]
    fn responses(&self) -> Vec<(String, String)> {
        self.responses.clone()
    }

    /// Works out the responses of many variants: `values` (variants, parameters) in SI, C-contiguous doubles. With `slopes`
    /// also their derivatives (variants, responses times parameters), NaN where one is not known exactly.
    #[pyo3(signature = (values, threads, told=None, slopes=false))]
    fn run(
        &self,
        py: Python<'_>,
        values: PyBuffer<f64>,
        threads: usize,
        told: Option<&Bound<'_, PyAny>>,
        slopes: bool,
    ) -> PyResult<Out> {
        let wanted = self.parameters.len();
        if values.shape().len() != 2 || values.shape()[1] != wanted {
            return Err(PyValueError::new_err(format!(
                "values have the shape (variants, {wanted}), not {:?}",
                values.shape()
            )));
        }
        let (rows, values) = (values.shape()[0], values.to_vec(py)?);
        let table = Table {
            family: Arc::clone(&self.family),
            values,
            rows,
            inputs: wanted,
            width: self.responses.len(),
            slopes: if slopes {
                wanted * self.responses.len()
            } else {
                0
            },
        };
        let columns = table.slopes;
        let done = watched(py, told, move |watch| table.all(threads, watch))?;
        let found = done.value.map_err(|error| exception(py, &error))?;
        let answers = Answers {
            values: Arc::new(found.values),
            width: self.responses.len(),
        };
        Ok((
            answers,
            Statuses(found.statuses),
            found.refused,
            done.stopped,
            Answers {
                values: Arc::new(found.slopes),
                width: columns,
            },
        ))
    }
}

/// What is asked of a family: values (rows, inputs), whose answers are (rows, width), their derivatives (rows, slopes).
struct Table {
    family: Arc<linkdyn::Family>,
    values: Vec<f64>,
    rows: usize,
    inputs: usize,
    width: usize,
    /// 0 where no derivatives are wanted.
    slopes: usize,
}

/// What all threads found.
struct Found {
    values: Vec<f64>,
    slopes: Vec<f64>,
    statuses: Vec<u8>,
    refused: Option<(usize, String)>,
}

/// What a thread found about consecutive rows.
struct Portion {
    from: usize,
    values: Vec<f64>,
    slopes: Vec<f64>,
    statuses: Vec<u8>,
    refused: Option<(usize, String)>,
}

impl Family {
    pub fn new(family: linkdyn::Family, parameters: Vec<String>) -> Self {
        let responses = bridge::responses(&family);
        Family {
            family: Arc::new(family),
            parameters,
            responses,
        }
    }
}

impl Table {
    /// All rows, by so many threads; which one computes a row does not change it.
    fn all(&self, threads: usize, watch: &Watch) -> Result<Found, Error> {
        let rows = self.rows;
        let (next, done) = (AtomicUsize::new(0), Mutex::new(Vec::new()));
        let threads = threads.clamp(1, rows.div_ceil(PORTION).max(1));
        let share = || -> Result<(), Error> {
            let begin = || {
                self.family.member_under(Control {
                    interrupted: Arc::clone(&watch.interrupted),
                    ..Control::default()
                })
            };
            let mut member = begin();
            loop {
                let from = next.fetch_add(PORTION, Ordering::Relaxed);
                if from >= rows || watch.interrupted.load(Ordering::Relaxed) {
                    return Ok(());
                }
                watch.progress.note(from as f64, rows as f64);
                let portion = self.portion(&mut member, begin, from..rows.min(from + PORTION));
                done.lock()
                    .unwrap_or_else(std::sync::PoisonError::into_inner)
                    .push(portion);
            }
        };
        thread::scope(|scope| {
            let others: Vec<_> = (1..threads).map(|_| scope.spawn(share)).collect();
            let mut ended = share();
            for other in others {
                match other.join() {
                    Ok(other) => ended = ended.and(other),
                    Err(payload) => std::panic::resume_unwind(payload),
                }
            }
            ended
        })?;
        let (width, slopes) = (self.width, self.slopes);
        let mut found = Found {
            values: vec![f64::NAN; rows * width],
            slopes: vec![f64::NAN; rows * slopes],
            statuses: vec![code(Status::Interrupted); rows],
            refused: None,
        };
        let mut done = done
            .into_inner()
            .unwrap_or_else(std::sync::PoisonError::into_inner);
        done.sort_by_key(|portion| portion.from);
        for portion in done {
            let (from, to) = (portion.from, portion.from + portion.statuses.len());
            found.values[from * width..to * width].copy_from_slice(&portion.values);
            found.slopes[from * slopes..to * slopes].copy_from_slice(&portion.slopes);
            found.statuses[from..to].copy_from_slice(&portion.statuses);
            found.refused = found.refused.or(portion.refused);
        }
        Ok(found)
    }

    fn portion<'f>(
        &'f self,
        member: &mut linkdyn::Member<'f>,
        begin: impl Fn() -> linkdyn::Member<'f>,
        rows: std::ops::Range<usize>,
    ) -> Portion {
        let (inputs, width) = (self.inputs, self.width);
        let mut portion = Portion {
            from: rows.start,
            values: vec![f64::NAN; rows.len() * width],
            slopes: vec![f64::NAN; rows.len() * self.slopes],
            statuses: Vec::with_capacity(rows.len()),
            refused: None,
        };
        let last = rows.end;
        for (place, row) in rows.enumerate() {
            let answers = &mut portion.values[place * width..(place + 1) * width];
            let slopes = &mut portion.slopes[place * self.slopes..(place + 1) * self.slopes];
            let of = |row: usize| &self.values[row * inputs..(row + 1) * inputs];
            if self.slopes == 0 && place.is_multiple_of(linkdyn::Family::ABREAST) {
                let end = last.min(row + linkdyn::Family::ABREAST);
                let next: Vec<&[f64]> = (row..end).map(of).collect();
                if bridge::caught(|| member.expect(&next)).is_err() {
                    // a fault is told by the row that meets it
                    *member = begin();
                }
            }
            let values = of(row);
            let run = || match self.slopes {
                0 => member.run(values, answers),
                _ => member.gradient(values, answers, slopes),
            };
            let (status, said) = match bridge::caught(run) {
                Ok(Ok(status)) => (code(status), None),
                Ok(Err(error)) => (REFUSED, Some(error.to_string())),
                Err(said) => {
                    *member = begin();
                    (FAILED, Some(format!("failed: {said}")))
                }
            };
            portion.statuses.push(status);
            if let Some(said) = said {
                answers.fill(f64::NAN);
                slopes.fill(f64::NAN);
                portion.refused.get_or_insert((row, said));
            }
        }
        portion
    }
}

/// The number of a status.
fn code(status: Status) -> u8 {
    match status {
        Status::Completed => 0,
        Status::CompletedWithGaps => 1,
        Status::DeadCentre => 2,
        Status::AssemblyFailed => 3,
        Status::StepTooSmall => 4,
        Status::Singular => 5,
        Status::TimeLimit => 6,
        Status::Interrupted => 7,
    }
}
