//! Measures against closed forms, in columns, formulas, ratios, responses and variants.

use crate::mechanisms::*;
use linkdyn_engine::analysis::{Control, Family};
use linkdyn_model::{Given, load};
use serde_json::{Value, json};

/// A crank of 0.1 m on the ground's origin that turns, a rod to a slider on the x axis, and a jaw that is drawn turned by π/2.
fn jaws() -> Value {
    let bodies = json!({
        "ground": { "points": { "O": [0, 0], "W": [0, 0.5], "E": [1, 0.5] } },
        "crank": { "points": { "O": [0, 0], "A": [0.1, 0], "B": [0, 0.05] } },
        "slider": { "points": { "C": [0, 0], "T": [0, 0.2] }, "pose": { "position": [0.4, 0] } },
        "rod": { "points": { "A": [0, 0], "C": [0.3, 0] }, "pose": { "position": [0.1, 0] } } });
    let joints = json!({
        "main": pin("ground.O", "crank.O"),
        "pin": pin("crank.A", "rod.A"),
        "wrist": pin("rod.C", "slider.C"),
        "guide": { "type": "prismatic", "between": ["ground.O", "slider.C"], "axis": [1, 0] } });
    let mut model = model(
        bodies,
        joints,
        json!({ "motor": { "type": "rotation", "body": "crank",
            "motion": { "type": "constant_velocity", "start": 0.0, "velocity": 3.0 } } }),
    );
    model["measures"] = json!({
        "grip": { "distance": ["crank.B", "slider.T"] },
        "tilt": { "angle": ["ground.W", "ground.E", "crank.O", "crank.B"] },
        "knee": { "angle": ["crank.A", "crank.O", "rod.A", "rod.C"] },
        "gap": { "distance_to_line": ["slider.T", "crank.O", "crank.A"] } });
    model["analysis"] = json!({ "type": "kinematics", "end": 2.0, "outputs": 41 });
    model
}

#[test]
fn measures_are_what_they_say() {
    let run = completed(&jaws());
    let angles = column(&run, "crank.angle");
    let of = |name: &str| column(&run, &format!("measure.{name}"));
    let [grip, tilt, knee, gap] = ["grip", "tilt", "knee", "gap"].map(of);
    let [grip_rate, tilt_rate, knee_rate, gap_rate] =
        ["grip.rate", "tilt.rate", "knee.rate", "gap.rate"].map(of);
    for (row, theta) in angles.iter().enumerate() {
        let (sin, cos) = theta.sin_cos();
        let rod = (0.09 - 0.01 * sin * sin).sqrt();
        let place = 0.1 * cos + rod;
        let speed = 3.0 * (-0.1 * sin - 0.01 * sin * cos / rod);
        // B is at 0.05 (−sin, cos), T at (place, 0.2)
        let apart = [place + 0.05 * sin, 0.2 - 0.05 * cos];
        let rate = [speed + 0.15 * cos, 0.15 * sin];
        let length = apart[0].hypot(apart[1]);
        close(grip[row], length, 1e-14);
        close(
            grip_rate[row],
            (apart[0] * rate[0] + apart[1] * rate[1]) / length,
            1e-13,
        );
        // angles go on beyond half a turn
        close(tilt[row], theta + std::f64::consts::FRAC_PI_2, 1e-13);
        close(tilt_rate[row], 3.0, 1e-13);
        let lean = -(0.1 * sin / 0.3).asin();
        close(
            knee[row].rem_euclid(std::f64::consts::TAU),
            (lean - theta - std::f64::consts::PI).rem_euclid(std::f64::consts::TAU),
            1e-13,
        );
        close(knee_rate[row], -0.3 * cos / rod - 3.0, 1e-12);
        close(gap[row], 0.2 * cos - place * sin, 1e-14);
        close(
            gap_rate[row],
            -0.6 * sin - speed * sin - 3.0 * place * cos,
            1e-13,
        );
    }
    assert!(knee[0].abs() <= std::f64::consts::PI + 1e-15, "{}", knee[0]);
}

/// A spring by a formula of a measure does what a spring does.
#[test]
fn forces_and_ratios_may_name_measures() {
    let mut model = jaws();
    for body in ["crank", "rod", "slider"] {
        model["bodies"][body]["mass"] = 0.5.into();
        model["bodies"][body]["inertia"] = 0.001.into();
        model["bodies"][body]["com"] = json!([0.01, 0.0]);
    }
    model["analysis"]["type"] = "inverse_dynamics".into();
    model["measures"]["way"] = json!({ "distance": ["ground.W", "slider.T"] });
    let mut sprung = model.clone();
    sprung["forces"] = json!({ "coil": { "type": "spring", "between": ["ground.W", "slider.T"],
        "stiffness": 400.0, "free_length": 0.1, "damping": 20.0 } });
    sprung["outputs"] = json!({ "leverage": "d(measure.way)/d(driver.motor)" });
    let mut by_formula = model;
    by_formula["forces"] = json!({ "coil": { "type": "actuator", "between": ["ground.W", "slider.T"],
        "force": "=-400 N/m*(measure.way - 0.1 m) - 20 N*s/m*measure.way.rate" } });
    let [sprung, by_formula] = [&sprung, &by_formula].map(completed);
    let efforts = [&sprung, &by_formula].map(|run| column(run, "driver.motor.effort"));
    for (one, other) in efforts[0].iter().zip(&efforts[1]) {
        close(*one, *other, 1e-11);
    }
    let ratios = column(&sprung, "output.leverage");
    for (ratio, rate) in ratios.iter().zip(column(&sprung, "measure.way.rate")) {
        close(*ratio, rate / 3.0, 1e-13);
    }
}

/// Variants have the measures of their own points.
#[test]
fn variants_measure_themselves() {
    let mut model = jaws();
    model["parameters"] = json!({ "height": "0.2 m", "arm": "0.1 m" });
    model["bodies"]["slider"]["points"]["T"] = json!([0, "=height"]);
    model["bodies"]["crank"]["points"]["A"] = json!(["=arm", 0]);
    model["responses"] = json!({ "least": "min(measure.gap)", "turn": "max(measure.tilt)", "far": "last(measure.grip)" });
    let text = model.to_string();
    let loaded = load(text.as_bytes(), &[]).expect("a model");
    let family = Family::new(&loaded, &["height", "arm"], Given::Values).expect("a family");
    let mut member = family.begin();
    for values in [[0.2, 0.1], [0.25, 0.1], [0.21, 0.12]] {
        let mut found = [0.0; 3];
        member
            .run(&values, &Control::default(), &mut found)
            .expect("a model");
        let mut own = model.clone();
        own["parameters"] =
            json!({ "height": format!("{} m", values[0]), "arm": format!("{} m", values[1]) });
        let alone = completed(&own);
        for (found, answer) in found.iter().zip(&alone.responses) {
            close(*found, answer.value.expect("a value"), 1e-12);
        }
    }
}

#[test]
fn measures_that_are_none_are_refused() {
    for (measure, said) in [
        (json!({}), "a measure is a \"distance\" of two points"),
        (
            json!({ "distance": ["crank.A", "crank.B"] }),
            "both are of \"crank\"",
        ),
        (json!({ "distance": ["crank.A", "slider.X"] }), "slider"),
        (json!({ "distance": ["crank.A"] }), "measures.m.distance"),
        (
            json!({ "angle": ["crank.A", "rod.A", "slider.C", "slider.T"] }),
            "crank.A and rod.A are of two bodies",
        ),
        (
            json!({ "angle": ["crank.O", "crank.A", "slider.C"] }),
            "measures.m.angle",
        ),
        (
            json!({ "angle": ["crank.O", "crank.A", "slider.C", "slider.T", "slider.C"] }),
            "an angle has 4 points, and here are 5",
        ),
        (
            json!({ "distance_to_line": ["crank.A", "crank.O", "crank.B"] }),
            "both are of \"crank\"",
        ),
        (
            json!({ "distance_to_line": ["slider.T", "crank.O", "crank.O"] }),
            "are at one place",
        ),
        (
            json!({ "angle": ["crank.O", "crank.A", "slider.C", "slider.T"], "distance": ["crank.A", "slider.T"] }),
            "measures.m",
        ),
    ] {
        let mut model = jaws();
        model["measures"] = json!({ "m": measure });
        let complaints = load(model.to_string().as_bytes(), &[])
            .map(|_| ())
            .expect_err(said);
        let text = format!("{complaints:?}").replace("\\\"", "\"");
        assert!(text.contains(said), "{said}: {text}");
    }
}

#[test]
fn names_of_measures_are_those_of_their_columns() {
    for (name, said) in [
        (
            "angle",
            "measure.angle would be a column of a body called \"measure\"",
        ),
        ("a.b", "measures"),
        ("", "measures"),
    ] {
        let mut model = jaws();
        model["measures"] = json!({ name: { "distance": ["crank.B", "slider.T"] } });
        let found = load(model.to_string().as_bytes(), &[]).map(|_| ());
        let text = format!("{:?}", found.expect_err(said)).replace("\\\"", "\"");
        assert!(text.contains(said), "{name}: {text}");
    }
}
