//! What `check` refuses a run refuses, in the same words, and nothing else.

use crate::models;
use linkdyn_engine::analysis::{Control, check, run};
use linkdyn_model::{JointKind, Model, bundled, load};
use linkdyn_output::Status;
use std::time::{Duration, Instant};

const ANALYSES: [&str; 5] = [
    r#"{ "type": "kinematics", "end": 0.01, "outputs": 3 }"#,
    r#"{ "type": "inverse_dynamics", "end": 0.01, "outputs": 3 }"#,
    r#"{ "type": "dynamics", "end": 0.01, "outputs": 3 }"#,
    r#"{ "type": "statics" }"#,
    r#"{ "type": "assembly" }"#,
];

/// Sets that may spoil a model, each alone.
fn spoilt(model: &Model) -> Vec<Vec<String>> {
    let bodies: Vec<&String> = model
        .bodies
        .keys()
        .filter(|body| *body != "ground")
        .collect();
    let (first, last) = (bodies[0], bodies[bodies.len() - 1]);
    let pin = model.joints.iter().find(|(_, joint)| {
        let JointKind::Revolute { clearance, .. } = &joint.kind else {
            return false;
        };
        clearance.is_none()
    });
    let mut sets = vec![
        vec![],
        vec!["drivers={}".to_owned()],
        vec![format!(
            r#"drivers.more={{ "type": "rotation", "body": "{last}", "motion": {{ "type": "constant_velocity", "velocity": 1 }} }}"#
        )],
        vec![
            format!("bodies.{first}.mass=null"),
            format!("bodies.{first}.inertia=null"),
        ],
        vec![
            format!("bodies.{last}.mass=0"),
            format!("bodies.{last}.inertia=0"),
        ],
        vec![format!(
            r#"outputs={{ "o": "d({last}.angle)/d({first}.angle)" }}"#
        )],
        vec![format!(r#"initial.{last}={{ "angle": "1 rad" }}"#)],
        vec![format!(
            r#"initial.{first}={{ "angular_velocity": "3 rad/s" }}"#
        )],
        vec![
            "analysis.sample={ \"driver\": \"motor\", \"from\": 0, \"to\": 1, \"step\": 0.5 }"
                .to_owned(),
        ],
    ];
    if let Some((name, _)) = pin {
        sets.extend([
            vec![format!(r#"joints.{name}.limits=["100 deg", "101 deg"]"#)],
            vec![format!(r#"joints.{name}={{ "type": "fixed" }}"#)],
            vec![format!(
                r#"joints.{name}.clearance={{ "model": "massless_link", "radius": "0.1 mm" }}"#
            )],
        ]);
    }
    sets
}

#[test]
fn check_refuses_what_a_run_refuses() {
    let (mut tried, mut refused) = (0, 0);
    for (of, bundled) in bundled::MODELS.iter().enumerate() {
        let whole = models::load_bundled(bundled.name, &[]);
        for (number, mut sets) in spoilt(&whole).into_iter().enumerate() {
            // its own analysis now and then, and a sample needs one by values
            if (of + number) % 6 < ANALYSES.len() {
                sets.insert(0, format!("analysis={}", ANALYSES[(of + number) % 6]));
            }
            let text = bundled::text(bundled.name).expect("bundled");
            let Ok(loaded) = load(text.as_bytes(), &sets) else {
                continue;
            };
            let control = Control {
                deadline: Some(Instant::now() + Duration::from_millis(5)),
                ..Control::default()
            };
            let ran = run(&loaded.model, &control).map(|outcome| outcome.report);
            let found = match check(&loaded.model) {
                Ok(found) if found.refused.is_empty() => Ok(found.status),
                Ok(found) => Err(found.refused),
                Err(complaints) => Err(complaints.0),
            };
            let what = format!("{} with {sets:?}", bundled.name);
            match (&found, &ran) {
                (Err(of_check), Err(of_run)) => assert_eq!(*of_check, of_run.0, "{what}"),
                (Ok(_), Ok(report)) if report.status == Status::TimeLimit => {}
                // a run that has rows has had a first instant
                (Ok(status), Ok(report)) => assert!(
                    *status == Status::Completed || *status == report.status,
                    "{what}: {status:?} {report:?}"
                ),
                (_, _) => panic!("{what}: check {found:?}, run {ran:?}"),
            }
            tried += 1;
            refused += usize::from(ran.is_err());
        }
    }
    assert!(tried > 250 && refused > 60, "{refused} of {tried}");
}
