//! Responses against closed forms: a slider-crank with r = 50 mm and l = 200 mm, 61 rows of one turn.

mod between;
mod complaints;
mod lists;

use linkdyn_engine::analysis::responses::Answer;
use linkdyn_engine::analysis::{Control, Prepared};
use linkdyn_model::{Checked, JointKind, Loaded, Response, bundled, load};
use linkdyn_output::{Report, Status};
use std::f64::consts::{PI, TAU};

const R: f64 = 0.05;
const L: f64 = 0.2;

/// A slider-crank that turns once in a second, forces by masses; rows every 6°.
const SLIDER_CRANK: &str = r#"{ "format": "linkdyn/1", "units": { "length": "mm", "angle": "deg" },
  "parameters": { "r": "50 mm", "l": "200 mm" },
  "bodies": {
    "ground": { "points": { "O": [0, 0] } },
    "crank": { "mass": 1, "inertia": 0.001, "com": [0, 0], "points": { "O": [0, 0], "A": ["=r", 0] } },
    "rod": { "mass": 0, "inertia": 0, "com": [0, 0], "points": { "A": [0, 0], "B": ["=l", 0] }, "pose": { "position": [50, 0] } },
    "piston": { "mass": 2, "inertia": 0, "com": [0, 0], "points": { "B": [0, 0] }, "pose": { "position": [250, 0] } } },
  "joints": {
    "main": { "type": "revolute", "between": ["ground.O", "crank.O"] },
    "big": { "type": "revolute", "between": ["crank.A", "rod.A"] },
    "small": { "type": "revolute", "between": ["rod.B", "piston.B"] },
    "guide": { "type": "prismatic", "between": ["ground.O", "piston.B"], "axis": [1, 0] } },
  "drivers": { "motor": { "type": "rotation", "body": "crank", "motion": { "type": "constant_velocity", "velocity": "60 rpm" } } },
  "points": ["crank.A"],
  "analysis": { "type": "inverse_dynamics", "end": 1, "outputs": 61 } }"#;

/// The model with responses.
fn model(texts: &[&str]) -> Checked {
    let loaded = load(SLIDER_CRANK.as_bytes(), &[]).expect("a good model");
    let with = loaded.model.edit(|model| {
        for (index, text) in texts.iter().enumerate() {
            model
                .responses
                .insert(format!("n{index}"), Response::new(*text));
        }
    });
    with.expect("good responses")
}

/// The answers of a model.
fn answers(model: &Checked) -> Vec<Answer> {
    let prepared = Prepared::new(model).expect("runs");
    let outcome = prepared.run(&Control::default()).expect("runs");
    outcome.responses
}

/// The text of the model with a key `responses`.
fn with_responses(responses: &str) -> String {
    SLIDER_CRANK.replacen('{', &format!("{{ \"responses\": {responses},\n"), 1)
}

fn loaded(responses: &str) -> Loaded {
    load(with_responses(responses).as_bytes(), &[]).expect("good responses")
}

fn value(text: &str) -> (f64, String) {
    let answer = answers(&model(&[text])).remove(0);
    let value = answer.value;
    (
        value.unwrap_or_else(|| panic!("{text}: {:?}", answer.reason)),
        answer.unit,
    )
}

fn holds(text: &str, expected: f64, unit: &str, within: f64) {
    let (found, own) = value(text);
    assert!(
        (found - expected).abs() <= within,
        "{text}: {found}, not {expected}"
    );
    assert_eq!(own, unit, "{text}");
}

#[test]
fn positions_are_those_of_the_closed_form() {
    // rows stand at both dead centres
    holds("max(piston.x) - min(piston.x)", 2.0 * R, "m", 1e-12);
    holds("range(piston.x)", 2.0 * R, "m", 1e-12);
    holds(
        "at(piston.x, driver.motor = 90 deg)",
        (L * L - R * R).sqrt(),
        "m",
        1e-12,
    );
    holds(
        "at(piston.x, driver.motor.value = 90 deg)",
        (L * L - R * R).sqrt(),
        "m",
        1e-12,
    );
    holds("first(piston.x)", L + R, "m", 1e-12);
    holds("last(piston.x)", L + R, "m", 1e-12);
    holds("argmin(piston.x)", 0.5, "s", 1e-12);
    holds("argmax(piston.x)", 0.0, "s", 0.0);
    holds("max(abs(rod.angle))", (R / L).asin(), "rad", 1e-12);
    holds("sin(max(abs(rod.angle)))*200 mm", R, "m", 1e-12);
}

#[test]
fn integrals_over_a_turn_are_those_of_a_sine() {
    // the trapezium rule is exact for sines over whole turns, and 61 rows take more than their squares
    holds("integral(crank.A.y)", 0.0, "m*s", 1e-15);
    holds("rms(crank.A.y)", R / 2f64.sqrt(), "m", 1e-14);
    holds("mean(crank.A.y^2)", R * R / 2.0, "m^2", 1e-15);
    holds("mean(crank.omega)", TAU, "rad/s", 1e-10);
    holds("integral(crank.omega)", TAU, "rad", 1e-10);
    // half of h²/12·(y'(1/2) − y'(0)) with y' = ∓2πr is what the rule lacks of r/π over half a turn
    let half = "integral((crank.A.y + abs(crank.A.y))/2)";
    let lacking = R / PI * (1.0 - (PI / 60.0) / (PI / 60.0).tan());
    holds(half, R / PI - lacking, "m*s", 1e-14);
}

#[test]
fn parameters_follow_and_are_printed_with_their_values() {
    let loaded = loaded(
        r#"{ "free": { "value": "max(piston.x)/l - 1 + 0*r/l", "limits": [0, 0.5] }, "s": "range(piston.x) - 2*r" }"#,
    );
    let value = |model: &Checked| answers(model)[0].value.expect("a value");
    assert!((value(&loaded.model) - R / L).abs() < 1e-12);
    let longer = loaded
        .source
        .with_parameters(&[("r", 0.06), ("l", 0.3)])
        .expect("a model");
    assert!((value(&longer) - 0.2).abs() < 1e-12);
    assert_eq!(loaded.source.print(&loaded.model), loaded.document);
    // without the parameters the numbers stand in their place
    let text = loaded.model.to_json();
    assert_eq!(text["responses"]["s"], "range(piston.x) - 2*(0.05 m)");
    let again = load(text.to_string().as_bytes(), &[]).expect("what was printed");
    assert_eq!(
        value(&again.model).to_bits(),
        value(&loaded.model).to_bits()
    );
}

#[test]
fn limits_are_in_the_units_of_the_file() {
    let loaded = loaded(
        r#"{ "a": { "value": "max(piston.x)", "limits": [79, "81 mm"], "unit": "cm" },
             "b": { "value": "max(rod.angle)", "limits": [-30, "=10*2 deg"] },
             "c": { "value": "max(rod.omega)*rms(crank.omega)", "limits": [1, 2] } }"#,
    );
    let limits = |name: &str| loaded.model.responses[name].limits.expect("limits");
    assert_eq!(limits("a"), [0.079, 0.081]);
    assert_eq!(limits("b"), [-PI / 6.0, 20f64.to_radians()]);
    assert_eq!(limits("c"), [1.0, 2.0]);
    let found = answers(&loaded.model).remove(0);
    assert_eq!(found.shown, Some(("cm".to_owned(), 0.01)));
    // limits that the program changes are printed in SI, and read as the same doubles
    let changed = loaded
        .model
        .edit(|model| model.responses["a"].limits = Some([0.0791, 0.0811]));
    let changed = changed.expect("a model");
    let printed = loaded.source.print(&changed);
    assert_eq!(printed["responses"]["a"]["limits"][0], "0.0791 m");
    let again = load(printed.to_string().as_bytes(), &[]).expect("what was printed");
    assert_eq!(again.model.responses, changed.responses);
}

#[test]
fn no_value_has_a_reason() {
    let reason = |text: &str| answers(&model(&[text])).remove(0).reason.expect("none");
    assert_eq!(
        reason("at(piston.x, crank.angle = 400 deg)"),
        "at(piston.x, crank.angle = 400 deg): this never happens"
    );
    assert_eq!(
        reason("max(1 m/(crank.A.y - 2 m + abs(crank.A.y - 2 m)))"),
        "it has no finite value at 0 s"
    );
    assert_eq!(
        reason("1/(first(crank.A.y)/(1 m))"),
        "its value is not finite"
    );
    assert_eq!(
        reason("max(contacts.impulse)"),
        "max(contacts.impulse): there is nothing of this kind"
    );
    assert_eq!(
        reason("clearances.big.impulse"),
        "joint \"big\" has no contacts in this run"
    );
    assert_eq!(
        reason("quality.energy_imbalance"),
        "this run has no quality.energy_imbalance"
    );
    // a run that ends early has numbers of its own, and no others
    let model = model(&["max(piston.x)", "status"]);
    let prepared = Prepared::new(&model).expect("runs");
    let outcome = prepared.run(&Control::default()).expect("runs");
    let report = Report {
        status: Status::DeadCentre,
        ..outcome.report.clone()
    };
    let mut evaluation = prepared.responses().begin();
    let answers = evaluation.answers(&report);
    assert_eq!(
        answers[0].reason.as_deref(),
        Some("the run ended early: dead_centre")
    );
    assert_eq!((answers[0].value, answers[1].value), (None, Some(0.0)));
}

#[test]
fn contacts_and_events_are_counted_and_summed() {
    let text = bundled::text("slider-crank-clearance").expect("bundled");
    let mut model = load(text.as_bytes(), &[])
        .expect("a model")
        .model
        .into_model();
    let joint = model
        .joints
        .iter()
        .find(|(_, joint)| {
            matches!(
                &joint.kind,
                JointKind::Revolute {
                    clearance: Some(_),
                    ..
                }
            )
        })
        .expect("one")
        .0
        .clone();
    let sets = [
        "count(contacts.impulse)".to_owned(),
        "sum(contacts.impulse)".to_owned(),
        "count(events.contact)".to_owned(),
        format!("clearances.{joint}.impulse"),
        format!("max(joint.{joint}.normal_force)"),
        "max(contacts.peak_force)".to_owned(),
        format!("sum(clearances.{joint}.wear)"),
        format!("clearances.{joint}.contacts"),
    ];
    for text in &sets {
        model
            .responses
            .insert(text.replace('.', " "), Response::new(text.clone()));
    }
    let model = model.check().expect("good responses");
    let outcome = Prepared::new(&model)
        .expect("runs")
        .run(&Control::default())
        .expect("runs");
    let values: Vec<f64> = outcome
        .responses
        .iter()
        .map(|one| one.value.unwrap_or_else(|| panic!("{one:?}")))
        .collect();
    let sums = &outcome.report.clearances[0];
    assert!(sums.episodes > 1, "{sums:?}");
    assert_eq!(values[0], sums.episodes as f64);
    assert_eq!(values[7], sums.episodes as f64);
    assert_eq!(values[3], sums.impulse);
    assert!(
        (values[1] - sums.impulse).abs() <= 1e-9 * sums.impulse,
        "{values:?}"
    );
    assert!(values[2] >= 1.0 && values[4] > 0.0, "{values:?}");
    assert!(
        (values[4] - values[5]).abs() <= 1e-6 * values[5],
        "{values:?}"
    );
    assert!(
        (values[6] - sums.wear.iter().sum::<f64>()).abs() <= 1e-12 * values[6].abs(),
        "{values:?}"
    );
}

#[test]
fn rows_that_come_one_by_one_give_the_same() {
    let model = model(&[
        "range(piston.x)",
        "rms(joint.big.fx)",
        "count(piston.x = 200 mm)",
    ]);
    let prepared = Prepared::new(&model).expect("runs");
    let responses = prepared.responses();
    let outcome = prepared.run(&Control::default()).expect("runs");
    let mut evaluation = responses.begin();
    let mut values = [0.0; 3];
    // the second time after another run
    for _ in 0..2 {
        evaluation.restart();
        for row in outcome.all().rows() {
            let row: Vec<f64> = responses
                .needed()
                .iter()
                .map(|column| row[column.index()])
                .collect();
            evaluation.row(&row);
        }
        evaluation.finish(&outcome.report, &mut values);
    }
    let at_once: Vec<f64> = outcome
        .responses
        .iter()
        .map(|one| one.value.expect("a value"))
        .collect();
    assert_eq!(values.to_vec(), at_once);
    assert_eq!(values[2], 2.0);
    assert_eq!(responses.needed().len(), 3);
    fn is_shared<T: Send + Sync>(_: &T) {}
    is_shared(responses);
}
