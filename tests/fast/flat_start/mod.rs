//! Statics and small motions of mechanisms drawn in a singular position, against closed forms.

mod slider;

use crate::mechanisms::*;
use linkdyn_engine::analysis::{Control, Linearised, Outcome, modes};
use linkdyn_output::Status;
use serde_json::{Value, json};
use std::f64::consts::{FRAC_PI_2, PI};

const G: f64 = 9.81;

const SINGULAR: &str = "the start is a singular position";

fn still(mut model: Value) -> Value {
    model["drivers"] = json!({});
    model["analysis"] = json!({ "type": "statics" });
    model
}

fn linearised(model: &Value, pose: bool) -> Linearised {
    modes(&loaded(model).model, pose, &Control::default()).unwrap_or_else(|said| panic!("{said:?}"))
}

fn refusal(outcome: &Outcome) -> &str {
    assert_eq!(
        outcome.report.status,
        Status::Singular,
        "{:?}",
        outcome.report.equilibrium
    );
    assert!(outcome.trajectory.is_empty());
    outcome.report.message.as_deref().expect("a message")
}

/// What one coordinate says: stiffness [N·m/rad] and ω² [1/s²], and that the branch is told.
#[track_caller]
fn swings(model: &Value, stiffness: f64, square: f64) {
    let run = outcome(model);
    assert_eq!(
        run.report.status,
        Status::Completed,
        "{:?}",
        run.report.message
    );
    let found = run.report.equilibrium.as_ref().expect("an equilibrium");
    assert_eq!(
        (found.stability, found.coordinates.len()),
        ("stable", 1),
        "{found:?}"
    );
    assert!(found.coordinates[0].ends_with(".angle"), "{found:?}");
    close(found.stiffness[0], stiffness, 1e-12 * stiffness);
    assert_eq!(run.report.mobility.rank, 1);
    assert!(
        run.report
            .warnings
            .iter()
            .any(|warning| warning.starts_with(SINGULAR)),
        "{:?}",
        run.report.warnings
    );
    let small = linearised(model, false);
    assert_eq!(
        (small.status, small.modes.len(), small.mobility.rank),
        (Status::Completed, 1, 1)
    );
    close(
        small.modes[0].frequency(),
        square.sqrt(),
        1e-11 * square.sqrt(),
    );
    assert!(
        small
            .warnings
            .iter()
            .any(|warning| warning.starts_with(SINGULAR)),
        "{:?}",
        small.warnings
    );
    let pose = linearised(model, true);
    assert_eq!((pose.status, pose.modes.len()), (Status::Singular, 0));
    assert!(
        pose.message
            .as_deref()
            .is_some_and(|said| said.starts_with("the pose is a singular position")),
        "{pose:?}"
    );
}

const DRAWN_FLAT: &str = include_str!("../../cases/flat-start-modes.json");

/// The parallelogram of the case: cranks of 0.3 m, turned and mirrored as a whole (gravity with it), drawn at `crank`.
fn drawn(crank: f64, turn: f64, mirror: bool) -> Value {
    let mut model: Value = serde_json::from_str(DRAWN_FLAT).expect("JSON");
    let sign = if mirror { -1.0 } else { 1.0 };
    let (sin, cos) = turn.sin_cos();
    let placed = |x: f64, y: f64| json!([x * cos - sign * y * sin, x * sin + sign * y * cos]);
    for (point, x) in [("O", 0.0), ("D", 1.0), ("E", 0.5)] {
        model["bodies"]["ground"]["points"][point] = placed(x, 0.0);
    }
    model["gravity"] = placed(0.0, -G);
    let tip = [0.3 * crank.cos(), 0.3 * crank.sin()];
    for (body, at, angle) in [
        ("c", [0.0; 2], crank),
        ("k", tip, 0.0),
        ("r", [1.0, 0.0], crank),
    ] {
        model["bodies"][body]["pose"] =
            json!({ "position": placed(at[0], at[1]), "angle": sign * angle + turn });
    }
    for (part, at) in [("M", [0.5, 0.0]), ("P", [0.3, -0.1])] {
        model["bodies"]["k"]["points"][part] = json!([at[0], sign * at[1]]);
    }
    model["bodies"]["k"]["com"] = json!([0.4, sign * 0.05]);
    model
}

// As one pendulum: m l = 0.1 + 0.2 + 2·0.3 kg·m, J = 0.02 + 0.01 + 0.03 + 0.04 + 2·0.09 kg·m².
const STIFFNESS: f64 = 0.9 * G;

const INERTIA: f64 = 0.28;

#[test]
fn a_parallelogram_drawn_flat_hangs_as_a_parallelogram() {
    for crank in [0.0, PI] {
        for turn in [0.0, 0.4, -1.1, FRAC_PI_2, 3.0] {
            for mirror in [false, true] {
                let model = drawn(crank, turn, mirror);
                swings(&model, STIFFNESS, STIFFNESS / INERTIA);
                let run = outcome(&model);
                for body in ["c", "r"] {
                    let down = if mirror {
                        turn + FRAC_PI_2
                    } else {
                        turn - FRAC_PI_2
                    };
                    close(
                        (column(&run, &format!("{body}.angle"))[0] - down).sin(),
                        0.0,
                        1e-12,
                    );
                }
                let told = &run.report.warnings[0];
                assert!(
                    told.contains("\"c\", \"r\" turn") && told.contains("Another assembly"),
                    "{told}"
                );
            }
        }
    }
    close(
        linearised(&drawn(0.0, 0.0, false), false).modes[0].frequency() / (2.0 * PI),
        0.893_711,
        1e-6,
    );
}

#[test]
fn a_spring_on_a_crank_drawn_flat_only_adds_to_it() {
    // k θ + m l g cos θ = 0, K = k − m l g sin θ.
    for k in [2.0, 30.0] {
        let mut model = drawn(0.0, 0.0, false);
        model["forces"] = json!({ "k": { "type": "torsion_spring", "between": ["ground", "c"], "stiffness": k } });
        let mut theta = -0.5_f64;
        for _ in 0..50 {
            theta -= (k * theta + STIFFNESS * theta.cos()) / (k - STIFFNESS * theta.sin());
        }
        let stiffness = k - STIFFNESS * theta.sin();
        swings(&model, stiffness, stiffness / INERTIA);
        close(column(&outcome(&model), "c.angle")[0], theta, 1e-12);
    }
}

#[test]
fn chains_of_parallelograms_drawn_flat_hang_as_one() {
    let motion = json!({ "type": "polynomial", "coefficients": [0.0] });
    // Cranks of 0.1 m and couplers of 1 kg each: K = g r (½ cranks + couplers), J = r² (⅓ cranks + couplers).
    for (cells, third) in [(1, false), (2, false), (3, false), (1, true), (2, true)] {
        let cranks = cells as f64 + if third { 2.0 } else { 1.0 };
        let stiffness = G * 0.1 * (0.5 * cranks + cells as f64);
        let square = stiffness / (0.01 * (cranks / 3.0 + cells as f64));
        for start in [0.0, PI] {
            let model = still(parallelogram(cells, third, start, &motion));
            swings(&model, stiffness, square);
            let run = outcome(&model);
            assert_eq!(
                run.report.mobility.redundant,
                if third { vec!["pm"] } else { Vec::new() }
            );
            // With a third crank all cranks must turn alike.
            let unique = run.report.warnings[0].contains("one motion leads away");
            assert_eq!(unique, third && cells == 1, "{:?}", run.report.warnings);
        }
    }
}

/// A model beside another, its names with an `x`.
fn beside(mut model: Value, other: &Value) -> Value {
    for (name, body) in other["bodies"].as_object().expect("a map") {
        if name == "ground" {
            for (point, place) in body["points"].as_object().expect("a map") {
                model["bodies"]["ground"]["points"][format!("x{point}")] = place.clone();
            }
        } else {
            model["bodies"][format!("x{name}")] = body.clone();
        }
    }
    for (name, joint) in other["joints"].as_object().expect("a map") {
        let moved = |k: usize| {
            let text = joint["between"][k].as_str().expect("text");
            text.strip_prefix("ground.")
                .map_or_else(|| format!("x{text}"), |point| format!("ground.x{point}"))
        };
        model["joints"][format!("x{name}")] = pin(&moved(0), &moved(1));
    }
    model
}

#[test]
fn two_of_them_in_one_model_hang_each_as_it_does_alone() {
    let motion = json!({ "type": "polynomial", "coefficients": [0.0] });
    let chain = still(parallelogram(2, false, 0.0, &motion));
    let model = beside(drawn(0.0, 0.0, false), &chain);
    let found = linearised(&model, false);
    assert_eq!(
        (found.status, found.mobility.rank, found.modes.len()),
        (Status::Completed, 2, 2),
        "{:?}",
        found.message
    );
    let alone = [STIFFNESS / INERTIA, G * 0.1 * 3.5 / 0.03];
    for (mode, square) in found.modes.iter().zip(alone) {
        close(mode.frequency(), square.sqrt(), 1e-11 * square.sqrt());
    }
    // One flat, one not.
    let model = beside(drawn(0.7, 0.0, false), &chain);
    let found = linearised(&model, false);
    for (mode, square) in found.modes.iter().zip(alone) {
        close(mode.frequency(), square.sqrt(), 1e-11 * square.sqrt());
    }
    // A pendulum that hangs on the coupler is a freedom of its own: three in all, one of them lost by the flat position.
    let mut model = drawn(0.0, 0.0, false);
    model["bodies"]["p"] = rod(0.8, [0.5, 0.0], -1.0);
    model["joints"]["p"] = pin("k.M", "p.A");
    let found = linearised(&model, false);
    assert_eq!(
        (found.status, found.mobility.rank, found.modes.len()),
        (Status::Completed, 2, 2),
        "{:?}",
        found.message
    );
}

#[test]
fn what_is_regular_keeps_its_freedoms_and_says_nothing() {
    let chain = still(parallelogram(
        1,
        true,
        0.6,
        &json!({ "type": "polynomial", "coefficients": [0.6] }),
    ));
    let model = beside(drawn(0.7, 0.0, false), &chain);
    let run = outcome(&model);
    assert_eq!(run.report.mobility.rank, 2);
    assert_eq!(
        run.report
            .equilibrium
            .as_ref()
            .expect("there")
            .coordinates
            .len(),
        2
    );
    assert!(
        run.report
            .warnings
            .iter()
            .all(|warning| !warning.contains("singular")),
        "{:?}",
        run.report.warnings
    );
    assert_eq!(linearised(&model, true).status, Status::Completed);
}

#[test]
fn an_equilibrium_that_is_singular_itself_is_said_to_be() {
    let motion = json!({ "type": "polynomial", "coefficients": [0.0] });
    for start in [0.0, 0.3, PI - 0.2] {
        // The ground's pivots above each other: the parallelogram hangs where it is flat.
        let mut model = still(parallelogram(1, false, start, &motion));
        model["gravity"] = json!([G, 0.0]);
        let run = outcome(&model);
        let said = refusal(&run);
        assert!(
            said.starts_with("the equilibrium is itself a singular position"),
            "{start}: {said}"
        );
        assert_eq!(linearised(&model, false).status, Status::Singular);
    }
}
