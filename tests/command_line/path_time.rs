//! `linkdyn path-time`: what it writes, and how it ends. Its numbers are tested where it is answered.

use crate::browser::Scratch;
use serde_json::Value;
use std::fs;
use std::process::{Command, Output, Stdio};

const STROKE: [&str; 5] = ["four-bar", "--from", "0 deg", "--to", "150 deg"];

fn path_time(scratch: &Scratch, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_linkdyn"));
    command.arg("path-time").args(STROKE).args(arguments);
    command.current_dir(&scratch.0).stdin(Stdio::null());
    command.output().expect("the binary runs")
}

#[test]
fn what_is_written_is_the_law_of_the_answer() {
    let scratch = Scratch::new("path-time");
    let limits = [
        "--limit",
        "driver.motor.effort=20 N*m",
        "--speed",
        "10 rad/s",
    ];
    let output = path_time(&scratch, &[&limits[..], &["-o", "out", "--json"]].concat());
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let told: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let read = |name: &str| fs::read_to_string(scratch.0.join("out").join(name)).expect("a file");
    let written: Value = serde_json::from_str(&read("path-time.json")).expect("JSON");
    assert_eq!(told, written);
    let [law, limits] = [&told["law"], &told["limits"]];
    assert_eq!(law["time"].as_array().map(Vec::len), Some(401));
    assert_eq!(law["time"][400], told["time"]);
    assert_eq!([&limits[0]["lower"], &limits[0]["upper"]], [-20.0, 20.0]);
    assert_eq!(limits[1]["name"], "speed");
    assert!(
        limits[1]["intervals"].as_u64().expect("a number") > 100,
        "{limits}"
    );
    assert!(told["gap"].as_f64().expect("a number") < 1e-8);
    let table = read("law.csv");
    assert!(table.starts_with("time [s],value [rad],velocity [rad/s],acceleration [rad/s^2],limit,limit_curve [rad/s]\n0.0,0.0,0.0,"));
    assert_eq!(table.lines().count(), 402);
    let page = read("report.html");
    assert!(
        page.contains("<title>linkdyn path-time: Four-bar</title>")
            && page.matches("<svg").count() == 2
    );
    let model: Value = serde_json::from_str(&read("fastest.json")).expect("JSON");
    let motion = &model["drivers"]["motor"]["motion"];
    assert_eq!(motion["velocities"].as_array().map(Vec::len), Some(401));
    assert_eq!(model["analysis"]["type"], "inverse_dynamics");
}

#[test]
fn bad_questions_and_limits_that_nothing_keeps_end_with_their_own_status() {
    let scratch = Scratch::new("path-time-refused");
    for (arguments, status, said) in [
        (
            &["--limit", "driver.motor.efort=20 N*m"],
            2,
            "error: --limit \"driver.motor.efort=20 N*m\": the results have no column \"driver.motor.efort\" (did you mean \"driver.motor.effort\"?)\n",
        ),
        (
            &["--limit", "crank.angle=30 deg"],
            3,
            "error: at rest at 150° crank.angle is 2.618 rad, beyond its limit of 0.5236 rad: the motion can't have an end there\n",
        ),
    ] {
        let output = path_time(&scratch, arguments);
        assert_eq!(output.status.code(), Some(status), "{output:?}");
        assert_eq!(String::from_utf8_lossy(&output.stderr), said);
    }
}
