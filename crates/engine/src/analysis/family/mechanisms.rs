//! The mechanisms of a family: values of parameters become numbers of a system.

use crate::analysis::responses::{Evaluation, Responses};
use crate::system::System;
use crate::system::compile::compile;
use linkdyn_model::{Checked, Substituted, Substitution};

/// One thread's maker of mechanisms.
pub struct Mechanisms<'f> {
    substitution: &'f Substitution,
    nominal: &'f [f64],
    place: Substituted,
    mixed: Vec<f64>,
}

impl<'f> Mechanisms<'f> {
    pub fn new(substitution: &'f Substitution, nominal: &'f [f64]) -> Self {
        Mechanisms {
            substitution,
            nominal,
            place: substitution.begin(),
            mixed: Vec::with_capacity(nominal.len()),
        }
    }

    /// The model with values; `None` if only reading can tell what is wrong with it.
    pub fn model(&mut self, values: &[f64]) -> Option<&Checked> {
        self.substitution.put(values, &mut self.place)
    }

    /// The mechanism at a part of the way from the nominal values to those given.
    pub fn at(&mut self, values: &[f64], part: f64) -> Option<System> {
        self.mixed.clear();
        let both = values.iter().zip(self.nominal);
        self.mixed.extend(both.map(|(value, nominal)| {
            if part == 1.0 {
                *value
            } else {
                nominal + (value - nominal) * part
            }
        }));
        let model = self.substitution.put(&self.mixed, &mut self.place)?;
        let kind = model.analysis.as_ref()?.kind;
        compile(model, kind).ok()
    }

    /// Tells responses the parameters that they name, of the mechanism made last.
    pub fn tell(&self, responses: &Responses, evaluation: &mut Evaluation) {
        for response in responses.list() {
            for name in &response.parameters {
                if let Some(value) = self.parameter(name) {
                    evaluation.set_parameter(name, value);
                }
            }
        }
    }

    /// The value of a parameter that a response names, in the mechanism made last.
    pub fn parameter(&self, name: &str) -> Option<f64> {
        self.substitution.value(name, &self.place)
    }
}
