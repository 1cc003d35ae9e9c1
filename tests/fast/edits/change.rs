//! One edit at random of a model.

use super::places::{names, numbers, options};
use super::rng::Rng;
use linkdyn_model::Model;

/// Numbers that people and programs make by mistake.
const ODD: [f64; 12] = [
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    0.0,
    -0.0,
    -1.0,
    1e308,
    -1e300,
    1e-320,
    1e16,
    0.1,
    3.0,
];

/// Names that are there, that are not, and that can't be.
const NAMES: [&str; 12] = [
    "ground",
    "crank",
    "coupler",
    "A",
    "B",
    "note",
    "",
    "a.b",
    "x[0]",
    "new\nline",
    "ü",
    "*",
];

/// Removes, renames, moves or doubles one thing of a map.
macro_rules! edit_map {
    ($map:expr, $rng:expr) => {{
        let map = &mut $map;
        if !map.is_empty() {
            let at = $rng.below(map.len());
            match $rng.below(4) {
                0 => {
                    map.shift_remove_index(at);
                }
                1 => map.move_index(at, 0),
                2 => {
                    if let Some((_, thing)) = map.shift_remove_index(at) {
                        map.insert($rng.word(&NAMES).to_owned(), thing);
                    }
                }
                _ => {
                    let (_, thing) = map.get_index(at).expect("it is there");
                    let thing = thing.clone();
                    map.insert(format!("{}{at}", $rng.word(&NAMES)), thing);
                }
            }
        }
    }};
}

/// Takes out or exchanges a part of what a model would be as JSON.
fn edit_words(value: &mut serde_json::Value, rng: &mut Rng) {
    use serde_json::Value as Json;
    match value {
        Json::Object(members) if !members.is_empty() => {
            let at = rng.below(members.len());
            let key = members.keys().nth(at).cloned().unwrap_or_default();
            if rng.once_in(6) {
                members.shift_remove(&key);
            } else if let Some(member) = members.get_mut(&key) {
                edit_words(member, rng);
            }
        }
        Json::Array(items) if !items.is_empty() => {
            let at = rng.below(items.len());
            match rng.below(6) {
                0 => {
                    items.remove(at);
                }
                1 => items.push(items[at].clone()),
                _ => edit_words(&mut items[at], rng),
            }
        }
        Json::String(text) => {
            let words = [
                "revolute",
                "prismatic",
                "slot",
                "gear",
                "rack",
                "belt",
                "bushing",
                "beam",
                "fixed",
                "rotation",
                "translation",
                "length",
                "chord",
                "tangent",
                "contact",
                "two_state",
                "three_state",
                "massless_link",
                "ideal",
                "dynamics",
                "statics",
                "kinematics",
                "hertz",
                "johnson",
                "flores",
                "lugre",
                "stribeck",
            ];
            *text = rng.word(&words).to_owned();
        }
        Json::Number(_) => *value = rng.unit().into(),
        Json::Null | Json::Bool(_) | Json::Array(_) | Json::Object(_) => {}
    }
}

/// Changes one thing of a model.
pub fn edit(model: &mut Model, rng: &mut Rng) {
    let odd = ODD[rng.below(ODD.len())];
    match rng.below(10) {
        0 | 1 => {
            let mut numbers = numbers(model);
            let at = rng.below(numbers.len());
            *numbers[at] = odd;
        }
        2 => {
            let mut numbers = numbers(model);
            let at = rng.below(numbers.len());
            *numbers[at] *= 1.0 + 0.1 * rng.unit();
        }
        3 => {
            let mut options = options(model);
            let at = rng.below(options.len());
            *options[at] = Some(odd).filter(|_| !rng.once_in(3));
        }
        4 => {
            let mut names = names(model);
            if !names.is_empty() {
                let at = rng.below(names.len());
                *names[at] = rng.word(&NAMES).to_owned();
            }
        }
        5 => match rng.below(6) {
            0 => edit_map!(model.joints, rng),
            1 => edit_map!(model.drivers, rng),
            2 => edit_map!(model.forces, rng),
            3 => edit_map!(model.initial, rng),
            _ => edit_map!(model.bodies, rng),
        },
        6 => {
            let at = rng.below(model.bodies.len());
            if let Some((_, body)) = model.bodies.get_index_mut(at) {
                edit_map!(body.points, rng);
            }
        }
        _ => {
            let mut words = serde_json::to_value(&*model).unwrap_or_default();
            edit_words(&mut words, rng);
            if let Ok(mut edited) = serde_json::from_value::<Model>(words) {
                edited.display = model.display.clone();
                *model = edited;
            }
        }
    }
}
