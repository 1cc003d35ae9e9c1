//! The variants of a study: each a member of the model's family, so that a row depends on its number alone.

use super::asked::Asked;
use crate::broken::caught;
use crate::cli::exit::Failure;
use linkdyn_engine::analysis::{Control, Family, Member};
use linkdyn_model::error::Complaints;
use linkdyn_output::Status;
use linkdyn_study::chunks::Rows;
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// What makes rows of variants.
pub struct Variants<'a> {
    pub family: &'a Family,
    pub asked: &'a Asked,
    pub interrupted: Arc<AtomicBool>,
}

/// A row: why it has no result, inputs, responses.
type Made = (Option<String>, Vec<f64>, Vec<f64>);

/// Variants that a thread takes at once where they are found beside the nominal one; a run of its own takes long enough alone.
const SOME: u64 = 16;
/// After so long what is done is kept.
const KEPT: Duration = Duration::from_secs(2);

/// The rows of a chunk as threads make them.
struct Growing<'r, K> {
    rows: &'r mut Rows,
    /// Rows behind one that is not there yet, by number.
    ahead: BTreeMap<u64, Made>,
    keep: K,
    kept: Instant,
    failure: Option<Failure>,
}

impl<K: FnMut(&Rows) -> Result<(), Failure>> Growing<'_, K> {
    /// Takes consecutive rows from one on.
    fn take(&mut self, from: u64, made: Vec<Made>) {
        self.ahead.extend((from..).zip(made));
        while let Some((reason, inputs, responses)) = self.ahead.remove(&self.rows.end()) {
            self.rows.push(reason.as_deref(), &inputs, &responses);
        }
        if self.kept.elapsed() >= KEPT {
            self.keep();
        }
    }

    fn keep(&mut self) {
        self.failure = (self.keep)(self.rows).err();
        self.kept = Instant::now();
    }
}

impl Variants<'_> {
    /// Appends rows until `end`, in their order; `keep` is given those that are done every two seconds, and when it is
    /// interrupted. Whether all are there.
    ///
    /// # Errors
    /// Those of `keep`.
    pub fn append(
        &self,
        rows: &mut Rows,
        end: u64,
        keep: impl FnMut(&Rows) -> Result<(), Failure> + Send,
    ) -> Result<bool, Failure> {
        let next = AtomicU64::new(rows.end());
        let some = if self.family.is_tracked() { SOME } else { 1 };
        let growing = Mutex::new(Growing {
            rows,
            ahead: BTreeMap::new(),
            keep,
            kept: Instant::now(),
            failure: None,
        });
        let share = |_: rayon::BroadcastContext<'_>| {
            let mut member = self.family.begin();
            loop {
                let from = next.fetch_add(some, Ordering::Relaxed);
                let all = from..end.min(from.saturating_add(some));
                let wanted = all.clone().count();
                let made = all.map_while(|variant| self.row(&mut member, variant));
                let made: Vec<Made> = made.collect();
                let is_last = made.is_empty() || made.len() < wanted;
                let mut growing = growing.lock().unwrap_or_else(PoisonError::into_inner);
                growing.take(from, made);
                if is_last || growing.failure.is_some() {
                    return;
                }
            }
        };
        rayon::broadcast(share);
        let mut growing = growing.into_inner().unwrap_or_else(PoisonError::into_inner);
        let is_whole = growing.rows.end() >= end;
        if !is_whole && growing.failure.is_none() {
            growing.keep();
        }
        growing.failure.map_or(Ok(is_whole), Err)
    }

    /// One variant; none where it was interrupted. A fault of linkdyn spoils this row alone.
    fn row<'f>(&'f self, member: &mut Member<'f>, variant: u64) -> Option<Made> {
        if self.interrupted.load(Ordering::Relaxed) {
            return None;
        }
        let mut inputs = vec![0.0; self.asked.inputs.len()];
        let mut given = inputs.clone();
        let mut responses = vec![f64::NAN; self.family.responses().len()];
        self.asked.values(variant, &mut inputs, &mut given);
        let reason = match caught(|| self.run(member, &given, &mut responses)) {
            Ok(ended) => ended?,
            Err(said) => {
                *member = self.family.begin();
                responses.fill(f64::NAN);
                Some(format!("failed: {said}"))
            }
        };
        Some((reason, inputs, responses))
    }

    /// Why a variant has no result, where it has none; nothing where it was interrupted.
    fn run(
        &self,
        member: &mut Member,
        given: &[f64],
        responses: &mut [f64],
    ) -> Option<Option<String>> {
        // No deadline: a row depends on its number, not on the machine.
        let control = Control {
            interrupted: Arc::clone(&self.interrupted),
            ..Control::default()
        };
        Some(match member.run(given, &control, responses) {
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
