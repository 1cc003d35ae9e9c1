//! Efforts and joint forces with everything off: against closed forms, runs of other models, and clearance links.

mod slopes;
mod worst;

use super::told::Told;
use super::{asked_in_vain, file};
use linkdyn_engine::analysis::{Control, run};
use linkdyn_variation::{Accuracy, PoseAccuracy};
use serde_json::{Value, json};

/// A slider-crank with a force on its slide; SI.
fn slider_crank(kind: &str) -> Value {
    json!({
        "format": "linkdyn/1", "units": "SI",
        "parameters": { "r": { "value": "0.05 m", "tolerance": "1e-4 m" }, "l": { "value": "0.2 m", "tolerance": "2e-4 m" },
            "push": { "value": "-100 N", "tolerance": "1 N" } },
        "bodies": {
            "ground": { "points": { "O": [0, 0] } },
            "crank": { "points": { "O": [0, 0], "A": ["=r", 0] }, "pose": { "angle": ANGLE } },
            "rod": { "points": { "A": [0, 0], "B": ["=l", 0] }, "pose": { "position": [0.025, 0.043], "angle": -0.2 } },
            "slide": { "points": { "B": [0, 0] }, "pose": { "position": [0.22, 0] } } },
        "joints": {
            "main": { "type": "revolute", "between": ["ground.O", "crank.O"] },
            "big": { "type": "revolute", "between": ["crank.A", "rod.A"] },
            "small": { "type": "revolute", "between": ["rod.B", "slide.B"] },
            "guide": { "type": "prismatic", "between": ["ground.O", "slide.B"], "axis": [1, 0] } },
        "forces": { "push": { "type": "force", "at": "slide.B", "vector": ["=push", 0] } },
        "drivers": { "motor": { "type": "rotation", "body": "crank", "tolerance": 1e-3,
            "motion": { "type": "constant_velocity", "start": ANGLE, "velocity": 1 } } },
        "analysis": { "type": kind },
        "accuracy": { "outputs": { "effort": { "column": "driver.motor.effort" }, "side": { "column": "joint.guide.fy" } } }
    })
}

const ANGLE: f64 = 1.1;

fn told(json: &Value) -> Told {
    Told::read(json).unwrap_or_else(|said| panic!("{said}"))
}

/// The effort against a force on the slide: −F dx/dθ.
fn effort(force: f64, r: f64, l: f64, angle: f64) -> f64 {
    let (sin, cos) = angle.sin_cos();
    let s = (l * l - (r * sin).powi(2)).sqrt();
    force * (r * sin + r * r * sin * cos / s)
}

#[track_caller]
fn near(said: f64, exact: f64, allowed: f64) {
    assert!(
        (said - exact).abs() <= allowed * exact.abs(),
        "{said} instead of {exact}"
    );
}

fn sensitivity(found: &Accuracy, pose: &PoseAccuracy, source: &str) -> f64 {
    let place = found.sources.iter().position(|own| own == source);
    pose.contributions[place.expect("a source")].sensitivity
}

#[test]
fn effort_of_a_slider_crank_has_closed_derivatives() {
    let told = told(&slider_crank("statics"));
    let found = told.answer();
    let pose = &found.outputs[0].poses[0];
    let (force, r, l) = (-100.0, 0.05, 0.2);
    let (sin, cos) = ANGLE.sin_cos();
    let s = (l * l - r * r * sin * sin).sqrt();
    near(pose.nominal, effort(force, r, l, ANGLE), 1e-13);
    // of T = F (r sin + r² sin cos/s), s² = l² − r² sin²
    let by_r = force * (sin + 2.0 * r * sin * cos / s + r.powi(3) * sin.powi(3) * cos / s.powi(3));
    let by_l = -force * r * r * sin * cos * l / s.powi(3);
    let by_angle = force
        * (r * cos
            + r * r * (cos * cos - sin * sin) / s
            + r.powi(4) * (sin * cos).powi(2) / s.powi(3));
    for (source, exact) in [
        ("parameters.r", by_r),
        ("parameters.l", by_l),
        ("parameters.push", effort(1.0, r, l, ANGLE)),
        ("drivers.motor", by_angle),
    ] {
        let said = sensitivity(&found, pose, source);
        assert!(
            (said - exact).abs() <= 1e-11 * exact.abs(),
            "{source}: {said} instead of {exact}"
        );
    }
    // The corner that is farthest: a stronger push, a longer crank, a shorter rod, a crank that stands higher.
    let high = effort(force - 1.0, r + 1e-4, l - 2e-4, ANGLE + 1e-3);
    let low = effort(force + 1.0, r - 1e-4, l + 2e-4, ANGLE - 1e-3);
    near(pose.found[0].expect("a worst"), high - pose.nominal, 1e-11);
    near(pose.found[1].expect("a worst"), low - pose.nominal, 1e-11);
    assert_eq!((pose.certified, found.outputs[0].unit), (None, "N*m"));
    // Each source scatters by a third of its tolerance, the driver too.
    let by = [
        by_r * 1e-4,
        by_l * 2e-4,
        effort(1.0, r, l, ANGLE),
        by_angle * 1e-3,
    ];
    let square: f64 = by.iter().map(|by| (by / 3.0).powi(2)).sum();
    let [mean, sigma] = pose.moments.expect("moments");
    near(sigma, square.sqrt(), 1e-10);
    assert!(mean.abs() < 1e-12 * sigma, "{mean:e}");
    assert_eq!(found.outputs[1].unit, "N");
}

#[test]
fn a_pressed_rod_is_shorter_by_the_clearances_of_its_loop() {
    // The rod is pressed: the journals of all three pins are where the chain is shortest, along the rod, and the crank's
    // effort is that of a rod shorter by all three clearances (and longer, where the slide is pulled).
    for (force, side) in [(-100.0, -1.0), (100.0, 1.0)] {
        let mut json = slider_crank("statics");
        json["parameters"] = json!({ "r": "0.05 m", "l": "0.2 m", "push": format!("{force} N") });
        json["drivers"]["motor"]
            .as_object_mut()
            .expect("an object")
            .remove("tolerance");
        let c = 2e-5;
        for joint in ["main", "big", "small"] {
            json["joints"][joint]["clearance"] = json!({ "model": "ideal", "radius": c });
        }
        let found = told(&json).answer();
        let pose = &found.outputs[0].poses[0];
        let exact = effort(force, 0.05, 0.2 + side * 3.0 * c, ANGLE) - pose.nominal;
        for found in pose.found {
            near(found.expect("a worst"), exact, 1e-10);
        }
        // Every pin contributes the same.
        let pins =
            ["main", "big", "small"].map(|pin| sensitivity(&found, pose, &format!("joints.{pin}")));
        let (r, l, s) = (0.05, 0.2, (0.04 - (0.05 * ANGLE.sin()).powi(2)).sqrt());
        let by_rod = -force * r * r * ANGLE.sin() * ANGLE.cos() * l / s.powi(3);
        pins.iter().for_each(|&g| near(g, side * by_rod, 1e-10));
        // From least to greatest clearance: a mean, and a spread of that width.
        json["joints"]["big"]["clearance"]["radius"] = json!([0.0, 2.0 * c]);
        let found = told(&json).answer();
        let pose = &found.outputs[0].poses[0];
        let [mean, sigma] = pose.moments.expect("moments");
        near(mean, side * by_rod * 3.0 * c, 1e-10);
        near(sigma, by_rod.abs() * 2.0 * c / 12.0_f64.sqrt(), 1e-10);
        let ends =
            [2.0, 4.0].map(|pins| effort(force, 0.05, 0.2 + side * pins * c, ANGLE) - pose.nominal);
        let [low, high] = pose.found.map(|by| by.expect("a worst"));
        near(low, ends[0].min(ends[1]), 1e-10);
        near(high, ends[0].max(ends[1]), 1e-10);
    }
}

/// A clearance of at least c/2: neither its mean, nor its width, nor its near end is that of one from zero on.
#[test]
fn a_clearance_between_two_carries_from_the_least_to_the_greatest() {
    let (r, l, c) = (0.05, 0.2, 2e-5);
    let s = (l * l - (r * ANGLE.sin()).powi(2)).sqrt();
    for (force, side) in [(-100.0, -1.0), (100.0, 1.0)] {
        let mut json = slider_crank("statics");
        json["parameters"] = json!({ "r": "0.05 m", "l": "0.2 m", "push": format!("{force} N") });
        json["drivers"]["motor"]
            .as_object_mut()
            .expect("an object")
            .remove("tolerance");
        json["joints"]["big"]["clearance"] =
            json!({ "model": "ideal", "radius": [0.5 * c, 2.0 * c] });
        let found = told(&json).answer();
        let pose = &found.outputs[0].poses[0];
        let by_rod = -force * r * r * ANGLE.sin() * ANGLE.cos() * l / s.powi(3);
        let [mean, sigma] = pose.moments.expect("moments");
        near(mean, side * by_rod * 1.25 * c, 1e-10);
        near(sigma, by_rod.abs() * 1.5 * c / 12.0_f64.sqrt(), 1e-10);
        let sorted = |[a, b]: [f64; 2]| [f64::min(a, b), f64::max(a, b)];
        let first = sorted([0.5, 2.0].map(|pins| side * by_rod * pins * c));
        let worst =
            sorted([0.5, 2.0].map(|pins| {
                effort(force, r, l + side * pins * c, ANGLE) - effort(force, r, l, ANGLE)
            }));
        let reached = pose.first.expect("first");
        let place = found.sources.iter().position(|own| own == "joints.big");
        let contribution = &pose.contributions[place.expect("a source")];
        for end in 0..2 {
            near(reached[end], first[end], 1e-10);
            near(contribution.reach[end], first[end], 1e-10);
            near(pose.found[end].expect("a worst"), worst[end], 1e-8);
        }
        near(contribution.variance, sigma * sigma, 1e-12);
    }
}

/// A four-bar under its weight and a spring, in motion, with sources of all kinds.
fn sprung() -> Value {
    json!({
        "format": "linkdyn/1", "units": "SI", "gravity": [0, -9.81],
        "parameters": {
            "crank": { "value": "0.1 m", "tolerance": "1e-4 m" }, "coupler": { "value": "0.25 m", "tolerance": ["-2e-4 m", "1e-4 m"] },
            "weight": { "value": "2 kg", "tolerance": "2 %" }, "rate": { "value": "400 N/m", "tolerance": "5 %" },
            "speed": { "value": "4 rad/s", "tolerance": "1 %" } },
        "bodies": {
            "ground": { "points": { "O": [0, 0], "Q": { "position": [0.3, 0], "tolerance": 4e-4 }, "S": [0.35, 0.3] } },
            "crank": { "mass": 1, "inertia": 1e-3, "com": [0.05, 0], "points": { "O": [0, 0], "A": ["=crank", 0] }, "pose": { "angle": 1 } },
            "coupler": { "mass": "=weight", "inertia": 5e-3, "com": [0.12, 0.02], "points": { "A": [0, 0], "B": ["=coupler", 0] },
                "pose": { "position": [0.05, 0.086], "angle": 0.35 } },
            "rocker": { "mass": 1, "inertia": 2e-3, "com": [0.1, 0], "points": { "Q": [0, 0], "B": [0.2, 0] },
                "pose": { "position": [0.3, 0], "angle": 1.75 } } },
        "joints": {
            "a": { "type": "revolute", "between": ["ground.O", "crank.O"] },
            "b": { "type": "revolute", "between": ["crank.A", "coupler.A"] },
            "c": { "type": "revolute", "between": ["coupler.B", "rocker.B"] },
            "d": { "type": "revolute", "between": ["ground.Q", "rocker.Q"] } },
        "forces": { "coil": { "type": "spring", "between": ["ground.S", "rocker.B"], "stiffness": "=rate", "free_length": 0.05 } },
        "drivers": { "motor": { "type": "rotation", "body": "crank",
            "motion": { "type": "constant_velocity", "start": 1, "velocity": "=speed" } } },
        "analysis": { "type": "inverse_dynamics", "end": 1, "outputs": 6 },
        "accuracy": { "outputs": { "effort": { "column": "driver.motor.effort" }, "pin": { "column": "joint.c.fy" },
            "at": { "column": "driver.motor.effort", "at": { "value": 2.5 }, "limits": [-1, 1] } } }
    })
}

#[test]
fn a_pose_at_a_value_of_the_driver_keeps_the_value_whatever_its_motion() {
    let found = told(&sprung()).answer();
    let pose = &found.outputs[2].poses[0];
    // The speed changes forces at the value, though not the value: against runs that are sampled there.
    let run_at = |speed: f64| {
        let mut json = sprung();
        json["parameters"]["speed"] = json!(format!("{speed:e} rad/s"));
        json["analysis"] = json!({ "type": "inverse_dynamics", "sample": { "driver": "motor", "from": 2.5, "to": 2.6, "step": 0.1 } });
        let told = told(&json);
        let run = run(&told.loaded.model, &Control::default()).expect("a run");
        run.trajectory
            .values("driver.motor.effort")
            .expect("a column")[0]
    };
    // Inertia forces go with the square of the speed, so that this difference is exact.
    let expected = (run_at(4.5) - run_at(3.5)) / 1.0;
    near(
        sensitivity(&found, pose, "parameters.speed"),
        expected,
        1e-9,
    );
    near(pose.nominal, run_at(4.0), 1e-11);
    assert!(pose.capability.is_some_and(|own| own.within > 0.5));
}

#[test]
fn guides_and_slots_stand_on_the_side_of_their_force() {
    // A slot's play c lifts the driven point by c against its force: the effort is that of a slot moved so.
    let mut json = slider_crank("statics");
    json["joints"]["guide"]["play"] = json!(1e-4);
    let moved = |y: f64| {
        let mut json = slider_crank("statics");
        json["bodies"]["ground"]["points"]["O2"] = json!([0, y]);
        json["joints"]["guide"]["between"][0] = json!("ground.O2");
        told(&json).answer().outputs[0].poses[0].nominal
    };
    let found = told(&json).answer();
    let pose = &found.outputs[0].poses[0];
    let side = found.outputs[1].poses[0].nominal.signum();
    let place = found
        .sources
        .iter()
        .position(|own| own == "joints.guide")
        .expect("a source");
    let exact = moved(-side * 1e-4) - moved(0.0);
    let reach = pose.contributions[place].reach;
    assert_eq!(reach[0], reach[1]);
    near(reach[0], exact, 5e-3);
    near(
        pose.contributions[place].sensitivity,
        (moved(-side * 1e-6) - moved(side * 1e-6)) / 2e-6,
        1e-7,
    );
}

#[test]
fn what_has_no_derivative_is_named() {
    let refused = [
        (
            json!({ "joints": { "b": { "clearance": { "model": "contact", "radius": 1e-4, "bearing_radius": 0.01,
            "normal": { "law": "hertz", "stiffness": 1e9 } } } } }),
            "joints.b.clearance.model: \"contact\": a journal that moves freely in its bearing has impacts: forces with it have no derivative",
        ),
        (
            json!({ "bodies": { "crank": { "mass": null } } }),
            "bodies.crank: inverse dynamics needs the mass of body \"crank\"",
        ),
        (
            json!({ "accuracy": { "outputs": { "at": { "column": "joint.c.torque" } } } }),
            "accuracy.outputs.at.column: \"joint.c.torque\": the results have no such column of a position, an effort or a joint force (there are joint.c.fx, joint.c.fy)",
        ),
        (
            json!({ "parameters": { "idle": { "value": "1 kg", "tolerance": "1 g" } } }),
            "parameters.idle.tolerance: \"1 g\": no dimension, mass, spring, load or law of the mechanism follows from this parameter",
        ),
    ];
    for (number, (change, says)) in refused.into_iter().enumerate() {
        let mut json = sprung();
        merge(&mut json, &change);
        let (status, said) = asked_in_vain(900 + number, &json.to_string(), &[]);
        assert!(
            status == 2 && said.contains(says),
            "{status} {said}\nnot: {says}"
        );
    }
    // At its change point the lock has no effort that deviations leave finite.
    let mut json: Value = serde_json::from_str(
        &std::fs::read_to_string(file("models/watt-i-lock.json")).expect("a file"),
    )
    .expect("JSON");
    json["accuracy"]["outputs"] = json!({ "closing": { "column": "driver.motor.effort", "at": { "value": "117.512206516644 deg" } } });
    let found = told(&json).answer();
    let pose = &found.outputs[0].poses[0];
    let missing = pose.missing.as_deref().expect("a reason");
    assert!(
        missing.starts_with("does not exist: in a singular position (") && pose.first.is_none(),
        "{missing}"
    );
    assert!(pose.found.iter().all(Option::is_none) && pose.contributions.is_empty());
}

/// Changes a model; null takes out.
fn merge(json: &mut Value, change: &Value) {
    match change {
        Value::Object(all) if json.is_object() => {
            let own = json.as_object_mut().expect("an object");
            for (key, change) in all {
                if change.is_null() {
                    own.remove(key);
                } else {
                    merge(own.entry(key.clone()).or_insert(Value::Null), change);
                }
            }
        }
        other => *json = other.clone(),
    }
}
