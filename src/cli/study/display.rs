//! The units in which a study is told.

use std::fs;
use std::path::Path;

use crate::cli::open::Opened;
use crate::cli::page::number;
use crate::cli::words::unit_words;
use linkdyn_engine::analysis::Family;
use linkdyn_model::display::Shown;
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// Digits of values.
const DIGITS: usize = 6;

/// Symbol of a unit, and its size in SI.
pub type Named = (String, f64);

/// The units of the model file, in which the page shows its numbers; `study.json` keeps them for `merge`.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Display {
    pub length: Named,
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
    pub fn of(opened: &Opened, family: &Family) -> Self {
        let display = &opened.loaded.model.display;
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

/// The units that the directory of a study keeps; SI where it keeps none.
pub fn kept(directory: &Path) -> Display {
    let text = fs::read(directory.join(super::HEAD)).unwrap_or_default();
    let all: Value = serde_json::from_slice(&text).unwrap_or_default();
    serde_json::from_value(all["display"].clone()).unwrap_or_default()
}
