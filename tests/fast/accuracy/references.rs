//! Influences, first order and worst cases against the references of `validation/accuracy-*`, computed with 40 digits by loop
//! equations, without multipliers.

use super::{asked, clearances, file};
use serde_json::{Map, Value, json};

const CASES: [&str; 8] = [
    "four-bar",
    "slider-crank",
    "clutch",
    "lock",
    "lock-points",
    "random-1",
    "random-2",
    "random-3",
];

fn number(value: &Value) -> f64 {
    value.as_str().expect("digits").parse().expect("a number")
}

fn list<'a>(value: &'a Value, key: &str) -> &'a [Value] {
    value[key].as_array().map_or(&[], Vec::as_slice)
}

fn map<'a>(value: &'a Value, key: &str) -> &'a Map<String, Value> {
    value[key].as_object().unwrap_or_else(|| panic!("{key}"))
}

/// Difference by the size of the reference, or of the largest beside it.
fn off(found: &Value, expected: f64, size: f64) -> f64 {
    let found = found.as_f64().unwrap_or(f64::NAN);
    (found - expected).abs() / expected.abs().max(size)
}

struct Case {
    name: &'static str,
    model: String,
    poses: Vec<Value>,
}

impl Case {
    fn read(name: &'static str) -> Case {
        let path = file(&format!("validation/accuracy-{name}/expected.json"));
        let text = std::fs::read_to_string(path).expect("a reference");
        let value: Value = serde_json::from_str(&text).expect("JSON");
        Case {
            name,
            model: file(value["model"].as_str().expect("a model"))
                .display()
                .to_string(),
            poses: list(&value, "poses").to_vec(),
        }
    }

    /// The outputs of a pose with a clearance in all pins, by their places.
    fn ask(&self, pose: &Value, c: f64) -> Value {
        let mut outputs = Map::new();
        for (k, output) in list(pose, "outputs").iter().enumerate() {
            let mut asked = json!({ "column": output["column"] });
            if let Some(driver) = pose["driver"].as_object() {
                asked["at"] = json!({ "driver": driver["name"], "value": format!("{:e} rad", number(&driver["value"])) });
            }
            outputs.insert(format!("o{k}"), asked);
        }
        // At a change point no pin has an influence.
        let joints: Vec<String> = map(&list(&self.poses[0], "outputs")[0], "pins")
            .keys()
            .cloned()
            .collect();
        let mut sets = clearances(&joints, c);
        sets.push(format!("accuracy={}", json!({ "outputs": outputs })));
        asked(&self.model, &sets)
    }
}

/// Worst of a list, with what it was.
#[derive(Default)]
struct Worst(f64, String);

impl Worst {
    fn take(&mut self, off: f64, what: impl FnOnce() -> String) {
        if off > self.0 || off.is_nan() {
            *self = Worst(off, what());
        }
    }
}

#[test]
fn influences_agree_to_round_off() {
    let mut worst = Worst::default();
    for case in CASES.map(Case::read) {
        for pose in &case.poses {
            let found = case.ask(pose, 1e-6);
            for (k, output) in list(pose, "outputs").iter().enumerate() {
                let own = &found["outputs"][format!("o{k}")]["poses"][0];
                let what = |word: &str| {
                    format!(
                        "{} {} {} {word}",
                        case.name, pose["driver"]["value"], output["column"]
                    )
                };
                worst.take(
                    off(&own["nominal"], number(&output["nominal"]), 1.0),
                    || what("nominal"),
                );
                let all = &own["contributions"];
                let sensitivities = map(output, "sensitivities");
                let size = sensitivities
                    .values()
                    .map(|s| number(s).abs())
                    .fold(0.0, f64::max);
                for (name, expected) in sensitivities {
                    worst.take(
                        off(&all[name]["sensitivity"], number(expected), size),
                        || what(name),
                    );
                }
                let pins = map(output, "pins");
                let size = pins
                    .values()
                    .map(|pin| number(&pin["g"]))
                    .fold(0.0, f64::max);
                for (name, expected) in pins {
                    let found = &all[format!("joints.{name}")]["sensitivity"];
                    worst.take(off(found, number(&expected["g"]), size), || what(name));
                }
            }
        }
    }
    println!("{} {}", worst.0, worst.1);
    assert!(worst.0 <= 1e-12, "{}: {}", worst.1, worst.0);
}

#[test]
fn worst_cases_agree() {
    let (mut first, mut found, mut spread, mut root) = Default::default();
    let _: [&Worst; 4] = [&first, &found, &spread, &root];
    for case in CASES.map(Case::read) {
        for pose in &case.poses {
            let mut sizes: Vec<f64> = Vec::new();
            for output in list(pose, "outputs") {
                let all = list(output, "first_order")
                    .iter()
                    .chain(list(output, "worst"));
                sizes.extend(all.map(|entry| number(&entry["c"])));
            }
            sizes.sort_by(f64::total_cmp);
            sizes.dedup();
            for c in sizes {
                let answer = case.ask(pose, c);
                for (k, output) in list(pose, "outputs").iter().enumerate() {
                    let own = &answer["outputs"][format!("o{k}")]["poses"][0];
                    let what = || {
                        format!(
                            "{} {} {} c {c}",
                            case.name, pose["driver"]["value"], output["column"]
                        )
                    };
                    let same = |entry: &&Value| number(&entry["c"]) == c;
                    for entry in list(output, "first_order").iter().filter(same) {
                        first.take(off(&own["first"][1], number(&entry["value"]), 0.0), what);
                    }
                    for entry in list(output, "worst").iter().filter(same) {
                        for (side, key) in ["minus", "plus"].into_iter().enumerate() {
                            if let Some(digits) = entry.get(key) {
                                // At a change point the reach is the root of the clearance: round-off of a length counts by
                                // the reach.
                                if map(output, "pins").is_empty() {
                                    root.take(off(&own["found"][side], number(digits), 0.0), what);
                                    continue;
                                }
                                // Values of some radians or metres are known to some 1e-15 in doubles, and lengths to 1e-16 m,
                                // which singular positions magnify as they do clearances.
                                let magnified = own["first"][1].as_f64().expect("a number") / c;
                                let floor = 2e-3 * number(&output["nominal"]).abs().max(1.0);
                                let floor = floor.max(1e-4 * magnified);
                                found.take(off(&own["found"][side], number(digits), floor), || {
                                    format!("{} {key}", what())
                                });
                            }
                        }
                    }
                    for entry in list(output, "sigma").iter().filter(same) {
                        spread.take(off(&own["sigma"], number(&entry["rim"]), 0.0), what);
                    }
                }
            }
        }
    }
    for (worst, most) in [
        (&first, 1e-12),
        (&found, 1e-12),
        (&spread, 1e-12),
        (&root, 1e-9),
    ] {
        println!("{} {}", worst.0, worst.1);
        assert!(worst.0 <= most, "{}: {}", worst.1, worst.0);
    }
}

/// V5: with tolerances of its three lengths the clutch has the worst cases and the root sum of squares of the reference.
#[test]
fn tolerances_of_the_clutch_add_up() {
    let case = Case::read("clutch");
    let output = &list(&case.poses[0], "outputs")[0];
    let expected = &output["tolerances"];
    let named = map(expected, "half_widths").iter();
    let mut sets: Vec<String> = named
        .map(|(name, half)| format!("{name}.tolerance=\"{} m\"", half.as_str().expect("digits")))
        .collect();
    sets.push(format!(
        "accuracy={}",
        json!({ "outputs": { "phi": { "column": output["column"] } } })
    ));
    let found = asked(&case.model, &sets);
    let own = &found["outputs"]["phi"]["poses"][0];
    let mut worst = Worst::default();
    let mut take = |found: f64, key: &str| {
        let off = (found / number(&expected[key]) - 1.0).abs();
        worst.take(off, || key.to_owned());
    };
    let digits = |value: &Value| value.as_f64().unwrap_or(f64::NAN);
    take(digits(&own["first"][1]), "worst_first_order");
    take(digits(&own["found"][0]), "minus");
    take(digits(&own["found"][1]), "plus");
    take(3.0 * digits(&own["sigma"]), "rss");
    for (name, share) in map(expected, "shares_of_worst") {
        let found = &own["contributions"][name];
        worst.take(off(&found["worst_share"], number(share), 0.0), || {
            name.clone()
        });
        let share = &expected["shares_of_variance"][name];
        worst.take(off(&found["variance_share"], number(share), 0.0), || {
            name.clone()
        });
    }
    println!("{} {}", worst.0, worst.1);
    assert!(worst.0 <= 1e-12, "{}: {}", worst.1, worst.0);
}
