//! Friction of ideal joints: against closed forms and equations written once more by hand, and where it locks.

mod forms;
mod loops;
mod slider;

use crate::mechanisms::*;
use linkdyn_engine::analysis::{Control, Outcome, run};
use linkdyn_output::Status;
use serde_json::{Value, json};

const G: f64 = 9.81;

fn coulomb(coefficient: f64, threshold: f64) -> Value {
    json!({ "law": "coulomb", "coefficient": coefficient, "threshold_velocity": threshold })
}

fn lugre(kinetic: f64, resting: f64) -> Value {
    json!({ "law": "lugre", "coefficient": kinetic, "static_coefficient": resting, "stribeck_velocity": 0.01,
            "bristle_stiffness": 1e4, "bristle_damping": 30.0 })
}

fn dynamics(end: f64, outputs: usize, rtol: f64) -> Value {
    json!({ "type": "dynamics", "end": end, "outputs": outputs, "solver": { "rtol": rtol, "atol": 1e-2 * rtol } })
}

#[track_caller]
fn completed(model: &Value) -> Outcome {
    let outcome = outcome(model);
    assert_eq!(
        outcome.report.status,
        Status::Completed,
        "{:?}",
        outcome.report.message
    );
    assert!(
        outcome.report.quality.power_imbalance.expect("forces") < 1e-12,
        "{:?}",
        outcome.report.quality
    );
    outcome
}

#[track_caller]
fn close(found: f64, wanted: f64, tolerance: f64) {
    assert!(
        (found - wanted).abs() <= tolerance,
        "{found:e}, not {wanted:e}: off by {:e}",
        (found - wanted).abs()
    );
}

fn last(outcome: &Outcome, name: &str) -> f64 {
    *column(outcome, name).last().expect("rows")
}

/// A block of 2 kg on a plane that falls at `slope`, starting at rest.
fn incline(slope: f64, friction: &Value) -> Value {
    let bodies = json!({
        "ground": { "points": { "O": [0.0, 0.0] } },
        "block": { "mass": 2.0, "inertia": 0.01, "com": [0.0, 0.0], "points": { "C": [0.0, 0.0] },
                   "pose": { "position": [0.0, 0.0], "angle": -slope } },
    });
    let joints = json!({ "g": { "type": "prismatic", "between": ["ground.O", "block.C"],
        "axis": [slope.cos(), -slope.sin()], "angle": -slope, "friction": friction } });
    model(bodies, joints, json!({}))
}

/// A uniform bar on a pin of radius r.
fn pendulum(angle: f64, radius: f64, friction: &Value) -> Value {
    let bodies =
        json!({ "ground": { "points": { "O": [0.0, 0.0] } }, "bar": rod(1.0, [0.0, 0.0], angle) });
    let joints = json!({ "o": { "type": "revolute", "between": ["ground.O", "bar.A"], "friction": friction,
                                "pin_radius": radius } });
    let mut pendulum = model(bodies, joints, json!({}));
    pendulum["initial"] = json!({ "bar": { "angle": angle, "angular_velocity": 0.0 } });
    pendulum
}

/// The four-bar of the examples with friction in all its pins.
fn four_bar(mu: f64) -> Value {
    let text = linkdyn_model::bundled::find("four-bar")
        .expect("bundled")
        .text;
    let mut four_bar: Value = serde_json::from_str(text).expect("valid JSON");
    for joint in four_bar["joints"]
        .as_object_mut()
        .expect("a map")
        .values_mut()
    {
        joint["friction"] = coulomb(mu, 1e-3);
        joint["pin_radius"] = json!("8 mm");
    }
    four_bar["analysis"] = json!({ "type": "inverse_dynamics", "end": 0.5, "outputs": 51 });
    four_bar
}

/// Bristles hold a block that a regularised law would let creep, and let it go at the static coefficient.
#[test]
fn bristles_stick_and_break_away() {
    let mut model = incline(0.2, &lugre(0.15, 0.25));
    model["analysis"] = dynamics(2.0, 3, 1e-8);
    // Next to no power flows, so its balance is told in parts of nothing.
    let run = outcome(&model);
    assert_eq!(run.report.status, Status::Completed);
    let moved = column(&run, "block.x");
    // It gives way by some deflections of the bristles, and stays there.
    assert!(
        moved[2] > 0.2_f64.tan() / 1e4 && moved[2] < 1e-3,
        "{moved:?}"
    );
    close(moved[2], moved[1], 1e-8);
    close(
        last(&run, "joint.g.friction"),
        -2.0 * G * 0.2_f64.sin(),
        1e-4,
    );
    let mut model = incline(0.3, &lugre(0.15, 0.25));
    model["analysis"] = dynamics(2.0, 3, 1e-8);
    let run = completed(&model);
    let (sin, cos) = 0.3_f64.sin_cos();
    close(
        last(&run, "block.ax").hypot(last(&run, "block.ay")),
        G * (sin - 0.15 * cos),
        1e-6,
    );
}

/// What slows a free mechanism down is what its pins turn into heat: Simpson's rule over the columns.
#[test]
fn lost_energy_is_the_work_of_friction() {
    let mut model = four_bar(0.0);
    model.as_object_mut().expect("a map").remove("drivers");
    model.as_object_mut().expect("a map").remove("forces");
    for joint in model["joints"].as_object_mut().expect("a map").values_mut() {
        joint["friction"] = json!({ "law": "stribeck", "coefficient": 0.1, "static_coefficient": 0.15,
            "stribeck_velocity": "50 mm/s", "threshold_velocity": "10 mm/s", "viscous": 0.2 });
    }
    model["initial"] = json!({ "crank": { "angle": "60 deg", "angular_velocity": "25 rad/s" } });
    model["analysis"] = dynamics(0.5, 4001, 1e-10);
    let run = completed(&model);
    let get = |name: &str| column(&run, name);
    let [crank, coupler, rocker] = ["crank.omega", "coupler.omega", "rocker.omega"].map(get);
    let [a, b, c, d] =
        ["a", "b", "c", "d"].map(|joint| column(&run, &format!("joint.{joint}.friction")));
    let power = |k: usize| {
        a[k] * crank[k]
            + b[k] * (coupler[k] - crank[k])
            + c[k] * (rocker[k] - coupler[k])
            + d[k] * rocker[k]
    };
    let (kinetic, potential) = (get("energy.kinetic"), get("energy.potential"));
    let step = get("time")[1];
    let (mut work, mut worst) = (0.0, 0.0_f64);
    for k in (2..kinetic.len()).step_by(2) {
        assert!(power(k) <= 0.0, "{k}");
        work += step / 3.0 * (power(k - 2) + 4.0 * power(k - 1) + power(k));
        worst = worst.max((kinetic[k] + potential[k] - kinetic[0] - potential[0] - work).abs());
    }
    println!("{worst:e} of {work} J");
    assert!(
        work < -0.5 && worst < 1e-6 * work.abs(),
        "{worst:e} of {work} J"
    );
}

fn said(joint: Value) -> Vec<String> {
    let mut model = pendulum(0.0, 0.01, &json!({ "law": "none" }));
    model["joints"]["o"] = joint;
    match linkdyn_model::load(model.to_string().as_bytes(), &[]) {
        Ok(loaded) => loaded.warnings,
        Err(complaints) => {
            let text = |complaint: &linkdyn_model::error::Complaint| {
                let text = complaint.to_string();
                text.split_once("joints.o")
                    .map_or(text.clone(), |(_, rest)| rest.to_string())
            };
            complaints.iter().map(text).collect()
        }
    }
}

#[test]
fn complaints_say_what_lacks_and_where_it_belongs() {
    let pin = |more: Value| {
        let mut joint = json!({ "type": "revolute", "between": ["ground.O", "bar.A"] });
        for (key, value) in more.as_object().expect("a map") {
            joint[key] = value.clone();
        }
        said(joint)
    };
    let sound = coulomb(0.1, 0.01);
    assert!(pin(json!({ "friction": sound, "pin_radius": "8 mm" })).is_empty());
    assert!(pin(json!({ "friction": { "law": "none" } })).is_empty());
    assert_eq!(
        pin(json!({ "friction": sound })),
        [
            ": \"pin_radius\" is missing (the torque of the friction is that of its force on the pin's surface)"
        ]
    );
    assert_eq!(
        pin(json!({ "friction": { "law": "coulomb", "coefficient": 0.1 }, "pin_radius": 0.01 })),
        [": \"friction.threshold_velocity\" is missing (the law \"coulomb\" needs it)"]
    );
    let clearance =
        |model: &str| json!({ "model": model, "radius": 1e-4, "surface": { "stiffness": 1e8 } });
    let both = |model: &str| json!({ "friction": sound, "pin_radius": 0.01, "clearance": clearance(model) });
    assert!(pin(both("ideal")).is_empty());
    for complaint in [pin(both("two_state")), pin(both("massless_link"))].concat() {
        assert!(
            complaint.starts_with(".friction: ") && complaint.contains("is that of an ideal joint"),
            "{complaint}"
        );
    }
    let zero = pin(json!({ "friction": sound, "pin_radius": 0.0 }));
    assert!(
        zero.len() == 1 && zero[0].starts_with(".pin_radius: 0"),
        "{zero:?}"
    );
    let slot = said(
        json!({ "type": "slot", "between": ["ground.O", "bar.A"], "axis": [1.0, 0.0], "friction": sound }),
    );
    assert!(
        slot.iter()
            .any(|text| text.contains("only revolute and prismatic joints can have friction")),
        "{slot:?}"
    );
}

#[test]
fn what_has_no_history_has_no_bristles_and_rest_no_friction() {
    let mut driven = four_bar(0.1);
    driven["joints"]["b"]["friction"] = lugre(0.1, 0.2);
    let complaints = run(&loaded(&driven).model, &Control::default()).expect_err("refused");
    assert_eq!(complaints.len(), 1);
    let text = complaints[0].to_string();
    assert!(
        text.contains("joints.b.friction.law") && text.contains("bristles have a history"),
        "{text}"
    );
    driven["analysis"]["type"] = json!("kinematics");
    assert_eq!(outcome(&driven).report.status, Status::Completed);

    let mut resting = pendulum(-1.0, 0.01, &coulomb(0.1, 0.01));
    resting["analysis"] = json!({ "type": "statics" });
    let run = outcome(&resting);
    assert!(
        run.report
            .warnings
            .iter()
            .any(|text| text.starts_with("the friction of o is left out")),
        "{:?}",
        run.report.warnings
    );
    close(last(&run, "bar.angle"), -std::f64::consts::FRAC_PI_2, 1e-9);
    assert!(run.trajectory.values("joint.o.friction").is_none());
}
