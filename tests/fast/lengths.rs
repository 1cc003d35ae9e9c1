//! Driven lengths against closed forms, and against a cylinder of two bodies.

use crate::mechanisms::*;
use linkdyn_engine::analysis::{Control, run};
use linkdyn_output::Status;
use serde_json::{Value, json};

const G: f64 = 9.81;
const MASS: f64 = 60.0;
const INERTIA: f64 = 15.0;
/// Foot and eye of the cylinder; the arm turns about the origin.
const FOOT: [f64; 2] = [0.2, -0.4];
const EYE: f64 = 0.5;

/// An arm lifted by a cylinder, s(t) = 0.5 m + 0.05 m/s t + 0.01 m/s² t².
fn lift() -> Value {
    let bodies = json!({ "ground": { "points": { "hinge": [0.0, 0.0], "foot": FOOT } },
        "arm": { "mass": MASS, "inertia": INERTIA, "com": [0.8, 0.0], "points": { "hinge": [0.0, 0.0], "eye": [EYE, 0.0] } } });
    let joints = json!({ "hinge": pin("ground.hinge", "arm.hinge") });
    let oil = json!({ "type": "length", "between": ["ground.foot", "arm.eye"],
        "motion": { "type": "polynomial", "coefficients": [0.5, 0.05, 0.01] } });
    let mut lift = model(bodies, joints, json!({ "oil": oil }));
    lift["analysis"] = json!({ "type": "inverse_dynamics", "end": 4.0, "outputs": 41 });
    lift
}

/// ℓ² = a² + b² − 2 a b cos γ between the lines to foot and eye; by virtual work F dℓ = (I α + m g c cos θ) dθ.
#[test]
fn a_cylinder_lifts_an_arm_as_its_triangle_says() {
    let run = outcome(&lift());
    assert_eq!(run.report.status, Status::Completed, "{:?}", run.report);
    let mobility = &run.report.mobility;
    assert_eq!((mobility.grubler, mobility.rank), (1, 1));
    let of = |name: &str| column(&run, name);
    let (a, b) = (FOOT[0].hypot(FOOT[1]), EYE);
    let below = FOOT[1].atan2(FOOT[0]);
    for (k, t) in of("time").into_iter().enumerate() {
        let (length, rate, bend) = (0.5 + 0.05 * t + 0.01 * t * t, 0.05 + 0.02 * t, 0.02);
        close(of("driver.oil.value")[k], length, 1e-14);
        let gamma = ((a * a + b * b - length * length) / (2.0 * a * b)).acos();
        let theta = below + gamma;
        close(of("arm.angle")[k], theta, 1e-13);
        // dℓ/dθ and d²ℓ/dθ² of ℓ² = a² + b² − 2 a b cos γ.
        let slope = a * b * gamma.sin() / length;
        let second = (a * b * gamma.cos() - slope * slope) / length;
        let omega = rate / slope;
        let alpha = (bend - second * omega * omega) / slope;
        close(of("arm.omega")[k], omega, 1e-12);
        close(of("arm.alpha")[k], alpha, 1e-11);
        let about = INERTIA + MASS * 0.8 * 0.8;
        let effort = (about * alpha + MASS * G * 0.8 * theta.cos()) / slope;
        close(
            of("driver.oil.effort")[k],
            effort,
            1e-12 * effort.abs() * 10.0,
        );
    }
}

/// Tube and rod without mass, with a slide between them, say the same: motion, effort, and what the ground carries.
#[test]
fn a_driven_length_is_a_cylinder_without_mass() {
    let mut alone = lift();
    let mut whole = lift();
    for (name, at) in [("tube", FOOT), ("rod", [EYE, 0.0])] {
        whole["bodies"][name] = json!({ "mass": 0, "inertia": 0, "com": [0.0, 0.0], "points": { "P": [0.0, 0.0] },
            "pose": { "position": at, "angle": 0.9 } });
    }
    whole["joints"]["foot"] = pin("ground.foot", "tube.P");
    whole["joints"]["eye"] = pin("arm.eye", "rod.P");
    whole["joints"]["slide"] =
        json!({ "type": "prismatic", "between": ["tube.P", "rod.P"], "axis": [1.0, 0.0] });
    let motion = alone["drivers"]["oil"]["motion"].clone();
    whole["drivers"]["oil"] = json!({ "type": "translation", "joint": "slide", "motion": motion });
    for model in [&mut alone, &mut whole] {
        model["responses"] = json!({ "fx": "max(shaking.fx)", "fy": "max(shaking.fy)", "moment": "max(shaking.moment)" });
    }
    let (alone, whole) = (outcome(&alone), outcome(&whole));
    for name in [
        "arm.angle",
        "arm.omega",
        "arm.alpha",
        "driver.oil.effort",
        "joint.hinge.fx",
        "joint.hinge.fy",
    ] {
        for (ours, theirs) in column(&alone, name).into_iter().zip(column(&whole, name)) {
            close(ours, theirs, 1e-9 * theirs.abs().max(1.0));
        }
    }
    for (ours, theirs) in alone.responses.iter().zip(&whole.responses) {
        let (ours, theirs) = (ours.value.expect("known"), theirs.value.expect("known"));
        close(ours, theirs, 1e-9 * theirs.abs().max(1.0));
    }
}

/// LinearisedSystem at a length, two pendulums are one with a rod between them: nothing is lost, and the rod's force is the effort.
#[test]
fn a_held_length_is_a_rod() {
    let pendulum = |position: [f64; 2], angle: f64| {
        json!({ "mass": 2.0, "inertia": 0.05, "com": [0.4, 0.0], "points": { "O": [0.0, 0.0], "P": [0.6, 0.0] },
            "pose": { "position": position, "angle": angle } })
    };
    let bodies = json!({ "ground": { "points": { "A": [0.0, 0.0], "B": [1.0, 0.2] } },
        "one": pendulum([0.0, 0.0], -0.4), "two": pendulum([1.0, 0.2], -1.1) });
    let joints = json!({ "a": pin("ground.A", "one.O"), "b": pin("ground.B", "two.O") });
    let place = |x: f64, y: f64, angle: f64| [x + 0.6 * f64::cos(angle), y + 0.6 * f64::sin(angle)];
    let (p, q) = (place(0.0, 0.0, -0.4), place(1.0, 0.2, -1.1));
    let length = (q[0] - p[0]).hypot(q[1] - p[1]);
    let mut held = model(
        bodies,
        joints,
        json!({ "rod": { "type": "length", "between": ["one.P", "two.P"],
        "motion": { "type": "polynomial", "coefficients": [length] } } }),
    );
    held["analysis"] = json!({ "type": "dynamics", "end": 1.0, "outputs": 21, "solver": { "rtol": 1e-11, "atol": 1e-13 } });
    let mut rod = held.clone();
    rod["drivers"] = json!({});
    rod["bodies"]["rod"] = json!({ "mass": 0, "inertia": 0, "com": [0.0, 0.0], "points": { "P": [0.0, 0.0], "Q": [length, 0.0] },
        "pose": { "position": p, "angle": (q[1] - p[1]).atan2(q[0] - p[0]) } });
    rod["joints"]["p"] = pin("one.P", "rod.P");
    rod["joints"]["q"] = pin("rod.Q", "two.P");
    let (held, rod) = (outcome(&held), outcome(&rod));
    assert_eq!(held.report.status, Status::Completed, "{:?}", held.report);
    for name in ["one.angle", "two.omega", "energy.kinetic"] {
        for (ours, theirs) in column(&held, name).into_iter().zip(column(&rod, name)) {
            close(ours, theirs, 1e-8);
        }
    }
    let (fx, fy) = (column(&rod, "joint.q.fx"), column(&rod, "joint.q.fy"));
    for (k, effort) in column(&held, "driver.rod.effort").into_iter().enumerate() {
        close(effort.abs(), fx[k].hypot(fy[k]), 1e-6);
    }
}

/// A drawing in which the points coincide has no line between them; along another one the assembly parts them.
#[test]
fn points_that_coincide_are_parted() {
    let mut folded = lift();
    let start = 0.5_f64;
    folded["bodies"]["ground"]["points"]["foot"] = json!([EYE * start.cos(), EYE * start.sin()]);
    folded["bodies"]["arm"]["pose"] = json!({ "angle": start });
    folded["drivers"]["oil"]["motion"]["coefficients"] = json!([0.1]);
    let run = outcome(&folded);
    assert_eq!(run.report.status, Status::Completed, "{:?}", run.report);
    let angle = column(&run, "arm.angle")[0];
    close(2.0 * EYE * (0.5 * (angle - start)).sin().abs(), 0.1, 1e-13);
}

#[test]
fn lengths_that_no_points_have_are_told() {
    let mut wrong = lift();
    wrong["drivers"]["oil"]["motion"]["coefficients"] = json!([-0.02, 0.05]);
    let said = run(&loaded(&wrong).model, &Control::default()).expect_err("refused");
    assert_eq!(
        said.to_string(),
        "drivers.oil.motion: the length begins at -0.02 m, and points that are driven apart have a distance above 0 (a driven length \
         is the whole distance of its points, not the stroke)"
    );
    // Longer than the triangle allows: the motion ends where the arm is stretched.
    wrong["drivers"]["oil"]["motion"]["coefficients"] = json!([0.5, 0.2]);
    let report = outcome(&wrong).report;
    assert_ne!(report.status, Status::Completed);
    println!("{:?}", report.message);
    assert!(
        report.message.expect("a reason").contains("oil"),
        "no driver named"
    );
}
