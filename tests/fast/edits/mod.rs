//! Models edited at random in Rust: the gate complains, or the model compiles, assembles and runs; nothing panics, and what
//! is printed is read as the same model.
//!
//! `LINKDYN_EDITS` is the number of edits, `LINKDYN_EDIT_SEED` where they begin.

#[path = "../../common/fuzz/rng.rs"]
#[allow(dead_code)]
mod rng;

mod change;
mod huge;
mod places;
mod watch;

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::{Duration, Instant};

use crate::models;
use change::edit;
use linkdyn_engine::analysis::{Control, check, run};
use linkdyn_model::{Checked, ForceKind, Loaded, Model, Value};
use rng::Rng;

/// Models with all kinds of words.
fn sources() -> Vec<Loaded> {
    let named = [
        "four-bar",
        "four-bar-spring",
        "geared-five-bar",
        "slider-crank-clearance",
        "scotch-yoke",
        "double-pendulum",
        "double-wishbone",
    ];
    let mut sources: Vec<Loaded> = named
        .iter()
        .map(|name| {
            let text = linkdyn_model::bundled::find(name).expect("bundled").text;
            linkdyn_model::load(text.as_bytes(), &[]).expect("sound")
        })
        .collect();
    let words = include_bytes!("edits.json");
    sources.push(linkdyn_model::load(words, &[]).unwrap_or_else(|said| panic!("{said:?}")));
    sources
}

/// A model of the same words that is over soon.
fn short(model: &Checked) -> Option<Checked> {
    let short = model.edit(|model| {
        let Some(analysis) = &mut model.analysis else {
            return;
        };
        analysis.outputs = analysis.outputs.map(|outputs| outputs.min(3));
        if let Some(sample) = &mut analysis.sample {
            sample.step = sample.to - sample.from;
        }
    });
    short.ok()
}

/// What must hold of an edited model; whether it passed the gate.
fn holds(loaded: &Loaded, model: Model, is_run: bool) -> bool {
    let model = match model.check() {
        Ok(model) => model,
        Err(complaints) => {
            assert!(!complaints.is_empty());
            for complaint in complaints {
                assert!(!complaint.message.is_empty() && !complaint.path.is_empty());
                loaded.source.place(complaint);
            }
            return false;
        }
    };
    for (source, json) in [
        ("its file", loaded.source.print(&model)),
        ("nothing", model.to_json()),
    ] {
        let text = json.to_string();
        let again = linkdyn_model::load(text.as_bytes(), &[])
            .unwrap_or_else(|said| panic!("printed over {source}: {said:?}\n{json:#}"));
        assert_eq!(
            again.model.to_json().to_string(),
            model.to_json().to_string(),
            "printed over {source}: {json:#}"
        );
    }
    if is_run && let Some(model) = short(&model) {
        let control = Control {
            deadline: Some(Instant::now() + Duration::from_millis(20)),
            ..Control::default()
        };
        for complaint in check(&model).err().into_iter().flatten() {
            assert!(!complaint.message.is_empty());
        }
        for complaint in run(&model, &control).err().into_iter().flatten() {
            assert!(!complaint.message.is_empty());
        }
    }
    true
}

#[test]
fn edited_models_are_refused_or_run() {
    let number = |name: &str, otherwise: u64| {
        let text = std::env::var(name).ok();
        text.map_or(otherwise, |text| text.parse().expect("a number"))
    };
    let (count, seed) = (
        number("LINKDYN_EDITS", 2000),
        number("LINKDYN_EDIT_SEED", 7),
    );
    let passed = watch::in_time(move |begins| edited(count, seed, begins));
    println!("{count} edits, {passed} passed the gate");
    assert!(
        passed > count / 10 && passed < count,
        "{passed} of {count} passed"
    );
}

/// Edits models, and says of each what it is before it begins; how many passed the gate.
fn edited(count: u64, seed: u64, begins: impl Fn(String)) -> u64 {
    let sources = sources();
    let mut passed = 0;
    for index in 0..count {
        let mut rng = Rng::new(seed, index);
        let loaded = &sources[rng.below(sources.len())];
        let mut model = Model::clone(&loaded.model);
        for _ in 0..=rng.below(3) {
            edit(&mut model, &mut rng);
        }
        let kept = model.clone();
        let is_run = rng.once_in(4);
        begins(format!("edit {index} of seed {seed}"));
        let held = catch_unwind(AssertUnwindSafe(|| holds(loaded, model, is_run)));
        match held {
            Ok(held) => passed += u64::from(held),
            Err(_) => panic!("edit {index} of seed {seed}: {kept:?}"),
        }
    }
    passed
}

/// The model with formulas that have the values of their parameters, as they were printed, in the place of the names.
fn without_parameters(model: &Model, printed: &Model) -> Model {
    let mut model = model.clone();
    for (name, force) in &mut model.forces {
        let values = |kind: &mut ForceKind| match kind {
            ForceKind::Load { vector, .. } => vector.to_vec(),
            ForceKind::Torque { value, .. } | ForceKind::Actuator { force: value, .. } => {
                vec![value.clone()]
            }
            _ => Vec::new(),
        };
        let named =
            |value: &Value| matches!(value, Value::Formula(one) if !one.parameters.is_empty());
        if values(&mut force.kind).iter().any(named) {
            *force = printed.forces[name].clone();
        }
    }
    model
}

#[test]
fn a_model_is_printed_as_it_was_written() {
    for named in models::all() {
        let text = named.json.to_string();
        let loaded = linkdyn_model::load(text.as_bytes(), &[])
            .unwrap_or_else(|said| panic!("{}: {said:?}", named.name));
        let printed = loaded.source.print(&loaded.model);
        assert_eq!(printed.to_string(), text, "{}", named.name);
        // Without its file, a model is the same after it is printed and read.
        let alone = loaded.model.to_json();
        let again = linkdyn_model::load(alone.to_string().as_bytes(), &[])
            .unwrap_or_else(|said| panic!("{}: {said:?}\n{alone:#}", named.name));
        let mut model = again.model.clone().into_model();
        model.display = loaded.model.display.clone();
        assert_eq!(
            model,
            without_parameters(&loaded.model, &model),
            "{}",
            named.name
        );
        assert_eq!(again.model.to_json().to_string(), alone.to_string());
        assert_eq!(again.source.print(&again.model), alone, "{}", named.name);
    }
}
