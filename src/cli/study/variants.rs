//! The variants of a study: each a model of its own, run by itself, so that a row depends on its number alone.

use super::asked::Asked;
use super::respond::Responses;
use linkdyn_engine::analysis::{Control, Prepared};
use linkdyn_model::Source;
use linkdyn_model::error::Complaints;
use linkdyn_output::Status;
use linkdyn_study::chunks::Rows;
use rayon::prelude::*;
use std::ops::Range;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// What makes rows of variants.
pub struct Variants<'a> {
    pub source: &'a Source,
    pub asked: &'a Asked,
    pub responses: &'a Responses,
    pub interrupted: Arc<AtomicBool>,
}

/// A row: why it has no result, inputs, responses.
type Made = (Option<String>, Vec<f64>, Vec<f64>);

impl Variants<'_> {
    /// The rows of a range of variants, in their order; none where it was interrupted.
    pub fn rows(&self, range: Range<u64>) -> Option<Rows> {
        let made: Vec<Made> = range
            .clone()
            .into_par_iter()
            .map(|variant| self.row(variant))
            .while_some()
            .collect();
        if made.len() as u64 != range.end - range.start {
            return None;
        }
        let mut rows = Rows::new(
            range.start,
            self.asked.inputs.len(),
            self.responses.asked().len(),
        );
        for (reason, inputs, responses) in made {
            rows.push(reason.as_deref(), &inputs, &responses);
        }
        Some(rows)
    }

    /// One variant; none where it was interrupted.
    fn row(&self, variant: u64) -> Option<Made> {
        if self.interrupted.load(Ordering::Relaxed) {
            return None;
        }
        let mut inputs = vec![0.0; self.asked.inputs.len()];
        let none = vec![f64::NAN; self.responses.asked().len()];
        let model = self.asked.model(self.source, variant, &mut inputs);
        // No deadline: a row depends on its number, not on the machine.
        let control = Control {
            interrupted: Arc::clone(&self.interrupted),
            ..Control::default()
        };
        let run = model.and_then(|model| Prepared::new(&model)?.run(&control));
        Some(match run {
            Err(complaints) => (Some(input_fault(&complaints)), inputs, none),
            Ok(outcome) => match outcome.report.status {
                Status::Interrupted => return None,
                Status::Completed => {
                    let (missing, values) = self.responses.values(&outcome);
                    (missing, inputs, values)
                }
                Status::CompletedWithGaps => {
                    let (_, values) = self.responses.values(&outcome);
                    (
                        Some(outcome.report.status.word().to_owned()),
                        inputs,
                        values,
                    )
                }
                status => (Some(status.word().to_owned()), inputs, none),
            },
        })
    }
}

/// What is wrong with a model, without its values: many variants have the same fault.
fn input_fault(complaints: &Complaints) -> String {
    let first = complaints.0.first();
    first.map_or_else(
        || "bad_input".to_owned(),
        |complaint| format!("bad_input: {}: {}", complaint.path, complaint.message),
    )
}
