//! Responses: named numbers of a run, worked out while its rows come.
//!
//! The expressions are the model's (`linkdyn_model::response`); here they meet the columns of a run. [`Responses`] is made
//! once and can be used from any thread; each thread has an [`Evaluation`] of its own, which allocates nothing while rows
//! come.
//!
//! ```text
//! integral  Σ (t₂ − t₁)(x₁ + x₂)/2 over the rows      mean  integral/(t_end − t_start)      rms  √ of the mean of x²
//! at        linear between the two rows where the two sides of the equation change order
//! ```
//!
//! Where the motion can be asked for rows between ([`Evaluation::ask`]), extremes and `at` are those of the motion: the
//! highest row is where the search for the top begins (`top`), the rows around a crossing where that for the crossing does
//! (`crossing`).

mod answer;
mod crossing;
mod items;
mod reason;
mod running;
mod slopes;
mod top;
mod words;

pub use answer::{Answer, to_json};
pub use linkdyn_model::response::Dual;
pub use reason::Reason;
pub use words::Response;

use items::{Listed, fact};
use linkdyn_model::response::{Fact, Program, Reduction};
use linkdyn_output::{ColumnId, Report, Status};
use running::{Row, Running};

/// Named numbers of runs with certain columns.
#[derive(Debug, Clone, Default)]
pub struct Responses {
    list: Vec<Response>,
    /// Columns that are needed, without the others.
    needed: Vec<ColumnId>,
    /// Their names.
    columns: Vec<String>,
    /// Of which there is nothing at single instants, without anything being wrong.
    may_be_empty: Vec<bool>,
    /// Place of the time among them.
    time: Option<usize>,
    reducers: Vec<Reducer>,
    /// Names of the joints, which are known by their numbers.
    joints: Vec<String>,
    /// Values of parameters, those of a response behind each other.
    parameters: Vec<f64>,
    /// Largest stack.
    depth: usize,
}

/// Many values that become one.
#[derive(Debug, Clone)]
struct Reducer {
    reduction: Reduction,
    over: Over,
    /// Which of all parameters its programs take.
    parameters: [usize; 2],
    /// As the text writes it.
    text: String,
}

/// What it is of.
#[derive(Debug, Clone)]
enum Over {
    /// Rows; inputs are places among the needed columns.
    Rows {
        value: Program,
        equation: Option<[Program; 2]>,
    },
    Items(Listed),
}

/// What the last arithmetic of a response takes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum TakenFrom {
    Reducer(usize),
    Fact(Fact),
}

/// Responses of one run that is under way.
#[derive(Debug, Clone)]
pub struct Evaluation<'r> {
    of: &'r Responses,
    running: Vec<Running>,
    parameters: Vec<f64>,
    reasons: Vec<Option<Reason>>,
    stack: Vec<f64>,
    inputs: Vec<f64>,
    /// A row between others.
    values: Vec<f64>,
}

impl Responses {
    /// What a row gives a reduction; none for one that is not of rows.
    fn reduced(
        &self,
        reducer: &Reducer,
        values: &[f64],
        parameters: &[f64],
        stack: &mut Vec<f64>,
    ) -> Option<Row> {
        let Over::Rows { value, equation } = &reducer.over else {
            return None;
        };
        let time = self.time.map_or(0.0, |time| values[time]);
        let [from, to] = reducer.parameters;
        let mut of = |program: &Program| {
            let found = program.value(values, &parameters[from..to], stack);
            if found.is_finite() {
                return Ok(found);
            }
            let mut inputs = program.inputs();
            Err(match inputs.find(|input| !values[*input].is_finite()) {
                Some(input) if self.may_be_empty[input] => Reason::Empty(input),
                Some(input) => Reason::Gap(time, input),
                None => Reason::NotFinite(Some(time)),
            })
        };
        Some(Row {
            time,
            value: of(value),
            sides: equation.as_ref().map(|[left, right]| {
                let (left, right) = (of(left), of(right));
                left.and_then(|left| right.map(|right| [left, right]))
            }),
        })
    }

    /// The responses, in the order of the model.
    pub fn list(&self) -> &[Response] {
        &self.list
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.list.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// The columns that rows must have, and no others; the time is among them where it is needed.
    pub fn needed(&self) -> &[ColumnId] {
        &self.needed
    }

    /// The names of these columns.
    pub fn columns(&self) -> impl Iterator<Item = &str> {
        self.columns.iter().map(String::as_str)
    }

    /// Begins with the parameters of the model.
    pub fn begin(&self) -> Evaluation<'_> {
        let most = self.list.iter().map(|one| one.sources.len()).max();
        Evaluation {
            of: self,
            running: vec![Running::default(); self.reducers.len()],
            parameters: self.parameters.clone(),
            reasons: vec![None; self.list.len()],
            stack: Vec::with_capacity(self.depth),
            inputs: Vec::with_capacity(most.unwrap_or(0)),
            values: Vec::with_capacity(self.needed.len()),
        }
    }

    /// Whether no rows but the first and the last matter for any of them.
    pub fn take_ends(&self) -> bool {
        let mut reducers = self.reducers.iter();
        reducers.all(|reducer| matches!(reducer.reduction, Reduction::First | Reduction::Last))
    }

    /// Whether the motion between rows matters for any of them.
    pub fn look_between(&self) -> bool {
        self.reducers.iter().any(|reducer| match reducer.reduction {
            Reduction::Max
            | Reduction::Min
            | Reduction::Range
            | Reduction::ArgMax
            | Reduction::ArgMin
            | Reduction::At => matches!(reducer.over, Over::Rows { .. }),
            Reduction::First
            | Reduction::Last
            | Reduction::Mean
            | Reduction::Rms
            | Reduction::Integral
            | Reduction::Sum
            | Reduction::Count => false,
        })
    }
}

impl Evaluation<'_> {
    /// Forgets the rows, for another run with the same columns.
    pub fn restart(&mut self) {
        self.running.iter_mut().for_each(Running::restart);
    }

    /// Sets a parameter that responses name, in SI; ignored where none does.
    pub fn set_parameter(&mut self, name: &str, value: f64) {
        for response in &self.of.list {
            let place = response.parameters.iter().position(|known| known == name);
            if let Some(place) = place {
                self.parameters[response.first_parameter + place] = value;
            }
        }
    }

    /// Takes the next row: a value for each of the columns that are needed, in their order.
    pub fn row(&mut self, row: &[f64]) {
        self.take(row, |running, reduction, row| running.row(reduction, row));
    }

    /// Takes a row between others, where columns have their extremes: it counts for the greatest and the smallest only.
    pub fn between(&mut self, row: &[f64]) {
        self.take(row, |running, _, row| running.between(row));
    }

    fn take(&mut self, values: &[f64], then: impl Fn(&mut Running, Reduction, &Row)) {
        let (of, parameters) = (self.of, &self.parameters);
        for (reducer, running) in of.reducers.iter().zip(&mut self.running) {
            if let Some(row) = of.reduced(reducer, values, parameters, &mut self.stack) {
                then(running, reducer.reduction, &row);
            }
        }
    }

    /// Looks for extremes and crossings between the rows, which have all come, of a run that came to its end. `between` gives
    /// the needed columns at a time, and says whether they are known there; where they are not, what the rows say remains.
    pub fn ask(&mut self, report: &Report, between: &mut dyn FnMut(f64, &mut Vec<f64>) -> bool) {
        if !is_whole(report.status) {
            return;
        }
        let (of, parameters, stack) = (self.of, &self.parameters, &mut self.stack);
        let mut values = std::mem::take(&mut self.values);
        for (reducer, running) in of.reducers.iter().zip(&mut self.running) {
            running.ask(reducer.reduction, |time| {
                values.clear();
                let is_known = between(time, &mut values);
                is_known.then(|| of.reduced(reducer, &values, parameters, stack))?
            });
        }
        self.values = values;
    }

    /// Works out all responses, in SI; NaN where one has no value.
    pub fn finish(&mut self, report: &Report, values: &mut [f64]) {
        let all = self.of.list.iter().zip(values).zip(&mut self.reasons);
        for ((response, value), reason) in all {
            let (from, count) = (response.first_parameter, response.parameters.len());
            let parameters = &self.parameters[from..from + count];
            self.inputs.clear();
            let mut found = Ok(());
            for source in &response.sources {
                let input = match *source {
                    TakenFrom::Fact(of) => {
                        fact(of, report, &self.of.joints).ok_or(Reason::NoFact(of))
                    }
                    TakenFrom::Reducer(_) if !is_whole(report.status) => {
                        Err(Reason::Early(report.status))
                    }
                    TakenFrom::Reducer(index) => {
                        let reducer = &self.of.reducers[index];
                        let done = match &reducer.over {
                            Over::Rows { .. } => self.running[index].result(reducer.reduction),
                            Over::Items(listed) => {
                                let program = |inputs: &[f64], stack: &mut Vec<f64>| {
                                    listed.program.value(inputs, parameters, stack)
                                };
                                listed.reduce(
                                    reducer.reduction,
                                    report,
                                    &self.of.joints,
                                    |inputs| program(inputs, &mut self.stack),
                                )
                            }
                        };
                        done.map_err(|reason| reason.of(index))
                    }
                };
                match input {
                    Ok(input) => self.inputs.push(input),
                    Err(reason) => {
                        found = Err(reason);
                        break;
                    }
                }
            }
            let found = found.and_then(|()| {
                let total = response
                    .total
                    .value(&self.inputs, parameters, &mut self.stack);
                match total.is_finite() {
                    true => Ok(total),
                    false => Err(Reason::NotFinite(None)),
                }
            });
            *value = found.unwrap_or(f64::NAN);
            *reason = found.err();
        }
    }

    /// The responses, worked out.
    pub fn answers(&mut self, report: &Report) -> Vec<Answer> {
        let mut values = vec![f64::NAN; self.of.len()];
        self.finish(report, &mut values);
        let answers = self.of.list.iter().zip(values).enumerate();
        let answers = answers.map(|(index, (response, value))| Answer {
            name: response.name.clone(),
            value: (!value.is_nan()).then_some(value),
            unit: response.unit.clone(),
            shown: response.shown.clone(),
            limits: response.limits,
            reason: self.reason(index),
        });
        answers.collect()
    }

    /// Why a response has no value, after [`Evaluation::finish`]; `None` if it has one.
    pub fn reason(&self, index: usize) -> Option<String> {
        let reason = self.reasons.get(index).copied().flatten()?;
        Some(self.of.words(reason))
    }
}

/// Whether a run came to its end.
fn is_whole(status: Status) -> bool {
    match status {
        Status::Completed | Status::CompletedWithGaps => true,
        Status::DeadCentre
        | Status::AssemblyFailed
        | Status::StepTooSmall
        | Status::Singular
        | Status::TimeLimit
        | Status::Interrupted => false,
    }
}
