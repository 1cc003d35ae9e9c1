//! What a question puts into a model, so that it is checked where the file is; complaints about it name the question.

use std::sync::Arc;

use linkdyn_model::error::{Complaint, Complaints};
use serde_json::{Value, json};

use crate::model_file::{ModelFile, Text};
use crate::unanswered::Unanswered;

/// Something that is put into a model.
#[derive(Debug)]
pub struct Put {
    /// `PATH=VALUE`.
    pub set: String,
    /// Paths at which faults of it are found, each with the words of the user.
    pub labels: Vec<(String, String)>,
}

impl Put {
    /// A value at a path, which the user gave in these words.
    pub fn new(path: String, value: impl std::fmt::Display, label: String) -> Self {
        Put {
            set: format!("{path}={value}"),
            labels: vec![(path, label)],
        }
    }
}

/// A number, or text with a unit.
pub(crate) fn number(text: &str) -> Value {
    let text = text.trim();
    match text.parse::<f64>() {
        Ok(number) if number.is_finite() => json!(number),
        Ok(_) | Err(_) => json!(text),
    }
}

/// Reads a model with values set, and with what is put into it besides.
///
/// # Errors
/// All faults of the model, and of what is put into it.
pub fn read(text: &Arc<Text>, sets: &[String], puts: &[Put]) -> Result<ModelFile, Complaints> {
    let own = puts.iter().map(|put| put.set.clone()).collect();
    let file = ModelFile::read_with(Arc::clone(text), sets.to_vec(), own);
    file.map_err(|complaints| relabelled(complaints, puts))
}

/// Complaints about what was put into the model name it in the words of the user.
pub(crate) fn relabelled(complaints: Complaints, puts: &[Put]) -> Complaints {
    let label = |complaint: &Complaint| {
        let found = complaint.found.as_deref();
        let is_set = found.is_some_and(|found| found.starts_with("--set "));
        let is_it = |path: &String| {
            let rest = complaint.path.strip_prefix(path.as_str());
            rest.is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '[']))
        };
        let mut all = puts.iter().flat_map(|put| &put.labels);
        let found = all.find(|(path, _)| is_it(path));
        let found = found.map(|(_, label)| label.clone());
        found.filter(|_| is_set || complaint.place.is_none())
    };
    let told = complaints.into_iter().map(|mut complaint| {
        if let Some(label) = label(&complaint) {
            complaint.found = None;
            complaint.path = label;
        }
        complaint
    });
    let mut told: Vec<Complaint> = told.collect();
    told.dedup();
    Complaints(told)
}

/// Reads a model with more responses, each `NAME = EXPRESSION`.
///
/// # Errors
/// What is no response; all faults of the model with them.
pub fn with_responses(
    text: &Arc<Text>,
    sets: &[String],
    asked: &[String],
) -> Result<ModelFile, Unanswered> {
    let mut puts = Vec::new();
    let mut faults = Vec::new();
    for text in asked {
        let parts = text.split_once('=');
        match parts.map(|(name, rest)| (name.trim(), rest.trim())) {
            Some((name, rest)) if is_name(name) && !rest.is_empty() => {
                let label = format!("--response {text:?}");
                puts.push(Put::new(format!("responses.{name}"), rest, label));
            }
            Some(_) | None => faults.push(format!(
                "--response {text:?}: a name and an expression are expected (as in \"stroke = max(piston.x) - min(piston.x)\")"
            )),
        }
    }
    if !faults.is_empty() {
        return Err(Unanswered::Question(faults));
    }
    Ok(read(text, sets, &puts)?)
}

/// Whether a response can have this name.
fn is_name(name: &str) -> bool {
    !name.is_empty() && !name.contains(|c: char| ".[],=*?".contains(c) || c.is_control())
}
