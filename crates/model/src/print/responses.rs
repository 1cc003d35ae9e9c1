//! Responses printed back.

use serde::Deserialize;
use serde_json::{Map, Value, json};

use super::{Printer, plain};
use crate::dimension::Dimension;
use crate::event::Event;
use crate::formula::Formula;
use crate::node::{Kind, Node};
use crate::response::{Response, self_contained};
use crate::shape::Shape;
use crate::state::State;
use crate::tree::Tree;
use crate::walk::{Driven, Walk};

impl Printer<'_> {
    /// A response as the file says it, else with the values of its parameters.
    pub(super) fn response(
        &mut self,
        tree: &Tree,
        written: Option<&Node>,
        driven: Driven,
    ) -> Value {
        let tree = without_nulls(tree.clone());
        if let Some(node) = written
            && self
                .walk
                .sound(node, &Shape::Response, driven)
                .map(without_nulls)
                .as_ref()
                == Some(&tree)
        {
            return node.to_value();
        }
        let Ok(response) = Response::deserialize(&tree) else {
            return plain(&tree);
        };
        let text = self_contained(&response.value, &response.parameters);
        if response.limits.is_none() && response.unit.is_none() {
            return text.into();
        }
        let mut out = Map::from_iter([("value".to_owned(), json!(text))]);
        if let Some(limits) = response.limits {
            let limits = limits.map(|limit| self.limit(limit, &text));
            out.insert("limits".to_owned(), limits.to_vec().into());
        }
        out.extend(response.unit.map(|unit| ("unit".to_owned(), unit.into())));
        Value::Object(out)
    }

    /// An expression of what moves as the file says it, else with the values of its parameters.
    pub(super) fn formula(
        &mut self,
        tree: &Tree,
        of: Dimension,
        written: Option<&Node>,
        driven: Driven,
    ) -> Value {
        if tree.get("formula").is_none() {
            return self.value(tree, &Shape::Varying(of), written, driven);
        }
        let tree = without_nulls(tree.clone());
        let shape = &Shape::Formula(of);
        let says = |walk: &mut Walk<'_>, node: &Node| {
            let value = walk.sound(node, shape, driven).map(without_nulls);
            value.as_ref() == Some(&tree)
        };
        if let Some(node) = written
            && says(&mut self.walk, node)
        {
            return node.to_value();
        }
        let Ok(mut formula) = Formula::deserialize(&tree) else {
            return plain(&tree);
        };
        let text = self_contained(&formula.formula, &formula.parameters);
        let Some(table) = formula.table.take() else {
            return text.into();
        };
        let mut out = Map::from_iter([("of".to_owned(), text.trim_start_matches('=').into())]);
        if let Value::Object(members) = plain(&without_nulls(Tree::of(&table))) {
            out.extend(members);
        }
        Value::Object(out)
    }

    /// An event as the file says it, else with the values of its parameters.
    pub(super) fn event(&mut self, tree: &Tree, written: Option<&Node>, driven: Driven) -> Value {
        let tree = without_nulls(tree.clone());
        if let Some(node) = written {
            let said = self.walk.sound(node, &Shape::Event, driven);
            if said.map(without_nulls).as_ref() == Some(&tree) {
                return node.to_value();
            }
        }
        match Event::deserialize(&tree) {
            Ok(event) => event.self_contained().into(),
            Err(_) => plain(&tree),
        }
    }

    /// A table or a state as the file says it, else in SI.
    pub(super) fn whole(
        &mut self,
        tree: &Tree,
        shape: &Shape,
        written: Option<&Node>,
        driven: Driven,
    ) -> Value {
        let tree = without_nulls(tree.clone());
        if let Some(node) = written
            && self
                .walk
                .sound(node, shape, driven)
                .map(without_nulls)
                .as_ref()
                == Some(&tree)
        {
            return node.to_value();
        }
        let Ok(state) = State::deserialize(&tree) else {
            return plain(&tree);
        };
        let rate = self_contained(&state.rate.formula, &state.rate.parameters);
        let start = format!("{:?} {}", state.start, state.unit);
        json!({ "rate": rate, "start": start.trim_end() })
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
