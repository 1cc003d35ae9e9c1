//! Mutants of all files: no panic, no hang, and what is read is a model, or has faults that are told.

use std::time::{Duration, Instant};

use serde_json::{Value, json};

use super::*;

/// Mutants of each format.
const MUTANTS: u64 = 10_000;

/// Random numbers that repeat: SplitMix64.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn below(&mut self, count: usize) -> usize {
        (self.next() % count.max(1) as u64) as usize
    }
}

/// Words that are where something is expected.
const WORDS: [&str; 16] = [
    "",
    "0",
    "-1",
    "1e999",
    "nan",
    "A",
    "null",
    "{}",
    "[[[[",
    ",,,",
    "..",
    "~",
    "\u{0}",
    "é",
    "Infinity",
    "99999999999999999999",
];

fn mutant(origin: &str, random: &mut Random, marks: &[char]) -> Vec<u8> {
    let mut bytes = origin.as_bytes().to_vec();
    for _ in 0..=random.below(3) {
        let at = random.below(bytes.len() + 1);
        let to = (at + random.below(40)).min(bytes.len());
        match random.below(7) {
            0 => bytes.truncate(at),
            1 => {
                let part = bytes[at..to].to_vec();
                let here = random.below(bytes.len() + 1);
                bytes.splice(here..here, part);
            }
            2 => {
                bytes.drain(at..to);
            }
            3 if at < bytes.len() => bytes[at] = random.next() as u8,
            // A cell becomes another, or one of the words.
            4 | 5 => {
                let is_mark = |k: &usize| marks.contains(&char::from(bytes[*k]));
                let cells: Vec<usize> = (0..bytes.len()).filter(is_mark).collect();
                let mut cell = || {
                    let k = random.below(cells.len());
                    let start = cells.get(k).map_or(0, |mark| mark + 1);
                    start..cells.get(k + 1).copied().unwrap_or(bytes.len()).max(start)
                };
                let (here, other) = (cell(), cell());
                let other = bytes[other].to_vec();
                let word = match random.below(2) {
                    0 => WORDS[random.below(WORDS.len())].as_bytes().to_vec(),
                    _ => other,
                };
                bytes.splice(here, word);
            }
            _ => {
                let deep = "[{\"a\":".repeat(random.below(400));
                bytes.splice(at..at, deep.bytes());
            }
        }
    }
    bytes
}

/// A JSON text of which a few values are others: what no rule of the syntax stops.
fn altered(text: &str, random: &mut Random) -> Option<Vec<u8>> {
    fn places(value: &Value, at: &str, all: &mut Vec<String>) {
        all.push(at.to_owned());
        match value {
            Value::Array(items) => (0..)
                .zip(items)
                .for_each(|(k, item): (usize, _)| places(item, &format!("{at}/{k}"), all)),
            Value::Object(members) => members
                .iter()
                .for_each(|(key, item)| places(item, &format!("{at}/{key}"), all)),
            Value::Null | Value::Bool(_) | Value::Number(_) | Value::String(_) => {}
        }
    }
    let mut value: Value = serde_json::from_str(text).ok()?;
    for _ in 0..=random.below(3) {
        let mut all = Vec::new();
        places(&value, "", &mut all);
        let other = value.pointer(&all[random.below(all.len())])?.clone();
        let others = [
            json!(null),
            json!(0),
            json!(-1e300),
            json!(1e-300),
            json!("A"),
            json!([]),
            json!({}),
            other,
        ];
        let at = &all[random.below(all.len())];
        *value.pointer_mut(at)? = others[random.below(16).min(7)].clone();
    }
    Some(value.to_string().into_bytes())
}

fn survives(format: Format, origins: &[&str], marks: &[char], mend: fn(Vec<u8>) -> Vec<u8>) {
    let (mut models, mut refused, mut faults) = (0, 0, 0);
    for number in 0..MUTANTS {
        let mut random = Random(number.wrapping_mul(0xd1b5_4a32_d192_ed03));
        let origin = origins[random.below(origins.len())];
        let altered = (random.below(2) == 0).then(|| altered(origin, &mut random));
        let altered = altered.flatten();
        let bytes = altered.unwrap_or_else(|| mutant(origin, &mut random, marks));
        let bytes = if random.below(4) > 0 {
            mend(bytes)
        } else {
            bytes
        };
        let begun = Instant::now();
        let read = import("mutant", &bytes, Some(format), &Options::default());
        let told = || format!("{number}: {}", String::from_utf8_lossy(&bytes));
        match read {
            Ok(imported) => {
                let text = imported.draft.text();
                assert!(!text.contains("NaN") && !text.contains("inf"), "{}", told());
                match linkdyn_model::load(text.as_bytes(), &[]) {
                    Ok(_) => models += 1,
                    Err(complaints) => {
                        if faults % 100 == 0 {
                            println!("{complaints}");
                        }
                        assert!(!complaints.to_string().is_empty(), "{}", told());
                        faults += 1;
                    }
                }
            }
            Err(Refused { cause, mend, .. }) => {
                assert!(
                    !cause.is_empty() && !mend.is_empty() && !cause.contains('\n'),
                    "{}",
                    told()
                );
                refused += 1;
            }
        }
        assert!(begun.elapsed() < Duration::from_secs(1), "{}", told());
    }
    println!("{format:?}: {models} models, {faults} with faults, {refused} refused");
    assert!(
        models > MUTANTS / 50 && refused > MUTANTS / 50,
        "{models} models, {refused} refused"
    );
    // What is read is a model: only names and sizes that the format has not are told later.
    assert!(faults < MUTANTS / 20, "{faults}");
}

#[test]
fn links_of_pmks() {
    let links: Vec<&str> = links().into_iter().map(|(_, link)| link).collect();
    // Most get checks that fit, so that what is behind them is read.
    let mend = |bytes: Vec<u8>| -> Vec<u8> {
        let text = String::from_utf8_lossy(&bytes).into_owned();
        let body = text.split('*').next().unwrap_or_default();
        let end = body.char_indices().next_back().map_or(0, |(at, _)| at);
        checked(&body[..end]).into_bytes()
    };
    survives(Format::Pmks, &links, &['.', ','], mend);
}

#[test]
fn files_of_pylinkage() {
    let files = [
        include_str!("pylinkage-four-bar.json"),
        include_str!("pylinkage-strider.json"),
        include_str!("pylinkage-stroke-engine.json"),
        include_str!("mechanism-four-bar.json"),
        include_str!("mechanism-plate.json"),
        include_str!("mechanism-slider-crank.json"),
    ];
    survives(Format::Pylinkage, &files, &['"', ':', ','], |bytes| bytes);
}

#[test]
fn tables_of_points() {
    let tables = [
        "body,point,x [mm],y [mm]\nground,A,0,0\nground,D,120,20\nhandle,A,0,0\nhandle,B,40,30.5\nlink,B,40,30.5\nlink,C,100,55\narm,C,100,55\narm,D,120,20\n",
        "joint,x,y,bodies\nA,0,0,ground crank\nB,1,0,crank rod\nC,3,2,rod rocker\nD,4,0,ground rocker\nP,2,2,rod\n",
    ];
    survives(Format::Csv, &tables, &['\n', ','], |bytes| bytes);
}
