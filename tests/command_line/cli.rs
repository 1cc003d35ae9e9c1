//! The command as its users meet it: exit statuses, what is told on which stream, files.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use serde_json::Value;

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
fn models_are_listed_and_printed() {
    let list = done(&["models"]);
    assert!(
        list.lines().any(|line| line.starts_with("four-bar ")),
        "{list}"
    );
    assert!(
        list.lines().all(|line| line.chars().count() <= 110),
        "{list}"
    );
    let names: Vec<&str> = list
        .lines()
        .filter(|line| !line.starts_with(' '))
        .filter_map(|line| line.split([',', ' ']).next())
        .collect();
    assert!(names.len() >= 20, "{names:?}");
    for name in names {
        let model: Value = serde_json::from_str(&done(&["models", name])).expect("valid JSON");
        assert_eq!(model["format"], "linkdyn/1", "{name}");
    }
    refused(&["models", "fuor-bar"], 2, "did you mean \"four-bar\"?");
    refused(
        &["models", "wishbone"],
        2,
        "did you mean \"double-wishbone\"?",
    );
}

#[test]
fn the_row_of_four_bars_comes_in_any_size() {
    assert_eq!(
        done(&["models", "nfourbar", "--n", "2"]),
        done(&["models", "nfourbar"])
    );
    let model: Value =
        serde_json::from_str(&done(&["models", "a02", "--n", "40"])).expect("valid JSON");
    assert_eq!(
        model["bodies"].as_object().map(|bodies| bodies.len()),
        Some(82)
    );
    assert!(done(&["run", "nfourbar:3"]).contains("N = 3 (nfourbar:3): dynamics, completed"));
    refused(
        &["models", "nfourbar:7", "--n", "3"],
        2,
        "nfourbar:7: --n 3 beside the size 7 (give one: nfourbar:3,",
    );
    refused(
        &["models", "nfourbar", "--n", "0"],
        2,
        "a whole number from 1 to 50000, as in \"nfourbar:40\"",
    );
    refused(
        &["check", "nfourbar:many"],
        2,
        "nfourbar:many: the size of \"nfourbar\" is its number of loops",
    );
    refused(
        &["models", "jansen", "--n", "3"],
        2,
        "the model \"jansen-leg\" has one size",
    );
    refused(&["models", "--n", "3"], 2, "<NAME>");
}

#[test]
fn every_template_checks_and_runs_clean() {
    let scratch = Scratch::new("new");
    for template in [
        "four-bar",
        "slider-crank",
        "pendulum",
        "spring-mass",
        "clearance",
    ] {
        let file = scratch.path(&format!("{template}.json"));
        let told = done(&["new", template, "-o", &file]);
        assert!(
            told.contains(&format!("linkdyn check {file}")) && told.contains("linkdyn run"),
            "{told}"
        );
        let told: Value =
            serde_json::from_str(&done(&["check", "--json", &file])).expect("valid JSON");
        assert_eq!(
            (&told["warnings"], &told["faults"]),
            (&serde_json::json!([]), &serde_json::json!([])),
            "{template}"
        );
        let told = done(&["run", &file, "-o", &scratch.path("out")]);
        assert!(
            told.contains("completed") && !told.contains("warnings"),
            "{told}"
        );
        assert_eq!(
            json(&format!("{}/summary.json", scratch.path("out")))["status"],
            "completed",
            "{template}"
        );
    }
}

#[test]
fn a_new_model_overwrites_nothing_unasked() {
    let scratch = Scratch::new("new-twice");
    let file = scratch.write("mine.json", "precious");
    refused(
        &["new", "-o", &file],
        2,
        "there is such a file already (--force overwrites it)",
    );
    assert_eq!(fs::read_to_string(&file).expect("there"), "precious");
    done(&["new", "-o", &file, "--force"]);
    assert_eq!(json(&file)["name"], "My four-bar");
    refused(
        &["new", "-o", &scratch.path("none/mine.json")],
        2,
        "its folder does not exist",
    );
    for force in [&[][..], &["--force"]] {
        refused(
            &[&["new", "-o", &scratch.path("")], force].concat(),
            2,
            ": a directory (name a file, such as ",
        );
    }
    if Path::new("/proc/self").is_dir() {
        refused(
            &["new", "-o", "/proc/x.json"],
            2,
            "/proc/x.json: can't be written: ",
        );
    }
    refused(
        &["new", "fourbar"],
        2,
        "no template of that name (did you mean \"four-bar\"?)",
    );
    // Where no file is named it is called after the template, here.
    let ran: Ran = command(&["new", "pendulum"])
        .current_dir(&scratch.0)
        .output()
        .expect("runs")
        .into();
    assert!(
        ran.status == Some(0) && ran.stdout.starts_with("pendulum.json: "),
        "{ran:?}"
    );
    assert_eq!(json(&scratch.path("pendulum.json"))["name"], "My pendulum");
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
fn a_run_writes_its_files_and_tells_about_them() {
    let scratch = Scratch::new("run");
    let output = scratch.path("deep/out");
    let told = done(&["run", "four-bar", "-o", &output]);
    for word in [
        "Four-bar (four-bar): inverse dynamics, completed",
        "mobility",
        "outputs",
        "motor: ",
        "results.csv",
        "time",
    ] {
        assert!(told.contains(word), "{word:?} is not in {told}");
    }
    let summary = json(&format!("{output}/summary.json"));
    assert_eq!(summary["status"], "completed");
    assert_eq!(summary["model"]["sha256"].as_str().map(str::len), Some(64));
    let results = fs::read_to_string(format!("{output}/results.csv")).expect("readable");
    assert!(results.starts_with("time[s],"), "{results}");
    let left: Vec<_> = fs::read_dir(&output)
        .expect("a directory")
        .filter_map(Result::ok)
        .collect();
    assert!(
        left.iter()
            .all(|entry| !entry.file_name().to_string_lossy().starts_with('.')),
        "{left:?}"
    );
    // A second run overwrites.
    done(&["run", "four-bar", "-o", &output]);
}

#[test]
fn a_file_is_run_like_the_bundled_model() {
    let scratch = Scratch::new("file");
    let model = scratch.write("mine.json", &done(&["models", "four-bar"]));
    assert!(done(&["run", &model]).contains("mine.json): inverse dynamics, completed"));
}

#[test]
fn a_directory_of_a_bundled_models_name_does_not_hide_it() {
    let scratch = Scratch::new("hide");
    fs::create_dir(scratch.path("four-bar")).expect("made");
    let ran: Ran = command(&["run", "four-bar"])
        .current_dir(&scratch.0)
        .output()
        .expect("runs")
        .into();
    assert_eq!(ran.status, Some(0), "{ran:?}");
}

#[test]
fn results_that_can_not_be_written_are_bad_input() {
    let scratch = Scratch::new("unwritable");
    let file = scratch.write("file", "");
    refused(&["run", "four-bar", "-o", &file], 2, "not a directory");
    refused(
        &["run", "four-bar", "-o", &format!("{file}/below")],
        2,
        "can't be made",
    );
    fs::create_dir(scratch.path("results.csv")).expect("made");
    refused(
        &["run", "four-bar", "-o", &scratch.path("")],
        2,
        "stands where a result file would go",
    );
    refused(&["validate", "-o", &file], 2, "not a directory");
}

#[test]
fn a_broken_file_is_bad_input_with_its_place() {
    let scratch = Scratch::new("broken");
    let model = scratch.write(
        "broken.json",
        "{\n  \"format\": \"linkdyn/1\",\n  oops\n}\n",
    );
    for command in ["run", "check"] {
        let ran = refused(&[command, &model], 2, "broken.json: line 3, column ");
        assert_eq!(ran.stdout, "", "{ran:?}");
    }
}

#[test]
fn a_bad_model_makes_no_directory() {
    let scratch = Scratch::new("no-directory");
    let model = scratch.write("broken.json", "{");
    refused(
        &["run", &model, "-o", &scratch.path("out")],
        2,
        "broken.json",
    );
    assert!(!Path::new(&scratch.path("out")).exists());
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

#[test]
#[cfg(unix)]
fn a_reader_that_goes_away_is_no_fault() {
    for arguments in [
        &["models", "four-bar"][..],
        &["--help"],
        &["run", "four-bar"],
        &["schema"],
    ] {
        let mut child = command(arguments)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the binary runs");
        drop(child.stdout.take());
        let ran: Ran = child.wait_with_output().expect("ends").into();
        assert_eq!(
            (ran.status, ran.stderr.as_str()),
            (Some(0), ""),
            "{arguments:?}"
        );
    }
}

#[test]
#[cfg(target_os = "linux")]
fn a_full_disk_behind_standard_output_is_told() {
    let full = fs::File::options()
        .write(true)
        .open("/dev/full")
        .expect("there");
    let ran: Ran = command(&["models"])
        .stdout(full)
        .output()
        .expect("runs")
        .into();
    assert_eq!(ran.status, Some(2), "{ran:?}");
    assert!(
        ran.stderr.contains("standard output can't be written"),
        "{ran:?}"
    );
}
