//! Tolerances, ranges of clearance and outputs, as `check` shows them.

use super::{File, checked, linkdyn};
use serde_json::json;

const MODEL: &str = r#"{
  "format": "linkdyn/1",
  "units": { "length": "mm", "angle": "deg" },
  "parameters": {
    "l2": { "value": "100 mm", "tolerance": "0.05 mm" },
    "l3": { "value": "=2.5*l2", "tolerance": ["-0.02 mm", "0.05 mm"], "distribution": "uniform", "cost": "1 mm" },
    "l4": { "value": 200, "tolerance": "2 %", "sigma": 4 },
    "l1": "300 mm"
  },
  "bodies": {
    "ground": { "points": { "O": [0, 0], "Q": { "position": ["=l1", 0], "tolerance": "0.1 mm" } } },
    "crank": { "points": { "O": [0, 0], "A": ["=l2", 0] }, "pose": { "angle": 60 } },
    "coupler": { "points": { "A": [0, 0], "B": ["=l3", 0] }, "pose": { "position": [50, 87], "angle": 20 } },
    "rocker": { "points": { "Q": [0, 0], "B": ["=l4", 0] }, "pose": { "position": [300, 0], "angle": 90 } }
  },
  "joints": {
    "a": { "type": "revolute", "between": ["ground.O", "crank.O"], "clearance": { "model": "ideal", "fit": "20 H7/g6" } },
    "b": { "type": "revolute", "between": ["crank.A", "coupler.A"], "clearance": { "model": "ideal", "radius": ["5 um", "20 um"] } },
    "c": { "type": "revolute", "between": ["coupler.B", "rocker.B"], "clearance": { "model": "ideal", "radius": "10 um" } },
    "d": { "type": "revolute", "between": ["ground.Q", "rocker.Q"] }
  },
  "drivers": {
    "motor": { "type": "rotation", "body": "crank", "tolerance": 0.5,
               "motion": { "type": "constant_velocity", "start": 60, "velocity": "10 rpm" } }
  },
  "analysis": { "type": "kinematics", "end": 6, "outputs": 61 },
  "accuracy": {
    "outputs": {
      "swing": { "column": "rocker.angle", "at": { "value": 90 }, "limits": [-0.1, 0.1] },
      "gap": { "distance": ["crank.A", "ground.Q"], "limits": ["-0.1 mm", 0.2] },
      "push": { "column": "driver.motor.effort", "at": { "driver": "motor", "value": "1 rev" }, "limits": [-1, 1] }
    },
    "pins": "rim"
  }
}"#;

const SHOWN: &str = "
  tolerances    l2 ±0.05 mm, normal, 3 σ
                l3 -0.02 mm to +0.05 mm, uniform, costs 1 mm / t
                l4 ±4, normal, 4 σ
                driver motor ±0.5°
                ground.Q ⌀0.1 mm
  clearances    a 3.5 to 20.5 µm (20 H7/g6: hole 0 to 21 µm, shaft -20 to -7 µm)
                b 5 to 20 µm
  accuracy      swing: rocker.angle at motor 90°, limits ±0.1°
                gap: distance of crank.A and ground.Q over the stroke, limits -0.1 mm to +0.2 mm
                push: driver.motor.effort at motor 360°, limits ±1 N*m
                pins: anywhere on the rim
";

#[test]
fn limits_fits_and_outputs_are_shown() {
    let file = File::new("tolerances", MODEL);
    let (status, stdout, stderr) = linkdyn(&["check", file.path()]);
    assert_eq!(status, Some(0), "{stderr}");
    assert!(stdout.contains(SHOWN), "{stdout}");
}

#[test]
fn programs_get_limits_in_si() {
    let file = File::new("tolerances-json", MODEL);
    let parameters = &checked(&[file.path()])["parameters"];
    assert_eq!(
        parameters["l3"],
        json!({ "value": 0.25, "unit": "m",
                "tolerance": { "lower": -2e-5, "upper": 5e-5, "distribution": "uniform", "sigma": null, "cost": 1e-3 } })
    );
    assert_eq!(parameters["l4"]["tolerance"]["sigma"], 4.0);
    assert_eq!(parameters["l1"], json!({ "value": 0.3, "unit": "m" }));
}

#[test]
fn models_without_such_words_show_none() {
    let (_, stdout, _) = linkdyn(&["check", "four-bar"]);
    let labels = ["tolerances", "clearances", "accuracy"];
    assert!(
        labels
            .iter()
            .all(|label| !stdout.contains(&format!("\n  {label} "))),
        "{stdout}"
    );
}
