//! What a `--set` of a point leaves behind: a body of another length with the mass of the old one.

use super::node::{Kind, Node, Origin, excerpt, members};
use super::{GROUND, suggest};
use crate::error::Complaint;

/// Keys that belong to a body's lengths.
const KEYS: [&str; 3] = ["com", "mass", "inertia"];

/// A warning per body one of whose joint points a `--set` has moved, where the file's centre of mass, mass or inertia stays.
pub(super) fn stale(root: &Node, sets: &[String]) -> Vec<Complaint> {
    let mut found = Vec::new();
    if sets.is_empty() {
        return found;
    }
    for (name, body) in members(root.get("bodies")).filter(|(name, _)| *name != GROUND) {
        let mut moved = members(body.node.get("points")).filter_map(|(point, at)| {
            // a tolerance beside it moves nothing
            Some((point, set_in(at.node.get("position").unwrap_or(&at.node))?))
        });
        let Some((_, set)) = moved.find(|(point, _)| is_joined(root, &format!("{name}.{point}")))
        else {
            continue;
        };
        let left: Vec<&str> = KEYS
            .into_iter()
            .filter(|key| body.node.get(key).is_some_and(is_left))
            .collect();
        let (keys, name) = (suggest::all_of(&left), format!("{name:?}"));
        let message = match left.len() {
            0 => continue,
            1 => format!("{keys} of {name} stays as it was, that of the old shape"),
            _ => format!("{keys} of {name} stay as they were, those of the old shape"),
        };
        let hint = "set them, too, or change a parameter from which all of them follow";
        found.push(
            Complaint::new("", message)
                .found(format!("--set {}", excerpt(&sets[set])))
                .hint(hint),
        );
    }
    found
}

/// Whether a joint connects this point.
fn is_joined(root: &Node, point: &str) -> bool {
    members(root.get("joints")).any(|(_, joint)| {
        let ends = joint.node.get("between");
        let end = |index| ends.and_then(|ends| ends.entry(index)?.as_str());
        [end(0), end(1)].contains(&Some(point))
    })
}

/// The `--set` that a value, or a part of it, comes from.
fn set_in(node: &Node) -> Option<usize> {
    match (node.origin, &node.kind) {
        (Origin::Set(index), _) => Some(index),
        (Origin::Text(..), Kind::Array(items)) => items.iter().find_map(set_in),
        (
            Origin::Text(..),
            Kind::Null | Kind::Bool(_) | Kind::Number(_) | Kind::String(_) | Kind::Object(_),
        ) => None,
    }
}

/// Whether a value is the file's own; zeros stay right.
fn is_left(node: &Node) -> bool {
    let is_zero =
        |node: &Node| matches!(&node.kind, Kind::Number(number) if number.as_f64() == Some(0.0));
    let zero = match &node.kind {
        Kind::Array(items) => items.iter().all(is_zero),
        Kind::Null | Kind::Bool(_) | Kind::Number(_) | Kind::String(_) | Kind::Object(_) => {
            is_zero(node)
        }
    };
    set_in(node).is_none() && !zero
}
