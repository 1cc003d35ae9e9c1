//! The implicit method with sparse matrices, against closed forms, the dense way and the explicit method.

use super::energy_drift;
use crate::mechanisms::{column, model, pin, rod};
use crate::row::{PERIODS, RATIO, Row};
use linkdyn_engine::analysis::Outcome;
use linkdyn_output::Status;
use serde_json::{Value, json};
use std::f64::consts::{FRAC_PI_2, PI};

fn solved(json: &Value, method: &str, accelerations: &str, rtol: f64) -> Outcome {
    let mut json = json.clone();
    json["analysis"]["solver"] =
        json!({ "method": method, "accelerations": accelerations, "rtol": rtol, "atol": rtol });
    let outcome = crate::mechanisms::outcome(&json);
    let report = &outcome.report;
    assert_eq!(report.status, Status::Completed, "{:?}", report.message);
    outcome
}

/// Largest difference of a column [SI units].
fn difference(one: &Outcome, other: &Outcome, names: &[String]) -> f64 {
    let of = |name: &String| {
        let (a, b) = (column(one, name), column(other, name));
        a.iter()
            .zip(b)
            .map(|(a, b)| (a - b).abs())
            .fold(0.0, f64::max)
    };
    names.iter().map(of).fold(0.0, f64::max)
}

/// The closed form holds its own equations, and the fastest mode, by power iteration, is as fast as it should be.
#[test]
fn the_row_has_the_frequencies_it_says() {
    for masses in [3, 10, 100] {
        let row = Row::new(masses);
        let force = |x: &[f64]| -> Vec<f64> {
            let at = |j: Option<usize>| j.and_then(|j| x.get(j)).copied();
            let pull = |j: usize, other: Option<usize>| {
                at(other).map_or(0.0, |there| row.stiffness * (there - x[j]))
            };
            (0..masses)
                .map(|j| {
                    let ground = if j == 0 { -row.soft * x[0] } else { 0.0 };
                    pull(j, j.checked_sub(1)) + pull(j, Some(j + 1)) + ground
                })
                .collect()
        };
        let places: Vec<f64> = (0..masses).map(|j| row.place(j, 0.0)).collect();
        let slowest = (2.0 * PI).powi(2);
        let worst = force(&places)
            .iter()
            .zip(&places)
            .map(|(force, x)| (force + slowest * x).abs())
            .fold(0.0, f64::max);
        // Differences of places of 1 m times the stiffness.
        assert!(worst < 4e-16 * row.stiffness, "{masses}: {worst:e}");
        let mut x: Vec<f64> = (0..masses)
            .map(|j| if j % 2 == 0 { 1.0 } else { -1.1 })
            .collect();
        let mut square = 0.0;
        for _ in 0..200_000 / masses {
            let next = force(&x);
            square = next.iter().map(|f| f * f).sum::<f64>().sqrt();
            x = next.iter().map(|f| f / square).collect();
        }
        let ratio = (square / slowest).sqrt() / RATIO;
        assert!((ratio - 1.0).abs() < 1e-3, "{masses}: {ratio}");
    }
}

#[test]
fn a_stiff_row_follows_its_slowest_mode() {
    let row = Row::new(20);
    let json = row.json("radau5");
    for (rtol, most) in [(1e-6, 1e-5), (1e-8, 1e-7)] {
        let outcome = solved(&json, "radau5", "auto", rtol);
        let times = column(&outcome, "time");
        assert_eq!(times.last(), Some(&PERIODS));
        let of = |j: usize| {
            let x = column(&outcome, &format!("m{j}.x"));
            let off = x.iter().zip(&times);
            off.map(|(x, t)| (x - row.place(j, *t)).abs())
                .fold(0.0, f64::max)
        };
        let worst = (0..row.masses).map(of).fold(0.0, f64::max);
        let steps = outcome.report.statistics.steps;
        println!("rtol {rtol}: {worst:e} in {steps} steps");
        assert!(worst < most, "rtol {rtol}: {worst:e}");
        // The fastest mode has 10⁵ periods.
        assert!(steps < 200, "{steps} steps");
    }
}

/// Rods of 1 m with stiff torsion springs and dampers in their pins; as a ladder with rungs and a second side, from the first rung
/// on, that close loops.
fn rods(links: usize, is_ladder: bool, damping: f64) -> Value {
    let mut bodies = json!({ "ground": { "points": { "O": [0, 0] } } });
    let mut joints = json!({});
    let mut forces = json!({});
    for k in 0..links {
        for (side, y) in [("a", 0.0), ("b", 1.0)] {
            if side == "b" && (!is_ladder || k == 0) {
                continue;
            }
            bodies[format!("{side}{k}")] = rod(1.0, [k as f64, y], 0.0);
            let before = match (k, side) {
                (0, "a") => "ground.O".to_owned(),
                (1, "b") => "r0.B".to_owned(),
                _ => format!("{side}{}.B", k - 1),
            };
            joints[format!("{side}{k}")] = pin(&before, &format!("{side}{k}.A"));
            let body = before.split('.').next().expect("a body");
            let free_angle = if body == "r0" { -FRAC_PI_2 } else { 0.0 };
            forces[format!("{side}{k}")] = json!({ "type": "torsion_spring",
                "between": [body, format!("{side}{k}")], "stiffness": 2e4, "damping": damping,
                "free_angle": free_angle });
        }
        if is_ladder {
            let rung = format!("r{k}");
            bodies[&rung] = rod(1.0, [(k + 1) as f64, 0.0], FRAC_PI_2);
            joints[format!("c{k}")] = pin(&format!("a{k}.B"), &format!("{rung}.A"));
            if k > 0 {
                joints[format!("d{k}")] = pin(&format!("b{k}.B"), &format!("{rung}.B"));
            }
        }
    }
    let mut rods = model(bodies, joints, json!({}));
    rods["forces"] = forces;
    rods["gravity"] = json!([0, -9.81]);
    rods["analysis"] = json!({ "type": "dynamics", "end": 0.5, "outputs": 11 });
    rods
}

#[test]
fn stiff_chains_and_loops_are_the_same_all_ways() {
    for (name, json) in [
        ("chain", rods(6, false, 2.0)),
        ("ladder", rods(6, true, 2.0)),
    ] {
        let exact = solved(&json, "dop853", "dense", 1e-10);
        let names: Vec<String> = (0..6)
            .flat_map(|k| ["x", "y", "angle"].map(|axis| format!("a{k}.{axis}")))
            .collect();
        for rtol in [1e-5, 1e-7] {
            let [dense, sparse] = ["dense", "sparse"].map(|way| solved(&json, "radau5", way, rtol));
            let off = [&dense, &sparse].map(|outcome| difference(outcome, &exact, &names));
            let evaluations = [&dense, &sparse].map(|o| o.report.statistics.evaluations);
            println!("{name}, rtol {rtol}: {off:?}, {evaluations:?} evaluations");
            assert!(off[1] < 30.0 * rtol, "{name}, rtol {rtol}: {off:?}");
            assert!(evaluations[1] < evaluations[0], "{evaluations:?}");
        }
    }
}

#[test]
fn energy_stays_where_nothing_takes_it() {
    let json = rods(6, false, 0.0);
    let drift = energy_drift(&solved(&json, "radau5", "sparse", 1e-9));
    assert!(drift < 1e-6, "{drift:e}");
}

/// Slides one upon the other, each inclined, on ground, on a crank that turns or on a cart that is driven to and fro; on request a
/// pendulum on the last.
fn slides(base: &str, has_pendulum: bool) -> Value {
    let mut json = json!({
        "format": "linkdyn/1", "units": { "angle": "rad" }, "gravity": [0, -9.81],
        "bodies": { "ground": { "points": { "O": [0, 0] } } },
        "joints": {},
        "forces": {},
        "analysis": { "type": "dynamics", "end": 0.1, "outputs": 11 }
    });
    let mut below = "ground.O".to_string();
    if base != "ground" {
        let [joint, driver] = match base {
            "crank" => [
                json!({ "type": "revolute", "between": ["ground.O", "crank.O"] }),
                json!({ "type": "rotation", "body": "crank",
                        "motion": { "type": "polynomial", "coefficients": [0, 3] } }),
            ],
            _ => [
                json!({ "type": "prismatic", "between": ["ground.O", "cart.O"], "axis": [1, 0.3] }),
                json!({ "type": "translation", "joint": "base",
                        "motion": { "type": "harmonic", "amplitude": 0.05, "frequency": 3 } }),
            ],
        };
        json["bodies"][base] =
            json!({ "mass": 1, "inertia": 0.1, "com": [0, 0], "points": { "O": [0, 0] } });
        json["joints"]["base"] = joint;
        json["drivers"] = json!({ "motor": driver });
        below = format!("{base}.O");
    }
    for k in 0..5 {
        let (body, number) = (format!("m{k}"), k as f64);
        json["bodies"][&body] = json!({ "mass": 1.0 + 0.3 * number, "inertia": 0.01, "com": [0, 0],
            "points": { "P": [0, 0], "Q": [0.1, 0.02] },
            "pose": { "position": [0.1 * (number + 1.0), 0.02 * (number + 1.0)] } });
        let (sine, cosine) = (0.5 * number).sin_cos();
        json["joints"][format!("s{k}")] = json!({ "type": "prismatic",
            "between": [below, format!("{body}.P")], "axis": [cosine, sine] });
        json["forces"][format!("k{k}")] = json!({ "type": "spring",
            "between": ["ground.O", format!("{body}.P")], "stiffness": 2e5 / 10.0_f64.powi(k % 3),
            "damping": if k % 2 == 1 { 3.0 } else { 0.0 }, "free_length": 0.1 * (number + 1.0) });
        below = format!("{body}.Q");
    }
    if has_pendulum {
        json["bodies"]["pendulum"] = json!({ "mass": 0.5, "inertia": 0.002, "com": [0.2, 0],
            "points": { "A": [0, 0] }, "pose": { "position": [0.6, 0.12], "angle": -0.5 } });
        json["joints"]["pin"] = json!({ "type": "revolute", "between": [below, "pendulum.A"] });
    }
    json
}

/// Coordinates that slides hold are left out of the matrices, on a cart that is driven those that follow it are not; of slides on a
/// turning crank none stands. Without the pendulum all is straight but on the crank.
#[test]
fn slides_that_stand_and_slides_that_turn_move_as_by_explicit_steps() {
    for (base, has_pendulum) in [
        ("ground", true),
        ("crank", true),
        ("cart", true),
        ("ground", false),
        ("cart", false),
    ] {
        let json = slides(base, has_pendulum);
        let expected = solved(&json, "dop853", "dense", 1e-11);
        let (dense, sparse) = (
            solved(&json, "radau5", "dense", 1e-6),
            solved(&json, "radau5", "sparse", 1e-10),
        );
        let mut bodies = vec!["m0", "m2", "m4"];
        bodies.extend(has_pendulum.then_some("pendulum"));
        let names = |what: &str| -> Vec<String> {
            let bodies = bodies.iter();
            bodies.map(|body| format!("{body}.{what}")).collect()
        };
        let places = ["x", "y", "angle"].map(names).concat();
        let of_places = difference(&sparse, &expected, &places);
        assert!(of_places < 1e-9, "{base}: {of_places:e}");
        let of_dense = difference(&dense, &expected, &places);
        assert!(of_dense < 1e-5, "{base}: {of_dense:e}");
        let mut forces = ["s0", "s4"]
            .map(|joint| format!("joint.{joint}.fy"))
            .to_vec();
        forces.extend((base != "ground").then(|| "driver.motor.effort".to_string()));
        let of_forces = difference(&sparse, &expected, &forces);
        assert!(of_forces < 1e-5, "{base}: {of_forces:e} N of some 2000 N");
    }
}
