//! The responses of a study: those of the model, and those of the command, which are put into it.

use super::head::Asked;
use crate::cli::exit::BadInput;
use crate::cli::open::Opened;
use linkdyn_engine::analysis::{Outcome, Prepared};
use linkdyn_study::summary::Limits;

/// What comes out of each variant.
pub struct Responses {
    asked: Vec<Asked>,
}

impl Responses {
    /// Those of a model.
    ///
    /// # Errors
    /// A model without any, an analysis that can't be run, names that it does not have.
    pub fn new(opened: &Opened) -> Result<Self, BadInput> {
        let model = &opened.loaded.model;
        if model.responses.is_empty() {
            return Err(BadInput(vec![format!(
                "{}: it has no responses, which a study asks for: add --response \"stroke = max(piston.x) - min(piston.x)\", or \"responses\" to the model",
                opened.label
            )]));
        }
        let refuse = |complaints| opened.bad_input(complaints);
        let prepared = Prepared::new(model).map_err(refuse)?;
        let asked = prepared.responses().list().iter().map(|own| Asked {
            name: own.name.clone(),
            unit: own.unit.clone(),
            value: own.text.clone(),
            limits: own
                .limits
                .map_or_else(Limits::default, |[lower, upper]| Limits {
                    lower: Some(lower),
                    upper: Some(upper),
                }),
        });
        Ok(Responses {
            asked: asked.collect(),
        })
    }

    /// What is told of them.
    pub fn asked(&self) -> &[Asked] {
        &self.asked
    }

    /// The values of a run of a variant, NaN where there is none, and which has none first.
    pub fn values(&self, outcome: &Outcome) -> (Option<String>, Vec<f64>) {
        let answers = &outcome.responses;
        let missing = answers.iter().find(|answer| answer.value.is_none());
        let missing = missing.map(|answer| format!("no value of {}", answer.name));
        let values = answers
            .iter()
            .map(|answer| answer.value.unwrap_or(f64::NAN));
        (missing, values.collect())
    }
}
