//! Peaks between rows in what the command leaves: summary, report, figures and comparisons.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

/// A folder of its own, removed at the end.
struct Scratch(PathBuf);

impl Scratch {
    fn new(name: &str) -> Self {
        let path = Path::new(env!("CARGO_TARGET_TMPDIR"))
            .join(format!("extremes-{}-{name}", std::process::id()));
        fs::create_dir_all(&path).expect("a scratch directory");
        Scratch(path)
    }

    #[track_caller]
    fn linkdyn(&self, arguments: &[&str]) -> String {
        let mut command = Command::new(env!("CARGO_BIN_EXE_linkdyn"));
        let output = command
            .args(arguments)
            .current_dir(&self.0)
            .output()
            .expect("the binary runs");
        assert!(
            output.status.success(),
            "{}",
            String::from_utf8_lossy(&output.stderr)
        );
        String::from_utf8(output.stdout).expect("UTF-8")
    }

    fn read(&self, name: &str) -> String {
        fs::read_to_string(self.0.join(name)).unwrap_or_else(|fault| panic!("{name}: {fault}"))
    }

    fn json(&self, name: &str) -> Value {
        serde_json::from_str(&self.read(name)).expect("valid JSON")
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

const SHORT: [&str; 4] = [
    "--set",
    "analysis.end=0.003",
    "--set",
    "analysis.outputs=31",
];
const COLUMN: &str = "joint.wristpin.normal_force[N]";

/// Summary, report and curve know the peaks; a folder without them is drawn as it was, and no other run's are taken.
#[test]
fn files_and_figures_have_the_peaks() {
    let scratch = Scratch::new("files");
    let run = |model: &str, more: &[&str]| {
        scratch.linkdyn(&[&["run", model, "-o", "out"], more].concat())
    };
    let told = run("slider-crank-clearance", &SHORT);
    assert!(told.contains("peaks.csv"), "{told}");
    let summary = scratch.json("out/summary.json");
    let peaks: Vec<f64> = summary["events"]
        .as_array()
        .expect("events")
        .iter()
        .filter_map(|event| event["peak_force"].as_f64())
        .collect();
    let largest = peaks.iter().copied().fold(0.0, f64::max);
    let told = summary["extremes"][COLUMN]["max"]
        .as_f64()
        .expect("a number");
    assert!((told / largest - 1.0).abs() < 1e-9, "{told} for {largest}");
    assert!(
        scratch
            .read("out/report.html")
            .contains("instants between them"),
        "the report says so"
    );
    let headers = ["out/results.csv", "out/peaks.csv"]
        .map(|name| scratch.read(name).lines().next().map(String::from));
    assert_eq!(headers[0], headers[1]);
    let draw = || {
        scratch.linkdyn(&[
            "plot",
            "out",
            "--y",
            "joint.wristpin.normal_force",
            "-o",
            "force.svg",
        ]);
        scratch.read("force.svg")
    };
    let with = draw();
    fs::rename(scratch.0.join("out/peaks.csv"), scratch.0.join("kept.csv")).expect("moved");
    let without = draw();
    // The largest force is 45.8 kN, that of the rows 16 kN.
    assert!(
        with.contains(">40000<") && !without.contains(">40000<"),
        "the axis shows the peaks"
    );
    fs::write(
        scratch.0.join("out/peaks.csv"),
        "time[s],another[m]\n0.001,1\n",
    )
    .expect("written");
    assert!(draw() == without, "another table's rows are not drawn");
    run("four-bar", &[]);
    assert!(
        !scratch.0.join("out/peaks.csv").exists(),
        "a run without peaks leaves none of an older one"
    );
}

#[test]
fn compare_tells_the_extremes_that_the_runs_have() {
    let scratch = Scratch::new("compare");
    let told = scratch.linkdyn(
        &[
            &[
                "compare",
                "slider-crank-clearance",
                "--joint",
                "wristpin",
                "--models",
                "ideal,contact",
                "-o",
                "both",
            ][..],
            &["--columns", "joint.wristpin.fx,driver.motor.effort"],
            &SHORT,
        ]
        .concat(),
    );
    assert!(told.contains("smallest and largest"), "{told}");
    let compared = scratch.json("both/compare.json");
    for label in ["joint.wristpin.fx[N]", "driver.motor.effort[N*m]"] {
        for model in ["ideal", "contact"] {
            let own = &scratch.json(&format!("both/{model}/summary.json"))["extremes"][label];
            assert!(own["max"].is_f64(), "{own}");
            assert_eq!(&compared["extremes"][label][model], own, "{model} {label}");
        }
    }
    assert!(!scratch.0.join("both/ideal/peaks.csv").exists());
}
