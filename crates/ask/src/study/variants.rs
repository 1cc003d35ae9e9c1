//! The variants of a study: each a member of the model's family, so that a row depends on its number alone.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use linkdyn_engine::analysis::{ABREAST, Control, Family, Member};
use linkdyn_output::Status;
use linkdyn_study::chunks::{ChunkFault, Rows};
use web_time::Instant;

use super::display::Display;
use super::head::Head;
use super::inputs::Inputs;
use super::question::Study;
use super::sums::Sums;
use super::{Chunks, Studied};
use crate::broken::caught;
use crate::text::words::input_fault;
use crate::{ModelFile, Question, Unanswered};

/// The variants of a study, ready to be computed.
pub struct Variants {
    /// The model.
    pub file: ModelFile,
    /// What the study is.
    pub head: Head,
    /// The units in which it is reported.
    pub display: Display,
    pub(super) family: Family,
    pub(super) inputs: Inputs,
}

/// A row: why it has no result, inputs, responses.
type Made = (Option<String>, Vec<f64>, Vec<f64>);

/// The inputs of a variant, and what the family is given for them.
type Given = [Vec<f64>; 2];

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
    failure: Option<ChunkFault>,
}

impl<K: FnMut(&Rows) -> Result<(), ChunkFault>> Growing<'_, K> {
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

impl Study {
    /// The variants of a model, ready to be computed.
    ///
    /// # Errors
    /// A model without responses, parameters that it does not have, nothing to vary.
    pub fn variants(&self, file: &ModelFile) -> Result<Variants, Unanswered> {
        Variants::new(self, file)
    }
}

/// Threads of rayon share the work.
impl Question for Study {
    type Answer = Studied;

    fn answer(&self, file: &ModelFile, control: &Control) -> Result<Studied, Unanswered> {
        let studied = self.variants(file)?.answer(control, |_| ());
        studied.ok_or(Unanswered::Interrupted)
    }
}

impl Variants {
    pub(super) fn new(study: &Study, file: &ModelFile) -> Result<Self, Unanswered> {
        if file.model().responses.is_empty() {
            return Err(Unanswered::question(format!(
                "{}: it has no responses, which a study asks for: add --response \"stroke = max(piston.x) - min(piston.x)\", or \"responses\" to the model",
                file.label()
            )));
        }
        let inputs = Inputs::new(study, file)?;
        let family = Family::new(&file.loaded, &inputs.parameters(), inputs.given());
        let family = family.map_err(|complaints| file.refused(complaints))?;
        Ok(Variants {
            file: file.clone(),
            head: Head::new(study, file, &inputs, &family),
            display: Display::of(file.model(), &family),
            family,
            inputs,
        })
    }

    /// Computes all variants, whose rows `take` is given in their order; `None` if it is interrupted. Threads of rayon share
    /// the work.
    pub fn answer(&self, control: &Control, mut take: impl FnMut(&Rows)) -> Option<Studied> {
        let (plan, whole) = (self.head.plan(), self.head.variants as f64);
        let mut sums = Sums::new(&self.head);
        for chunk in 0..plan.chunks() {
            let range = plan.range(chunk);
            control.progress.note(range.start as f64, whole);
            let mut rows = self.begin(range.start);
            // Nothing is kept, so that nothing can fail to be.
            if !self
                .append(&mut rows, range.end, control, |_| Ok(()))
                .ok()?
            {
                return None;
            }
            sums.take(&rows);
            take(&rows);
        }
        Some(sums.studied(self.head.clone(), self.display.clone()))
    }

    /// Computes what chunks lack; false where it is interrupted.
    ///
    /// # Errors
    /// Chunks that can't be kept or read.
    pub fn fill(&self, chunks: &dyn Chunks, control: &Control) -> Result<bool, ChunkFault> {
        let plan = self.head.plan();
        let to_do = chunks.to_do()?;
        let missing: u64 = to_do
            .iter()
            .map(|chunk| {
                let range = plan.range(*chunk);
                range.end - range.start
            })
            .sum();
        let whole = self.head.variants;
        let mut done = whole.saturating_sub(missing);
        for chunk in to_do {
            control.progress.note(done as f64, whole as f64);
            let mut rows = chunks.begun(chunk);
            let keep = |rows: &Rows| chunks.keep(chunk, rows);
            if !self.append(&mut rows, plan.range(chunk).end, control, keep)? {
                return Ok(false);
            }
            chunks.finish(chunk, &rows)?;
            done += rows.len() as u64;
        }
        Ok(true)
    }

    /// No rows yet, from a variant on.
    pub fn begin(&self, from: u64) -> Rows {
        Rows::new(from, self.head.inputs.len(), self.head.responses.len())
    }

    /// Appends rows until `end`, in their order; `keep` is given those that are done every two seconds, and when it is
    /// interrupted. Whether all are there.
    ///
    /// # Errors
    /// Those of `keep`.
    pub fn append(
        &self,
        rows: &mut Rows,
        end: u64,
        control: &Control,
        keep: impl FnMut(&Rows) -> Result<(), ChunkFault> + Send,
    ) -> Result<bool, ChunkFault> {
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
                let mut made: Vec<Made> = Vec::with_capacity(wanted);
                let all: Vec<Given> = all.map(|variant| self.values(variant)).collect();
                'rows: for some in all.chunks(ABREAST) {
                    self.expect(&mut member, some);
                    for own in some {
                        let Some(row) = self.row(&mut member, own, control) else {
                            break 'rows;
                        };
                        made.push(row);
                    }
                }
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

    /// Inputs of a variant, and what is given for them.
    fn values(&self, variant: u64) -> Given {
        let inputs = vec![0.0; self.inputs.inputs.len()];
        let mut own = [inputs.clone(), inputs];
        let [inputs, given] = &mut own;
        self.inputs.values(variant, inputs, given);
        own
    }

    /// Says which variants come next. A fault of linkdyn is left to the row that meets it.
    fn expect<'f>(&'f self, member: &mut Member<'f>, variants: &[Given]) {
        let given: Vec<&[f64]> = variants.iter().map(|[_, given]| &given[..]).collect();
        if caught(|| member.expect(&given)).is_err() {
            *member = self.family.begin();
        }
    }

    /// One variant; `None` if it was interrupted. A fault of linkdyn spoils this row alone.
    fn row<'f>(
        &'f self,
        member: &mut Member<'f>,
        [inputs, given]: &Given,
        control: &Control,
    ) -> Option<Made> {
        if control.interrupted.load(Ordering::Relaxed) {
            return None;
        }
        let mut responses = vec![f64::NAN; self.family.responses().len()];
        let reason = match caught(|| self.run(member, given, control, &mut responses)) {
            Ok(ended) => ended?,
            Err(said) => {
                *member = self.family.begin();
                responses.fill(f64::NAN);
                Some(format!("failed: {said}"))
            }
        };
        Some((reason, inputs.clone(), responses))
    }

    /// Why a variant has no result, where it has none; nothing where it was interrupted.
    fn run(
        &self,
        member: &mut Member,
        given: &[f64],
        control: &Control,
        responses: &mut [f64],
    ) -> Option<Option<String>> {
        // No deadline: a row depends on its number, not on the machine.
        let control = Control {
            interrupted: Arc::clone(&control.interrupted),
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
