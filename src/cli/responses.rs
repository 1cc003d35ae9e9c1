//! Responses on the command line: asked for by `--response`, told in rows.

use super::exit::{BadInput, Failure};
use super::open::{ModelOptions, Opened, bad_input};
use super::page::{Page, number};
use super::words::unit_words;
use linkdyn_engine::analysis::responses::Answer;
use linkdyn_model::display::{DIGITS, DisplayUnits};
use linkdyn_model::error::Complaints;
use linkdyn_model::response::Catalogue;
use serde_json::{Value, json};

/// Reads a model with more responses, `NAME = EXPRESSION`.
///
/// # Errors
/// When there is no such model, or it or a response has faults.
pub fn open(model: &ModelOptions, asked: &[String]) -> Result<Opened, Failure> {
    let mut sets = Vec::new();
    let mut faults = Vec::new();
    for text in asked {
        let parts = text
            .split_once('=')
            .map(|(name, rest)| (name.trim(), rest.trim()));
        match parts {
            Some((name, rest)) if is_name(name) && !rest.is_empty() => {
                sets.push(format!("responses.{name}={rest}"));
            }
            Some(_) | None => faults.push(format!(
                "--response {text:?}: a name and an expression are expected (as in \"stroke = max(piston.x) - min(piston.x)\")"
            )),
        }
    }
    if !faults.is_empty() {
        return Err(BadInput(faults));
    }
    let opened = model.open_with(&sets)?;
    opened.map_err(|complaints| bad_input(&model.label(), asked_for(complaints, asked, &sets)))
}

/// Whether a response can have this name.
fn is_name(name: &str) -> bool {
    !name.is_empty() && !name.contains(|c: char| ".[],=*?".contains(c) || c.is_control())
}

/// Complaints about what `--response` asks for say so.
fn asked_for(complaints: Complaints, asked: &[String], sets: &[String]) -> Complaints {
    let told = complaints.into_iter().map(|mut complaint| {
        let found = complaint
            .found
            .as_deref()
            .and_then(|found| found.strip_prefix("--set "));
        let index = found.and_then(|found| sets.iter().position(|set| set == found));
        if let Some(index) = index {
            complaint.found = None;
            complaint.path = format!("--response {:?}", asked[index]);
        }
        complaint
    });
    Complaints(told.collect())
}

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

/// The text and the unit of each response of a model.
fn texts(opened: &Opened) -> Vec<[String; 3]> {
    let model = &opened.loaded.model;
    let catalogue = Catalogue::of(model);
    let texts = model.responses.iter().map(|(name, response)| {
        let unit = response.compile(&catalogue).map(|compiled| compiled.unit);
        [
            name.clone(),
            response.value.clone(),
            unit.unwrap_or_default(),
        ]
    });
    texts.collect()
}

/// The outputs and the responses that a model asks for, a row each.
pub fn rows(page: &mut Page, opened: &Opened) {
    let outputs = opened.loaded.model.outputs.iter();
    page.rows(
        "outputs",
        outputs.map(|(name, text)| format!("{name} = {text}")),
    );
    let texts = texts(opened)
        .into_iter()
        .map(|[name, text, unit]| match unit.as_str() {
            "" => format!("{name} = {text}"),
            unit => format!("{name} = {text}  [{unit}]"),
        });
    page.rows("responses", texts);
}

/// The same for programs.
pub fn to_json(opened: &Opened) -> Value {
    let texts = texts(opened).into_iter();
    let texts = texts.map(|[name, text, unit]| (name, json!({ "value": text, "unit": unit })));
    Value::Object(texts.collect())
}
