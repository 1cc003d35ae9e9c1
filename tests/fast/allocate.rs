//! The cheapest tolerances: digits of a reference in closed form, limits that are kept, and what is refused.

use std::ffi::OsString;

use linkdyn::cli::{Said, captured};
use serde_json::Value;

const LENGTHS: [(&str, &str); 4] = [
    ("base", "300 mm"),
    ("crank", "100 mm"),
    ("coupler", "250 mm"),
    ("rocker", "200 mm"),
];

/// `linkdyn allocate four-bar` with a cost of 1 mm for every length, and more words.
fn said(limits: &str, more: &[&str]) -> Said {
    let mut words: Vec<OsString> = ["linkdyn", "allocate", "four-bar"].map(Into::into).into();
    let outputs = format!(
        "accuracy={{\"outputs\":{{\"rocker\":{{\"column\":\"rocker.angle\",\"at\":{{\"value\":\"60 deg\"}}{limits}}}}}}}"
    );
    let costs = LENGTHS.map(|(name, value)| {
        format!("parameters.{name}={{\"value\":\"{value}\",\"cost\":\"1 mm\"}}")
    });
    for set in costs.iter().chain([&outputs]) {
        words.extend(["--set".into(), set.into()]);
    }
    words.extend(more.iter().map(Into::into));
    captured(words)
}

const LIMITS: &str = ",\"limits\":[\"-0.05 deg\",\"0.05 deg\"]";

fn json(said: &Said) -> Value {
    assert_eq!(said.status, 0, "{}", said.stderr);
    serde_json::from_str(&said.stdout).expect("JSON")
}

/// Digits of `validation/accuracy-four-bar`: a closed form, with 40 digits.
#[test]
fn one_limit_gives_the_tolerances_of_the_closed_form() {
    let text = include_str!("../../validation/accuracy-four-bar/expected.json");
    let reference: Value = serde_json::from_str(text).expect("JSON");
    let all = reference["poses"][0]["outputs"][0]["allocation"]
        .as_array()
        .expect("two kinds");
    for (expected, more) in all.iter().zip([&["--json"][..], &["--json", "--rss"]]) {
        let found = json(&said(LIMITS, more));
        for (name, _) in LENGTHS {
            let digits = expected["tolerances"][format!("parameters.{name}")]
                .as_str()
                .expect("digits");
            let digits: f64 = digits.parse().expect("a number");
            let own = found["parameters"][name]["first_order"]
                .as_f64()
                .expect("a number");
            // The cost is flat at its minimum: a gap of 1e-11 leaves tolerances open by the root of that.
            assert!(
                (own / digits - 1.0).abs() < 3e-6,
                "{more:?} {name}: {own} {digits}"
            );
        }
        let cost: f64 = expected["cost"]
            .as_str()
            .expect("digits")
            .parse()
            .expect("a number");
        let own = found["first_order_cost"].as_f64().expect("a number");
        assert!((own / cost - 1.0).abs() < 1e-9, "{more:?}: {own} {cost}");
    }
}

#[test]
fn what_is_written_keeps_its_limits_by_certificate() {
    let folder = tempfile("allocate");
    let file = folder.join("cheap.json");
    let path = file.display().to_string();
    let found = json(&said(LIMITS, &["--json", "--write", &path]));
    let used = found["limits"]["rocker"]["used"]
        .as_f64()
        .expect("a number");
    assert!(
        used <= 1.0 + 1e-9 && used > 0.995,
        "{used}: kept, and nothing given away"
    );
    let again = captured(["linkdyn", "accuracy", &path, "--json"].map(OsString::from));
    let again = json(&again);
    let pose = &again["outputs"]["rocker"]["poses"][0];
    let limit = 0.05_f64.to_radians();
    let certified = pose["certified"][1].as_f64().expect("certified");
    assert!(
        certified <= limit && certified > 0.995 * limit,
        "{certified} {limit}"
    );
    std::fs::remove_dir_all(folder).expect("removed");
}

fn tempfile(name: &str) -> std::path::PathBuf {
    let folder = std::env::temp_dir().join(format!("linkdyn-{name}-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    folder
}

#[test]
fn what_can_not_be_chosen_is_told() {
    let free = said("", &[]);
    assert_eq!(free.status, 2);
    assert_eq!(
        free.stderr,
        "error: four-bar: --set accuracy={\"outputs\":{\"rocker\":{\"column\":\"rocker.angle\",\"at\":…: accuracy.outputs: no output has limits, so any tolerance will do (as in \"limits\": [\"-0.1 deg\", \"0.1 deg\"])\n"
    );
    let pin = "joints.a.clearance={\"model\":\"ideal\",\"radius\":\"0.2 mm\"}";
    let tight = said(LIMITS, &["--set", pin]);
    assert_eq!(tight.status, 3);
    assert_eq!(
        tight.stderr,
        "error: the limits of rocker leave no room for tolerances where the drivers stand at 60°: what has no cost uses them up (widen the limits, or narrow the clearances)\n"
    );
    let words = [
        "linkdyn",
        "allocate",
        "four-bar",
        "--set",
        "parameters.base={\"value\":\"300 mm\",\"tolerance\":\"0.1 mm\"}",
    ];
    let outputs =
        format!("accuracy={{\"outputs\":{{\"rocker\":{{\"column\":\"rocker.angle\"{LIMITS}}}}}}}");
    let none = captured(
        words
            .iter()
            .map(OsString::from)
            .chain(["--set".into(), outputs.into()]),
    );
    assert_eq!(none.status, 2);
    assert!(
        none.stderr
            .contains("no parameter of the mechanism has a cost, so there is nothing to choose"),
        "{}",
        none.stderr
    );
}
