//! Bad limits.

use super::block;
use serde_json::{Value, json};

/// What is wrong with limits, and what would be right.
#[test]
fn faulty_limits_are_told() {
    let said = |stops: &Value| {
        let model = block(0.5, stops, 1.0).to_string();
        let faults = linkdyn_model::load(model.as_bytes(), &[]).expect_err("refused");
        faults.to_string()
    };
    for (stops, expected) in [
        (
            json!({ "limits": [0.9, 0.2] }),
            "joints.g.limits: the lower limit 0.9 m is not below the upper limit 0.2 m (write [lower, upper]; a joint that does \
             not move is \"fixed\")",
        ),
        (
            json!({ "limits": [null, null] }),
            "joints.g.limits: neither end is given (give one of them, or leave \"limits\" out)",
        ),
        (
            json!({ "limits": [0.2] }),
            "joints.g.limits: a list of 2 is expected, this one has 1",
        ),
        (
            json!({ "limits": ["10 deg", 0.2] }),
            "joints.g.limits[0]: \"10 deg\": \"deg\" is not a unit of length (such as \"m\")",
        ),
        (
            json!({ "limits": [0.2, 0.9], "restitution": 1.5 }),
            "joints.g.restitution: 1.5: must not be greater than 1",
        ),
        (
            json!({ "limits": [0.2, 0.9], "stiffness": 0.0 }),
            "joints.g.stiffness: 0.0: must be greater than 0",
        ),
        (
            json!({ "limits": [0.2, 0.9], "damping": 5.0 }),
            "joints.g.damping: 5.0: \"stiffness\" is missing: a stop with damping yields (give the stiffness of the stops, or \
             \"restitution\" instead of the damping)",
        ),
        (
            json!({ "limits": [0.2, 0.9], "stiffness": 5.0, "restitution": 0.5 }),
            "joints.g.restitution: 0.5: the stops yield, since there is a \"stiffness\": what they give back follows from stiffness \
             and damping (leave out one of them)",
        ),
        (
            json!({ "limits": [0.2, null], "latch": "both" }),
            "joints.g.latch: \"both\": the joint has no upper limit (a joint latches at one of its limits)",
        ),
        (
            json!({ "limits": [0.2, 0.9], "latch": "upper", "stiffness": 5.0 }),
            "joints.g.latch: \"upper\": a latch is rigid, and these stops yield (leave out \"stiffness\" and \"damping\")",
        ),
        (
            json!({ "limits": [0.2, 0.9], "release": 5.0 }),
            "joints.g.release: 5.0: there is no latch that could open (say where the joint latches, as in \"latch\": \"upper\")",
        ),
        (
            json!({ "restitution": 0.5 }),
            "joints.g.restitution: 0.5: is of the stops at the joint's limits, and there are no \"limits\" (as in \"limits\": \
             [\"0 mm\", \"80 mm\"])",
        ),
    ] {
        let text = said(&stops);
        let at = text.find("joints.").unwrap_or(0);
        assert_eq!(&text[at..], expected);
    }
}
