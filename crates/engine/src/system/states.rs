//! Integrated states of a model.

use super::System;
use crate::element::formula::Formula;
use std::sync::Arc;

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
    pub rate: Arc<Formula>,
}

impl System {
    /// Whose formula the one of a force, or behind all forces of a state, is.
    pub(crate) fn owner(&self, force: usize) -> String {
        match self.force_data.get(force) {
            Some(data) => format!("force \"{}\"", data.name),
            None => {
                let state = self.states.get(force - self.force_data.len());
                format!("state \"{}\"", state.map_or("", |state| &state.name))
            }
        }
    }
}
