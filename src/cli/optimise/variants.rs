//! What a variant of the model gives: the one place where the search meets the engine.

use super::question::Question;
use crate::cli::exit::BadInput;
use crate::cli::open::{ModelOptions, Opened};
use linkdyn_engine::analysis::{Control, Outcome, Prepared};
use linkdyn_model::Source;
use linkdyn_model::error::Complaints;
use linkdyn_optimise::curve::Node;
use linkdyn_output::{Status, Trajectory};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// What names of responses begin with that the search adds.
pub const OWN: &str = "number of the search ";

/// What a variant gives.
#[derive(Debug, Clone, PartialEq)]
pub enum Found<T> {
    Some(T),
    /// Nothing, and why.
    None(String),
    /// Ctrl-C.
    Stopped,
}

/// How finely a path is known.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Detail {
    /// For the search.
    Coarse,
    /// For the last digits.
    Fine,
}

/// Whether an interrupt counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Call {
    /// It does: this is one of many.
    OfSearch,
    /// It does not: this says what the search found.
    Last,
}

/// The variants of a model by the values of its parameters [SI].
pub trait Variants: Sync {
    /// The numbers that the search needs, then the responses of the model, NaN where these have no value.
    fn numbers(&self, x: &[f64], call: Call) -> Found<Vec<f64>>;
    /// The same where a parameter of the model deviates from what it has there.
    fn deviating(&self, x: &[f64], deviation: (&str, f64), call: Call) -> Found<Vec<f64>>;
    /// The path of the point.
    fn path(&self, x: &[f64], detail: Detail, call: Call) -> Found<Vec<Node>>;
}

/// Each variant is read, compiled and run by itself.
pub struct Runs {
    source: Source,
    /// The model with an analysis for the path: coarse, fine.
    paths: Option<[Source; 2]>,
    point: String,
    names: Vec<String>,
    /// Values of the file.
    nominal: Vec<f64>,
    needed: usize,
    responses: usize,
    interrupted: Arc<AtomicBool>,
}

/// Rows of a path: one turn in steps of 3.75°, and of a quarter of it, which the quintics between them make 1e-12 and 1e-15 of it.
const ROWS: [usize; 2] = [97, 385];

impl Runs {
    /// Of a model that has the responses of the search.
    ///
    /// # Errors
    /// A path that the model does not have.
    pub fn new(
        model: &ModelOptions,
        sets: &[String],
        question: &Question,
        opened: &Opened,
        timing: Option<&super::timing::Timing>,
        interrupted: Arc<AtomicBool>,
    ) -> Result<Self, BadInput> {
        let mut paths = Vec::new();
        if let Some(point) = question.point() {
            for rows in ROWS {
                let path = super::timing::sets(opened, point, timing, rows);
                let with = model.open_with(&[sets, &path].concat())?;
                let with = with.map_err(|said| opened.bad_input(said))?;
                paths.push(with.loaded.source);
            }
        }
        let variables = question.variables.iter().map(|own| &own.parameter);
        Ok(Runs {
            source: opened.loaded.source.clone(),
            paths: paths.try_into().ok(),
            point: question
                .point()
                .map_or_else(String::new, ToString::to_string),
            names: variables.clone().map(|own| own.name.clone()).collect(),
            nominal: variables.map(|own| own.value).collect(),
            needed: question.numbers(),
            responses: question.responses.len(),
            interrupted,
        })
    }

    fn run(&self, model: Result<linkdyn_model::Checked, Complaints>, call: Call) -> Found<Outcome> {
        let heeded = match call {
            Call::OfSearch => Arc::clone(&self.interrupted),
            Call::Last => Arc::default(),
        };
        if heeded.load(Ordering::Relaxed) {
            return Found::Stopped;
        }
        // No deadline: what is found does not depend on the machine.
        let control = Control {
            interrupted: heeded,
            ..Control::default()
        };
        let run = model.and_then(|model| Prepared::new(&model)?.run(&control));
        match run {
            Err(complaints) => Found::None(input_fault(&complaints)),
            Ok(outcome) => match outcome.report.status {
                Status::Interrupted => Found::Stopped,
                Status::Completed => Found::Some(outcome),
                status @ (Status::CompletedWithGaps
                | Status::DeadCentre
                | Status::AssemblyFailed
                | Status::StepTooSmall
                | Status::Singular
                | Status::TimeLimit) => Found::None(status.word().to_owned()),
            },
        }
    }

    fn named<'x>(&'x self, x: &'x [f64]) -> Vec<(&'x str, f64)> {
        self.names
            .iter()
            .map(String::as_str)
            .zip(x.iter().copied())
            .collect()
    }

    fn answers(&self, outcome: &Outcome) -> Found<Vec<f64>> {
        let (own, others): (Vec<_>, Vec<_>) = outcome
            .responses
            .iter()
            .partition(|answer| answer.name.starts_with(OWN));
        if let Some(missing) = own.iter().find(|answer| answer.value.is_none()) {
            let why = missing
                .reason
                .clone()
                .unwrap_or_else(|| "no value".to_owned());
            return Found::None(why);
        }
        let all = own
            .iter()
            .chain(&others)
            .map(|answer| answer.value.unwrap_or(f64::NAN));
        let all: Vec<f64> = all.collect();
        debug_assert_eq!(all.len(), self.needed + self.responses);
        Found::Some(all)
    }
}

impl Variants for Runs {
    fn numbers(&self, x: &[f64], call: Call) -> Found<Vec<f64>> {
        match self.run(self.source.with_parameters(&self.named(x)), call) {
            Found::Some(outcome) => self.answers(&outcome),
            Found::None(why) => Found::None(why),
            Found::Stopped => Found::Stopped,
        }
    }

    fn deviating(&self, x: &[f64], (parameter, by): (&str, f64), call: Call) -> Found<Vec<f64>> {
        let mut deviations = self.named(x);
        for (own, nominal) in deviations.iter_mut().zip(&self.nominal) {
            own.1 -= nominal;
        }
        match deviations.iter_mut().find(|own| own.0 == parameter) {
            Some(own) => own.1 += by,
            None => deviations.push((parameter, by)),
        }
        match self.run(self.source.with_deviations(&deviations), call) {
            Found::Some(outcome) => self.answers(&outcome),
            Found::None(why) => Found::None(why),
            Found::Stopped => Found::Stopped,
        }
    }

    fn path(&self, x: &[f64], detail: Detail, call: Call) -> Found<Vec<Node>> {
        let Some([coarse, fine]) = &self.paths else {
            return Found::None("no path is looked for".to_owned());
        };
        let source = match detail {
            Detail::Coarse => coarse,
            Detail::Fine => fine,
        };
        match self.run(source.with_parameters(&self.named(x)), call) {
            Found::Some(outcome) => nodes(outcome.all(), &self.point)
                .map_or_else(|| Found::None("no path".to_owned()), Found::Some),
            Found::None(why) => Found::None(why),
            Found::Stopped => Found::Stopped,
        }
    }
}

/// The path of a point over time.
fn nodes(rows: &Trajectory, point: &str) -> Option<Vec<Node>> {
    let column = |name: &str| rows.column_index(name);
    let of = |word: &str| column(&format!("{point}.{word}"));
    let time = column(linkdyn_output::TIME)?;
    let all = ["x", "y", "vx", "vy", "ax", "ay"].map(of);
    let [Some(x), Some(y), Some(vx), Some(vy), Some(ax), Some(ay)] = all else {
        return None;
    };
    let node = |row: &[f64]| Node {
        s: row[time],
        p: [row[x], row[y]],
        d: [row[vx], row[vy]],
        dd: [row[ax], row[ay]],
    };
    let nodes: Vec<Node> = rows.rows().map(node).collect();
    let is_whole = nodes
        .iter()
        .all(|node| node.p.iter().chain(&node.dd).all(|own| own.is_finite()));
    is_whole.then_some(nodes)
}

/// What is wrong with a model, without its values: many variants have the same fault.
fn input_fault(complaints: &Complaints) -> String {
    let first = complaints.0.first();
    first.map_or_else(
        || "bad_input".to_owned(),
        |complaint| format!("bad_input: {}: {}", complaint.path, complaint.message),
    )
}
