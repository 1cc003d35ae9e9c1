//! Equilibria.

use super::{found, value};
use crate::browser::Scratch;
use serde_json::json;
use std::fs;

/// A rod that a spring without free length holds from the side: tan θ = −m g c/(k L a). The softest spring that holds it above
/// −20° is the one that pulls from farthest away.
#[test]
fn an_equilibrium_is_optimised_by_exact_derivatives() {
    let model = json!({ "format": "linkdyn/1", "units": "SI", "gravity": [0.0, -9.81],
        "parameters": { "k": "60 N/m", "a": "0.4 m" },
        "bodies": { "ground": { "points": { "O": [0.0, 0.0], "P": ["=a", 0.0] } },
            "rod": { "mass": 2.0, "com": [0.3, 0.0], "points": { "O": [0.0, 0.0], "B": [0.7, 0.0] } } },
        "joints": { "o": { "type": "revolute", "between": ["ground.O", "rod.O"] } },
        "forces": { "s": { "type": "spring", "between": ["ground.P", "rod.B"], "stiffness": "=k", "free_length": 0.0 } },
        "responses": { "angle": "last(rod.angle)", "soft": "k" },
        "analysis": { "type": "statics" } });
    let scratch = Scratch::new("optimise-rest");
    fs::write(scratch.0.join("rod.json"), model.to_string()).expect("a model");
    let found = found(
        &scratch,
        &[
            "rod.json",
            "--vary",
            "k=10 N/m:500 N/m",
            "--vary",
            "a=0.2 m:0.6 m",
            "--minimise",
            "soft",
            "--constraint",
            "angle >= -20 deg",
        ],
    );
    let exact = 2.0 * 9.81 * 0.3 / (0.7 * 0.6 * 20_f64.to_radians().tan());
    assert!((value(&found, "a") - 0.6).abs() < 1e-9, "{found}");
    assert!((value(&found, "k") - exact).abs() < 1e-6 * exact, "{found}");
    assert_eq!(found["derivatives"], "exact", "{found}");
    for of in found["gradients"].as_array().expect("gradients") {
        assert_eq!(of["differences"], 0, "{of}");
        assert!(of["exact"].as_u64() > Some(0), "{of}");
    }
}
