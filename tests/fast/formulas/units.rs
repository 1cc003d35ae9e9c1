//! Units in formulas, and names that are spelt like them.

use super::{MASS, block};
use crate::mechanisms::*;
use serde_json::json;

/// The force at t = 0.02 s, of a block that rests at x = 0.3 m, with a mass of 2 kg as a parameter.
fn force_by(text: &str) -> f64 {
    let mut model = block(text, [0.3, 0.0], 0.02);
    model["parameters"] = json!({ "heavy": "2 kg" });
    model["analysis"]["outputs"] = json!(2);
    let run = completed(&model);
    MASS * column(&run, "block.ax")[1]
}

#[test]
fn time_stands_behind_an_operator_and_the_tonne_behind_a_number() {
    for (text, known) in [
        ("=5 N/s*t", 0.1),
        ("=500 N*min(1, t/(0.05 s))", 200.0),
        ("=40 N/(1 m)*min(t, 1 s)*2 m/(1 s)", 1.6),
        // as a formula of time it would be no force, and so nothing in it moves
        ("=9.81 kN/t*heavy", 19.62),
    ] {
        let found = force_by(text);
        assert!((found - known).abs() < 1e-12 * known, "{text}: {found}");
    }
}
