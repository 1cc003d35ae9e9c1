//! The lock of the founding paper.

use super::*;
use linkdyn_output::EventKind;

const LOCK: &str = include_str!("../../../models/watt-i-lock.json");

fn lock(from: f64, to: f64, step: f64) -> linkdyn_engine::analysis::Outcome {
    let mut model: serde_json::Value = serde_json::from_str(LOCK).expect("JSON");
    model["analysis"]["sample"] = json!({ "driver": "motor", "from": format!("{from} deg"), "to": format!("{to} deg"),
                                          "step": format!("{step} deg") });
    outcome(&model)
}

/// Change point and dead centre of the lock from an independent calculation to 50 digits.
const CHANGE_POINT: f64 = 117.512206516641;

const DEAD_CENTRE: f64 = 132.743309602;

#[test]
fn the_lock_has_one_change_point_and_a_dead_centre() {
    let whole = lock(-50.0, 125.0, 0.5);
    let found = degrees(&whole, EventKind::ChangePoint);
    assert_eq!(found.len(), 1, "{found:?}");
    assert!((found[0] - CHANGE_POINT).abs() < 1e-8, "{found:?}");
    assert_eq!(whole.report.status, Status::Completed);
    let too_far = lock(-50.0, 135.0, 0.5);
    assert_eq!(too_far.report.status, Status::DeadCentre);
    let found = degrees(&too_far, EventKind::DeadCentre);
    assert!((found[0] - DEAD_CENTRE).abs() < 1e-8, "{found:?}");
    // Everything before it is kept: −50° to 132.5°.
    assert_eq!(too_far.trajectory.len(), 366);
}

#[test]
fn the_lock_is_smooth_at_its_change_point() {
    let run = lock(117.51220651664, 118.51220651664, 0.5);
    let first = |name: &str| column(&run, name)[0];
    assert!((first("link2.omega") / 5.914528704 - 1.0).abs() < 1e-9);
    assert!((first("link2.alpha") / 57.1197951 - 1.0).abs() < 1e-7);
    assert!((first("driver.motor.effort") / 34.8767 - 1.0).abs() < 1e-5);
    // Loop a–b–c–g carries a force without bound there; the other loop's forces exist.
    for joint in ["a", "b", "c", "g"] {
        assert!(first(&format!("joint.{joint}.fx")).is_nan(), "{joint}");
    }
    for joint in ["d", "e", "f"] {
        assert!(first(&format!("joint.{joint}.fx")).is_finite(), "{joint}");
    }
    assert!(
        run.report.warnings.iter().any(|w| w.contains("a, b, c, g")),
        "{:?}",
        run.report.warnings
    );
    let near = lock(117.5, 118.5, 0.5);
    let first = |name: &str| column(&near, name)[0];
    assert!((first("link2.omega") / 5.910973315 - 1.0).abs() < 1e-9);
    assert!((first("link2.alpha") / 57.01870056 - 1.0).abs() < 1e-7);
    assert!((first("driver.motor.effort") / 34.66967 - 1.0).abs() < 1e-6);
    assert!((first("joint.a.fx").hypot(first("joint.a.fy")) / 76005.56 - 1.0).abs() < 1e-6);
}

#[test]
fn the_lock_says_the_same_for_every_number_of_outputs() {
    let runs: Vec<_> = [5.0, 2.5, 1.0, 0.1]
        .map(|step| lock(-50.0, 125.0, step))
        .into();
    let finest = &runs[3];
    for run in &runs[..3] {
        let stride = (finest.trajectory.len() - 1) / (run.trajectory.len() - 1);
        for (k, name) in run
            .trajectory
            .columns
            .iter()
            .enumerate()
            .map(|(k, c)| (k, &c.name))
        {
            let (coarse, fine) = (column(run, name), column(finest, name));
            for (i, value) in coarse.iter().enumerate() {
                let same = fine[i * stride];
                let scale = value.abs().max(1.0);
                assert!(
                    (value - same).abs() <= 1e-9 * scale,
                    "column {k} {name}, row {i}: {value} {same}"
                );
            }
        }
    }
}
