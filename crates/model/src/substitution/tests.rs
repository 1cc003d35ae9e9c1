use super::*;
use crate::bundled;

/// The parameters of every bundled model can be given without reading it again, and give what reading gives.
#[test]
fn bundled_models_take_numbers() {
    let mut met = 0;
    for model in bundled::MODELS {
        let loaded = crate::load(model.text.as_bytes(), &[]).expect("a sound model");
        let names: Vec<&str> = loaded
            .parameters
            .iter()
            .map(|one| one.name.as_str())
            .collect();
        if names.is_empty() {
            continue;
        }
        met += 1;
        for given in [Given::Values, Given::Deviations] {
            let found = Substitution::new(
                &loaded.source,
                &loaded.model,
                &loaded.parameters,
                &names,
                given,
            );
            // Of segments of a cam's law there are rules that only reading knows.
            if model.name == "cam-roller" {
                assert!(found.is_none());
                continue;
            }
            let substitution = found.unwrap_or_else(|| panic!("{}: is read again", model.name));
            let mut place = substitution.begin();
            let values: Vec<f64> = loaded
                .parameters
                .iter()
                .map(|one| match given {
                    Given::Values => 1.01 * one.value,
                    Given::Deviations => 0.01 * one.value,
                })
                .collect();
            let pairs: Vec<(&str, f64)> =
                names.iter().copied().zip(values.iter().copied()).collect();
            let read = match given {
                Given::Values => loaded.source.with_parameters(&pairs),
                Given::Deviations => loaded.source.with_deviations(&pairs),
            };
            assert_eq!(
                substitution.put(&values, &mut place),
                read.ok().as_ref(),
                "{}",
                model.name
            );
        }
    }
    assert!(met >= 10, "{met} models with parameters");
}

fn of(text: &str, names: &[&str]) -> Option<(Substitution, crate::Loaded)> {
    let loaded = crate::load(text.as_bytes(), &[]).expect("a sound model");
    let found = Substitution::new(
        &loaded.source,
        &loaded.model,
        &loaded.parameters,
        names,
        Given::Values,
    );
    found.map(|substitution| (substitution, loaded))
}

const BAR: &str = r#"{ "format": "linkdyn/1", "units": "SI", "parameters": { "m": "2 kg", "l": "5 mm" },
    "bodies": { "bar": { "mass": "=m", "inertia": "=m*l^2/12", "com": ["=l/(l-3 mm)*1 mm", 0], "points": { "A": ["=2*l", 0] } } } }"#;

#[test]
fn what_only_reading_can_tell_is_left_to_it() {
    let (substitution, loaded) = of(BAR, &["m", "l"]).expect("numbers alone");
    let mut place = substitution.begin();
    assert!(substitution.put(&[2.0, 0.006], &mut place).is_some());
    // a mass that must not be, a step without value, and a number that changes its sign
    assert!(substitution.put(&[-2.0, 0.006], &mut place).is_none());
    assert!(substitution.put(&[2.0, 0.003], &mut place).is_none());
    assert!(substitution.put(&[2.0, 0.002], &mut place).is_none());
    assert!(substitution.put(&[2.0, f64::NAN], &mut place).is_none());
    assert!(loaded.source.with_parameters(&[("m", -2.0)]).is_err());
    // and after all that as if nothing had been
    let again = substitution.put(&[3.0, 0.004], &mut place).cloned();
    let read = loaded.source.with_parameters(&[("m", 3.0), ("l", 0.004)]);
    assert_eq!(again, read.ok());
}

/// On which side of a body's frame a point lies is no rule, and where a body is drawn is none.
#[test]
fn points_change_their_side() {
    let text = r#"{ "format": "linkdyn/1", "units": "SI", "parameters": { "x": "5 mm", "a": "0 rad" },
        "bodies": { "bar": { "points": { "A": ["=x", "=a*1 mm"] }, "pose": { "position": ["=x", 0], "angle": "=a" } } } }"#;
    let (substitution, loaded) = of(text, &["x", "a"]).expect("numbers alone");
    let mut place = substitution.begin();
    for values in [[0.005, 0.1], [0.0, 0.0], [-0.003, -0.2], [0.001, 0.0]] {
        let read = loaded
            .source
            .with_parameters(&[("x", values[0]), ("a", values[1])]);
        assert_eq!(
            substitution.put(&values, &mut place),
            read.ok().as_ref(),
            "{values:?}"
        );
    }
    assert!(
        substitution
            .put(&[f64::INFINITY, 0.0], &mut place)
            .is_none()
    );
}

/// Numbers that keep their signs may still not belong together: then reading says so.
#[test]
fn a_joint_whose_numbers_do_not_fit_is_read() {
    let text = r#"{ "format": "linkdyn/1", "units": "SI", "parameters": { "r": -0.08 },
        "bodies": { "ground": { "points": { "O": [0, 0] } }, "disc": { "points": { "C": [0, 0] } } },
        "joints": { "ring": { "type": "rolling", "between": ["ground.O", "disc.C"], "radii": ["=r*1 m", 0.02] } } }"#;
    let (substitution, loaded) = of(text, &["r"]).expect("numbers alone");
    let mut place = substitution.begin();
    for r in [-0.08, -0.02, -0.01, -0.03] {
        let read = loaded.source.with_parameters(&[("r", r)]).ok();
        assert_eq!(read.is_some(), r < -0.02, "{r}");
        assert_eq!(substitution.put(&[r], &mut place), read.as_ref(), "{r}");
    }
}

#[test]
fn places_that_are_not_known_mean_reading() {
    let table = r#"{ "format": "linkdyn/1", "units": "SI", "parameters": { "l": "5 mm" },
        "bodies": { "bar": { "mass": 1, "inertia": 1, "com": [0, 0] } },
        "drivers": { "d": { "type": "rotation", "body": "bar",
            "motion": { "type": "table", "points": [[0, 0], [1, "=l/(1 mm)*1 rad"], [2, 3]] } } } }"#;
    assert!(of(table, &["l"]).is_none());
}
