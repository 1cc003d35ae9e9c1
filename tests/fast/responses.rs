//! Responses against closed forms: a slider-crank with r = 50 mm and l = 200 mm, 61 rows of one turn.

use linkdyn_engine::analysis::responses::{Answer, Responses};
use linkdyn_engine::analysis::{Control, Prepared};
use linkdyn_model::{Checked, Response, load};
use std::f64::consts::{PI, TAU};

const R: f64 = 0.05;
const L: f64 = 0.2;

/// A slider-crank that turns once in a second, forces by masses; rows every 6°.
const SLIDER_CRANK: &str = r#"{ "format": "linkdyn/1", "units": { "length": "mm", "angle": "deg" },
  "parameters": { "r": "50 mm", "l": "200 mm" },
  "bodies": {
    "ground": { "points": { "O": [0, 0] } },
    "crank": { "mass": 1, "inertia": 0.001, "com": [0, 0], "points": { "O": [0, 0], "A": ["=r", 0] } },
    "rod": { "mass": 0, "inertia": 0, "com": [0, 0], "points": { "A": [0, 0], "B": ["=l", 0] }, "pose": { "position": [50, 0] } },
    "piston": { "mass": 2, "inertia": 0, "com": [0, 0], "points": { "B": [0, 0] }, "pose": { "position": [250, 0] } } },
  "joints": {
    "main": { "type": "revolute", "between": ["ground.O", "crank.O"] },
    "big": { "type": "revolute", "between": ["crank.A", "rod.A"] },
    "small": { "type": "revolute", "between": ["rod.B", "piston.B"] },
    "guide": { "type": "prismatic", "between": ["ground.O", "piston.B"], "axis": [1, 0] } },
  "drivers": { "motor": { "type": "rotation", "body": "crank", "motion": { "type": "constant_velocity", "velocity": "60 rpm" } } },
  "points": ["crank.A"],
  "analysis": { "type": "inverse_dynamics", "end": 1, "outputs": 61 } }"#;

/// The model with responses.
fn model(texts: &[&str]) -> Checked {
    let loaded = load(SLIDER_CRANK.as_bytes(), &[]).expect("a good model");
    let with = loaded.model.edit(|model| {
        for text in texts {
            model.responses.insert((*text).into(), Response::new(*text));
        }
    });
    with.expect("good responses")
}

/// The answers of a model.
fn answers(model: &Checked) -> Vec<Answer> {
    let prepared = Prepared::new(model).expect("runs");
    let responses = Responses::new(model, &prepared.columns()).expect("good responses");
    let outcome = prepared.run(&Control::default()).expect("runs");
    responses.answers(outcome.all(), &outcome.peaks, &outcome.report)
}

fn value(text: &str) -> (f64, String) {
    let answer = answers(&model(&[text])).remove(0);
    let value = answer.value;
    (
        value.unwrap_or_else(|| panic!("{text}: {:?}", answer.reason)),
        answer.unit,
    )
}

fn holds(text: &str, expected: f64, unit: &str, within: f64) {
    let (found, own) = value(text);
    assert!(
        (found - expected).abs() <= within,
        "{text}: {found}, not {expected}"
    );
    assert_eq!(own, unit, "{text}");
}

#[test]
fn positions_are_those_of_the_closed_form() {
    // rows stand at both dead centres
    holds("max(piston.x) - min(piston.x)", 2.0 * R, "m", 1e-12);
    holds("range(piston.x)", 2.0 * R, "m", 1e-12);
    holds(
        "at(piston.x, driver.motor = 90 deg)",
        (L * L - R * R).sqrt(),
        "m",
        1e-12,
    );
    holds(
        "at(piston.x, driver.motor.value = 90 deg)",
        (L * L - R * R).sqrt(),
        "m",
        1e-12,
    );
    holds("first(piston.x)", L + R, "m", 1e-12);
    holds("last(piston.x)", L + R, "m", 1e-12);
    holds("argmin(piston.x)", 0.5, "s", 1e-12);
    holds("argmax(piston.x)", 0.0, "s", 0.0);
    holds("max(abs(rod.angle))", (R / L).asin(), "rad", 1e-12);
    holds("sin(max(abs(rod.angle)))*200 mm", R, "m", 1e-12);
}

#[test]
fn values_between_rows_are_linear() {
    // between 84° and 90° the angle of the crank is linear in time
    holds("at(t, crank.angle = 87 deg)", 87.0 / 360.0, "s", 1e-12);
    let x = |degrees: f64| {
        let angle = degrees.to_radians();
        R * angle.cos() + (L * L - (R * angle.sin()).powi(2)).sqrt()
    };
    holds(
        "at(piston.x, driver.motor = 87 deg)",
        0.5 * (x(84.0) + x(90.0)),
        "m",
        1e-12,
    );
}

#[test]
fn integrals_over_a_turn_are_those_of_a_sine() {
    // the trapezium rule is exact for sines over whole turns, and 61 rows take more than their squares
    holds("integral(crank.A.y)", 0.0, "m*s", 1e-15);
    holds("rms(crank.A.y)", R / 2f64.sqrt(), "m", 1e-14);
    holds("mean(crank.A.y^2)", R * R / 2.0, "m^2", 1e-15);
    holds("mean(crank.omega)", TAU, "rad/s", 1e-10);
    holds("integral(crank.omega)", TAU, "rad", 1e-10);
    // half of h²/12·(y'(1/2) − y'(0)) with y' = ∓2πr is what the rule lacks of r/π over half a turn
    let half = "integral((crank.A.y + abs(crank.A.y))/2)";
    let lacking = R / PI * (1.0 - (PI / 60.0) / (PI / 60.0).tan());
    holds(half, R / PI - lacking, "m*s", 1e-14);
}
