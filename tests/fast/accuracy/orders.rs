//! An answer is that of its question alone: not of what else is asked, nor of how often the model is read for it.

use super::told::{Told, ask_outputs, parametric, spoil, tolerate};
use crate::models;
use linkdyn_variation::Scope;
use serde_json::{Map, Value, json};
use std::num::NonZeroUsize;
use std::sync::atomic::Ordering;

const INSTANTS: usize = 9;

/// Everything off in a bundled model: clearances of 0.1 mm, all numbers of the geometry by 10 um.
fn off(name: &str) -> Value {
    let model = models::load_bundled(name, &[]);
    let mut json = parametric(&model, INSTANTS);
    spoil(&mut json, 1e-4);
    tolerate(&mut json, 1e-5);
    ask_outputs(&mut json, &model, None);
    json
}

#[test]
fn an_output_does_not_depend_on_those_asked_with_it() {
    let mut compared = 0;
    for name in ["four-bar", "slider-crank", "whitworth", "watt-i-lock"] {
        let mut json = off(name);
        let outputs = json["accuracy"]["outputs"].take();
        let outputs = outputs.as_object().expect("outputs");
        let mut answers = |order: &mut dyn Iterator<Item = (&String, &Value)>| {
            let wanted = order.map(|(name, asked)| (name.clone(), asked.clone()));
            json["accuracy"]["outputs"] = Value::Object(wanted.collect::<Map<_, _>>());
            let found = Told::read(&json).expect("legal").answer().outputs;
            let told = found
                .iter()
                .map(|own| (own.name.clone(), format!("{:?}", own.poses)));
            told.collect::<Vec<_>>()
        };
        let together = answers(&mut outputs.iter());
        assert!(
            together
                .iter()
                .any(|(_, poses)| poses.contains("found: [Some")),
            "{name}"
        );
        for (output, poses) in &together {
            let alone = answers(&mut outputs.iter().filter(|(name, _)| *name == output));
            assert!(alone[0].1 == *poses, "{name}: {output}");
            compared += 1;
        }
        let mut backwards = answers(&mut outputs.iter().rev());
        backwards.reverse();
        assert!(backwards == together, "{name}");
    }
    assert!(compared > 40, "{compared}");
}

#[test]
fn an_answer_does_not_hang_on_the_threads_that_share_it() {
    for (name, output) in [("slider-crank", "piston.x"), ("watt-i-lock", "link2.angle")] {
        let model = models::load_bundled(name, &[]);
        // Several stretches, and the last one is shorter.
        let mut json = parametric(&model, 150);
        spoil(&mut json, 1e-4);
        tolerate(&mut json, 1e-5);
        json["accuracy"] = json!({ "outputs": { "o": { "column": output } } });
        let told = Told::read(&json).expect("legal");
        let answers = [1, 3].map(|threads| {
            let scope = Scope {
                threads: NonZeroUsize::new(threads),
                ..Scope::default()
            };
            told.ask_for(&told.loaded.model, scope).expect("answers")
        });
        let [alone, shared] = answers
            .each_ref()
            .map(|found| format!("{:?}", found.outputs));
        assert_eq!(answers[0].outputs[0].poses.len(), 150, "{name}");
        assert!(alone.contains("found: [Some"), "{name}");
        assert!(alone == shared, "{name}");
    }
}

#[test]
fn a_model_is_read_again_only_for_parameters_that_bend() {
    // Two of them make the direction of the slide, the others are lengths, offsets and places.
    let told = Told::read(&off("slider-crank")).expect("legal");
    assert!(told.loaded.parameters.len() > 10);
    told.answer();
    let read = told.readings.load(Ordering::Relaxed);
    assert!((1..=8).contains(&read), "{read}");
    // Of a four-bar nothing bends.
    let mut json = off("four-bar");
    let told = Told::read(&json).expect("legal");
    told.answer();
    assert_eq!(told.readings.load(Ordering::Relaxed), 0);
    // A length that is a product bends with both, and the others do not.
    let first = json["parameters"]
        .as_object()
        .expect("parameters")
        .keys()
        .next()
        .cloned();
    let first = first.expect("a parameter");
    let value = json["parameters"][&first].take();
    json["parameters"]["half"] = value;
    json["parameters"]["part"] = json!({ "value": 1.0, "tolerance": 1e-4 });
    json["parameters"][&first] = json!("=half*part");
    let told = Told::read(&json).expect("legal");
    told.answer();
    let read = told.readings.load(Ordering::Relaxed);
    assert!((1..=8).contains(&read), "{read}");
}
