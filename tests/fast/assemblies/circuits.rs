//! Circuits: closed forms of four-bars, and the motion that `run` takes.

use super::*;
use linkdyn_engine::analysis::{
    AllCircuits, CircuitsQuestion, Control, Turning, all_circuits, run,
};
use std::f64::consts::{PI, TAU};

fn circuits(model: &Value, count: usize) -> AllCircuits {
    let question = CircuitsQuestion {
        count,
        most: 1000,
        ..CircuitsQuestion::default()
    };
    let found = all_circuits(&loaded(model).model, &question, &Control::default());
    found
        .unwrap_or_else(|said| panic!("{said:?}"))
        .expect("nobody interrupts")
}

/// Crank a, coupler b, rocker c, base d.
fn four_bar([a, b, c, d]: [f64; 4], start: f64) -> Value {
    json!({
        "format": "linkdyn/1", "units": "SI",
        "bodies": {
            "ground": { "points": { "A": [0, 0], "D": [d, 0] } },
            "crank": { "points": { "A": [0, 0], "B": [a, 0] }, "pose": { "angle": start } },
            "coupler": { "points": { "B": [0, 0], "C": [b, 0] }, "pose": { "position": [a * start.cos(), a * start.sin()], "angle": 0.3 } },
            "rocker": { "points": { "D": [0, 0], "C": [c, 0] }, "pose": { "position": [d, 0], "angle": 1.5 } }
        },
        "joints": {
            "a": { "type": "revolute", "between": ["ground.A", "crank.A"] },
            "b": { "type": "revolute", "between": ["crank.B", "coupler.B"] },
            "c": { "type": "revolute", "between": ["coupler.C", "rocker.C"] },
            "d": { "type": "revolute", "between": ["ground.D", "rocker.D"] }
        },
        "drivers": { "motor": { "type": "rotation", "body": "crank", "motion": { "type": "polynomial", "coefficients": [start, 1] } } },
        "analysis": { "type": "kinematics", "end": 0.1, "outputs": 3 }
    })
}

/// Grashof: a crank that is the shortest link turns fully, on two circuits; where the shortest and longest link are longer together than the
/// others, there is one circuit, and the driver turns back where coupler and rocker are in line, cos θ = (a² + d² − (b ± c)²)/(2ad).
#[test]
fn four_bars_turn_as_grashof_says() {
    for (lengths, turns, count) in [
        ([0.1, 0.25, 0.2, 0.3], true, 2),
        // The coupler is the shortest: a double rocker, also of two circuits.
        ([0.25, 0.1, 0.2, 0.3], false, 2),
        ([0.25, 0.3, 0.2, 0.12], true, 2),
        ([0.2, 0.15, 0.16, 0.3], false, 1),
        ([0.3, 0.15, 0.12, 0.25], false, 1),
    ] {
        let [a, b, c, d] = lengths;
        let cosine = |span: f64| (a * a + d * d - span * span) / (2.0 * a * d);
        let limits = [cosine(b + c), cosine(b - c)];
        let limits: Vec<f64> = limits
            .into_iter()
            .filter(|cosine| cosine.abs() < 1.0)
            .map(f64::acos)
            .collect();
        let start = match limits[..] {
            [] => 0.5,
            [one] if cosine(b + c).abs() < 1.0 => 0.5 * one,
            [one] => 0.5 * (one + PI),
            [one, other, ..] => 0.5 * (one + other),
        };
        let found = circuits(&four_bar(lengths, start), 36);
        assert_eq!(found.circuits.len(), count, "{lengths:?}");
        for circuit in &found.circuits {
            assert!(circuit.is_closed);
            assert_eq!(circuit.turns_fully(), turns, "{lengths:?}");
            for (kind, value, _) in &circuit.turnings {
                assert_eq!(*kind, Turning::DeadCentre, "{lengths:?}");
                let off = limits.iter().map(|limit| {
                    let both = [value - limit, value + limit];
                    both.map(|off| (off - TAU * (off / TAU).round()).abs())
                        .into_iter()
                        .fold(f64::INFINITY, f64::min)
                });
                let off = off.fold(f64::INFINITY, f64::min);
                assert!(off < 1e-7, "{lengths:?} {value}: {off:e} of {limits:?}");
            }
            assert_eq!(circuit.turnings.is_empty(), turns);
        }
        assert_eq!(
            found.circuits.iter().filter(|one| one.is_drawn).count(),
            1,
            "{lengths:?}"
        );
    }
}

/// Each assembly at 36 values belongs to one circuit, and the motion of a run stays on the one that is drawn.
#[test]
fn circuits_hold_all_assemblies_and_the_motion_of_a_run() {
    for name in [
        "four-bar",
        "slider-crank",
        "jansen-leg",
        "klann-leg",
        "stephenson-iii",
        "watt-i-lock",
        "whitworth",
    ] {
        let model = bundled(name);
        let found = circuits(&model, 36);
        assert!(found.doubts.is_empty(), "{name}: {:?}", found.doubts);
        let members: usize = found.circuits.iter().map(|one| one.members).sum();
        let all: usize = found.counts.iter().sum();
        assert_eq!(members, all, "{name}");
        assert!(
            found.circuits[0].is_drawn && found.circuits[1..].iter().all(|one| !one.is_drawn),
            "{name}"
        );
        let loaded = loaded(&model);
        let outcome = run(&loaded.model, &Control::default()).expect("it runs");
        let table = outcome.all();
        let columns: Vec<usize> = found
            .bodies
            .iter()
            .flat_map(|body| ["x", "y", "angle"].map(|axis| format!("{body}.{axis}")))
            .map(|column| table.column_index(&column).expect("there"))
            .collect();
        for row in table.rows().step_by(7) {
            let near = |circuit: &linkdyn_engine::analysis::FoundCircuit| {
                let off = |poses: &Vec<[f64; 3]>| {
                    let own = poses.iter().flatten().zip(&columns).enumerate();
                    own.map(|(k, (value, column))| {
                        let off = value - row[*column];
                        if k % 3 == 2 {
                            (off - TAU * (off / TAU).round()).abs()
                        } else {
                            off.abs()
                        }
                    })
                    .fold(0.0, f64::max)
                };
                circuit
                    .course
                    .iter()
                    .map(|(_, poses)| off(poses))
                    .fold(f64::INFINITY, f64::min)
            };
            // Half of the longest step.
            let off = near(&found.circuits[0]);
            assert!(off < 0.03, "{name}: {off}");
        }
    }
}

/// A slide that is led over its stroke: both ends are ends, and a piston passes its dead centres.
#[test]
fn a_length_is_led_through_what_its_motion_passes() {
    let model = bundled("excavator");
    let question = CircuitsQuestion {
        driver: Some("lift".into()),
        count: 10,
        most: 1000,
        range: None,
    };
    let found = all_circuits(&loaded(&model).model, &question, &Control::default());
    let found = found.expect("it is led").expect("nobody interrupts");
    assert_eq!(found.values.len(), 10);
    let drawn = &found.circuits[0];
    assert!(drawn.is_drawn && !drawn.is_closed);
    let kinds: Vec<Turning> = drawn.turnings.iter().map(|(kind, ..)| *kind).collect();
    assert_eq!(kinds, [Turning::End, Turning::End]);
}
