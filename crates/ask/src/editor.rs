//! What an editor asks of a model: words of other questions by name, and a picture of whatever there is to draw.

use linkdyn_engine::analysis::{Control, Outcome};
use linkdyn_model::DriverKind;
use linkdyn_output::Status;

use crate::accuracy::Accuracy;
use crate::check::Check;
use crate::modes::Modes;
use crate::run::{self, Run};
use crate::study::Study;
use crate::text::Page;
use crate::{ModelFile, Question, Unanswered};

/// The answer to the question with the name of a command, in the words of this command; nothing for a name that is none of
/// `check`, `statics`, `modes`, `accuracy` and `study`.
///
/// # Errors
/// Why it has no answer.
pub fn words(file: &ModelFile, name: &str, control: &Control) -> Result<Option<Page>, Unanswered> {
    Ok(Some(match name {
        "check" => Check.answer(file, control)?.text(),
        "statics" => {
            let file = file.with(&["analysis={\"type\":\"statics\"}".to_owned()])?;
            run::text(&file, &Run.answer(&file, control)?)
        }
        "modes" => Modes::default().answer(file, control)?.text(),
        "accuracy" => Accuracy::default().answer(file, control)?.text(),
        "study" => {
            let study = Study::of_model(file, None).unwrap_or_default();
            study.answer(file, control)?.text()
        }
        _ => return Ok(None),
    }))
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
pub fn drawn(file: &ModelFile, control: &Control) -> Result<(ModelFile, Outcome), Unanswered> {
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
