//! Ranges, and points with tolerances, printed back.

use indexmap::IndexMap;
use serde_json::Value;

use super::Printer;
use crate::node::{Kind, Node};
use crate::shape::Shape;
use crate::tree::Tree;
use crate::walk::Driven;
use crate::words::{self, LENGTH};

impl Printer<'_> {
    /// Least and greatest value, or one number where they are the same and the file does not say it twice.
    pub(super) fn range(
        &mut self,
        tree: &Tree,
        of: &Shape,
        written: Option<&Node>,
        driven: Driven,
    ) -> Value {
        let is_list = written.is_some_and(|node| matches!(node.kind, Kind::Array(_)));
        match tree {
            Tree::List(items) => self.list(items, |_| *of, written, driven),
            Tree::Number(_) if is_list => {
                let both = [tree.clone(), tree.clone()];
                let is_twice = (0..2).all(|index| {
                    written
                        .and_then(|list| list.entry(index))
                        .is_some_and(|node| self.says(node, of, driven, tree))
                });
                match is_twice {
                    true => self.list(&both, |_| *of, written, driven),
                    false => self.leaf(tree, of, None, driven),
                }
            }
            Tree::Null
            | Tree::Number(_)
            | Tree::Count(_)
            | Tree::Flag(_)
            | Tree::Text(_)
            | Tree::Map(_) => self.leaf(tree, of, written, driven),
        }
    }

    /// A point, with the tolerance of its place where it has one.
    pub(super) fn place(&mut self, tree: &Tree, written: Option<&Node>, driven: Driven) -> Value {
        let is_object = written.is_some_and(|node| matches!(node.kind, Kind::Object(_)));
        match tree {
            Tree::List(items) if !is_object => self.list(items, |_| LENGTH, written, driven),
            Tree::List(_) => {
                let place = IndexMap::from([("position".to_owned(), tree.clone())]);
                Value::Object(self.object(
                    &Tree::Map(place),
                    words::object("Place"),
                    None,
                    written,
                    driven,
                ))
            }
            place if is_object => {
                Value::Object(self.object(place, words::object("Place"), None, written, driven))
            }
            place => {
                let mut object = self.object(place, words::object("Place"), None, None, driven);
                // the file has the coordinates alone
                if let Some(position) = place.get("position") {
                    let position = self.place(position, written, driven);
                    object.insert("position".to_owned(), position);
                }
                Value::Object(object)
            }
        }
    }
}
