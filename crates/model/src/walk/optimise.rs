//! Optimisation in a file: ranges of parameters, expressions that may name responses, equations and inequalities.

use indexmap::IndexMap;

use crate::tree::Tree;

use super::{Driven, NOTE, Walk, wrong_kind};
use crate::error::Complaint;
use crate::examples;
use crate::expression::{Misfit, Quantity};
use crate::node::{Kind, Node, join, members};
use crate::optimise::{Constraint, Relation, Sought};
use crate::response::Catalogue;
use crate::shape::Asked;
use crate::suggest;

/// How comparisons are written.
const RELATIONS: [(&str, Relation); 7] = [
    ("<=", Relation::AtMost),
    (">=", Relation::AtLeast),
    ("≤", Relation::AtMost),
    ("≥", Relation::AtLeast),
    ("<", Relation::AtMost),
    (">", Relation::AtLeast),
    ("=", Relation::Equal),
];

/// The word for a range without bounds.
const FREE: &str = "free";

impl Walk<'_> {
    /// What is asked of an optimisation.
    pub(super) fn asked(&mut self, asked: Asked, node: &Node, path: &str) -> Option<Tree> {
        match asked {
            Asked::Design => self.design(node, path),
            Asked::Value => self.sought(node, path),
            Asked::Constraint => self.constraint(node, path),
        }
    }

    /// Parameters by their names, each with its bounds.
    fn design(&mut self, node: &Node, path: &str) -> Option<Tree> {
        let Kind::Object(members) = &node.kind else {
            self.complain(node, wrong_kind(path, "an object", node));
            return None;
        };
        let mut out = IndexMap::new();
        for (name, member) in members.iter() {
            let here = join(path, name);
            if name == NOTE && !self.parameters.has(NOTE) && member.node.as_str().is_some() {
                continue;
            }
            if !self.parameters.has(name) {
                let complaint = Complaint::new(&here, format!("there is no parameter {name:?}"));
                let names = self.parameters.names();
                let hint = match suggest::nearest(name, names.iter().map(String::as_str)) {
                    Some(near) => format!("did you mean {near:?}?"),
                    None if names.is_empty() => {
                        "give what is to change a name under \"parameters\"".to_owned()
                    }
                    None => format!("the parameters: {}", suggest::list(names.iter())),
                };
                self.complain_key(member.key, name, complaint.hint(hint));
                self.holes.add(&here);
                continue;
            }
            match self.bounds(&member.node, name, &here) {
                Some(range) => {
                    out.insert(name.clone(), range);
                }
                None => self.holes.add(&here),
            }
        }
        if members.is_empty() {
            let complaint = Complaint::new(path, "it is empty, at least one parameter is needed");
            self.complain(node, complaint.hint("as in \"r\": [\"10 mm\", \"60 mm\"]"));
            self.holes.add(path);
        }
        Some(Tree::Map(out))
    }

    /// A lower and an upper bound, or the word for none.
    fn bounds(&mut self, node: &Node, name: &str, path: &str) -> Option<Tree> {
        let example = "as in [\"10 mm\", \"60 mm\"]";
        match &node.kind {
            Kind::String(word) if word == FREE => return Some(FREE.into()),
            Kind::Array(items) if items.len() == 2 => {
                // A parameter without value was complained about there.
                let wanted = self.parameters.value(name)?;
                let mut ends = Vec::new();
                for (index, item) in items.iter().enumerate() {
                    let here = format!("{path}[{index}]");
                    let driven = Driven::Parameter(wanted);
                    ends.push(self.alike_to(item, &here, driven, "as the parameter is"));
                }
                let ends = [ends[0]?, ends[1]?];
                let fault = if ends[0] > ends[1] {
                    Some((
                        "the bounds are the wrong way round",
                        "the lower bound comes first",
                    ))
                } else if ends[0] == ends[1] {
                    Some(("between these bounds there is nothing", example))
                } else {
                    None
                };
                if let Some((message, hint)) = fault {
                    self.complain(node, Complaint::new(path, message).hint(hint));
                    return None;
                }
                return Some(ends.map(Tree::Number).into_iter().collect());
            }
            Kind::Null
            | Kind::Bool(_)
            | Kind::Number(_)
            | Kind::String(_)
            | Kind::Array(_)
            | Kind::Object(_) => {}
        }
        let complaint = Complaint::new(path, "a lower and an upper bound are expected");
        self.complain(node, complaint.hint(example));
        None
    }

    /// An expression whose value is sought.
    fn sought(&mut self, node: &Node, path: &str) -> Option<Tree> {
        let text = self.text(node, path)?;
        let (value, _) = self.side(node, &text, 0, path)?;
        Some(Tree::of(&Sought { text, value }))
    }

    /// An equation or an inequality.
    fn constraint(&mut self, node: &Node, path: &str) -> Option<Tree> {
        let text = self.text(node, path)?;
        let Some((left, relation, right)) = split(&text) else {
            let complaint = Complaint::new(path, "an equation or an inequality is expected");
            let hint = "as in \"stroke = 80 mm\" or \"peak < 40 N*m\"";
            self.complain(node, complaint.hint(hint));
            return None;
        };
        let sides = [left, right].map(|part| {
            let at = part.as_ptr() as usize - text.as_ptr() as usize;
            self.side(node, part, at, path)
        });
        let [Some((left, one)), Some((right, other))] = sides else {
            return None;
        };
        if let (Some(one), Some(other)) = (one, other)
            && !one.is_like(&other)
        {
            let message = format!("{} and {} can't be compared", one.words(), other.words());
            self.complain(node, Complaint::new(path, message));
            return None;
        }
        Some(Tree::of(&Constraint {
            text,
            left,
            relation,
            right,
        }))
    }

    /// A side, without names of responses, and what it measures.
    fn side(
        &mut self,
        node: &Node,
        text: &str,
        at: usize,
        path: &str,
    ) -> Option<(String, Option<Quantity>)> {
        if text.trim().is_empty() {
            let complaint = Complaint::new(path, "an expression is missing");
            let hint = examples::example(path).map(|example| format!("as in {example}"));
            self.complain(node, Complaint { hint, ..complaint });
            return None;
        }
        let root = &self.source.root;
        let catalogue = self
            .catalogue
            .take()
            .unwrap_or_else(|| Catalogue::of_file(root));
        let responses = responses(root);
        let read = self.parameters.with_responses(text, &responses, &catalogue);
        let read = read.and_then(|whole| {
            // Within what a response says there is no place to point at.
            let place = |misfit: Misfit| match whole == text {
                true => misfit,
                false => Misfit { at: 0, ..misfit },
            };
            let measured = self
                .parameters
                .response(&whole, &catalogue)
                .map_err(place)?;
            Ok((whole, measured.map(|(quantity, _)| quantity)))
        });
        self.catalogue = Some(catalogue);
        match read {
            Ok(found) => Some(found),
            Err(Misfit { at: within, fault }) => {
                self.complain_at(node, Some(at + within), fault.at(path));
                None
            }
        }
    }
}

/// Names and texts of the responses of a file.
fn responses(root: &Node) -> Vec<(String, String)> {
    let all = members(root.get("responses")).filter_map(|(name, member)| {
        let node = &member.node;
        let text = node.as_str().or_else(|| node.get("value")?.as_str())?;
        Some((name.clone(), text.to_owned()))
    });
    all.collect()
}

/// Both sides of a comparison, and what stands between them outside of all parentheses and quotes.
fn split(text: &str) -> Option<(&str, Relation, &str)> {
    let (mut depth, mut quoted) = (0_usize, false);
    for (at, sign) in text.char_indices() {
        match sign {
            '\'' => quoted = !quoted,
            _ if quoted => {}
            '(' => depth += 1,
            ')' => depth = depth.saturating_sub(1),
            _ if depth > 0 => {}
            _ => {
                let rest = &text[at..];
                let found = RELATIONS.iter().find(|(sign, _)| rest.starts_with(sign));
                if let Some((sign, relation)) = found {
                    // Of 0 = a = b the rest is complained about as an expression.
                    let right = &rest[sign.len()..];
                    let right = right
                        .strip_prefix('=')
                        .filter(|_| *sign == "=")
                        .unwrap_or(right);
                    return Some((&text[..at], *relation, right));
                }
            }
        }
    }
    None
}
