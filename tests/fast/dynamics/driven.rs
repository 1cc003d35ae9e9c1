//! Drivers among free coordinates, and both directions of dynamics.

use super::*;

/// The upper rod driven, the lower free: a rod on a moving hinge, by its own equation.
#[test]
fn a_driven_body_carries_a_free_one() {
    let mut model = double_pendulum();
    model["initial"] = json!({ "lower": { "angle": -0.4, "angular_velocity": -1.0 } });
    model["drivers"] = json!({ "motor": { "type": "rotation", "body": "upper",
        "motion": { "type": "harmonic", "offset": 0.3, "amplitude": 0.5, "frequency": 1.5 } } });
    model["analysis"] = dynamics(4.0, 81, 1e-12);
    let run = completed(&model);
    assert_eq!(
        (run.report.mobility.rank, run.report.mobility.drivers),
        (2, 1)
    );
    let [time, angle, upper] =
        ["time", "lower.angle", "driver.motor.value"].map(|name| column(&run, name));
    // θ'' = −(3/2l) ((g + ÿ) cos θ − ẍ sin θ) of a uniform rod on a hinge that moves, by small classical Runge–Kutta steps.
    let hinge = |t: f64| {
        let (w, a) = (2.0 * PI * 1.5, 0.5);
        let (theta, rate, second) = (
            0.3 + a * (w * t).sin(),
            a * w * (w * t).cos(),
            -a * w * w * (w * t).sin(),
        );
        [
            -theta.sin() * second - theta.cos() * rate * rate,
            theta.cos() * second - theta.sin() * rate * rate,
        ]
    };
    let second = |t: f64, theta: f64| {
        let [ax, ay] = hinge(t);
        -1.5 / 0.8 * ((9.81 + ay) * theta.cos() - ax * theta.sin())
    };
    let (mut t, mut theta, mut omega, h) = (0.0, -0.4, -1.0, 1.0 / 20_000.0);
    for k in 0..time.len() {
        assert!(
            (theta - angle[k]).abs() <= 1e-9,
            "{:e} at {t}",
            theta - angle[k]
        );
        assert!((upper[k] - 0.3 - 0.5 * (3.0 * PI * time[k]).sin()).abs() <= 1e-14);
        for _ in 0..1000 {
            let k1 = (omega, second(t, theta));
            let k2 = (
                omega + 0.5 * h * k1.1,
                second(t + 0.5 * h, theta + 0.5 * h * k1.0),
            );
            let k3 = (
                omega + 0.5 * h * k2.1,
                second(t + 0.5 * h, theta + 0.5 * h * k2.0),
            );
            let k4 = (omega + h * k3.1, second(t + h, theta + h * k3.0));
            theta += h / 6.0 * (k1.0 + 2.0 * k2.0 + 2.0 * k3.0 + k4.0);
            omega += h / 6.0 * (k1.1 + 2.0 * k2.1 + 2.0 * k3.1 + k4.1);
            t += h;
        }
    }
    assert!(
        run.report
            .quality
            .power_imbalance
            .expect("forces are known")
            <= 1e-12,
        "{:?}",
        run.report.quality
    );
}

/// The effort that inverse dynamics finds for a motion, applied as a torque, brings the motion about.
#[test]
fn inverse_dynamics_undoes_forward_dynamics() {
    let mut driven = slider_crank(
        0.1,
        0.3,
        0.5,
        false,
        &json!({ "type": "harmonic", "offset": 0.5, "amplitude": 0.8,
        "frequency": 1.0 }),
    );
    driven["analysis"] = json!({ "type": "inverse_dynamics", "end": 1.0, "outputs": 4001 });
    let inverse = completed(&driven);
    let (time, effort) = (
        column(&inverse, "time"),
        column(&inverse, "driver.motor.effort"),
    );
    let points: Vec<[f64; 2]> = time
        .iter()
        .zip(&effort)
        .map(|(t, effort)| [*t, *effort])
        .collect();
    let mut free = driven.clone();
    free.as_object_mut().expect("a map").remove("drivers");
    free["forces"] = json!({ "motor": { "type": "torque", "body": "crank",
        "value": { "type": "table", "points": points } } });
    let omega = 0.8 * 2.0 * PI;
    free["initial"] = json!({ "crank": { "angle": 0.5, "angular_velocity": omega } });
    free["analysis"] = dynamics(1.0, 41, 1e-10);
    let forward = completed(&free);
    for name in [
        "crank.angle",
        "slider.x",
        "crank.omega",
        "rod.alpha",
        "joint.a.fx",
        "joint.b.fy",
    ] {
        let (known, ours) = (column(&inverse, name), column(&forward, name));
        let scale = known.iter().fold(1.0, |m: f64, value| m.max(value.abs()));
        let off = ours.iter().enumerate().fold(0.0, |m: f64, (k, value)| {
            m.max((value - known[100 * k]).abs())
        });
        println!("{name}: {:e}", off / scale);
        // The spline through 4001 points is good to h² at its natural ends, over h, and to h⁴ between.
        assert!(off <= 1e-6 * scale, "{name}: {off:e} of {scale}");
    }
}

#[test]
fn a_free_start_in_a_flat_position_is_refused_with_the_reason() {
    let mut model = parallelogram(
        1,
        false,
        0.0,
        &json!({ "type": "polynomial", "coefficients": [0.0] }),
    );
    model.as_object_mut().expect("a map").remove("drivers");
    model["initial"] = json!({ "c0": { "angle": 0.0, "angular_velocity": 1.0 } });
    model["analysis"] = dynamics(1.0, 11, 1e-8);
    let run = outcome(&model);
    assert_eq!(run.report.status, Status::Singular);
    assert!(
        run.report
            .message
            .as_deref()
            .is_some_and(|m| m.contains("singular position")),
        "{:?}",
        run.report.message
    );
    assert!(run.trajectory.is_empty());
}
