//! Numbers from outside, and integrated states of a model.

use super::System;
use crate::element::formula::Strength;

/// A number from outside.
#[derive(Clone)]
pub(crate) struct InputData {
    /// Its name.
    pub name: String,
    /// Its value until it is set.
    pub start: f64,
}

/// An integrated state.
#[derive(Clone)]
pub(crate) struct StateData {
    /// Its name.
    pub name: String,
    /// SI units of itself and of its rate.
    pub units: [&'static str; 2],
    /// Its value at t = 0.
    pub start: f64,
    /// Its rate.
    pub rate: Strength,
}

impl System {
    /// Whose formula the one of a force is, or behind all forces of a state, or behind these of what closes and opens.
    pub(crate) fn owner(&self, force: usize) -> String {
        match self.force_data.get(force) {
            Some(data) => format!("force \"{}\"", data.name),
            None => {
                let index = force - self.force_data.len();
                match self.states.get(index) {
                    Some(state) => format!("state \"{}\"", state.name),
                    None => self.contact_name(self.timed[index - self.states.len()].contact),
                }
            }
        }
    }
}
