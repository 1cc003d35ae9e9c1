//! What tolerances and clearances do to the outputs of a mechanism.

mod csv;
mod json;
mod levels;
mod page;
mod text;
mod zones;

use std::num::NonZeroUsize;

use linkdyn_engine::analysis::Control;
use linkdyn_model::{Checked, Parameter};
use linkdyn_variation::{Accuracy as Found, Levels, Of, Parameters, Refusal, Scope, accuracy};

use crate::{ModelFile, Question, Unanswered};

pub use zones::{Zone, zones};

/// Asks what tolerances and clearances do to outputs.
#[derive(Debug, Clone, Default)]
pub struct Accuracy {
    /// Outputs of the model's `accuracy`; none: all.
    pub outputs: Vec<String>,
    /// How much is worked out; none: what the model says.
    pub levels: Option<Levels>,
    /// Threads that share the poses of a stroke; none: one.
    pub threads: Option<NonZeroUsize>,
}

/// What tolerances and clearances do to outputs.
#[derive(Debug)]
pub struct Deviations {
    /// The model.
    pub file: ModelFile,
    /// What the engine found.
    pub found: Found,
}

impl Question for Accuracy {
    type Answer = Deviations;

    fn answer(&self, file: &ModelFile, control: &Control) -> Result<Deviations, Unanswered> {
        self.answer_with(file, &file.loaded.parameters, control)
    }
}

impl Accuracy {
    /// The same with other tolerances of the parameters.
    pub(crate) fn answer_with(
        &self,
        file: &ModelFile,
        known: &[Parameter],
        control: &Control,
    ) -> Result<Deviations, Unanswered> {
        let scope = Scope {
            of: Of::Outputs(&self.outputs),
            levels: self.levels,
            threads: self.threads,
        };
        Ok(Deviations {
            file: file.clone(),
            found: found(file, known, scope, control)?,
        })
    }
}

/// The answer of the engine, with all that follows from the parameters.
fn found(
    file: &ModelFile,
    known: &[Parameter],
    scope: Scope,
    control: &Control,
) -> Result<Found, Unanswered> {
    let loaded = &file.loaded;
    let limits: Vec<[f64; 2]> = known
        .iter()
        .map(|parameter| {
            let tolerance = parameter.tolerance.as_ref();
            tolerance.map_or([0.0; 2], |tolerance| {
                [tolerance.lower.min(0.0), tolerance.upper.max(0.0)]
            })
        })
        .collect();
    let with = |by: &[(usize, f64)]| -> Option<Checked> {
        let named: Vec<(&str, f64)> = by
            .iter()
            .map(|&(index, by)| (known[index].name.as_str(), by))
            .collect();
        loaded.source.with_deviations(&named).ok()
    };
    let dependence = loaded.source.dependence();
    let parameters = Parameters {
        all: known,
        derivatives: &dependence.at(&[]),
        enclosed: &|| dependence.within(&limits),
        with: &with,
    };
    let found = accuracy(&loaded.model, &parameters, scope, control);
    found.map_err(|why| match why {
        Refusal::Input(complaints) => file.refused(complaints),
        Refusal::Failed(message) => Unanswered::Failed(message),
    })
}
