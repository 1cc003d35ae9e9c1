//! Columns without bound at change points: which and when, and that no row of them is called the largest.

use crate::mechanisms::{column, completed, parallelogram, pin, rod};
use linkdyn_engine::analysis::Outcome;
use linkdyn_output::EventKind;
use serde_json::{Value, json};
use std::f64::consts::PI;

/// Crank of [`parallelogram`] [m], whose rods have 1 kg, and gravity [m/s²].
const CRANK: f64 = 0.1;
const G: f64 = 9.81;

/// The columns without bound, by name, and when they have none.
fn told(run: &Outcome) -> Vec<(Vec<&str>, Vec<f64>)> {
    let told = run.report.unbounded.iter();
    told.map(|one| {
        let mut columns: Vec<&str> = one.columns.iter().map(String::as_str).collect();
        columns.sort_unstable();
        (columns, one.times.clone())
    })
    .collect()
}

fn change_points(run: &Outcome) -> Vec<f64> {
    let events = run.report.events.iter();
    let passed = events.filter(|event| event.kind == EventKind::ChangePoint);
    passed.map(|event| event.time).collect()
}

/// The forces along the line of a flat parallelogram.
const ALONG: [&str; 4] = ["joint.o0.fx", "joint.o1.fx", "joint.p0.fx", "joint.q0.fx"];

/// A crank that turns at 10 rad/s from 1 rad on, flat at π, 2π and 3π. At its right end the coupler rests on the right crank,
/// whose own weight it bears by half, so that there fx = −(½ + ½) m g cot φ + O(1): no bound. fy and the effort have one.
#[test]
fn a_driven_parallelogram_has_no_bound_along_its_line() {
    let motion = json!({ "type": "polynomial", "coefficients": [1.0, 10.0] });
    let mut model = parallelogram(1, false, 1.0, &motion);
    let run = completed(&model);
    let times: Vec<f64> = [1.0, 2.0, 3.0].map(|k| (k * PI - 1.0) / 10.0).to_vec();
    let found = told(&run);
    let [(columns, when)] = &found[..] else {
        panic!("{found:?}");
    };
    assert_eq!(columns, &ALONG);
    assert_eq!(when.len(), 3, "{when:?}");
    for (found, wanted) in when.iter().zip(&times) {
        assert!((found - wanted).abs() < 1e-12, "{found} {wanted}");
    }
    // The force as it grows, one degree and a tenth of one before the line.
    for off in [1.0_f64, 0.1].map(f64::to_radians) {
        model["analysis"] =
            json!({ "type": "inverse_dynamics", "end": (PI - off - 1.0) / 10.0, "outputs": 2 });
        let run = completed(&model);
        let fx = column(&run, "joint.q0.fx")[1];
        let size = fx.abs() * off.tan();
        assert!(
            (size / G - 1.0).abs() < 0.2 * off.sqrt() + 1e-9,
            "{fx} {size}"
        );
        assert!(told(&run).is_empty(), "not passed yet");
    }
    // Without weight the coupler goes round by forces that have a bound: nothing presses on the self-stress.
    model["gravity"] = json!([0.0, 0.0]);
    model["analysis"] = json!({ "type": "inverse_dynamics", "end": 1.0, "outputs": 101 });
    let run = completed(&model);
    assert_eq!(change_points(&run).len(), 3);
    assert_eq!(told(&run), []);
    // No forces are asked for.
    model["gravity"] = json!([0.0, -G]);
    model["analysis"]["type"] = json!("kinematics");
    assert_eq!(told(&completed(&model)), []);
}

/// The parallelogram let go, with the centre of its coupler at a place along it, and a pendulum on it where one is wanted.
fn let_go(rate: f64, centre: f64, pendulum: bool) -> Value {
    let motion = json!({ "type": "polynomial", "coefficients": [1.0] });
    let mut model = parallelogram(1, false, 1.0, &motion);
    model["drivers"] = json!({});
    model["bodies"]["h0"]["com"] = json!([centre, 0.0]);
    model["initial"] = json!({ "c0": { "angle": 1.0, "angular_velocity": rate } });
    if pendulum {
        let place = [CRANK * f64::cos(1.0) + 0.1, CRANK * f64::sin(1.0)];
        model["bodies"]["h0"]["points"]["P"] = json!([0.1, 0.0]);
        model["bodies"]["hung"] = rod(0.2, place, -1.0);
        model["joints"]["p"] = pin("h0.P", "hung.A");
        model["initial"]["hung"] = json!({ "angle": -1.0, "angular_velocity": 0.0 });
    }
    model["analysis"] = json!({ "type": "dynamics", "end": 1.0, "outputs": 51, "solver": { "rtol": 1e-10, "atol": 1e-10 } });
    model
}

/// The coupler's centre is not in its middle, so that the cranks bear unequal loads though they turn alike.
///
/// (⅔ + 1) m r² φ″ = −2 m g r cos φ: with φ̇² = ω² − 2 k (sin φ − sin 1) it is at kπ after ∫ dφ/φ̇, here by Simpson's rule.
#[test]
fn a_free_parallelogram_tells_when_it_is_flat() {
    let omega: f64 = 20.0;
    let run = completed(&let_go(omega, 0.1, false));
    let k = 2.0 * G / (5.0 / 3.0 * CRANK);
    let slowness = |phi: f64| (omega * omega - 2.0 * k * (phi.sin() - f64::sin(1.0))).powf(-0.5);
    let until = |end: f64| {
        let pieces = 2000;
        let h = (end - 1.0) / f64::from(pieces);
        let middle = |j: i32| slowness(1.0 + (f64::from(j) + 0.5) * h);
        let ends = |j: i32| slowness(1.0 + f64::from(j) * h);
        let sum = |j: i32| ends(j) + 4.0 * middle(j) + ends(j + 1);
        (0..pieces).map(sum).sum::<f64>() * h / 6.0
    };
    let found = told(&run);
    let [(columns, when)] = &found[..] else {
        panic!("{found:?}");
    };
    assert_eq!(columns, &ALONG);
    assert_eq!(when, &change_points(&run));
    assert!(when.len() > 4, "{when:?}");
    for (turn, time) in (1..).zip(when) {
        let wanted = until(f64::from(turn) * PI);
        assert!((time - wanted).abs() < 1e-9, "{turn}: {time} {wanted}");
    }
    // With it in the middle all is alike on both sides, and nothing presses on the self-stress.
    let run = completed(&let_go(omega, 0.15, false));
    assert_eq!(change_points(&run).len(), when.len());
    assert_eq!(told(&run), []);
}

/// With more freedom than one the loop is a part with a curve of its own; what hangs on it has forces with a bound.
#[test]
fn a_loop_with_a_pendulum_has_no_bound_in_the_loop_alone() {
    let run = completed(&let_go(20.0, 0.15, true));
    let found = told(&run);
    let [(columns, when)] = &found[..] else {
        panic!("{found:?}");
    };
    assert_eq!(columns, &ALONG);
    assert_eq!(when, &change_points(&run));
    // At each the cranks are on the line: between rows their angle passes a multiple of π.
    let (time, angle) = (column(&run, "time"), column(&run, "c0.angle"));
    let half_turns = |angle: f64| (angle / PI).floor();
    let rows = time.windows(2).zip(angle.windows(2));
    let passed = rows.filter(|(_, angle)| half_turns(angle[0]) != half_turns(angle[1]));
    let passed: Vec<&[f64]> = passed.map(|(time, _)| time).collect();
    assert_eq!(passed.len(), when.len(), "{when:?} {passed:?}");
    for (time, row) in when.iter().zip(passed) {
        assert!((row[0]..=row[1]).contains(time), "{time} {row:?}");
    }
}

/// The lock's loop of four bars is flat at 117.512°: its pins have no bound, those of the other loop have one.
#[test]
fn the_lock_has_no_bound_in_four_of_its_pins() {
    let text = linkdyn_model::bundled::find("watt-i-lock").expect("bundled");
    let loaded = linkdyn_model::load(text.text.as_bytes(), &[]).expect("legal");
    let control = linkdyn_engine::analysis::Control::default();
    let run = linkdyn_engine::analysis::run(&loaded.model, &control).expect("runs");
    let found = told(&run);
    let joints = |columns: &[&str]| {
        let mut joints: Vec<String> = columns
            .iter()
            .filter_map(|column| Some(column.rsplit_once('.')?.0.to_owned()))
            .collect();
        joints.dedup();
        joints
    };
    let [(columns, when)] = &found[..] else {
        panic!("{found:?}");
    };
    assert_eq!(
        joints(columns),
        ["joint.a", "joint.b", "joint.c", "joint.g"]
    );
    assert_eq!(when, &change_points(&run));
}
