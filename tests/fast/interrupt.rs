//! Long runs: what an interrupt or a time limit leaves.

use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

use crate::long::text;
use cpu_time::ThreadTime;
use linkdyn_engine::analysis::{Control, Outcome, run};
use linkdyn_output::Status;

const ANALYSES: [&str; 3] = ["kinematics", "inverse_dynamics", "dynamics"];

/// The run, stopped where `when` says so.
fn stopped(analysis: &str, when: fn(f64) -> bool) -> Outcome {
    let loaded = linkdyn_model::load(text(analysis).as_bytes(), &[]).expect("a sound model");
    let control = Control {
        deadline: Instant::now().checked_add(Duration::from_secs(100)),
        ..Control::default()
    };
    let watched = control.clone();
    let watcher = std::thread::spawn(move || {
        while !watched.progress.share().is_some_and(when) {
            std::thread::sleep(Duration::from_micros(50));
        }
        watched.interrupted.store(true, Ordering::SeqCst);
    });
    let outcome = run(&loaded.model, &control).expect("sound");
    watcher.join().expect("no panic");
    outcome
}

#[test]
fn an_interrupt_keeps_the_rows_until_then() {
    for analysis in ANALYSES {
        // of prescribed motions the first half is the path
        let outcome = stopped(
            analysis,
            if analysis == "dynamics" {
                |share| share > 0.001
            } else {
                |share| share > 0.5001
            },
        );
        let rows = outcome.trajectory.rows().count();
        assert_eq!(outcome.report.status, Status::Interrupted, "{analysis}");
        assert!(0 < rows && rows < 100_001, "{analysis}: {rows}");
        assert!(
            outcome
                .trajectory
                .rows()
                .all(|row| row.iter().all(|value| value.is_finite())),
            "{analysis}"
        );
        let message = outcome.report.message.expect("a reason");
        assert!(
            message.starts_with("interrupted") && message.ends_with("the rows until then are kept"),
            "{message}"
        );
    }
}

#[test]
fn an_interrupt_while_the_path_is_followed_is_told_as_that() {
    let outcome = stopped("kinematics", |share| share > 0.001);
    assert_eq!(
        (outcome.report.status, outcome.trajectory.rows().count()),
        (Status::Interrupted, 0)
    );
    let message = outcome.report.message.expect("a reason");
    assert_eq!(
        message,
        "interrupted while the path was followed, before the first output"
    );
}

#[test]
fn a_time_that_is_over_is_a_time_limit_in_every_analysis() {
    for analysis in ANALYSES {
        let loaded = linkdyn_model::load(text(analysis).as_bytes(), &[]).expect("a sound model");
        let control = Control {
            deadline: Some(Instant::now()),
            ..Control::default()
        };
        let report = run(&loaded.model, &control).expect("sound").report;
        assert_eq!(report.status, Status::TimeLimit, "{analysis}");
        assert!(
            report
                .message
                .expect("a reason")
                .starts_with("max_wall_time is over"),
            "{analysis}"
        );
    }
}

/// A ball bounces on a floor without loss until its time is over.
#[test]
fn a_time_that_is_over_names_the_contact_that_took_it() {
    let text = r#"{ "format": "linkdyn/1", "units": "SI", "gravity": [0, -9.81], "bodies": { "ground": { "points": { "O": [0, 0] } },
        "ball": { "mass": 1, "inertia": 1, "com": [0, 0], "points": { "C": [0, 0] }, "pose": { "position": [0, 0.001] } } },
        "joints": { "floor": { "type": "contact", "between": ["ground.O", "ball.C"], "outline": [[1, 0], [-1, 0]], "restitution": 1 } },
        "analysis": { "type": "dynamics", "end": 1e6, "outputs": 2 } }"#;
    let loaded = linkdyn_model::load(text.as_bytes(), &[]).expect("a sound model");
    let control = Control {
        deadline: Some(Instant::now() + Duration::from_millis(300)),
        ..Control::default()
    };
    let report = run(&loaded.model, &control).expect("sound").report;
    assert_eq!(report.status, Status::TimeLimit);
    let message = report.message.expect("a reason");
    assert!(
        message.contains(": the contact of joint \"floor\" has changed "),
        "{message}"
    );
}

/// Ten million cycles of a driver: with one driver its path is gone once, of several it is followed in time until the limit.
#[test]
fn a_fast_driver_does_not_outlast_its_time() {
    let second = r#", "still": { "type": "rotation", "body": "b", "motion": { "type": "constant_velocity", "velocity": 1 } }"#;
    for (drivers, limit) in [("", false), (second, true)] {
        let joint = if limit {
            ""
        } else {
            r#", "k": { "type": "fixed", "between": ["ground.Q", "b.B"] }"#
        };
        let text = format!(
            r#"{{ "format": "linkdyn/1", "units": "SI", "bodies": {{ "ground": {{ "points": {{ "O": [0, 0], "Q": [2, 0] }} }},
            "a": {{ "points": {{ "O": [0, 0] }} }}, "b": {{ "points": {{ "B": [0, 0] }}, "pose": {{ "position": [2, 0] }} }} }},
            "joints": {{ "o": {{ "type": "revolute", "between": ["ground.O", "a.O"] }}
                {} {joint} }},
            "drivers": {{ "fast": {{ "type": "rotation", "body": "a", "motion": {{ "type": "harmonic", "amplitude": 0.3, "frequency": 1e7 }} }} {drivers} }},
            "analysis": {{ "type": "kinematics", "end": 1, "outputs": 11 }} }}"#,
            if limit {
                r#", "q": { "type": "revolute", "between": ["ground.Q", "b.B"] }"#
            } else {
                ""
            }
        );
        let model = linkdyn_model::load(text.as_bytes(), &[])
            .expect("a sound model")
            .model;
        let (start, work) = (Instant::now(), ThreadTime::now());
        let most = Duration::from_millis(500);
        let control = Control {
            deadline: start.checked_add(most).filter(|_| limit),
            ..Control::default()
        };
        let outcome = run(&model, &control).expect("sound");
        if limit {
            let took = start.elapsed();
            assert!(took < most + Duration::from_secs(1), "{took:?}");
            assert_eq!(outcome.report.status, Status::TimeLimit);
            continue;
        }
        // Of the processor, which others may use too.
        let took = work.elapsed();
        assert!(took < most, "{took:?}");
        assert_eq!(
            outcome.report.status,
            Status::Completed,
            "{:?}",
            outcome.report.message
        );
        for row in outcome.trajectory.rows() {
            // 0.3 sin ωt: ωt is known to round-off of some 6e7.
            let exact = 0.3 * (std::f64::consts::TAU * 1e7 * row[0]).sin();
            let angle = row[outcome
                .trajectory
                .column_index("a.angle")
                .expect("a column")];
            assert!((angle - exact).abs() < 1e-12, "{angle} instead of {exact}");
        }
    }
}
