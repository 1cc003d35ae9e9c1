//! `linkdyn accuracy -o DIR`: its page, and what a browser makes of it.

mod levels;
mod one_directory;
mod page;

use crate::browser::Scratch;
use serde_json::Value;
use std::fs;
use std::process::{Command, Stdio};

/// The lock over its stroke: nothing can be certified beside its change point.
const LOCK: [&str; 3] = [
    "lock",
    "--set",
    r#"accuracy={"outputs":{"closed":{"column":"link2.angle","limits":["-0.1 deg","0.1 deg"]}}}"#,
];
/// A four-bar with a tolerance and a fit: an angle and a distance over the stroke, and an angle at a pose.
const FOUR_BAR: [&str; 7] = [
    "four-bar",
    "--set",
    r#"parameters.base={"value":"300 mm","tolerance":"0.05 mm"}"#,
    "--set",
    r#"joints.a.clearance={"model":"ideal","fit":"20 H7/g6"}"#,
    "--set",
    r#"accuracy={"outputs":{"rocking":{"column":"rocker.angle","limits":["-0.02 deg","0.03 deg"]},
        "reach":{"distance":["ground.O2","rocker.B"]},
        "set":{"column":"rocker.angle","at":{"driver":"motor","value":"100 deg"},"limits":["-0.1 deg","0.1 deg"]}}}"#,
];

/// Runs the command; what it says, the page, and `accuracy.json`.
fn accuracy(arguments: &[&str]) -> (String, String, Value) {
    let scratch = Scratch::new("accuracy");
    let mut command = Command::new(env!("CARGO_BIN_EXE_linkdyn"));
    command.arg("accuracy").args(arguments).arg("-o");
    let output = command.arg(&scratch.0).stdin(Stdio::null()).output();
    let output = output.expect("the binary runs");
    let read = |name: &str| fs::read_to_string(scratch.0.join(name));
    let said = String::from_utf8_lossy(&output.stderr);
    let page =
        read("report.html").unwrap_or_else(|_| panic!("{arguments:?} leaves no page: {said}"));
    let json = serde_json::from_str(&read("accuracy.json").expect("a summary")).expect("JSON");
    let told = String::from_utf8(output.stdout).expect("UTF-8");
    (told, page, json)
}

/// An effort over the stroke is printed, written and drawn in its unit, and where it does not exist no number stands.
#[test]
fn efforts_are_told_in_their_unit() {
    let effort =
        r#"accuracy={"outputs":{"closing":{"column":"driver.motor.effort","limits":[-1,1]}}}"#;
    let sample = r#"analysis.sample={"driver":"motor","from":"60 deg","to":"117.512206516644 deg","step":"20 deg"}"#;
    let (told, page, json) = accuracy(&["lock", "--set", effort, "--set", sample]);
    for line in [
        "closing = driver.motor.effort, over 4 poses; farthest at motor = 80°",
        "  certified     no bound is proved for forces; the worst found is a corner of all that may be off",
        "  pins          here pressed by the load, from their least to their greatest clearance",
        "  without       motor = 117.51°: does not exist: in a singular position (",
        "  limits        ±1 N·m: kept by the worst found, not certified",
    ] {
        assert!(told.contains(line), "{told}\nlacks {line}");
    }
    assert!(page.contains("driver.motor.effort") && page.contains("N*m"));
    let output = &json["outputs"]["closing"];
    let poses = output["poses"].as_array().expect("poses");
    assert_eq!((output["unit"].as_str(), poses.len()), (Some("N*m"), 4));
    assert!(
        poses[3]["nominal"].is_null() && poses[3]["missing"].is_string(),
        "{}",
        poses[3]
    );
    assert!(
        poses[0]["missing"].is_null() && poses[0]["found"][0].is_f64(),
        "{}",
        poses[0]
    );
}

/// One thread, three, and one for each processor (0) write the same bytes; also what `--json` prints.
#[test]
fn files_do_not_hang_on_the_threads() {
    let files = ["accuracy.csv", "contributions.csv", "accuracy.json"].map(String::from);
    let written = |threads: &str| {
        let scratch = Scratch::new("accuracy");
        let output = Command::new(env!("CARGO_BIN_EXE_linkdyn"))
            .arg("accuracy")
            .args(FOUR_BAR)
            .args(["--threads", threads, "--json", "-o"])
            .arg(&scratch.0)
            .output()
            .expect("the binary runs");
        assert!(output.status.success(), "{output:?}");
        let files = files
            .clone()
            .map(|name| fs::read(scratch.0.join(name)).expect("a file"));
        assert_eq!(files[2], output.stdout);
        files
    };
    let [one, three, all] = ["1", "3", "0"].map(written);
    assert!(one == three && one == all);
}
