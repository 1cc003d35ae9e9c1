//! What a study refuses, and in which words.

use super::study;
use crate::browser::Scratch;

/// Arguments, and what is said of them.
const REFUSALS: &[(&[&str], &str)] = &[
    (
        &[],
        "error: nothing is varied: say --vary \"parameters.NAME=FROM:TO:COUNT\", or --samples N for tolerances",
    ),
    (
        &["--vary", "crnk=40 mm:60 mm:3"],
        "error: --vary crnk=40 mm:60 mm:3: the model has no parameter \"crnk\" (did you mean \"crank\"?)",
    ),
    (
        &["--vary", "wheel=1:2:3"],
        "error: --vary wheel=1:2:3: the model has no parameter \"wheel\" (it has crank, rod)",
    ),
    (
        &["--vary", "crank"],
        "error: --vary crank: write it as in \"parameters.r=40 mm:60 mm:21\" or \"parameters.r=40 mm, 50 mm\"",
    ),
    (
        &["--vary", "crank=40 mm:60 mm"],
        "error: --vary crank=40 mm:60 mm: write it as in \"parameters.r=40 mm:60 mm:21\" or \"parameters.r=40 mm, 50 mm\"",
    ),
    (
        &["--vary", "crank=40 mm:60 mm:many"],
        "error: --vary crank=40 mm:60 mm:many: \"many\" is no count of values",
    ),
    (
        &["--vary", "crank=40 mm:60 mm:0"],
        "error: --vary crank=40 mm:60 mm:0: 0 values: give at least 1",
    ),
    (
        &["--vary", "crank=40 mm:90 deg:3"],
        "error: --vary crank=40 mm:90 deg:3: \"90 deg\" is in rad, crank is in m (50 mm)",
    ),
    (
        &["--vary", "crank=40:60:3"],
        "error: --vary crank=40:60:3: \"40\" is a plain number, crank is in m (50 mm)",
    ),
    (
        &["--vary", "crank=wide"],
        "error: --vary crank=wide: \"wide\": this does not begin with a number",
    ),
    (
        &["--vary", "crank=1 mm, 2 mm", "--vary", "crank=3 mm"],
        "error: --vary crank=3 mm: crank is varied twice",
    ),
    (
        &["--samples", "0"],
        "error: --samples: 0 samples: give at least 1",
    ),
    (
        &["--samples", "9", "--indices", "--vary", "rod=200 mm"],
        "error: --indices: Sobol indices are those of samples; not together with --vary",
    ),
    (
        &["--samples", "9", "--shard", "8/7", "-o", "new"],
        "error: --shard 8/7: shard 8/7: there are shards 1/7 to 7/7",
    ),
    (
        &["--samples", "9", "--shard", "slurm", "-o", "new"],
        "error: --shard slurm: SLURM_ARRAY_TASK_ID is not set: this is no task of a Slurm array",
    ),
    (
        &["--samples", "9", "--response", "peak"],
        "error: --response \"peak\": a name and an expression are expected (as in \"stroke = max(piston.x) - min(piston.x)\")",
    ),
    (
        &["--samples", "9", "-o", "there"],
        "there/study.json: it is another study (other inputs, samples): choose another directory, or remove this one",
    ),
    (
        &[
            "--vary",
            "crank=40 mm:60 mm:3",
            "--set",
            "name=Other",
            "-o",
            "there",
        ],
        "there/study.json: it is another study (other model): choose another directory, or remove this one",
    ),
    (
        &["--samples", "9", "--shard", "0/3", "-o", "new"],
        "error: --shard 0/3: shard 0/3: there are shards 1/3 to 3/3",
    ),
    (
        &["--samples", "9", "--response", "peak = max(slde.x)"],
        "error: feeder.json: --response \"peak = max(slde.x)\": there is no column, parameter or number \"slde.x\" (did you mean \"slide.x\"?)",
    ),
    (
        &[
            "--samples",
            "9",
            "--response",
            "sum = max(slide.x) + max(rod.angle)",
        ],
        "error: feeder.json: --response \"sum = max(slide.x) + max(rod.angle)\": a length [m] and an angle [rad] can't be added",
    ),
    (
        &["--set", "study.vary.crnk=\"1 mm\""],
        "error: study.vary.crnk \"1 mm\": the model has no parameter \"crnk\" (did you mean \"crank\"?)",
    ),
    (
        &["--set", "study.vary.rod=\"1 s:2 s:3\""],
        "error: study.vary.rod \"1 s:2 s:3\": \"1 s\" is in s, rod is in m (200 mm)",
    ),
    (
        &["--set", "study.samples=0"],
        "error: feeder.json: --set study.samples=0: must not be less than 1",
    ),
    (
        &["--set", "study.method=\"halton\""],
        "error: feeder.json: --set study.method=\"halton\": unknown method (did you mean \"latin\"?)",
    ),
    (
        &["--set", "study.sampels=3"],
        "error: feeder.json: --set study.sampels=3: unknown key (did you mean \"samples\"?)",
    ),
    (
        &["--set", "study.seed=1"],
        "error: nothing is varied: say --vary \"parameters.NAME=FROM:TO:COUNT\", or --samples N for tolerances",
    ),
    (
        &["--samples", "9", "--response", "crank = max(slide.x)"],
        "error: feeder.json: --response \"crank = max(slide.x)\": a parameter has this name (give the response another name)",
    ),
    (
        &["--samples", "9", "--response", "a = slide.x"],
        "error: feeder.json: --response \"a = slide.x\": this has many values: which one of them? (max( … ), mean( … ), last( … ), or at( … , driver.NAME = value))",
    ),
    (
        &["--samples", "9", "--shard", "1/2"],
        "error: the following required arguments were not provided:",
    ),
    (
        &["--samples", "9", "--latin", "--sobol"],
        "error: the argument '--latin' cannot be used with '--sobol'",
    ),
    (
        &["merge", "nowhere"],
        "nowhere/study.json: there is no study in this directory",
    ),
];

/// What it refuses, in these words.
#[test]
fn refusals_say_what_and_how() {
    let scratch = Scratch::new("study-refusals");
    let grid = ["--vary", "crank=40 mm:60 mm:3", "-o", "there"];
    assert_eq!(study(&scratch, &grid).status.code(), Some(0));
    for (arguments, text) in REFUSALS {
        let output = study(&scratch, arguments);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {said}");
        assert!(said.contains(text), "{arguments:?}:\n{said}\nlacks {text}");
    }
    assert!(!scratch.0.join("new").exists());
}
