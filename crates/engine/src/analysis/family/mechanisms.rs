//! The mechanisms of a family: values of parameters become numbers of a system.

use super::numbers::Numbers;
use crate::analysis::responses::{Evaluation, Responses};
use crate::system::System;
use crate::system::compile::compile;
use linkdyn_model::{Checked, Substituted, Substitution};
use std::sync::Arc;

/// How the numbers of a family that drivers move follow from those of its file, of a nominal mechanism whose forces matter or
/// not.
pub fn numbers(
    substitution: &Substitution,
    nominal: &System,
    with_forces: bool,
) -> Option<Numbers> {
    let mut paths = substitution.nominal_numbers();
    if !nominal.is_numbered(with_forces) || !paths.all(|(path, _)| path.starts_with("bodies.")) {
        return None;
    }
    let leaves = substitution.nominal_numbers().map(|(_, value)| value);
    let mut place = substitution.begin();
    Numbers::new(nominal, leaves.collect(), |leaves| {
        let model = substitution.put_numbers(leaves, &mut place)?;
        let kind = model.analysis.as_ref()?.kind;
        compile(model, kind).ok()
    })
}

/// One thread's maker of mechanisms.
pub struct Mechanisms<'f> {
    substitution: &'f Substitution,
    nominal: &'f [f64],
    /// How large the parameters are.
    lengths: &'f [f64],
    place: Substituted,
    mixed: Vec<f64>,
    /// How numbers follow without the compiler, and the mechanism that they are written into.
    numbers: Option<(&'f Numbers, System)>,
    /// Numbers of the file.
    leaves: Vec<f64>,
}

/// A mechanism of the family.
pub enum Variant {
    /// Its numbers have been written.
    Numbers,
    /// It has been compiled.
    System(Arc<System>),
}

impl<'f> Mechanisms<'f> {
    pub fn new(
        substitution: &'f Substitution,
        [nominal, lengths]: [&'f [f64]; 2],
        numbers: Option<(&'f Numbers, System)>,
    ) -> Self {
        Mechanisms {
            numbers,
            leaves: Vec::new(),
            substitution,
            nominal,
            lengths,
            place: substitution.begin(),
            mixed: Vec::with_capacity(nominal.len()),
        }
    }

    /// The nominal values, and how large the parameters are.
    pub fn nominal(&self) -> (&'f [f64], &'f [f64]) {
        (self.nominal, self.lengths)
    }

    /// The model with values; `None` if only reading can tell what is wrong with it.
    pub fn model(&mut self, values: &[f64]) -> Option<&Checked> {
        self.substitution.put(values, &mut self.place)
    }

    fn mix(&mut self, values: &[f64], part: f64) {
        self.mixed.clear();
        let both = values.iter().zip(self.nominal);
        self.mixed.extend(both.map(|(value, nominal)| {
            if part == 1.0 {
                *value
            } else {
                nominal + (value - nominal) * part
            }
        }));
    }

    /// The same mechanism, as numbers where they tell it.
    pub fn make(&mut self, values: &[f64], part: f64, numbers: &mut Vec<f64>) -> Option<Variant> {
        let Some((known, _)) = &self.numbers else {
            return Some(Variant::System(Arc::new(self.at(values, part)?)));
        };
        let known = *known;
        self.mix(values, part);
        let (leaves, place) = (&mut self.leaves, &mut self.place);
        let are_sound = self.substitution.numbers(&self.mixed, place, leaves);
        are_sound.then(|| {
            known.write(leaves, numbers);
            Variant::Numbers
        })
    }

    /// The mechanism with such numbers.
    pub fn written(&mut self, numbers: &[f64]) -> Option<&System> {
        let (_, system) = self.numbers.as_mut()?;
        let mut numbers = numbers.iter();
        system.renumber(&mut |own| numbers.next().copied().unwrap_or(own));
        Some(system)
    }

    /// The mechanism at a part of the way from the nominal values to those given.
    pub fn at(&mut self, values: &[f64], part: f64) -> Option<System> {
        self.mix(values, part);
        let model = self.substitution.put(&self.mixed, &mut self.place)?;
        let kind = model.analysis.as_ref()?.kind;
        compile(model, kind).ok()
    }

    /// Tells responses the parameters that they name, of a mechanism with values.
    pub fn tell(&mut self, values: &[f64], responses: &Responses, evaluation: &mut Evaluation) {
        let named = responses.list().iter();
        let mut named = named.flat_map(|response| &response.parameters).peekable();
        if named.peek().is_some() {
            self.substitution.evaluate(values, &mut self.place);
        }
        for name in named {
            if let Some(value) = self.parameter(name) {
                evaluation.set_parameter(name, value);
            }
        }
    }

    /// The value of a parameter that a response names, in the mechanism made last.
    pub fn parameter(&self, name: &str) -> Option<f64> {
        self.substitution.value(name, &self.place)
    }
}
