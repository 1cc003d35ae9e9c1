//! Bodies that meet in points, put into a draft: all in the frame of the drawing.

use linkdyn_model::GROUND;
use serde_json::{Map, Value, json};

use crate::draft::{Draft, Entry, number, numbers};

/// A place in the drawing, in its unit.
pub(super) type At = [f64; 2];

/// The name of a model: that of its file without the ending.
pub(super) fn titled(file: &str, otherwise: &str) -> String {
    let stem = file.rsplit_once('.').map_or(file, |(stem, _)| stem);
    let stem = if stem == "-" { "" } else { stem };
    [stem, otherwise][usize::from(stem.is_empty())].to_owned()
}

/// A new body, named as near to the wish as is free, with what else it has.
pub(super) fn body(draft: &mut Draft, wish: &str, mut more: Entry) -> String {
    let name = Draft::named(&draft.bodies, wish, "link");
    more.insert("points".into(), json!({}));
    draft.bodies.insert(name.clone(), Value::Object(more));
    name
}

/// A point of a body as joints name it: the one that has this name and place, or a new one. The ground comes to be with its first point.
pub(super) fn point(draft: &mut Draft, body: &str, wish: &str, at: At) -> String {
    let body_entry = draft.bodies.entry(body).or_insert_with(|| json!({}));
    let points = members(
        members(body_entry)
            .entry("points")
            .or_insert_with(|| json!({})),
    );
    let at: Value = numbers(at);
    let is_it = |name: &String| points.get(name).is_none_or(|there| *there == at);
    let name = Draft::names(wish, "P").find(is_it).unwrap_or_default();
    points.entry(&name).or_insert(at);
    format!("{body}.{name}")
}

/// A joint of two points, with what else it has; its name.
pub(super) fn join(
    draft: &mut Draft,
    wish: &str,
    kind: &str,
    between: [&str; 2],
    more: Entry,
) -> String {
    let name = Draft::named(&draft.joints, wish, "joint");
    let mut joint = Map::new();
    joint.insert("type".into(), kind.into());
    joint.insert("between".into(), json!(between));
    joint.extend(more);
    draft.joints.insert(name.clone(), Value::Object(joint));
    name
}

/// A pin of several bodies: the first holds each of the others.
pub(super) fn pin(draft: &mut Draft, name: &str, bodies: &[String], at: At) {
    let Some((first, others)) = bodies.split_first() else {
        return;
    };
    let held = point(draft, first, name, at);
    for other in others {
        let holds = point(draft, other, name, at);
        join(draft, name, "revolute", [&held, &holds], Entry::new());
    }
}

/// The key of a slide: its axis in the first body.
pub(super) fn axis(value: Value) -> Entry {
    Entry::from_iter([("axis".to_owned(), value)])
}

/// A motor that turns a body at a constant velocity, relative to the ground or to another.
pub(super) fn motor(draft: &mut Draft, body: &str, relative_to: &str, velocity: &str) {
    let mut driver = json!({ "type": "rotation", "body": body });
    if relative_to != GROUND {
        driver["relative_to"] = relative_to.into();
    }
    drive(draft, "motor", driver, velocity);
}

/// A ram that moves a slide at a constant velocity.
pub(super) fn ram(draft: &mut Draft, joint: &str, velocity: &str) {
    let driver = json!({ "type": "translation", "joint": joint });
    drive(draft, "ram", driver, velocity);
}

fn drive(draft: &mut Draft, wish: &str, mut driver: Value, velocity: &str) {
    driver["motion"] = json!({ "type": "constant_velocity", "velocity": velocity });
    let name = Draft::named(&draft.drivers, wish, wish);
    draft.drivers.insert(name, driver);
}

/// What to compute: the motion, with forces where there are masses, or the position where nothing moves.
pub(super) fn analysis(draft: &mut Draft, end: Option<f64>, has_masses: bool) {
    let mut analysis = Entry::new();
    let end = end.filter(|_| !draft.drivers.is_empty());
    let kind = match end {
        None => "assembly",
        Some(_) if has_masses => "inverse_dynamics",
        Some(_) => "kinematics",
    };
    analysis.insert("type".into(), kind.into());
    if let Some(end) = end {
        analysis.insert("end".into(), number(end));
        analysis.insert("outputs".into(), OUTPUTS.into());
    }
    draft.analysis = analysis;
}

/// A turn by degrees.
const OUTPUTS: u32 = 361;

/// The members of an object; anything else becomes an empty one.
fn members(value: &mut Value) -> &mut Entry {
    if !value.is_object() {
        *value = json!({});
    }
    let Value::Object(members) = value else {
        unreachable!("it is an object now")
    };
    members
}
