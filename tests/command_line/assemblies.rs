//! `linkdyn assemblies`: what it writes, and how it ends. Its numbers are tested where they are found.

use crate::browser::Scratch;
use serde_json::Value;
use std::fs;
use std::process::{Command, Output, Stdio};

fn assemblies(scratch: &Scratch, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_linkdyn"));
    command.arg("assemblies").args(arguments);
    command.current_dir(&scratch.0).stdin(Stdio::null());
    command.output().expect("the binary runs")
}

fn told(output: &Output) -> Value {
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    serde_json::from_slice(&output.stdout).expect("JSON")
}

#[test]
fn what_is_written_is_what_is_told_and_an_assembly_that_is_taken_is_drawn() {
    let scratch = Scratch::new("assemblies");
    let all = told(&assemblies(
        &scratch,
        &["jansen-leg", "--at", "0.3", "-o", "out", "--json"],
    ));
    let read = |name: &str| fs::read_to_string(scratch.0.join("out").join(name)).expect("a file");
    assert_eq!(
        all,
        serde_json::from_str::<Value>(&read("assemblies.json")).expect("JSON")
    );
    let found = all["assemblies"].as_array().expect("a list");
    assert_eq!(found.len(), 8);
    assert_eq!(read("assemblies.html").matches("<svg").count(), 8);
    for (number, one) in found.iter().enumerate() {
        let taken = assemblies(
            &scratch,
            &[
                "jansen-leg",
                "--at",
                "0.3",
                "--take",
                &(number + 1).to_string(),
            ],
        );
        assert_eq!(taken.status.code(), Some(0), "{taken:?}");
        fs::write(scratch.0.join("taken.json"), &taken.stdout).expect("written");
        let again = told(&assemblies(
            &scratch,
            &["taken.json", "--at", "0.3", "--json"],
        ));
        let first = &again["assemblies"][0];
        assert_eq!(first["drawn"], true);
        for (body, pose) in one["bodies"].as_object().expect("bodies") {
            for axis in ["x", "y", "angle"] {
                let off = pose[axis].as_f64().expect("a number")
                    - first["bodies"][body][axis].as_f64().expect("a number");
                assert!(off.abs() < 1e-9, "{number} {body}.{axis}: {off:e}");
            }
        }
    }
    let circuits = told(&assemblies(
        &scratch,
        &[
            "watt-i-lock",
            "--circuits",
            "--values",
            "24",
            "-o",
            "out",
            "--json",
        ],
    ));
    assert_eq!(
        circuits,
        serde_json::from_str::<Value>(&read("circuits.json")).expect("JSON")
    );
    assert_eq!(circuits["values"].as_array().map(Vec::len), Some(24));
    // An angle of each of five bodies, and two circuits.
    assert_eq!(read("circuits.html").matches("<svg").count(), 7);
}

/// A four-bar whose coupler is too short.
const OPEN: &str = r#"{ "format": "linkdyn/1", "units": "SI",
  "bodies": { "ground": { "points": { "A": [0, 0], "D": [5, 0] } }, "crank": { "points": { "A": [0, 0], "B": [1, 0] } },
    "coupler": { "points": { "B": [0, 0], "C": [1, 0] } }, "rocker": { "points": { "D": [0, 0], "C": [1, 0] } } },
  "joints": { "a": { "type": "revolute", "between": ["ground.A", "crank.A"] }, "b": { "type": "revolute", "between": ["crank.B", "coupler.B"] },
    "c": { "type": "revolute", "between": ["coupler.C", "rocker.C"] }, "d": { "type": "revolute", "between": ["ground.D", "rocker.D"] } },
  "drivers": { "motor": { "type": "rotation", "body": "crank", "motion": { "type": "constant_velocity", "velocity": 1 } } },
  "analysis": { "type": "kinematics", "end": 1, "outputs": 3 } }"#;

#[test]
fn bad_questions_and_loops_that_do_not_close_end_with_their_own_status() {
    let scratch = Scratch::new("assemblies-refused");
    fs::write(scratch.0.join("open.json"), OPEN).expect("written");
    for (arguments, status, said) in [
        (
            &["open.json"][..],
            3,
            "error: there is no assembly: `linkdyn check` tells which loop does not close\n",
        ),
        (
            &["four-bar", "--take", "3"],
            2,
            "error: --take 3: there are 2 assemblies\n",
        ),
        (
            &["four-bar", "--take", "0"],
            2,
            "error: --take 0: there are 2 assemblies\n",
        ),
        (
            &["four-bar", "--most", "0"],
            2,
            "error: --most 0: look for one at least\n",
        ),
        (
            &["four-bar", "--at", "inf"],
            2,
            "error: --at: the time must be finite\n",
        ),
        (
            &["four-bar", "--at", "NaN"],
            2,
            "error: --at: the time must be finite\n",
        ),
        (
            &["four-bar", "--circuits", "--values", "1"],
            2,
            "error: --values 1: 2 to 100000 values\n",
        ),
        (
            &["four-bar", "--circuits", "--values", "100001"],
            2,
            "error: --values 100001: 2 to 100000 values\n",
        ),
        (
            &["four-bar", "--circuits", "--most", "0"],
            2,
            "error: --most 0: look for one at least\n",
        ),
    ] {
        let output = assemblies(&scratch, arguments);
        let complained = String::from_utf8(output.stderr.clone()).expect("UTF-8");
        assert_eq!(
            (output.status.code(), complained.as_str()),
            (Some(status), said),
            "{arguments:?}"
        );
    }
    for (arguments, part) in [
        (
            &["four-bar", "--circuits", "--driver", "moto"][..],
            "drivers: there is no driver \"moto\" (the drivers: motor)",
        ),
        (
            &["pendulum", "--circuits"],
            "drivers: circuits are those of a driver, and there is none",
        ),
        (
            &["excavator", "--circuits"],
            "there are several drivers: lift, crowd, curl (say --driver NAME)",
        ),
        (
            &["four-bar", "--circuits", "--range", "3:1"],
            "the first number must be less than the second",
        ),
        (
            &["four-bar", "--circuits", "--range", "a"],
            "two numbers are wanted",
        ),
        (&["four-bar", "--values", "5"], "--circuits"),
        (
            &["four-bar", "--workspace", "coupler.P"],
            "drivers: the map is that of two drivers, and there are 1 (say --drivers A,B if there are more; `--circuits` is for one)",
        ),
        (
            &[
                "excavator",
                "--workspace",
                "bucket.tooth",
                "--drivers",
                "lift",
            ],
            "--drivers: name two, as in --drivers left,right",
        ),
        (
            &[
                "excavator",
                "--workspace",
                "bucket.tooth",
                "--drivers",
                "lift,lift",
            ],
            "drivers: \"lift\" is named twice (name two)",
        ),
        (
            &[
                "excavator",
                "--workspace",
                "bucket.teeth",
                "--drivers",
                "lift,curl",
            ],
            "bodies: there is no moving point \"bucket.teeth\" (as in coupler.P)",
        ),
        (
            &[
                "excavator",
                "--workspace",
                "tooth",
                "--drivers",
                "lift,curl",
            ],
            "--workspace: \"tooth\" is not body.point",
        ),
        (
            &[
                "excavator",
                "--workspace",
                "bucket.tooth",
                "--drivers",
                "lift,curl",
                "--values",
                "1",
            ],
            "--values 1: 2 to 400 values of each driver",
        ),
        (&["four-bar", "--driver", "motor"], "--circuits"),
        (
            &["four-bar", "--circuits", "--at", "1"],
            "cannot be used with",
        ),
        (
            &["four-bar", "--take", "1", "--json"],
            "cannot be used with",
        ),
        (&["four-bar", "--take", "-1"], "-1"),
        (&["four-bar", "--at", "soon"], "invalid value 'soon'"),
        (&["four-bar", "--most", "many"], "invalid value 'many'"),
        (&["fourbar"], "fourbar"),
        (&["four-bar", "--set", "parameters.crank=-3"], "crank"),
    ] {
        let output = assemblies(&scratch, arguments);
        let complained = String::from_utf8(output.stderr.clone()).expect("UTF-8");
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {complained}");
        assert!(complained.contains(part), "{arguments:?}: {complained}");
    }
}

#[test]
fn the_map_of_two_drivers_is_written() {
    let scratch = Scratch::new("workspace");
    let ask = [
        "excavator",
        "--workspace",
        "bucket.tooth",
        "--drivers",
        "lift,curl",
        "--values",
        "9",
        "-o",
        "out",
        "--json",
    ];
    let map = told(&assemblies(&scratch, &ask));
    let read = |name: &str| fs::read_to_string(scratch.0.join("out").join(name)).expect("a file");
    assert_eq!(
        map,
        serde_json::from_str::<Value>(&read("workspace.json")).expect("JSON")
    );
    assert_eq!(map["drivers"], serde_json::json!(["lift", "curl"]));
    assert_eq!(map["assemblies"].as_array().map(Vec::len), Some(9));
    assert_eq!(read("workspace.html").matches("<svg").count(), 1);
}
