//! Objects and maps of a file.

use indexmap::IndexMap;

use super::{Driven, Walk, texts, wrong_kind};
use crate::GROUND as FIXED;
use crate::accuracy::Column;
use crate::dimension::Dimension;
use crate::error::Complaint;
use crate::examples;
use crate::gate::name_fault;
use crate::node::{Kind, Member, Node, join};
use crate::shape::{Bound, Described, Drives, Either, Field, Measure, Need, Object, Shape, Tagged};
use crate::suggest;
use crate::tree::Tree;
use crate::words;

/// The key of a remark.
pub const NOTE: &str = "note";

/// Members of an object.
type Members = IndexMap<String, Member>;

impl Object {
    /// Whether it has a key, `note` among them.
    pub fn has(&self, key: &str) -> bool {
        key == NOTE || self.field(key).is_some()
    }
}

/// The text at a key.
fn text_of<'m>(members: &'m Members, key: &str) -> Option<&'m str> {
    members.get(key).and_then(|member| member.node.as_str())
}

/// What stands at a key; the stiffness of a contact has a unit where its law is linear.
pub fn shape_of(field: &Field, law: Option<&str>) -> Shape {
    match (field.shape, law) {
        (Shape::ContactStiffness, Some("kelvin_voigt")) => {
            Shape::Quantity(Measure::LinearStiffness, Bound::Above(0.0))
        }
        (shape, _) => shape,
    }
}

/// What a body is; `ground` is one of its own kind.
pub fn body_of(name: &str) -> &'static Described<Object> {
    words::object(if name == FIXED { "Ground" } else { "Body" })
}

impl Walk<'_> {
    /// What is driven inside of an object.
    fn drives(&self, object: &Object, members: &Members, around: Driven) -> Driven {
        match object.drives {
            Drives::Nothing => around,
            Drives::Always(dimension) => Driven::Dimension(dimension),
            Drives::Sampled => self.driven_by(text_of(members, "driver")),
            Drives::Posed => match text_of(members, "driver") {
                None if !members.contains_key("driver") => self.driven_alone(),
                driver => self.driven_by(driver),
            },
            Drives::Measured => {
                self.measured(text_of(members, "column"), members.contains_key("distance"))
            }
        }
    }

    /// What the driver of a name drives.
    pub fn driven_by(&self, driver: Option<&str>) -> Driven {
        let found = driver.and_then(|name| self.driven.get(name));
        found.map_or(Driven::Unknown, |&dimension| Driven::Dimension(dimension))
    }

    /// What the only driver drives.
    pub fn driven_alone(&self) -> Driven {
        let mut known = self.driven.values();
        match (known.next(), known.next()) {
            (Some(&dimension), None) => Driven::Dimension(dimension),
            (Some(_), Some(_)) | (None, _) => Driven::Unknown,
        }
    }

    /// The dimension of a column of results, or of a distance.
    pub fn measured(&self, column: Option<&str>, is_distance: bool) -> Driven {
        let effort = |driver: &str| match self.driven.get(driver)? {
            Dimension::Length => Some(Dimension::Force),
            _ => Some(Dimension::Torque),
        };
        match column {
            None if is_distance => Driven::Dimension(Dimension::Length),
            Some(column) => {
                let found = Column::read(column).and_then(|column| column.dimension(effort));
                found.map_or(Driven::Unknown, Driven::Dimension)
            }
            None => Driven::Unknown,
        }
    }

    /// An object; with its `type` where it is one of several kinds.
    pub(super) fn object(
        &mut self,
        node: &Node,
        object: &Object,
        kind: Option<&str>,
        path: &str,
        driven: Driven,
    ) -> Option<Tree> {
        let Kind::Object(members) = &node.kind else {
            self.complain(node, wrong_kind(path, "an object", node));
            return None;
        };
        let driven = self.drives(object, members, driven);
        let law = members.get("law").and_then(|member| member.node.as_str());
        let mut out = IndexMap::new();
        for (key, member) in members.iter() {
            let here = join(path, key);
            match (object.field(key), kind) {
                (Some(field), _) => {
                    let value = self.value(&member.node, &shape_of(field, law), &here, driven);
                    out.insert(key.clone(), value);
                }
                (None, Some(kind)) if key == "type" => {
                    if self.choice(&member.node, &[kind], &here).is_none() {
                        self.holes.add(&here);
                    }
                    out.insert(key.clone(), kind.into());
                }
                (None, _) if key == NOTE => {
                    self.text(&member.node, &here);
                }
                (None, _) => {
                    if let Some(meant) = self.unknown_key(key, object, kind, members, &here) {
                        let value = self.hole(&meant.shape, &join(path, meant.key));
                        out.insert(meant.key.to_owned(), value);
                    }
                }
            }
        }
        self.missing(node, object, &mut out, path);
        Some(Tree::Map(out))
    }

    /// An object told from others by its `type`.
    pub(super) fn tagged(
        &mut self,
        node: &Node,
        tagged: &Tagged,
        path: &str,
        driven: Driven,
    ) -> Option<Tree> {
        let names = || tagged.variants.iter().map(|variant| variant.name);
        let Kind::Object(members) = &node.kind else {
            self.complain(node, wrong_kind(path, "an object", node));
            return None;
        };
        let Some(member) = members.get("type") else {
            let misspelt = members
                .iter()
                .find(|(key, _)| suggest::nearest(key, ["type"]).is_some());
            match misspelt {
                Some((key, member)) => {
                    let complaint = Complaint::new(join(path, key), "unknown key")
                        .hint("did you mean \"type\"?");
                    self.complain_key(member.key, key, complaint);
                }
                None => {
                    let complaint = Complaint::new(path, "\"type\" is missing");
                    let hint = format!("one of {}", suggest::any_of(names()));
                    self.complain(node, complaint.hint(hint));
                }
            }
            return None;
        };
        // a misspelt type is read as the one that was probably meant, to find what else is wrong
        let kind = member.node.as_str();
        let meant = kind.and_then(|kind| {
            let exact = tagged.variant(kind);
            exact.or_else(|| tagged.variant(suggest::nearest(kind, names())?))
        });
        match meant {
            Some(variant) => self.object(node, variant, Some(variant.name), path, driven),
            None => {
                let names: Vec<&str> = names().collect();
                self.choice(&member.node, &names, &join(path, "type"))?;
                None
            }
        }
    }

    /// Complains about keys that are missing.
    fn missing(
        &mut self,
        node: &Node,
        object: &Object,
        out: &mut IndexMap<String, Tree>,
        path: &str,
    ) {
        for field in object
            .fields
            .iter()
            .filter(|field| field.need == Need::Required)
        {
            if out.contains_key(field.key) {
                continue;
            }
            let mut complaint = Complaint::new(path, format!("{:?} is missing", field.key));
            complaint.hint = examples::of_missing(path, field.key).or_else(|| match field.shape {
                Shape::Choice(choice) => Some(format!("one of {}", suggest::any_of(texts(choice)))),
                _ => None,
            });
            self.complain(node, complaint);
            let value = self.hole(&field.shape, &join(path, field.key));
            out.insert(field.key.to_owned(), value);
        }
        if let Some(either) = &object.either {
            self.either(node, either, out, path);
        }
    }

    /// Complains where none of the keys is there, or two are and must not be.
    fn either(&mut self, node: &Node, either: &Either, out: &IndexMap<String, Tree>, path: &str) {
        let mut given = either.keys.iter().filter(|key| out.contains_key(**key));
        let Some(first) = given.next() else {
            if let Some(hint) = either.needed {
                let key = either.keys[0];
                let complaint = Complaint::new(path, format!("{key:?} is missing"));
                self.complain(node, complaint.hint(hint));
                self.holes.add(&join(path, key));
            }
            return;
        };
        for second in given.filter(|_| either.exclusive) {
            let message = format!("{first:?} and {second:?} exclude each other");
            let complaint = Complaint::new(join(path, second), message);
            let at = node.get(second).unwrap_or(node);
            self.complain(at, complaint.hint("keep one of them"));
            self.holes.add(&join(path, second));
        }
    }

    /// Complains about a key that is not known; the field that was probably meant.
    fn unknown_key<'o>(
        &mut self,
        key: &str,
        object: &'o Object,
        kind: Option<&str>,
        members: &Members,
        path: &str,
    ) -> Option<&'o Field> {
        let origin = members.get(key)?.key;
        if let Some((_, reason)) = object.refused.iter().find(|row| row.0 == key) {
            self.complain_key(origin, key, Complaint::new(path, *reason));
            return None;
        }
        let known: Vec<&str> = kind
            .map(|_| "type")
            .into_iter()
            .chain(object.fields.iter().map(|field| field.key))
            .chain([NOTE])
            .collect();
        let meant = self.unknown(key, &known, members, path)?;
        object.field(meant)
    }

    /// Complains about a key that is none of the known ones; the one that was probably meant.
    fn unknown<'k>(
        &mut self,
        key: &str,
        known: &[&'k str],
        members: &Members,
        path: &str,
    ) -> Option<&'k str> {
        let origin = members.get(key)?.key;
        let free = known
            .iter()
            .copied()
            .filter(|known| !members.contains_key(*known));
        let meant = suggest::nearest(key, free);
        let complaint = Complaint::new(path, "unknown key").hint(match meant {
            Some(meant) => format!("did you mean {meant:?}?"),
            None => format!("known keys: {}", known.join(", ")),
        });
        self.complain_key(origin, key, complaint);
        meant
    }

    /// Things by their names.
    pub(super) fn map(
        &mut self,
        node: &Node,
        of: &Shape,
        path: &str,
        driven: Driven,
    ) -> Option<Tree> {
        self.entries(node, path, driven, |_| *of)
    }

    /// Bodies by their names; `ground` is one of its own kind.
    pub(super) fn bodies(&mut self, node: &Node, path: &str, driven: Driven) -> Option<Tree> {
        self.entries(node, path, driven, |name| Shape::Object(body_of(name)))
    }

    fn entries(
        &mut self,
        node: &Node,
        path: &str,
        driven: Driven,
        of: impl Fn(&str) -> Shape,
    ) -> Option<Tree> {
        let Kind::Object(members) = &node.kind else {
            self.complain(node, wrong_kind(path, "an object", node));
            return None;
        };
        let mut out = IndexMap::new();
        for (name, member) in members.iter() {
            // in a map, `note` is a remark if it is text, else a name like any other
            if name == NOTE && member.node.as_str().is_some() {
                continue;
            }
            let here = join(path, name);
            if let Some((message, hint)) = name_fault(name) {
                let mut complaint = Complaint::new(here.as_str(), message);
                complaint.hint = hint.map(str::to_owned);
                self.complain_key(member.key, name, complaint);
                self.holes.add_key(&here);
            }
            let value = self.value(&member.node, &of(name), &here, driven);
            out.insert(name.clone(), value);
        }
        Some(Tree::Map(out))
    }

    /// `"SI"`, or a unit per dimension.
    pub(super) fn units_of_file(&mut self, node: &Node, path: &str) -> Option<Tree> {
        match &node.kind {
            Kind::Object(members) => self.named_units(members, path),
            _ => self.choice(node, &["SI"], path),
        }
    }

    /// A unit per dimension.
    pub(super) fn named_units(&mut self, members: &Members, path: &str) -> Option<Tree> {
        let names = Dimension::NAMED.into_iter().map(Dimension::name);
        let known: Vec<&str> = names.chain([NOTE]).collect();
        for (key, member) in members {
            let here = join(path, key);
            let dimension = Dimension::NAMED.into_iter().find(|one| one.name() == key);
            match dimension {
                Some(dimension) => {
                    if let Some(text) = self.text(&member.node, &here) {
                        self.unit(&member.node, &text, dimension, &here);
                    }
                }
                None if key == NOTE => {
                    self.text(&member.node, &here);
                }
                None => {
                    self.unknown(key, &known, members, &here);
                }
            }
        }
        Some(Tree::Null)
    }
}
