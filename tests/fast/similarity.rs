//! A mechanism and its enlargement by similarity, with masses and times of their own, move alike: tolerances are measured by
//! the mechanism's own length, mass and time, none by metre, kilogram or second.
//!
//! With factors l, m, t of lengths, masses and times: speeds l/t, forces m l/t², moduli of elasticity m/(l t²).

mod smooth;

use crate::models::{load, solve};
use linkdyn_engine::analysis::Outcome;
use linkdyn_model::bundled;
use linkdyn_output::Status;
use serde_json::{Value, json};
use std::f64::consts::PI;

/// Length of the connecting rod, the longest body [m].
const ROD: f64 = 0.12;
/// Largest distances of outputs, by the largest value in their unit.
#[derive(Clone, Copy)]
struct Near {
    /// Of lengths.
    length: f64,
    /// Of all else.
    other: f64,
}

/// With contacts. A step's error is 1e-8 of what moves; each of the impacts multiplies what was wrong before it, and forces
/// change within a hundredth of the time between outputs. Lengths are changed little by impacts.
const NEAR: Near = Near {
    length: 1e-6,
    other: 1e-3,
};
/// The same of the instants at which contacts begin [s], of 24 ms.
const NEAR_TIME: f64 = 1e-7;

/// Factors of lengths, masses and times.
#[derive(Debug, Clone, Copy)]
struct Factors {
    length: f64,
    mass: f64,
    time: f64,
}

impl Factors {
    /// With a connecting rod of this length, of the same density, and as fast as gravity would make it.
    fn with_rod(rod: f64) -> Self {
        let length = rod / ROD;
        Factors {
            length,
            mass: length.powi(3),
            time: length.sqrt(),
        }
    }

    /// Of values in a unit.
    fn of(self, unit: &str) -> Option<f64> {
        let Factors { length, mass, time } = self;
        let force = mass * length / time.powi(2);
        match unit {
            "s" => Some(time),
            "m" => Some(length),
            "m/s" => Some(length / time),
            "m/s^2" => Some(length / time.powi(2)),
            "rad" => Some(1.0),
            "rad/s" => Some(1.0 / time),
            "rad/s^2" => Some(1.0 / time.powi(2)),
            "N" => Some(force),
            "N*m" | "J" => Some(force * length),
            // What a contact does: an output beside a change may be on its other side.
            "1" => None,
            other => panic!("no dimension for {other:?}"),
        }
    }
}

/// The bundled slider-crank with clearance, enlarged.
fn slider_crank(clearance: &str, factors: Factors) -> Value {
    let Factors { length, mass, time } = factors;
    let found = bundled::find("slider-crank-clearance").expect("bundled");
    let mut model: Value = serde_json::from_str(found.text).expect("JSON");
    model["units"] = json!("SI");
    model.as_object_mut().expect("a map").remove("parameters");
    // `atol` is in SI, and would be stricter for the large one.
    model["analysis"]["solver"] = json!({ "rtol": 1e-6, "atol": 1e-30 });
    let (crank, rod) = (0.05 * length, ROD * length);
    let inertia = mass * length.powi(2);
    let set = |model: &mut Value, path: &str, value: Value| {
        *model.pointer_mut(path).unwrap_or_else(|| panic!("{path}")) = value;
    };
    let numbers = [
        ("/bodies/crank/mass", json!(0.30 * mass)),
        ("/bodies/crank/inertia", json!(1e-5 * inertia)),
        ("/bodies/crank/com", json!([crank / 2.0, 0.0])),
        ("/bodies/crank/points/A", json!([crank, 0.0])),
        ("/bodies/rod/mass", json!(0.21 * mass)),
        ("/bodies/rod/inertia", json!(2.5e-4 * inertia)),
        ("/bodies/rod/com", json!([rod / 2.0, 0.0])),
        ("/bodies/rod/points/B", json!([rod, 0.0])),
        ("/bodies/rod/pose/position", json!([crank, 0.0])),
        ("/bodies/slider/mass", json!(0.14 * mass)),
        ("/bodies/slider/pose/position", json!([crank + rod, 0.0])),
        (
            "/drivers/motor/motion/velocity",
            json!(5000.0 * PI / 30.0 / time),
        ),
        ("/analysis/end", json!(24e-3 * time)),
    ];
    for (path, value) in numbers {
        set(&mut model, path, value);
    }
    let modulus = 207e9 * mass / (length * time.powi(2));
    let of_joint = [
        ("model", json!(clearance)),
        ("radius", json!(0.5e-3 * length)),
        ("bearing_radius", json!(10e-3 * length)),
        ("normal/elastic/young_modulus", json!(modulus)),
        ("friction/threshold_velocity", json!(0.01 * length / time)),
        ("surface/stiffness", json!(1e8 * mass / time.powi(2))),
        ("surface/damping", json!(2000.0 * mass / time)),
    ];
    for (path, value) in of_joint {
        let path = format!("/joints/wristpin/clearance/{path}");
        set(&mut model, &path, value);
    }
    model
}

fn motion(clearance: &str, factors: Factors) -> Outcome {
    let outcome = solve(&load(&slider_crank(clearance, factors)));
    let report = &outcome.report;
    assert_eq!(report.status, Status::Completed, "{:?}", report.message);
    outcome
}

/// Holds the outputs of a motion against those of the enlarged mechanism, in its own units.
fn assert_alike(own: &Outcome, other: &Outcome, factors: Factors, what: &str, near: Near) {
    let (table, enlarged) = (&own.trajectory, &other.trajectory);
    let columns = || table.columns.iter().enumerate();
    let mut compared = 0;
    for (index, column) in columns() {
        let Some(factor) = factors.of(column.unit) else {
            continue;
        };
        let same_unit = columns().filter(|(_, other)| other.unit == column.unit);
        let span = same_unit
            .flat_map(|(index, _)| table.rows().map(move |row| row[index].abs()))
            .fold(0.0, f64::max);
        let off = table
            .rows()
            .zip(enlarged.rows())
            .map(|(row, other)| (row[index] - other[index] / factor).abs())
            .fold(0.0, f64::max);
        let near = if column.unit == "m" {
            near.length
        } else {
            near.other
        };
        assert!(
            off <= near * span,
            "{what}, {}: off by {:e} of the largest",
            column.name,
            off / span
        );
        compared += 1;
    }
    assert!(compared > 20, "{what}: only {compared} columns");
}

/// The same contacts, and the same outputs, of enlargements to a micrometre and to a hundred metres.
fn assert_moves_alike(clearance: &str) {
    let own = motion(clearance, Factors::with_rod(ROD));
    for rod in [1e-6, 1e2] {
        let what = format!("{clearance}, {rod:e} m");
        let factors = Factors::with_rod(rod);
        let other = motion(clearance, factors);
        let rows = |outcome: &Outcome| outcome.trajectory.rows().count();
        assert_eq!(rows(&own), rows(&other), "{what}");
        let contacts = |outcome: &Outcome| outcome.report.clearances[0].episodes;
        assert_eq!(contacts(&own), contacts(&other), "{what}");
        assert!(contacts(&own) > 20, "{what}: too few contacts");
        let starts = |outcome: &Outcome| -> Vec<f64> {
            let events = outcome.report.events.iter();
            let episodes = events.filter(|event| event.episode.is_some());
            episodes.map(|event| event.time).collect()
        };
        for (start, other) in starts(&own).iter().zip(starts(&other)) {
            let off = (start - other / factors.time).abs();
            assert!(off < NEAR_TIME, "{what}: {start} s, off by {off:e} s");
        }
        assert_alike(&own, &other, factors, &what, NEAR);
    }
}

#[test]
fn contact_forces_are_alike_at_every_size() {
    assert_moves_alike("contact");
}

#[test]
fn impacts_are_alike_at_every_size() {
    assert_moves_alike("three_state");
}
