//! Columns of forces and joints: against geometry, against closed forms, and energies against the integral of power.

mod asked;

use crate::models;
use linkdyn_engine::analysis::Outcome;
use serde_json::{Value, json};
use std::f64::consts::TAU;

const R: f64 = 0.05;
const L: f64 = 0.2;
/// Where the spring and the actuator are held.
const W: [f64; 2] = [0.02, -0.1];
const STIFFNESS: f64 = 700.0;
const DAMPING: f64 = 3.0;
const FREE: f64 = 0.15;

/// A slider-crank of one turn in a second, begun flat, with a spring, a torsion spring, an actuator and loads.
fn model(analysis: &Value) -> Value {
    json!({ "format": "linkdyn/1", "units": "SI",
      "bodies": {
        "ground": { "points": { "O": [0, 0], "W": W } },
        "crank": { "mass": 1, "inertia": 0.001, "com": [0.01, 0], "points": { "O": [0, 0], "A": [R, 0] } },
        "rod": { "mass": 0.4, "inertia": 0.002, "com": [0.1, 0], "points": { "A": [0, 0], "B": [L, 0] }, "pose": { "position": [R, 0] } },
        "piston": { "mass": 2, "inertia": 0, "com": [0.03, 0], "points": { "B": [0, 0] }, "pose": { "position": [R + L, 0] } } },
      "joints": {
        "main": { "type": "revolute", "between": ["ground.O", "crank.O"] },
        "big": { "type": "revolute", "between": ["crank.A", "rod.A"] },
        "small": { "type": "revolute", "between": ["rod.B", "piston.B"] },
        "guide": { "type": "prismatic", "between": ["ground.O", "piston.B"], "axis": [1, 0] } },
      "drivers": { "motor": { "type": "rotation", "body": "crank", "motion": { "type": "constant_velocity", "velocity": TAU } } },
      "forces": {
        "spring": { "type": "spring", "between": ["ground.W", "piston.B"], "stiffness": STIFFNESS, "damping": DAMPING, "free_length": FREE },
        "twist": { "type": "torsion_spring", "between": ["crank", "rod"], "stiffness": 2, "damping": 0.1, "free_angle": 0.3 },
        "lift": { "type": "actuator", "between": ["piston.B", "ground.W"], "force": "=40 N - 30 N/m*force.lift.length" },
        "push": { "type": "force", "at": "piston.B", "vector": [5, -2] },
        "turn": { "type": "torque", "body": "rod", "value": 0.7 } },
      "analysis": analysis })
}

fn analysis(kind: &str, columns: &[&str]) -> Value {
    json!({ "type": kind, "end": 1, "outputs": 121, "columns": columns })
}

fn solve(json: &Value) -> Outcome {
    let outcome = models::solve(&models::load(json));
    assert!(
        outcome.report.warnings.is_empty(),
        "{:?}",
        outcome.report.warnings
    );
    outcome
}

/// x and ẋ of the piston at a time.
fn piston(time: f64) -> [f64; 2] {
    let (sin, cos) = (TAU * time).sin_cos();
    let across = (L * L - R * R * sin * sin).sqrt();
    [
        R * cos + across,
        TAU * (-R * sin - R * R * sin * cos / across),
    ]
}

#[track_caller]
fn near(found: &[f64], time: &[f64], scale: f64, expected: impl Fn(f64) -> f64) {
    for (&found, &time) in found.iter().zip(time) {
        let expected = expected(time);
        assert!(
            (found - expected).abs() <= 1e-12 * scale,
            "{found} at {time} s, not {expected}"
        );
    }
}

#[test]
fn springs_and_joints_show_what_geometry_says() {
    let patterns = [
        "force.*.length",
        "force.*.rate",
        "force.spring.f?",
        "force.*.f",
        "force.*.fx",
        "force.*.fy",
        "force.*.torque",
        "force.*.angle",
        "force.*.omega",
        "joint.*.angle",
        "joint.*.omega",
        "joint.*.slide",
        "joint.*.rate",
        "*.angle",
        "*.omega",
        "joint.*.f",
        "joint.*.f?",
    ];
    let outcome = solve(&model(&analysis("inverse_dynamics", &patterns)));
    let of = |name: &str| models::values(&outcome, name);
    let time = of("time");
    let length = |time: f64| (piston(time)[0] - W[0]).hypot(W[1]);
    let rate = |time: f64| (piston(time)[0] - W[0]) * piston(time)[1] / length(time);
    let push = |time: f64| STIFFNESS * (FREE - length(time)) - DAMPING * rate(time);
    near(&of("force.spring.length"), &time, 1.0, length);
    near(&of("force.spring.rate"), &time, 1.0, rate);
    near(&of("force.spring.f"), &time, 100.0, push);
    // on the second point, which is the piston's
    near(&of("force.spring.fx"), &time, 100.0, |time| {
        push(time) * (piston(time)[0] - W[0]) / length(time)
    });
    near(&of("force.spring.fy"), &time, 100.0, |time| {
        push(time) * -W[1] / length(time)
    });
    // the actuator has the same points the other way round: the second is the ground's
    let lift = |time: f64| 40.0 - 30.0 * length(time);
    near(&of("force.lift.f"), &time, 100.0, lift);
    near(&of("force.lift.fx"), &time, 100.0, |time| {
        lift(time) * (W[0] - piston(time)[0]) / length(time)
    });
    near(&of("force.push.fx"), &time, 1.0, |_| 5.0);
    near(&of("force.turn.torque"), &time, 1.0, |_| 0.7);
    near(&of("joint.guide.slide"), &time, 1.0, |time| piston(time)[0]);
    near(&of("joint.guide.rate"), &time, 1.0, |time| piston(time)[1]);
    // angles go on beyond a turn, as those of bodies do
    near(&of("joint.main.angle"), &time, 1.0, |time| TAU * time);
    let crank = |time: f64| TAU * time;
    let rod = |time: f64| -(R / L * crank(time).sin()).asin();
    near(&of("joint.big.angle"), &time, 1.0, |time| {
        rod(time) - crank(time)
    });
    let rod_rate = |time: f64| -TAU * R * crank(time).cos() / (L * rod(time).cos());
    near(&of("joint.big.omega"), &time, 10.0, |time| {
        rod_rate(time) - TAU
    });
    near(&of("force.twist.angle"), &time, 1.0, |time| {
        rod(time) - crank(time)
    });
    near(&of("force.twist.omega"), &time, 10.0, |time| {
        rod_rate(time) - TAU
    });
    let twist = |time: f64| -2.0 * (rod(time) - crank(time) - 0.3) - 0.1 * (rod_rate(time) - TAU);
    near(&of("force.twist.torque"), &time, 10.0, twist);
    let (fx, fy) = (of("joint.big.fx"), of("joint.big.fy"));
    let sizes: Vec<f64> = fx.iter().zip(&fy).map(|(x, y)| x.hypot(*y)).collect();
    assert_eq!(of("joint.big.f"), sizes);
}

/// The integral by Simpson's rule over the whole time.
fn integral(time: &[f64], values: &[f64]) -> f64 {
    let step = time[1] - time[0];
    let triples = values.windows(3).step_by(2);
    triples
        .map(|of| step / 3.0 * (of[0] + 4.0 * of[1] + of[2]))
        .sum()
}

#[test]
fn power_integrates_to_energy() {
    // a quarter of a turn and a little more, in steps whose fourth power is below what is asked
    let mut json = model(&json!({ "type": "kinematics", "end": 0.3, "outputs": 601,
        "columns": ["force.*.power", "force.*.length", "force.*.angle", "piston.x"] }));
    json["forces"]["spring"]["damping"] = json!(0);
    json["forces"]["twist"]["damping"] = json!(0);
    let outcome = solve(&json);
    let of = |name: &str| models::values(&outcome, name);
    let time = of("time");
    let change = |name: &str, energy: &dyn Fn(f64) -> f64| {
        let values = of(name);
        energy(values[600]) - energy(values[0])
    };
    let work = |name: &str| integral(&time, &of(name));
    let stretch = change("force.spring.length", &|l| {
        0.5 * STIFFNESS * (l - FREE) * (l - FREE)
    });
    assert!(
        (work("force.spring.power") + stretch).abs() < 1e-9 && stretch.abs() > 0.5,
        "{stretch}"
    );
    let twist = change("force.twist.angle", &|angle| (angle - 0.3) * (angle - 0.3));
    assert!(
        (work("force.twist.power") + twist).abs() < 1e-9 && twist.abs() > 0.5,
        "{twist}"
    );
    // what pushes apart works by the length
    let lift = change("force.lift.length", &|l| 40.0 * l - 15.0 * l * l);
    assert!(
        (work("force.lift.power") - lift).abs() < 1e-9 && lift.abs() > 0.5,
        "{lift}"
    );
    let push = change("piston.x", &|x| 5.0 * x);
    assert!(
        (work("force.push.power") - push).abs() < 1e-9 && push.abs() > 0.1,
        "{push}"
    );
}

#[test]
fn a_damper_takes_what_the_mechanism_loses() {
    // a slide that is braked by a damper alone: its energy goes there
    let json = json!({ "format": "linkdyn/1", "units": "SI",
      "bodies": { "ground": { "points": { "O": [0, 0], "W": [-1, 0.5] } },
        "block": { "mass": 2, "inertia": 1, "com": [0, 0], "points": { "P": [0, 0] } } },
      "joints": { "rail": { "type": "prismatic", "between": ["ground.O", "block.P"], "axis": [1, 0] } },
      "forces": { "damper": { "type": "spring", "between": ["ground.W", "block.P"], "damping": 3 } },
      "initial": { "block": { "vx": 1.5 } },
      "analysis": { "type": "dynamics", "end": 1, "outputs": 401, "solver": { "rtol": 1e-10, "atol": 1e-12 },
        "columns": ["force.damper.power", "energy.kinetic", "joint.rail.slide", "block.x"] } });
    let outcome = solve(&json);
    let of = |name: &str| models::values(&outcome, name);
    let energy = of("energy.kinetic");
    let lost = energy[400] - energy[0];
    let work = integral(&of("time"), &of("force.damper.power"));
    assert!(
        (work - lost).abs() < 1e-8 && lost < -1.0,
        "{work} and {lost}"
    );
    assert_eq!(of("joint.rail.slide"), of("block.x"));
}
