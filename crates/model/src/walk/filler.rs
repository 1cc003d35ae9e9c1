//! Values that stand where a file is faulty, so that the rest of it can be read.

use indexmap::IndexMap;

use crate::event::Event;
use crate::input::ModelInput;
use crate::tree::Tree;

use crate::optimise::{Constraint, Sought};
use crate::shape::{Asked, Need, Object, Shape};
use crate::words;
use crate::{Response, State, Table};

/// A value of a shape that stands for none.
pub fn filler(shape: &Shape) -> Tree {
    match shape {
        Shape::Format | Shape::Text | Shape::Name(_) => Tree::from(""),
        Shape::Units | Shape::Parameters | Shape::Nominal | Shape::Deviations | Shape::End(_) => {
            Tree::Null
        }
        Shape::Point => Tree::from("."),
        Shape::Choice(choice) => Tree::from(choice.words.first().map_or("", |one| one.word)),
        Shape::Quantity(..)
        | Shape::Range(..)
        | Shape::PerAxis(..)
        | Shape::Alike(_)
        | Shape::Number(_)
        | Shape::Coefficient(_)
        | Shape::ContactStiffness
        | Shape::Limit
        | Shape::Varying(_)
        | Shape::Formula(_) => Tree::Number(0.0),
        Shape::Count(least, _) => Tree::Count(*least as u64),
        Shape::Flag => Tree::Flag(false),
        Shape::Direction => [1.0, 0.0].map(Tree::Number).into_iter().collect(),
        Shape::Place => [0.0, 0.0].map(Tree::Number).into_iter().collect(),
        Shape::Pair(of) => Tree::List(vec![filler(of), filler(of)]),
        Shape::Entries | Shape::Entry => Tree::Null,
        Shape::Curve(_) => Tree::of(&Table::default()),
        Shape::Event => Tree::of(&Event::new("")),
        Shape::Input => Tree::of(&ModelInput::default()),
        Shape::State(_) => Tree::of(&State::default()),
        Shape::List(..) | Shape::Table => Tree::List(Vec::new()),
        Shape::Response => Tree::of(&Response::new("")),
        Shape::Asked(Asked::Value) => Tree::of(&Sought::default()),
        Shape::Asked(Asked::Constraint) => Tree::of(&Constraint::default()),
        Shape::Map(_) | Shape::Bodies | Shape::Responses | Shape::Asked(Asked::Design) => {
            Tree::Map(IndexMap::new())
        }
        Shape::Materials => empty(words::object("Material"), None),
        Shape::Object(object) => empty(object, None),
        Shape::Tagged(tagged) => tagged
            .variants
            .first()
            .map_or(Tree::Null, |variant| empty(variant, Some(variant.name))),
    }
}

/// An object with the keys that it may not lack.
fn empty(object: &Object, kind: Option<&str>) -> Tree {
    let kind = kind.map(|kind| ("type".to_owned(), kind.into()));
    let needed = object
        .fields
        .iter()
        .filter(|field| field.need == Need::Required);
    let needed = needed.map(|field| (field.key.to_owned(), filler(&field.shape)));
    Tree::Map(kind.into_iter().chain(needed).collect())
}
