//! What a newcomer gets wrong first, and what the command says: place, cause and mend.
//!
//! Where the command runs the model all the same (status 0), `check` says what looks like a slip.

mod mechanisms;
mod texts;

use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

/// A sound model; each mistake spoils it.
const SOUND: &str = r#"{
  "format": "linkdyn/1",
  "units": { "length": "mm", "angle": "deg", "inertia": "kg*mm^2" },
  "bodies": {
    "ground": { "points": { "O": [0, 0], "Q": [300, 0] } },
    "crank": { "mass": 0.8, "inertia": 700, "com": [50, 0], "points": { "O": [0, 0], "A": [100, 0] }, "pose": { "angle": 60 } },
    "rod": { "mass": 1.9, "inertia": 9000, "com": [125, 0], "points": { "A": [0, 0], "B": [250, 0] }, "pose": { "position": [50, 87], "angle": 20 } },
    "rocker": { "mass": 1.5, "inertia": 5000, "com": [100, 0], "points": { "Q": [0, 0], "B": [200, 0] }, "pose": { "position": [300, 0], "angle": 95 } }
  },
  "joints": {
    "a": { "type": "revolute", "between": ["ground.O", "crank.O"] },
    "b": { "type": "revolute", "between": ["crank.A", "rod.A"] },
    "c": { "type": "revolute", "between": ["rod.B", "rocker.B"] },
    "d": { "type": "revolute", "between": ["ground.Q", "rocker.Q"] }
  },
  "drivers": {
    "motor": { "type": "rotation", "body": "crank", "motion": { "type": "constant_velocity", "start": 60, "velocity": "60 rpm" } }
  },
  "analysis": { "type": "inverse_dynamics", "end": 1, "outputs": 101 }
}
"#;

struct Mistake {
    what: &'static str,
    /// Texts and what each is replaced by.
    edits: &'static [(&'static str, &'static str)],
    /// Of `run`.
    status: i32,
    said: &'static [&'static str],
}

/// The mistakes by theme.
const MISTAKES: [&[Mistake]; 2] = [mechanisms::MISTAKES, texts::MISTAKES];

/// Exit status, standard output, and the complaints on standard error without their `error:` and file.
fn linkdyn(folder: &Path, arguments: &[&str]) -> (Option<i32>, String, Vec<String>) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_linkdyn"));
    let output = command
        .args(arguments)
        .current_dir(folder)
        .stdin(Stdio::null())
        .output()
        .expect("runs");
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("UTF-8");
    let said = text(output.stderr);
    let said = said.lines().map(|line| {
        line.trim_start_matches("error: ")
            .trim_start_matches("model.json: ")
            .to_string()
    });
    (output.status.code(), text(output.stdout), said.collect())
}

#[test]
fn typical_mistakes_are_answered_with_place_cause_and_mend() {
    let mistakes = MISTAKES.into_iter().flatten();
    assert!(mistakes.clone().count() >= 30);
    let folder =
        Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("mistakes-{}", std::process::id()));
    fs::create_dir_all(&folder).expect("a folder");
    let file = folder.join("model.json");
    fs::write(&file, SOUND).expect("written");
    assert_eq!(
        linkdyn(&folder, &["run", "model.json"]).0,
        Some(0),
        "the model to be spoilt is sound"
    );
    let mut wrong = Vec::new();
    for mistake in mistakes {
        let mut text = SOUND.to_string();
        for (from, to) in mistake.edits {
            assert!(text.contains(from), "{}: {from}", mistake.what);
            text = text.replace(from, to);
        }
        fs::write(&file, text).expect("written");
        let (status, _, mut said) = linkdyn(&folder, &["run", "model.json"]);
        let (checked, told, refused) = linkdyn(&folder, &["check", "model.json", "--json"]);
        let is_refused = [status, checked].map(|status| status == Some(2));
        // `run` refuses a model without an analysis, which `check` is for.
        let is_run_alone = mistake.what == "no analysis";
        if !is_run_alone && (is_refused[0] != is_refused[1] || is_refused[0] && said != refused) {
            wrong.push(format!(
                "{}: check {checked:?}, said {refused:#?}",
                mistake.what
            ));
        }
        if status == Some(0) {
            let told: Value = serde_json::from_str(&told).expect("JSON");
            let suspicious = told["suspicious"].as_array().expect("a list").iter();
            said = suspicious
                .filter_map(|text| text.as_str().map(String::from))
                .collect();
        }
        if status != Some(mistake.status) || said != mistake.said {
            wrong.push(format!("{}: {status:?}, said {said:#?}", mistake.what));
        }
    }
    let (status, _, said) = linkdyn(&folder, &["run", "nomodel.json"]);
    assert_eq!(status, Some(2));
    assert_eq!(
        said,
        [
            "nomodel.json: no such file, and no bundled model of that name (`linkdyn models` lists them)"
        ]
    );
    fs::remove_dir_all(&folder).expect("removed");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
