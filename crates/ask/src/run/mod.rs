//! Runs of a model's analysis.

mod largest;
mod text;
mod tuned;

use std::io::{self, Write};
use std::time::Duration;

use linkdyn_engine::analysis::derived::derived;
use linkdyn_engine::analysis::responses::to_json;
use linkdyn_engine::analysis::{Control, Outcome, Prepared};
use linkdyn_model::error::Complaints;
use linkdyn_model::{Checked, Model};
use linkdyn_output::{Stage, Summary, Trajectory};
use linkdyn_picture::{Report, Shape};
use web_time::Instant;

use crate::shape::{with_loads, with_profiles};
use crate::text::responses::for_page;
use crate::{ModelFile, Question, Unanswered};
pub use text::text;
pub use tuned::{parameters, tuned, typed, with_values};

/// Asks for a run of the model's analysis.
#[derive(Debug, Clone, Copy, Default)]
pub struct Run;

/// How the run ended stands in its report.
impl Question for Run {
    type Answer = Outcome;

    fn answer(&self, file: &ModelFile, control: &Control) -> Result<Outcome, Unanswered> {
        unplaced(file, control).map_err(|complaints| file.refused(complaints))
    }
}

/// The same; complaints have no places in the file.
pub(crate) fn unplaced(file: &ModelFile, control: &Control) -> Result<Outcome, Complaints> {
    let control = limited(file.model(), control);
    let outcome = Prepared::new(file.model())?.run(&control)?;
    Ok(warned(outcome, &file.loaded.warnings))
}

/// A run whose page nobody wants: its rows have the columns alone that `analysis.columns` asks for, where nothing else is read from
/// them.
///
/// # Errors
/// Those of the question [`Run`].
pub fn of_columns(file: &ModelFile, control: &Control) -> Result<Outcome, Unanswered> {
    let run = || {
        let prepared = Prepared::new(file.model())?;
        // The summary draws what loads are over time, from all poses.
        let is_drawn = !Shape::of_model(file.model()).loads.is_empty();
        let prepared = if is_drawn {
            prepared
        } else {
            prepared.for_columns()
        };
        prepared.run(&limited(file.model(), control))
    };
    let outcome = run().map_err(|complaints| file.refused(complaints))?;
    Ok(warned(outcome, &file.loaded.warnings))
}

/// The control of a run that also ends when the model's `max_wall_time` is over.
pub fn limited(model: &Model, control: &Control) -> Control {
    let seconds = || model.analysis.as_ref()?.solver.max_wall_time;
    let own = || {
        let wait = Duration::try_from_secs_f64(seconds()?).ok()?;
        Instant::now().checked_add(wait)
    };
    Control {
        deadline: [control.deadline, own()].into_iter().flatten().min(),
        ..control.clone()
    }
}

/// The outcome with the warnings of the file before its own.
pub fn warned(mut outcome: Outcome, warnings: &[String]) -> Outcome {
    let warnings = warnings.iter().cloned();
    outcome.report.warnings.splice(0..0, warnings);
    outcome
}

/// What the files of a run say of its model.
#[derive(Debug, Clone, Copy)]
pub struct Origin<'a> {
    /// The model that ran.
    pub model: &'a Checked,
    /// The model's own name, or the file's.
    pub name: &'a str,
    /// Of the file's bytes, hexadecimal.
    pub sha256: &'a str,
    /// Time that reading it took.
    pub load: Stage,
}

impl ModelFile {
    /// What the files of a run say of the model.
    pub fn origin(&self) -> Origin<'_> {
        Origin {
            model: self.model(),
            name: self.name(),
            sha256: &self.text.sha256,
            load: self.time,
        }
    }
}

impl<'a> Origin<'a> {
    /// The summary of a run, without the mechanism's shape and the time of writing.
    fn facts(self, outcome: &'a Outcome, curves: &'a Trajectory) -> Summary<'a> {
        Summary {
            model_name: self.name,
            model_sha256: self.sha256,
            settings: &outcome.settings,
            responses: to_json(&outcome.responses),
            report: &outcome.report,
            trajectory: curves,
            mechanism: serde_json::Value::Null,
            drawing: serde_json::Value::Null,
            load: self.load,
            write: Stage::default(),
        }
    }

    /// The text of `summary.json`; `write` is the time that the other files took.
    pub fn summary(self, outcome: &Outcome, write: Stage) -> String {
        let shape = with_loads(self.model, outcome.all());
        let curves = outcome.curves();
        linkdyn_output::summary::to_text(&Summary {
            mechanism: shape.to_json(),
            drawing: shape.to_drawing(),
            write,
            ..self.facts(outcome, &curves)
        })
    }

    /// The text of `report.html`.
    pub fn html(self, outcome: &Outcome) -> String {
        let mut text = Vec::new();
        self.write_page(outcome, &mut text)
            .expect("memory takes it");
        String::from_utf8(text).expect("it is made of texts")
    }

    /// Writes `report.html`, piece by piece.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn write_page(self, outcome: &Outcome, out: &mut impl Write) -> io::Result<()> {
        self.with_report(outcome, |report| report.write(out))
    }

    /// The data of that page alone, for a page that stays: JSON, a line feed, and the numbers in base64.
    pub fn data(self, outcome: &Outcome) -> String {
        let mut text = Vec::new();
        self.with_report(outcome, |report| report.write_data(&mut text))
            .expect("memory takes it");
        String::from_utf8(text).expect("it is made of texts")
    }

    /// The same with the numbers as they are, column after column: for a page that the engine runs in.
    pub fn numbers(self, outcome: &Outcome) -> (String, Vec<f64>) {
        self.with_report(outcome, |report| report.data())
    }

    /// Lets `write` have what the page is made of.
    fn with_report<T>(self, outcome: &Outcome, write: impl FnOnce(&Report) -> T) -> T {
        let (curves, complete) = (outcome.curves(), outcome.all_curves());
        let summary = Summary {
            responses: for_page(&outcome.responses, &self.model.display),
            ..self.facts(outcome, &curves)
        };
        let (derived, mut notes) = derived(self.model, &complete);
        if !outcome.peaks.is_empty() {
            notes.push(format!(
                "Besides the {} outputs this page has {} instants between them: where columns have their smallest or largest value, \
                 and where contacts begin, press most and end.",
                outcome.trajectory.len(),
                outcome.peaks.len()
            ));
        }
        let report = Report {
            derived: Some(&derived),
            notes,
            shape: with_profiles(self.model),
            ..Report::new(self.model, &summary, &complete)
        };
        write(&report)
    }
}
