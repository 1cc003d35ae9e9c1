//! The models that every law is tried on: the bundled ones and those of the reference cases.

use linkdyn_engine::analysis::{Control, Outcome, run};
use linkdyn_model::{Checked, Model, bundled};
use linkdyn_validation::{CASES, CaseKind};
use serde_json::Value;

/// A model as JSON, with its name for messages.
#[derive(Debug, Clone)]
pub struct Named {
    pub name: String,
    pub json: Value,
}

/// All bundled models and all models of reference cases.
pub fn all() -> Vec<Named> {
    let bundled = bundled::MODELS.iter().map(|bundled| Named {
        name: bundled.name.to_string(),
        json: serde_json::from_str(bundled.text).expect("valid JSON"),
    });
    let cases = CASES.iter().filter_map(|case| match case.kind {
        CaseKind::Reference(reference) => {
            let words = reference.read().expect("valid words");
            words.model.is_object().then(|| Named {
                name: format!("case {}", case.name),
                json: words.model,
            })
        }
        CaseKind::Coded { .. } => None,
    });
    bundled.chain(cases).collect()
}

/// A bundled model with some values set.
pub fn load_bundled(name: &str, sets: &[&str]) -> Model {
    let text = bundled::find(name).expect("bundled").text;
    let sets: Vec<String> = sets.iter().map(|set| set.to_string()).collect();
    linkdyn_model::load(text.as_bytes(), &sets)
        .unwrap_or_else(|said| panic!("{name}: {said:?}"))
        .model
        .into_model()
}

/// The model that a JSON text says.
#[track_caller]
pub fn load(json: &Value) -> Model {
    linkdyn_model::load(json.to_string().as_bytes(), &[])
        .unwrap_or_else(|said| panic!("{said:?}\n{json:#}"))
        .model
        .into_model()
}

/// The model, legal.
#[track_caller]
pub fn checked(model: &Model) -> Checked {
    model
        .clone()
        .check()
        .unwrap_or_else(|said| panic!("{said}"))
}

/// Runs a model's analysis.
#[track_caller]
pub fn solve(model: &Model) -> Outcome {
    run(&checked(model), &Control::default()).unwrap_or_else(|said| panic!("{said:?}"))
}

/// Values of a column.
#[track_caller]
pub fn values(outcome: &Outcome, column: &str) -> Vec<f64> {
    outcome
        .trajectory
        .values(column)
        .unwrap_or_else(|| panic!("no column {column}"))
}
