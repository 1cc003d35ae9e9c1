//! Reductions over lists of contacts and events: a ball on a floor, whose impacts make geometric series.

use super::*;
use crate::mechanisms::{loaded, model};
use serde_json::json;

const GRAVITY: f64 = 9.81;

/// A block that falls from 0.5 m upon its stop with e = 0.6: it meets it with v₀ eᵏ, after 2 v₀ eᵏ/g each.
#[test]
fn reductions_of_contacts_are_those_of_a_geometric_series() {
    let (height, e, mass) = (0.5, 0.6_f64, 2.0);
    let bodies = json!({ "ground": { "points": { "O": [0.0, 0.0] } },
        "block": { "mass": mass, "inertia": 0.1, "com": [0.0, 0.0], "points": { "P": [0.0, 0.0] },
                   "pose": { "position": [0.0, height] } } });
    let joints = json!({ "g": { "type": "prismatic", "between": ["ground.O", "block.P"], "axis": [0.0, 1.0],
        "limits": [0.0, null], "restitution": e } });
    let mut json = model(bodies, joints, json!({}));
    json["initial"] = json!({ "block": { "y": height, "vy": 0.0 } });
    let speed = (2.0 * GRAVITY * height).sqrt();
    // Four contacts, and a part of the flight that follows.
    let flight = |k: i32| 2.0 * speed * e.powi(k) / GRAVITY;
    let end = speed / GRAVITY + flight(1) + flight(2) + flight(3) + 0.4 * flight(4);
    json["analysis"] =
        json!({ "type": "dynamics", "end": end, "outputs": 3, "solver": { "rtol": 1e-11 } });
    let met = |k: i32| speed * e.powi(k);
    let sum: f64 = (0..4).map(met).sum();
    let first = speed / GRAVITY;
    let cases = [
        ("range(contacts.approach_speed)", met(0) - met(3)),
        ("max(contacts.approach_speed)", met(0)),
        ("min(contacts.approach_speed)", met(3)),
        ("first(contacts.approach_speed)", met(0)),
        ("last(contacts.approach_speed)", met(3)),
        ("mean(contacts.approach_speed)", sum / 4.0),
        ("sum(contacts.approach_speed)", sum),
        ("count(contacts.approach_speed)", 4.0),
        ("range(contacts.separation_speed)", e * (met(0) - met(3))),
        (
            "range(contacts.impulse)",
            mass * (1.0 + e) * (met(0) - met(3)),
        ),
        (
            "range(contacts.energy_lost)",
            0.5 * mass * (1.0 - e * e) * (met(0).powi(2) - met(3).powi(2)),
        ),
        ("range(contacts.time)", flight(1) + flight(2) + flight(3)),
        ("min(events.contact)", first),
        // Of what is negative, too.
        ("range(-3*contacts.approach_speed)", 3.0 * (met(0) - met(3))),
        ("max(-3*contacts.approach_speed)", -3.0 * met(3)),
    ];
    for (number, (text, _)) in cases.iter().enumerate() {
        json["responses"][format!("n{number}")] = json!(text);
    }
    for (answer, (text, known)) in answers(&loaded(&json).model).iter().zip(cases) {
        let found = answer
            .value
            .unwrap_or_else(|| panic!("{text}: {:?}", answer.reason));
        assert!(
            (found - known).abs() < 1e-8 * known.abs(),
            "{text}: {found} instead of {known}"
        );
    }
}
