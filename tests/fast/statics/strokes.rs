//! Equilibria in which the stroke of a force holds, though the way behind its end would lead back to lengths that it allows.

use super::*;

/// An arm of 0.1 m about O that a torque turns, and points that may be 0.25 m to 0.38 m apart: of A and (0, −0.3).
///
/// ```text
/// d² = 0.1 + 0.06 sin θ,   dd/dθ = 0.03 cos θ/d
/// ```
fn arm(torque: &str, stops: Value) -> Value {
    let mut force = json!({ "type": "actuator", "between": ["ground.S", "arm.A"], "force": 0, "limits": [0.25, 0.38] });
    for (key, value) in stops.as_object().expect("keys") {
        force[key] = value.clone();
    }
    let bodies = json!({ "ground": { "points": { "O": [0, 0], "S": [0, -0.3] } },
        "arm": { "mass": 1, "inertia": 1, "com": [0, 0], "points": { "O": [0, 0], "A": [0.1, 0] } } });
    let turn = json!({ "type": "torque", "body": "arm", "value": torque });
    statics(
        bodies,
        json!({ "hinge": pin("ground.O", "arm.O") }),
        json!({ "stop": force, "turn": turn }),
    )
}

/// θ where the points are at a distance, before a quarter turn.
fn at(distance: f64) -> f64 {
    ((distance * distance - 0.1) / 0.06).asin()
}

#[test]
fn the_end_of_a_stroke_holds_where_it_is_met_first() {
    for (torque, value, limit) in [
        ("=10 N*m*(1 - arm.angle/(3 rad))", None, 0.38),
        ("=10 N*m", Some(10.0), 0.38),
        ("=-10 N*m", Some(-10.0), 0.25),
    ] {
        let run = completed(&arm(torque, json!({})));
        let theta = super::value(&run, "arm.angle");
        close(theta, at(limit), 1e-10);
        let needed = value.unwrap_or(10.0 * (1.0 - theta / 3.0));
        let lever = 0.03 * theta.cos() / limit;
        close(super::value(&run, "force.stop.stop"), -needed / lever, 1e-7);
    }
}

#[test]
fn an_end_that_yields_holds_alike() {
    let run = completed(&arm("=10 N*m", json!({ "stop_stiffness": 1e6 })));
    let theta = value(&run, "arm.angle");
    let distance = (0.1 + 0.06 * theta.sin()).sqrt();
    let force = 1e6 * (distance - 0.38);
    close(force * 0.03 * theta.cos() / distance, 10.0, 1e-6);
}

#[test]
fn what_does_not_reach_its_end_rests_before_it() {
    let run = completed(&arm("=10 N*m*(1 - arm.angle/(0.5 rad))", json!({})));
    close(value(&run, "arm.angle"), 0.5, 1e-12);
    close(value(&run, "force.stop.stop"), 0.0, 1e-12);
}

/// At rest a motor has its steady current, whatever its inductance, in small motions, too.
#[test]
fn the_inductance_of_a_motor_has_no_part_in_rest() {
    let model = |inductance: f64| {
        let bodies = json!({ "ground": { "points": { "O": [0, 0] } },
            "drum": { "mass": 2, "inertia": 0.05, "com": [0.1, 0], "points": { "O": [0, 0] } } });
        let motor = json!({ "type": "dc_motor", "body": "drum", "voltage": 12, "torque_constant": 0.05, "resistance": 0.6,
            "inductance": inductance });
        let spring =
            json!({ "type": "torsion_spring", "between": ["ground", "drum"], "stiffness": 8 });
        let joints = json!({ "pin": pin("ground.O", "drum.O") });
        statics(bodies, joints, json!({ "motor": motor, "spring": spring }))
    };
    let run = completed(&model(0.02));
    let theta = value(&run, "drum.angle");
    close(
        8.0 * theta + 2.0 * G * 0.1 * theta.cos(),
        0.05 * 12.0 / 0.6,
        1e-10,
    );
    let about = |inductance: f64| {
        let model = load(model(inductance).to_string().as_bytes(), &[]).expect("legal");
        let found = modes(&model.model, false, &Control::default()).expect("good input");
        (found.mass, found.damping)
    };
    let (with, without) = (about(0.02), about(0.0));
    close(with.1[0][0], 0.05 * 0.05 / 0.6, 1e-14);
    assert_eq!(with, without);
}
