//! The page of a model that is refused: as much as can be drawn, with the complaints at their places.
//!
//! What complaints are about is taken out of the model, until the rest is legal.

use serde_json::{Map, Value};

use super::page::{Finder, pose};
use crate::Text;
use crate::shape::at_pose;
use linkdyn_model::Checked;
use linkdyn_model::error::Complaints;
use linkdyn_picture::Shape;
use linkdyn_picture::diagnosis::{Diagnosis, page, page_of_text};

/// How often something is taken out: what is left may miss what was taken.
const ROUNDS: usize = 12;
/// Lines that are shown above and below the first complaint.
const AROUND: usize = 4;
/// Keys of a joint without which it is none.
const NEEDED: [&str; 3] = ["type", "between", "axis"];

/// The page of a model that was refused.
pub fn html(text: &Text, complaints: &Complaints) -> String {
    let bytes = &text.bytes;
    let document: Option<Value> = serde_json::from_slice(bytes).ok();
    let drawn = document.as_ref().and_then(drawable);
    let shape = match &drawn {
        Some(model) => at_pose(model, &pose(model, &[])),
        None => Shape::default(),
    };
    let mut found = Finder {
        shape: &shape,
        loops: &[],
        findings: Vec::new(),
    };
    for complaint in complaints.iter() {
        found.complain(complaint, bytes);
        let named = document
            .as_ref()
            .map(|document| bodies_of(document, &complaint.path));
        let number = |name: &String| shape.bodies.iter().position(|body| body.name == *name);
        if let Some(last) = found.findings.last_mut()
            && last.bodies.is_empty()
            && last.joints.is_empty()
        {
            // The ground has no middle.
            let bodies = named.iter().flatten().filter_map(number);
            last.bodies = bodies.filter(|body| *body > 0).collect();
        }
    }
    let diagnosis = Diagnosis {
        title: format!("{}: refused", text.label),
        facts: vec![match drawn {
            Some(_) => "The drawing leaves out what the complaints are about.".to_string(),
            None => "Nothing of it can be drawn.".to_string(),
        }],
        loops: Vec::new(),
        findings: found.findings,
        figures: Vec::new(),
    };
    match &drawn {
        Some(model) => page(shape.clone(), &pose(model, &[]), &diagnosis),
        None => {
            let line = line(complaints);
            page_of_text(&diagnosis, &excerpt(bytes, line.unwrap_or(1)), line)
        }
    }
}

/// What is left of a model without what is wrong in it; `None` if that is no model.
fn drawable(document: &Value) -> Option<Checked> {
    let mut document = document.as_object()?.clone();
    document.insert("format".into(), "linkdyn/1".into());
    for _ in 0..ROUNDS {
        let text = serde_json::to_vec(&document).ok()?;
        let complaints = match linkdyn_model::load(&text, &[]) {
            Ok(loaded) => return Some(loaded.model),
            Err(complaints) => complaints,
        };
        let mut is_less = false;
        for complaint in complaints.iter() {
            is_less |= take_out(&mut document, &segments(&complaint.path));
        }
        if !is_less {
            return None;
        }
    }
    None
}

/// `joints.b.between[1]` as its names.
fn segments(path: &str) -> Vec<&str> {
    let names = path.split('.');
    let names = names.map(|name| name.split('[').next().unwrap_or(name));
    names.filter(|name| !name.is_empty()).collect()
}

/// Takes out what a path is about, as little as keeps the rest whole; whether there was something.
fn take_out(document: &mut Map<String, Value>, path: &[&str]) -> bool {
    match path {
        [] | ["bodies"] => false,
        ["units", ..] => document.insert("units".into(), "SI".into()) != Some("SI".into()),
        ["bodies", body, "points", point, ..] => {
            let points = entry(document, "bodies", body).and_then(|body| body.get_mut("points"));
            let points = points.and_then(Value::as_object_mut);
            points.is_some_and(|points| points.remove(*point).is_some())
        }
        ["bodies", body, key, ..] if *key != "points" => take_key(document, ["bodies", body], key),
        ["joints", joint, key, ..] if !NEEDED.contains(key) => {
            take_key(document, ["joints", joint], key) || take_entry(document, ["joints", joint])
        }
        ["bodies" | "joints" | "forces" | "drivers", name, ..] => {
            take_entry(document, [path[0], name])
        }
        [key, ..] => document.remove(*key).is_some(),
    }
}

fn entry<'d>(
    document: &'d mut Map<String, Value>,
    section: &str,
    name: &str,
) -> Option<&'d mut Map<String, Value>> {
    document.get_mut(section)?.get_mut(name)?.as_object_mut()
}

fn take_key(document: &mut Map<String, Value>, [section, name]: [&str; 2], key: &str) -> bool {
    entry(document, section, name).is_some_and(|entry| entry.remove(key).is_some())
}

fn take_entry(document: &mut Map<String, Value>, [section, name]: [&str; 2]) -> bool {
    let entries = document.get_mut(section).and_then(Value::as_object_mut);
    entries.is_some_and(|entries| entries.remove(name).is_some())
}

/// Bodies that the thing at a path names: `rod` of `rod.A`.
fn bodies_of(document: &Value, path: &str) -> Vec<String> {
    let names = segments(path);
    let [section, name, ..] = names[..] else {
        return Vec::new();
    };
    let mut found = Vec::new();
    if let Some(thing) = document.get(section).and_then(|all| all.get(name)) {
        let texts = thing.as_object().into_iter().flat_map(Map::values);
        let texts = texts.flat_map(|value| match value {
            Value::Array(values) => values.iter().filter_map(Value::as_str).collect(),
            value => Vec::from_iter(value.as_str()),
        });
        found.extend(texts.map(|text| text.split('.').next().unwrap_or(text).to_string()));
    }
    found
}

/// The line of the first complaint that has a place.
fn line(complaints: &Complaints) -> Option<usize> {
    let place = complaints.iter().find_map(|complaint| complaint.place);
    place.map(|place| place.line)
}

/// The lines around a line.
fn excerpt(bytes: &[u8], line: usize) -> Vec<(usize, String)> {
    let text = String::from_utf8_lossy(bytes);
    let first = line.saturating_sub(AROUND).max(1);
    let lines = text.lines().enumerate().skip(first - 1);
    lines
        .take(2 * AROUND + 1)
        .map(|(index, line)| (index + 1, line.chars().take(400).collect()))
        .collect()
}
