//! A run of the model with a rung of the ladder of clearance models.

use std::sync::Arc;

use linkdyn_engine::analysis::{Control, Outcome};
use linkdyn_model::Checked;
use linkdyn_model::error::{Complaint, Complaints};
use linkdyn_output::Channel;

use super::question::Compare;
use crate::ModelFile;

/// What came of a clearance model.
#[derive(Debug)]
pub struct Rung {
    /// Word of the clearance model.
    pub model: &'static str,
    /// The model and its run, or why there is none.
    pub ran: Result<(ModelFile, Outcome), String>,
}

/// The models that ran.
pub fn ran(rungs: &[Rung]) -> impl Iterator<Item = (&'static str, &Outcome)> {
    rungs
        .iter()
        .filter_map(|rung| Some((rung.model, &rung.ran.as_ref().ok()?.1)))
}

/// Runs with one clearance model, with the columns that are compared; else why it can't be run.
pub fn run(
    compare: &Compare,
    file: &ModelFile,
    joints: &[String],
    model: &str,
    control: &Control,
) -> Result<(ModelFile, Outcome), String> {
    let set = |joint: &String| format!("joints.{joint}.clearance.model={model}");
    let sets: Vec<String> = joints.iter().map(set).collect();
    let ran = || -> Result<(ModelFile, Outcome), Complaints> {
        let mut file = file.with(&sets)?;
        if let Some(model) = asking(file.model(), &compare.columns)? {
            Arc::make_mut(&mut file.loaded).model = model;
        }
        let outcome = crate::run::unplaced(&file, control)?;
        Ok((file, outcome))
    };
    ran().map_err(|complaints| reason(&complaints))
}

/// The model that asks for columns that results have only then, where some of these are.
fn asking(model: &Checked, patterns: &[String]) -> Result<Option<Checked>, Complaints> {
    let waits = |pattern: &&String| {
        let channel = Channel::read(pattern);
        matches!(
            channel,
            Some((Channel::Relative(..) | Channel::Load(..), _))
        )
    };
    let asked: Vec<String> = patterns.iter().filter(waits).cloned().collect();
    if asked.is_empty() {
        return Ok(None);
    }
    let asking = model.edit(|model| {
        if let Some(analysis) = &mut model.analysis {
            if analysis.columns.is_empty() {
                analysis.columns.push("*".to_owned());
            }
            analysis.columns.extend(asked);
        }
    })?;
    Ok(Some(asking))
}

/// Complaints as a line; where they stand in the file does not matter here.
fn reason(complaints: &[Complaint]) -> String {
    let said = complaints.iter().map(
        |Complaint {
             path,
             message,
             hint,
             ..
         }| {
            let hint = hint
                .as_ref()
                .map(|hint| format!(" ({hint})"))
                .unwrap_or_default();
            format!("{path}: {message}{hint}")
        },
    );
    said.collect::<Vec<_>>().join("; ")
}
