//! The units in which a study is reported.

use linkdyn_engine::analysis::Family;
use linkdyn_model::Model;
use linkdyn_model::display::Shown;
use serde::{Deserialize, Serialize};

use crate::text::number;
use crate::text::words::unit_words;

/// Digits of values.
const DIGITS: usize = 6;

/// Symbol of a unit, and its size in SI.
pub type Named = (String, f64);

/// The units of the model file, in which the page shows its numbers; `study.json` keeps them for `merge`.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Display {
    /// For lengths.
    pub length: Named,
    /// For angles.
    pub angle: Named,
    /// Of responses that have one of their own.
    pub responses: indexmap::IndexMap<String, Named>,
}

impl Default for Display {
    fn default() -> Self {
        Display {
            length: ("m".into(), 1.0),
            angle: ("rad".into(), 1.0),
            responses: indexmap::IndexMap::new(),
        }
    }
}

impl Display {
    /// Of a model and its responses.
    pub fn of(model: &Model, family: &Family) -> Self {
        let display = &model.display;
        let named = |shown: &Shown| (shown.symbol.clone(), shown.size);
        let responses = family.responses().list().iter();
        Display {
            length: named(&display.length),
            angle: named(&display.angle),
            responses: responses
                .filter_map(|own| Some((own.name.clone(), own.shown.clone()?)))
                .collect(),
        }
    }
}

impl Display {
    /// A value of this SI unit in that of the file, in words.
    pub fn words(&self, value: f64, unit: &str) -> String {
        match unit {
            "m" => in_unit(value, &self.length),
            "rad" => in_unit(value, &self.angle),
            unit => in_unit(value, &(unit_words(unit), 1.0)),
        }
    }

    /// A value of a response, which may have a unit of its own.
    pub fn words_of(&self, response: &str, value: f64, unit: &str) -> String {
        match self.responses.get(response) {
            Some((own, size)) => in_unit(value, &(unit_words(own), *size)),
            None => self.words(value, unit),
        }
    }
}

fn in_unit(value: f64, (symbol, size): &Named) -> String {
    let text = number(value / size, DIGITS);
    match symbol.as_str() {
        "" => text,
        symbol if symbol.starts_with('°') => format!("{text}{symbol}"),
        symbol => format!("{text} {symbol}"),
    }
}
