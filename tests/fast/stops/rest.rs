//! Stops at rest.

use super::*;
use std::f64::consts::FRAC_PI_2;

/// At rest a mechanism leans on its stops: on rigid ones, and on those that yield.
#[test]
fn mechanisms_rest_on_their_stops() {
    let angle = -0.3;
    for (more, sinks) in [(json!({}), 0.0), (json!({ "stiffness": 5e4 }), 1.0 / 5e4)] {
        let mut stops = json!({ "limits": [angle, 2.0] });
        join(&mut stops, &more);
        let mut model = rod(1.0, &stops, 1.0);
        model["analysis"] = json!({ "type": "statics" });
        let run = completed(&model);
        let found = column(&run, "rod.angle")[0];
        let torque = GRAVITY * found.cos();
        near(found, angle - sinks * torque, 1e-12);
        near(column(&run, "joint.o.stop")[0], torque, 1e-9);
        near(column(&run, "joint.o.fy")[0], GRAVITY, 1e-9);
    }
    // Where nothing presses the stops are not felt.
    let mut model = rod(-1.0, &json!({ "limits": [-2.0, 2.0] }), 1.0);
    model["analysis"] = json!({ "type": "statics" });
    let run = completed(&model);
    near(column(&run, "rod.angle")[0], -FRAC_PI_2, 1e-12);
    assert_eq!(column(&run, "joint.o.stop")[0], 0.0);
}

/// Small motions of a rod on a stop that yields: ω² = (k − m g l sin θ)/I, damping D/I.
#[test]
fn stops_that_press_at_rest_are_springs() {
    let (stiffness, damping) = (5e3, 20.0);
    let stops = json!({ "limits": [-0.3, 2.0], "stiffness": stiffness, "damping": damping });
    let model = rod(1.0, &stops, 1.0);
    let found = analysis::modes(&loaded(&model).model, false, &Control::default());
    let found = found.expect("good input");
    let angle = found.bodies[0].1[2];
    near(angle, -0.3 - GRAVITY * angle.cos() / stiffness, 1e-12);
    let inertia = 4.0 / 3.0;
    let square = (stiffness - GRAVITY * angle.sin()) / inertia;
    near(
        found.modes[0].frequency(),
        square.sqrt(),
        1e-9 * square.sqrt(),
    );
    let ratio = 0.5 * damping / inertia / square.sqrt();
    near(
        found.modes[0].damping_ratio().expect("it swings"),
        ratio,
        1e-9,
    );
    // Latched, nothing is left to swing.
    let model = rod(0.0, &json!({ "limits": [0.0, 2.0], "latch": "lower" }), 1.0);
    let refused = analysis::modes(&loaded(&model).model, true, &Control::default());
    assert!(refused.is_err());
}

/// What stops carry reaches the ground: the weight of a block, and that of a rod with its torque about the ground's origin.
#[test]
fn the_ground_carries_what_leans_on_stops() {
    let shaken = |model: &mut Value, end: &str| {
        model["responses"] = json!({ "fy": "last(shaking.fy)", "moment": "last(shaking.moment)" });
        let run = completed(model);
        let of = |name: &str| {
            let answers = run.responses.iter();
            let mut found = answers.filter(|answer| answer.name == name);
            found.next().and_then(|answer| answer.value).expect(end)
        };
        [of("fy"), of("moment")]
    };
    let [force, _] = shaken(
        &mut block(0.5, &json!({ "limits": [0.2, 1.5] }), 1.0),
        "a block",
    );
    near(force, -MASS * GRAVITY, 1e-9);
    let angle: f64 = -0.3;
    let stops = json!({ "limits": [angle, 2.0] });
    let [force, moment] = shaken(&mut rod(0.5, &stops, 2.0), "a rod");
    near(force, -GRAVITY, 1e-8);
    near(moment, -GRAVITY * angle.cos(), 1e-8);
}
