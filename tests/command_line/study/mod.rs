//! `linkdyn study`: variants against closed forms, the same bytes however they were computed, and what it refuses.

mod plots;
mod refused;

use crate::browser::Scratch;
use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::time::Duration;

/// A slider-crank of which crank and rod scatter; its stroke is twice the crank.
const MODEL: &str = r#"{
  "format": "linkdyn/1", "name": "Feeder", "units": { "length": "mm", "angle": "deg" },
  "parameters": {
    "crank": { "value": "50 mm", "tolerance": "0.05 mm" },
    "rod": { "value": "200 mm", "tolerance": ["-0.1 mm", "0.1 mm"], "distribution": "uniform" }
  },
  "bodies": {
    "ground": { "points": { "O": [0, 0] } },
    "crank": { "points": { "O": [0, 0], "A": ["=crank", 0] }, "pose": { "angle": 60 } },
    "rod": { "points": { "A": [0, 0], "B": ["=rod", 0] }, "pose": { "position": [25, 43], "angle": -13 } },
    "slide": { "points": { "B": [0, 0] }, "pose": { "position": [220, 0] } }
  },
  "joints": {
    "main": { "type": "revolute", "between": ["ground.O", "crank.O"] },
    "big": { "type": "revolute", "between": ["crank.A", "rod.A"] },
    "small": { "type": "revolute", "between": ["rod.B", "slide.B"] },
    "guide": { "type": "prismatic", "between": ["ground.O", "slide.B"], "axis": [1, 0] }
  },
  "drivers": { "motor": { "type": "rotation", "body": "crank",
    "motion": { "type": "constant_velocity", "start": 0, "velocity": "60 rpm" } } },
  "responses": { "stroke": { "value": "max(slide.x) - min(slide.x)", "limits": [99.95, 100.05], "unit": "mm" } },
  "analysis": { "type": "kinematics", "end": 1, "outputs": 37 }
}"#;

fn command(scratch: &Scratch, arguments: &[&str]) -> Command {
    let model = scratch.0.join("feeder.json");
    fs::write(&model, MODEL).expect("a model");
    let mut command = Command::new(env!("CARGO_BIN_EXE_linkdyn"));
    command.arg("study").current_dir(&scratch.0);
    if arguments.first() != Some(&"merge") {
        command.arg("feeder.json");
    }
    command.args(arguments).stdin(Stdio::null());
    command
}

fn study(scratch: &Scratch, arguments: &[&str]) -> Output {
    let output = command(scratch, arguments).output();
    output.expect("the binary runs")
}

fn json(scratch: &Scratch, arguments: &[&str]) -> Value {
    let output = study(scratch, arguments);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {said}");
    serde_json::from_slice(&output.stdout).expect("JSON")
}

/// The rows of `variants.csv` without its header.
fn rows(directory: &Path) -> Vec<Vec<String>> {
    let text = fs::read_to_string(directory.join("variants.csv")).expect("a table");
    let lines = text.lines().skip(1);
    lines
        .map(|line| line.split(',').map(str::to_owned).collect())
        .collect()
}

/// A crank of r has a stroke of 2r; longer than the rod it never comes round, and is told as a row with its reason.
#[test]
fn a_sweep_has_a_row_for_each_variant() {
    let scratch = Scratch::new("study-sweep");
    let told = json(
        &scratch,
        &[
            "--vary",
            "parameters.crank=45 mm:245 mm:21",
            "--json",
            "-o",
            "out",
        ],
    );
    let rows = rows(&scratch.0.join("out"));
    assert_eq!(rows.len(), 21);
    let mut completed = 0;
    for (number, row) in rows.iter().enumerate() {
        let crank = 0.045 + 0.01 * number as f64;
        assert_eq!(row[0], number.to_string());
        assert!((row[2].parse::<f64>().expect("a number") - crank).abs() < 1e-15);
        if row[1] == "ok" {
            let stroke: f64 = row[3].parse().expect("a number");
            assert!((stroke - 2.0 * crank).abs() < 1e-12, "{row:?}");
            completed += 1;
        } else {
            assert!(crank > 0.2, "{row:?}");
            assert_eq!(row[3], "");
        }
    }
    assert_eq!(completed, 16);
    let summary = &told["summary"];
    assert_eq!(summary["completed"]["within"], 16);
    let failures = summary["failures"].as_object().expect("reasons");
    let failed: u64 = failures.values().filter_map(Value::as_u64).sum();
    assert_eq!(failed, 5);
    assert!(failures.contains_key("dead_centre"), "{failures:?}");
    assert_eq!(summary["responses"]["stroke"]["none"], 5);
}

/// What a model says of its study is done as the options say it, which go before it.
#[test]
fn the_model_may_say_what_is_varied() {
    let scratch = Scratch::new("study-words");
    let inputs = |told: &Value| {
        (
            told["method"].clone(),
            told["seed"].clone(),
            told["inputs"].clone(),
        )
    };
    let samples = [
        "--set",
        "study.samples=20",
        "--set",
        "study.method=\"sobol\"",
    ];
    let own = json(
        &scratch,
        &[&samples[..], &["--set", "study.seed=7", "--json"]].concat(),
    );
    let said = json(
        &scratch,
        &["--samples", "20", "--sobol", "--seed", "7", "--json"],
    );
    assert_eq!(inputs(&own), inputs(&said));
    assert_eq!(own["summary"], said["summary"]);
    let grid = ["--set", "study.vary.crank=\"40 mm:60 mm:3\""];
    let own = json(&scratch, &[&grid[..], &["--json"]].concat());
    let said = json(
        &scratch,
        &["--vary", "parameters.crank=40 mm:60 mm:3", "--json"],
    );
    assert_eq!(inputs(&own), inputs(&said));
    assert_eq!(own["summary"], said["summary"]);
    let over = json(
        &scratch,
        &[&grid[..], &["--vary", "rod=200 mm", "--json"]].concat(),
    );
    assert_eq!(over["variants"], 1);
}

/// Two axes multiply, the last one fastest; values may be listed, and responses come from the command.
#[test]
fn axes_multiply() {
    let scratch = Scratch::new("study-axes");
    let said = json(
        &scratch,
        &[
            "--vary",
            "crank=40 mm, 50 mm",
            "--vary",
            "rod=0.2 m:0.3 m:3",
            "--json",
            "-o",
            "out",
            "--response",
            "reach = max(slide.x)",
            "--response",
            "share = max(slide.x)/(crank + rod)",
        ],
    );
    assert_eq!(said["variants"], 6);
    for (number, row) in rows(&scratch.0.join("out")).iter().enumerate() {
        let crank = [0.04, 0.05][number / 3];
        let rod = [0.2, 0.25, 0.3][number % 3];
        let values: Vec<f64> = row[2..]
            .iter()
            .map(|cell| cell.parse().expect("a number"))
            .collect();
        for (value, wanted) in values
            .iter()
            .zip([crank, rod, 2.0 * crank, crank + rod, 1.0])
        {
            assert!((value - wanted).abs() < 1e-12, "{row:?}");
        }
    }
}

/// The stroke scatters by twice the crank's deviation, cut at three: mean and σ within three standard errors; the rod has no
/// share.
#[test]
fn samples_scatter_as_the_closed_form_says() {
    let scratch = Scratch::new("study-samples");
    // σ of a normal cut at 3σ is 0.98658 of it.
    let sigma = 2.0 * 0.05e-3 / 3.0 * 0.986_578_5;
    let told = json(&scratch, &["--samples", "4000", "--json"]);
    let stroke = &told["summary"]["responses"]["stroke"];
    let (mean, deviation) = (&stroke["mean"], &stroke["deviation"]);
    let (mean, deviation) = (
        mean.as_f64().expect("mean"),
        deviation.as_f64().expect("deviation"),
    );
    let n = 4000.0_f64;
    assert!((mean - 0.1).abs() < 3.0 * sigma / n.sqrt(), "{mean}");
    assert!(
        (deviation - sigma).abs() < 3.0 * sigma / (2.0 * n).sqrt(),
        "{deviation}"
    );
    // Limits of ±0.05 mm are 1.5 uncut standard deviations of the stroke.
    let within = &told["summary"]["within_limits"];
    let bounds = ["lower", "upper"].map(|side| within[side].as_f64().expect("a bound"));
    let expected = (0.866_385_6 - 0.0) / 0.997_300_2;
    assert!(bounds[0] < expected && expected < bounds[1], "{bounds:?}");

    let told = json(
        &scratch,
        &["--samples", "512", "--sobol", "--indices", "--json"],
    );
    let indices = &told["summary"]["responses"]["stroke"]["indices"];
    let of = |kind: &str, input: usize| indices[kind][input]["value"].as_f64().expect("an index");
    assert!(
        (of("first", 0) - 1.0).abs() < 0.02 && of("total", 1).abs() < 1e-6,
        "{indices}"
    );
}

/// The same bytes for one and two threads, in one go, by shards, and killed at any moment and gone on with.
#[test]
fn bytes_do_not_depend_on_who_computed_them() {
    let scratch = Scratch::new("study-bytes");
    let model = [
        "--samples",
        "30000",
        "--sobol",
        "--set",
        "analysis.outputs=9",
    ];
    let with = |more: &[&'static str]| -> Vec<&str> { [&model[..], more].concat() };
    let run = |arguments: &[&str]| {
        let output = study(&scratch, arguments);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(0), "{arguments:?}: {said}");
    };
    // Nothing is added where the command was built without it.
    let columns: &[&str] = if cfg!(feature = "parquet") {
        &["--parquet"]
    } else {
        &[]
    };
    run(&with(&[&["-o", "one", "--threads", "1"], columns].concat()));
    run(&with(&[&["-o", "two", "--threads", "2"], columns].concat()));
    for shard in ["7/7", "3/7", "1/7", "2/7", "6/7", "5/7", "4/7"] {
        run(&with(&["-o", "parts", "--shard", shard]));
    }
    run(&[&["merge", "parts"], columns].concat());
    for attempt in 0..20 {
        let mut child = command(&scratch, &with(&["-o", "killed"]))
            .stdout(Stdio::null())
            .spawn()
            .expect("the binary runs");
        std::thread::sleep(Duration::from_millis(30 + 41 * attempt % 300));
        match attempt % 2 {
            0 => drop(child.kill()),
            _ => end(&child, "-TERM"),
        }
        let _ = child.wait();
    }
    run(&with(&[&["-o", "killed"], columns].concat()));
    let by_columns = columns.first().map(|_| "variants.parquet");
    for file in ["variants.csv", "study.json"].into_iter().chain(by_columns) {
        let read =
            |directory: &str| fs::read(scratch.0.join(directory).join(file)).expect("a file");
        let one = read("one");
        assert!(one.len() > 1000);
        for other in ["two", "parts", "killed"] {
            assert!(one == read(other), "{file} of {other}");
        }
    }
}

/// Sends a signal.
fn end(child: &Child, signal: &str) {
    let id = child.id().to_string();
    let sent = Command::new("kill").args([signal, &id]).status();
    assert!(sent.is_ok_and(|status| status.success()));
}

/// Signals to end keep all variants that are done, also of a chunk that is not; what a `nohup` ignores does not end it.
#[test]
#[cfg(unix)]
fn signals_to_end_keep_what_is_done() {
    let scratch = Scratch::new("study-signals");
    // one chunk of several seconds
    let options = ["--samples", "4000", "--set", "analysis.outputs=1001"];
    let options = [&options[..], &["--threads", "1"]].concat();
    for signal in ["-TERM", "-HUP", "-INT"] {
        // A machine that is busy computes little in 0.4 s: then the same with twice the time.
        let kept = (0..6).map(|doubled| {
            let directory = format!("study{signal}-{doubled}");
            let child = command(&scratch, &[&options[..], &["-o", &directory]].concat())
                .stdout(Stdio::null())
                .stderr(Stdio::piped())
                .spawn()
                .expect("the binary runs");
            let chunks = scratch.0.join(directory).join("chunks");
            let has_begun = (0..3000).any(|_| {
                std::thread::sleep(Duration::from_millis(20));
                chunks.exists()
            });
            assert!(has_begun);
            std::thread::sleep(Duration::from_millis(400 << doubled));
            end(&child, signal);
            let output = child.wait_with_output().expect("it ends");
            let said = String::from_utf8_lossy(&output.stderr);
            assert_eq!(output.status.code(), Some(130), "{signal}: {said}");
            assert!(
                said.contains("goes on from the variants that are done"),
                "{said}"
            );
            let kept = fs::read_dir(chunks).expect("there").flatten();
            kept.map(|entry| entry.metadata().map_or(0, |file| file.len()))
                .sum::<u64>()
        });
        // a row has some 40 bytes, and there were many
        assert!(kept.into_iter().any(|size| size > 2000), "{signal}");
    }
}

/// A command without it says so before it computes.
#[test]
#[cfg(not(feature = "parquet"))]
fn a_table_by_columns_is_refused_where_it_was_not_built() {
    let scratch = Scratch::new("study-parquet");
    for arguments in [
        &["-o", "out", "--parquet"][..],
        &["merge", "out", "--parquet"],
    ] {
        let output = study(&scratch, arguments);
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(said.contains("--features dist"), "{said}");
    }
    assert!(!scratch.0.join("out").exists());
}
