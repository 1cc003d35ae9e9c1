//! Which columns there are: those asked for by their last word, and those of actuators.

use super::{analysis, model, solve};
use crate::models;
use linkdyn_engine::analysis::{Control, Family, Prepared};
use linkdyn_model::{Given, load};
use linkdyn_output::Trajectory;
use serde_json::{Value, json};

fn names(table: &Trajectory) -> Vec<&str> {
    table
        .columns
        .iter()
        .map(|column| column.name.as_str())
        .collect()
}

/// The model without what no older file has.
fn older(analysis: &Value) -> Value {
    let mut json = model(analysis);
    let forces = json["forces"].as_object_mut().expect("forces");
    forces.remove("lift");
    json
}

#[test]
fn patterns_of_older_files_keep_what_they_kept() {
    let before = |name: &str| match name.split_once('.') {
        Some(("joint", rest)) => ["fx", "fy", "torque"]
            .iter()
            .any(|word| rest.ends_with(&format!(".{word}"))),
        Some((kind, _)) => kind != "force" && kind != "output",
        None => true,
    };
    let all = solve(&older(&analysis("inverse_dynamics", &[])));
    assert!(
        names(&all.trajectory).into_iter().all(before),
        "{:?}",
        names(&all.trajectory)
    );
    assert!(all.complete.is_none());
    for pattern in [
        "joint.*",
        "*",
        "*.angle",
        "*angle",
        "joint.guide.?*",
        "joint.*.*",
        "*.rate",
        "j*.f",
    ] {
        let outcome = models::solve(&models::load(&older(&analysis(
            "inverse_dynamics",
            &[pattern],
        ))));
        assert!(
            names(&outcome.trajectory).into_iter().all(before),
            "{pattern}"
        );
    }
    // that matches nothing, as it did
    let outcome = models::solve(&models::load(&older(&analysis(
        "inverse_dynamics",
        &["force.*"],
    ))));
    assert_eq!(names(&outcome.trajectory), ["time"]);
    assert_eq!(
        outcome.report.warnings,
        ["analysis.columns: \"force.*\" matches no column"]
    );
}

#[test]
fn what_is_asked_for_stands_behind_the_rest() {
    let json = older(&analysis(
        "inverse_dynamics",
        &["force.s*.length", "driver.*", "joint.guide.slide"],
    ));
    let outcome = solve(&json);
    let shown = [
        "time",
        "driver.motor.value",
        "driver.motor.effort",
        "joint.guide.slide",
        "force.spring.length",
    ];
    assert_eq!(names(&outcome.trajectory), shown);
    let units: Vec<&str> = outcome
        .trajectory
        .columns
        .iter()
        .map(|column| column.unit)
        .collect();
    assert_eq!(units, ["s", "rad", "N*m", "m", "m"]);
    // and a handle finds them before a run
    let prepared = Prepared::new(&models::checked(&models::load(&json))).expect("runs");
    assert_eq!(prepared.columns()[..], outcome.all().columns[..]);
    // all other columns are what they are without
    let plain = solve(&older(&analysis("inverse_dynamics", &[])));
    for column in plain.trajectory.columns.iter() {
        assert_eq!(
            plain.trajectory.values(&column.name),
            outcome.all().values(&column.name)
        );
    }
}

#[test]
fn actuators_have_theirs_unasked() {
    let outcome = solve(&model(&analysis("inverse_dynamics", &[])));
    let last: Vec<&str> = names(&outcome.trajectory)
        .into_iter()
        .rev()
        .take(5)
        .collect();
    let shown = [
        "force.lift.power",
        "force.lift.f",
        "force.lift.rate",
        "force.lift.length",
        "energy.potential",
    ];
    assert_eq!(last, shown);
    let kept = solve(&model(&analysis("inverse_dynamics", &["crank.angle"])));
    assert_eq!(names(&kept.trajectory), ["time", "crank.angle"]);
    // at rest nothing has a rate
    let mut json = model(&json!({ "type": "statics" }));
    json["drivers"] = json!({});
    let rest = solve(&json);
    let last: Vec<&str> = names(&rest.trajectory).into_iter().rev().take(2).collect();
    assert_eq!(last, ["force.lift.f", "force.lift.length"]);
}

#[test]
fn a_slip_is_told() {
    let json = model(&analysis(
        "kinematics",
        &["force.spring.lenght", "force.sprong.rate", "joint.guide.f"],
    ));
    let outcome = models::solve(&models::load(&json));
    assert_eq!(
        outcome.report.warnings,
        [
            "analysis.columns: \"force.spring.lenght\" matches no column; the nearest is \"force.spring.length\"",
            "analysis.columns: \"force.sprong.rate\" matches no column; the nearest is \"force.spring.rate\"",
            "analysis.columns: \"joint.guide.f\" matches no column; the nearest is \"joint.guide.rate\"",
        ]
    );
}

#[test]
fn what_forces_do_not_exist_have_no_size() {
    // where the slide locks itself there are no forces, but places
    let mut json = older(&analysis(
        "inverse_dynamics",
        &["joint.*.f", "joint.*.fx", "force.spring.f"],
    ));
    json["bodies"]["crank"]["points"]["A"] = json!([0.16, 0]);
    json["bodies"]["rod"]["pose"] = json!({ "position": [0.16, 0] });
    json["bodies"]["piston"]["pose"] = json!({ "position": [0.36, 0] });
    json["joints"]["guide"]["friction"] =
        json!({ "law": "coulomb", "coefficient": 1.1, "threshold_velocity": 1e-9 });
    let outcome = models::solve(&models::load(&json));
    let of = |name: &str| models::values(&outcome, name);
    let (fx, f) = (of("joint.guide.fx"), of("joint.guide.f"));
    let empty = fx.iter().filter(|fx| fx.is_nan()).count();
    assert!(empty > 0 && empty < fx.len(), "{empty}");
    assert!(fx.iter().zip(&f).all(|(fx, f)| fx.is_nan() == f.is_nan()));
    assert!(of("force.spring.f").iter().all(|f| f.is_finite()));
}

#[test]
fn responses_and_their_gradients_know_them() {
    let responses = json!({
        "longest": "max(force.spring.length)", "hardest": "max(force.spring.f)", "lift": "mean(force.lift.power)",
        "slide": "max(joint.guide.slide) - min(joint.guide.slide)", "pin": "max(joint.big.f)",
        "turned": "last(joint.main.angle)" });
    let mut json = older(&json!({ "type": "inverse_dynamics", "end": 1, "outputs": 61 }));
    json["forces"]["lift"] = model(&json!({}))["forces"]["lift"].clone();
    json["parameters"] = json!({ "r": "0.05 m" });
    json["bodies"]["crank"]["points"]["A"] = json!(["=r", 0]);
    json["responses"] = responses;
    let loaded = load(json.to_string().as_bytes(), &[]).expect("a good model");
    let outcome = models::solve(&loaded.model.clone().into_model());
    assert_eq!(outcome.responses[2].unit, "W");
    // responses alone ask for no columns
    assert!(!names(&outcome.trajectory).contains(&"force.spring.length"));
    let family = Family::new(&loaded, &["r"], Given::Values).expect("a family");
    let mut member = family.begin();
    let (mut values, mut slopes) = ([0.0; 6], [0.0; 6]);
    let control = Control::default();
    member
        .gradient(&[0.05], &[0.05], &control, &mut values, &mut slopes)
        .expect("runs");
    for (answer, value) in outcome.responses.iter().zip(values) {
        let found = answer.value.expect("a value");
        assert!(
            (found - value).abs() <= 1e-9 * found.abs().max(1e-3),
            "{}: {found} and {value}",
            answer.name
        );
    }
    let mut beside = |r: f64| {
        let mut values = [0.0; 6];
        member.run(&[r], &control, &mut values).expect("runs");
        values
    };
    let step = 1e-5;
    let (below, above) = (beside(0.05 - step), beside(0.05 + step));
    for k in 0..6 {
        let difference = (above[k] - below[k]) / (2.0 * step);
        let error = (slopes[k] - difference).abs();
        assert!(
            error <= 1e-6 * difference.abs().max(1.0),
            "{k}: {} and {difference}",
            slopes[k]
        );
    }
}
