//! `linkdyn accuracy -o DIR`: its page, and what a browser makes of it.

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
