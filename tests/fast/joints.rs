//! Slots and gears against closed forms.

use crate::mechanisms::*;
use linkdyn_model::bundled;
use linkdyn_output::Status;
use serde_json::{Value, json};
use std::f64::consts::PI;

/// A few ulps of sizes around 1, through a solution of some ten equations.
const ROUND_OFF: f64 = 1e-13;
/// The same for forces of some 10 N.
const FORCE: f64 = 1e-11;

fn from_bundle(name: &str) -> Value {
    serde_json::from_str(bundled::find(name).expect("a bundled model").text).expect("JSON")
}

/// A wheel about its centre of mass, with a few named points.
fn wheel(position: [f64; 2], angle: f64) -> Value {
    json!({ "mass": 2.0, "inertia": 0.03, "com": [0.0, 0.0], "points": { "C": [0.0, 0.0] },
            "pose": { "position": position, "angle": angle } })
}

fn gear(first: &str, second: &str, ratio: f64) -> Value {
    json!({ "type": "gear", "between": [first, second], "ratio": ratio })
}

fn turn(body: &str, coefficients: &[f64]) -> Value {
    json!({ "type": "rotation", "body": body, "motion": { "type": "polynomial", "coefficients": coefficients } })
}

/// x = r cos θ; the slot carries the yoke's inertia alone, the guide its weight.
#[test]
fn the_yoke_moves_as_a_cosine_and_loads_the_pin_with_its_inertia() {
    let (r, speed, g) = (0.06, 4.0 * PI, 9.81);
    let run = outcome(&from_bundle("scotch-yoke"));
    assert_eq!(run.report.status, Status::Completed);
    assert_eq!(
        (run.report.mobility.grubler, run.report.mobility.rank),
        (1, 1)
    );
    assert!(run.trajectory.values("joint.pin.torque").is_none());
    let [x, ax, fx, fy] =
        ["yoke.x", "yoke.ax", "joint.pin.fx", "joint.pin.fy"].map(|name| column(&run, name));
    let [effort, up, torque] = [
        "driver.motor.effort",
        "joint.guide.fy",
        "joint.guide.torque",
    ]
    .map(|name| column(&run, name));
    for (k, theta) in column(&run, "crank.angle").into_iter().enumerate() {
        close(x[k], r * theta.cos(), ROUND_OFF);
        let acceleration = -r * speed * speed * theta.cos();
        close(ax[k], acceleration, FORCE);
        // Of the yoke on the crank pin.
        let pin = -1.2 * acceleration;
        close(fx[k], pin, FORCE);
        close(fy[k], 0.0, FORCE);
        close(
            effort[k],
            0.6 * g * 0.02 * theta.cos() + r * theta.sin() * pin,
            FORCE,
        );
        // The pin pushes the yoke at the height r sin θ; the weight hangs 80 mm before the slot.
        close(up[k], 1.2 * g, FORCE);
        close(torque[k], 1.2 * g * 0.08 - r * theta.sin() * pin, FORCE);
    }
}

#[test]
fn the_slide_of_a_slot_can_be_driven() {
    let mut model = from_bundle("scotch-yoke");
    model["drivers"]["motor"] = json!({ "type": "translation", "joint": "pin",
        "motion": { "type": "harmonic", "amplitude": 42.0, "frequency": 2.0 } });
    model["bodies"]["crank"]["pose"]["angle"] = json!(5.0);
    let run = outcome(&model);
    assert_eq!(run.report.status, Status::Completed);
    let (time, theta) = (column(&run, "time"), column(&run, "crank.angle"));
    let (effort, slide) = (
        column(&run, "driver.motor.effort"),
        column(&run, "driver.motor.value"),
    );
    for k in 0..time.len() {
        close(
            theta[k],
            (0.7 * (4.0 * PI * time[k]).sin()).asin(),
            ROUND_OFF,
        );
        close(slide[k], 0.06 * theta[k].sin(), ROUND_OFF);
    }
    // The effort does the work that a motor at the crank would do.
    let power: Vec<f64> = column(&run, "crank.omega")
        .iter()
        .zip(&theta)
        .map(|(w, th)| 0.06 * th.cos() * w)
        .collect();
    let mut turned = from_bundle("scotch-yoke");
    turned["drivers"]["motor"]["motion"] = json!({ "type": "constant_acceleration", "start": format!("{} rad", theta[20]),
        "velocity": format!("{} rad/s", column(&run, "crank.omega")[20]),
        "acceleration": format!("{} rad/s^2", column(&run, "crank.alpha")[20]) });
    turned["analysis"]["outputs"] = json!(2);
    let again = outcome(&turned);
    let torque = column(&again, "driver.motor.effort")[0];
    close(
        effort[20] * power[20],
        torque * column(&run, "crank.omega")[20],
        1e-9,
    );
}

/// Two wheels on ground: the load on the second is felt at the first by the ratio, and each bearing carries the tooth force.
#[test]
fn a_gear_pair_passes_torque_by_its_ratio_and_its_tooth_force_to_the_bearings() {
    let (ratio, alpha, load) = (-0.4, 3.0, 0.7);
    let at = [0.3, 0.4];
    let bodies = json!({ "ground": { "points": { "A": [0.0, 0.0], "B": at } },
        "one": wheel([0.0, 0.0], 0.2), "two": wheel(at, -0.5) });
    let joints = json!({ "a": pin("ground.A", "one.C"), "b": pin("ground.B", "two.C"),
        "mesh": gear("one.C", "two.C", ratio) });
    let mut pair = model(
        bodies,
        joints,
        json!({ "motor": turn("one", &[0.2, 1.0, 0.5 * alpha]) }),
    );
    pair["gravity"] = json!([0.0, 0.0]);
    pair["forces"] = json!({ "load": { "type": "torque", "body": "two", "value": -load } });
    pair["analysis"]["end"] = json!(5.0);
    let run = outcome(&pair);
    assert_eq!(
        (run.report.mobility.grubler, run.report.mobility.rank),
        (1, 1)
    );
    let torque = 0.03 * ratio * alpha + load;
    // Radii 0.5/(1 + 5/2) · (1, 5/2): pitch point a little before the first wheel's rim, centre line (0.6, 0.8).
    let radius = 0.5 / (1.0 - ratio);
    let tooth = [0.8 * torque / radius, -0.6 * torque / radius];
    let columns = [
        "mesh.fx",
        "mesh.fy",
        "mesh.torque",
        "a.fx",
        "a.fy",
        "b.fx",
        "b.fy",
    ];
    let columns = columns.map(|name| column(&run, &format!("joint.{name}")));
    let known = [
        tooth[0], tooth[1], torque, tooth[0], tooth[1], -tooth[0], -tooth[1],
    ];
    let (one, two) = (column(&run, "one.angle"), column(&run, "two.angle"));
    for k in 0..one.len() {
        close(two[k], -0.5 + ratio * (one[k] - 0.2), 1e-12);
        for (values, known) in columns.iter().zip(known) {
            close(values[k], known, FORCE);
        }
        close(
            column(&run, "driver.motor.effort")[k],
            0.03 * alpha + ratio * torque,
            FORCE,
        );
    }
}

/// Sun, planet and fixed ring; the arm is the carrier. Willis: ω_arm = ω_sun / (1 + z_ring/z_sun).
fn planetary() -> Value {
    let (sun, planet) = (0.12, 0.03);
    let bodies = json!({ "ground": { "points": { "O": [0.0, 0.0] } },
        "sun": wheel([0.0, 0.0], 0.3),
        "arm": { "mass": 0.5, "inertia": 0.01, "com": [0.0, 0.0], "points": { "O": [0.0, 0.0], "C": [0.0, sun + planet] },
                 "pose": { "angle": -1.0 } },
        "planet": wheel([0.1, 0.1], 0.0) });
    let joints = json!({ "sun": pin("ground.O", "sun.C"), "arm": pin("arm.O", "ground.O"), "planet": pin("arm.C", "planet.C"),
        "inner": gear("sun.C", "planet.C", -4.0), "outer": gear("ground.O", "planet.C", 6.0) });
    let mut train = model(
        bodies,
        joints,
        json!({ "motor": turn("sun", &[0.3, 60.0]) }),
    );
    train["gravity"] = json!([0.0, 0.0]);
    train["forces"] = json!({ "load": { "type": "torque", "body": "arm", "value": -1.5 } });
    train
}

#[test]
fn a_planetary_train_turns_by_willis_over_many_turns() {
    let mut named = planetary();
    for joint in ["inner", "outer"] {
        named["joints"][joint]["carrier"] = json!("arm");
    }
    for train in [planetary(), named] {
        let run = outcome(&train);
        assert_eq!(
            run.report.status,
            Status::Completed,
            "{:?}",
            run.report.message
        );
        assert_eq!(
            (run.report.mobility.grubler, run.report.mobility.rank),
            (1, 1)
        );
        let [sun, arm, planet] =
            ["sun.angle", "arm.angle", "planet.angle"].map(|name| column(&run, name));
        let (inner, outer) = (
            [
                column(&run, "joint.inner.fx"),
                column(&run, "joint.inner.fy"),
            ],
            column(&run, "joint.outer.torque"),
        );
        // Both teeth carry the same force F along the same tangent, the planet's pin 2 F.
        let force = 1.5 / (2.0 * 0.15);
        for k in 0..sun.len() {
            close(arm[k] + 1.0, (sun[k] - 0.3) / 2.5, 1e-11);
            // As drawn at −1 rad of the arm: θ_p − θ_c = −4 (θ_s − θ_c) + 1 + 4 · 1.3.
            close(planet[k] - arm[k], -4.0 * (sun[k] - arm[k]) + 6.2, 1e-11);
            // The tangent is the arm's −x.
            close(inner[0][k], force * -arm[k].cos(), FORCE);
            close(inner[1][k], force * -arm[k].sin(), FORCE);
            close(outer[k], force * 0.03, FORCE);
        }
        for effort in column(&run, "driver.motor.effort") {
            close(effort, 1.5 / 2.5, FORCE);
        }
    }
}

/// With equal wheels the mechanism is symmetric: P stays in the middle, at the height of an isosceles triangle.
#[test]
fn the_geared_five_bar_draws_a_straight_line() {
    let run = outcome(&from_bundle("geared-five-bar"));
    assert_eq!(run.report.status, Status::Completed);
    assert_eq!(
        (run.report.mobility.grubler, run.report.mobility.rank),
        (1, 1)
    );
    let [theta, x, y] =
        ["left.angle", "left_rod.P.x", "left_rod.P.y"].map(|name| column(&run, name));
    let [fx, fy, torque] =
        ["joint.mesh.fx", "joint.mesh.fy", "joint.mesh.torque"].map(|name| column(&run, name));
    for (k, angle) in theta.iter().enumerate() {
        close(x[k], 0.1, ROUND_OFF);
        let half = 0.1 - 0.06 * angle.cos();
        close(
            y[k],
            0.06 * angle.sin() + (0.18 * 0.18 - half * half).sqrt(),
            ROUND_OFF,
        );
        // The right wheel takes the vertical tooth force at its radius, half the centre distance.
        close(fx[k], 0.0, FORCE);
        close(torque[k], -0.1 * fy[k], FORCE);
    }
}

#[test]
fn a_gear_meshes_as_drawn_or_as_told_from_any_guess() {
    let drawn = outcome(&from_bundle("geared-five-bar"));
    let mut told = from_bundle("geared-five-bar");
    told["joints"]["mesh"]["angle"] = json!("180 deg");
    for body in ["left", "right"] {
        told["bodies"][body]
            .as_object_mut()
            .expect("a map")
            .remove("pose");
    }
    let told = outcome(&told);
    for name in ["right.angle", "left_rod.P.y", "driver.motor.effort"] {
        for (a, b) in column(&drawn, name).into_iter().zip(column(&told, name)) {
            close(a, b, FORCE);
        }
    }
}
