//! What a page draws.

use linkdyn_ask::ModelFile;
use linkdyn_engine::analysis::Outcome;
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
