//! Rules on single values: numbers in their ranges, names without signs that paths need, lists that are long enough.

use indexmap::IndexMap;

use super::holes::Holes;
use super::names::Reference;
use crate::GROUND as FIXED;
use crate::error::Complaint;
use crate::shape::{Bound, Object, Shape};
use crate::tree::Tree;
use crate::words::{self, LENGTH};

/// A name that a file can't hold: what is wrong, and what would be right.
pub fn name_fault(name: &str) -> Option<(String, Option<&'static str>)> {
    if name.is_empty() {
        return Some(("a name must not be empty".to_owned(), None));
    }
    let bad = name
        .chars()
        .find(|&c| ".[],=*?".contains(c) || c.is_control())?;
    Some((
        format!("a name must not contain {:?}", bad.to_string()),
        Some("nor any of . [ ] , = * ? and control characters"),
    ))
}

/// A list that is too short, where `least` are wanted, or as many where that is `exact`.
pub fn length_fault(found: usize, least: usize, exact: bool) -> String {
    let wanted = if exact {
        format!("{least}")
    } else {
        format!("at least {least}")
    };
    format!("a list of {wanted} is expected, this one has {found}")
}

/// All single values that are not legal, and all that is named, each with its path.
pub(super) fn ranges<'t>(
    model: &'t Tree,
    holes: &Holes,
) -> (Vec<Complaint>, Vec<(String, Reference<'t>)>) {
    let mut look = RangeCheck {
        holes,
        path: String::new(),
        complaints: Vec::new(),
        named: Vec::new(),
    };
    match model {
        Tree::Map(_) => look.object(model, words::file()),
        Tree::Null
        | Tree::Number(_)
        | Tree::Count(_)
        | Tree::Flag(_)
        | Tree::Text(_)
        | Tree::List(_) => {
            look.complain("this is no model");
        }
    }
    (look.complaints, look.named)
}

struct RangeCheck<'h, 't> {
    holes: &'h Holes,
    path: String,
    complaints: Vec<Complaint>,
    named: Vec<(String, Reference<'t>)>,
}

impl<'t> RangeCheck<'_, 't> {
    fn complain(&mut self, message: impl Into<String>) -> &mut Complaint {
        self.complaints.push(Complaint::new(&self.path, message));
        let last = self.complaints.len() - 1;
        &mut self.complaints[last]
    }

    /// Looks at what a step further holds.
    fn enter(&mut self, step: std::fmt::Arguments<'_>, look: impl FnOnce(&mut Self)) {
        let length = self.path.len();
        self.path += &step.to_string();
        if self.holes.is_empty() || !self.holes.has(&self.path) {
            look(self);
        }
        self.path.truncate(length);
    }

    fn key(&mut self, key: &str, look: impl FnOnce(&mut Self)) {
        if self.path.is_empty() {
            self.enter(format_args!("{key}"), look);
        } else {
            self.enter(format_args!(".{key}"), look);
        }
    }

    fn refer(&mut self, reference: Reference<'t>) {
        self.named.push((self.path.clone(), reference));
    }

    fn object(&mut self, tree: &'t Tree, object: &Object) {
        for field in &object.fields {
            if let Some(value) = tree.get(field.key) {
                self.key(field.key, |look| look.value(value, &field.shape));
            }
        }
    }

    /// A number, a motion, or a formula, in which nothing is out of its range.
    fn varying(&mut self, value: &'t Tree) {
        match value {
            Tree::Number(number) => self.number(*number, Bound::Any),
            formula if formula.get("formula").is_some() => {}
            motion => self.value(motion, &Shape::Tagged(words::kinds("Motion"))),
        }
    }

    fn value(&mut self, tree: &'t Tree, shape: &Shape) {
        match (shape, tree) {
            (
                Shape::Quantity(_, bound) | Shape::Number(bound) | Shape::Coefficient(bound),
                Tree::Number(number),
            ) => self.number(*number, *bound),
            (Shape::End(_), Tree::Number(number)) => self.number(*number, Bound::Any),
            (Shape::Range(_, bound), limits) => self.range(limits, *bound),
            (Shape::PerAxis(_, bound), Tree::Number(number)) => self.number(*number, *bound),
            (Shape::PerAxis(measure, bound), Tree::List(items)) => {
                self.list(items, &Shape::Quantity(*measure, *bound), 0);
            }
            (Shape::Place, Tree::List(items)) => self.list(items, &LENGTH, 0),
            (Shape::Place, place) => self.object(place, words::object("Place")),
            (Shape::ContactStiffness, Tree::Number(number)) => {
                self.number(*number, Bound::Above(0.0));
            }
            (Shape::Varying(_) | Shape::Formula(_), value) => self.varying(value),
            (Shape::Count(least, most), Tree::Count(count)) => {
                let bound = Bound::Between(*least as f64, *most as f64);
                self.number(*count as f64, bound);
            }
            (Shape::Direction, Tree::List(items)) => self.direction(items),
            (Shape::Pair(of), Tree::List(items)) => self.list(items, of, 0),
            (Shape::List(of, least), Tree::List(items)) => self.list(items, of, *least),
            (Shape::Table, Tree::List(items)) => {
                self.list(items, &Shape::Pair(&Shape::Number(Bound::Any)), 2);
            }
            (Shape::Materials, materials) => self.materials(materials),
            (Shape::Map(of), Tree::Map(members)) => {
                for (name, value) in members {
                    self.named(name, value, of);
                }
            }
            (Shape::Responses, all) => self.value(all, &Shape::Map(&Shape::Response)),
            (Shape::Bodies, Tree::Map(members)) => self.bodies(members),
            (Shape::Object(object), tree) => self.object(tree, object),
            (Shape::Tagged(tagged), tree) => {
                let kind = tree.get("type").and_then(Tree::text);
                if let Some(variant) = kind.and_then(|kind| tagged.variant(kind)) {
                    self.object(tree, variant);
                }
            }
            (Shape::Point, Tree::Text(text)) => self.refer(Reference::Point(text)),
            (Shape::Name(kind), Tree::Text(name)) => self.refer(Reference::Name(*kind, name)),
            // Their types allow nothing else.
            (_, _) => {}
        }
    }

    fn bodies(&mut self, members: &'t IndexMap<String, Tree>) {
        for (name, value) in members {
            self.named(name, value, &Shape::Object(words::object("Body")));
        }
        if let Some(ground) = members.get(FIXED) {
            self.key(FIXED, |look| look.ground(ground));
        }
    }

    fn materials(&mut self, materials: &'t Tree) {
        let is_one = materials.get("young_modulus").is_some();
        let name = if is_one { "Material" } else { "Separate" };
        self.object(materials, words::object(name));
    }

    fn number(&mut self, number: f64, bound: Bound) {
        if let Some(fault) = bound.fault(number) {
            let complaint = self.complain(fault);
            if !number.is_finite() {
                complaint.found = Some(number.to_string());
            }
        }
    }

    /// A number, or the least and the greatest one.
    fn range(&mut self, limits: &'t Tree, bound: Bound) {
        match limits {
            Tree::Number(number) => self.number(*number, bound),
            Tree::List(items) => {
                for (index, item) in items.iter().enumerate() {
                    if let Tree::Number(number) = item {
                        self.enter(format_args!("[{index}]"), |look| {
                            look.number(*number, bound);
                        });
                    }
                }
                let is_known = |index| !self.holes.has(&format!("{}[{index}]", self.path));
                if let [Tree::Number(least), Tree::Number(most)] = items.as_slice()
                    && least > most
                    && (0..2).all(is_known)
                {
                    self.complain("the range is the wrong way round").hint =
                        Some("the least value comes first".to_owned());
                }
            }
            Tree::Null | Tree::Count(_) | Tree::Flag(_) | Tree::Text(_) | Tree::Map(_) => {}
        }
    }

    fn direction(&mut self, items: &'t [Tree]) {
        let is_known = |index: usize| !self.holes.has(&format!("{}[{index}]", self.path));
        let is_zero = |item: &Tree| *item == Tree::Number(0.0);
        if items.iter().all(is_zero) && (0..items.len()).all(is_known) {
            self.complain("both components are zero, which is no direction");
        }
        self.list(items, &Shape::Number(Bound::Any), 0);
    }

    fn list(&mut self, items: &'t [Tree], of: &Shape, least: usize) {
        if items.len() < least {
            self.complain(length_fault(items.len(), least, false));
        }
        for (index, item) in items.iter().enumerate() {
            self.enter(format_args!("[{index}]"), |look| look.value(item, of));
        }
    }

    fn named(&mut self, name: &str, value: &'t Tree, of: &Shape) {
        self.key(name, |look| {
            if let Some((message, hint)) = name_fault(name)
                && !look.holes.has_key(&look.path)
            {
                let complaint = look.complain(message);
                complaint.found = Some(format!("{name:?}"));
                complaint.hint = hint.map(str::to_owned);
            }
            look.value(value, of);
        });
    }

    /// Ground has points and nothing else.
    fn ground(&mut self, ground: &'t Tree) {
        let rest = Tree::of(&crate::Body::default());
        for (key, reason) in &words::object("Ground").refused {
            if ground.get(key) != rest.get(key) {
                self.key(key, |look| {
                    look.complain(*reason);
                });
            }
        }
    }
}
