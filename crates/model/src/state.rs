//! Integrated states: `"states": { "integral": { "rate": "=target - rotor.omega", "start": 0 } }`, which formulas name as
//! `state.integral`.

use std::sync::Mutex;

use serde::{Deserialize, Serialize};

use crate::formula::Formula;

/// A quantity of which the rate is known, integrated with the motion.
#[derive(Debug, Clone, PartialEq, Default, Deserialize, Serialize)]
pub struct State {
    /// Its rate.
    pub rate: Formula,
    /// Its value at t = 0, in SI.
    #[serde(default)]
    pub start: f64,
    /// Its SI unit; empty of a plain number.
    #[serde(default)]
    pub unit: String,
}

impl State {
    /// SI units of itself and of its rate, as columns write them.
    pub fn units(&self) -> [&'static str; 2] {
        let powers = crate::table::unit(&self.unit).map(|unit| unit.powers);
        let powers = powers.unwrap_or_default();
        [0, 1].map(|order| kept(powers.per_second(order).unit()))
    }
}

/// A text that is kept for ever; there are as many as units that models ever have.
fn kept(text: String) -> &'static str {
    static KEPT: Mutex<Vec<&'static str>> = Mutex::new(Vec::new());
    let text = if text.is_empty() {
        "1".to_owned()
    } else {
        text
    };
    // whoever panicked with the lock left a whole list
    let mut all = KEPT
        .lock()
        .unwrap_or_else(std::sync::PoisonError::into_inner);
    match all.iter().find(|known| **known == text) {
        Some(known) => known,
        None => {
            let new: &'static str = Box::leak(text.into_boxed_str());
            all.push(new);
            new
        }
    }
}
