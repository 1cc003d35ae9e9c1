//! What is read as a whole, printed back: responses, formulas, events, tables, states, what may change in an optimisation.

use serde::Deserialize;
use serde_json::{Map, Value, json};

use super::{Printer, plain};
use crate::event::Event;
use crate::formula::Formula;
use crate::input::ModelInput;
use crate::node::{Kind, Node};
use crate::response::{Response, self_contained};
use crate::shape::Shape;
use crate::state::State;
use crate::tree::Tree;
use crate::walk::{Driven, NOTE};

/// What may change has no names in a file without parameters.
pub fn named(file: &mut Map<String, Value>) {
    if !file.contains_key("parameters") {
        file.shift_remove("optimise");
    }
}

impl Printer<'_> {
    /// As the file says it; else in SI, and with the values of the parameters that it names.
    pub(super) fn whole(
        &mut self,
        tree: &Tree,
        shape: &Shape,
        written: Option<&Node>,
        driven: Driven,
    ) -> Value {
        let tree = without_nulls(tree.clone());
        let said = written.and_then(|node| self.walk.sound(node, shape, driven));
        if let Some(node) = written
            && said.map(without_nulls).as_ref() == Some(&tree)
        {
            return node.to_value();
        }
        let afresh = match shape {
            Shape::Response => self.response(&tree),
            Shape::Formula(_) => formula(&tree),
            Shape::Event => Event::deserialize(&tree)
                .map(|event| event.self_contained().into())
                .ok(),
            Shape::Input => input(&tree),
            Shape::State(_) => state(&tree),
            Shape::Asked(_) => self.design(&tree, written),
            _ => None,
        };
        afresh.unwrap_or_else(|| plain(&tree))
    }

    fn response(&mut self, tree: &Tree) -> Option<Value> {
        let response = Response::deserialize(tree).ok()?;
        let text = self_contained(&response.value, &response.parameters);
        if response.limits.is_none() && response.unit.is_none() {
            return Some(text.into());
        }
        let mut out = Map::from_iter([("value".to_owned(), json!(text))]);
        if let Some(limits) = response.limits {
            let limits = limits.map(|limit| self.limit(limit, &text));
            out.insert("limits".to_owned(), limits.to_vec().into());
        }
        out.extend(response.unit.map(|unit| ("unit".to_owned(), unit.into())));
        Some(Value::Object(out))
    }

    /// Bounds with their unit.
    fn design(&mut self, tree: &Tree, written: Option<&Node>) -> Option<Value> {
        let Value::Object(all) = plain(tree) else {
            return None;
        };
        let note = written
            .and_then(|node| node.get(NOTE))
            .filter(|note| note.as_str().is_some());
        let mut out = Map::new();
        for (name, range) in all {
            let unit = self.walk.unit_of(&name);
            let said = |end: &Value| match (end.as_f64(), unit.as_str()) {
                (Some(number), unit) if !unit.is_empty() => json!(format!("{number:?} {unit}")),
                _ => end.clone(),
            };
            let range = match &range {
                Value::Array(ends) => ends.iter().map(said).collect(),
                other => other.clone(),
            };
            out.insert(name, range);
        }
        out.extend(note.map(|note| (NOTE.to_owned(), note.to_value())));
        Some(Value::Object(out))
    }

    /// A limit in SI, with its unit where plain numbers of the file are in another one.
    fn limit(&mut self, limit: f64, text: &str) -> Value {
        let Some(quantity) = self.walk.measure_of(text) else {
            return json!(limit);
        };
        let texts = [
            json!(limit),
            json!(format!("{limit:?} {}", quantity.unit())),
        ];
        for value in texts {
            let kind = match &value {
                Value::Number(number) => Kind::Number(number.clone()),
                other => Kind::String(other.as_str().unwrap_or_default().to_owned()),
            };
            let (node, driven) = (Node::of(kind), Driven::Parameter(quantity));
            if self.says(&node, &Shape::Limit, driven, &Tree::Number(limit)) {
                return value;
            }
        }
        json!(limit)
    }
}

fn formula(tree: &Tree) -> Option<Value> {
    let formula = Formula::deserialize(tree).ok()?;
    let text = self_contained(&formula.formula, &formula.parameters);
    let Some(table) = formula.table else {
        return Some(text.into());
    };
    let mut out = Map::from_iter([("of".to_owned(), text.trim_start_matches('=').into())]);
    if let Value::Object(members) = plain(&without_nulls(Tree::of(&table))) {
        out.extend(members);
    }
    Some(Value::Object(out))
}

fn input(tree: &Tree) -> Option<Value> {
    let input = ModelInput::deserialize(tree).ok()?;
    Some(with_unit(input.start, &input.unit).into())
}

/// A number in SI as text.
fn with_unit(value: f64, unit: &str) -> String {
    format!("{value:?} {unit}").trim_end().to_owned()
}

fn state(tree: &Tree) -> Option<Value> {
    let state = State::deserialize(tree).ok()?;
    let rate = self_contained(&state.rate.formula, &state.rate.parameters);
    let start = with_unit(state.start, &state.unit);
    Some(json!({ "rate": rate, "start": start }))
}

/// An object without keys that hold nothing.
fn without_nulls(tree: Tree) -> Tree {
    match tree {
        Tree::Map(members) => {
            let is_there = |value: &Tree| match value {
                Tree::Map(members) => !members.is_empty(),
                value => *value != Tree::Null,
            };
            let kept = members.into_iter().filter(|(_, value)| is_there(value));
            Tree::Map(kept.collect())
        }
        other => other,
    }
}
