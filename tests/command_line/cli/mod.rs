//! The command as its users meet it: exit statuses, what is told on which stream, files.

mod drawings;
mod files;
mod help;
mod models;
mod running;
mod streams;

use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// A run of the command: exit status, standard output, standard error.
#[derive(Debug)]
struct Ran {
    status: Option<i32>,
    stdout: String,
    stderr: String,
}

impl From<Output> for Ran {
    fn from(output: Output) -> Self {
        Ran {
            status: output.status.code(),
            stdout: String::from_utf8(output.stdout).expect("stdout is UTF-8"),
            stderr: String::from_utf8(output.stderr).expect("stderr is UTF-8"),
        }
    }
}

fn command(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_linkdyn"));
    command.args(arguments).stdin(Stdio::null());
    command
}

fn linkdyn(arguments: &[&str]) -> Ran {
    command(arguments).output().expect("the binary runs").into()
}

/// Runs, and asserts the exit status and a text on standard error.
#[track_caller]
fn refused(arguments: &[&str], status: i32, said: &str) -> Ran {
    let ran = linkdyn(arguments);
    assert_eq!(ran.status, Some(status), "{ran:?}");
    assert!(ran.stderr.contains(said), "{said:?} is not in {ran:?}");
    ran
}

/// Runs, and asserts exit status 0 and silence on standard error.
#[track_caller]
fn done(arguments: &[&str]) -> String {
    let ran = linkdyn(arguments);
    assert_eq!((ran.status, ran.stderr.as_str()), (Some(0), ""), "{ran:?}");
    ran.stdout
}

/// An empty directory of its own, removed at the end.
struct Scratch(PathBuf);

impl Scratch {
    fn new(name: &str) -> Self {
        let path = Path::new(env!("CARGO_TARGET_TMPDIR"))
            .join(format!("cli-{}-{name}", std::process::id()));
        fs::create_dir_all(&path).expect("a scratch directory");
        Scratch(path)
    }

    fn path(&self, name: &str) -> String {
        self.0.join(name).to_str().expect("UTF-8").to_string()
    }

    fn write(&self, name: &str, text: &str) -> String {
        fs::write(self.0.join(name), text).expect("written");
        self.path(name)
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

fn json(path: &str) -> Value {
    serde_json::from_str(&fs::read_to_string(path).expect("readable")).expect("valid JSON")
}

#[test]
fn help_and_version_are_done() {
    assert!(done(&["--help"]).contains("validate"));
    assert!(done(&["run", "--help"]).contains("--set <PATH=VALUE>"));
    assert_eq!(
        done(&["--version"]),
        format!("linkdyn {}\n", env!("CARGO_PKG_VERSION"))
    );
}

#[test]
fn bad_arguments_are_bad_input() {
    refused(&[], 2, "Usage");
    refused(&["runn"], 2, "run");
    refused(&["run"], 2, "MODEL");
    refused(&["run", "four-bar", "--otput", "x"], 2, "--output");
}

#[test]
fn the_schema_is_json() {
    let schema: Value = serde_json::from_str(&done(&["schema"])).expect("valid JSON");
    assert!(schema.get("$schema").is_some(), "{schema}");
}

#[test]
fn an_unknown_command_is_bad_input_with_a_suggestion() {
    refused(&["rnu"], 2, "did you mean \"run\"?");
    refused(&["valdate"], 2, "validate");
}

#[test]
fn an_unknown_model_is_bad_input_with_a_suggestion() {
    refused(
        &["run", "four-bra"],
        2,
        "four-bra: no such file, and no bundled model of that name (did you mean \"four-bar\"?)",
    );
    refused(&["check", "q.json"], 2, "`linkdyn models` lists them");
    let scratch = Scratch::new("unknown");
    refused(
        &["run", &scratch.path("")],
        2,
        "a directory, not a model file",
    );
}

#[test]
fn check_tells_people_and_programs() {
    let told = done(&["check", "four-bar"]);
    assert!(
        told.starts_with("Four-bar (four-bar): sound\n") && told.contains("mobility"),
        "{told}"
    );
    let told: Value =
        serde_json::from_str(&done(&["check", "four-bar", "--json"])).expect("valid JSON");
    assert_eq!(told["status"], "completed");
}

#[test]
fn check_tells_the_parameters() {
    let sets = [
        "--set",
        "parameters.r=50 mm",
        "--set",
        "bodies.crank.points.A[0]==2*r",
    ];
    let told = done(&[&["check", "four-bar"][..], &sets].concat());
    assert!(told.contains("                r = 0.05 m\n"), "{told}");
    let told: Value = serde_json::from_str(&done(
        &[&["check", "four-bar", "--json"][..], &sets].concat(),
    ))
    .expect("JSON");
    assert_eq!(
        told["parameters"]["r"],
        serde_json::json!({ "value": 0.05, "unit": "m" })
    );
}

#[test]
fn validation_tells_its_tally() {
    let told = done(&[
        "validate",
        "lock",
        "four-bar-spring",
        "restitution",
        "four-bar",
    ]);
    assert!(
        told.contains("agreed") && told.contains("0 faults"),
        "{told}"
    );
    refused(
        &["validate", "no-such-case"],
        2,
        "no validation case of that name",
    );
}
