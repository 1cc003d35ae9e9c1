//! Small mechanisms for the tests, written as model files.

use linkdyn_engine::analysis::{Control, Outcome, run};
use linkdyn_model::{Loaded, load};
use linkdyn_output::Status;
use serde_json::{Value, json};

/// A uniform rod from A to B with a guessed pose.
pub fn rod(length: f64, position: [f64; 2], angle: f64) -> Value {
    json!({ "mass": 1.0, "inertia": length * length / 12.0, "com": [0.5 * length, 0.0],
            "points": { "A": [0.0, 0.0], "B": [length, 0.0] }, "pose": { "position": position, "angle": angle } })
}

pub fn pin(first: &str, second: &str) -> Value {
    json!({ "type": "revolute", "between": [first, second] })
}

/// `cells` parallelograms in a row (cranks 0.1 m, couplers 0.3 m) driven at c0; with `third` a third crank in the first.
pub fn parallelogram(cells: usize, third: bool, start: f64, motion: &Value) -> Value {
    let (r, l) = (0.1, 0.3);
    let tip = [r * start.cos(), r * start.sin()];
    let mut points = json!({});
    let (mut bodies, mut joints) = (json!({}), json!({}));
    for k in 0..=cells {
        let x = l * k as f64;
        points[format!("O{k}")] = json!([x, 0.0]);
        bodies[format!("c{k}")] = rod(r, [x, 0.0], start);
        joints[format!("o{k}")] = pin(&format!("ground.O{k}"), &format!("c{k}.A"));
    }
    for k in 0..cells {
        bodies[format!("h{k}")] = rod(l, [l * k as f64 + tip[0], tip[1]], 0.0);
        joints[format!("p{k}")] = pin(&format!("c{k}.B"), &format!("h{k}.A"));
        joints[format!("q{k}")] = pin(&format!("h{k}.B"), &format!("c{}.B", k + 1));
    }
    if third {
        points["M"] = json!([0.5 * l, 0.0]);
        bodies["h0"]["points"]["M"] = json!([0.5 * l, 0.0]);
        bodies["cm"] = rod(r, [0.5 * l, 0.0], start);
        joints["om"] = pin("ground.M", "cm.A");
        joints["pm"] = pin("h0.M", "cm.B");
    }
    bodies["ground"] = json!({ "points": points });
    model(
        bodies,
        joints,
        json!({ "motor": { "type": "rotation", "body": "c0", "motion": motion } }),
    )
}

/// Slider-crank on the x axis, crank `r`, rod `l`, drawn at crank angle `start`; driven at the crank or, with
/// `by_slider`, at the slider.
pub fn slider_crank(r: f64, l: f64, start: f64, by_slider: bool, motion: &Value) -> Value {
    let x = slider_position(r, l, start);
    let bodies = json!({
        "ground": { "points": { "O": [0.0, 0.0] } },
        "crank": rod(r, [0.0, 0.0], start),
        "rod": rod(l, [r * start.cos(), r * start.sin()], (-r * start.sin()).atan2(x - r * start.cos())),
        "slider": { "mass": 1.0, "inertia": 0.01, "com": [0.0, 0.0], "points": { "B": [0.0, 0.0] },
                    "pose": { "position": [x, 0.0] } },
    });
    let joints = json!({
        "o": pin("ground.O", "crank.A"), "a": pin("crank.B", "rod.A"), "b": pin("rod.B", "slider.B"),
        "g": { "type": "prismatic", "between": ["ground.O", "slider.B"], "axis": [1.0, 0.0] },
    });
    let driver = if by_slider {
        json!({ "type": "translation", "joint": "g", "motion": motion })
    } else {
        json!({ "type": "rotation", "body": "crank", "motion": motion })
    };
    model(bodies, joints, json!({ "motor": driver }))
}

/// Slider position of a slider-crank by closed form.
pub fn slider_position(r: f64, l: f64, angle: f64) -> f64 {
    r * angle.cos() + (l * l - (r * angle.sin()).powi(2)).sqrt()
}

/// An inverse-dynamics model of these parts.
pub fn model(bodies: Value, joints: Value, drivers: Value) -> Value {
    json!({ "format": "linkdyn/1", "units": "SI", "gravity": [0.0, -9.81], "bodies": bodies, "joints": joints,
            "drivers": drivers, "analysis": { "type": "inverse_dynamics", "end": 1.0, "outputs": 101 } })
}

/// Fails, and says by how much, where a number is not near the one that is known.
#[track_caller]
pub fn close(ours: f64, known: f64, tolerance: f64) {
    let off = (ours - known).abs();
    assert!(
        off <= tolerance,
        "{ours} instead of {known}, off by {off:e}"
    );
}

pub fn loaded(model: &Value) -> Loaded {
    load(model.to_string().as_bytes(), &[]).unwrap_or_else(|complaints| panic!("{complaints:?}"))
}

/// Runs a model that must be good input.
pub fn outcome(model: &Value) -> Outcome {
    run(&loaded(model).model, &Control::default())
        .unwrap_or_else(|complaints| panic!("{complaints:?}"))
}

/// A result column.
pub fn column(outcome: &Outcome, name: &str) -> Vec<f64> {
    outcome
        .trajectory
        .values(name)
        .unwrap_or_else(|| panic!("no column {name}"))
}

/// Runs a model that has to come to its end.
#[track_caller]
pub fn completed(model: &Value) -> Outcome {
    let run = outcome(model);
    let message = &run.report.message;
    assert_eq!(run.report.status, Status::Completed, "{message:?}");
    run
}

#[track_caller]
pub fn near(found: f64, expected: f64, tolerance: f64) {
    let off = (found - expected).abs();
    assert!(
        off <= tolerance,
        "{found} for {expected}: {off:e} > {tolerance:e}"
    );
}

/// Linear and angular momentum, about the origin, of bodies in a row of the results: name, mass, inertia and centre of mass of each.
pub fn momenta(run: &Outcome, row: usize, bodies: &[(&str, f64, f64, [f64; 2])]) -> [f64; 3] {
    let mut sums = [0.0; 3];
    for &(body, mass, inertia, [u, v]) in bodies {
        let at = |quantity: &str| column(run, &format!("{body}.{quantity}"))[row];
        let ((sin, cos), omega) = (at("angle").sin_cos(), at("omega"));
        let arm = [cos * u - sin * v, sin * u + cos * v];
        let place = [at("x") + arm[0], at("y") + arm[1]];
        let speed = [at("vx") - omega * arm[1], at("vy") + omega * arm[0]];
        sums[0] += mass * speed[0];
        sums[1] += mass * speed[1];
        sums[2] += mass * (place[0] * speed[1] - place[1] * speed[0]) + inertia * omega;
    }
    sums
}
