//! Mutants of model files: of their structure, their tokens, their bytes, and values set by `--set`.

mod tables;
mod texts;

pub use tables::{summary, table};
pub use texts::tokens;

use super::rng::Rng;
use super::words;
use serde_json::{Map, Value};

/// A step on the way to a value.
#[derive(Debug, Clone, PartialEq)]
enum Step {
    Key(String),
    At(usize),
}

/// All places below a value.
fn places(value: &Value) -> Vec<Vec<Step>> {
    let mut found = Vec::new();
    let mut open = vec![(Vec::new(), value)];
    while let Some((way, value)) = open.pop() {
        let further = |step: Step| [way.as_slice(), &[step]].concat();
        match value {
            Value::Object(map) => open.extend(
                map.iter()
                    .map(|(key, value)| (further(Step::Key(key.clone())), value)),
            ),
            Value::Array(list) => open.extend(
                list.iter()
                    .enumerate()
                    .map(|(at, value)| (further(Step::At(at)), value)),
            ),
            Value::Null | Value::Bool(_) | Value::Number(_) | Value::String(_) => {}
        }
        if !way.is_empty() {
            found.push(way);
        }
    }
    found
}

fn at<'a>(root: &'a mut Value, way: &[Step]) -> Option<&'a mut Value> {
    way.iter().try_fold(root, |value, step| match step {
        Step::Key(key) => value.get_mut(key.as_str()),
        Step::At(index) => value.get_mut(*index),
    })
}

fn copy(root: &mut Value, way: &[Step]) -> Value {
    at(root, way).map(|value| value.clone()).unwrap_or_default()
}

/// One to four changes of a model's structure; `others` lend their parts.
pub fn structure(rng: &mut Rng, model: &str, others: &[Value]) -> Vec<u8> {
    let mut root: Value = serde_json::from_str(model).unwrap_or_default();
    for _ in 0..=rng.below(4) {
        change(rng, &mut root, others);
    }
    root.to_string().into_bytes()
}

fn change(rng: &mut Rng, root: &mut Value, others: &[Value]) {
    let all = places(root);
    let Some(way) = rng.pick(&all).cloned() else {
        return;
    };
    let Some(other) = rng.pick(&all).cloned() else {
        return;
    };
    match rng.below(20) {
        0 => remove(root, &way),
        1 => rename(rng, root, &way, &other, false),
        2 => rename(rng, root, &way, &other, true),
        3 => {
            let (one, two) = (copy(root, &way), copy(root, &other));
            put(root, &way, two);
            put(root, &other, one);
        }
        4 => {
            let value = copy(root, &other);
            put(root, &way, value);
        }
        5 => put(root, &way, words::value(rng)),
        6..=11 => leaf(rng, root, &all),
        12 | 13 => graft(rng, root, &way, others),
        14 => ends(rng, root),
        15 | 16 => kind(rng, root, &all),
        17 => add(rng, root, others),
        18 => exchange_alike(rng, root, &all),
        _ => double(rng, root, &way),
    }
}

fn put(root: &mut Value, way: &[Step], value: Value) {
    if let Some(place) = at(root, way) {
        *place = value;
    }
}

fn remove(root: &mut Value, way: &[Step]) {
    let Some((last, before)) = way.split_last() else {
        return;
    };
    match (at(root, before), last) {
        (Some(Value::Object(map)), Step::Key(key)) => drop(map.shift_remove(key)),
        (Some(Value::Array(list)), Step::At(index)) if *index < list.len() => {
            drop(list.remove(*index))
        }
        (Some(_) | None, _) => {}
    }
}

/// Another name for a key; the old one stays where it is to be twice there.
fn rename(rng: &mut Rng, root: &mut Value, way: &[Step], other: &[Step], keep: bool) {
    let Some((Step::Key(key), before)) = way.split_last() else {
        return;
    };
    let name = match (rng.below(3), other.last()) {
        (0, Some(Step::Key(name))) => name.clone(),
        (1, _) => words::respelt(rng, key),
        _ => rng.word(words::KEYS).to_string(),
    };
    if let Some(Value::Object(map)) = at(root, before) {
        let value = if keep {
            map.get(key).cloned()
        } else {
            map.shift_remove(key)
        };
        map.insert(name, value.unwrap_or_default());
    }
}

/// Another number or text.
fn leaf(rng: &mut Rng, root: &mut Value, all: &[Vec<Step>]) {
    for _ in 0..20 {
        let Some(way) = rng.pick(all) else { return };
        let Some(place) = at(root, way) else { continue };
        let new = match place {
            Value::Number(old) if rng.once_in(6) => {
                Some(Value::from(format!("{old} {}", words::text(rng))))
            }
            Value::Number(old) => Some(Value::from(words::number(rng, old.as_f64()))),
            Value::String(old) => Some(Value::from(words::respelt(rng, old))),
            Value::Null | Value::Bool(_) | Value::Array(_) | Value::Object(_) => None,
        };
        if let Some(new) = new {
            *place = new;
            return;
        }
    }
}

/// The value of the same key in another model.
fn graft(rng: &mut Rng, root: &mut Value, way: &[Step], others: &[Value]) {
    let Some(mut other) = rng.pick(others).cloned() else {
        return;
    };
    let last = way.last();
    let alike: Vec<Vec<Step>> = places(&other)
        .into_iter()
        .filter(|place| place.last() == last)
        .collect();
    if let Some(place) = rng.pick(&alike) {
        let value = copy(&mut other, place);
        put(root, way, value);
    }
}

/// Both ends of a joint or spring change places, or two joints exchange an end.
fn ends(rng: &mut Rng, root: &mut Value) {
    let is_end = |way: &Vec<Step>| matches!(way.as_slice(), [.., Step::Key(key), Step::At(_)] if key == "between");
    let all: Vec<Vec<Step>> = places(root).into_iter().filter(is_end).collect();
    let (Some(one), Some(two)) = (rng.pick(&all).cloned(), rng.pick(&all).cloned()) else {
        return;
    };
    let (first, second) = (copy(root, &one), copy(root, &two));
    put(root, &one, second);
    put(root, &two, first);
}

/// Another kind of joint, force, motion, analysis or law.
fn kind(rng: &mut Rng, root: &mut Value, all: &[Vec<Step>]) {
    let is_kind = |way: &&Vec<Step>| matches!(way.last(), Some(Step::Key(key)) if ["type", "model", "law", "method"].contains(&key.as_str()));
    let kinds: Vec<&Vec<Step>> = all.iter().filter(is_kind).collect();
    if let Some(way) = rng.pick(&kinds) {
        put(root, way, Value::from(rng.word(words::KINDS)));
    }
}

/// A key with the value it has in another model, or with any.
fn add(rng: &mut Rng, root: &mut Value, others: &[Value]) {
    let objects: Vec<Vec<Step>> = places(root);
    let Some(way) = rng.pick(&objects) else {
        return;
    };
    let mut other = rng.pick(others).cloned().unwrap_or_default();
    let lent = places(&other);
    let (key, value) = match (rng.pick(&lent), rng.once_in(3)) {
        (Some(place), false) => match place.last() {
            Some(Step::Key(key)) => (key.clone(), copy(&mut other, place)),
            Some(Step::At(_)) | None => return,
        },
        (Some(_) | None, _) => (rng.word(words::KEYS).to_string(), words::value(rng)),
    };
    match at(root, way) {
        Some(Value::Object(map)) => drop(map.insert(key, value)),
        Some(Value::Array(list)) => list.push(value),
        Some(_) | None => {}
    }
}

/// Two values under the same key exchange their places: masses, poses, points, motions.
fn exchange_alike(rng: &mut Rng, root: &mut Value, all: &[Vec<Step>]) {
    let Some(one) = rng.pick(all).cloned() else {
        return;
    };
    let alike: Vec<&Vec<Step>> = all
        .iter()
        .filter(|way| way.last() == one.last() && **way != one)
        .collect();
    let Some(two) = rng.pick(&alike).map(|way| (*way).clone()) else {
        return;
    };
    let (first, second) = (copy(root, &one), copy(root, &two));
    put(root, &one, second);
    put(root, &two, first);
}

/// A second part like one that is there: a doubled body, joint, driver or force.
fn double(rng: &mut Rng, root: &mut Value, way: &[Step]) {
    let Some((Step::Key(part), _)) = way.split_first() else {
        return;
    };
    if let Some(Value::Object(map)) = root.get_mut(part.as_str()) {
        let names: Vec<String> = map.keys().cloned().collect();
        if let Some(name) = rng.pick(&names) {
            let value = map.get(name).cloned().unwrap_or_default();
            map.insert(format!("{name}2"), value);
        }
    }
}

/// One to three numbers of any size a double can have at places where numbers stand, and sometimes one of the solver's.
pub fn extremes(rng: &mut Rng, model: &str) -> Vec<u8> {
    let mut root: Value = serde_json::from_str(model).unwrap_or_default();
    let is_number = |root: &mut Value, way: &[Step]| match at(root, way) {
        Some(Value::Number(_)) => true,
        Some(Value::String(text)) => split(text).is_some(),
        Some(_) | None => false,
    };
    let mut all = places(&root);
    all.retain(|way| is_number(&mut root, way));
    for _ in 0..=rng.below(3) {
        let Some(way) = rng.pick(&all) else { break };
        let number = words::extreme(rng);
        let new = match at(&mut root, way) {
            Some(Value::String(text)) => split(text)
                .map(|unit| Value::from(format!("{number:?} {unit}")))
                .unwrap_or_default(),
            Some(_) | None => Value::from(number),
        };
        put(&mut root, way, new);
    }
    if rng.once_in(6)
        && let Some(Value::Object(analysis)) = root.get_mut("analysis")
    {
        let key = rng.word(&["rtol", "atol", "max_step", "initial_step"]);
        let solver = analysis
            .entry("solver")
            .or_insert_with(|| Map::new().into());
        if let Some(solver) = solver.as_object_mut() {
            let number = match key {
                "rtol" | "atol" => 10.0_f64.powf(-16.0 * rng.unit()),
                _ => words::extreme(rng).abs(),
            };
            solver.insert(key.to_owned(), Value::from(number));
        }
    }
    root.to_string().into_bytes()
}

/// The unit of a text that is a number with a unit.
fn split(text: &str) -> Option<&str> {
    let (number, unit) = text.split_once(' ')?;
    number.parse::<f64>().ok().map(|_| unit)
}

/// Bytes flipped, cut off, doubled, taken from another file; also such that are no UTF-8.
pub fn bytes(rng: &mut Rng, model: &[u8], other: &[u8]) -> Vec<u8> {
    let mut bytes = model.to_vec();
    for _ in 0..=rng.below(3) {
        if bytes.is_empty() {
            break;
        }
        let here = rng.below(bytes.len());
        let length = rng.below(40).min(bytes.len() - here);
        match rng.below(8) {
            0 => bytes[here] ^= 1 << rng.below(8),
            1 => bytes[here] = rng.below(256) as u8,
            2 => bytes.truncate(here),
            3 => drop(bytes.drain(here..here + length)),
            4 => {
                let piece = bytes[here..here + length].to_vec();
                let there = rng.below(bytes.len());
                bytes.splice(there..there, piece);
            }
            5 => {
                let from = rng.below(other.len());
                let piece = other[from..(from + 200).min(other.len())].to_vec();
                bytes.splice(here..here + length, piece);
            }
            6 => drop(bytes.splice(here..here, [0xff, 0xfe, 0xc0, 0x80])),
            _ => {
                let digit = b"0123456789eE+-.\"{}[]:,"[rng.below(22)];
                bytes.insert(here, digit);
            }
        }
    }
    bytes
}

/// `--set PATH=VALUE`, one to three.
pub fn sets(rng: &mut Rng, model: &str) -> Vec<String> {
    let mut root: Value = serde_json::from_str(model).unwrap_or_default();
    let all = places(&root);
    let mut sets = Vec::new();
    for _ in 0..=rng.below(3) {
        let Some(way) = rng.pick(&all) else { break };
        let mut path = spelt(way);
        match rng.below(12) {
            0 => path = words::respelt(rng, &path),
            1 => path = format!("{path}.{}", rng.word(words::KEYS)),
            2 => path = rng.word(words::KEYS).to_string(),
            3 => path.push_str("[0]"),
            _ => {}
        }
        let value = match copy(&mut root, way) {
            Value::Number(old) if !rng.once_in(4) => words::number(rng, old.as_f64()).to_string(),
            Value::String(old) if !rng.once_in(4) => words::respelt(rng, &old),
            _ if rng.once_in(3) => words::text(rng),
            _ => words::value(rng).to_string(),
        };
        sets.push(if rng.once_in(40) {
            path
        } else {
            format!("{path}={value}")
        });
    }
    sets
}

fn spelt(way: &[Step]) -> String {
    let mut path = String::new();
    for step in way {
        match step {
            Step::Key(key) if path.is_empty() => path.push_str(key),
            Step::Key(key) => path = format!("{path}.{key}"),
            Step::At(index) => path = format!("{path}[{index}]"),
        }
    }
    path
}
