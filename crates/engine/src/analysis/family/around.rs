//! The mechanisms around one: one parameter more or less by some steps.

use super::mechanisms::Mechanisms;
use super::needs::Needs;
use super::stencil::{PLACES, STEP, StencilSums};
use crate::analysis::derived::Derived;
use crate::analysis::responses::{Dual, Evaluation, Responses};
use crate::system::System;

/// The mechanisms around one along one parameter.
pub struct Around {
    /// At each of the places.
    pub systems: Vec<System>,
    /// \[SI of the parameter\]
    pub step: f64,
    /// Derivatives of the parameters that responses name, those of a response behind each other; NaN where they have none.
    pub named: Vec<f64>,
}

impl Around {
    /// Around values along each parameter, which matter over some lengths.
    pub fn all(
        mechanisms: &mut Mechanisms,
        responses: &Responses,
        values: &[f64],
        lengths: &[f64],
    ) -> Vec<Option<Self>> {
        let numbers = lengths.iter().copied().enumerate();
        numbers
            .map(|number| Around::new(mechanisms, responses, values, number))
            .collect()
    }

    /// The parameters that responses name, with their derivatives.
    pub fn parameters(arounds: &[Option<Self>], evaluation: &Evaluation) -> Vec<Dual<f64>> {
        evaluation.parameters_with(arounds.len(), |place, k| {
            let around = arounds[k].as_ref();
            around.map_or(f64::NAN, |around| around.named[place])
        })
    }

    /// What makes of rows what follows from them, of each of the mechanisms along each parameter.
    pub fn derived<'a>(arounds: &'a [Option<Self>], needs: &Needs) -> Vec<Vec<Derived<'a>>> {
        let mut all = Vec::with_capacity(arounds.len());
        for around in arounds {
            let systems = around.iter().flat_map(|around| &around.systems);
            all.push(systems.filter_map(|system| needs.derived(system)).collect());
        }
        all
    }

    /// Around values along parameter `k`, which matters over some length; `None` if one of these mechanisms can't be made by
    /// putting in numbers.
    pub fn new(
        mechanisms: &mut Mechanisms,
        responses: &Responses,
        values: &[f64],
        (k, length): (usize, f64),
    ) -> Option<Self> {
        let step = STEP * length;
        if !(step > 0.0 && step.is_finite()) {
            return None;
        }
        let names = || responses.list().iter().flat_map(|own| &own.parameters);
        let mut named = StencilSums::new(names().count());
        named.begin(step);
        let mut row = vec![0.0; names().count()];
        let mut moved = values.to_vec();
        let mut systems = Vec::with_capacity(PLACES.len());
        for place in PLACES {
            moved[k] = values[k] + place * step;
            systems.push(mechanisms.at(&moved, 1.0)?);
            for (value, name) in row.iter_mut().zip(names()) {
                *value = mechanisms.parameter(name).unwrap_or(f64::NAN);
            }
            named.take(place, &row);
        }
        let of = |index: usize| match named.is_smooth(index) {
            true => named.slopes[index],
            false => f64::NAN,
        };
        Some(Around {
            systems,
            step,
            named: (0..row.len()).map(of).collect(),
        })
    }
}
