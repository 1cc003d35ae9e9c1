//! What the packages for other languages need in addition to the public items. It changes without notice.

use std::path::{Path, PathBuf};

use linkdyn_ask::run::{parameters, with_values};
use linkdyn_ask::{ModelFile, study};
use linkdyn_engine::analysis::Control;
use linkdyn_exchange::{Format, LeftOut, Options, Refused};
use linkdyn_model::FileAccess;
use linkdyn_output::{Column, Event, Stage};
use linkdyn_study::chunks::Shard;

use crate::error::Error;
use crate::family::Family;
use crate::mechanism::Mechanism;
use crate::run::Run;
use crate::studies;

pub use linkdyn_ask::caught;
pub use linkdyn_engine::analysis::Progress;
pub use linkdyn_engine::system::{System, Terms};

/// Reads a model file with this name. Its tables are in the folder of the path, or in folders that are allowed.
///
/// # Errors
/// [`Error::Model`] with all faults of the model.
pub fn read(
    stem: &str,
    text: &[u8],
    path: &Path,
    allowed: Vec<PathBuf>,
) -> Result<Mechanism, Error> {
    let path = path.to_owned();
    Mechanism::read_with_access(stem, text.to_vec(), FileAccess { path, allowed })
}

/// A file of another program as the text of a model, and what that lacks. `format` is one of [`linkdyn_exchange::Format::word`].
///
/// # Errors
/// [`Error::Foreign`] where it can't be read.
pub fn imported(
    name: &str,
    bytes: &[u8],
    format: Option<&str>,
    length: Option<String>,
) -> Result<(String, Vec<(String, String)>), Error> {
    let word = |word: &str| {
        let known = Format::ALL.into_iter().find(|format| format.word() == word);
        let words = Format::ALL.map(Format::word).join(", ");
        let cause = format!("{word:?} is no format");
        known.ok_or_else(|| Refused::new("format", cause, words))
    };
    let format = format.map(word).transpose()?;
    let read = linkdyn_exchange::import(name, bytes, format, &Options { length })?;
    let left_out = read.left_out.into_iter();
    let left_out = left_out.map(|LeftOut { place, what }| (place, what));
    Ok((read.draft.text(), left_out.collect()))
}

/// The mechanism with values of its model set at once, each as `PATH=VALUE`: what is legal only together can be set.
///
/// # Errors
/// [`Error::Model`] where a path leads nowhere, or the model has faults with these values.
pub fn set(mechanism: &Mechanism, sets: Vec<String>) -> Result<Mechanism, Error> {
    mechanism.set_all(sets)
}

/// The parameters that have numbers of their own: names, numbers in the file's units, and these units.
///
/// # Errors
/// As [`Mechanism::ask`].
pub fn knobs(mechanism: &Mechanism) -> Result<Vec<(String, f64, String)>, Error> {
    let all = parameters(&mechanism.as_file()?).into_iter();
    Ok(all.map(|knob| (knob.name, knob.value, knob.unit)).collect())
}

/// The text of the mechanism's file with other numbers for such parameters; all other characters stay.
///
/// # Errors
/// A parameter that has no number in the file.
pub fn rewritten(mechanism: &Mechanism, values: &[(&str, f64)]) -> Result<String, Error> {
    let text = with_values(&mechanism.as_file()?, values)?;
    Ok(String::from_utf8_lossy(&text).into_owned())
}

/// What a text such as `90 mm` says in SI, and its SI unit.
///
/// # Errors
/// A text that is no quantity.
pub fn quantity(text: &str) -> Result<(f64, String), Error> {
    let read = study::quantity(text.trim());
    let read = read.map_err(|why| Error::Question(vec![why]))?;
    Ok((read.value, read.unit))
}

/// The text of `summary.json`; it has no time of writing files, as none were written.
pub fn summary(run: &Run) -> String {
    run.mechanism()
        .origin()
        .summary(run.outcome(), Stage::default())
}

/// An event as in `summary.json`.
pub fn event(event: &Event) -> String {
    event.to_json().to_string()
}

/// The columns of `results.csv`; all others were computed, too, where `analysis.columns` leaves some out.
pub fn wanted(run: &Run) -> &[Column] {
    &run.outcome().trajectory.columns
}

/// Names and SI units of the responses of a family, in their order.
pub fn responses(family: &Family) -> Vec<(String, String)> {
    let owned = |(name, unit): (&str, &str)| (name.to_owned(), unit.to_owned());
    family.responses().map(owned).collect()
}

/// A study of a mechanism, whose rows can be had, and kept in directories share by share.
pub struct Variants(study::Variants);

/// What a study comes to as JSON, in words and as a page.
pub struct Studied {
    /// `study.json`.
    pub json: String,
    /// The same in words.
    pub text: String,
    /// `report.html`, where that is wanted and no file.
    pub page: Option<String>,
}

/// The rows of a study: how each ended, and inputs and responses \[SI\], row by row.
#[derive(Default)]
pub struct Rows {
    /// `completed`, or why it has no result.
    pub statuses: Vec<String>,
    /// (variants, inputs and responses); NaN where there is none.
    pub values: Vec<f64>,
}

impl Variants {
    /// Of a question, or of what the model says if there is none. The responses come in addition to those of the model.
    ///
    /// # Errors
    /// A question that does not fit the model.
    pub fn new(
        mechanism: &Mechanism,
        question: Option<&study::Study>,
        seed: Option<u64>,
        responses: &[String],
    ) -> Result<Self, Error> {
        let file = mechanism.as_file()?;
        let file = linkdyn_ask::with_responses(&file.text, &file.sets, responses)?;
        let own = || study::Study::of_model(&file, seed).unwrap_or_default();
        let question = question.cloned().unwrap_or_else(own);
        Ok(Variants(question.variants(&file)?))
    }

    /// What the study is: `study.json` before anything was computed.
    pub fn plan(&self) -> String {
        studies::plan(&self.0)
    }

    /// Names and SI units of inputs and responses.
    pub fn columns(&self) -> Vec<(String, String)> {
        let head = &self.0.head;
        let inputs = head.inputs.iter().map(|own| (&own.name, &own.unit));
        let responses = head.responses.iter().map(|own| (&own.name, &own.unit));
        let both = inputs.chain(responses);
        both.map(|(name, unit)| (name.clone(), unit.clone()))
            .collect()
    }

    /// Computes all variants, or `None` if it is interrupted.
    pub fn run(&self, control: &Control, page: bool) -> Option<(Studied, Rows)> {
        let mut all = Rows::default();
        let studied = self.0.answer(control, |rows| {
            for row in rows.iter() {
                all.statuses
                    .push(row.reason.unwrap_or("completed").to_owned());
                all.values.extend(row.inputs.iter().chain(row.responses));
            }
        })?;
        let page = page.then(|| studied.html(Some((&self.0, control))));
        Some((Studied::new(&studied, page), all))
    }

    /// Computes what a share of the chunks in a directory lacks; false where it is interrupted.
    ///
    /// # Errors
    /// A directory of another study, files that can't be written.
    pub fn share(
        &self,
        directory: &Path,
        [index, of]: [u64; 2],
        control: &Control,
    ) -> Result<bool, Error> {
        let shard = Shard::new(index, of);
        let shard = shard.map_err(|fault| Error::Question(vec![fault.to_string()]))?;
        studies::Kept::begin(directory, &self.0)?.fill(&self.0, shard, control)
    }

    /// Computes what is missing in a directory, and writes all files, or `None` if it is interrupted.
    ///
    /// # Errors
    /// A directory of another study, files that can't be written.
    pub fn join(
        &self,
        directory: &Path,
        page: bool,
        control: &Control,
    ) -> Result<Option<Studied>, Error> {
        let kept = studies::Kept::begin(directory, &self.0)?;
        if !kept.fill(&self.0, Shard::WHOLE, control)? {
            return Ok(None);
        }
        let files = studies::Files {
            page,
            parquet: false,
        };
        let (studied, _) = kept.join(Some((&self.0, control)), files)?;
        Ok(Some(Studied::new(&studied, None)))
    }
}

impl Studied {
    fn new(studied: &study::Studied, page: Option<String>) -> Self {
        Studied {
            json: studies::text(studied),
            text: studied.text().to_string(),
            page,
        }
    }
}

/// Does a work by so many threads, one for each processor where that is 0.
///
/// # Errors
/// The system gives no threads.
pub fn by_threads<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> Result<T, Error> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    let pool = pool.map_err(|error| Error::Question(vec![format!("no threads: {error}")]))?;
    Ok(pool.install(work))
}

/// An answer as JSON and in words, and its page where there is one.
pub fn told(
    answer: &impl serde::Serialize,
    words: linkdyn_ask::text::Page,
    page: Option<String>,
) -> (String, String, Option<String>) {
    (studies::text(answer), words.to_string(), page)
}

/// The mechanism of a model that a question gave.
///
/// # Errors
/// [`Error::Model`] where it can't be compiled.
pub fn mechanism(file: ModelFile) -> Result<Mechanism, Error> {
    Mechanism::of_file(file)
}

/// Names of the bundled models.
pub fn bundled() -> Vec<String> {
    linkdyn_model::bundled::names().map(str::to_owned).collect()
}

/// The equations that a mechanism was compiled to.
///
/// # Errors
/// [`Error::Model`] where the model has no analysis, or lacks what it needs.
pub fn system(mechanism: &Mechanism) -> Result<&System, Error> {
    Ok(mechanism.prepared()?.system())
}
