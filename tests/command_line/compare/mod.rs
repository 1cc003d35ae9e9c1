//! `linkdyn compare` as its users meet it: what is run and skipped, differences, files, exit statuses.

mod page;
mod refused;

use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

const MODEL: &str = include_str!("../../../validation/slider-crank-clearance/model.json");

/// A slow, short run.
const SHORT: [&str; 6] = [
    "--set",
    "analysis.end=0.002",
    "--set",
    "analysis.outputs=41",
    "--set",
    "analysis.solver.rtol=1e-6",
];

struct Ran {
    status: Option<i32>,
    stdout: String,
    stderr: String,
}

/// A directory of its own with the model in it, removed at the end.
struct Scratch(PathBuf);

impl Scratch {
    fn new(name: &str) -> Self {
        let path = Path::new(env!("CARGO_TARGET_TMPDIR"))
            .join(format!("compare-{}-{name}", std::process::id()));
        fs::create_dir_all(&path).expect("a scratch directory");
        fs::write(path.join("model.json"), MODEL).expect("written");
        Scratch(path)
    }

    /// Runs `compare model.json` there.
    fn compare(&self, arguments: &[&str]) -> Ran {
        let mut command = Command::new(env!("CARGO_BIN_EXE_linkdyn"));
        command
            .args(["compare", "model.json"])
            .args(SHORT)
            .args(arguments);
        let output = command
            .current_dir(&self.0)
            .stdin(Stdio::null())
            .output()
            .expect("the binary runs");
        Ran {
            status: output.status.code(),
            stdout: String::from_utf8(output.stdout).expect("UTF-8"),
            stderr: String::from_utf8(output.stderr).expect("UTF-8"),
        }
    }

    #[track_caller]
    fn done(&self, arguments: &[&str]) -> String {
        let ran = self.compare(arguments);
        assert_eq!(
            (ran.status, ran.stderr.as_str()),
            (Some(0), ""),
            "{}",
            ran.stdout
        );
        ran.stdout
    }

    #[track_caller]
    fn refused(&self, arguments: &[&str], status: i32, said: &str) -> Ran {
        let ran = self.compare(arguments);
        assert_eq!(ran.status, Some(status), "{}", ran.stderr);
        assert!(
            ran.stderr.contains(said),
            "{said:?} is not in {}",
            ran.stderr
        );
        ran
    }

    fn json(&self, name: &str) -> Value {
        serde_json::from_str(&fs::read_to_string(self.0.join(name)).expect("readable"))
            .expect("valid JSON")
    }

    /// Header and rows of a table; empty cells are none.
    fn table(&self, name: &str) -> (Vec<String>, Vec<Vec<Option<f64>>>) {
        let text = fs::read_to_string(self.0.join(name)).expect("readable");
        let mut lines = text.lines();
        let header = lines
            .next()
            .expect("a header")
            .split(',')
            .map(String::from)
            .collect();
        (
            header,
            lines
                .map(|line| line.split(',').map(|cell| cell.parse().ok()).collect())
                .collect(),
        )
    }

    fn column(&self, table: &str, name: &str) -> Vec<f64> {
        let (header, rows) = self.table(table);
        let index = header
            .iter()
            .position(|column| column == name)
            .unwrap_or_else(|| panic!("{name} in {header:?}"));
        rows.iter()
            .map(|row| row[index].expect("a value"))
            .collect()
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

#[test]
fn the_ladder_is_run_as_far_as_there_are_parameters() {
    let scratch = Scratch::new("ladder");
    let told = scratch.done(&["--joint", "b"]);
    for words in [
        "ideal         completed",
        "massless_link completed",
        "contact       completed, 41 instants, ",
    ] {
        assert!(told.contains(words), "{words:?} is not in {told}");
    }
    assert!(
        told.contains("two_state     skipped: joints.b.clearance: \"surface\" is missing"),
        "{told}"
    );
    for column in [
        "driver.motor.effort [N·m]",
        "joint.b.force [N]",
        "slider.x [m]",
        "slider.ax [m/s²]",
    ] {
        assert!(told.contains(column), "{column:?} is not in {told}");
    }
    assert!(!told.contains("slider.angle"), "it does not turn: {told}");
}

/// What `new` writes has the parameters of all models; the pivoted rocker turns, and its pivot stays.
#[test]
fn the_starter_model_runs_the_whole_ladder() {
    let scratch = Scratch::new("starter");
    let linkdyn = |arguments: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_linkdyn"));
        let output = command
            .args(arguments)
            .current_dir(&scratch.0)
            .output()
            .expect("the binary runs");
        assert!(
            output.status.success(),
            "{}",
            String::from_utf8_lossy(&output.stderr)
        );
        String::from_utf8(output.stdout).expect("UTF-8")
    };
    linkdyn(&["new", "clearance", "-o", "mine.json"]);
    let told = linkdyn(&["compare", "mine.json", "--joint", "b"]);
    for model in [
        "ideal",
        "massless_link",
        "two_state",
        "three_state",
        "contact",
    ] {
        assert!(
            told.contains(&format!("{model:13} completed, 73 instants")),
            "{model}: {told}"
        );
    }
    assert!(
        told.contains("rocker.angle [rad]") && !told.contains("rocker.x"),
        "{told}"
    );
}

/// Largest, mean and root mean square of the differences of two curves.
fn expect_differences(summary: &Value, label: &str, ideal: &[f64], contact: &[f64]) {
    let off: Vec<f64> = ideal
        .iter()
        .zip(contact)
        .map(|(a, b)| (a - b).abs())
        .collect();
    let n = off.len() as f64;
    let max = off.iter().copied().fold(0.0, f64::max);
    let rms = (off.iter().map(|d| d * d).sum::<f64>() / n).sqrt();
    let told = &summary["differences"][label]["contact"];
    for (key, expected) in [
        ("max", max),
        ("mean", off.iter().sum::<f64>() / n),
        ("rms", rms),
    ] {
        let told = told[key].as_f64().expect("a number");
        assert!(
            expected > 0.0 && (told / expected - 1.0).abs() < 1e-12,
            "{label} {key}: {told} {expected}"
        );
    }
}

/// Worked out anew from the files of the single runs.
#[test]
fn differences_and_curves_are_those_of_the_runs() {
    let scratch = Scratch::new("files");
    scratch.done(&[
        "--joint",
        "b",
        "--models",
        "ideal,contact",
        "--columns",
        "joint.b.force,slider.v*",
        "-o",
        "out",
    ]);
    let summary = scratch.json("out/compare.json");
    assert_eq!(summary["reference"], "ideal");
    assert_eq!(
        summary["columns"],
        serde_json::json!(["joint.b.force[N]", "slider.vx[m/s]", "slider.vy[m/s]"])
    );
    let contacts = &scratch.json("out/contact/summary.json")["clearances"]["b"]["contacts"];
    let of_contact = &summary["models"][1];
    assert_eq!(
        (&of_contact["model"], &of_contact["contacts"]),
        (&Value::from("contact"), contacts)
    );
    assert!(summary["models"][0]["contacts"].is_null(), "{summary:#}");
    let single =
        |model: &str, column: &str| scratch.column(&format!("out/{model}/results.csv"), column);
    let force = |model: &str| -> Vec<f64> {
        let (fx, fy) = (
            single(model, "joint.b.fx[N]"),
            single(model, "joint.b.fy[N]"),
        );
        fx.iter().zip(&fy).map(|(x, y)| x.hypot(*y)).collect()
    };
    for (label, ideal, contact) in [
        ("joint.b.force[N]", force("ideal"), force("contact")),
        (
            "slider.vx[m/s]",
            single("ideal", "slider.vx[m/s]"),
            single("contact", "slider.vx[m/s]"),
        ),
    ] {
        assert_eq!(
            scratch.column("out/compare.csv", &format!("contact:{label}")),
            contact
        );
        assert_eq!(
            scratch.column("out/compare.csv", &format!("ideal:{label}")),
            ideal
        );
        expect_differences(&summary, label, &ideal, &contact);
    }
    assert_eq!(scratch.table("out/compare.csv").0[0], "time[s]");
    // A figure per column, with a curve per model; the guided slider's vy is a flat line.
    for column in ["joint.b.force", "slider.vx", "slider.vy"] {
        let figure =
            fs::read_to_string(scratch.0.join(format!("out/{column}.svg"))).expect("readable");
        for text in [">ideal<", ">contact<"] {
            assert_eq!(figure.matches(text).count(), 1, "{column}: {text}");
        }
        assert!(figure.contains(column), "{column} is not named");
    }
}

#[test]
fn only_the_clearance_model_changes() {
    let scratch = Scratch::new("same");
    scratch.done(&[
        "--joint",
        "all",
        "--models",
        "ideal,massless_link,contact",
        "-o",
        "out",
    ]);
    let headers = ["ideal", "massless_link", "contact"]
        .map(|model| scratch.table(&format!("out/{model}/results.csv")).0);
    assert!(
        headers[0] == headers[1] && headers[0] == headers[2],
        "{headers:?}"
    );
    // The joint named by itself is all there are.
    scratch.done(&[
        "--joint", "b", "--joint", "all", "--models", "contact", "-o", "again",
    ]);
    let results = |folder: &str| {
        fs::read(scratch.0.join(folder).join("contact/results.csv")).expect("readable")
    };
    assert!(results("out") == results("again"));
}

#[test]
fn columns_that_wait_to_be_asked_for_are_compared() {
    let scratch = Scratch::new("asked");
    let words = ["--joint", "all", "--models", "ideal,contact", "-o", "out"];
    let columns = ["--columns", "joint.s.slide", "--columns", "joint.o.f"];
    let said = scratch.done(&[&words[..], &columns].concat());
    assert!(said.contains("joint.s.slide"), "{said}");
    for model in ["ideal", "contact"] {
        let results = format!("out/{model}/results.csv");
        let [fx, fy, f] =
            ["fx", "fy", "f"].map(|word| scratch.column(&results, &format!("joint.o.{word}[N]")));
        let sizes: Vec<f64> = fx.iter().zip(&fy).map(|(x, y)| x.hypot(*y)).collect();
        assert_eq!(f, sizes, "{model}");
    }
}
