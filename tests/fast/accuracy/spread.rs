//! The spread of a position by each kind of source, from closed derivatives of a slider-crank.

use super::told::Told;
use serde_json::{Value, json};

const R: f64 = 0.05;
const L: f64 = 0.2;
const ANGLE: f64 = 1.1;

/// Position of the slide by a source's own tolerance alone.
fn deviations(change: impl Fn(&mut Value)) -> [f64; 2] {
    let mut json = json!({
        "format": "linkdyn/1", "units": "SI",
        "bodies": {
            "ground": { "points": { "O": [0, 0] } },
            "crank": { "points": { "O": [0, 0], "A": [R, 0] }, "pose": { "angle": ANGLE } },
            "rod": { "points": { "A": [0, 0], "B": [L, 0] }, "pose": { "position": [0.025, 0.043], "angle": -0.2 } },
            "slide": { "points": { "B": [0, 0] }, "pose": { "position": [0.22, 0] } } },
        "joints": {
            "main": { "type": "revolute", "between": ["ground.O", "crank.O"] },
            "big": { "type": "revolute", "between": ["crank.A", "rod.A"] },
            "small": { "type": "revolute", "between": ["rod.B", "slide.B"] },
            "guide": { "type": "prismatic", "between": ["ground.O", "slide.B"], "axis": [1, 0] } },
        "drivers": { "motor": { "type": "rotation", "body": "crank",
            "motion": { "type": "constant_velocity", "start": ANGLE, "velocity": 1 } } },
        "analysis": { "type": "kinematics", "end": 0.1, "outputs": 2 },
        "accuracy": { "outputs": { "x": { "column": "slide.x" } } }
    });
    change(&mut json);
    let told = Told::read(&json).unwrap_or_else(|said| panic!("{said}"));
    told.answer().outputs[0].poses[0].moments.expect("moments")
}

#[test]
fn every_kind_of_source_scatters_by_its_own_share() {
    let (sin, cos) = ANGLE.sin_cos();
    let root = (L * L - (R * sin).powi(2)).sqrt();
    // x = r cos θ + √(l² − r² sin² θ), and the rod's direction
    let by_angle = -R * sin - R * R * sin * cos / root;
    let by_length = L / root;
    let t = 1e-4;
    let driver = deviations(|json| json["drivers"]["motor"]["tolerance"] = json!(t));
    let length = |scatter: Value| {
        deviations(|json| {
            json["parameters"] = json!({ "l": { "value": "0.2 m", "tolerance": "0.1 mm" } });
            if scatter != json!("normal") {
                json["parameters"]["l"]["distribution"] = scatter.clone();
            }
            json["bodies"]["rod"]["points"]["B"] = json!(["=l", 0]);
        })
    };
    // A gap carries the slide by its part along the rod, over the rod's cosine.
    let pin = deviations(|json| {
        json["joints"]["big"]["clearance"] = json!({ "model": "ideal", "radius": t });
    });
    for (what, [mean, sigma], known) in [
        ("driver", driver, t * by_angle.abs() / 3.0),
        ("normal", length(json!("normal")), t * by_length / 3.0),
        (
            "uniform",
            length(json!("uniform")),
            t * by_length / 3.0_f64.sqrt(),
        ),
        (
            "triangular",
            length(json!("triangular")),
            t * by_length / 6.0_f64.sqrt(),
        ),
        ("pin on its rim", pin, t * by_length / 2.0_f64.sqrt()),
    ] {
        assert!(
            (sigma / known - 1.0).abs() < 1e-11 && mean == 0.0,
            "{what}: {sigma} instead of {known}, mean {mean}"
        );
    }
}
