//! Variants beside a nominal mechanism against runs of the models that they are.

use crate::accuracy::told::{Random, parametric};
use crate::models;
use linkdyn_engine::analysis::{Control, Family, Member, Prepared};
use linkdyn_model::{Given, JointKind, Loaded, Model};
use linkdyn_output::Status;
use serde_json::{Value, json};

/// Instants of a motion.
const INSTANTS: usize = 12;
/// Off by this, relative to the largest place where lengths are metres.
const ALLOWED: f64 = 1e-10;

fn is_shared<T: Send + Sync>() {}
fn is_sent<T: Send>() {}

#[test]
fn a_family_is_shared_by_threads() {
    is_shared::<Family>();
    is_sent::<Member>();
}

/// The model with all numbers of its geometry as parameters, and responses of all bodies; none where it has no motion
/// that drivers prescribe.
pub fn spread(json: &Value, kind: &str) -> Option<Loaded> {
    let model: Model = models::load(json);
    let is_moved = model.analysis.is_some() && !model.drivers.is_empty();
    if !is_moved || model.bodies.len() < 2 {
        return None;
    }
    let mut json = parametric(&model, INSTANTS);
    let mut responses = serde_json::Map::new();
    for name in model.bodies.keys().filter(|name| *name != "ground") {
        responses.insert(format!("top_{name}"), json!(format!("max({name}.y)")));
        responses.insert(
            format!("turn_{name}"),
            json!(format!("range({name}.angle)")),
        );
        responses.insert(format!("late_{name}"), json!(format!("last({name}.ax)")));
    }
    if kind == "inverse_dynamics" {
        let drivers = model.drivers.keys();
        responses.extend(drivers.map(|name| {
            (
                format!("effort_{name}"),
                json!(format!("rms(driver.{name}.effort)")),
            )
        }));
    }
    if kind == "inverse_dynamics" {
        responses.insert("shake".to_owned(), json!("rms(shaking.moment)"));
        responses.insert("push".to_owned(), json!("last(shaking.fx)"));
    }
    transmit(&model, &mut json, &mut responses);
    json["responses"] = Value::Object(responses);
    json["analysis"]["type"] = json!(kind);
    linkdyn_model::load(json.to_string().as_bytes(), &[]).ok()
}

/// Asks for the transmission from the first driver to the body that was named last, and for its least angles.
fn transmit(model: &Model, json: &mut Value, responses: &mut serde_json::Map<String, Value>) {
    let mut moving = model.bodies.keys().filter(|name| *name != "ground");
    let (Some(driver), Some(output)) = (model.drivers.keys().next(), moving.next_back()) else {
        return;
    };
    json["analysis"]["transmission"] = json!({ "driver": driver, "output": output });
    responses.insert("ratio".to_owned(), json!("last(transmission.ratio)"));
    for (name, joint) in &model.joints {
        let carries = matches!(
            joint.kind,
            JointKind::Revolute { .. } | JointKind::Slot { .. }
        );
        let is_of = |body: &str| joint.between.iter().any(|end| end.body == body);
        if carries && is_of(output) && !is_of("ground") {
            let least = format!("min(transmission.{name}.angle)");
            responses.insert(format!("angle_{name}"), json!(least));
        }
    }
}

/// Values of all parameters, off by some part.
pub fn off(loaded: &Loaded, part: f64, random: &mut Random) -> Vec<f64> {
    let parameters = loaded.parameters.iter();
    parameters
        .map(|one| {
            let scale = if one.value == 0.0 { 0.01 } else { one.value };
            one.value + part * scale * random.both()
        })
        .collect()
}

/// What a run of the model itself gives.
pub fn alone(family: &Family, values: &[f64]) -> (Option<Status>, Vec<f64>) {
    let none = vec![f64::NAN; family.responses().len()];
    let Ok(model) = family.model(values) else {
        return (None, none);
    };
    match Prepared::new(&model).and_then(|prepared| prepared.run(&Control::default())) {
        Err(_) => (None, none),
        Ok(outcome) => {
            let answers = outcome.responses.iter();
            let values = answers.map(|answer| answer.value.unwrap_or(f64::NAN));
            (Some(outcome.report.status), values.collect())
        }
    }
}

/// What a member of the family gives.
pub fn beside(member: &mut Member, values: &[f64], count: usize) -> (Option<Status>, Vec<f64>) {
    let mut responses = vec![f64::NAN; count];
    match member.run(values, &Control::default(), &mut responses) {
        Ok(ended) => (Some(ended.status), responses),
        Err(_) => (None, vec![f64::NAN; count]),
    }
}

#[test]
fn variants_are_the_models_that_they_are() {
    let (mut tracked, mut compared) = (0, 0);
    for (index, named) in models::all().into_iter().enumerate() {
        for kind in ["kinematics", "inverse_dynamics"] {
            let Some(loaded) = spread(&named.json, kind) else {
                continue;
            };
            let names = loaded.parameters.iter().map(|one| one.name.as_str());
            let names: Vec<&str> = names.collect();
            let Ok(family) = Family::new(&loaded, &names, Given::Values) else {
                continue;
            };
            tracked += usize::from(family.is_tracked());
            let mut random = Random(index as u64);
            let mut member = family.begin();
            let count = family.responses().len();
            for part in [1e-4, 0.01, 0.05] {
                let values = off(&loaded, part, &mut random);
                let (status, found) = beside(&mut member, &values, count);
                let (expected, answers) = alone(&family, &values);
                assert_eq!(status, expected, "{} {kind} {part}", named.name);
                for ((own, found), answer) in
                    family.responses().list().iter().zip(&found).zip(&answers)
                {
                    let scale = answer.abs().max(1.0);
                    assert!(
                        (found - answer).abs() <= ALLOWED * scale
                            || found.is_nan() && answer.is_nan(),
                        "{} {kind} {part} {}: {found}, not {answer}",
                        named.name,
                        own.name
                    );
                    compared += 1;
                }
            }
        }
    }
    assert!(tracked >= 20, "{tracked} families are tracked");
    assert!(compared >= 1000, "{compared} numbers compared");
}

#[test]
fn what_comes_out_depends_on_the_values_alone() {
    let json = serde_json::from_str(linkdyn_model::bundled::find("four-bar").expect("it").text);
    let loaded = spread(&json.expect("valid JSON"), "inverse_dynamics").expect("it moves");
    let names: Vec<&str> = loaded
        .parameters
        .iter()
        .map(|one| one.name.as_str())
        .collect();
    let family = Family::new(&loaded, &names, Given::Values).expect("it runs");
    assert!(family.is_tracked());
    let mut random = Random(7);
    // some of them do not go round
    let all: Vec<Vec<f64>> = (0..40)
        .map(|k| off(&loaded, if k % 4 == 3 { 0.6 } else { 0.05 }, &mut random))
        .collect();
    let count = family.responses().len();
    let fresh = all
        .iter()
        .map(|values| beside(&mut family.begin(), values, count));
    let fresh: Vec<_> = fresh.collect();
    let mut member = family.begin();
    for (values, (status, expected)) in all.iter().zip(&fresh).rev() {
        let (again, found) = beside(&mut member, values, count);
        assert_eq!(again, *status);
        let bits = |values: &[f64]| {
            values
                .iter()
                .map(|value| value.to_bits())
                .collect::<Vec<_>>()
        };
        assert_eq!(bits(&found), bits(expected));
    }
    let whole = fresh
        .iter()
        .filter(|(status, _)| *status == Some(Status::Completed));
    let whole = whole.count();
    assert!((20..40).contains(&whole), "{whole} of 40 go round");
}

#[test]
fn variants_beyond_a_dead_centre_are_told() {
    let sets = [
        "responses.swing=range(rocker.angle)",
        "analysis.type=kinematics",
        "analysis.outputs=13",
    ];
    let text = linkdyn_model::bundled::find("four-bar").expect("it").text;
    let loaded = linkdyn_model::load(text.as_bytes(), &sets.map(str::to_owned)).expect("sound");
    let family = Family::new(&loaded, &["crank"], Given::Values).expect("it runs");
    let mut member = family.begin();
    // Grashof: 300 mm + crank <= 250 mm + 200 mm
    for (crank, expected) in [
        (0.149, Status::Completed),
        (0.149_999, Status::Completed),
        (0.150_001, Status::DeadCentre),
        (0.151, Status::DeadCentre),
        (0.19, Status::DeadCentre),
    ] {
        let (status, _) = beside(&mut member, &[crank], 1);
        assert_eq!(status, Some(expected), "crank {crank} m");
    }
}
