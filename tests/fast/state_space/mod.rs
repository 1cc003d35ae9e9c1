//! Linear systems about rest and along motions.

mod closed_forms;
mod full;
mod refused;
mod rest;

use crate::mechanisms::*;
use linkdyn_engine::analysis::{
    Control, LinearSystem, NoLinearSystem, StateSpaceQuestion, state_space,
};
use serde_json::{Value, json};

fn question(inputs: &[&str], outputs: &[&str]) -> StateSpaceQuestion {
    let own = |names: &[&str]| names.iter().map(|name| name.to_string()).collect();
    StateSpaceQuestion {
        inputs: own(inputs),
        outputs: own(outputs),
        ..StateSpaceQuestion::default()
    }
}

#[track_caller]
fn asked(model: &Value, question: &StateSpaceQuestion) -> Vec<LinearSystem> {
    state_space(&loaded(model).model, question, &Control::default())
        .unwrap_or_else(|said| panic!("{said:?}"))
}

/// The linear system about rest.
#[track_caller]
fn linear(model: &Value, inputs: &[&str], outputs: &[&str]) -> LinearSystem {
    asked(model, &question(inputs, outputs)).remove(0)
}

/// The linear system about the assembled position.
#[track_caller]
fn posed(model: &Value, inputs: &[&str], outputs: &[&str]) -> LinearSystem {
    let question = StateSpaceQuestion {
        pose: true,
        ..question(inputs, outputs)
    };
    asked(model, &question).remove(0)
}

/// The linear system at an instant of the motion.
#[track_caller]
fn moving(model: &Value, inputs: &[&str], outputs: &[&str], time: f64) -> LinearSystem {
    let question = StateSpaceQuestion {
        at: vec![time],
        ..question(inputs, outputs)
    };
    asked(model, &question).remove(0)
}

fn names(all: &[linkdyn_engine::analysis::Variable]) -> Vec<&str> {
    all.iter().map(|one| one.name.as_str()).collect()
}

/// Whether a matrix is one that is known, its entries to parts of the largest of their row.
#[track_caller]
fn is(found: &[Vec<f64>], known: &[&[f64]], tolerance: f64) {
    assert_eq!(found.len(), known.len(), "{found:?}");
    for (found, known) in found.iter().zip(known) {
        assert_eq!(found.len(), known.len(), "{found:?}");
        let largest = known
            .iter()
            .fold(1e-300, |most: f64, own| most.max(own.abs()));
        for (own, exact) in found.iter().zip(*known) {
            let off = (own - exact).abs() / largest;
            assert!(
                off <= tolerance,
                "{own} for {exact}, off by {off:e} in {found:?}"
            );
        }
    }
}

#[track_caller]
fn refused(model: &Value, question: &StateSpaceQuestion) -> String {
    match state_space(&loaded(model).model, question, &Control::default()) {
        Ok(found) => panic!("{found:?}"),
        Err(NoLinearSystem::Model(complaints)) => complaints[0].to_string(),
        Err(NoLinearSystem::Question(message) | NoLinearSystem::Failed { message, .. }) => message,
    }
}

const G: f64 = 9.81;

/// A cart on rails with a pole that stands on it, driven along the rails.
fn cart_pole() -> Value {
    let bodies = json!({
        "ground": { "points": { "O": [0.0, 0.0] } },
        "cart": { "mass": 2.0, "inertia": 0.1, "com": [0.0, 0.0], "points": { "P": [0.0, 0.0] } },
        "pole": { "mass": 0.3, "inertia": 0.02, "com": [0.4, 0.0],
                  "points": { "P": [0.0, 0.0], "T": [0.8, 0.0] }, "pose": { "angle": std::f64::consts::FRAC_PI_2 } } });
    let joints = json!({
        "rails": { "type": "prismatic", "between": ["ground.O", "cart.P"], "axis": [1.0, 0.0] },
        "hinge": pin("cart.P", "pole.P") });
    let drivers = json!({ "belt": { "type": "translation", "joint": "rails",
        "motion": { "type": "polynomial", "coefficients": [0.25] } } });
    let mut model = model(bodies, joints, drivers);
    model["analysis"] = json!({ "type": "dynamics", "end": 1.0, "outputs": 11 });
    model["initial"] = json!({ "pole": { "angle": std::f64::consts::FRAC_PI_2 } });
    model
}
