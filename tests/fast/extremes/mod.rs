//! Extremes of columns in motions with contacts: closed forms, the events' own peaks, dense rows, and that they depend on no row.

mod rows;

use crate::mechanisms::{loaded, parallelogram};
use crate::models::{load_bundled, solve};
use linkdyn_engine::analysis::Outcome;
use linkdyn_output::{Event, EventKind, Extremes, Status};
use serde_json::json;
use std::f64::consts::PI;

#[track_caller]
fn slider_crank(sets: &[&str]) -> Outcome {
    let outcome = solve(&load_bundled("slider-crank-clearance", sets));
    assert_eq!(
        outcome.report.status,
        Status::Completed,
        "{:?}",
        outcome.report.message
    );
    outcome
}

#[track_caller]
fn extremes(outcome: &Outcome, column: &str) -> Extremes {
    let curves = outcome.curves();
    let index = curves
        .column_index(column)
        .unwrap_or_else(|| panic!("no column {column}"));
    curves.extremes()[index].unwrap_or_else(|| panic!("{column} has no value"))
}

fn contacts(outcome: &Outcome) -> Vec<&Event> {
    outcome
        .report
        .events
        .iter()
        .filter(|event| event.kind == EventKind::Contact)
        .collect()
}

#[track_caller]
fn near(what: &str, ours: f64, exact: f64, relative: f64) {
    println!("{what}: {ours:e}, off by {:e}", ours / exact - 1.0);
    assert!(
        (ours / exact - 1.0).abs() < relative,
        "{what}: {ours:e} for {exact:e}"
    );
}

const G: f64 = 9.81;
/// Mass [kg], gap [m] and speed at the start [m/s] of a disc that falls to its bearing.
const DISC: (f64, f64, f64) = (2.0, 0.002, 0.3);

fn falling_disc(normal: &serde_json::Value) -> linkdyn_model::Model {
    let (m, gap, speed) = DISC;
    let model = json!({ "format": "linkdyn/1", "units": "SI", "gravity": [0, -G],
            "bodies": { "ground": { "points": { "O": [0, 0] } },
                "disc": { "mass": m, "inertia": 1e-3, "com": [0, 0], "points": { "P": [0, 0] } } },
            "joints": { "pin": { "type": "revolute", "between": ["ground.O", "disc.P"],
                "clearance": { "model": "contact", "radius": gap, "bearing_radius": 0.05, "normal": normal } } },
            "initial": { "disc": { "vy": -speed } },
            "analysis": { "type": "dynamics", "end": 0.01, "outputs": 2, "solver": { "rtol": 1e-10 } } });
    loaded(&model).model.into_model()
}

/// A disc of 2 kg falls 2 mm to its bearing and on: ½ m v² + m g δ = K δ^(n+1)/(n + 1) where it is deepest. What it
/// presses there is K δ^n, its acceleration less by g. Two rows, neither of them near.
#[test]
fn a_falling_disc_presses_as_its_energy_says() {
    let (m, gap, speed) = DISC;
    for (law, exponent) in [("hertz", 1.5), ("kelvin_voigt", 1.0)] {
        let stiffness = if exponent == 1.0 { 1e6 } else { 1e9 };
        let mut normal = json!({ "law": law, "stiffness": stiffness });
        if law == "kelvin_voigt" {
            normal["damping"] = json!(0.0);
        }
        let outcome = solve(&falling_disc(&normal));
        // v at the surface, from the height.
        let taken = |depth: f64| {
            stiffness * depth.powf(exponent + 1.0) / (exponent + 1.0) - m * G * (depth + gap)
        };
        let (mut low, mut high) = (1e-7, 1e-2);
        while high - low > 1e-18 && 0.5 * (low + high) != low && 0.5 * (low + high) != high {
            let middle = 0.5 * (low + high);
            if taken(middle) < 0.5 * m * speed * speed {
                low = middle
            } else {
                high = middle
            }
        }
        let force = stiffness * high.powf(exponent);
        near(
            "penetration",
            extremes(&outcome, "joint.pin.penetration").max,
            high,
            1e-9,
        );
        near(
            "normal force",
            extremes(&outcome, "joint.pin.normal_force").max,
            force,
            1e-9,
        );
        near(
            "joint force",
            extremes(&outcome, "joint.pin.fy").max,
            force,
            1e-9,
        );
        near(
            "acceleration",
            extremes(&outcome, "disc.ay").max,
            force / m - G,
            1e-7,
        );
        near(
            "contact energy",
            extremes(&outcome, "energy.contact").max,
            taken(high) + m * G * (high + gap),
            1e-7,
        );
        near(
            "eccentricity",
            extremes(&outcome, "joint.pin.eccentricity").max,
            gap + high,
            1e-9,
        );
        near(
            "lowest point",
            extremes(&outcome, "disc.y").min,
            -gap - high,
            1e-7,
        );
        let fastest = extremes(&outcome, "disc.vy").min;
        // Fastest where the force has become the weight.
        let depth = (m * G / stiffness).powf(1.0 / exponent);
        let speed = (speed * speed - 2.0 * taken(depth) / m).sqrt();
        near("fastest", -fastest, speed, 1e-7);
    }
}

/// Columns and extremes of the joint are the events' own.
#[test]
fn every_contact_has_its_peak_in_the_curves() {
    let outcome = slider_crank(&[]);
    let curves = outcome.curves();
    let [time, force, depth] = [
        "time",
        "joint.wristpin.normal_force",
        "joint.wristpin.penetration",
    ]
    .map(|name| curves.values(name).expect("a column"));
    let events = contacts(&outcome);
    assert!(events.len() > 20, "{}", events.len());
    let mut largest = [0.0_f64; 2];
    let mut off_by_rows = 0;
    for event in events {
        let episode = event.episode.expect("of a contact");
        let end = episode.end.unwrap_or(f64::INFINITY);
        let within = |values: &[f64], time: &[f64]| {
            let inside = time
                .iter()
                .zip(values)
                .filter(|(time, _)| (episode.start..=end).contains(*time));
            inside.map(|(_, value)| *value).fold(0.0, f64::max)
        };
        near("force", within(&force, &time), episode.peak_force, 1e-9);
        let rows = &outcome.trajectory;
        let row_force = within(
            &rows.values("joint.wristpin.normal_force").expect("there"),
            &rows.values("time").expect("there"),
        );
        off_by_rows += usize::from(row_force < 0.5 * episode.peak_force);
        largest = [
            largest[0].max(episode.peak_force),
            largest[1].max(episode.peak_penetration),
        ];
    }
    near(
        "largest force",
        extremes(&outcome, "joint.wristpin.normal_force").max,
        largest[0],
        1e-9,
    );
    near(
        "largest penetration",
        extremes(&outcome, "joint.wristpin.penetration").max,
        largest[1],
        1e-9,
    );
    println!("of rows alone {off_by_rows} contacts would show less than half of their force");
    assert!(off_by_rows > 0 && depth.len() > outcome.trajectory.len());
}

/// A number that depends on where the rows fall is no peak.
#[test]
fn extremes_do_not_depend_on_the_outputs() {
    for (model, sets) in [
        ("contact", &[][..]),
        (
            "two_state",
            &["joints.wristpin.clearance.model=two_state"][..],
        ),
        (
            "three_state",
            &["joints.wristpin.clearance.model=three_state"][..],
        ),
    ] {
        let runs: Vec<Outcome> = [11, 101, 1001, 2001]
            .iter()
            .map(|outputs| {
                let outputs = format!("analysis.outputs={outputs}");
                slider_crank(&[sets, &["analysis.end=0.012", &outputs]].concat())
            })
            .collect();
        let first = runs[0].curves();
        let known = first.extremes();
        for run in &runs[1..] {
            let curves = run.curves();
            for ((column, a), b) in first.columns.iter().zip(&known).zip(curves.extremes()) {
                let (Some(a), Some(b)) = (a, b) else { continue };
                let owned = column.name.starts_with("joint.wristpin");
                let span = if owned {
                    a.max.abs().max(a.min.abs())
                } else {
                    a.max - a.min
                };
                // Contact's own to 1e-9; others to the tolerance; what is smaller is round-off.
                let bound = if owned { 1e-9 } else { 2e-7 } * span + 1e-9 * floor(column.unit);
                let off = (a.max - b.max).abs().max((a.min - b.min).abs());
                assert!(
                    off <= bound,
                    "{model}: {}: {a:?} and {b:?} at {} rows",
                    column.label(),
                    run.trajectory.len()
                );
            }
        }
    }
}

/// A small number in this unit, for this mechanism.
fn floor(unit: &str) -> f64 {
    match unit {
        "N" => 1e4,
        "m/s^2" | "rad/s^2" => 1e5,
        "m" => 1e-3,
        _ => 1e2,
    }
}

/// Against rows 20 ns apart, which show a peak to 2e-7: no column's extreme is less than they show, and none is much more.
#[test]
fn neighbours_have_the_extremes_of_dense_rows() {
    let sets = ["analysis.end=0.0015", "analysis.solver.rtol=1e-8"];
    let located = slider_crank(&[&sets[..], &["analysis.outputs=31"]].concat());
    let dense = slider_crank(&[&sets[..], &["analysis.outputs=75001"]].concat());
    let rows_alone = dense.trajectory.extremes();
    let coarse = located.trajectory.extremes();
    let curves = located.curves();
    let mut missed = 0;
    for (((column, ours), rows), coarse) in curves
        .columns
        .iter()
        .zip(curves.extremes())
        .zip(&rows_alone)
        .zip(coarse)
    {
        let (Some(ours), Some(rows), Some(coarse)) = (ours, rows, coarse) else {
            continue;
        };
        let span = (rows.max - rows.min) + 1e-5 * floor(column.unit);
        for (side, ours, rows, coarse) in [
            ("max", ours.max, rows.max, coarse.max),
            ("min", -ours.min, -rows.min, -coarse.min),
        ] {
            assert!(
                ours >= rows - 1e-7 * span,
                "{side} of {}: {ours:e} for {rows:e}",
                column.label()
            );
            assert!(
                ours <= rows + 1e-5 * span,
                "{side} of {}: {ours:e} for {rows:e}",
                column.label()
            );
            missed += usize::from(coarse < rows - 0.1 * span);
        }
    }
    println!("{missed} extremes would be wrong by a tenth of the range with rows alone");
    assert!(missed > 5, "{missed}");
}

/// The size of a joint's force is watched like a column.
#[test]
fn the_largest_force_of_a_joint_is_that_of_dense_rows() {
    let sets = ["analysis.end=0.0015", "analysis.solver.rtol=1e-8"];
    let largest = |outcome: &Outcome| {
        let table = outcome.curves();
        let [x, y] =
            ["fx", "fy"].map(|c| table.values(&format!("joint.crankpin.{c}")).expect("there"));
        x.iter()
            .zip(&y)
            .map(|(x, y)| x.hypot(*y))
            .fold(0.0, f64::max)
    };
    let located = largest(&slider_crank(
        &[&sets[..], &["analysis.outputs=3"]].concat(),
    ));
    let dense = largest(&slider_crank(
        &[&sets[..], &["analysis.outputs=75001"]].concat(),
    ));
    near("crankpin", located, dense, 2e-7);
}

#[test]
fn columns_that_are_left_out_are_not_watched() {
    let all = slider_crank(&["analysis.end=0.002"]);
    let few = slider_crank(&["analysis.end=0.002", "analysis.columns=[\"driver.*\"]"]);
    assert!(few.report.statistics.evaluations < all.report.statistics.evaluations);
    let (ours, theirs) = (
        extremes(&few, "driver.motor.effort"),
        extremes(&all, "driver.motor.effort"),
    );
    near("effort", ours.max, theirs.max, 1e-7);
    assert_eq!(few.curves().width(), few.trajectory.width());
}
