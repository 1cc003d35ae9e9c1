//! Understands the user: bad models and the exact texts of what is said about them.
//!
//! Line and column in these texts were checked by eye against the base model below.

mod arriving;
mod cases;
mod elastic;
mod files;
mod hostile;

use linkdyn_model::{self, Value};
use proptest::prelude::*;
use std::io::Write;

/// A good model; each case spoils it.
const BASE: &str = r#"{
  "format": "linkdyn/1",
  "name": "four-bar and slider",
  "units": { "length": "mm", "angle": "deg" },
  "gravity": [0, -9.81],
  "bodies": {
    "ground": { "points": { "O": [0, 0], "Q": [300, 0] } },
    "crank": { "mass": 0.8, "inertia": 7e-4, "com": [50, 0],
      "points": { "O": [0, 0], "A": [100, 0] }, "pose": { "angle": 60 } },
    "coupler": { "points": { "A": [0, 0], "B": [250, 0] } },
    "rocker": { "points": { "Q": [0, 0], "B": [200, 0] }, "note": "measured" },
    "slider": { "points": { "C": [0, 0] } }
  },
  "joints": {
    "a": { "type": "revolute", "between": ["ground.O", "crank.O"] },
    "b": { "type": "revolute", "between": ["crank.A", "coupler.A"],
      "clearance": { "model": "massless_link", "radius": 0.1 } },
    "c": { "type": "revolute", "between": ["coupler.B", "rocker.B"] },
    "d": { "type": "revolute", "between": ["ground.Q", "rocker.Q"] },
    "e": { "type": "prismatic", "between": ["ground.Q", "slider.C"], "axis": [1, 0] }
  },
  "drivers": {
    "motor": { "type": "rotation", "body": "crank", "motion": { "type": "polynomial", "coefficients": [60, "10 rad/s"] } },
    "pusher": { "type": "translation", "joint": "e", "motion": { "type": "table", "points": [[0, 0], [1, 5]] } }
  },
  "forces": {
    "return": { "type": "spring", "between": ["ground.Q", "coupler.B"], "stiffness": 200, "free_length": 150 },
    "load": { "type": "force", "at": "coupler.B", "vector": [0, 5] }
  },
  "initial": { "crank": { "angle": 60 } },
  "points": ["coupler.B"],
  "analysis": { "type": "inverse_dynamics", "end": 2.0, "outputs": 401 }
}
"#;

struct Case {
    what: &'static str,
    /// Texts and what each is replaced by, everywhere.
    edits: &'static [(&'static str, &'static str)],
    sets: &'static [&'static str],
    complaints: &'static [&'static str],
}

/// The end of the last joint, and a gear after it.
const GEAR: &str = r#""axis": [1, 0] },
    "g": { "type": "gear", "between": ["crank.O", "rocker.Q"], "ratio": -2 }"#;

/// The bad models by theme.
const CASES: [&[Case]; 17] = [
    cases::words::CASES,
    cases::yielding::CASES,
    cases::expressions::CASES,
    cases::bodies::CASES,
    cases::joints::CASES,
    cases::clearances::CASES,
    cases::drivers::CASES,
    cases::laws::CASES,
    cases::analysis::CASES,
    cases::syntax::CASES,
    cases::tolerances::CASES,
    cases::parts::CASES,
    cases::sections::CASES,
    cases::elastic::CASES,
    cases::inputs::CASES,
    cases::sets::CASES,
    cases::slips::CASES,
];

fn said(text: &[u8], sets: &[&str]) -> Vec<String> {
    let sets: Vec<String> = sets.iter().map(ToString::to_string).collect();
    match linkdyn_model::load(text, &sets) {
        Ok(_) => Vec::new(),
        Err(complaints) => complaints.iter().map(ToString::to_string).collect(),
    }
}

#[test]
fn every_bad_model_is_refused_in_these_words() {
    assert_eq!(
        said(BASE.as_bytes(), &[]),
        Vec::<String>::new(),
        "the base model is good"
    );
    let mut wrong = String::new();
    for case in CASES.into_iter().flatten() {
        let mut text = BASE.to_owned();
        for (from, to) in case.edits {
            assert!(text.contains(from), "{}: {from}", case.what);
            text = text.replace(from, to);
        }
        let said = said(text.as_bytes(), case.sets);
        if said != case.complaints {
            wrong += &format!(
                "{}:\n  said {said:#?}\n  want {:#?}\n",
                case.what, case.complaints
            );
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}
