//! A model printed back as JSON: what the file says where that still gives the model's value, SI numbers elsewhere.
//!
//! Order of keys, units, parameters, expressions and remarks are the file's. A value that was changed is written in SI,
//! as a plain number where the file's unit is that of SI, else with its unit; what is read of it is the same double.

mod places;
mod whole;

use std::collections::HashMap;

use indexmap::IndexMap;
use serde_json::{Map, Value, json};

use super::{DriverKind, FORMAT, Model};
use crate::dimension::Dimension;
use crate::expression::Parameters;
use crate::node::{Kind, Node, members};
use crate::response::Catalogue;
use crate::shape::{Asked, Default, Drives, Field, Measure, Need, Object, Shape, Tagged};
use crate::source::Source;
use crate::tree::Tree;
use crate::units::Unit;
use crate::walk::{COLUMNS, Driven, NOTE, Units, Walk, body_of, entry_driven, shape_of};
use crate::words;

impl Model {
    /// The model as a file in SI units, without parameters and expressions.
    ///
    /// # Examples
    /// ```
    /// let text = br#"{ "format": "linkdyn/1", "units": { "length": "mm" }, "bodies": { "bar": { "points": { "A": [5, 0] } } } }"#;
    /// let model = linkdyn_model::load(text, &[]).unwrap().model;
    /// assert_eq!(model.to_json()["bodies"]["bar"]["points"]["A"][0], 0.005);
    /// ```
    pub fn to_json(&self) -> Value {
        print(&Source::new("", &[]), self)
    }
}

impl Source {
    /// A model as a file: the words of this one wherever they say what the model says.
    ///
    /// # Examples
    /// ```
    /// let text = br#"{ "format": "linkdyn/1", "units": { "length": "mm" }, "bodies": { "bar": { "points": { "A": [5, 0] } } } }"#;
    /// let loaded = linkdyn_model::load(text, &[]).unwrap();
    /// assert_eq!(loaded.source.print(&loaded.model), loaded.document);
    /// let longer = loaded.model.edit(|model| model.bodies["bar"].points["A"][0] = 0.006).unwrap();
    /// assert_eq!(loaded.source.print(&longer)["bodies"]["bar"]["points"]["A"][0], "0.006 m");
    /// ```
    pub fn print(&self, model: &Model) -> Value {
        print(self, model)
    }
}

fn print(source: &Source, model: &Model) -> Value {
    let units = Units::read(source.root.get("units"));
    let (parameters, _) = Parameters::read(source.root.get("parameters"), !units.in_radians());
    let drivers = model.drivers.iter().map(|(name, driver)| {
        let dimension = match driver.kind {
            DriverKind::Rotation { .. } => Dimension::Angle,
            DriverKind::Translation { .. }
            | DriverKind::Length { .. }
            | DriverKind::Point { .. } => Dimension::Length,
        };
        (name.clone(), dimension)
    });
    let driven: HashMap<_, _> = drivers.collect();
    let mut printer = Printer {
        walk: Walk::new(source, units, parameters, driven).knowing(Catalogue::of(model)),
    };
    let written = Some(&source.root);
    let model = printer.object(
        &Tree::of(model),
        words::file(),
        None,
        written,
        Driven::Nothing,
    );
    let mut file = Map::new();
    for (key, value) in [("format", FORMAT), ("units", "SI")] {
        if !model.contains_key(key) {
            file.insert(key.to_owned(), value.into());
        }
    }
    file.extend(model);
    whole::named(&mut file);
    Value::Object(file)
}

/// A value as it is.
fn plain(tree: &Tree) -> Value {
    match tree {
        Tree::Null => Value::Null,
        Tree::Number(number) => json!(number),
        Tree::Count(count) => json!(count),
        Tree::Flag(flag) => json!(flag),
        Tree::Text(text) => json!(text),
        Tree::List(items) => items.iter().map(plain).collect(),
        Tree::Map(members) => {
            let members = members
                .iter()
                .map(|(key, value)| (key.clone(), plain(value)));
            Value::Object(members.collect())
        }
    }
}

/// Whether two values are the same to the last bit.
fn is_same(one: &Tree, other: &Tree) -> bool {
    match (one, other) {
        (Tree::Number(one), Tree::Number(other)) => one.to_bits() == other.to_bits(),
        (Tree::Count(_) | Tree::Flag(_) | Tree::Text(_), other) => one == other,
        (Tree::Null | Tree::Number(_) | Tree::List(_) | Tree::Map(_), _) => false,
    }
}

/// Whether a key may be left out, as it is then what it is here.
fn is_default(tree: &Tree, field: &Field) -> bool {
    let default = match field.need {
        Need::Required | Need::Optional => return false,
        Need::Default(default) | Need::Silent(default) => default,
    };
    let number = Tree::Number;
    match (default, tree) {
        (Default::Zero, tree) => is_same(&number(0.0), tree),
        (Default::Number(default), tree) => is_same(&number(default), tree),
        (Default::Text(text), tree) => tree.text() == Some(text),
        (Default::Zeros, Tree::List(items)) => items.iter().all(|item| is_same(&number(0.0), item)),
        (Default::Empty, Tree::List(items)) => items.is_empty(),
        (Default::Empty, Tree::Map(members)) => members.is_empty(),
        (Default::Same, tree) => match field.shape {
            Shape::Object(object) => object.fields.iter().all(|field| {
                let value = tree.get(field.key);
                value.is_none_or(|value| is_default(value, field))
            }),
            _ => false,
        },
        (
            Default::Zeros | Default::Empty,
            Tree::Null
            | Tree::Number(_)
            | Tree::Count(_)
            | Tree::Flag(_)
            | Tree::Text(_)
            | Tree::Map(_),
        ) => false,
    }
}

struct Printer<'a> {
    /// Reads what the file says.
    walk: Walk<'a>,
}

impl Printer<'_> {
    /// Whether a node says exactly this.
    fn says(&mut self, node: &Node, shape: &Shape, driven: Driven, tree: &Tree) -> bool {
        let value = self.walk.sound(node, shape, driven);
        value.is_some_and(|value| is_same(&value, tree))
    }

    fn value(
        &mut self,
        tree: &Tree,
        shape: &Shape,
        written: Option<&Node>,
        driven: Driven,
    ) -> Value {
        match (shape, tree) {
            (Shape::Materials, materials) => {
                let is_one = materials.get("young_modulus").is_some();
                let object = words::object(if is_one { "Material" } else { "Separate" });
                Value::Object(self.object(materials, object, None, written, driven))
            }
            (Shape::Object(object), tree) => {
                Value::Object(self.object(tree, object, None, written, driven))
            }
            (Shape::Tagged(tagged), tree) => self.tagged(tree, tagged, written, driven),
            (Shape::Asked(Asked::Value | Asked::Constraint), tree) => {
                let text = tree.get("text").and_then(Tree::text);
                text.map_or_else(|| plain(tree), Value::from)
            }
            (
                Shape::Curve(_)
                | Shape::Input
                | Shape::State(_)
                | Shape::Event
                | Shape::Response
                | Shape::Asked(Asked::Design),
                tree,
            ) => self.whole(tree, shape, written, driven),
            (Shape::Formula(_), tree) if tree.get("formula").is_some() => {
                self.whole(tree, shape, written, driven)
            }
            (Shape::Formula(of), tree) => self.value(tree, &Shape::Varying(*of), written, driven),
            (Shape::Varying(dimension), Tree::Map(_)) => self.tagged(
                tree,
                words::kinds("Motion"),
                written,
                Driven::Dimension(*dimension),
            ),
            (Shape::Map(of), Tree::Map(things)) => self.map(things, |_| **of, written, driven),
            (Shape::Bodies, Tree::Map(things)) => {
                self.map(things, |name| Shape::Object(body_of(name)), written, driven)
            }
            (Shape::Pair(of) | Shape::List(of, _), Tree::List(items)) => {
                self.list(items, |_| **of, written, driven)
            }
            (Shape::Range(measure, bound) | Shape::PerAxis(measure, bound), tree) => {
                let each = Shape::Quantity(*measure, *bound);
                self.range(tree, &each, written, driven)
            }
            (Shape::Place, tree) => self.place(tree, written, driven),
            (Shape::Responses, Tree::Map(things)) => {
                self.map(things, |_| Shape::Response, written, driven)
            }
            (Shape::Direction, Tree::List(items)) => {
                let number = Shape::Number(crate::shape::Bound::Any);
                self.list(items, |_| number, written, driven)
            }
            (Shape::Table, Tree::List(points)) => {
                let points = points.iter().enumerate().map(|(index, point)| match point {
                    Tree::List(pair) => {
                        let written = written.and_then(|list| list.entry(index));
                        self.list(pair, |column| COLUMNS[column % 2], written, driven)
                    }
                    other => plain(other),
                });
                points.collect()
            }
            (shape, tree) => self.leaf(tree, shape, written, driven),
        }
    }

    /// A single value: as the file says it, else in SI.
    fn leaf(
        &mut self,
        tree: &Tree,
        shape: &Shape,
        written: Option<&Node>,
        driven: Driven,
    ) -> Value {
        if let Some(node) = written
            && self.says(node, shape, driven, tree)
        {
            return node.to_value();
        }
        match (shape, tree) {
            (Shape::Quantity(measure, _) | Shape::End(measure), Tree::Number(number)) => {
                self.quantity(*number, shape, *measure, driven)
            }
            (Shape::Varying(dimension), Tree::Number(number)) => {
                self.quantity(*number, shape, Measure::Of(*dimension), driven)
            }
            (_, tree) => plain(tree),
        }
    }

    fn quantity(&mut self, number: f64, shape: &Shape, measure: Measure, driven: Driven) -> Value {
        let Some(wanted) = self.walk.units().wanted(measure, driven) else {
            return json!(number);
        };
        if wanted.plain == Unit::si(wanted.powers) {
            return json!(number);
        }
        // No unit has a power as high as the last coefficients of long polynomials want; an expression has.
        let text = format!("{number:?} {}", wanted.si);
        let product = format!("={number:?} {}", wanted.si.replace("/s^", "/(1 s)^"));
        for text in [text, product] {
            let node = Node::of(Kind::String(text));
            if self.says(&node, shape, driven, &Tree::Number(number)) {
                return node.to_value();
            }
        }
        json!(number)
    }

    fn tagged(
        &mut self,
        tree: &Tree,
        tagged: &Tagged,
        written: Option<&Node>,
        driven: Driven,
    ) -> Value {
        let kind = tree.get("type").and_then(Tree::text);
        match kind.and_then(|kind| tagged.variant(kind)) {
            Some(variant) => {
                Value::Object(self.object(tree, variant, Some(variant.name), written, driven))
            }
            None => plain(tree),
        }
    }

    fn object(
        &mut self,
        tree: &Tree,
        object: &Object,
        kind: Option<&str>,
        written: Option<&Node>,
        driven: Driven,
    ) -> Map<String, Value> {
        let driven = match object.drives {
            Drives::Nothing => driven,
            Drives::Always(dimension) => Driven::Dimension(dimension),
            Drives::Sampled => self.walk.driven_by(tree.get("driver").and_then(Tree::text)),
            Drives::Posed => match tree.get("driver").and_then(Tree::text) {
                None => self.walk.driven_alone(),
                driver => self.walk.driven_by(driver),
            },
            Drives::Measured => {
                let column = tree.get("column").and_then(Tree::text);
                self.walk.measured(column, tree.get("distance").is_some())
            }
        };
        let law = tree.get("law").and_then(Tree::text);
        let is_written = |key: &str| written.is_some_and(|node| node.get(key).is_some());
        let mut out = Map::new();
        out.extend(
            kind.filter(|_| !is_written("type"))
                .map(|kind| ("type".to_owned(), kind.into())),
        );
        for (key, member) in members(written) {
            let value = match (object.field(key), kind) {
                (Some(field), _) => match (field.shape, tree.get(key)) {
                    // They are of the file alone.
                    (Shape::Format | Shape::Units | Shape::Parameters, _) => member.node.to_value(),
                    (_, Some(value)) => {
                        self.value(value, &shape_of(field, law), Some(&member.node), driven)
                    }
                    (_, None) => continue,
                },
                (None, Some(kind)) if key == "type" => kind.into(),
                (None, _) if key == NOTE => member.node.to_value(),
                (None, _) => continue,
            };
            out.insert(key.clone(), value);
        }
        // Of keys of which one is needed, the first is written where all may be left out.
        let has_either = |out: &Map<String, Value>, keys: &[&str]| {
            keys.iter().any(|key| {
                let other = object.field(key).zip(tree.get(key));
                out.contains_key(*key)
                    || other.is_some_and(|(field, value)| !is_default(value, field))
            })
        };
        let needed = object.either.as_ref();
        let needed = needed.filter(|either| either.needed.is_some());
        let needed = needed.filter(|either| !has_either(&out, &either.keys));
        let needed = needed.map(|either| either.keys[0]);
        for field in object.fields.iter().filter(|field| !is_written(field.key)) {
            if let Some(value) = tree.get(field.key)
                && (needed == Some(field.key) || !is_default(value, field))
            {
                let value = self.value(value, &shape_of(field, law), None, driven);
                out.insert(field.key.to_owned(), value);
            }
        }
        out
    }

    /// Things in their order, which counts; a remark stays at its place.
    fn map(
        &mut self,
        things: &IndexMap<String, Tree>,
        of: impl Fn(&str) -> Shape,
        written: Option<&Node>,
        driven: Driven,
    ) -> Value {
        let remark = members(written).position(|(key, member)| {
            // a thing of this name is no text
            key == NOTE && member.node.as_str().is_some()
        });
        let remark = remark.zip(written.and_then(|node| node.get(NOTE)).map(Node::to_value));
        let mut entries: Vec<(String, Value)> = Vec::with_capacity(things.len() + 1);
        for (name, thing) in things {
            let is_remark = name == NOTE && remark.is_some();
            let known = written
                .and_then(|node| node.get(name))
                .filter(|_| !is_remark);
            entries.push((name.clone(), self.value(thing, &of(name), known, driven)));
        }
        // A thing may be called like the remark, which then gives way.
        if let Some((index, remark)) = remark.filter(|_| !things.contains_key(NOTE)) {
            entries.insert(index.min(entries.len()), (NOTE.to_owned(), remark));
        }
        Value::Object(entries.into_iter().collect())
    }

    fn list(
        &mut self,
        items: &[Tree],
        of: impl Fn(usize) -> Shape,
        written: Option<&Node>,
        driven: Driven,
    ) -> Value {
        let values = items.iter().enumerate().map(|(index, item)| {
            let shape = of(index);
            let driven = entry_driven(&shape, driven, index);
            self.value(
                item,
                &shape,
                written.and_then(|list| list.entry(index)),
                driven,
            )
        });
        values.collect()
    }
}
