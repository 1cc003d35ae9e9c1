//! The fuzzer: mutants of models, of `--set` and of result files, given to every command that reads them.
//!
//! What must hold of each: no panic, no run longer than its limit and a second, no number that does not exist in a file, an exit
//! status of the contract, and for each complaint a place and words. A mutant is told by its seed and number alone.

// Of the benchmark and the tests each uses a part.
#![allow(dead_code, unused_imports)]

mod mutate;
mod oracle;
mod rng;
mod runner;
mod words;

use std::fs;
use std::path::{Path, PathBuf};

use linkdyn_model::bundled;
use linkdyn_validation::{CASES, CaseKind};
use serde_json::Value;

pub use oracle::{ENDS, Find};
pub use runner::{Runner, at, watch};

use rng::Rng;

/// What mutants are made of.
#[derive(Debug)]
struct Origin {
    name: String,
    text: String,
}

/// Where a mutant differs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Class {
    Structure,
    Extremes,
    Tokens,
    Bytes,
    Sets,
    Results,
}

impl Class {
    pub const ALL: [Class; 6] = [
        Class::Structure,
        Class::Extremes,
        Class::Tokens,
        Class::Bytes,
        Class::Sets,
        Class::Results,
    ];

    pub fn word(self) -> &'static str {
        match self {
            Class::Structure => "structure",
            Class::Extremes => "extremes",
            Class::Tokens => "tokens",
            Class::Bytes => "bytes",
            Class::Sets => "set",
            Class::Results => "results",
        }
    }

    /// Of a mutant's number: four of ten structure.
    fn of(number: u64) -> Self {
        match number % 10 {
            0..=3 => Class::Structure,
            4 => Class::Extremes,
            5 => Class::Tokens,
            6 => Class::Bytes,
            7 | 8 => Class::Sets,
            _ => Class::Results,
        }
    }
}

/// One input.
#[derive(Debug, Clone)]
pub struct Mutant {
    pub class: Class,
    /// The file it was made from.
    pub of: String,
    /// The model, or the table of results.
    pub bytes: Vec<u8>,
    /// Of a mutant of results.
    pub summary: Vec<u8>,
    pub sets: Vec<String>,
}

/// Mutants and what they are tried on.
#[derive(Debug)]
pub struct Fuzzer {
    origins: Vec<Origin>,
    values: Vec<Value>,
    /// `results.csv` and `summary.json` of sound runs.
    results: Vec<(String, String, String)>,
    /// Words like "NaN" that the page of a sound run has.
    odd_in_report: usize,
    scratch: PathBuf,
    pub runner: Runner,
    /// `max_wall_time` [s].
    limit: f64,
    seed: u64,
}

/// Mechanisms smaller than any bundled one.
const SMALL: &[(&str, &str)] = &[
    (
        "small bar",
        r#"{"format":"linkdyn/1","units":"SI","gravity":[0,-9.81],"bodies":{"ground":{"points":{"O":[0,0]}},"bar":{"mass":1,"inertia":0.1,"com":[0.5,0],"points":{"O":[0,0],"A":[1,0]}}},"joints":{"o":{"type":"revolute","between":["ground.O","bar.O"]}},"initial":{"bar":{"angle":0,"angular_velocity":1}},"analysis":{"type":"dynamics","end":1,"outputs":11}}"#,
    ),
    (
        "small free body",
        r#"{"format":"linkdyn/1","units":{"length":"mm"},"bodies":{"stone":{"mass":"2 kg","inertia":"1 kg*m^2","com":[0,0],"points":{"A":[10,0]}}},"forces":{"push":{"type":"force","at":"stone.A","value":["3 N",0]}},"analysis":{"type":"dynamics","end":1,"outputs":5}}"#,
    ),
    (
        "small driven crank",
        r#"{"format":"linkdyn/1","units":{"length":"mm","angle":"deg"},"parameters":{"r":"50 mm"},"bodies":{"ground":{"points":{"O":[0,0]}},"crank":{"points":{"O":[0,0],"A":["=r",0]}}},"joints":{"o":{"type":"revolute","between":["ground.O","crank.O"]}},"drivers":{"motor":{"type":"rotation","body":"crank","motion":{"type":"harmonic","amplitude":30,"frequency":"1 Hz"}}},"points":["crank.A"],"analysis":{"type":"kinematics","end":1,"outputs":9}}"#,
    ),
];

impl Fuzzer {
    /// Reads what mutants are made of; `scratch` is a folder for files of one mutant at a time.
    pub fn new(seed: u64, limit: f64, scratch: &Path, runner: Runner) -> Self {
        let mut origins: Vec<Origin> = SMALL
            .iter()
            .map(|(name, text)| Origin {
                name: name.to_string(),
                text: text.to_string(),
            })
            .collect();
        let bundled = bundled::MODELS.iter();
        origins.extend(bundled.map(|b| Origin {
            name: b.name.to_string(),
            text: b.text.to_string(),
        }));
        let cases = CASES.iter().filter_map(|case| match case.kind {
            CaseKind::Reference(reference) => Some((case.name, reference.read().ok()?.model)),
            CaseKind::Coded { .. } => None,
        });
        // Large ones cost much and have nothing that small ones lack.
        let cases = cases
            .filter(|(_, model)| model.is_object())
            .map(|(name, model)| (name, model.to_string()));
        let cases = cases.filter(|(_, text)| text.len() < 12_000);
        origins.extend(cases.map(|(name, text)| Origin {
            name: format!("case {name}"),
            text,
        }));
        for folder in ["src/cli/templates", "tests/cases"] {
            let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
            let mut files: Vec<PathBuf> = fs::read_dir(folder)
                .into_iter()
                .flatten()
                .filter_map(|entry| Some(entry.ok()?.path()))
                .collect();
            files.sort();
            let texts = files
                .iter()
                .filter_map(|file| Some((file, fs::read_to_string(file).ok()?)));
            origins.extend(
                texts
                    .filter(|(_, text)| text.trim_start().starts_with('{') && text.len() < 12_000)
                    .map(|(file, text)| Origin {
                        name: file
                            .file_stem()
                            .unwrap_or_default()
                            .to_string_lossy()
                            .into_owned(),
                        text,
                    }),
            );
        }
        let values = origins
            .iter()
            .filter_map(|origin| serde_json::from_str(&origin.text).ok())
            .collect();
        fs::create_dir_all(scratch).expect("a scratch folder");
        let scratch = scratch.to_path_buf();
        let mut fuzzer = Fuzzer {
            origins,
            values,
            results: Vec::new(),
            odd_in_report: 0,
            scratch,
            runner,
            limit,
            seed,
        };
        fuzzer.sound_results();
        fuzzer
    }

    /// Results that mutants of results are made of.
    fn sound_results(&mut self) {
        for (model, set) in [
            ("four-bar", "analysis.outputs=9"),
            ("slider-crank-clearance", "analysis.end=0.002"),
            ("watt-i-lock", "analysis.sample.step=\"25 deg\""),
            ("geared-five-bar", "analysis.outputs=5"),
            ("four-bar-spring", "name=rhombus"),
        ] {
            let folder = self.scratch.join("sound");
            let arguments =
                ["linkdyn", "run", model, "--set", set, "-o"].map(std::ffi::OsString::from);
            let said = linkdyn::cli::captured(arguments.into_iter().chain([folder.clone().into()]));
            assert_eq!((said.status, said.stderr.as_str()), (0, ""), "{model}");
            let read = |name: &str| fs::read_to_string(folder.join(name)).expect(name);
            // Times of the clock are others each time, and mutants are not.
            let mut summary: Value = serde_json::from_str(&read("summary.json")).expect("JSON");
            summary
                .as_object_mut()
                .map(|facts| facts.shift_remove("timing"));
            self.results.push((
                model.to_string(),
                read("results.csv"),
                format!("{summary:#}\n"),
            ));
            self.odd_in_report = oracle::odd_words_of_page(&read("report.html"));
        }
    }

    /// The mutant of a number.
    pub fn mutant(&self, number: u64) -> Mutant {
        let mut rng = Rng::new(self.seed, number);
        let class = Class::of(number);
        if class == Class::Results {
            let (of, table, summary) = &self.results[rng.below(self.results.len())];
            let (mut bytes, mut new_summary) =
                (table.clone().into_bytes(), summary.clone().into_bytes());
            if rng.once_in(2) {
                bytes = mutate::table(&mut rng, table);
            } else {
                new_summary = mutate::summary(&mut rng, summary);
            }
            return Mutant {
                class,
                of: of.clone(),
                bytes,
                summary: new_summary,
                sets: Vec::new(),
            };
        }
        let origin = &self.origins[rng.below(self.origins.len())];
        let other = &self.origins[rng.below(self.origins.len())];
        let (mut bytes, mut sets) = (origin.text.clone().into_bytes(), Vec::new());
        match class {
            Class::Structure => bytes = mutate::structure(&mut rng, &origin.text, &self.values),
            Class::Extremes => bytes = mutate::extremes(&mut rng, &origin.text),
            Class::Tokens => bytes = mutate::tokens(&mut rng, &origin.text),
            Class::Bytes => {
                bytes = mutate::bytes(&mut rng, origin.text.as_bytes(), other.text.as_bytes())
            }
            Class::Sets | Class::Results => sets = mutate::sets(&mut rng, &origin.text),
        }
        Mutant {
            class,
            of: origin.name.clone(),
            bytes,
            summary: Vec::new(),
            sets,
        }
    }

    /// Tries all that a mutant is for; what does not hold.
    pub fn try_mutant(&self, number: u64, mutant: &Mutant) -> Vec<Find> {
        // Another stream than that of the mutation.
        let rng = Rng::new(self.seed ^ 0x5eed, number);
        match mutant.class {
            Class::Results => oracle::results(self, rng, mutant),
            Class::Structure | Class::Extremes | Class::Tokens | Class::Bytes | Class::Sets => {
                oracle::model(self, rng, mutant)
            }
        }
    }
}
