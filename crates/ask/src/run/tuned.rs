//! A run with other values of parameters, while a hand moves them, and the file with these values.

use linkdyn_engine::analysis::Control;
use linkdyn_model::{Knob, knobs, rewritten};
use linkdyn_output::Status;

use super::Run;
use crate::put::{Put, relabelled};
use crate::{ModelFile, Question, Unanswered, caught};

/// The parameters that have numbers of their own.
pub fn parameters(file: &ModelFile) -> Vec<Knob> {
    knobs(&file.loaded)
}

/// What someone types for a parameter, as a number in the file's unit.
///
/// # Errors
/// What is no such number, and a name that no such parameter has.
pub fn typed(file: &ModelFile, name: &str, text: &str) -> Result<f64, Unanswered> {
    let all = parameters(file);
    let value = knob(&all, name)?.read(text);
    value.map_err(|why| Unanswered::question(why.to_string()))
}

/// The data of the report with other values, each in the file's unit.
///
/// # Errors
/// Faults of the model with these values, and why a run has no result to the end.
pub fn tuned(
    file: &ModelFile,
    values: &[(&str, f64)],
    control: &Control,
) -> Result<String, Unanswered> {
    let all = parameters(file);
    let mut puts = Vec::new();
    for &(name, value) in values {
        let set = knob(&all, name)?.set(value);
        let (path, value) = set.split_once('=').unwrap_or((&set, ""));
        puts.push(Put::new(
            path.to_owned(),
            value,
            format!("{name} = {value}"),
        ));
    }
    let sets: Vec<String> = puts.iter().map(|put| put.set.clone()).collect();
    let run = || {
        let file = file.with(&sets).map_err(|why| relabelled(why, &puts))?;
        let outcome = Run.answer(&file, control)?;
        let report = &outcome.report;
        match report.status {
            Status::Completed | Status::CompletedWithGaps => Ok(file.origin().data(&outcome)),
            Status::Interrupted => Err(Unanswered::Interrupted),
            Status::DeadCentre
            | Status::AssemblyFailed
            | Status::StepTooSmall
            | Status::Singular
            | Status::TimeLimit => {
                let why = report.message.as_deref().unwrap_or(report.status.word());
                Err(Unanswered::Failed(why.to_owned()))
            }
        }
    };
    caught(run).unwrap_or_else(|why| Err(Unanswered::Failed(format!("a bug in linkdyn: {why}"))))
}

/// The bytes of the model's file with other values, each in the file's unit; all other bytes stay.
///
/// # Errors
/// A parameter that has no number in the file.
pub fn with_values(file: &ModelFile, values: &[(&str, f64)]) -> Result<Vec<u8>, Unanswered> {
    let text = rewritten(&file.loaded, values);
    let text = text.map_err(|why| Unanswered::question(why.to_string()))?;
    // a mark of UTF-8 is no part of the text
    let mark = file.text.bytes.len() - file.loaded.source.text().len();
    Ok([&file.text.bytes[..mark], text.as_bytes()].concat())
}

fn knob<'k>(all: &'k [Knob], name: &str) -> Result<&'k Knob, Unanswered> {
    let found = all.iter().find(|knob| knob.name == name);
    found.ok_or_else(|| {
        Unanswered::question(format!("there is no parameter {name:?} with a number"))
    })
}
