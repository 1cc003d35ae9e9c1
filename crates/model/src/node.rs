//! A JSON value that knows where it came from.

use indexmap::IndexMap;
use serde_json::{Map, Number, Value};

/// Where a value came from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Origin {
    /// Bytes of the text, start and end.
    Text(usize, usize),
    /// Which `--set`.
    Set(usize),
}

/// A value and where it came from.
#[derive(Debug, Clone, PartialEq)]
pub struct Node {
    pub kind: Kind,
    pub origin: Origin,
}

/// A JSON value.
#[derive(Debug, Clone, PartialEq)]
pub enum Kind {
    Null,
    Bool(bool),
    Number(Number),
    String(String),
    Array(Vec<Node>),
    Object(Box<IndexMap<String, Member>>),
}

/// Value of a key, and where the key came from.
#[derive(Debug, Clone, PartialEq)]
pub struct Member {
    pub key: Origin,
    pub node: Node,
}

impl Node {
    /// One that stands in no file.
    pub fn of(kind: Kind) -> Node {
        let origin = Origin::Text(0, 0);
        Node { kind, origin }
    }

    /// What kind of thing it is, in words.
    pub fn kind_name(&self) -> &'static str {
        match &self.kind {
            Kind::Null => "null",
            Kind::Bool(_) => "true or false",
            Kind::Number(_) => "a number",
            Kind::String(_) => "text",
            Kind::Array(_) => "a list",
            Kind::Object(_) => "an object",
        }
    }

    /// The value of a key, where this is an object that has it.
    pub fn get(&self, key: &str) -> Option<&Node> {
        match &self.kind {
            Kind::Object(members) => members.get(key).map(|member| &member.node),
            _ => None,
        }
    }

    /// An entry of a list, where this is one that has it.
    pub fn entry(&self, index: usize) -> Option<&Node> {
        match &self.kind {
            Kind::Array(items) => items.get(index),
            _ => None,
        }
    }

    /// The text, where this is one.
    pub fn as_str(&self) -> Option<&str> {
        match &self.kind {
            Kind::String(text) => Some(text),
            _ => None,
        }
    }

    /// The plain value, order preserved.
    pub fn to_value(&self) -> Value {
        match &self.kind {
            Kind::Null => Value::Null,
            Kind::Bool(value) => Value::Bool(*value),
            Kind::Number(number) => Value::Number(number.clone()),
            Kind::String(text) => Value::String(text.clone()),
            Kind::Array(items) => Value::Array(items.iter().map(Node::to_value).collect()),
            Kind::Object(members) => {
                let members = members
                    .iter()
                    .map(|(key, member)| (key.clone(), member.node.to_value()));
                Value::Object(members.collect::<Map<_, _>>())
            }
        }
    }

    /// The same value, all of it from a `--set`.
    pub fn set_by(mut self, index: usize) -> Node {
        self.origin = Origin::Set(index);
        match &mut self.kind {
            Kind::Array(items) => {
                *items = std::mem::take(items)
                    .into_iter()
                    .map(|item| item.set_by(index))
                    .collect();
            }
            Kind::Object(members) => {
                for member in members.values_mut() {
                    member.key = Origin::Set(index);
                    let node = std::mem::replace(
                        &mut member.node,
                        Node {
                            kind: Kind::Null,
                            origin: self.origin,
                        },
                    );
                    member.node = node.set_by(index);
                }
            }
            Kind::Null | Kind::Bool(_) | Kind::Number(_) | Kind::String(_) => {}
        }
        self
    }
}

/// The members of an object; none of what is no object.
pub fn members(node: Option<&Node>) -> impl Iterator<Item = (&String, &Member)> {
    let members = match node.map(|node| &node.kind) {
        Some(Kind::Object(members)) => Some(members.iter()),
        _ => None,
    };
    members.into_iter().flatten()
}

/// Path of a key in the object at `path`.
pub fn join(path: &str, key: &str) -> String {
    if path.is_empty() {
        key.to_owned()
    } else {
        format!("{path}.{key}")
    }
}

/// The beginning of a long text.
pub fn excerpt(text: &str) -> String {
    const LENGTH: usize = 60;
    let mut short: String = text
        .chars()
        .take(LENGTH)
        .map(|c| if c.is_control() { ' ' } else { c })
        .collect();
    if text.chars().nth(LENGTH).is_some() {
        short.push('…');
    }
    short
}
