//! Texts of all kinds of pages, in windows of a desk, a tablet and a phone: none covers another, leaves the page, or stands on a curve.

use crate::browser::{Scratch, ask_in, find};
use serde_json::{Value, json};
use std::fs;
use std::process::{Command, Stdio};

const SIZES: [[u32; 2]; 3] = [[1440, 900], [1024, 768], [390, 844]];

/// The page that a command leaves in its directory.
fn page(arguments: &[&str]) -> String {
    let scratch = Scratch::new("boxes");
    let mut command = Command::new(env!("CARGO_BIN_EXE_linkdyn"));
    command.args(arguments).arg("-o").arg(&scratch.0);
    let output = command.stdin(Stdio::null()).output();
    let output = output.expect("the binary runs");
    let names = ["report.html", "compare.html", "check.html", "modes.html"];
    let pages = names.map(|name| fs::read_to_string(scratch.0.join(name)));
    pages.into_iter().flatten().next().unwrap_or_else(|| {
        let said = String::from_utf8_lossy(&output.stderr);
        panic!("{arguments:?} leaves no page: {said}")
    })
}

/// What is found in windows of all sizes.
fn walked(arguments: &[&str]) {
    let Some(browser) = find() else { return };
    let page = page(arguments);
    for size in SIZES {
        let script = include_str!("boxes.js");
        let (told, visit) = ask_in(&browser, &page, script, Some(12_000), size);
        assert!(
            visit.console.is_empty(),
            "{arguments:?}: {:#?}",
            visit.console
        );
        assert_eq!(told["faults"], json!([]), "{arguments:?} {size:?}");
        assert!(told["texts"].as_u64() > Some(5), "{arguments:?}: {told:#}");
    }
}

#[test]
fn texts_of_runs_keep_apart() {
    for model in [
        "four-bar",
        "watt-i-lock",
        "slider-crank-clearance",
        "walking-strandbeest",
        "andrews-squeezer",
        "cam-roller",
    ] {
        walked(&["run", model]);
    }
}

#[test]
fn texts_of_other_pages_keep_apart() {
    walked(&["compare", "slider-crank-clearance", "--joint", "wristpin"]);
    walked(&["accuracy", "watt-i-lock"]);
    walked(&["check", "slider-crank"]);
    walked(&["modes", "double-pendulum"]);
    let crank = ["--vary", "parameters.crank=40 mm:100 mm:11"];
    let rod = ["--vary", "parameters.rod=120 mm:240 mm:11"];
    let peak = "max(abs(driver.motor.effort))";
    let response = format!("peak = {peak}");
    let response = ["--response", &response];
    walked(&[&["study", "slider-crank"], &crank[..], &rod, &response].concat());
    let crank = ["--vary", "parameters.crank=20 mm:60 mm"];
    let bounded = ["--constraint", "max(piston.x) - min(piston.x) > 70 mm"];
    let least = ["--minimise", peak];
    walked(&[&["optimise", "slider-crank"], &crank[..], &least, &bounded].concat());
}

/// The walk sees what is planted: a text over another one, one that leaves the page, and one on a canvas that is cut off.
#[test]
fn planted_faults_are_found() {
    let Some(browser) = find() else { return };
    let page = page(&["run", "four-bar"]);
    for (planted, said) in [
        (
            "document.getElementById('line').style.marginLeft = '-9em'",
            "over each other",
        ),
        (
            "document.getElementById('about').style.cssText = 'position: relative; left: -40px'",
            "outside",
        ),
        (
            "document.getElementById('foot').style.width = '2000px'",
            "scrolls sideways",
        ),
        (
            "linkdyn.drawing.draw = (pen) => { pen.fillText('far', 0, 0); return []; }",
            "cut off",
        ),
    ] {
        let script = format!("{planted};\n{}", include_str!("boxes.js"));
        let (told, _) = ask_in(&browser, &page, &script, Some(12_000), SIZES[0]);
        let faults: Vec<&Value> = told["faults"].as_array().expect("a list").iter().collect();
        let found = faults
            .iter()
            .any(|fault| fault.as_str().is_some_and(|text| text.starts_with(said)));
        assert!(found, "{planted}: {told:#}");
    }
}
