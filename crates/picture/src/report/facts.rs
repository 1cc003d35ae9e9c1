//! The summary as the page has it: without extremes, and without what is too long.

use serde_json::{Map, Value};

use linkdyn_output::{Summary, summary};

/// Events and warnings beyond these are counted only, longer texts are cut.
const MOST_EVENTS: usize = 2_000;
const MOST_WARNINGS: usize = 200;
const LONGEST_TEXT: usize = 2_000;
/// Settings of more text than this are left out.
const LARGEST_SETTINGS: usize = 100_000;

/// At most so much of a text.
pub fn cut(text: &str) -> String {
    match text.char_indices().nth(LONGEST_TEXT) {
        Some((end, _)) => format!("{} …", &text[..end]),
        None => text.to_string(),
    }
}

/// The summary without extremes and without the time of writing, which is not over yet.
pub fn facts(summary: &Summary, notes: &mut Vec<String>) -> Value {
    let mut facts = summary::facts(summary);
    if let Some(timing) = facts.get_mut("timing").and_then(Value::as_object_mut) {
        timing.remove("write");
    }
    if let Some(Value::Array(events)) = facts.get_mut("events")
        && events.len() > MOST_EVENTS
    {
        notes.push(format!(
            "The first {MOST_EVENTS} of {} events are shown; summary.json has all.",
            events.len()
        ));
        events.truncate(MOST_EVENTS);
    }
    if let Some(Value::Array(warnings)) = facts.get_mut("warnings")
        && warnings.len() > MOST_WARNINGS
    {
        notes.push(format!(
            "The first {MOST_WARNINGS} of {} warnings are shown.",
            warnings.len()
        ));
        warnings.truncate(MOST_WARNINGS);
    }
    if facts
        .get("settings")
        .is_some_and(|settings| settings.to_string().len() > LARGEST_SETTINGS)
    {
        facts.remove("settings");
        notes.push("The settings are too long to be shown; summary.json has them.".into());
    }
    for key in ["mobility", "equilibrium"] {
        if let Some(Value::Object(part)) = facts.get_mut(key) {
            shorten_lists(part);
        }
    }
    let mut facts = Value::Object(facts);
    shorten_texts(&mut facts);
    facts
}

fn shorten_lists(part: &mut Map<String, Value>) {
    for value in part.values_mut() {
        if let Value::Array(list) = value
            && list.len() > MOST_WARNINGS
        {
            let more = list.len() - MOST_WARNINGS;
            list.truncate(MOST_WARNINGS);
            list.push(format!("… and {more} more").into());
        }
    }
}

fn shorten_texts(value: &mut Value) {
    match value {
        Value::String(text) if text.len() > LONGEST_TEXT => *text = cut(text),
        Value::Array(list) => list.iter_mut().for_each(shorten_texts),
        Value::Object(map) => map.values_mut().for_each(shorten_texts),
        Value::String(_) | Value::Null | Value::Bool(_) | Value::Number(_) => {}
    }
}
