//! `linkdyn accuracy --levels`: what was not asked for is nowhere, and what was is what it is with all of them.

use super::*;
use crate::browser::{ask, find};
use serde_json::json;

/// What a browser shows of the page.
const PROBE: &str = "setTimeout(() => answer({ foot: document.getElementById('foot').textContent, \
    legend: document.getElementById('legend').textContent, worst: document.getElementById('worst').hidden, \
    note: document.getElementById('band_note').textContent, badge: document.querySelector('#outputs .badge').textContent, \
    tiles: [...document.querySelectorAll('#outputs .tile .muted')].map((tile) => tile.textContent) }), 300);";

fn at_levels(levels: &[&str]) -> (String, String, Value) {
    let mut arguments = FOUR_BAR.to_vec();
    arguments.extend(levels);
    accuracy(&arguments)
}

/// The numbers of each output at each pose, by key.
fn numbers(json: &Value, key: &str) -> Vec<Value> {
    let outputs = json["outputs"].as_object().expect("outputs").values();
    let poses = outputs.flat_map(|output| output["poses"].as_array().expect("poses"));
    poses.map(|pose| pose[key].clone()).collect()
}

#[test]
fn levels_that_were_not_asked_for_are_nowhere() {
    let (told, _, all) = at_levels(&[]);
    assert_eq!(all["levels"], "certified");
    assert!(told.contains("worst found") && told.contains("certified"));
    for (levels, has_found) in [("first", false), ("worst", true)] {
        let (told, _, json) = at_levels(&["--levels", levels]);
        assert_eq!(json["levels"], levels);
        assert_eq!(told.contains("  worst found"), has_found, "{told}");
        assert!(!told.contains("certified"), "{told}");
        let same = [
            "first",
            "mean",
            "sigma",
            "pressed",
            "within",
            "contributions",
        ];
        for key in same.into_iter().chain(has_found.then_some("found")) {
            let (own, all) = (numbers(&json, key), numbers(&all, key));
            assert!(
                own.iter().any(|number| !number.is_null()),
                "{levels}: {key}"
            );
            assert_eq!(own, all, "{levels}: {key}");
        }
        let none = |key: &str, none: Value| numbers(&json, key).iter().all(|own| *own == none);
        assert!(none("certified", Value::Null), "{levels}");
        assert!(has_found || none("found", json!([null, null])), "{levels}");
    }
}

/// The table keeps its columns; cells without a number are empty.
#[test]
fn the_table_keeps_its_columns() {
    let scratch = Scratch::new("accuracy-levels");
    let mut command = Command::new(env!("CARGO_BIN_EXE_linkdyn"));
    command.arg("accuracy").args(FOUR_BAR);
    command.args(["--levels", "first", "-o"]).arg(&scratch.0);
    assert!(command.output().expect("the binary runs").status.success());
    let table = fs::read_to_string(scratch.0.join("accuracy.csv")).expect("a table");
    let rows: Vec<Vec<&str>> = table
        .lines()
        .map(|line| line.split(',').collect())
        .collect();
    let names = [
        "found.minus",
        "found.plus",
        "certified.minus",
        "certified.plus",
    ];
    for row in &rows[1..] {
        assert_eq!(row.len(), rows[0].len());
        for (name, cell) in rows[0].iter().zip(row) {
            let is_asked = !names.contains(name);
            assert!(is_asked || cell.is_empty(), "{name}: {cell}");
            assert!(
                !name.starts_with("first") || cell.parse::<f64>().is_ok(),
                "{cell}"
            );
        }
    }
}

/// The model may say the levels; the option goes before it.
#[test]
fn the_model_says_levels_and_the_option_goes_before_it() {
    let set = ["--set", "accuracy.levels=first"];
    let (_, _, json) = at_levels(&set);
    assert_eq!(json["levels"], "first");
    let (_, _, json) = at_levels(&[&set[..], &["--levels", "worst"]].concat());
    assert_eq!(json["levels"], "worst");
    assert!(
        numbers(&json, "found")
            .iter()
            .all(|found| found[0].is_f64())
    );
}

#[test]
fn other_levels_are_refused() {
    let mut command = Command::new(env!("CARGO_BIN_EXE_linkdyn"));
    command.args(["accuracy", "lock", "--levels", "second"]);
    let output = command.output().expect("the binary runs");
    assert_eq!(output.status.code(), Some(2));
    let said = String::from_utf8_lossy(&output.stderr);
    for part in [
        "invalid value 'second' for '--levels <LEVELS>'",
        "[possible values: first, worst, certified]",
    ] {
        assert!(said.contains(part), "{said}");
    }
}

/// The page leaves out what was not asked for, and says so.
#[test]
fn the_page_leaves_levels_out() {
    let Some(browser) = find() else { return };
    let unasked = [
        "The worst found and the certified bound were not requested.",
        "The certified bound was not requested.",
    ];
    let badges = ["limits exceeded to first order at", "limits exceeded at"];
    for (level, levels) in ["first", "worst"].into_iter().enumerate() {
        let (_, page, _) = at_levels(&["--levels", levels]);
        let (found, visit) = ask(&browser, &page, PROBE, Some(2000));
        assert!(visit.console.is_empty(), "{:#?}", visit.console);
        let text = |key: &str| found[key].as_str().expect("text").to_owned();
        assert!(text("foot").contains(unasked[level]), "{found}");
        assert!(text("badge").starts_with(badges[level]), "{found}");
        assert!(!text("legend").contains("certified"), "{found}");
        assert!(!text("note").contains("certified"), "{found}");
        let reach = ["first order", "worst found"][level];
        assert!(text("legend").contains(reach), "{found}");
        assert_eq!(found["worst"], level == 0, "{found}");
        let tiles = found["tiles"].as_array().expect("tiles");
        assert_eq!(tiles.contains(&json!("worst found")), level > 0, "{found}");
        assert!(!tiles.contains(&json!("certified")), "{found}");
    }
}
