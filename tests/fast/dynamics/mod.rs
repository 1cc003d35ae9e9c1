//! Laws of free motion: energy, drivers among free coordinates, forward and inverse dynamics against each other, stiffness,
//! and errors that follow the tolerance. Motions with known answers are reference cases in `validation/`.

mod breaks;
mod curves;
mod driven;
mod sequence;
mod sparse;
mod stiff;

use crate::mechanisms::*;
use linkdyn_engine::analysis::Outcome;
use linkdyn_model::bundled;
use linkdyn_output::Status;
use serde_json::{Value, json};
use std::f64::consts::PI;

fn dynamics(end: f64, outputs: usize, rtol: f64) -> Value {
    json!({ "type": "dynamics", "end": end, "outputs": outputs, "solver": { "rtol": rtol, "atol": 1e-3 * rtol } })
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
    outcome
}

fn double_pendulum() -> Value {
    let bodies = json!({ "ground": { "points": { "O": [0.0, 0.0] } },
        "upper": rod(1.0, [0.0, 0.0], 0.3), "lower": rod(0.8, [0.95, 0.3], -0.4) });
    let joints = json!({ "o": pin("ground.O", "upper.A"), "a": pin("upper.B", "lower.A") });
    let mut pendulum = model(bodies, joints, json!({}));
    pendulum["initial"] = json!({ "upper": { "angle": 0.3, "angular_velocity": 0.5 },
        "lower": { "angle": -0.4, "angular_velocity": -1.0 } });
    pendulum
}

/// A bundled mechanism without its driver and forces.
fn free(name: &str) -> Value {
    let text = bundled::find(name).expect("bundled").text;
    let mut json: Value = serde_json::from_str(text).expect("valid JSON");
    let words = json.as_object_mut().expect("a map");
    for key in ["drivers", "forces"] {
        words.remove(key);
    }
    json
}

/// The bundled four-bar without its driver, its crank turning fast enough for whole turns.
fn free_four_bar() -> Value {
    let mut four_bar = free("four-bar");
    four_bar["initial"] = json!({ "crank": { "angle": "60 deg", "angular_velocity": "25 rad/s" } });
    four_bar
}

/// Largest change of energy, by the largest kinetic energy.
fn energy_drift(outcome: &Outcome) -> f64 {
    let (kinetic, potential) = (
        column(outcome, "energy.kinetic"),
        column(outcome, "energy.potential"),
    );
    let start = kinetic[0] + potential[0];
    let drift = kinetic
        .iter()
        .zip(&potential)
        .fold(0.0, |m: f64, (t, v)| m.max((t + v - start).abs()));
    drift / kinetic.iter().fold(0.0, |m: f64, t| m.max(*t))
}

/// No more than the errors of the steps add up to, and less with each tolerance.
#[test]
fn energy_is_kept_the_better_the_smaller_the_tolerance() {
    for (name, mut model, end) in [
        ("double pendulum", double_pendulum(), 10.0),
        ("four-bar", free_four_bar(), 10.0),
    ] {
        let mut drifts = Vec::new();
        for rtol in [1e-6, 1e-8, 1e-10] {
            model["analysis"] = dynamics(end, 101, rtol);
            let run = completed(&model);
            let steps = run.report.statistics.steps as f64;
            let drift = energy_drift(&run);
            println!("{name}: {drift:e} of the energy at rtol {rtol:e} in {steps} steps");
            assert!(
                drift <= 10.0 * rtol * steps,
                "{name}: {drift:e} at {rtol:e} in {steps} steps"
            );
            drifts.push(drift);
        }
        assert!(
            drifts.windows(2).all(|pair| pair[1] < 0.1 * pair[0]),
            "{name}: {drifts:?}"
        );
    }
}

#[test]
fn a_six_bar_keeps_its_energy_for_a_minute() {
    let mut six_bar: Value =
        serde_json::from_str(bundled::find("stephenson-iii").expect("bundled").text)
            .expect("valid JSON");
    six_bar.as_object_mut().expect("a map").remove("drivers");
    six_bar["initial"] = json!({ "crank": { "angle": 90.0, "angular_velocity": "20 rad/s" } });
    six_bar["analysis"] = dynamics(60.0, 601, 1e-10);
    let run = completed(&six_bar);
    let drift = energy_drift(&run);
    println!(
        "{drift:e} in {} steps, {:?}",
        run.report.statistics.steps, run.report.quality
    );
    assert!(
        drift <= 1e-10 * run.report.statistics.steps as f64,
        "{drift:e}"
    );
    assert!(
        run.report.quality.constraint_residual <= 1e-12,
        "{:?}",
        run.report.quality
    );
}

/// Without outer forces two bodies keep momentum and angular momentum.
#[test]
fn momentum_is_kept_where_nothing_acts_from_outside() {
    let mut model = double_pendulum();
    model["gravity"] = json!([0.0, 0.0]);
    model["joints"].as_object_mut().expect("a map").remove("o");
    model["initial"]["upper"] =
        json!({ "x": 0.0, "y": 0.0, "angle": 0.3, "vx": 0.4, "vy": -0.7, "angular_velocity": 2.0 });
    model["forces"] = json!({ "hinge": { "type": "torsion_spring", "between": ["upper", "lower"],
        "stiffness": 20.0, "damping": 0.3 } });
    model["analysis"] = dynamics(5.0, 51, 1e-10);
    let run = completed(&model);
    let get = |body: &str, name: &str| column(&run, &format!("{body}.{name}"));
    let mut kept: Vec<[f64; 3]> = vec![[0.0; 3]; run.trajectory.len()];
    for (body, length) in [("upper", 1.0), ("lower", 0.8)] {
        let [x, y, angle, vx, vy, omega] =
            ["x", "y", "angle", "vx", "vy", "omega"].map(|name| get(body, name));
        for (k, sum) in kept.iter_mut().enumerate() {
            let (sin, cos) = angle[k].sin_cos();
            let (rx, ry) = (0.5 * length * cos, 0.5 * length * sin);
            let (px, py) = (vx[k] - omega[k] * ry, vy[k] + omega[k] * rx);
            let spin = (x[k] + rx) * py - (y[k] + ry) * px + length * length / 12.0 * omega[k];
            for (sum, part) in sum.iter_mut().zip([px, py, spin]) {
                *sum += part;
            }
        }
    }
    let off = kept
        .iter()
        .flat_map(|now| now.iter().zip(&kept[0]))
        .fold(0.0, |m: f64, (a, b)| m.max((a - b).abs()));
    println!("{off:e} in {} steps", run.report.statistics.steps);
    assert!(off <= 1e-10 * run.report.statistics.steps as f64, "{off:e}");
}

/// A stiff, heavily damped coil holds the hinge of a double pendulum: fast decay, slow swing.
#[test]
fn stiffness_is_found_and_both_methods_agree() {
    let mut model = double_pendulum();
    model["forces"] = json!({ "hinge": { "type": "torsion_spring", "between": ["upper", "lower"],
        "stiffness": 1e4, "damping": 2e3, "free_angle": -0.7 } });
    let run = |method: &str, rtol: f64| {
        let mut model = model.clone();
        model["analysis"] = dynamics(1.0, 21, rtol);
        model["analysis"]["solver"]["method"] = json!(method);
        completed(&model)
    };
    let [auto, explicit, implicit] = ["auto", "dop853", "radau5"].map(|method| run(method, 1e-6));
    let steps = [&auto, &explicit, &implicit].map(|run| run.report.statistics.steps);
    println!("steps {steps:?}");
    assert!(10 * steps[0] < steps[1], "auto stays explicit: {steps:?}");
    let [explicit, implicit] = ["dop853", "radau5"].map(|method| run(method, 1e-9));
    for name in ["upper.angle", "lower.angle", "upper.omega"] {
        let (a, b, c) = (
            column(&explicit, name),
            column(&implicit, name),
            column(&auto, name),
        );
        let far = |x: &[f64], y: &[f64]| {
            x.iter()
                .zip(y)
                .fold(0.0, |m: f64, (x, y)| m.max((x - y).abs()))
        };
        println!("{name}: {:e}, auto {:e}", far(&a, &b), far(&a, &c));
        assert!(far(&a, &b) <= 1e-7, "{name}: {:e}", far(&a, &b));
        assert!(far(&a, &c) <= 1e-4, "{name}: {:e}", far(&a, &c));
    }
}

/// The pendulum of IFToMM A01 over 10 s: error of the angle against a run at 1e-13, which the case `a01-pendulum-exact`
/// holds against elliptic functions.
#[test]
fn errors_follow_the_tolerance() {
    /// Largest error of SciPy 1.17's DOP853 for θ″ = −g cos θ, θ(0) = π, at the same outputs and tolerances (atol = 1e-3 rtol), against
    /// elliptic functions.
    const SCIPY: [f64; 6] = [5.9e-4, 1.41e-4, 7.74e-7, 2.85e-8, 5.4e-9, 8.5e-10];
    let bodies = json!({ "ground": { "points": { "O": [0.0, 0.0] } },
        "bob": { "mass": 1.0, "inertia": 0.0, "com": [1.0, 0.0], "points": { "O": [0.0, 0.0] }, "pose": { "angle": PI } } });
    let mut pendulum = model(
        bodies,
        json!({ "pin": pin("ground.O", "bob.O") }),
        json!({}),
    );
    pendulum["initial"] = json!({ "bob": { "angle": PI, "angular_velocity": 0.0 } });
    let mut angle = |rtol: f64| {
        pendulum["analysis"] = dynamics(10.0, 21, rtol);
        column(&completed(&pendulum), "bob.angle")
    };
    let exact = angle(1e-13);
    let errors: Vec<f64> = (5..=10)
        .map(|digits| {
            let ours = angle(10.0_f64.powi(-digits));
            ours.iter()
                .zip(&exact)
                .fold(0.0, |m: f64, (a, b)| m.max((a - b).abs()))
        })
        .collect();
    // Least squares through (log rtol, log error).
    let logs: Vec<f64> = errors.iter().map(|error| error.log10()).collect();
    let mean = logs.iter().sum::<f64>() / 6.0;
    let slope = logs
        .iter()
        .enumerate()
        .map(|(k, log)| (2.5 - k as f64) * (log - mean))
        .sum::<f64>()
        / 17.5;
    println!("{errors:?}, slope {slope}");
    // SciPy's own is 1.25.
    assert!((0.8..=1.35).contains(&slope), "{errors:?}, slope {slope}");
    for (ours, scipy) in errors.iter().zip(SCIPY) {
        assert!(*ours <= 3.0 * scipy, "{errors:?} against {SCIPY:?}");
    }
}

/// A body that falls along a guide gets far beyond the mechanism's own size: x = g t²/2.
#[test]
fn a_body_falls_far_along_its_guide() {
    let bodies = json!({ "ground": { "points": { "O": [0.0, 0.0] } },
        "block": { "mass": 1.3, "inertia": 0.0, "com": [0.0, 0.0], "points": { "P": [0.0, 0.0] } } });
    let guide = json!({ "type": "prismatic", "between": ["ground.O", "block.P"], "axis": [1, 0] });
    let mut falling = model(bodies, json!({ "guide": guide }), json!({}));
    falling["gravity"] = json!([9.81, 0.0]);
    falling["analysis"] = dynamics(300.0, 4, 1e-8);
    let outcome = completed(&falling);
    for (time, x) in column(&outcome, "time")
        .into_iter()
        .zip(column(&outcome, "block.x"))
    {
        let wanted = 0.5 * 9.81 * time * time;
        assert!(
            (x - wanted).abs() <= 1e-10 * wanted.max(1.0),
            "{x} for {wanted}"
        );
    }
    assert!(
        outcome.report.statistics.steps < 1000,
        "{:?}",
        outcome.report.statistics
    );
}

/// A wheel that turns evenly about its centre of mass, driven or free: no power flows, and what is left of it is round-off of
/// the powers that its motion could have.
#[test]
fn round_off_is_no_imbalance_where_no_power_flows() {
    let bodies = json!({ "ground": { "points": { "O": [0.3, 0.7] } },
        "wheel": { "mass": 3.0, "inertia": 0.2, "com": [0.1, 0.05], "points": { "O": [0.1, 0.05], "A": [0.4, 0.3] },
                   "pose": { "position": [0.2, 0.65], "angle": 0.0 } } });
    let joints = json!({ "o": pin("ground.O", "wheel.O") });
    let turning = json!({ "type": "constant_velocity", "start": 0.3, "velocity": 7.0 });
    let wheel = model(
        bodies,
        joints,
        json!({ "motor": { "type": "rotation", "body": "wheel", "motion": turning } }),
    );
    let mut free = wheel.clone();
    free["drivers"] = json!({});
    free["initial"] = json!({ "wheel": { "angular_velocity": 7.0 } });
    free["analysis"] = dynamics(1.0, 101, 1e-9);
    for model in [wheel, free] {
        let quality = completed(&model).report.quality;
        assert!(
            quality.power_imbalance.expect("forces are known") < 1e-8,
            "{quality:?}"
        );
    }
}
