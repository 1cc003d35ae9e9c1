//! What a page draws.

use linkdyn_ask::run::Run;
use linkdyn_ask::{ModelFile, Question, Unanswered};
use linkdyn_engine::analysis::{Control, Outcome};
use linkdyn_model::DriverKind;
use linkdyn_output::Status;
use wasm_bindgen::prelude::wasm_bindgen;

/// A run, or the mechanism at its start: the data of a report, which the page of a report takes.
#[wasm_bindgen]
#[derive(Debug, Default)]
pub struct Picture {
    facts: String,
    values: Vec<f64>,
    failure: String,
}

#[wasm_bindgen]
impl Picture {
    /// What is drawn and said, as JSON.
    #[wasm_bindgen(getter)]
    pub fn facts(&mut self) -> String {
        std::mem::take(&mut self.facts)
    }

    /// The numbers, column after column.
    #[wasm_bindgen(getter)]
    pub fn values(&mut self) -> Vec<f64> {
        std::mem::take(&mut self.values)
    }

    /// Why the run did not go to its end; empty if it did.
    #[wasm_bindgen(getter)]
    pub fn failure(&mut self) -> String {
        std::mem::take(&mut self.failure)
    }
}

impl Picture {
    /// Of what can't be drawn, and why.
    pub(crate) fn without(failure: String) -> Self {
        Picture {
            failure,
            ..Picture::default()
        }
    }

    /// Of a run of a model.
    pub(crate) fn new(file: &ModelFile, outcome: &Outcome) -> Self {
        let report = &outcome.report;
        let failure = match report.status {
            Status::Completed | Status::CompletedWithGaps => String::new(),
            Status::Interrupted
            | Status::DeadCentre
            | Status::AssemblyFailed
            | Status::StepTooSmall
            | Status::Singular
            | Status::TimeLimit => {
                let why = report.message.as_deref();
                why.unwrap_or(report.status.word()).to_owned()
            }
        };
        let (facts, values) = file.origin().numbers(outcome);
        Picture {
            facts,
            values,
            failure,
        }
    }
}

/// The model with fewer outputs, where it has more: enough to draw while a hand moves.
pub fn thinned(file: &ModelFile, most: usize) -> Option<ModelFile> {
    let model = file.model();
    let analysis = model.analysis.as_ref()?;
    let set = match (&analysis.outputs, &analysis.sample) {
        (Some(outputs), None) if *outputs > most => format!("analysis.outputs={most}"),
        (None, Some(sample)) => {
            let step = (sample.to - sample.from) / most as f64;
            let unit = match model.drivers.get(&sample.driver)?.kind {
                DriverKind::Rotation { .. } => "rad",
                DriverKind::Translation { .. }
                | DriverKind::Length { .. }
                | DriverKind::Point { .. } => "m",
            };
            let is_fine = step.abs() > sample.step.abs();
            is_fine.then(|| format!("analysis.sample.step={step} {unit}"))?
        }
        (Some(_), _) | (None, None) => return None,
    };
    // What can't be thinned, since something of it asks for an instant, is run as it is.
    file.with(&[set]).ok()
}

/// What a run of a model comes to, and the model that ran: one without an analysis, or with one that has no first instant, is assembled.
///
/// # Errors
/// Why it can't even be assembled.
pub fn run(file: &ModelFile, control: &Control) -> Result<(ModelFile, Outcome), Unanswered> {
    let analysis = file.model().analysis.as_ref();
    let first = analysis.map(|_| Run.answer(file, control));
    match first {
        Some(Ok(outcome)) if outcome.all().rows().next().is_some() => {
            return Ok((file.clone(), outcome));
        }
        Some(Ok(_) | Err(_)) | None => {}
    }
    let assembled = file.with(&["analysis={\"type\":\"assembly\"}".to_owned()]);
    let drawn = assembled
        .map_err(Unanswered::from)
        .and_then(|file| Ok((Run.answer(&file, control)?, file)));
    match (drawn, first) {
        (Ok((outcome, file)), None) => Ok((file, outcome)),
        // What went wrong with the run is said of the drawing of the start.
        (Ok((mut outcome, file)), Some(failed)) => {
            let (status, message) = match failed {
                Ok(failed) => (failed.report.status, failed.report.message),
                Err(why) => (Status::AssemblyFailed, Some(why.to_string())),
            };
            (outcome.report.status, outcome.report.message) = (status, message);
            Ok((file, outcome))
        }
        (Err(why), None) => Err(why),
        (Err(_), Some(failed)) => failed.map(|outcome| (file.clone(), outcome)),
    }
}
