//! Mechanisms with two to four freedoms in which constraints are redundant, free to move: none is refused at a regular
//! start, none stalls, energy stays, and each moves as its regular twin does, which has the same motion without redundancy.
//!
//! ```text
//! parallel cranks   plate on three or four equal cranks     twin: one body with the sum of energies on a pivot
//! doubled bar       bar from a pivot to a body turning about it   twin: the bar welded to that body
//! doubled pin       the same pin twice                      twin: once
//! box               four bars and both diagonals            twin: one diagonal welded to a side
//! ```
//!
//! Pendulums hang on each, some with a spring, some with a start in motion. `LINKDYN_REDUNDANT=20000` tries so many and
//! prints each.

mod pairs;

use crate::models::{load, solve, values};
use linkdyn_engine::analysis::Outcome;
use pairs::{Pair, pair};
use serde_json::{Value, json};

/// Largest difference of the columns that both have [rad].
fn apart(pair: &Pair, redundant: &Outcome, regular: &Outcome) -> f64 {
    let differences = pair.columns.iter().flat_map(|column| {
        let (a, b) = (values(redundant, column), values(regular, column));
        // Angles of drawings differ by whole turns at most.
        let first = a[0] - b[0];
        a.into_iter()
            .zip(b)
            .map(move |(a, b)| (a - b - first).abs())
            .collect::<Vec<_>>()
    });
    differences.fold(0.0, f64::max)
}

#[test]
fn redundant_mechanisms_move_as_their_regular_twins() {
    let count = std::env::var("LINKDYN_REDUNDANT")
        .ok()
        .and_then(|count| count.parse().ok())
        .unwrap_or(2000);
    let mut faults = Vec::new();
    let (mut worst_steps, mut worst_energy, mut worst_apart) = (0.0_f64, 0.0_f64, 0.0_f64);
    for seed in 0..count {
        let pair = pair(seed);
        let rtol = pair.redundant["analysis"]["solver"]["rtol"]
            .as_f64()
            .expect("a number");
        let (redundant, regular) = (solve(&load(&pair.redundant)), solve(&load(&pair.regular)));
        let words = [&redundant, &regular].map(|outcome| outcome.report.status.word());
        if words != ["completed"; 2] {
            faults.push(format!(
                "{seed} {}: {words:?} {:?}",
                pair.kind, redundant.report.message
            ));
            continue;
        }
        let mobility = &redundant.report.mobility;
        assert!(
            !mobility.redundant.is_empty() && mobility.rank == regular.report.mobility.rank,
            "{seed}: {mobility:?}"
        );
        let steps = [&redundant, &regular]
            .map(|outcome| outcome.report.statistics.steps + outcome.report.statistics.rejected);
        let part = steps[0] as f64 / steps[1] as f64;
        let energy = redundant.report.quality.energy_drift.expect("conservative") / rtol;
        let apart = apart(&pair, &redundant, &regular) / rtol;
        if std::env::var_os("LINKDYN_REDUNDANT").is_some() {
            println!(
                "{seed} {} rtol {rtol:.1e} steps {steps:?} energy {energy:.1} apart {apart:.1}",
                pair.kind
            );
        }
        if part > 3.0 {
            faults.push(format!("{seed} {}: {steps:?} steps", pair.kind));
        }
        worst_steps = worst_steps.max(part);
        worst_energy = worst_energy.max(energy);
        worst_apart = worst_apart.max(apart);
    }
    println!(
        "{count}: steps {worst_steps:.2} times, energy {worst_energy:.1} rtol, apart {worst_apart:.1} rtol"
    );
    assert!(
        faults.is_empty(),
        "{} of {count}:\n{}",
        faults.len(),
        faults.join("\n")
    );
    // Errors of a step, times the steps, times what the motion makes of them.
    assert!(
        worst_energy < 1e4 && worst_apart < 1e4,
        "{worst_energy} {worst_apart}"
    );
}

fn case(name: &str) -> Value {
    let path = format!("{}/tests/cases/{name}.json", env!("CARGO_MANIFEST_DIR"));
    serde_json::from_str(&std::fs::read_to_string(path).expect("a case")).expect("valid JSON")
}

/// The start is beside a flat position of the first loop; what is left of its last row there is 6.5e-4.
#[test]
fn a_pendulum_on_parallel_cranks_starts_whatever_its_centre_of_mass() {
    let mut model = case("redundant-crank-and-pendulum");
    for com in [0.05, 0.1, 0.171259, 0.2, 0.4] {
        model["bodies"]["pend"]["com"] = json!([format!("{com} m"), 0]);
        let outcome = solve(&load(&model));
        let report = &outcome.report;
        assert_eq!(
            report.status.word(),
            "completed",
            "{com}: {:?}",
            report.message
        );
        assert_eq!((report.mobility.rank, outcome.trajectory.len()), (2, 31));
        let drift = report.quality.energy_drift.expect("conservative");
        assert!(
            drift < 1e-8 && report.statistics.steps < 1000,
            "{com}: {drift}, {} steps",
            report.statistics.steps
        );
    }
}

/// The bar turns through directions in which one row or the other says its length.
#[test]
fn a_doubled_bar_turns_at_any_tolerance() {
    let mut model = case("redundant-bar");
    let mut ends = Vec::new();
    for exponent in 5..12 {
        for factor in [1.0, 2.0, 5.0] {
            let rtol = factor * 10f64.powi(-exponent);
            model["analysis"]["solver"] = json!({ "rtol": rtol, "atol": 0.01 * rtol });
            let outcome = solve(&load(&model));
            let report = &outcome.report;
            assert_eq!(
                report.status.word(),
                "completed",
                "{rtol}: {:?}",
                report.message
            );
            let steps = report.statistics.steps + report.statistics.rejected;
            assert!(steps < 1500, "{rtol}: {steps} steps");
            ends.push((rtol, *values(&outcome, "b2.angle").last().expect("a row")));
        }
    }
    let best = ends.last().expect("an end").1;
    for (rtol, end) in ends {
        assert!((end - best).abs() < 1e3 * rtol, "{rtol}: {end} {best}");
    }
}

/// A flat parallelogram has two ways to go.
#[test]
fn a_singular_start_is_still_refused() {
    let mut model: Value = serde_json::from_str(
        linkdyn_model::bundled::find("parallel-crank")
            .expect("bundled")
            .text,
    )
    .expect("JSON");
    for joint in ["r", "c"] {
        model["joints"]
            .as_object_mut()
            .expect("joints")
            .remove(joint);
    }
    model["bodies"]
        .as_object_mut()
        .expect("bodies")
        .remove("crank3");
    model["drivers"] = json!({});
    model["analysis"] = json!({ "type": "dynamics", "end": 0.1, "outputs": 3 });
    let outcome = solve(&load(&model));
    assert_eq!(
        outcome.report.status.word(),
        "singular",
        "{:?}",
        outcome.report.message
    );
}
