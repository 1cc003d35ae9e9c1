//! Paths of points found again by `linkdyn optimise`: a known four-bar from 25 points of its curve by nearly every start, and on the other
//! branch its cognate, whose dimensions are known in closed form (Roberts 1875).
//!
//! ```text
//! λ = (px + i py)/coupler               a point of the coupler, by the coupler
//! cognate over E = A + λ (D − A) and D  base, crank, coupler, rocker = |1 − λ| (base, crank, rocker, coupler), its crank at E
//! ```
//!
//! Source: Hartenberg and Denavit, Kinematic Synthesis of Linkages, 1964, ch. 6. The points are worked out here by the law of cosines.

use serde_json::{Value, json};
use std::f64::consts::TAU;
use std::process::{Command, Stdio};

/// Base, crank, coupler, rocker, and the point in the coupler [mm].
const TRUE: [f64; 4] = [300.0, 100.0, 250.0, 200.0];
const POINT: [f64; 2] = [125.0, 80.0];
/// Distances of points from a path that is found again are below this [m].
const FOUND: f64 = 1e-8;

/// The curve's points, at even angles of the crank.
fn points(count: usize) -> Value {
    let [base, crank, coupler, rocker] = TRUE;
    let point = |k: usize| {
        let (sin, cos) = (TAU * k as f64 / count as f64).sin_cos();
        let a = [crank * cos, crank * sin];
        let gap = [base - a[0], -a[1]];
        let d = gap[0].hypot(gap[1]);
        let part = (coupler * coupler + d * d - rocker * rocker) / (2.0 * coupler * d);
        let (sin, cos) = (part.acos() + gap[1].atan2(gap[0])).sin_cos();
        json!([
            a[0] + POINT[0] * cos - POINT[1] * sin,
            a[1] + POINT[0] * sin + POINT[1] * cos
        ])
    };
    (0..count).map(point).collect()
}

/// A four-bar of which nothing is known but that its crank turns; `side` says on which side the coupler is put together.
fn model(side: f64, starts: u64) -> Value {
    let length = json!([50, 500]);
    let place = json!([-300, 300]);
    json!({ "format": "linkdyn/1", "name": "Tracer", "units": { "length": "mm", "angle": "deg" },
        "parameters": { "x": "10 mm", "y": "-20 mm", "tilt": "5 deg", "base": "280 mm", "crank": "90 mm", "coupler": "260 mm",
            "rocker": "210 mm", "px": "100 mm", "py": "60 mm" },
        "bodies": {
            "ground": { "points": { "A": ["=x", "=y"], "D": ["=x+base*cos(tilt)", "=y+base*sin(tilt)"] } },
            "crank": { "points": { "A": [0, 0], "B": ["=crank", 0] }, "pose": { "position": ["=x", "=y"], "angle": "=tilt" } },
            "coupler": { "points": { "B": [0, 0], "C": ["=coupler", 0], "P": ["=px", "=py"] },
                "pose": { "position": ["=x+crank*cos(tilt)", "=y+crank*sin(tilt)"], "angle": format!("=tilt+{side}*1 rad") } },
            "rocker": { "points": { "D": [0, 0], "C": ["=rocker", 0] },
                "pose": { "position": ["=x+base*cos(tilt)", "=y+base*sin(tilt)"], "angle": format!("=tilt+{side}*100 deg") } } },
        "joints": {
            "a": { "type": "revolute", "between": ["ground.A", "crank.A"] },
            "b": { "type": "revolute", "between": ["crank.B", "coupler.B"] },
            "c": { "type": "revolute", "between": ["coupler.C", "rocker.C"] },
            "d": { "type": "revolute", "between": ["ground.D", "rocker.D"] } },
        "drivers": { "motor": { "type": "rotation", "body": "crank",
            "motion": { "type": "constant_velocity", "velocity": "60 rpm" } } },
        "analysis": { "type": "kinematics", "end": 1, "outputs": 37 },
        "optimise": {
            "design": { "x": [-200, 200], "y": [-200, 200], "tilt": [-80, 80], "base": length, "crank": length, "coupler": length,
                "rocker": length, "px": place, "py": place },
            "curve": { "point": "coupler.P", "through": points(25) }, "starts": starts, "seed": 1 } })
}

fn optimise(name: &str, model: &Value) -> Value {
    let path = std::env::temp_dir().join(format!("linkdyn-{name}-{}.json", std::process::id()));
    std::fs::write(&path, model.to_string()).expect("a model");
    let mut command = Command::new(env!("CARGO_BIN_EXE_linkdyn"));
    command
        .arg("optimise")
        .arg(&path)
        .arg("--json")
        .stdin(Stdio::null());
    let output = command.output().expect("the binary runs");
    std::fs::remove_file(&path).expect("it is there");
    assert_eq!(
        output.status.code(),
        Some(0),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    serde_json::from_slice(&output.stdout).expect("JSON")
}

/// All dimensions, and where the base is.
fn assert_design(found: &Value, exact: &[(&str, f64)]) {
    for (name, exact) in exact {
        let value = found["design"][name]["value"].as_f64().expect("a value");
        assert!(
            (value - exact).abs() < FOUND,
            "{name} = {value}, not {exact}"
        );
    }
}

#[test]
fn a_four_bar_is_found_again_from_25_points_by_nearly_every_start() {
    let found = optimise("paths", &model(1.0, 20));
    let starts = found["starts"].as_array().expect("starts");
    let mut good = 0;
    for start in starts {
        // The root of the sum of squares, by the diagonal of the points, which is 252 mm.
        let off = start["value"].as_f64().map(|value| value.sqrt() * 0.252);
        println!(
            "start {}: {} after {} evaluations, off by {off:?} m",
            start["start"], start["ended"], start["evaluations"]
        );
        good += u64::from(off < Some(FOUND));
    }
    assert!(good >= 18, "{good} of {}", starts.len());
    assert!(
        found["curve"]["largest_distance"].as_f64() < Some(FOUND),
        "{found}"
    );
    assert_design(
        &found,
        &[
            ("x", 0.0),
            ("y", 0.0),
            ("tilt", 0.0),
            ("base", 0.3),
            ("crank", 0.1),
            ("coupler", 0.25),
            ("rocker", 0.2),
            ("px", 0.125),
            ("py", 0.08),
        ],
    );
}

#[test]
fn on_the_other_branch_the_cognate_is_found() {
    let found = optimise("cognates", &model(-1.0, 3));
    assert!(
        found["curve"]["largest_distance"].as_f64() < Some(FOUND),
        "{found}"
    );
    let [base, crank, coupler, rocker] = TRUE.map(|length| 1e-3 * length);
    let part = POINT.map(|one| 1e-3 * one / coupler);
    let size = (1.0 - part[0]).hypot(part[1]);
    assert_design(
        &found,
        &[
            ("x", part[0] * base),
            ("y", part[1] * base),
            ("tilt", -part[1].atan2(1.0 - part[0])),
            ("base", size * base),
            ("crank", size * crank),
            ("coupler", size * rocker),
            ("rocker", size * coupler),
        ],
    );
}

/// The published design of `validation/path-synthesis`, seen from the coupler point, as printed, and its last digit [m].
const PRINTED: [(&str, f64, f64); 4] = [
    ("x1", -0.0877960434509, 1e-13),
    ("x2", -0.851386907516, 1e-12),
    ("y1", 0.235837391307, 1e-12),
    ("y2", -1.41899202704, 1e-11),
];

#[test]
fn a_published_problem_of_synthesis_has_its_published_design() {
    let text = include_str!("../../validation/path-synthesis/model.json");
    let found = optimise("line", &serde_json::from_str(text).expect("JSON"));
    assert_eq!(found["status"], "found");
    for (name, printed, digit) in PRINTED {
        let value = found["design"][name]["value"].as_f64().expect("a value");
        assert!(
            (value - printed).abs() < digit,
            "{name} = {value}, not {printed}"
        );
    }
    let distance = found["curve"]["largest_distance"].as_f64();
    assert!(distance < Some(1e-12), "{distance:?}");
}
