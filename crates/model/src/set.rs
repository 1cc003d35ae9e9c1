//! `--set PATH=VALUE`: overrides any value of the model, before it is checked.

use super::json;
use super::node::{self, Kind, Member, Node, Origin};
use super::source::Source;
use super::{GROUND, suggest};
use crate::error::Complaint;
use serde_json::Number;

/// A step of a path.
#[derive(Debug, PartialEq)]
enum SetStep<'a> {
    Key(&'a str),
    Index(usize),
}

/// Puts every `--set` over the model, in order.
pub(super) fn apply(source: &mut Source, complaints: &mut Vec<Complaint>) {
    let sets = source.sets.clone();
    let given = names(&source.root);
    let mut refused = Vec::new();
    for (index, set) in sets.iter().enumerate() {
        if let Err((message, hint)) = apply_one(&mut source.root, set, index) {
            refused.push((
                set,
                Complaint::new("", message)
                    .found(format!("--set {}", node::excerpt(set)))
                    .hint(hint),
            ));
        }
    }
    for (kind, known) in KINDS.iter().zip(&given) {
        for (path, complaint) in take_fragments(&mut source.root, kind, known, &sets) {
            // What else is wrong in what does not exist need not be known.
            refused.retain(|(set, _)| !is_inside(set, &path));
            complaints.push(complaint);
        }
    }
    complaints.extend(refused.into_iter().map(|(_, complaint)| complaint));
}

/// Whether a `--set` changes something inside of what is at a path.
fn is_inside(set: &str, path: &str) -> bool {
    set.trim_start()
        .strip_prefix(path)
        .is_some_and(|rest| rest.starts_with(['.', '[']))
}

/// Maps of named things, what one is called, and what makes a new one whole.
const KINDS: [(&str, &str, &[&str]); 4] = [
    ("bodies", "body", &["points"]),
    ("joints", "joint", &["type", "between"]),
    ("drivers", "driver", &["type", "motion"]),
    ("forces", "force", &["type"]),
];

/// The names in each of these maps.
fn names(root: &Node) -> [Vec<String>; KINDS.len()] {
    KINDS.map(|(map, ..)| {
        let names = node::members(root.get(map)).map(|(name, _)| name.clone());
        names.collect()
    })
}

/// Takes out what a `--set` made by a name that does not exist, where that is not a whole thing: it was to change one.
fn take_fragments(
    root: &mut Node,
    (map, what, whole): &(&str, &str, &[&str]),
    known: &[String],
    sets: &[String],
) -> Vec<(String, Complaint)> {
    let Kind::Object(members) = &mut root.kind else {
        return Vec::new();
    };
    let Some(Kind::Object(members)) = members.get_mut(*map).map(|member| &mut member.node.kind)
    else {
        return Vec::new();
    };
    let mut complaints = Vec::new();
    members.retain(|name, member| {
        let (Origin::Set(index), Kind::Object(_)) = (member.key, &member.node.kind) else {
            return true;
        };
        // What was given whole is complained about like anything in a file.
        let path = node::join(map, name);
        if !is_inside(&sets[index], &path)
            || *name == GROUND
            || whole.iter().all(|key| member.node.get(key).is_some())
        {
            return true;
        }
        let hint = match suggest::nearest(name, known.iter().map(String::as_str)) {
            Some(near) => format!("did you mean {near:?}?"),
            None => format!(
                "the {map}: {}; a new one needs {}",
                suggest::list(known.iter()),
                suggest::all_of(whole)
            ),
        };
        let found = format!("--set {}", node::excerpt(&sets[index]));
        complaints.push((
            path,
            Complaint::new("", format!("there is no {what} {name:?}"))
                .found(found)
                .hint(hint),
        ));
        false
    });
    complaints
}

type Refusal = (String, String);

const FORM: &str = "PATH=VALUE is expected, such as joints.b.clearance.radius=\"10 um\"";

fn apply_one(root: &mut Node, set: &str, index: usize) -> Result<(), Refusal> {
    let Some((path, text)) = set.split_once('=') else {
        return Err(("there is no \"=\"".into(), FORM.into()));
    };
    let steps = steps(path.trim())?;
    let value = value(text, index)?;
    if matches!(value.kind, Kind::Null) && take_away(root, &steps) {
        return Ok(());
    }
    let steps = beside_tolerance(root, steps, &value, index);
    take_other(root, &steps);
    *reach(root, &steps, index)? = value;
    Ok(())
}

/// Where the value of a parameter and the place of a point stand that may have a tolerance beside: a number alone is put
/// for the number and leaves the tolerance, and a tolerance is put beside a number that stands alone.
fn beside_tolerance<'a>(
    root: &mut Node,
    mut steps: Vec<SetStep<'a>>,
    value: &Node,
    index: usize,
) -> Vec<SetStep<'a>> {
    let (depth, key) = match steps.as_slice() {
        [SetStep::Key("parameters"), SetStep::Key(_), ..] => (2, "value"),
        [
            SetStep::Key("bodies"),
            SetStep::Key(_),
            SetStep::Key("points"),
            SetStep::Key(_),
            ..,
        ] => (4, "position"),
        _ => return steps,
    };
    let Some(found) = existing(root, &steps[..depth]) else {
        return steps;
    };
    let is_object = |node: &Node| matches!(node.kind, Kind::Object(_));
    match steps.get(depth) {
        // all of it, or a coordinate
        None if is_object(found) && !is_object(value) => steps.push(SetStep::Key(key)),
        Some(SetStep::Index(_)) if is_object(found) => steps.insert(depth, SetStep::Key(key)),
        Some(SetStep::Key(_)) if !is_object(found) => {
            let made = Kind::Object(Box::default());
            let origin = Origin::Set(index);
            let alone = std::mem::replace(found, Node { kind: made, origin });
            if let Kind::Object(members) = &mut found.kind {
                let member = Member {
                    key: origin,
                    node: alone,
                };
                members.insert(key.to_owned(), member);
            }
        }
        None | Some(SetStep::Index(_) | SetStep::Key(_)) => {}
    }
    steps
}

/// What exists at a path of keys.
fn existing<'n>(root: &'n mut Node, steps: &[SetStep<'_>]) -> Option<&'n mut Node> {
    steps
        .iter()
        .try_fold(root, |node, step| match (step, &mut node.kind) {
            (SetStep::Key(key), Kind::Object(members)) => {
                members.get_mut(*key).map(|member| &mut member.node)
            }
            (SetStep::Key(_) | SetStep::Index(_), _) => None,
        })
}

/// `null` takes away what there is; whether there was something.
fn take_away(root: &mut Node, steps: &[SetStep<'_>]) -> bool {
    let Some((SetStep::Key(key), before)) = steps.split_last() else {
        return false;
    };
    match existing(root, before).map(|node| &mut node.kind) {
        Some(Kind::Object(members)) => members.shift_remove(*key).is_some(),
        Some(Kind::Null | Kind::Bool(_) | Kind::Number(_) | Kind::String(_) | Kind::Array(_))
        | None => false,
    }
}

/// The radius of a clearance and its fit exclude each other: the one that is set takes the place of the other.
fn take_other(root: &mut Node, steps: &[SetStep<'_>]) {
    let [
        SetStep::Key("joints"),
        _,
        SetStep::Key("clearance"),
        SetStep::Key(key),
    ] = steps
    else {
        return;
    };
    let other = match *key {
        "radius" => "fit",
        "fit" => "radius",
        _ => return,
    };
    if let Some(Kind::Object(members)) = existing(root, &steps[..3]).map(|node| &mut node.kind) {
        members.shift_remove(other);
    }
}

/// JSON where it is JSON, else a string; but what begins as a list or an object must be one.
fn value(text: &str, index: usize) -> Result<Node, Refusal> {
    let (node, repeats) = match json::parse(text) {
        Ok(parsed) => parsed,
        Err(fault) if text.trim_start().starts_with(['[', '{']) => {
            let column = text[..fault.at].chars().count() + 1;
            let hint = fault.hint.unwrap_or(
                "a list or an object is given as JSON: [0, -9.81] or {\"type\": \"fixed\"}",
            );
            return Err((
                format!(
                    "not JSON at character {column} of the value: {}",
                    fault.message
                ),
                hint.to_owned(),
            ));
        }
        // In a shell .5 is a number, though not in JSON.
        Err(_) => {
            let number = text.trim().parse::<f64>().ok().and_then(Number::from_f64);
            let kind = number.map_or_else(|| Kind::String(text.to_owned()), Kind::Number);
            return Ok(Node {
                kind,
                origin: Origin::Set(index),
            });
        }
    };
    match repeats.first() {
        Some(repeat) => Err((
            format!("the key {:?} is given twice", repeat.key),
            "keep one of them".into(),
        )),
        None => Ok(node.set_by(index)),
    }
}

/// Splits `joints.b.between[1]`.
fn steps(path: &str) -> Result<Vec<SetStep<'_>>, Refusal> {
    let malformed = || {
        (
            format!("{:?} is not a path", node::excerpt(path)),
            FORM.to_owned(),
        )
    };
    let mut steps = Vec::new();
    let mut rest = path;
    loop {
        let end = rest.find(['.', '[']).unwrap_or(rest.len());
        let key = &rest[..end];
        if key.is_empty() || key.contains(']') {
            return Err(malformed());
        }
        steps.push(SetStep::Key(key));
        rest = &rest[end..];
        while let Some(text) = rest.strip_prefix('[') {
            let (index, after) = text.split_once(']').ok_or_else(malformed)?;
            steps.push(SetStep::Index(index.parse().map_err(|_| malformed())?));
            rest = after;
        }
        if steps.len() > json::DEEPEST / 2 {
            return Err(("the path is too deep".into(), FORM.into()));
        }
        if rest.is_empty() {
            return Ok(steps);
        }
        rest = rest.strip_prefix('.').ok_or_else(malformed)?;
    }
}

/// The value at a path; objects that are missing on the way are made.
fn reach<'a>(
    root: &'a mut Node,
    steps: &[SetStep<'_>],
    index: usize,
) -> Result<&'a mut Node, Refusal> {
    let mut node = root;
    let mut way = String::new();
    for step in steps {
        let kind = node.kind_name();
        let here = if way.is_empty() {
            "the model".to_owned()
        } else {
            way.clone()
        };
        match (step, &mut node.kind) {
            (SetStep::Key(key), Kind::Object(members)) => {
                way = node::join(&way, key);
                let made = || Node {
                    kind: Kind::Object(Box::default()),
                    origin: Origin::Set(index),
                };
                node = &mut members
                    .entry((*key).to_owned())
                    .or_insert_with(|| Member {
                        key: Origin::Set(index),
                        node: made(),
                    })
                    .node;
            }
            (SetStep::Index(at), Kind::Array(items)) => {
                way = format!("{way}[{at}]");
                let count = items.len();
                let entries = format!("it has {count}, counted from 0");
                node = items
                    .get_mut(*at)
                    .ok_or_else(|| (format!("{here} has no entry [{at}]"), entries))?;
            }
            (SetStep::Key(key), _) => {
                return Err((
                    format!("{here} is {kind} and has no keys"),
                    format!("the path goes on with {key:?}"),
                ));
            }
            (SetStep::Index(at), _) => {
                return Err((
                    format!("{here} is {kind} and no list"),
                    format!("the path goes on with [{at}]"),
                ));
            }
        }
    }
    Ok(node)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_as_a_shell_has_them_are_numbers() {
        for (text, number) in [
            ("0.5", 0.5),
            (".5", 0.5),
            ("+3", 3.0),
            ("-.81", -0.81),
            ("2.", 2.0),
        ] {
            let kind = value(text, 0).expect("a value").kind;
            assert!(
                matches!(&kind, Kind::Number(found) if found.as_f64() == Some(number)),
                "{text}: {kind:?}"
            );
        }
        for text in ["10 um", "inf", "nan", "crank.A", ""] {
            assert_eq!(
                value(text, 0).expect("a value").kind,
                Kind::String(text.into())
            );
        }
    }
}
