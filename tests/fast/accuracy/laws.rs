//! Laws of accuracy that hold for all models with one driver.

use super::told::{Told, ask_outputs, bare, is_counted, parametric, spoil, tolerate};
use crate::models;
use crate::transform::{mirror, rename_and_reverse};
use linkdyn_model::{GROUND, Model};
use linkdyn_variation::{Accuracy, PoseAccuracy, Refusal};
use serde_json::{Value, json};

/// Instants of a stroke.
const INSTANTS: usize = 4;

/// Bundled models with one driver that holds their motion and no joint too many, and those of the cases.
fn each_model() -> Vec<(String, Model)> {
    let all = models::all().into_iter();
    let all = all.map(|named| (named.name, models::load(&named.json)));
    all.filter(|(_, model)| model.drivers.len() == 1 && model.analysis.is_some())
        .filter(|(_, model)| is_counted(model))
        .collect()
}

/// The answer with everything off by c; none of models whose joints repeat themselves or whose freedom is not driven.
fn answer(name: &str, json: &Value) -> Option<Accuracy> {
    let told = Told::read(json).unwrap_or_else(|said| panic!("{name}: {said}"));
    match told.ask(&told.loaded.model) {
        Ok(found) => Some(found),
        Err(Refusal::Failed(said)) => panic!("{name}: {said}"),
        Err(Refusal::Input(said)) => {
            let known = |text: &str| {
                text.contains("too few drivers") || text.contains("hold the same freedom")
            };
            assert!(
                said.iter().all(|fault| known(&fault.message)),
                "{name}: {said}"
            );
            None
        }
    }
}

fn poses(found: &Accuracy) -> impl Iterator<Item = (&str, &str, &PoseAccuracy)> {
    found.outputs.iter().flat_map(|output| {
        let poses = output.poses.iter();
        poses.map(|pose| (output.of.as_str(), output.unit, pose))
    })
}

#[test]
fn nothing_found_is_beyond_what_is_certified_and_shares_make_a_whole() {
    let mut faults = Vec::new();
    let (mut tried, mut certain, mut all) = (0, 0, 0);
    for (name, model) in each_model() {
        if name.starts_with("case") {
            continue;
        }
        for c in [1e-4] {
            let mut json = parametric(&model, INSTANTS);
            ask_outputs(&mut json, &model, None);
            spoil(&mut json, c);
            tolerate(&mut json, 0.1 * c);
            let Some(found) = answer(&name, &json) else {
                continue;
            };
            tried += 1;
            for (of, _, pose) in poses(&found) {
                all += 1;
                let mut fault = |what: String| {
                    faults.push(format!(
                        "{name} {of} at {:?}, c {c:e}: {what}",
                        pose.drivers
                    ));
                };
                let shares = pose.shares();
                for k in 0..2 {
                    let sum: f64 = shares.iter().map(|share| share[k]).sum();
                    if sum != 0.0 && (sum - 1.0).abs() > 1e-12 {
                        fault(format!("shares make {sum}"));
                    }
                }
                let Some([low, high]) = pose.certified else {
                    continue;
                };
                certain += 1;
                let [below, above] = pose.first.expect("a first order where there is a bound");
                if below < low || above > high {
                    fault(format!(
                        "first order {below:e} … {above:e} beyond {low:e} … {high:e}"
                    ));
                }
                match pose.found {
                    // Round-off of the nominal position is in both.
                    [Some(below), Some(above)] => {
                        if below < low - 1e-14 || above > high + 1e-14 {
                            fault(format!(
                                "found {below:e} … {above:e} beyond {low:e} … {high:e}"
                            ));
                        }
                    }
                    _ => fault("nothing found where a bound is known".into()),
                }
            }
        }
    }
    println!("{tried} questions, {certain} of {all} outputs certain");
    assert!(
        faults.is_empty(),
        "{} faults:\n{}",
        faults.len(),
        faults[..faults.len().min(30)].join("\n")
    );
    assert!(tried >= 12 && 4 * certain > all, "{tried} {certain} {all}");
}

#[test]
fn worst_cases_become_the_first_order_with_small_clearances() {
    let mut faults = Vec::new();
    let mut compared = 0;
    for (name, model) in each_model() {
        let ask = |c: f64| {
            let mut json = bare(&model, INSTANTS);
            ask_outputs(&mut json, &model, None);
            spoil(&mut json, c);
            answer(&name, &json)
        };
        let (Some(coarse), Some(fine)) = (ask(1e-4), ask(1e-5)) else {
            continue;
        };
        for ((of, _, coarse), (_, _, fine)) in poses(&coarse).zip(poses(&fine)) {
            let off = |pose: &PoseAccuracy| -> Option<f64> {
                pose.certified?;
                let first = pose.first?;
                let ratio = |side: usize| Some((pose.found[side]? / first[side] - 1.0).abs());
                (first[1] > 1e-9).then(|| Some(ratio(0)?.max(ratio(1)?)))?
            };
            let (Some(large), Some(small)) = (off(coarse), off(fine)) else {
                continue;
            };
            compared += 1;
            // A tenth with the first power, besides where the corrections stall, and the square that is left to which of
            // several stationary positions was found.
            let stalled = 1e-8 + 1e-12 / fine.first.map_or(1.0, |by| by[1]);
            if small > 0.12 * large + stalled && small > 0.02 * 1e-5 / 0.05 {
                faults.push(format!(
                    "{name} {of} at {:?}: {large:e}, {small:e}",
                    fine.drivers
                ));
            }
        }
    }
    println!("{compared} compared");
    assert!(
        faults.is_empty(),
        "{} faults:\n{}",
        faults.len(),
        faults[..faults.len().min(30)].join("\n")
    );
    assert!(compared > 500, "{compared}");
}

/// The mechanism with all its lengths times a factor.
fn scaled(json: &Value, factor: f64) -> Value {
    let mut json = json.clone();
    let times = |value: &mut Value| {
        let numbers = value.as_array_mut().expect("a list");
        for number in numbers {
            *number = json!(number.as_f64().expect("a number") * factor);
        }
    };
    for (name, body) in json["bodies"].as_object_mut().expect("bodies") {
        for point in body["points"].as_object_mut().expect("points").values_mut() {
            times(point);
        }
        if name != GROUND && !body["pose"]["position"].is_null() {
            times(&mut body["pose"]["position"]);
        }
        if body.get("com").is_some() {
            times(&mut body["com"]);
        }
    }
    json
}

/// Compares what an answer says with what another lets expect: sign and factor by column.
fn agree(
    name: &str,
    found: &Accuracy,
    other: &Accuracy,
    factor: f64,
    mirrored: bool,
) -> Vec<String> {
    let mut faults = Vec::new();
    for output in &found.outputs {
        let same = |own: &&_| {
            let own: &linkdyn_variation::OutputAccuracy = own;
            own.name == output.name
        };
        let theirs = other.outputs.iter().find(same).expect("the output");
        let factor = if output.unit == "m" { factor } else { 1.0 };
        let flips = mirrored && (output.of.ends_with(".angle") || output.of.ends_with(".x"));
        assert_eq!(output.poses.len(), theirs.poses.len(), "{name}");
        for (ours, theirs) in output.poses.iter().zip(&theirs.poses) {
            let told = |pair: [f64; 2]| {
                if flips { [-pair[1], -pair[0]] } else { pair }.map(|by| by * factor)
            };
            let pairs = [
                ("first", ours.first.map(told), theirs.first),
                ("certified", ours.certified.map(told), theirs.certified),
                ("found", both(ours.found).map(told), both(theirs.found)),
            ];
            let certain = ours.certified.is_some() && theirs.certified.is_some();
            for (what, expected, seen) in pairs {
                let off = match (expected, seen) {
                    (Some(a), Some(b)) => (0..2)
                        .map(|k| (a[k] - b[k]).abs() / a[k].abs().max(1e-6 * factor))
                        .fold(0.0, f64::max),
                    (None, None) => 0.0,
                    (Some(_), None) | (None, Some(_)) => f64::INFINITY,
                };
                // One of several stationary positions is found; they differ by the square of the deviations.
                let allowed = if what == "found" { 4e-4 } else { 1e-7 };
                if certain && off > allowed {
                    let drivers = &ours.drivers;
                    faults.push(format!(
                        "{name} {} {what} at {drivers:?}: {expected:?}, {seen:?}",
                        output.of
                    ));
                }
            }
        }
    }
    faults
}

fn both([low, high]: [Option<f64>; 2]) -> Option<[f64; 2]> {
    Some([low?, high?])
}

#[test]
fn told_otherwise_a_mechanism_is_as_accurate() {
    const C: f64 = 2e-5;
    let mut faults = Vec::new();
    let mut tried = 0;
    for (name, model) in each_model() {
        let mut words = bare(&model, INSTANTS);
        ask_outputs(&mut words, &model, None);
        let spoilt = |words: &Value, c: f64| {
            let mut json = words.clone();
            spoil(&mut json, c);
            // Angles are not scaled.
            for driver in json["drivers"]
                .as_object_mut()
                .expect("drivers")
                .values_mut()
            {
                driver["tolerance"] = json!(C);
            }
            json
        };
        let plain = spoilt(&words, C);
        let Some(found) = answer(&name, &plain) else {
            continue;
        };
        tried += 1;
        let whole = models::load(&plain);
        let renamed = answer(&name, &rename_and_reverse(&whole).to_json()).expect("an answer");
        faults.extend(agree(
            &format!("{name} renamed"),
            &found,
            &renamed,
            1.0,
            false,
        ));
        let mirrored = answer(&name, &mirror(&whole).to_json()).expect("an answer");
        faults.extend(agree(
            &format!("{name} mirrored"),
            &found,
            &mirrored,
            1.0,
            true,
        ));
        let turns = words["drivers"].as_object().expect("drivers");
        let slides = ["prismatic"]
            .iter()
            .any(|kind| words["joints"].to_string().contains(kind));
        if turns.values().all(|driver| driver["type"] == "rotation") && !slides {
            let larger = answer(&name, &spoilt(&scaled(&words, 8.0), 8.0 * C)).expect("an answer");
            faults.extend(agree(
                &format!("{name} scaled"),
                &found,
                &larger,
                8.0,
                false,
            ));
        }
    }
    println!("{tried} models");
    assert!(
        faults.is_empty(),
        "{} faults:\n{}",
        faults.len(),
        faults[..faults.len().min(30)].join("\n")
    );
    assert!(tried >= 20, "{tried}");
}

/// found and first order of the four-bar and of the lock at their certified bound.
#[test]
fn bounds_are_close_where_the_position_is_regular() {
    let cases = [
        ("four-bar", "rocker.angle", 5e-5, vec![60.0]),
        (
            "watt-i-lock",
            "link2.angle",
            1e-5,
            vec![-49.95, -20.0, 0.0, 20.0, 40.0, 60.0],
        ),
    ];
    for (name, column, c, degrees) in cases {
        for degree in degrees {
            let [first, certified] = levels(name, column, c, degree);
            let ratio = certified.expect("a bound") / first.expect("a first order");
            println!("{name} at {degree}: {ratio}");
            assert!(
                (1.0..=1.002).contains(&ratio),
                "{name} at {degree}: {ratio}"
            );
        }
    }
    for degree in [117.0, 117.4, 117.5, 117.5122, 117.51221] {
        let [_, certified] = levels("watt-i-lock", "link2.angle", 1e-5, degree);
        assert_eq!(certified, None, "{degree}");
    }
}

fn levels(name: &str, column: &str, c: f64, degree: f64) -> [Option<f64>; 2] {
    let model = models::load_bundled(name, &[]);
    let mut json = bare(&model, INSTANTS);
    for joint in json["joints"].as_object_mut().expect("joints").values_mut() {
        joint["clearance"] = json!({ "model": "ideal", "radius": c });
    }
    let value = json!(degree.to_radians());
    json["accuracy"] =
        json!({ "outputs": { "o": { "column": column, "at": { "value": value } } } });
    let found = answer(name, &json).expect("an answer");
    let pose = &found.outputs[0].poses[0];
    [
        pose.first.map(|by| by[1]),
        pose.certified.map(|by| by[1].max(-by[0])),
    ]
}

#[test]
fn at_the_change_point_the_reach_goes_with_the_root_of_the_clearance() {
    const CHANGE_POINT: f64 = 117.512_206_516_641_08;
    let model = models::load_bundled("watt-i-lock", &[]);
    let reach = |c: f64| {
        let mut json = bare(&model, INSTANTS);
        for joint in json["joints"].as_object_mut().expect("joints").values_mut() {
            joint["clearance"] = json!({ "model": "ideal", "radius": c });
        }
        let value = CHANGE_POINT.to_radians();
        json["accuracy"] =
            json!({ "outputs": { "o": { "column": "link2.angle", "at": { "value": value } } } });
        let found = answer("lock", &json).expect("an answer");
        let [low, high] = both(found.outputs[0].poses[0].found).expect("a reach");
        0.5 * (high - low)
    };
    // 1e-5, 1e-4, 1e-3 mm
    let all = [1e-8, 1e-7, 1e-6].map(reach);
    for pair in all.windows(2) {
        let exponent = (pair[1] / pair[0]).log10();
        println!("{} {exponent}", pair[0]);
        assert!((exponent - 0.5).abs() <= 0.01, "{exponent}");
    }
}

/// Where an output turns back its influences vanish, and deviations are stationary there that carry it the other way.
#[test]
fn nothing_found_goes_less_far_than_no_deviation() {
    let mut json = parametric(&models::load_bundled("klann-leg", &[]), 201);
    spoil(&mut json, 1e-4);
    tolerate(&mut json, 1e-6);
    json["accuracy"] = json!({ "outputs": { "o": { "column": "upper_rocker.x" } } });
    let found = answer("klann-leg", &json).expect("an answer");
    let mut sides = [0; 2];
    for (_, _, pose) in poses(&found) {
        let [low, high] = pose.found;
        assert!(low.is_none_or(|low| low <= 0.0), "{}: {low:?}", pose.time);
        assert!(
            high.is_none_or(|high| high >= 0.0),
            "{}: {high:?}",
            pose.time
        );
        sides[0] += usize::from(low.is_some());
        sides[1] += usize::from(high.is_some());
    }
    assert!(sides.iter().all(|found| *found >= 199), "{sides:?}");
}
