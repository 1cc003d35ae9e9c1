//! Sensitivities against central differences of runs: numbers of all models are parameters.

use super::told;
use crate::accuracy::told::{Random, Told};
use crate::models;
use linkdyn_engine::analysis::{Control, Outcome, run};
use linkdyn_model::{AnalysisKind, Model};
use linkdyn_variation::Accuracy;
use serde_json::{Map, Value, json};

/// Numbers of a model that become parameters: not all of them, where there are many.
#[derive(Default)]
struct Numbers {
    seen: usize,
    every: usize,
    taken: Map<String, Value>,
}

impl Numbers {
    /// Those below a place but zeros, which may have to stay above zero.
    fn take(&mut self, place: &mut Value) {
        match place {
            Value::Number(number) if number.as_f64() != Some(0.0) => {
                self.seen += 1;
                if self.seen.is_multiple_of(self.every.max(1)) {
                    let name = format!("p{}", self.taken.len());
                    self.taken.insert(name.clone(), place.clone());
                    *place = json!(format!("={name}"));
                }
            }
            Value::Array(all) => all.iter_mut().for_each(|own| self.take(own)),
            Value::Object(all) => all.values_mut().for_each(|own| self.take(own)),
            Value::Null | Value::Bool(_) | Value::Number(_) | Value::String(_) => {}
        }
    }

    fn take_of(&mut self, json: &mut Value) {
        for body in json["bodies"].as_object_mut().expect("bodies").values_mut() {
            for key in ["mass", "inertia", "com", "points"] {
                body.get_mut(key).into_iter().for_each(|own| self.take(own));
            }
        }
        for key in ["forces", "gravity"] {
            json.get_mut(key).into_iter().for_each(|own| self.take(own));
        }
    }
}

/// Most parameters of one model.
const MOST: usize = 24;

/// A model with ideal joints at four instants, numbers of its bodies, forces and gravity parameters; it asks for its efforts
/// and for what three of its joints carry.
fn with_parameters(model: &Model) -> Value {
    let mut json = model.to_json();
    for body in json["bodies"].as_object_mut().expect("bodies").values_mut() {
        for point in body["points"].as_object_mut().expect("points").values_mut() {
            if let Some(place) = point.get("position") {
                *point = place.clone();
            }
        }
    }
    let mut all = Numbers::default();
    all.take_of(&mut json.clone());
    let mut numbers = Numbers {
        every: all.seen.div_ceil(MOST),
        ..Numbers::default()
    };
    numbers.take_of(&mut json);
    json["parameters"] = Value::Object(numbers.taken);
    let mut columns = Vec::new();
    for (name, driver) in json["drivers"].as_object_mut().expect("drivers") {
        columns.push(format!("driver.{name}.effort"));
        driver["tolerance"] = json!(1e-9);
    }
    for (name, joint) in json["joints"].as_object_mut().expect("joints") {
        joint.as_object_mut().expect("a joint").remove("clearance");
        if columns.len() < 6 && joint["type"] == "revolute" {
            columns.extend(["fx", "fy"].map(|of| format!("joint.{name}.{of}")));
        }
    }
    let asked = columns.iter().enumerate();
    let asked = asked.map(|(k, column)| (format!("o{k}"), json!({ "column": column })));
    json["accuracy"] = json!({ "outputs": asked.collect::<Map<_, _>>() });
    let analysis = model.analysis.as_ref().expect("an analysis");
    json["analysis"] = match &analysis.sample {
        Some(sample) => {
            let span = sample.to - sample.from;
            json!({ "type": "inverse_dynamics", "sample": { "driver": sample.driver, "from": sample.from + 0.02 * span,
                "to": sample.to - 0.02 * span, "step": 0.32 * span } })
        }
        None => json!({ "type": "inverse_dynamics", "end": analysis.end, "outputs": 4 }),
    };
    json
}

/// Step along a direction of all parameters, relative: what is left out goes with its fourth power, round-off with its inverse.
const STEP: f64 = 1e-4;
/// Off the largest by this, where singular positions are far.
const ALLOWED: f64 = 1e-7;

/// Greatest difference between sensitivities and central differences of runs, relative; and how many were compared.
fn compare(name: &str, told: &Told, found: &Accuracy, random: &mut Random) -> (f64, usize) {
    let known = &told.loaded.parameters;
    let direction: Vec<f64> = known
        .iter()
        .map(|own| random.both().signum() * own.value)
        .collect();
    let runs = [-2.0, -1.0, 1.0, 2.0, 0.0].map(|by| -> Outcome {
        let off = known
            .iter()
            .zip(&direction)
            .map(|(own, d)| (own.name.as_str(), by * STEP * d));
        let model = told.loaded.source.with_deviations(&off.collect::<Vec<_>>());
        run(&model.expect("legal"), &Control::default()).expect("a run")
    });
    let (mut worst, mut compared) = (0.0, 0);
    for unit in ["N", "N*m"] {
        let mut pairs: Vec<[f64; 2]> = Vec::new();
        let mut size = 0.0_f64;
        for output in found.outputs.iter().filter(|output| output.unit == unit) {
            let values = runs
                .each_ref()
                .map(|run| run.trajectory.values(&output.of).expect("a column"));
            for (row, pose) in output
                .poses
                .iter()
                .enumerate()
                .filter(|(_, pose)| pose.first.is_some())
            {
                let [a, b, c, d, nominal] = values
                    .each_ref()
                    .map(|own| own.get(row).copied().unwrap_or(f64::NAN));
                let expected = (8.0 * (c - b) - (d - a)) / (12.0 * STEP);
                let said = known.iter().zip(&direction).filter_map(|(own, d)| {
                    let source = format!("parameters.{}", own.name);
                    let place = found.sources.iter().position(|own| *own == source)?;
                    Some(d * pose.contributions[place].sensitivity)
                });
                assert!(
                    (pose.nominal - nominal).abs() <= 1e-9 * nominal.abs().max(1e-3),
                    "{name} {}: {} {nominal}",
                    output.of,
                    pose.nominal
                );
                size = size.max(expected.abs()).max(nominal.abs());
                pairs.push([said.sum(), expected]);
            }
        }
        for [said, expected] in pairs {
            compared += 1;
            worst = f64::max(worst, (said - expected).abs() / size.max(1e-6));
            assert!(
                (said - expected).abs() <= ALLOWED * size.max(1e-6),
                "{name}: {said} instead of {expected} {unit}"
            );
        }
    }
    (worst, compared)
}

#[test]
fn sensitivities_are_those_of_runs_with_other_numbers() {
    let mut random = Random(5);
    let mut tried = 0;
    for named in models::all() {
        let model = models::load(&named.json);
        let prescribed = model.analysis.as_ref().is_some_and(|analysis| {
            matches!(
                analysis.kind,
                AnalysisKind::Kinematics | AnalysisKind::InverseDynamics
            )
        });
        // Beside a change point differences of this step mean nothing.
        if !prescribed || model.drivers.is_empty() || named.name.contains("lock") {
            continue;
        }
        let told = told(&with_parameters(&model));
        let Ok(found) = told.ask(&told.loaded.model) else {
            continue;
        };
        let (worst, compared) = compare(&named.name, &told, &found, &mut random);
        println!(
            "{:40} {worst:.1e} {compared:3} of {:3}",
            named.name,
            told.loaded.parameters.len()
        );
        assert!(compared >= 8, "{}: {compared}", named.name);
        tried += 1;
    }
    assert!(tried >= 20, "{tried}");
}
