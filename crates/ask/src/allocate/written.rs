//! Tolerances as a file has them.

use linkdyn_model::{Parameter, Tolerance};

use crate::ModelFile;
use crate::text::number;

/// Digits of tolerances and costs.
pub const DIGITS: usize = 4;
/// Where a tolerance is written with few digits, it is this much narrower at least, so that it never gets wider.
const NARROWER: f64 = 1e-4;

/// A deviation of a parameter in the units of the file.
pub fn quantity(file: &ModelFile, parameter: &Parameter, value: f64, digits: usize) -> String {
    let display = &file.model().display;
    match parameter.unit.as_str() {
        "m" => display.length_to(value, digits),
        "rad" => display.angle_to(value, digits).replace('°', " deg"),
        _ => format!("{}{}", number(value, digits), unit(parameter)),
    }
}

/// `--set` of a tolerance by its half width: with few digits, never wider than it is, or with all if the middle is off the value.
pub fn set(file: &ModelFile, parameter: &Parameter, half: f64) -> String {
    let middle = parameter.tolerance.as_ref().map_or(0.0, Tolerance::middle);
    let words = if middle == 0.0 {
        let half = half * (1.0 - NARROWER);
        quoted(parameter, quantity(file, parameter, half, DIGITS + 1))
    } else {
        let [low, high] = [middle - half, middle + half]
            .map(|value| quoted(parameter, format!("{value:e}{}", unit(parameter))));
        format!("[{low}, {high}]")
    };
    format!("parameters.{}.tolerance={words}", parameter.name)
}

/// A quantity as JSON has it: a plain number as it is, with a unit in quotes.
fn quoted(parameter: &Parameter, quantity: String) -> String {
    match parameter.unit.as_str() {
        "" => quantity,
        _ => format!("\"{quantity}\""),
    }
}

fn unit(parameter: &Parameter) -> String {
    match parameter.unit.as_str() {
        "" => String::new(),
        unit => format!(" {unit}"),
    }
}
