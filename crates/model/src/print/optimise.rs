//! Optimisation printed back.

use serde_json::{Map, Value, json};

use super::{Printer, plain};
use crate::node::Node;
use crate::shape::{Asked, Shape};
use crate::tree::Tree;
use crate::walk::{Driven, NOTE};

/// What may change has no names in a file without parameters.
pub fn named(file: &mut Map<String, Value>) {
    if !file.contains_key("parameters") {
        file.shift_remove("optimise");
    }
}

impl Printer<'_> {
    /// What is asked, as the file says it.
    pub(super) fn asked(&mut self, asked: Asked, tree: &Tree, written: Option<&Node>) -> Value {
        match asked {
            Asked::Design => self.design(tree, written),
            Asked::Value | Asked::Constraint => {
                let text = tree.get("text").and_then(Tree::text);
                text.map_or_else(|| plain(tree), Value::from)
            }
        }
    }

    /// Bounds as the file says them, else in SI with their unit.
    fn design(&mut self, tree: &Tree, written: Option<&Node>) -> Value {
        if let Some(node) = written
            && self
                .walk
                .sound(node, &Shape::Asked(Asked::Design), Driven::Nothing)
                .as_ref()
                == Some(tree)
        {
            return node.to_value();
        }
        let Value::Object(all) = plain(tree) else {
            return plain(tree);
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
        Value::Object(out)
    }
}
