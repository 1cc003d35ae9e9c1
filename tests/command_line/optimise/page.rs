//! The page: before and after over each other, the path with its points, the history, limits that are reached.

use super::optimise;
use crate::browser::{Scratch, ask_in, find};
use serde_json::{Value, json};
use std::fs;

/// What the page says after a search with these arguments, in a window of that size.
fn told(arguments: &[&str], size: [u32; 2]) -> Option<Value> {
    let browser = find()?;
    let scratch = Scratch::new("optimise-page");
    let output = optimise(&scratch, &[arguments, &["-o", "out"]].concat());
    assert!(output.status.success(), "{output:?}");
    let page = fs::read_to_string(scratch.0.join("out/report.html")).expect("a page");
    let (told, visit) = ask_in(&browser, &page, include_str!("page.js"), Some(3000), size);
    assert!(visit.console.is_empty(), "{:#?}", visit.console);
    Some(told)
}

#[test]
fn before_and_after_are_drawn_and_limits_that_are_reached_are_marked() {
    let arguments = [
        "press.json",
        "--vary",
        "crank=20 mm:60 mm",
        "--vary",
        "rod=120 mm:300 mm",
        "--minimise",
        "max(abs(piston.ax))",
        "--constraint",
        "stroke >= 80 mm",
        "--starts",
        "2",
    ];
    for size in [[1440, 900], [390, 800]] {
        let Some(told) = told(&arguments, size) else {
            return;
        };
        assert_eq!(told["names"], json!(["before", "after"]));
        assert_eq!(told["rows"], json!([37, 37]));
        assert_eq!(told["status"], "found");
        assert!(told["moves"] == true && told["wide"] == 0, "{told:#}");
        let [aims, design, responses] = [0, 1, 2].map(|k| &told["tables"][k]);
        let marked = "stroke >= 80 mm at its limit";
        for (k, words) in [marked, "100 mm", "80 mm", "80 mm"].iter().enumerate() {
            assert_eq!(aims[2][k], *words, "{told:#}");
        }
        let crank = json!(["crank", "50 mm", "40 mm", "20 mm", "60 mm"]);
        let rod = ["200 mm", "300 mm", "120 mm", "300 mm"];
        assert_eq!(design[1], crank);
        let rod = [&["rod at its upper bound"], &rod[..]].concat();
        assert_eq!(design[2], json!(rod));
        assert_eq!(responses[1], json!(["stroke", "100 mm", "80 mm"]));
        // r ω² (1 + r/l), with ω = 2π.
        let least = 0.04 * std::f64::consts::TAU.powi(2) * (1.0 + 0.04 / 0.3);
        let last = told["last"].as_f64().expect("a number");
        assert_eq!(told["curves"], 2);
        assert!((last - least).abs() < 1e-2 * least, "{last} for {least}");
    }
}

#[test]
fn a_path_is_drawn_with_its_points() {
    let curve = r#"optimise={"design":{"crank":[60,140],"rocker":[150,300]},"starts":1,
        "curve":{"point":"coupler.P","through":[[102,154],[124,206],[80,222],[16,196],[-28,141],[-36,88],[-12,64],[-900,89]]}}"#;
    let arguments = ["four-bar", "--set", "analysis.end=0.63", "--set", curve];
    let Some(told) = told(&arguments, [1024, 768]) else {
        return;
    };
    let lengths = [0, 1].map(|k| told["path"][k].as_u64());
    assert!(lengths.iter().all(|own| *own > Some(100)), "{told:#}");
    // A point that the path does not reach is in the picture, too.
    let left = told["box"][0].as_f64().expect("a number");
    assert!((left + 0.9).abs() < 1e-9, "{told:#}");
    assert_eq!(told["tables"][0][1][0], "largest distance from 8 points");
}
