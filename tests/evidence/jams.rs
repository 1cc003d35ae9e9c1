//! Rigid journals that jam or kick one another off again and again: the motion goes on, or the joints are named.

use crate::models::values;
use crate::rigid::rigid;
use linkdyn_engine::analysis::{Control, run};
use linkdyn_output::Status;

/// Where it wedges, forces are so large that round-off alone carries a journal over its threshold: it does not stick and slip
/// for ever at one instant.
#[test]
fn a_wedged_journal_does_not_stick_and_slip_for_ever() {
    let text = linkdyn_model::bundled::find("slider-crank-clearance")
        .expect("bundled")
        .text;
    let clearance = r#"joints.wristpin.clearance={ "model": "three_state", "radius": "5 um", "bearing_radius": "30 mm",
        "impact": { "restitution": 0.3, "friction": 0.5 } }"#;
    let sets = [clearance, "analysis.end=0.0003", "analysis.outputs=3"].map(String::from);
    let model = linkdyn_model::load(text.as_bytes(), &sets)
        .expect("a model")
        .model;
    let outcome = run(&model, &Control::default()).expect("good input");
    assert_eq!(
        outcome.report.status,
        Status::Completed,
        "{:?}",
        outcome.report.message
    );
    let changes = outcome.report.clearances[0].switches;
    assert!(changes < 1000, "{changes} changes between stick and slip");
}

/// All joints of the loops' outer half of the lock: journals kick one another off again and again.
#[test]
fn many_rigid_journals_go_the_whole_way() {
    let text = linkdyn_model::bundled::find("watt-i-lock")
        .expect("bundled")
        .text;
    let clearance = |joint: &str| {
        format!(
            r#"joints.{joint}.clearance={{ "model": "three_state", "radius": "100 um", "bearing_radius": "10 mm",
                "impact": {{ "restitution": 0.5, "friction": 0 }} }}"#
        )
    };
    let model = linkdyn_model::load(text.as_bytes(), &["a", "b", "c", "g"].map(clearance))
        .expect("a model")
        .model;
    let outcome = run(&model, &Control::default()).expect("good input");
    assert_eq!(
        outcome.report.status,
        Status::Completed,
        "{:?}",
        outcome.report.message
    );
    let imbalance = outcome
        .report
        .quality
        .energy_imbalance
        .expect("of contacts");
    assert!(imbalance < 1e-5, "{imbalance:e} of the energy missing");
    let deepest = ["a", "b", "c", "g"]
        .map(|joint| {
            values(&outcome, &format!("joint.{joint}.penetration"))
                .into_iter()
                .fold(0.0, f64::max)
        })
        .into_iter()
        .fold(0.0, f64::max);
    assert!(deepest < 1e-12, "{deepest:e} m deep");
}

/// Where friction leaves no normal forces that answer the motion, impulses stop the sliding, and the motion goes on: no energy
/// comes of nothing, and the linkage goes where the ideal one goes.
#[test]
fn jams_end_by_impulses() {
    let ideal = rigid("watt-i-lock", &[], "", 0.0, 0.0, &[]);
    for (joints, restitution, friction) in [
        (&["d", "e", "f"][..], 0.5, 0.05),
        // Forces of those that press are undetermined but for round-off.
        (&["d", "e", "f"], 0.5, 0.2),
        // A step leads just beyond where forces have no bounds: it is taken back.
        (&["d", "e", "f"], 0.5, 0.3),
        (&["c", "d", "e", "f"], 0.5, 0.2),
        (&["d", "e", "f", "g"], 0.5, 0.5),
        // The others come nearer whatever they do while one of them pushes: it does not jam alone.
        (&["c", "d", "e", "f"], 0.5, 0.5),
        (&["a", "b"], 0.0, 0.1),
        (&["a", "b"], 0.5, 0.6),
        (&["a", "b", "c"], 0.0, 0.2),
        (&["a", "b", "c"], 0.0, 0.5),
    ] {
        let outcome = rigid("watt-i-lock", joints, "100 um", restitution, friction, &[]);
        assert_eq!(
            outcome.report.status,
            Status::Completed,
            "{joints:?}: {:?}",
            outcome.report.message
        );
        let imbalance = outcome
            .report
            .quality
            .energy_imbalance
            .expect("of contacts");
        assert!(imbalance < 1e-6, "{joints:?}: {imbalance:e}");
        for sums in &outcome.report.clearances {
            assert!(sums.energy_lost > 0.0, "{joints:?}: {sums:?}");
        }
        let angles = values(&outcome, "link2.angle")
            .into_iter()
            .zip(values(&ideal, "link2.angle"));
        let apart = angles
            .map(|(real, ideal)| (real - ideal).abs())
            .fold(0.0, f64::max);
        assert!(apart < 0.1, "{joints:?}: {apart} rad");
    }
}

/// Forces that grow beyond all bounds are such a jam too.
#[test]
fn a_motion_that_comes_to_a_jam_goes_on() {
    let outcome = rigid(
        "nfourbar",
        &["right0"],
        "200 um",
        0.3,
        0.5,
        &["analysis.end=0.745", "analysis.outputs=20"],
    );
    assert_eq!(
        outcome.report.status,
        Status::Completed,
        "{:?}",
        outcome.report.message
    );
    let imbalance = outcome
        .report
        .quality
        .energy_imbalance
        .expect("of contacts");
    assert!(imbalance < 1e-8, "{imbalance:e}");
}

/// A journal that leaves slowly would come back at once, but no forces would keep it: it leaves.
#[test]
fn what_leaves_slowly_may_leave_where_nothing_would_keep_it() {
    let until = ["analysis.sample.to=\"15 deg\""];
    let journals = ["a", "b", "d", "e", "f"];
    let outcome = rigid("watt-i-lock", &journals, "100 um", 0.5, 0.5, &until);
    assert_eq!(
        outcome.report.status,
        Status::Completed,
        "{:?}",
        outcome.report.message
    );
    let imbalance = outcome
        .report
        .quality
        .energy_imbalance
        .expect("of contacts");
    assert!(imbalance < 1e-8, "{imbalance:e}");
}

/// Where no forces and no impulses answer the motion, the joint is named.
#[test]
fn jammed_journals_are_named() {
    let all = ["a", "b", "c", "d", "e", "f", "g"];
    let outcome = rigid("watt-i-lock", &all, "100 um", 0.5, 0.5, &[]);
    assert_eq!(outcome.report.status, Status::Singular);
    let said = outcome.report.message.expect("why");
    assert!(
        said.contains("joints \"a\"") && !outcome.trajectory.is_empty(),
        "{said}"
    );
}
