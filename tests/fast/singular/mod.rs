//! Singular positions: found, located, classed, passed on the smooth branch or refused; against closed forms.

mod lock;
mod turns;

use crate::mechanisms::*;
use linkdyn_output::{EventKind, Status};
use serde_json::json;
use std::f64::consts::PI;

fn degrees(outcome: &linkdyn_engine::analysis::Outcome, kind: EventKind) -> Vec<f64> {
    outcome
        .report
        .events
        .iter()
        .filter(|e| e.kind == kind)
        .map(|e| e.value.expect("one driver").to_degrees())
        .collect()
}

#[test]
fn parallelograms_stay_parallelograms_through_their_flat_positions() {
    let motion = json!({ "type": "polynomial", "coefficients": [PI / 3.0, 2.0 * PI] });
    for (cells, third) in [
        (1, false),
        (2, false),
        (5, false),
        (20, false),
        (1, true),
        (3, true),
    ] {
        let run = outcome(&parallelogram(cells, third, PI / 3.0, &motion));
        assert_eq!(run.report.status, Status::Completed, "{cells} {third}");
        let flat = degrees(&run, EventKind::ChangePoint);
        assert_eq!(flat.len(), 2, "{cells} {third}: {flat:?}");
        assert!(
            (flat[0] - 180.0).abs() < 1e-8 && (flat[1] - 360.0).abs() < 1e-8,
            "{flat:?}"
        );
        let crank = column(&run, "c0.angle");
        for k in 0..=cells {
            let angle = column(&run, &format!("c{k}.angle"));
            let worst = crank
                .iter()
                .zip(&angle)
                .fold(0.0_f64, |m, (a, b)| m.max((a - b).abs()));
            assert!(
                worst < 1e-11,
                "{cells} {third}: crank {k} is off by {worst}"
            );
        }
        assert!(
            run.report.quality.constraint_residual < 1e-12
                && run.report.quality.power_imbalance < Some(1e-9)
        );
    }
}

#[test]
fn a_parallelogram_needs_the_torque_of_the_closed_form() {
    // I = 2·mL²/3 + mL² (cranks and coupler), gravity at 2·½ + 1 crank lengths.
    let motion = json!({ "type": "polynomial", "coefficients": [PI / 3.0, 1.0, 2.0] });
    let run = outcome(&parallelogram(1, false, PI / 3.0, &motion));
    let (angle, alpha) = (column(&run, "c0.angle"), column(&run, "c0.alpha"));
    for (k, effort) in column(&run, "driver.motor.effort").into_iter().enumerate() {
        let want = (2.0 / 3.0 + 1.0) * 0.01 * alpha[k] + 2.0 * 9.81 * 0.1 * angle[k].cos();
        assert!((effort - want).abs() < 1e-9, "row {k}: {effort} {want}");
    }
}

#[test]
fn a_third_crank_shares_the_load_by_least_norm() {
    let motion = json!({ "type": "polynomial", "coefficients": [PI / 3.0, 1.0] });
    let run = outcome(&parallelogram(1, true, PI / 3.0, &motion));
    assert_eq!(run.report.mobility.redundant, ["pm"]);
    assert_eq!(run.report.mobility.rank, 1);
    assert_eq!(run.report.mobility.grubler, 0);
    assert!(run.trajectory.data.iter().all(|v| v.is_finite()));
}

#[test]
fn an_isosceles_slider_crank_passes_over_its_pivot() {
    let motion = json!({ "type": "polynomial", "coefficients": [PI / 6.0, 2.0 * PI] });
    let run = outcome(&slider_crank(0.1, 0.1, PI / 6.0, false, &motion));
    let found = degrees(&run, EventKind::ChangePoint);
    assert!(
        (found[0] - 90.0).abs() < 1e-8 && (found[1] - 270.0).abs() < 1e-8,
        "{found:?}"
    );
    for (angle, x) in column(&run, "crank.angle")
        .iter()
        .zip(column(&run, "slider.x"))
    {
        assert!((x - 0.2 * angle.cos()).abs() < 1e-13, "{angle}: {x}");
    }
}

#[test]
fn a_slider_driven_past_its_dead_centre_is_refused_there() {
    let start = PI / 6.0;
    let motion =
        json!({ "type": "polynomial", "coefficients": [slider_position(0.1, 0.3, start), 0.1] });
    let run = outcome(&slider_crank(0.1, 0.3, start, true, &motion));
    assert_eq!(run.report.status, Status::DeadCentre);
    let event = run
        .report
        .events
        .iter()
        .find(|e| e.kind == EventKind::DeadCentre)
        .expect("an event");
    assert!(
        (event.value.expect("one driver") - 0.4).abs() < 1e-12,
        "{event:?}"
    );
    let time = (0.4 - slider_position(0.1, 0.3, start)) / 0.1;
    assert!((event.time - time).abs() < 1e-10, "{event:?} {time}");
    assert!(column(&run, "time").iter().all(|t| *t < time));
    assert!(run.trajectory.data.iter().all(|v| v.is_finite()));
    let message = run.report.message.expect("a message");
    assert!(
        message.starts_with("dead centre: driver \"motor\" can't go on beyond 0.4 m, t = ")
            && message.contains("\"crank\" and \"rod\" are in line")
            && message.ends_with("Turn back before it, go the other way, or drive another body"),
        "{message}"
    );
}

/// A pendulum that hangs on the slider leaves a freedom, so that the motion is integrated; it ends there all the same.
#[test]
fn a_dead_centre_of_a_motion_that_is_integrated_tells_what_is_in_line() {
    let start = PI / 6.0;
    let motion =
        json!({ "type": "polynomial", "coefficients": [slider_position(0.1, 0.3, start), 0.1] });
    let mut model = slider_crank(0.1, 0.3, start, true, &motion);
    model["bodies"]["bob"] = rod(0.2, [slider_position(0.1, 0.3, start), 0.0], -1.0);
    model["joints"]["hang"] = pin("slider.B", "bob.A");
    model["analysis"] = json!({ "type": "dynamics", "end": 1.0, "outputs": 101 });
    let run = outcome(&model);
    assert_eq!(run.report.status, Status::Singular);
    let message = run.report.message.expect("a message");
    assert!(
        message.contains("the motion can't be followed beyond t = 0.1"),
        "{message}"
    );
    assert!(
        message.contains("\"crank\" and \"rod\" are in line"),
        "{message}"
    );
    // The solver's own finding reaches the report.
    let reason = run.report.reason.expect("a reason");
    assert!(
        (0.1..0.2).contains(&reason.time) && !reason.cause.is_empty(),
        "{reason:?}"
    );
    assert!(
        !reason.rows.is_empty()
            && reason
                .owners
                .iter()
                .any(|owner| owner.starts_with("joint ")),
        "{reason:?}"
    );
}

const TWO_AT_ONCE: &str = include_str!("../../cases/dead-centre-called-singular.json");

/// Two equal dyads between the driven slider and ground fold at one instant, where even the arc's equations are singular.
#[test]
fn a_dead_centre_of_two_parts_at_once_is_located() {
    let model: serde_json::Value = serde_json::from_str(TWO_AT_ONCE).expect("JSON");
    let run = outcome(&model);
    assert_eq!(
        run.report.status,
        Status::DeadCentre,
        "{:?}",
        run.report.message
    );
    let event = run
        .report
        .events
        .iter()
        .find(|e| e.kind == EventKind::DeadCentre)
        .expect("an event");
    // |s u + w − p2| = |b1| − |b2| by hand, u the guide's direction, w the crank's p1 from its p0.
    let known = -0.125_439_957_264_526_4;
    assert!(
        (event.value.expect("one driver") - known).abs() < 1e-12,
        "{event:?}"
    );
    let time = (known + 0.019_814_300_027_219_29) / -1.690_682_280_178_789;
    assert!((event.time - time).abs() < 1e-12, "{event:?}");
    let message = run.report.message.expect("a message");
    assert!(
        message.contains("\"b1\" and \"b2\" are in line, \"b5\" and \"b6\" are in line"),
        "{message}"
    );
    assert!(!message.ends_with(','), "{message}");
}

/// A block between a fixed guide and one that turns, x = h cot θ: at θ = 0 they are parallel, and it is at infinity.
#[test]
fn guides_that_become_parallel_are_a_dead_centre() {
    let (h, start) = (0.3, PI / 3.0);
    let bodies = json!({
        "ground": { "points": { "O": [0.0, 0.0], "H": [0.0, h] } },
        "crank": { "mass": 1.0, "inertia": 0.01, "com": [0.1, 0.0], "points": { "O": [0.0, 0.0] },
                   "pose": { "angle": start } },
        "block": { "mass": 1.0, "inertia": 0.01, "com": [0.0, 0.0], "points": { "C": [0.0, 0.0] },
                   "pose": { "position": [h / start.tan(), h] } },
    });
    let joints = json!({
        "o": pin("ground.O", "crank.O"),
        "g": { "type": "prismatic", "between": ["ground.H", "block.C"], "axis": [1.0, 0.0] },
        "s": { "type": "slot", "between": ["crank.O", "block.C"], "axis": [1.0, 0.0] },
    });
    let motor = json!({ "motor": { "type": "rotation", "body": "crank",
        "motion": { "type": "constant_velocity", "start": start, "velocity": -1.0 } } });
    let mut model = model(bodies, joints, motor);
    // Rows on both sides of the parallel position, nearer than the path's own steps go.
    for sample in [[0.1, -0.1, -0.001], [1e-4, -1e-4, -1e-6]] {
        let [from, to, step] = sample;
        model["analysis"] = json!({ "type": "inverse_dynamics",
            "sample": { "driver": "motor", "from": from, "to": to, "step": step } });
        let run = outcome(&model);
        assert_eq!(
            run.report.status,
            Status::DeadCentre,
            "{:?}",
            run.report.message
        );
        let event = run
            .report
            .events
            .iter()
            .find(|e| e.kind == EventKind::DeadCentre)
            .expect("an event");
        assert!(event.value.expect("one driver").abs() < 1e-9, "{event:?}");
        let message = run.report.message.as_deref().expect("a message");
        assert!(
            message.contains("the guides \"g\", \"s\" are parallel") && !message.contains("NaN"),
            "{message}"
        );
        for (x, angle) in column(&run, "block.x")
            .iter()
            .zip(column(&run, "crank.angle"))
        {
            assert!((x * angle.tan() / h - 1.0).abs() < 1e-9, "{angle}: {x}");
        }
    }
}

#[test]
fn a_slider_that_turns_just_before_its_dead_centre_goes_on() {
    let start = PI / 6.0;
    let phase = ((slider_position(0.1, 0.3, start) - 0.3) / 0.0999).asin();
    let motion = json!({ "type": "harmonic", "offset": 0.3, "amplitude": 0.0999, "frequency": 1.0, "phase": phase });
    let run = outcome(&slider_crank(0.1, 0.3, start, true, &motion));
    assert_eq!(run.report.status, Status::Completed);
    assert!(run.report.events.is_empty(), "{:?}", run.report.events);
    for (x, angle) in column(&run, "slider.x")
        .iter()
        .zip(column(&run, "crank.angle"))
    {
        assert!((slider_position(0.1, 0.3, angle) - x).abs() < 1e-13);
    }
}

#[test]
fn a_start_in_a_flat_position_is_refused_with_the_reason() {
    let motion = json!({ "type": "polynomial", "coefficients": [0.0, 1.0] });
    let run = outcome(&parallelogram(1, false, 0.0, &motion));
    assert_eq!(run.report.status, Status::Singular);
    assert!(
        run.report
            .message
            .as_deref()
            .is_some_and(|m| m.contains("singular position")),
        "{:?}",
        run.report.message
    );
    // A slider at the end of its stroke goes nowhere.
    let motion = json!({ "type": "polynomial", "coefficients": [0.4, -0.1] });
    let said = outcome(&slider_crank(0.1, 0.3, 0.0, true, &motion))
        .report
        .message
        .expect("a message");
    assert!(
        said.contains("singular position") && said.contains("\"crank\" and \"rod\" are in line"),
        "{said}"
    );
}
