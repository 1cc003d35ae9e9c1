//! `linkdyn check` as a colleague: what the mobility means, what bodies lack, and what looks like a slip.

mod large;
mod mobility;
mod page;
mod slips;
mod tolerances;

use linkdyn_model::bundled;
use serde_json::{Map, Value, json};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// A file of its own, removed at the end.
struct File(PathBuf);

impl File {
    fn new(name: &str, text: &str) -> Self {
        let path = Path::new(env!("CARGO_TARGET_TMPDIR"))
            .join(format!("check-{}-{name}.json", std::process::id()));
        fs::write(&path, text).expect("written");
        File(path)
    }

    fn path(&self) -> &str {
        self.0.to_str().expect("UTF-8")
    }
}

impl Drop for File {
    fn drop(&mut self) {
        let _ = fs::remove_file(&self.0);
    }
}

/// Exit status, standard output, standard error.
fn linkdyn(arguments: &[&str]) -> (Option<i32>, String, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_linkdyn"))
        .args(arguments)
        .stdin(Stdio::null())
        .output()
        .expect("runs");
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("UTF-8");
    (
        output.status.code(),
        text(output.stdout),
        text(output.stderr),
    )
}

#[track_caller]
fn checked(arguments: &[&str]) -> Value {
    let (status, stdout, stderr) = linkdyn(&[&["check", "--json"], arguments].concat());
    assert_eq!(status, Some(0), "{stderr}");
    serde_json::from_str(&stdout).expect("JSON")
}

#[test]
fn bundled_models_raise_no_alarm() {
    for bundled in bundled::MODELS {
        let told = checked(&[bundled.name]);
        assert_eq!(
            (&told["warnings"], &told["suspicious"]),
            (&json!([]), &json!([])),
            "{}",
            bundled.name
        );
        assert_eq!(told["status"], "completed", "{}", bundled.name);
    }
}

/// Plain numbers in millimetres and degrees.
const MILLIMETRES: &str = r#"{ "format": "linkdyn/1", "units": { "length": "mm", "angle": "deg", "inertia": "kg*mm^2", "stiffness": "N/mm", "angular_velocity": "deg/s" },
  "bodies": { "ground": { "points": { "O": [0, 0] } },
    "crank": { "mass": 1, "inertia": 500, "com": [25, 0], "points": { "O": [0, 0], "A": [50, 0] } },
    "rod": { "mass": 2, "inertia": 7000, "com": [100, 0], "points": { "A": [0, 0], "B": [200, 0] }, "pose": { "position": [50, 0] } },
    "slider": { "mass": 1, "inertia": 100, "com": [0, 0], "points": { "P": [0, 0] }, "pose": { "position": [250, 0] } } },
  "joints": { "a": { "type": "revolute", "between": ["ground.O", "crank.O"] },
    "b": { "type": "revolute", "between": ["crank.A", "rod.A"] },
    "c": { "type": "revolute", "between": ["rod.B", "slider.P"] },
    "d": { "type": "prismatic", "between": ["ground.O", "slider.P"], "axis": [1, 0] } },
  "drivers": { "motor": { "type": "rotation", "body": "crank", "motion": { "type": "polynomial", "coefficients": [0, 360] } } },
  "forces": { "s": { "type": "spring", "between": ["ground.O", "slider.P"], "stiffness": 1, "free_length": 240 } },
  "analysis": { "type": "kinematics", "end": 1, "outputs": 101 } }
"#;

/// What `run` refuses as bad input `check` refuses in the same words.
#[test]
fn outputs_that_can_not_be_are_refused_by_check_as_by_run() {
    let file = File::new("samples", MILLIMETRES);
    let sample = |from: &str, to: &str, step: &str| {
        let sample =
            format!("{{\"driver\": \"motor\", \"from\": {from}, \"to\": {to}, \"step\": {step}}}");
        format!("\"type\": \"kinematics\", \"sample\": {sample}")
    };
    let cases = [
        (
            r#""type": "kinematics", "end": 1, "outputs": 1000000000000"#.to_string(),
            "line 12, column 60: analysis.outputs: 1000000000000: must not be greater than 10000000",
        ),
        (
            sample("0", "360", "1e-9"),
            "line 12, column 99: analysis.sample.step: 1e-9: more than 10000000 outputs between \"from\" and \"to\" (take a \
             larger step)",
        ),
        (
            sample("360", "0", "1"),
            "line 12, column 49: analysis.sample: driver \"motor\" passes the values in the other order (exchange from and to)",
        ),
    ];
    for (analysis, wanted) in cases {
        let text = MILLIMETRES.replace(
            r#""type": "kinematics", "end": 1, "outputs": 101"#,
            &analysis,
        );
        fs::write(file.path(), text).expect("written");
        for command in ["check", "run"] {
            let (status, _, stderr) = linkdyn(&[command, file.path()]);
            assert_eq!(status, Some(2), "{command} {analysis}");
            assert_eq!(
                stderr.trim_end(),
                format!("error: {}: {wanted}", file.path()),
                "{command} {analysis}"
            );
        }
    }
}

/// The lock's dead centre at 132.743310°, and t² = 182.743310° by its motion; six digits of both.
#[test]
fn messages_speak_the_units_of_the_file_with_six_digits() {
    let (status, _, stderr) = linkdyn(&["run", "lock", "--set", "analysis.sample.to=135 deg"]);
    assert!(
        status == Some(3)
            && stderr.contains("\"motor\" can't go on beyond 132.743°, t = 1.78591 s,"),
        "{stderr}"
    );
    let late = [
        "run",
        "lock",
        "--set",
        "analysis.sample.to=135 deg",
        "--set",
        "units.time=ms",
    ];
    let (_, _, stderr) = linkdyn(&late);
    assert!(
        stderr.contains("beyond 132.743°, t = 1785.91 ms,"),
        "{stderr}"
    );
    // However late it is.
    for command in ["run", "check"] {
        let (_, stdout, stderr) = linkdyn(&[command, "four-bar", "--set", "analysis.end=1e300"]);
        let longest = format!("{stdout}{stderr}")
            .split(|c: char| !c.is_ascii_digit())
            .map(str::len)
            .max();
        assert!(longest < Some(10), "{stdout}{stderr}");
    }
}
