//! Mechanisms of one degree of freedom: what is known of their curve between the points that were solved for.

use super::free;
use crate::allocations::{compiled, start};
use crate::benchmarks;
use linkdyn_engine::mechanism::driven::Failure;
use linkdyn_engine::mechanism::reduced::Reduced;
use linkdyn_engine::system::System;
use linkdyn_model::bundled;
use serde_json::{Value, json};
use std::f64::consts::PI;

/// Places of the independent coordinate that are tried.
const PLACES: usize = 400;
/// Its rate [rad/s].
const RATE: f64 = 3.0;

/// Where nothing is solved: largest difference of position, velocity and acceleration from the equations' own, of the largest of them, and the
/// part of such places. Those beyond dead centres are none.
fn known(json: &Value, lag: f64) -> (f64, f64) {
    let system: System = compiled(json);
    let (mut reduced, y) = start(&system);
    reduced.set_lag(lag);
    let (mut known, mut largest) = (0, 0.0_f64);
    for place in 0..PLACES {
        // More than a turn to both sides, and no place twice.
        let u = y[0] + 8.0 * (place as f64 / PLACES as f64 - 0.5);
        let before = reduced.work();
        if reduced.evaluate(0.0, &[u, RATE]).is_err() {
            continue;
        }
        if reduced.work() != before {
            continue;
        }
        known += 1;
        let found = [
            reduced.position(),
            reduced.velocity(),
            reduced.acceleration(),
        ]
        .map(<[f64]>::to_vec);
        reduced
            .evaluate_exactly(0.0, &[u, RATE])
            .expect("solved once");
        let exact = [
            reduced.position(),
            reduced.velocity(),
            reduced.acceleration(),
        ];
        for (found, exact) in found.iter().zip(exact) {
            let size = exact.iter().fold(1.0, |size: f64, x| size.max(x.abs()));
            let off = found.iter().zip(exact).map(|(a, b)| (a - b).abs() / size);
            largest = off.fold(largest, f64::max);
        }
    }
    (largest, known as f64 / PLACES as f64)
}

#[test]
fn curves_are_known_as_well_as_is_wanted() {
    for json in [
        benchmarks::pendulum(),
        benchmarks::four_bars(1),
        benchmarks::four_bars(20),
        // Of so many bodies nodes are few.
        benchmarks::four_bars(200),
        benchmarks::squeezer(),
        serde_json::from_str(bundled::find("engine").expect("bundled").text).expect("valid JSON"),
    ] {
        for lag in [1e-8, 1e-9] {
            let (off, part) = known(&json, lag);
            println!("{}: {off:e} {part} at {lag:e}", json["name"]);
            assert!(off <= 10.0 * lag, "{}: {off:e} at {lag:e}", json["name"]);
            assert!(part >= 0.6, "{}: {part} at {lag:e}", json["name"]);
        }
    }
}

/// Under weights alone: largest difference of ü from the equations' own, of the largest of them, and the part of the places at which
/// no position was worked out for it.
fn along(json: &Value, lag: f64) -> (f64, f64) {
    let system: System = compiled(json);
    let (mut reduced, y) = start(&system);
    reduced.set_lag(lag);
    let (mut known, mut pairs) = (0, Vec::new());
    for place in 0..PLACES {
        let u = y[0] + 8.0 * (place as f64 / PLACES as f64 - 0.5);
        let y = [u, RATE * (place as f64).sin()];
        let before = reduced.position().to_vec();
        if reduced.evaluate_within(0.0, &y).is_err() {
            continue;
        }
        let found = reduced.accelerations()[0];
        known += usize::from(reduced.position() == before);
        reduced.evaluate_exactly(0.0, &y).expect("solved once");
        pairs.push([found, reduced.accelerations()[0]]);
    }
    let size = pairs
        .iter()
        .fold(0.0, |size: f64, [_, exact]| size.max(exact.abs()));
    let off = pairs
        .iter()
        .map(|[found, exact]| (found - exact).abs() / size);
    (off.fold(0.0, f64::max), known as f64 / PLACES as f64)
}

/// A bundled mechanism without its driver.
fn swinging(name: &str) -> Value {
    let mut json = free(name);
    json["analysis"] = json!({ "type": "dynamics", "end": 1, "outputs": 2 });
    json
}

/// A slider-crank in which next to all mass is in the slider: beside its dead centres next to nothing moves.
fn light_crank() -> Value {
    let mut json = swinging("slider-crank");
    for body in ["crank", "rod"] {
        json["bodies"][body]["mass"] = json!("1 mg");
        json["bodies"][body]["inertia"] = json!("1e-9 kg*m^2");
    }
    json
}

#[test]
fn weights_alone_are_known_along_the_curve() {
    for json in [
        benchmarks::pendulum(),
        benchmarks::four_bars(1),
        benchmarks::four_bars(20),
        benchmarks::four_bars(200),
        swinging("four-bar"),
        swinging("slider-crank"),
    ] {
        // The curves of the last two are not known everywhere to the second.
        for (lag, least) in [(1e-8, 0.95), (1e-9, 0.4)] {
            let (off, part) = along(&json, lag);
            println!("{}: {off:e} {part} at {lag:e}", json["name"]);
            assert!(off <= lag, "{}: {off:e} at {lag:e}", json["name"]);
            assert!(part >= least, "{}: {part} at {lag:e}", json["name"]);
        }
    }
}

#[test]
fn weights_that_next_to_nothing_resists_are_known_no_worse() {
    let system: System = compiled(&light_crank());
    let (mut reduced, _) = start(&system);
    let lag = 1e-8;
    reduced.set_lag(lag);
    for k in -20..=20 {
        for centre in [0.0, PI] {
            let y = [centre + 1e-4 * f64::from(k), RATE];
            let mut found = |evaluate: &dyn Fn(&mut Reduced) -> Result<(), Failure>| {
                evaluate(&mut reduced).expect("a regular point");
                reduced.accelerations()[0]
            };
            let within = found(&|reduced| reduced.evaluate_within(0.0, &y));
            let places = found(&|reduced| reduced.evaluate(0.0, &y));
            let exact = found(&|reduced| reduced.evaluate_exactly(0.0, &y));
            let [within, places] = [within, places].map(|found| (found / exact - 1.0).abs());
            assert!(
                within <= f64::max(2.0 * places, 0.1 * lag),
                "{within:e} and {places:e} at {}",
                y[0]
            );
        }
    }
}

#[test]
fn what_looks_at_places_is_told_of_them() {
    // A spring and a damper pull by what they see, which is another thing at each point.
    let mut sprung = benchmarks::pendulum();
    sprung["bodies"]["ground"]["points"]["S"] = json!([0.5, 1]);
    sprung["forces"] = json!({ "s": { "type": "spring", "between": ["ground.S", "rod.P"],
                                      "stiffness": 30, "free_length": 0.5, "damping": 2 } });
    let (off, part) = along(&sprung, 1e-10);
    assert!(off <= 1e-9, "{off:e}");
    assert_eq!(part, 0.0);
}
