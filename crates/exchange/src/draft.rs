//! A model file as it is written for people: short, a body and a joint on a line each.

use linkdyn_model::{FORMAT, GROUND};
use serde_json::{Map, Value, json};

/// The entry of a body, a joint, a driver or a force, as it stands in the file.
pub type Entry = Map<String, Value>;

/// A model in the making: its sections by name, in their order.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Draft {
    /// Its name.
    pub name: String,
    /// What it is.
    pub about: String,
    /// Where it comes from.
    pub source: String,
    /// Units of plain numbers, such as `length`: `mm`; all others are those of SI, angles radians.
    pub units: Map<String, Value>,
    /// In units of the file \[length/s²\]; none where there is nothing to fall.
    pub gravity: Option<[f64; 2]>,
    /// Bodies, `ground` among them where it has points.
    pub bodies: Map<String, Value>,
    /// Joints.
    pub joints: Map<String, Value>,
    /// Drivers.
    pub drivers: Map<String, Value>,
    /// Forces.
    pub forces: Map<String, Value>,
    /// Points whose path is of interest: `body.point`.
    pub points: Vec<String>,
    /// The analysis.
    pub analysis: Entry,
}

/// Characters of a line, at most, before an entry is broken.
const WIDTH: usize = 140;

impl Draft {
    /// The text of the model file.
    pub fn text(&self) -> String {
        let mut head = Map::new();
        head.insert("format".into(), FORMAT.into());
        for (key, text) in [
            ("name", &self.name),
            ("about", &self.about),
            ("source", &self.source),
        ] {
            if !text.is_empty() {
                head.insert(key.into(), text.as_str().into());
            }
        }
        let units = match self.units.is_empty() {
            true => "SI".into(),
            false => Value::Object(self.units.clone()),
        };
        head.insert("units".into(), units);
        if let Some(gravity) = self.gravity {
            head.insert("gravity".into(), numbers(gravity));
        }
        let mut parts: Vec<String> = head.iter().map(|(key, value)| member(key, value)).collect();
        let sections = [
            ("bodies", &self.bodies),
            ("joints", &self.joints),
            ("drivers", &self.drivers),
            ("forces", &self.forces),
        ];
        for (key, entries) in sections {
            if !entries.is_empty() {
                let entries: Vec<String> = entries
                    .iter()
                    .map(|(name, entry)| broken(name, entry))
                    .collect();
                parts.push(format!(
                    "{}: {{\n    {}\n  }}",
                    json!(key),
                    entries.join(",\n    ")
                ));
            }
        }
        if !self.points.is_empty() {
            parts.push(member("points", &json!(self.points)));
        }
        if !self.analysis.is_empty() {
            parts.push(member("analysis", &Value::Object(self.analysis.clone())));
        }
        format!("{{\n  {}\n}}\n", parts.join(",\n  "))
    }

    /// A name that is legal and new in `taken`, as near to the wish as that allows.
    pub fn named(taken: &Map<String, Value>, wish: &str, otherwise: &str) -> String {
        let mut names = Draft::names(wish, otherwise);
        let free = names.find(|name| !taken.contains_key(name));
        free.unwrap_or_default()
    }

    /// Legal names, as near to the wish as can be: letters, digits, `_` and `-`; all but the first have a number.
    pub(crate) fn names(wish: &str, otherwise: &str) -> impl Iterator<Item = String> + use<> {
        let legal = |c: char| match c.is_alphanumeric() || c == '-' {
            true => c,
            false => '_',
        };
        let legal: String = wish.trim().chars().map(legal).collect();
        let stem = match legal.trim_matches('_') {
            "" => otherwise.to_owned(),
            stem => stem.to_owned(),
        };
        let numbered = stem.clone();
        std::iter::once(stem)
            .chain((2..).map(move |k: u32| format!("{numbered}_{k}")))
            .filter(|name| name != GROUND)
    }
}

/// A number as it is written: without a point where it is whole.
pub fn number(value: f64) -> Value {
    if value == value.trunc() && value.abs() < 1e15 {
        // −0 becomes 0.
        return json!(value as i64);
    }
    json!(value)
}

/// A list of them.
pub fn numbers<const N: usize>(values: [f64; N]) -> Value {
    values.into_iter().map(number).collect()
}

fn member(key: &str, value: &Value) -> String {
    format!("{}: {}", json!(key), spaced(value))
}

/// An entry on one line, or its longer members on lines of their own.
fn broken(name: &str, entry: &Value) -> String {
    let whole = member(name, entry);
    let Value::Object(members) = entry else {
        return whole;
    };
    if whole.chars().count() <= WIDTH || members.len() < 2 {
        return whole;
    }
    let members: Vec<String> = members
        .iter()
        .map(|(key, value)| member(key, value))
        .collect();
    format!("{}: {{ {} }}", json!(name), members.join(",\n      "))
}

/// JSON on one line, with spaces as a person writes it.
fn spaced(value: &Value) -> String {
    match value {
        Value::Object(members) if members.is_empty() => "{}".into(),
        Value::Object(members) => {
            let members: Vec<String> = members
                .iter()
                .map(|(key, value)| member(key, value))
                .collect();
            format!("{{ {} }}", members.join(", "))
        }
        Value::Array(items) => {
            let items: Vec<String> = items.iter().map(spaced).collect();
            format!("[{}]", items.join(", "))
        }
        other => other.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_draft_is_a_short_file_that_loads() {
        let mut draft = Draft {
            name: "Bar".into(),
            ..Draft::default()
        };
        draft.units.insert("length".into(), "mm".into());
        draft.bodies.insert(
            "ground".into(),
            json!({ "points": { "O": numbers([0.0, -0.0]) } }),
        );
        draft.bodies.insert(
            "bar".into(),
            json!({ "points": { "O": numbers([0.0, 0.0]), "A": numbers([0.1, 2.0]) } }),
        );
        draft.joints.insert(
            "o".into(),
            json!({ "type": "revolute", "between": ["ground.O", "bar.O"] }),
        );
        let text = draft.text();
        assert!(
            text.contains("\n    \"bar\": { \"points\": { \"O\": [0, 0], \"A\": [0.1, 2] } }\n"),
            "{text}"
        );
        let loaded = linkdyn_model::load(text.as_bytes(), &[]).expect("it loads");
        assert_eq!(loaded.model.bodies["bar"].points["A"], [0.1 * 1e-3, 2e-3]);
    }

    #[test]
    fn names_are_legal_and_new() {
        let mut taken = Map::new();
        taken.insert("arm".into(), Value::Null);
        assert_eq!(Draft::named(&taken, " arm ", "link"), "arm_2");
        assert_eq!(Draft::named(&taken, "a.b c", "link"), "a_b_c");
        assert_eq!(Draft::named(&taken, "ground", "link"), "ground_2");
        assert_eq!(Draft::named(&taken, "", "link"), "link");
    }
}
