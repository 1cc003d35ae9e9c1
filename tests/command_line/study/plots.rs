//! Figures of studies.

use super::study;
use crate::browser::Scratch;
use std::fs;
use std::process::{Command, Output};

fn plot(scratch: &Scratch, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_linkdyn"));
    command.arg("plot").args(arguments).current_dir(&scratch.0);
    command.output().expect("the binary runs")
}

fn figure(scratch: &Scratch, arguments: &[&str]) -> String {
    let output = plot(scratch, &[arguments, &["-o", "figure.svg"]].concat());
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {said}");
    fs::read_to_string(scratch.0.join("figure.svg")).expect("a figure")
}

#[test]
fn studies_are_drawn_over_what_was_varied() {
    let scratch = Scratch::new("study-plots");
    let one = ["--vary", "crank=60 mm, 40 mm, 50 mm", "-o", "one"];
    assert_eq!(study(&scratch, &one).status.code(), Some(0));
    let drawn = figure(&scratch, &["one", "--y", "stroke", "--units", "mm"]);
    for word in ["parameters.crank", "stroke", "mm"] {
        assert!(drawn.contains(word), "no {word}");
    }
    let two = [
        "--vary",
        "crank=40 mm:60 mm:5",
        "--vary",
        "rod=180 mm, 220 mm",
        "-o",
        "two",
    ];
    assert_eq!(study(&scratch, &two).status.code(), Some(0));
    let drawn = figure(&scratch, &["two", "--x", "crank", "--y", "stroke"]);
    for word in ["rod = 0.18 m", "rod = 0.22 m"] {
        assert!(drawn.contains(word), "no {word}");
    }
    let samples = ["--samples", "300", "-o", "samples"];
    assert_eq!(study(&scratch, &samples).status.code(), Some(0));
    let drawn = figure(&scratch, &["samples", "--y", "stroke", "--histogram"]);
    for word in ["share of variants", "limits", "stroke"] {
        assert!(drawn.contains(word), "no {word}");
    }
    for (arguments, text) in [
        (
            &["two", "--y", "stroke"][..],
            "error: two: which one is the x axis? --x parameters.crank, or --x parameters.rod",
        ),
        (
            &["samples", "--y", "stroke"],
            "error: samples: samples are no curve: --histogram draws how often a response has its values",
        ),
        (
            &["samples", "--y", "stroke", "parameters.rod", "--histogram"],
            "error: --histogram draws one column: give --y once, without * and ?",
        ),
        (
            &["samples", "--y", "strike", "--histogram"],
            "error: samples/variants.csv: --y strike: no column of that name (did you mean \"stroke\"?)",
        ),
    ] {
        let output = plot(&scratch, &[arguments, &["-o", "none.svg"]].concat());
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {said}");
        assert!(said.contains(text), "{said}\nlacks {text}");
    }
}
