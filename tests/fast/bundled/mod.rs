//! Every bundled model runs, and says one thing each that is known without running it.

mod lines;
mod loads;
mod machines;
mod motions;
mod walking;

use crate::benchmarks;
use crate::mechanisms::close;
use crate::models::{checked, load_bundled, solve, values};
use linkdyn_engine::analysis::{Control, Outcome, modes};
use linkdyn_model::bundled;
use linkdyn_output::{EventKind, Status};
use std::f64::consts::{FRAC_PI_6, PI, SQRT_2, TAU};

/// A few ulps of the sizes that occur (0.1 … 1 m, some rad), through a solution of some ten equations.
const ROUND_OFF: f64 = 1e-13;

#[test]
fn every_model_runs_and_tells_about_itself() {
    for bundled in bundled::MODELS {
        let loaded = linkdyn_model::load(bundled.text.as_bytes(), &[]).expect(bundled.name);
        assert!(
            loaded.warnings.is_empty(),
            "{}: {:?}",
            bundled.name,
            loaded.warnings
        );
        let model = loaded.model;
        assert!(
            model.name.is_some() && model.about.is_some() && model.source.is_some(),
            "{}",
            bundled.name
        );
        let outcome = solve(&model);
        assert_eq!(
            outcome.report.status,
            Status::Completed,
            "{}: {:?}",
            bundled.name,
            outcome.report.message
        );
        // The redundant crank is what that model is for.
        let expected = usize::from(bundled.name == "parallel-crank");
        assert_eq!(
            outcome.report.warnings.len(),
            expected,
            "{}: {:?}",
            bundled.name,
            outcome.report.warnings
        );
    }
}

/// The rocker's angle from the triangle O4 A B (Freudenstein's loop, solved by the law of cosines).
#[test]
fn the_four_bar_closes_by_the_law_of_cosines() {
    let outcome = solve(&load_bundled("four-bar", &[]));
    let (crank, rocker) = (
        values(&outcome, "crank.angle"),
        values(&outcome, "rocker.angle"),
    );
    for (theta, psi) in crank.into_iter().zip(rocker) {
        let (dx, dy) = (0.1 * theta.cos() - 0.3, 0.1 * theta.sin());
        let diagonal = dx.hypot(dy);
        let corner =
            ((diagonal * diagonal + 0.2 * 0.2 - 0.25 * 0.25) / (2.0 * diagonal * 0.2)).acos();
        close((psi - (dy.atan2(dx) - corner)).sin(), 0.0, ROUND_OFF);
    }
}

#[test]
fn the_slider_crank_strokes_twice_its_crank() {
    let outcome = solve(&load_bundled("slider-crank", &[]));
    let x = values(&outcome, "piston.x");
    let (low, high) = x.iter().fold((f64::MAX, f64::MIN), |(low, high), &x| {
        (low.min(x), high.max(x))
    });
    close(high - low, 2.0 * 0.05, ROUND_OFF);
    assert!(
        values(&outcome, "piston.y")
            .iter()
            .all(|y| y.abs() <= ROUND_OFF)
    );
    // At the outer dead centre the piston is decelerated by r ω² (1 + r/l).
    let omega = TAU * 50.0;
    let known = -0.05 * omega * omega * (1.0 + 0.05 / 0.2);
    close(
        values(&outcome, "piston.ax")[0],
        known,
        ROUND_OFF * known.abs(),
    );
}

/// The arm turns where it touches the crank's circle: its swing is 2 asin(r/d), and the crank turns by π + swing on the way
/// forth and by π − swing on the way back, a time ratio of 2 for r/d = 1/2.
#[test]
fn the_quick_return_is_quick_by_its_time_ratio() {
    let outcome = solve(&load_bundled("quick-return", &[]));
    let angle = outcome.trajectory.column_index("arm.angle").expect("there");
    let extremes = outcome.trajectory.extremes()[angle].expect("there");
    close(extremes.max - extremes.min, 2.0 * FRAC_PI_6, ROUND_OFF);
    // Starts at the lower turning point, 120 instants a third of a turn.
    let turns = values(&outcome, "driver.motor.value")
        .iter()
        .position(|theta| *theta > PI * 7.0 / 6.0 - 1e-9);
    close(extremes.max_time, 240.0 / 360.0, 1e-12);
    assert_eq!(turns, Some(240));
    let omega = values(&outcome, "arm.omega");
    let forth = omega.iter().filter(|omega| **omega > 1e-9).count() as f64;
    let back = omega.iter().filter(|omega| **omega < -1e-9).count() as f64;
    close((forth + 1.0) / (back + 1.0), 2.0, 1e-12);
}

#[test]
fn the_plate_on_parallel_cranks_does_not_turn() {
    let outcome = solve(&load_bundled("parallel-crank", &[]));
    for (column, scale) in [
        ("plate.angle", 1.0),
        ("plate.omega", TAU),
        ("plate.alpha", TAU * TAU),
    ] {
        let largest = values(&outcome, column)
            .iter()
            .fold(0.0, |m: f64, value| m.max(value.abs()));
        assert!(largest <= ROUND_OFF * scale, "{column}: {largest:e}");
    }
    assert_eq!(
        (
            outcome.report.mobility.grubler,
            outcome.report.mobility.rank
        ),
        (0, 1)
    );
    // Vertical equilibrium: what the ground carries is the weight and what lifts the masses.
    let carried = ["p", "q", "r"].map(|joint| values(&outcome, &format!("joint.{joint}.fy")));
    let lift = values(&outcome, "plate.ay");
    for k in 0..lift.len() {
        // Centres of the cranks at half their length move by half of what the plate does.
        let known = 5.8 * 9.81 + (4.0 + 3.0 * 0.6 * 0.5) * lift[k];
        close(carried.iter().map(|fy| fy[k]).sum(), known, 1e-11);
    }
}

/// The change point as computed with 50 digits (`validation/lock-ideal/SOURCE.md`).
#[test]
fn the_lock_passes_its_change_point() {
    let outcome = solve(&load_bundled("lock", &[]));
    let events = &outcome.report.events;
    assert_eq!(
        events.iter().map(|event| event.kind).collect::<Vec<_>>(),
        [EventKind::ChangePoint]
    );
    let value = events[0].value.expect("a driver value").to_degrees();
    close(value, 117.512206516641, 1e-8);
    println!("change point off by {:e} deg", value - 117.512206516641);
}

/// The path of a point.
fn path(outcome: &Outcome, point: &str) -> Vec<[f64; 2]> {
    values(outcome, &format!("{point}.x"))
        .into_iter()
        .zip(values(outcome, &format!("{point}.y")))
        .map(|(x, y)| [x, y])
        .collect()
}

/// Largest distance of two paths.
fn apart(ours: &[[f64; 2]], known: &[[f64; 2]]) -> f64 {
    assert_eq!(ours.len(), known.len());
    ours.iter()
        .zip(known)
        .map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1]))
        .fold(0.0, f64::max)
}

fn range(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| {
        [low.min(value), high.max(value)]
    })
}

/// The ram stands still where the pin crosses the line of the ram: α = asin(d/r) = 30° below, time ratio
/// (180 + 2α)/(180 − 2α) = 2; its stroke is twice the arm.
#[test]
fn the_whitworth_ram_comes_back_in_half_the_time() {
    let outcome = solve(&load_bundled("whitworth", &[]));
    let (x, v) = (values(&outcome, "ram.x"), values(&outcome, "ram.vx"));
    let [left, right] = range(x.iter().copied());
    close(right - left, 2.0 * 0.1, ROUND_OFF);
    for dead_centre in [0, 240, 360] {
        close(v[dead_centre], 0.0, 10.0 * ROUND_OFF);
    }
    assert!(v[1..240].iter().all(|v| *v > 0.0) && v[241..360].iter().all(|v| *v < 0.0));
}

/// Twice the lengths: twice every arm and centre of mass, four times the square of the radius of gyration.
#[test]
fn bundled_models_change_size_as_a_whole() {
    let mut resized = 0;
    for bundled in bundled::MODELS {
        let document: serde_json::Value = serde_json::from_str(bundled.text).expect("JSON");
        let Some(parameters) = document["parameters"].as_object() else {
            continue;
        };
        let lengths = parameters.iter().filter_map(|(name, value)| {
            let (number, unit) = value.as_str().filter(|_| name != "note")?.split_once(' ')?;
            let number: f64 = number.parse().ok()?;
            ["m", "cm", "mm"]
                .contains(&unit)
                .then(|| format!("parameters.{name}={} {unit}", 2.0 * number))
        });
        let sets: Vec<String> = lengths.collect();
        assert!(!sets.is_empty(), "{}", bundled.name);
        let small = linkdyn_model::load(bundled.text.as_bytes(), &[])
            .expect("sound")
            .model;
        let loaded = linkdyn_model::load(bundled.text.as_bytes(), &sets).expect("sound");
        assert!(
            loaded.warnings.is_empty(),
            "{}: {:?}",
            bundled.name,
            loaded.warnings
        );
        for (name, body) in small.bodies.iter().filter(|(name, _)| *name != "ground") {
            let (what, large) = (
                format!("{} {name}", bundled.name),
                &loaded.model.bodies[name],
            );
            let near = |a: f64, b: f64| (a - b).abs() <= 1e-12 * b.abs();
            let twice = |a: [f64; 2], b: [f64; 2]| near(a[0], 2.0 * b[0]) && near(a[1], 2.0 * b[1]);
            assert!(
                body.points
                    .iter()
                    .all(|(point, at)| twice(large.points[point], *at)),
                "{what}"
            );
            let arm = body
                .points
                .values()
                .fold(0.0, |arm: f64, at| arm.max(at[0].hypot(at[1])));
            let (Some(mass), Some(inertia), Some(com)) = (body.mass, body.inertia, body.com) else {
                continue;
            };
            // A body of one point, such as a piston, is the same at every stroke.
            if arm > 0.0 {
                let (m, j) = (large.mass.expect("mass"), large.inertia.expect("inertia"));
                assert!(twice(large.com.expect("com"), com), "{what}");
                // A point mass is as heavy as it was.
                assert!(
                    inertia == 0.0 || m >= 2.0 * mass,
                    "{what}: {m} kg and {mass} kg"
                );
                assert!(
                    near(j / m, 4.0 * inertia / mass),
                    "{what}: {j} kg m^2 and {inertia} kg m^2"
                );
            }
        }
        resized += 1;
    }
    assert!(resized >= 16, "{resized}");
}
