//! Responses in words.

use indexmap::IndexMap;
use linkdyn_engine::analysis::responses::Answer;
use linkdyn_model::Model;
use linkdyn_model::display::{DIGITS, DisplayUnits};
use linkdyn_model::response::Catalogue;
use serde::Serialize;

use super::words::unit_words;
use super::{Page, number};

/// A value with its SI unit, in the units of the file.
pub fn value(value: f64, unit: &str, display: &DisplayUnits) -> String {
    match unit {
        "m" => display.length(value),
        "rad" => display.angle(value),
        "kg" => display.mass_to(value, DIGITS),
        "s" => display.time(value),
        "" => number(value, DIGITS),
        unit => format!("{} {}", number(value, DIGITS), unit_words(unit)),
    }
}

/// `stroke = 100 mm`, with its limits, or why there is none.
pub fn told(answer: &Answer, display: &DisplayUnits) -> String {
    let shown = |value: f64| match (&answer.shown, answer.unit.as_str()) {
        (Some((unit, size)), _) => format!("{} {}", number(value / size, DIGITS), unit_words(unit)),
        (None, unit) => self::value(value, unit, display),
    };
    let name = &answer.name;
    let Some(value) = answer.value else {
        return format!(
            "{name}: none, {}",
            answer.reason.as_deref().unwrap_or("it has no value")
        );
    };
    let limits = answer.limits.map(|[lower, upper]| {
        let where_it_is = match (lower..=upper).contains(&value) {
            true => "within",
            false => "outside of",
        };
        format!(" ({where_it_is} {} … {})", shown(lower), shown(upper))
    });
    format!("{name} = {}{}", shown(value), limits.unwrap_or_default())
}

/// A response that a model asks for.
#[derive(Debug, Serialize)]
pub struct Expression<'a> {
    value: &'a str,
    unit: String,
}

/// The responses that a model asks for, by name.
pub fn expressions(model: &Model) -> IndexMap<&str, Expression<'_>> {
    let catalogue = Catalogue::of(model);
    let all = model.responses.iter().map(|(name, response)| {
        let unit = response.compile(&catalogue).map(|compiled| compiled.unit);
        let expression = Expression {
            value: &response.value,
            unit: unit.unwrap_or_default(),
        };
        (name.as_str(), expression)
    });
    all.collect()
}

/// The outputs and the responses that a model asks for, a row each.
pub fn rows(page: &mut Page, model: &Model) {
    let outputs = model.outputs.iter();
    page.rows(
        "outputs",
        outputs.map(|(name, text)| format!("{name} = {text}")),
    );
    let all = expressions(model).into_iter();
    let texts = all.map(|(name, Expression { value, unit })| match unit.as_str() {
        "" => format!("{name} = {value}"),
        unit => format!("{name} = {value}  [{unit}]"),
    });
    page.rows("responses", texts);
}
