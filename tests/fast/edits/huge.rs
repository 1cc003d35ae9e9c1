//! Every number of a model, one after the other, is as large or as small as a number can be.

use super::{short, sources, watch};
use linkdyn_engine::analysis::{Control, check, run};
use linkdyn_model::Model;
use serde_json::Value;
use std::time::{Duration, Instant};

/// Numbers that a file may hold: they overflow, or their squares do or vanish.
const EXTREME: [f64; 4] = [1e308, -1e308, 1e200, 1e-200];

/// Paths of all numbers.
fn paths(value: &Value, path: &str, found: &mut Vec<String>) {
    match value {
        Value::Object(members) => members
            .iter()
            .for_each(|(key, value)| paths(value, &format!("{path}/{key}"), found)),
        Value::Array(items) => items
            .iter()
            .enumerate()
            .for_each(|(index, value)| paths(value, &format!("{path}/{index}"), found)),
        Value::Number(_) => found.push(path.to_owned()),
        Value::Null | Value::Bool(_) | Value::String(_) => {}
    }
}

/// What linkdyn says of a model that is refused or ends early; whether it ran.
fn said_of(model: Model) -> (Vec<String>, bool) {
    let Ok(model) = model.check() else {
        // The gate's words have tests of their own.
        return (Vec::new(), false);
    };
    let mut said = Vec::new();
    let checked = check(&model).map(|found| found.message);
    let control = Control {
        deadline: Some(Instant::now() + Duration::from_millis(5)),
        ..Control::default()
    };
    let found = short(&model).map(|model| run(&model, &control));
    let found = found.map(|found| found.map(|outcome| outcome.report.message));
    let is_run = matches!(found, Some(Ok(_)));
    for found in [Some(checked), found].into_iter().flatten() {
        match found {
            Ok(message) => said.extend(message),
            Err(complaints) => {
                assert!(!complaints.is_empty());
                said.extend(complaints.iter().map(ToString::to_string));
            }
        }
    }
    (said, is_run)
}

#[test]
fn a_number_may_be_as_large_or_small_as_it_likes() {
    let [tried, ran] = watch::in_time(|begins| {
        let (mut tried, mut ran) = (0, 0);
        for loaded in sources() {
            let words = serde_json::to_value(&*loaded.model).expect("JSON");
            let mut numbers = Vec::new();
            paths(&words, "", &mut numbers);
            for (path, extreme) in numbers
                .iter()
                .flat_map(|path| EXTREME.map(|extreme| (path, extreme)))
            {
                let name = loaded.model.name.as_deref().unwrap_or_default();
                let what = format!("{name}: {path} = {extreme:e}");
                begins(what.clone());
                let mut words = words.clone();
                *words.pointer_mut(path).expect("it is there") = extreme.into();
                // Counts are no such numbers.
                let Ok(mut model) = serde_json::from_value::<Model>(words) else {
                    continue;
                };
                model.display = loaded.model.display.clone();
                let (said, is_run) = said_of(model);
                for said in said {
                    let odd = said
                        .split(|c: char| !c.is_alphanumeric())
                        .find(|word| ["inf", "NaN"].contains(word));
                    assert!(!said.is_empty() && odd.is_none(), "{what}: {said}");
                }
                tried += 1;
                ran += u64::from(is_run);
            }
        }
        [tried, ran]
    });
    println!("{tried} numbers, {ran} models ran");
    assert!(tried > 1000 && ran > tried / 5, "{ran} of {tried} ran");
}

/// Complaints of `check` and of `run`, which are the same.
#[track_caller]
fn refused(name: &str, set: &str) -> String {
    let bundled = linkdyn_model::bundled::find(name).expect("bundled");
    let loaded = linkdyn_model::load(bundled.text.as_bytes(), &[set.to_owned()]);
    let model = loaded.unwrap_or_else(|said| panic!("{said:?}")).model;
    let of_check = check(&model).expect_err(set);
    let of_run = run(&model, &Control::default()).expect_err(set);
    assert_eq!(of_check, of_run, "{set}");
    of_run[0].to_string()
}

/// The ratio was not looked at: a row of the Jacobian overflowed, and the rank of the constraints panicked.
#[test]
fn gear_ratios_that_overflow_are_refused() {
    for ratio in ["1e308", "-1e308", "1e200", "-1e61"] {
        let said = refused("geared-five-bar", &format!("joints.mesh.ratio={ratio}"));
        assert_eq!(
            said,
            "joints.mesh: it moves one body by more than 1e60 times as much as another, where numbers overflow \
             (look for a ratio or a length with a wrong exponent or unit)"
        );
    }
}

/// The depth of a contact was looked for by products of clearances, which vanished, without end.
#[test]
fn clearances_whose_squares_vanish_are_refused() {
    for radius in ["1e-200 m", "5e-324 m"] {
        let set = format!("joints.wristpin.clearance.radius={radius}");
        let said = refused("slider-crank-clearance", &set);
        let wanted = "joints.wristpin.clearance.radius: the radial clearance is smaller than 1e-57 mm, where squares of numbers vanish";
        assert!(said.starts_with(wanted), "{said}");
    }
}

/// The turning points of a wave were looked for quarter by quarter, 10¹⁵ of them where the end was beyond all of them.
#[test]
fn waves_of_any_duration_are_followed() {
    watch::in_time(|begins| {
        let bundled = linkdyn_model::bundled::find("scotch-yoke").expect("bundled");
        for (frequency, amplitude) in [("2 Hz", "1 rad"), ("1e300 Hz", "1 rad"), ("2 Hz", "0 rad")]
        {
            for end in ["1e9 s", "1e160 s", "1.7e308 s"] {
                begins(format!("{amplitude} at {frequency} until {end}"));
                let motion = format!(
                    r#"{{"type":"harmonic","amplitude":"{amplitude}","frequency":"{frequency}","phase":"1 rad"}}"#
                );
                let sets = [
                    format!("drivers.motor.motion={motion}"),
                    format!("analysis.end={end}"),
                ];
                let model = linkdyn_model::load(bundled.text.as_bytes(), &sets)
                    .unwrap_or_else(|said| panic!("{said:?}"))
                    .model;
                let outcome = run(&model, &Control::default()).expect("it is followed");
                assert!(
                    !outcome.trajectory.is_empty(),
                    "{:?}",
                    outcome.report.message
                );
            }
        }
    });
}
