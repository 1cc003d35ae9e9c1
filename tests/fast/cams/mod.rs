//! Cams against closed forms.
//!
//! ```text
//! eccentric     flat face  y = R + e sin θ,     roller  y = e sin θ + √((R + r)² − e² cos² θ)
//! follower      tan μ = (s′ − e)/(s + √((r_b + r)² − e²))
//! arm           tan μ = (l (ψ′ − 1) + D cos ψ)/(D sin ψ)
//! pitch curve   ρ = (p² + s′²)^(3/2)/(p² + 2 s′² − p s″),  p = r_b + r + s;      flat face  ρ = r_b + s + s″
//! ```

mod laws;
mod moving;
mod turning;
mod words;

use crate::mechanisms::{column, model, outcome, pin};
use linkdyn_engine::analysis::Outcome;
use linkdyn_output::Status;
use serde_json::{Value, json};
use std::f64::consts::{PI, TAU};

const GRAVITY: f64 = 9.81;
const MASS: f64 = 0.8;
const OMEGA: f64 = 3.0;

/// A cam that turns at a constant speed from an angle on, once, and a follower on an upright guide `right` of its point.
fn sliding(cam: Value, right: f64, start: f64) -> Value {
    let bodies = json!({
        "ground": { "points": { "O": [0.0, 0.0], "G": [right, 0.0], "S": [right, 0.3] } },
        "cam": { "mass": 1.0, "inertia": 0.01, "com": [0.0, 0.0], "points": { "C": [0.0, 0.0] },
                 "pose": { "angle": start } },
        "follower": { "mass": MASS, "inertia": 0.01, "com": [0.0, 0.0], "points": { "T": [0.0, 0.0] },
                      "pose": { "position": [right, 0.06] } },
    });
    let mut joints = json!({
        "o": pin("ground.O", "cam.C"),
        "g": { "type": "prismatic", "between": ["ground.G", "follower.T"], "axis": [0.0, 1.0] },
    });
    joints["c"] = json!({ "type": "cam", "between": ["cam.C", "follower.T"] });
    let own = joints["c"].as_object_mut().expect("an object");
    own.extend(cam.as_object().expect("an object").clone());
    let motor = json!({ "type": "rotation", "body": "cam",
        "motion": { "type": "constant_velocity", "start": start, "velocity": OMEGA } });
    let mut model = model(bodies, joints, json!({ "motor": motor }));
    model["analysis"] = json!({ "type": "inverse_dynamics", "end": TAU / OMEGA, "outputs": 73 });
    model
}

/// A spring that presses the follower down.
fn press(model: &mut Value, stiffness: f64, free_length: f64) {
    model["forces"] = json!({ "spring": { "type": "spring", "between": ["ground.S", "follower.T"],
        "stiffness": stiffness, "free_length": free_length } });
}

#[track_caller]
fn completed(model: &Value) -> Outcome {
    let run = outcome(model);
    let message = &run.report.message;
    assert_eq!(run.report.status, Status::Completed, "{message:?}");
    run
}

/// Columns hold the values of a function of the cam's angle, and the row's number, to a part of the largest of them.
#[track_caller]
fn follows(run: &Outcome, name: &str, tolerance: f64, of: impl Fn(f64, usize) -> f64) {
    let angles = column(run, "cam.angle");
    let found = column(run, name);
    let expected: Vec<f64> = angles
        .iter()
        .zip(0..)
        .map(|(&angle, k)| of(angle, k))
        .collect();
    let largest = expected
        .iter()
        .fold(0.0, |most: f64, value| most.max(value.abs()));
    for (k, (found, expected)) in found.iter().zip(&expected).enumerate() {
        let off = (found - expected).abs();
        assert!(
            off <= tolerance * largest.max(1e-3),
            "{name} of row {k}: {found} for {expected}, {off:e} off"
        );
    }
}

const ECCENTRICITY: f64 = 0.015;
const RADIUS: f64 = 0.04;
const ROLLER: f64 = 0.01;

fn eccentric() -> Value {
    json!({ "type": "circle", "centre": [ECCENTRICITY, 0.0], "radius": RADIUS })
}

#[test]
fn a_flat_follower_on_an_eccentric_moves_harmonically() {
    let mut model = sliding(
        json!({ "follower": "flat", "face": [1.0, 0.0], "profile": eccentric() }),
        0.0,
        0.3,
    );
    let (stiffness, free) = (900.0, 0.32);
    press(&mut model, stiffness, free);
    let run = completed(&model);
    let e = ECCENTRICITY;
    let height = |angle: f64| RADIUS + e * angle.sin();
    follows(&run, "follower.y", 1e-14, |angle, _| height(angle));
    follows(&run, "follower.vy", 1e-13, |angle, _| {
        e * OMEGA * angle.cos()
    });
    follows(&run, "follower.ay", 1e-13, |angle, _| {
        -e * OMEGA * OMEGA * angle.sin()
    });
    follows(&run, "joint.c.contact_x", 1e-13, |angle, _| e * angle.cos());
    follows(&run, "joint.c.contact_y", 1e-14, |angle, _| height(angle));
    follows(&run, "joint.c.curvature", 1e-13, |_, _| 1.0 / RADIUS);
    follows(&run, "joint.c.pressure_angle", 1e-14, |_, _| 0.0);
    let pressed = |angle: f64| {
        let spring = stiffness * (free - (0.3 - height(angle)));
        MASS * (GRAVITY - e * OMEGA * OMEGA * angle.sin()) + spring
    };
    follows(&run, "joint.c.normal_force", 1e-12, |angle, _| {
        pressed(angle)
    });
    follows(&run, "joint.c.fy", 1e-12, |angle, _| pressed(angle));
    follows(&run, "joint.c.fx", 1e-12, |_, _| 0.0);
    // the force stands beside the follower's point, and its guide takes the moment
    follows(&run, "joint.c.torque", 1e-12, |angle, _| {
        pressed(angle) * e * angle.cos()
    });
    follows(&run, "joint.g.torque", 1e-12, |angle, _| {
        -pressed(angle) * e * angle.cos()
    });
    follows(&run, "driver.motor.effort", 1e-12, |angle, _| {
        pressed(angle) * e * angle.cos()
    });
    assert!(run.report.warnings.is_empty(), "{:?}", run.report.warnings);
}

#[test]
fn a_roller_on_an_eccentric_is_a_slider_crank() {
    for (follower, roller) in [("roller", ROLLER), ("knife", 0.0)] {
        let mut cam = json!({ "follower": follower, "profile": eccentric() });
        if roller > 0.0 {
            cam["roller_radius"] = json!(roller);
        }
        let mut model = sliding(cam, 0.0, 0.3);
        press(&mut model, 900.0, 0.32);
        let run = completed(&model);
        let (e, l) = (ECCENTRICITY, RADIUS + roller);
        let rod = |angle: f64| (l * l - (e * angle.cos()).powi(2)).sqrt();
        follows(&run, "follower.y", 1e-14, |angle, _| {
            e * angle.sin() + rod(angle)
        });
        let rate = |angle: f64| e * angle.cos() + e * e * angle.cos() * angle.sin() / rod(angle);
        follows(&run, "follower.vy", 1e-13, |angle, _| OMEGA * rate(angle));
        let lean = |angle: f64| (e * angle.cos() / l).asin();
        follows(&run, "joint.c.pressure_angle", 1e-12, |angle, _| {
            lean(angle)
        });
        follows(&run, "joint.c.curvature", 1e-12, |_, _| 1.0 / RADIUS);
        let touch = |angle: f64| e * angle.cos() - RADIUS * lean(angle).sin();
        follows(&run, "joint.c.contact_x", 1e-12, |angle, _| touch(angle));
        let [force, fx, fy] =
            ["normal_force", "fx", "fy"].map(|word| column(&run, &format!("joint.c.{word}")));
        let angles = column(&run, "cam.angle");
        for (k, &angle) in angles.iter().enumerate() {
            let (sin, cos) = lean(angle).sin_cos();
            assert!((fx[k] + force[k] * sin).abs() < 1e-12 * force[k]);
            assert!((fy[k] - force[k] * cos).abs() < 1e-12 * force[k]);
        }
        assert!(
            !run.trajectory
                .columns
                .iter()
                .any(|column| column.name == "joint.c.torque")
        );
    }
}

/// What a spring takes while the follower rises it gives back.
#[test]
fn the_drive_works_nothing_over_a_turn() {
    for cam in [
        json!({ "follower": "flat", "face": [1.0, 0.0], "profile": eccentric() }),
        json!({ "follower": "roller", "roller_radius": ROLLER, "profile": eccentric() }),
    ] {
        let mut model = sliding(cam, 0.0, 0.3);
        press(&mut model, 900.0, 0.32);
        let run = completed(&model);
        let efforts = column(&run, "driver.motor.effort");
        // the last row is the first one again; the mean of a periodic function at equal steps is exact to round-off
        let mean = efforts[1..].iter().sum::<f64>() / (efforts.len() - 1) as f64;
        let largest = efforts
            .iter()
            .fold(0.0, |most: f64, one| most.max(one.abs()));
        assert!(mean.abs() < 1e-12 * largest, "{mean:e} of {largest}");
    }
}

/// An arm on a circle: four-bar of eccentricity, radii, arm and ground.
#[test]
fn an_arm_on_an_eccentric_is_a_four_bar() {
    let (arm, distance) = (0.09, 0.1);
    let mut model = sliding(
        json!({ "follower": "roller", "roller_radius": ROLLER, "profile": eccentric() }),
        0.0,
        0.3,
    );
    model["bodies"]["ground"]["points"]["P"] = json!([distance, 0.0]);
    model["bodies"]["follower"] = json!({ "mass": MASS, "inertia": 0.01, "com": [0.0, 0.0],
        "points": { "P": [0.0, 0.0], "T": [-arm, 0.0] }, "pose": { "position": [distance, 0.0], "angle": -0.5 } });
    model["joints"]["g"] = pin("ground.P", "follower.P");
    let run = completed(&model);
    let length = RADIUS + ROLLER;
    let swung = |angle: f64| {
        let [x, y] = [
            ECCENTRICITY * angle.cos() - distance,
            ECCENTRICITY * angle.sin(),
        ];
        let far = x.hypot(y);
        let between = ((arm * arm + far * far - length * length) / (2.0 * arm * far)).acos();
        y.atan2(x) - between
    };
    follows(&run, "follower.angle", 1e-13, |angle, _| {
        let turned = swung(angle) - PI;
        turned - TAU * (turned / TAU).round()
    });
}

/// The curve through points goes through them.
#[test]
fn a_curve_through_points_goes_through_them() {
    let radius = |k: usize| 0.04 + 0.006 * (k as f64).sin();
    let points: Vec<[f64; 2]> = (0..24)
        .map(|k| {
            let (sin, cos) = (TAU * k as f64 / 24.0).sin_cos();
            [radius(k) * cos, radius(k) * sin]
        })
        .collect();
    let clockwise: Vec<[f64; 2]> = points.iter().rev().copied().collect();
    for points in [points, clockwise] {
        let profile = json!({ "type": "points", "points": points });
        let mut model = sliding(
            json!({ "follower": "knife", "profile": profile }),
            0.0,
            PI / 2.0,
        );
        model["analysis"]["outputs"] = json!(25);
        let run = completed(&model);
        // the edge above the cam's point stands over point −k after k steps
        follows(&run, "follower.y", 1e-13, |_, k| radius((48 - k) % 24));
    }
}
