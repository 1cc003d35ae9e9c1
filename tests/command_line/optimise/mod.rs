//! `linkdyn optimise`: closed forms, paths of known linkages, what it says where there is nothing to find, and what it refuses.

mod page;
mod paths;
mod refused;
mod rest;

use crate::browser::Scratch;
use serde_json::{Value, json};
use std::f64::consts::TAU;
use std::fs;
use std::process::{Command, Output, Stdio};

/// A slider-crank: its stroke is 2 r, its piston is pulled back by r ω² (1 + r/l) at most.
const MODEL: &str = r#"{
  "format": "linkdyn/1", "name": "Press", "units": { "length": "mm", "angle": "deg" },
  "parameters": { "crank": { "value": "50 mm", "tolerance": "0.05 mm", "note": "kept" }, "rod": "200 mm" },
  "bodies": {
    "ground": { "points": { "O": [0, 0] } },
    "crank": { "points": { "O": [0, 0], "A": ["=crank", 0] } },
    "rod": { "points": { "A": [0, 0], "B": ["=rod", 0] }, "pose": { "position": ["=crank", 0] } },
    "piston": { "points": { "B": [0, 0] }, "pose": { "position": ["=crank+rod", 0] } } },
  "joints": {
    "main": { "type": "revolute", "between": ["ground.O", "crank.O"] },
    "big": { "type": "revolute", "between": ["crank.A", "rod.A"] },
    "small": { "type": "revolute", "between": ["rod.B", "piston.B"] },
    "guide": { "type": "prismatic", "between": ["ground.O", "piston.B"], "axis": [1, 0] } },
  "drivers": { "motor": { "type": "rotation", "body": "crank",
    "motion": { "type": "constant_velocity", "velocity": "60 rpm" } } },
  "responses": { "stroke": "max(piston.x) - min(piston.x)", "peak": { "value": "max(abs(piston.ax))", "unit": "m/s^2" } },
  "analysis": { "type": "kinematics", "end": 1, "outputs": 37 }
}"#;

fn command(scratch: &Scratch, arguments: &[&str]) -> Command {
    fs::write(scratch.0.join("press.json"), MODEL).expect("a model");
    let mut command = Command::new(env!("CARGO_BIN_EXE_linkdyn"));
    command
        .arg("optimise")
        .current_dir(&scratch.0)
        .args(arguments);
    command.stdin(Stdio::null());
    command
}

fn optimise(scratch: &Scratch, arguments: &[&str]) -> Output {
    command(scratch, arguments)
        .output()
        .expect("the binary runs")
}

fn json_with(scratch: &Scratch, arguments: &[&str], status: i32) -> Value {
    let arguments = [arguments, &["--json"]].concat();
    let output = optimise(scratch, &arguments);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(status), "{arguments:?}: {said}");
    serde_json::from_slice(&output.stdout).expect("JSON")
}

fn found(scratch: &Scratch, arguments: &[&str]) -> Value {
    let found = json_with(scratch, arguments, 0);
    assert_eq!(found["status"], "found", "{found}");
    found
}

fn value(found: &Value, parameter: &str) -> f64 {
    found["design"][parameter]["value"]
        .as_f64()
        .expect("a value")
}

#[test]
fn a_stroke_is_found_to_a_nanometre_in_few_evaluations() {
    let scratch = Scratch::new("optimise-goal");
    for vary in ["parameters.crank", "crank=1 mm:90 mm", "crank = 30:45"] {
        let found = found(
            &scratch,
            &["press.json", "--vary", vary, "--goal", "stroke = 80 mm"],
        );
        let off = value(&found, "crank") - 0.04;
        assert!(off.abs() < 1e-9, "{vary}: off by {off}");
        assert!(found["evaluations"].as_u64() <= Some(20), "{found}");
        assert_eq!(found["aim"], "goal");
        assert_eq!(found["constraints"][0]["kept"], true);
    }
    // A closed form that is no line: r ω² (1 + r/l) = 2 m/s², with ω = 2π.
    let goal = ["press.json", "--vary", "crank", "--goal", "peak = 2 m/s^2"];
    let found = found(&scratch, &goal);
    let size = 2.0 / (TAU * TAU);
    let exact = 0.1 * ((1.0 + 4.0 * size / 0.2).sqrt() - 1.0);
    let off = value(&found, "crank") - exact;
    assert!(off.abs() < 1e-12, "off by {off}");
    assert!(found["evaluations"].as_u64() <= Some(20), "{found}");
}

#[test]
fn the_model_that_is_written_has_the_values_and_everything_else() {
    let scratch = Scratch::new("optimise-write");
    let arguments = [
        "press.json",
        "--vary",
        "crank",
        "--goal",
        "stroke = 80 mm",
        "--write",
        "new.json",
        "-o",
        "out",
    ];
    let output = optimise(&scratch, &arguments);
    assert_eq!(output.status.code(), Some(0));
    let read = |name: &str| -> Value {
        let text = fs::read(scratch.0.join(name)).expect("a file");
        serde_json::from_slice(&text).expect("JSON")
    };
    let mut wanted: Value = serde_json::from_str(MODEL).expect("JSON");
    wanted["parameters"]["crank"]["value"] = json!("40 mm");
    assert_eq!(read("new.json"), wanted);
    assert_eq!(read("out/optimise.json")["status"], "found");
    let table = fs::read_to_string(scratch.0.join("out/evaluations.csv")).expect("a table");
    let lines: Vec<&str> = table.lines().collect();
    assert_eq!(
        lines[0],
        "start,evaluation,status,parameters.crank [m],constraint 1 left [m],constraint 1 right [m]"
    );
    assert!(lines[1].starts_with("0,0,completed,0.05,"), "{table}");
    let evaluations = read("out/optimise.json")["evaluations"].as_u64();
    assert_eq!(evaluations, Some(lines.len() as u64 - 1));
}

/// r = 40 mm from the stroke, l = 4.5 r as long as is allowed.
#[test]
fn a_constrained_optimum_is_that_of_the_closed_form() {
    let scratch = Scratch::new("optimise-constrained");
    let arguments = [
        "press.json",
        "--vary",
        "crank=20 mm:60 mm",
        "--vary",
        "rod=120 mm:300 mm",
        "--minimise",
        "peak",
        "--constraint",
        "stroke >= 80 mm",
        "--constraint",
        "rod < 4.5*crank",
        "--starts",
        "4",
    ];
    let one = found(&scratch, &[&arguments[..], &["--threads", "1"]].concat());
    assert!((value(&one, "crank") - 0.04).abs() < 1e-9, "{one}");
    assert!((value(&one, "rod") - 0.18).abs() < 1e-8, "{one}");
    let peak = one["objective"]["value"].as_f64().expect("a value");
    assert!(
        (peak - 0.04 * TAU * TAU * (1.0 + 1.0 / 4.5)).abs() < 1e-8,
        "{peak}"
    );
    assert_eq!(one["reached"], 4, "{one}");
    assert_eq!(one["constraints"][0]["active"], true, "{one}");
    assert_eq!(one["responses"]["stroke"]["unit"], "m");
    // The same to the last digit with more threads, another with another seed.
    assert_eq!(
        one,
        found(&scratch, &[&arguments[..], &["--threads", "3"]].concat())
    );
    let other = found(&scratch, &[&arguments[..], &["--seed", "2"]].concat());
    assert_ne!(one["starts"][1], other["starts"][1]);
}

#[test]
fn bounds_hold_and_are_told() {
    let scratch = Scratch::new("optimise-bounds");
    let arguments = [
        "press.json",
        "--vary",
        "crank=20 mm:60 mm",
        "--maximise",
        "stroke",
        "--starts",
        "2",
    ];
    let found = found(&scratch, &arguments);
    assert_eq!(found["design"]["crank"]["at"], "upper");
    assert_eq!(value(&found, "crank"), 0.06);
    assert_eq!(found["objective"]["sense"], "maximise");
}

/// The stroke scatters by 2 σ of the crank, and ±0.05 mm are 3 σ cut there: σ = 0.98657 · 0.05/3 mm.
#[test]
fn tolerances_count_where_that_is_asked_for() {
    let scratch = Scratch::new("optimise-robust");
    let arguments = [
        "press.json",
        "--vary",
        "crank=20 mm:60 mm",
        "--maximise",
        "stroke",
        "--robust",
        "3",
        "--starts",
        "1",
    ];
    let found = found(&scratch, &arguments);
    let number = |key: &str| found["objective"][key].as_f64().expect("a number");
    let sigma = number("deviation");
    assert!(
        (sigma / (2.0 * 0.986_578 * 0.05e-3 / 3.0) - 1.0).abs() < 1e-5,
        "{sigma}"
    );
    assert!(
        (number("robust_value") - (number("value") - 3.0 * sigma)).abs() < 1e-15,
        "{found}"
    );
}

/// A response whose name is no word stands in quotes.
#[test]
fn a_name_in_quotes_is_that_of_a_response() {
    let scratch = Scratch::new("optimise-quotes");
    let set = "responses.long way=max(piston.x) - min(piston.x)";
    let goal = "'long way' / 2 = 40 mm";
    let found = found(
        &scratch,
        &[
            "press.json",
            "--set",
            set,
            "--vary",
            "crank",
            "--goal",
            goal,
        ],
    );
    assert!((value(&found, "crank") - 0.04).abs() < 1e-9, "{found}");
}

/// As near as possible to 80 mm and 84 mm, both by their size.
#[test]
fn several_goals_are_met_as_well_as_they_can_be() {
    let scratch = Scratch::new("optimise-goals");
    let arguments = [
        "press.json",
        "--vary",
        "crank=20 mm:60 mm",
        "--goal",
        "stroke = 80 mm",
        "--goal",
        "stroke = 84 mm",
        "--starts",
        "2",
    ];
    let found = json_with(&scratch, &arguments, 3);
    assert_eq!(found["status"], "not_reached");
    // Sides are measured by the 100 mm that the stroke is in the file, so that both count alike.
    assert!((value(&found, "crank") - 0.041).abs() < 1e-9, "{found}");
    let two = [
        "press.json",
        "--vary",
        "crank=20:60",
        "--vary",
        "rod=100:300",
        "--goal",
        "stroke = 80 mm",
        "--goal",
        "peak = 2 m/s^2",
        "--starts",
        "2",
    ];
    let found = self::found(&scratch, &two);
    let ratio = 2.0 / (0.04 * TAU * TAU) - 1.0;
    assert!(
        (value(&found, "rod") - 0.04 / ratio).abs() < 1e-9,
        "{found}"
    );
}

#[test]
fn what_cannot_be_reached_says_so_with_the_nearest() {
    let scratch = Scratch::new("optimise-unreached");
    let goal = [
        "press.json",
        "--vary",
        "crank=10 mm:60 mm",
        "--goal",
        "stroke = 800 mm",
    ];
    let found = json_with(&scratch, &goal, 3);
    assert_eq!(found["status"], "not_reached");
    assert_eq!(value(&found, "crank"), 0.06);
    let output = optimise(&scratch, &goal);
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(
        said,
        "error: the goal is not reached; this is the nearest\n"
    );
    // A rod that is shorter than the crank locks: no crash, and no number.
    let none = [
        "press.json",
        "--vary",
        "crank=300 mm:400 mm",
        "--minimise",
        "stroke",
        "--starts",
        "2",
    ];
    let found = json_with(&scratch, &none, 3);
    assert_eq!(found["status"], "no_values");
    assert!(!found.to_string().contains("NaN"), "{found}");
}

/// Cranks longer than the rod lock; the longest stroke lies where that begins.
#[test]
fn variants_that_lock_bound_the_search() {
    let scratch = Scratch::new("optimise-lock");
    let arguments = [
        "press.json",
        "--vary",
        "crank=150 mm:400 mm",
        "--goal",
        "stroke = 399.9 mm",
    ];
    let found = found(&scratch, &arguments);
    assert!((value(&found, "crank") - 0.199_95).abs() < 1e-9, "{found}");
}

#[test]
fn a_model_says_what_it_looks_for_and_check_shows_it() {
    let scratch = Scratch::new("optimise-model");
    let mut model: Value = serde_json::from_str(MODEL).expect("JSON");
    model["optimise"] = json!({ "design": { "crank": [20, "60 mm"] }, "objective": { "minimise": "peak" },
        "constraints": ["stroke = 80 mm"], "starts": 2, "note": "read by nobody" });
    let text = model.to_string();
    fs::write(scratch.0.join("own.json"), &text).expect("a model");
    let own = found(&scratch, &["own.json"]);
    assert!((value(&own, "crank") - 0.04).abs() < 1e-9, "{own}");
    // Options go on top: another goal beside, another range.
    let more = [
        "own.json",
        "--vary",
        "crank=50:60",
        "--constraint",
        "peak < 9 m/s^2",
    ];
    let other = json_with(&scratch, &more, 3);
    assert_eq!(other["constraints"].as_array().map(Vec::len), Some(2));
    assert_eq!(value(&other, "crank"), 0.05, "{other}");
    let mut check = Command::new(env!("CARGO_BIN_EXE_linkdyn"));
    check.args(["check", "own.json"]).current_dir(&scratch.0);
    let said = String::from_utf8(check.output().expect("the binary runs").stdout).expect("text");
    for line in [
        "  optimise      crank within 20 mm … 60 mm",
        "least peak",
        "stroke = 80 mm",
    ] {
        assert!(said.contains(line), "{line:?} is not in\n{said}");
    }
    // Printed back it is what was read.
    let loaded = linkdyn_model::load(text.as_bytes(), &[]).expect("a model");
    assert_eq!(loaded.source.print(&loaded.model), model);
    let changed = loaded.model.edit(|model| {
        let optimise = model.optimise.as_mut().expect("it is there");
        optimise.design["crank"] = linkdyn_model::optimise::Range::Within([0.03, 0.06]);
    });
    let printed = loaded.source.print(&changed.expect("legal"));
    assert_eq!(
        printed["optimise"]["design"]["crank"],
        json!(["0.03 m", "0.06 m"])
    );
    assert_eq!(
        printed["optimise"]["constraints"],
        model["optimise"]["constraints"]
    );
}
