//! Values that stand where a file is faulty, so that the rest of it can be read.

use serde_json::{Map, Value};

use crate::shape::{Asked, Need, Object, Shape};
use crate::words;

/// A value of a shape that stands for none.
pub fn filler(shape: &Shape) -> Value {
    match shape {
        Shape::Format | Shape::Text | Shape::Name(_) => Value::from(""),
        Shape::Units | Shape::Parameters | Shape::Nominal | Shape::Deviations | Shape::End(_) => {
            Value::Null
        }
        Shape::Point => Value::from("."),
        Shape::Choice(choice) => Value::from(choice.words.first().map_or("", |word| word.0)),
        Shape::Quantity(..)
        | Shape::Range(..)
        | Shape::PerAxis(..)
        | Shape::Alike(_)
        | Shape::Number(_)
        | Shape::Coefficient(_)
        | Shape::ContactStiffness
        | Shape::Limit
        | Shape::Varying(_)
        | Shape::Formula(_) => Value::from(0.0),
        Shape::Count(least, _) => Value::from(*least),
        Shape::Direction => Value::from(vec![1.0, 0.0]),
        Shape::Place => Value::from(vec![0.0, 0.0]),
        Shape::Pair(of) => Value::from(vec![filler(of), filler(of)]),
        Shape::Entries | Shape::Entry => Value::Null,
        Shape::Curve(_) => serde_json::json!({ "points": [] }),
        Shape::Event => serde_json::json!({ "event": "" }),
        Shape::State(_) => serde_json::json!({ "rate": { "formula": "=0" } }),
        Shape::List(..) | Shape::Table => Value::Array(Vec::new()),
        Shape::Response => serde_json::json!({ "value": "" }),
        Shape::Asked(Asked::Value) => serde_json::json!({ "text": "", "value": "" }),
        Shape::Asked(Asked::Constraint) => {
            serde_json::json!({ "text": "", "left": "", "relation": "equal", "right": "" })
        }
        Shape::Map(_) | Shape::Bodies | Shape::Responses | Shape::Asked(Asked::Design) => {
            Value::Object(Map::new())
        }
        Shape::Materials => empty(words::object("Material"), None),
        Shape::Object(object) => empty(object, None),
        Shape::Tagged(tagged) => tagged
            .variants
            .first()
            .map_or(Value::Null, |variant| empty(variant, Some(variant.name))),
    }
}

/// An object with the keys that it may not lack.
fn empty(object: &Object, kind: Option<&str>) -> Value {
    let kind = kind.map(|kind| ("type".to_owned(), kind.into()));
    let needed = object
        .fields
        .iter()
        .filter(|field| field.need == Need::Required);
    let needed = needed.map(|field| (field.key.to_owned(), filler(&field.shape)));
    Value::Object(kind.into_iter().chain(needed).collect())
}
