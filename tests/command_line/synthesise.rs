//! `linkdyn synthesise` and `linkdyn chains`: what they write, and how they refuse. Their numbers are tested where they are found.

use crate::browser::Scratch;
use serde_json::Value;
use std::fs;
use std::process::{Command, Output, Stdio};

fn command(scratch: &Scratch, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_linkdyn"));
    command.args(arguments);
    command.current_dir(&scratch.0).stdin(Stdio::null());
    command.output().expect("the binary runs")
}

fn write(scratch: &Scratch, what: &str) {
    let text = format!(
        r#"{{ "format": "linkdyn/1", "name": "Lid", "units": {{ "length": "mm", "angle": "deg" }},
  "synthesise": {what} }}"#
    );
    fs::write(scratch.0.join("task.json"), text).expect("written");
}

const LID: &str = r#"{ "positions": [ { "point": [0, 0], "angle": 0 }, { "point": [36, 34], "angle": -14 },
    { "point": [94, 45], "angle": -17 }, { "point": [153, 25], "angle": -6 } ],
  "pivots": { "x": [-250, 250], "y": [-250, 50] }, "load": { "force": ["0 N", "-20 N"] }, "most": 6 }"#;

#[test]
fn what_is_written_is_what_is_told_and_a_linkage_that_is_taken_runs() {
    let scratch = Scratch::new("synthesise");
    write(&scratch, LID);
    let told = command(
        &scratch,
        &["synthesise", "task.json", "--json", "-o", "out"],
    );
    assert_eq!(told.status.code(), Some(0), "{told:?}");
    let told: Value = serde_json::from_slice(&told.stdout).expect("JSON");
    let read = |name: &str| fs::read_to_string(scratch.0.join("out").join(name)).expect("a file");
    assert_eq!(
        told,
        serde_json::from_str::<Value>(&read("synthesis.json")).expect("JSON")
    );
    let page = read("synthesis.html");
    assert_eq!(page.matches("<svg").count(), 6);
    assert!(page.contains("<animate "), "nothing moves");
    let words = command(&scratch, &["synthesise", "task.json", "--threads", "1"]);
    let words = String::from_utf8(words.stdout).expect("text");
    assert!(
        words.starts_with("Lid: 6 linkages for 4 positions\n"),
        "{words}"
    );
    // The same with one thread, and of each linkage the model that runs, from its first position to its last one or all around.
    for (number, one) in told["linkages"]
        .as_array()
        .expect("a list")
        .iter()
        .enumerate()
    {
        let taken = command(
            &scratch,
            &[
                "synthesise",
                "task.json",
                "--take",
                &(number + 1).to_string(),
            ],
        );
        assert_eq!(taken.status.code(), Some(0), "{taken:?}");
        assert_eq!(
            serde_json::from_slice::<Value>(&taken.stdout).expect("JSON"),
            one["model"]
        );
        fs::write(scratch.0.join("taken.json"), &taken.stdout).expect("written");
        let run = command(&scratch, &["run", "taken.json", "-o", "run"]);
        assert_eq!(run.status.code(), Some(0), "{run:?}");
        let rows = fs::read_to_string(scratch.0.join("run/results.csv")).expect("a table");
        let heads: Vec<&str> = rows.lines().next().expect("heads").split(',').collect();
        let place = |name: &str| {
            heads
                .iter()
                .position(|head| *head == name)
                .expect("a column")
        };
        let first: Vec<f64> = rows
            .lines()
            .nth(1)
            .expect("a row")
            .split(',')
            .map(|cell| cell.parse().expect("a number"))
            .collect();
        assert!(
            first[place("coupler.P.x[m]")].abs() < 1e-12
                && first[place("coupler.P.y[m]")].abs() < 1e-12
        );
        assert!(first[place("driver.motor.effort[N*m]")].abs() > 0.0);
        // What it is for goes on from there.
        let check = command(&scratch, &["check", "taken.json"]);
        assert_eq!(check.status.code(), Some(0), "{check:?}");
    }
}

#[test]
fn what_nothing_can_do_says_what_stood_in_the_way() {
    let scratch = Scratch::new("synthesise_nothing");
    write(
        &scratch,
        r#"{ "function": [[57, 51], [86, 63], [115, 80]], "directions": true, "lengths": [1, 2], "starts": 4 }"#,
    );
    let told = command(&scratch, &["synthesise", "task.json", "-o", "out"]);
    assert_eq!(told.status.code(), Some(3), "{told:?}");
    let words = String::from_utf8(told.stdout).expect("text");
    assert!(
        words.starts_with("Lid: no linkage for 3 pairs of angles\n"),
        "{words}"
    );
    assert!(words.contains("outside the limits"), "{words}");
    assert!(!scratch.0.join("out/synthesis.html").exists());
    let told = command(&scratch, &["synthesise", "task.json", "--take", "1"]);
    assert_eq!(told.status.code(), Some(2));
    assert_eq!(
        String::from_utf8(told.stderr).expect("text"),
        "error: --take 1: there are 0 linkages\n"
    );
}

#[test]
fn faulty_tasks_are_refused() {
    let scratch = Scratch::new("synthesise_faults");
    for (what, message) in [
        (
            r#"{}"#,
            r#"synthesise: "path" is missing (as in "path": [[0, 0], [10, 5], [20, 5]])"#,
        ),
        (
            r#"{"path": [[0, 0], [10, 5], [20, 5]], "function": [[0, 0], [1, 1]]}"#,
            r#"synthesise.function: "path" and "function" exclude each other (keep one of them)"#,
        ),
        (
            r#"{"path": [[0, 0]]}"#,
            r#"synthesise.path: a list of at least 2 is expected, this one has 1"#,
        ),
        (
            r#"{"path": [[0, 0], [1, 2, 3]]}"#,
            r#"synthesise.path[1]: a list of 2 is expected, this one has 3"#,
        ),
        (
            r#"{"path": [[0, 0], ["a", 2]]}"#,
            r#"synthesise.path[1][0]: "a": this does not begin with a number (a number, or text such as "5 m")"#,
        ),
        (
            r#"{"path": [[0, 0], ["5 deg", 2]]}"#,
            r#"synthesise.path[1][0]: "5 deg": "deg" is not a unit of length (such as "m")"#,
        ),
        (
            r#"{"path": [[0, 0], [0, 0], [1, 1]]}"#,
            r#"synthesise.path[1]: it is the same as the one before (leave one out)"#,
        ),
        (
            r#"{"positions": [{"point": [1, 1], "angle": 0}, {"point": [1, 1], "angle": 10}]}"#,
            r#"synthesise.positions: all are at one place, so that nothing says how large the linkage is (a body that turns about a fixed point is pinned there)"#,
        ),
        (
            r#"{"positions": [{"angle": 0}, {"point": [1, 1], "angle": 10}]}"#,
            r#"synthesise.positions[0]: "point" is missing"#,
        ),
        (
            r#"{"positions": [{"point": [0, 0]}, {"point": [1, 1], "angle": 10}]}"#,
            r#"synthesise.positions[0]: "angle" is missing, though others have one (angles are counted from that of the first position)"#,
        ),
        (
            r#"{"path": [[0, 0], [10, 5], [20, 5]], "crank": [0, 10]}"#,
            r#"synthesise.crank: 2 angles of the crank do not fit 3 positions (one for each; left out, it does not matter where the crank is)"#,
        ),
        (
            r#"{"path": [[0, 0], [10, 5], [20, 5]], "crank": [0, 10, 10]}"#,
            r#"synthesise.crank: the crank stands still between two positions (each angle differs from the one before)"#,
        ),
        (
            r#"{"function": [[0, 0], [10, 5]], "crank": [0, 10]}"#,
            r#"synthesise.crank: the angles of "function" already say where the crank is (leave it out)"#,
        ),
        (
            r#"{"function": [[0, 0], [0, 5]]}"#,
            r#"synthesise.function[1][0]: 0: the crank stands still between two positions (each angle differs from the one before)"#,
        ),
        (
            r#"{"path": [[0, 0], [10, 5], [20, 5]], "directions": true}"#,
            r#"synthesise.directions: true: only the angles of a "function" can be directions (leave it out)"#,
        ),
        (
            r#"{"path": [[0, 0], [10, 5], [20, 5]], "base": "100 mm"}"#,
            r#"synthesise.base: "100 mm": the distance of the pivots is only given for a "function" (a path or positions find it; "pivots" says where they may be)"#,
        ),
        (
            r#"{"function": [[0, 0], [10, 5]], "base": 0}"#,
            r#"synthesise.base: 0: must be greater than 0"#,
        ),
        (
            r#"{"function": [[0, 0], [10, 5]], "pivots": {"x": [0, 1], "y": [0, 1]}}"#,
            r#"synthesise.pivots: a "function" has its pivots at the origin and beside it, "base" apart (leave it out)"#,
        ),
        (
            r#"{"path": [[0, 0], [10, 5], [20, 5]], "pivots": {"x": [5, 1], "y": [0, 1]}}"#,
            r#"synthesise.pivots.x: the least must be below the greatest (as in ["10 mm", "200 mm"])"#,
        ),
        (
            r#"{"path": [[0, 0], [10, 5], [20, 5]], "pivots": {"x": [0, 1]}}"#,
            r#"synthesise.pivots: "y" is missing"#,
        ),
        (
            r#"{"path": [[0, 0], [10, 5], [20, 5]], "lengths": [50, 10]}"#,
            r#"synthesise.lengths: the least must be below the greatest (as in ["10 mm", "200 mm"])"#,
        ),
        (
            r#"{"path": [[0, 0], [10, 5], [20, 5]], "lengths": [-50, 10]}"#,
            r#"synthesise.lengths: lengths are not negative (as in ["10 mm", "200 mm"])"#,
        ),
        (
            r#"{"path": [[0, 0], [10, 5], [20, 5]], "linkages": ["fourbar"]}"#,
            r#"synthesise.linkages[0]: "fourbar": unknown word (did you mean "four_bar"?)"#,
        ),
        (
            r#"{"path": [[0, 0], [10, 5], [20, 5]], "linkages": ["four_bar", "four_bar"]}"#,
            r#"synthesise.linkages[1]: "four_bar": it is there twice (leave one out)"#,
        ),
        (
            r#"{"function": [[0, 0], [10, 5]], "linkages": ["slider_crank"]}"#,
            r#"synthesise.linkages[0]: "slider_crank": the output of a slider-crank does not turn (a "path" of its slider, with "crank", says how far it slides)"#,
        ),
        (
            r#"{"path": [[0, 0], [10, 5], [20, 5]], "bodies": 5}"#,
            r#"synthesise.bodies: 5: 5 bodies with pins alone have no single freedom (4, 6, 8 or 10)"#,
        ),
        (
            r#"{"path": [[0, 0], [10, 5], [20, 5]], "bodies": 12}"#,
            r#"synthesise.bodies: 12: must not be greater than 10"#,
        ),
        (
            r#"{"path": [[0, 0], [10, 5], [20, 5]], "transmission": 90}"#,
            r#"synthesise.transmission: 90: an angle of transmission is below 90° (40° is usual)"#,
        ),
        (
            r#"{"path": [[0, 0], [10, 5], [20, 5]], "starts": 0}"#,
            r#"synthesise.starts: 0: must not be less than 1"#,
        ),
        (
            r#"{"path": [[0, 0], [10, 5], [20, 5]], "most": 2.5}"#,
            r#"synthesise.most: 2.5: a whole number is expected"#,
        ),
        (
            r#"{"path": [[0, 0], [10, 5], [20, 5]], "pivot": {"x": [0, 1], "y": [0, 1]}}"#,
            r#"synthesise.pivot: "pivot": unknown key (did you mean "pivots"?)"#,
        ),
        (
            r#"{"path": [[0, 0], [10, 5], [20, 5]], "load": {"force": ["5 mm", 0]}}"#,
            r#"synthesise.load.force[0]: "5 mm": "mm" is not a unit of force (such as "N")"#,
        ),
    ] {
        write(&scratch, what);
        let told = command(&scratch, &["synthesise", "task.json"]);
        assert_eq!(told.status.code(), Some(2), "{what}: {told:?}");
        let said = String::from_utf8(told.stderr).expect("text");
        let said = said
            .strip_prefix("error: task.json: line 2, column ")
            .expect("a place");
        let (_, said) = said.split_once(": ").expect("a column");
        assert_eq!(said.trim_end(), message, "{what}");
    }
    let said = |arguments: &[&str]| {
        let told = command(&scratch, arguments);
        assert_eq!(told.status.code(), Some(2), "{told:?}");
        String::from_utf8(told.stderr).expect("text")
    };
    assert_eq!(
        said(&["synthesise", "four-bar"]),
        "error: \"synthesise\" is missing (as in \"synthesise\": { \"path\": [[0, 0], [10, 5], [20, 5]] })\n"
    );
    write(&scratch, LID);
    for question in ["check", "modes", "assemblies"] {
        let said = said(&[question, "task.json"]);
        assert!(
            said.ends_with(
                "bodies: there are none (`linkdyn synthesise` finds linkages for a task)\n"
            ),
            "{said}"
        );
    }
}

#[test]
fn chains_are_listed() {
    let scratch = Scratch::new("chains");
    let told = command(&scratch, &["chains", "8", "--json"]);
    let told: Value = serde_json::from_slice(&told.stdout).expect("JSON");
    let chains = told["chains"].as_array().expect("a list");
    assert_eq!(chains.len(), 16);
    assert!(
        chains
            .iter()
            .all(|own| own["pins"].as_array().map(Vec::len) == Some(10))
    );
    let told = command(&scratch, &["chains", "6"]);
    let words = String::from_utf8(told.stdout).expect("text");
    assert!(
        words.starts_with("2 chains of 6 bodies, 5 mechanisms\n"),
        "{words}"
    );
    let told = command(&scratch, &["chains", "7"]);
    assert_eq!(told.status.code(), Some(2));
    assert_eq!(
        String::from_utf8(told.stderr).expect("text"),
        "error: 7: chains with one freedom and pins alone have 4, 6, 8 or 10 bodies\n"
    );
}
