//! The text of a model file, with its `--set`s: finds the place of everything.

use indexmap::IndexMap;

use super::node::{self, Kind, Member, Node, Origin};
use crate::error::{Complaint, Complaints, Place};

/// A model's text as read, and what `--set` put over it.
#[derive(Debug, Clone)]
pub struct Source {
    text: String,
    /// Byte at which each line begins.
    lines: Vec<usize>,
    pub(super) sets: Vec<String>,
    pub(super) root: Node,
}

impl Source {
    /// The text, before anything is read of it.
    pub(super) fn new(text: &str, sets: &[String]) -> Self {
        let lines = std::iter::once(0)
            .chain(text.match_indices('\n').map(|(at, _)| at + 1))
            .collect();
        Source {
            text: text.to_owned(),
            lines,
            sets: sets.to_vec(),
            root: Node::of(Kind::Null),
        }
    }

    /// As it was read, without the mark of UTF-8.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Line and column of a byte.
    pub(super) fn place_of(&self, at: usize) -> Place {
        let line = self.lines.partition_point(|&start| start <= at).max(1);
        let before = self.text.get(self.lines[line - 1]..at).unwrap_or_default();
        Place {
            line,
            column: before.chars().count() + 1,
        }
    }

    /// Fills in where something came from, and what stands there.
    pub(super) fn complain(
        &self,
        origin: Origin,
        found: Option<String>,
        mut complaint: Complaint,
    ) -> Complaint {
        match origin {
            Origin::Text(start, _) => {
                complaint.place = Some(self.place_of(start));
                complaint.found = found;
            }
            Origin::Set(index) => {
                complaint.found = Some(format!("--set {}", node::excerpt(&self.sets[index])));
            }
        }
        complaint
    }

    /// What stands at a value, where that is short enough to repeat.
    pub(super) fn found(&self, node: &Node) -> Option<String> {
        match (&node.kind, node.origin) {
            (Kind::Array(_) | Kind::Object(_), _) | (_, Origin::Set(_)) => None,
            (_, Origin::Text(start, end)) => self.text.get(start..end).map(node::excerpt),
        }
    }

    /// Byte `at` of a text value, where the file holds it letter by letter; else the value.
    pub(super) fn within(&self, node: &Node, at: usize) -> Origin {
        match node.origin {
            Origin::Text(start, end)
                if self.text.get(start + 1..end.saturating_sub(1)) == node.as_str() =>
            {
                Origin::Text(start + 1 + at, end)
            }
            origin @ (Origin::Text(..) | Origin::Set(_)) => origin,
        }
    }

    /// The value at a path, or the nearest ancestor that exists: the node, where to point at, whether it is the one.
    pub(super) fn find(&self, path: &str) -> (&Node, Origin, bool) {
        let (mut node, mut origin, mut rest) = (&self.root, self.root.origin, path);
        while !rest.is_empty() {
            let step = match &node.kind {
                Kind::Object(members) => {
                    let step = member_at(members, rest.strip_prefix('.').unwrap_or(rest));
                    step.map(|(member, rest)| (&member.node, member.key, rest))
                }
                Kind::Array(items) => rest
                    .strip_prefix('[')
                    .and_then(|text| text.split_once(']'))
                    .and_then(|(index, rest)| {
                        let item = items.get(index.parse::<usize>().ok()?)?;
                        Some((item, item.origin, rest))
                    }),
                Kind::Null | Kind::Bool(_) | Kind::Number(_) | Kind::String(_) => None,
            };
            let Some((next, key, after)) = step else {
                return (node, origin, false);
            };
            (node, origin, rest) = (next, key, after);
        }
        (node, node.origin, true)
    }

    /// Line and column of the value at `path` (`joints.b.between[1]`), or else of the key of its nearest ancestor.
    /// None for what `--set` put there.
    pub fn locate(&self, path: &str) -> Option<Place> {
        match self.find(path).1 {
            Origin::Text(start, _) => Some(self.place_of(start)),
            Origin::Set(_) => None,
        }
    }

    /// Adds to a complaint where its path is and, where it does not say so yet, what stands there.
    pub fn place(&self, complaint: Complaint) -> Complaint {
        if complaint.place.is_some() || complaint.path.is_empty() {
            return complaint;
        }
        let (node, origin, exact) = self.find(&complaint.path);
        let found = complaint
            .found
            .clone()
            .or_else(|| exact.then(|| self.found(node)).flatten());
        self.complain(origin, found, complaint)
    }

    /// Adds to complaints where their paths are.
    pub fn place_all(&self, complaints: Complaints) -> Complaints {
        let placed = complaints.into_iter();
        Complaints(placed.map(|complaint| self.place(complaint)).collect())
    }
}

/// The member that a path begins with, and the rest of the path.
fn member_at<'a, 'p>(
    members: &'a IndexMap<String, Member>,
    path: &'p str,
) -> Option<(&'a Member, &'p str)> {
    let end = path.find(['.', '[']).unwrap_or(path.len());
    if let Some(member) = members.get(&path[..end]) {
        return Some((member, &path[end..]));
    }
    // a name may hold a dot where it should not: then the longest key wins
    let rest = |key: &str| {
        path.strip_prefix(key)
            .filter(|rest| rest.is_empty() || rest.starts_with(['.', '[']))
    };
    let fitting = members
        .iter()
        .filter_map(|(key, member)| Some((member, rest(key)?)));
    fitting.min_by_key(|(_, rest)| rest.len())
}
