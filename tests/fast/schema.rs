//! What the published schema says of models, the reader says too. `tests/cases/schema.json` holds models that are good and bad by
//! their structure: here the reader meets them, in `python/tests/test_schema.py` a validator of JSON Schema.

use std::fs;
use std::path::Path;

use serde_json::Value;

/// Models of one list: a good one with some of its keys replaced.
fn models(list: &str) -> Vec<Value> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases/schema.json");
    let cases: Value = serde_json::from_slice(&fs::read(path).unwrap()).unwrap();
    let with = |extra: &Value| {
        let mut model = cases["base"].clone();
        for (key, value) in extra.as_object().unwrap() {
            model[key] = value.clone();
        }
        model
    };
    let mut models: Vec<Value> = cases[list].as_array().unwrap().iter().map(with).collect();
    if list == "good" {
        models.push(cases["whole"].clone());
    }
    models
}

#[test]
fn good_models_are_read() {
    for model in models("good") {
        if let Err(complaints) = linkdyn_model::load(model.to_string().as_bytes(), &[]) {
            panic!("{}\n{model:#}", complaints[0]);
        }
    }
}

#[test]
fn a_bad_structure_is_refused() {
    let bad = models("bad");
    assert!(bad.len() > 50);
    for model in bad {
        assert!(
            linkdyn_model::load(model.to_string().as_bytes(), &[]).is_err(),
            "the reader accepts {model:#}"
        );
    }
}

#[test]
fn every_key_of_a_clearance_says_what_it_is() {
    let schema = linkdyn_model::schema();
    for name in [
        "Clearance",
        "Normal",
        "Friction",
        "Surface",
        "Impact",
        "Material",
    ] {
        for (key, property) in schema["$defs"][name]["properties"].as_object().unwrap() {
            let said = property.get("description").is_some() || property.get("$ref").is_some();
            assert!(said, "{name}.{key}");
        }
    }
}
