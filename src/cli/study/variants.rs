//! The variants of a study: each a member of the model's family, so that a row depends on its number alone.

use super::asked::Asked;
use linkdyn_engine::analysis::{Control, Family, Member};
use linkdyn_model::error::Complaints;
use linkdyn_output::Status;
use linkdyn_study::chunks::Rows;
use rayon::prelude::*;
use std::ops::Range;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// What makes rows of variants.
pub struct Variants<'a> {
    pub family: &'a Family,
    pub asked: &'a Asked,
    pub interrupted: Arc<AtomicBool>,
}

/// A row: why it has no result, inputs, responses.
type Made = (Option<String>, Vec<f64>, Vec<f64>);

/// Variants that a thread takes at once where they are found beside the nominal one; a run of its own takes long enough alone.
const SOME: usize = 16;

impl Variants<'_> {
    /// The rows of a range of variants, in their order; none where it was interrupted.
    pub fn rows(&self, range: Range<u64>) -> Option<Rows> {
        // a chunk is written at once, so that its length is one of a list in memory
        let length = (range.end - range.start) as usize;
        let begin = || self.family.begin();
        let some = if self.family.is_tracked() { SOME } else { 1 };
        let made: Vec<Made> = (0..length)
            .into_par_iter()
            .with_min_len(some)
            .map_init(begin, |member, k| self.row(member, range.start + k as u64))
            .while_some()
            .collect();
        if made.len() != length {
            return None;
        }
        let mut rows = Rows::new(
            range.start,
            self.asked.inputs.len(),
            self.family.responses().len(),
        );
        for (reason, inputs, responses) in made {
            rows.push(reason.as_deref(), &inputs, &responses);
        }
        Some(rows)
    }

    /// One variant; none where it was interrupted.
    fn row(&self, member: &mut Member, variant: u64) -> Option<Made> {
        if self.interrupted.load(Ordering::Relaxed) {
            return None;
        }
        let mut inputs = vec![0.0; self.asked.inputs.len()];
        let mut given = inputs.clone();
        let mut responses = vec![f64::NAN; self.family.responses().len()];
        self.asked.values(variant, &mut inputs, &mut given);
        // No deadline: a row depends on its number, not on the machine.
        let control = Control {
            interrupted: Arc::clone(&self.interrupted),
            ..Control::default()
        };
        let reason = match member.run(&given, &control, &mut responses) {
            Err(complaints) => Some(input_fault(&complaints)),
            Ok(ended) => match ended.status {
                Status::Interrupted => return None,
                Status::Completed => ended.missing.map(|index| {
                    format!("no value of {}", self.family.responses().list()[index].name)
                }),
                status => {
                    if status != Status::CompletedWithGaps {
                        responses.fill(f64::NAN);
                    }
                    Some(status.word().to_owned())
                }
            },
        };
        Some((reason, inputs, responses))
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
