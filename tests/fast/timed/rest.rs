//! What holds at the start: at rest, in small motions, in assemblies.

use super::*;
use linkdyn_engine::analysis::{Control, modes};

const GRAVITY: f64 = 9.81;

/// A rod of 1 kg and 2 m, hinged at its end.
fn rod(hinge: &Value, analysis: &Value) -> Value {
    let bodies = json!({ "ground": { "points": { "O": [0.0, 0.0] } },
        "rod": { "mass": 1.0, "inertia": 1.0 / 3.0, "com": [1.0, 0.0],
                 "points": { "O": [0.0, 0.0], "E": [2.0, 0.0] } } });
    let mut pinned = pin("ground.O", "rod.O");
    join(&mut pinned, hinge);
    let mut model = model(bodies, json!({ "o": pinned }), json!({}));
    model["analysis"] = analysis.clone();
    model["initial"] = json!({ "rod": { "angle": 0.0, "angular_velocity": 0.0 } });
    model
}

/// A lock and a backstop carry a rod; a lock that closes later does not, nor a clutch the other way round.
#[test]
fn statics_lean_on_what_holds() {
    let mut at_rest = json!({ "type": "statics" });
    for (hinge, angle, torque) in [
        (json!({ "lock": { "until": "time >= 1 s" } }), 0.0, GRAVITY),
        (json!({ "lock": { "from": "time >= 1 s" } }), -90.0, 0.0),
        (json!({ "one_way": "forward" }), 0.0, GRAVITY),
        (json!({ "one_way": "backward" }), -90.0, 0.0),
    ] {
        at_rest["type"] = json!("statics");
        let mut model = rod(&hinge, &at_rest);
        if angle != 0.0 {
            model["initial"] = json!({});
        }
        let run = completed(&model);
        near(column(&run, "rod.angle")[0].to_degrees(), angle, 1e-9);
        near(column(&run, "joint.o.stop")[0], torque, 1e-9);
    }
}

/// A pendulum that is held and let go swings as one that is let go at the start, and a pin that is pulled lets it fall.
#[test]
fn what_is_let_go_moves_from_there() {
    let run = |hinge: Value, end: f64| {
        completed(&rod(
            &hinge,
            &json!({ "type": "dynamics", "end": end, "outputs": 11, "solver": { "rtol": 1e-12 } }),
        ))
    };
    let free = run(json!({}), 1.0);
    let held = run(json!({ "lock": { "until": "time >= 0.5 s" } }), 1.5);
    let last = |run: &Outcome, name: &str| *column(run, name).last().expect("rows");
    for name in ["rod.angle", "rod.omega"] {
        near(last(&held, name), last(&free, name), 1e-9);
    }
    near(column(&held, "joint.o.stop")[1], GRAVITY, 1e-9);
    // From 90° on the pin is pulled: it flies on with what it has.
    let pulled = run(
        json!({ "active": { "until": "rod.angle <= -90 deg" } }),
        1.5,
    );
    let fell = times(&pulled, EventKind::Open)[0];
    let omega = -(3.0 * GRAVITY / 2.0_f64).sqrt();
    near(last(&pulled, "rod.omega"), omega, 1e-10);
    let flown = 1.5 - fell;
    near(last(&pulled, "rod.vx"), 0.0, 2.0 * omega.abs());
    let (x, y) = (last(&pulled, "rod.x"), last(&pulled, "rod.y"));
    let angle = -std::f64::consts::FRAC_PI_2 + omega * flown;
    let centre = [x + angle.cos(), y + angle.sin()];
    // The centre was below the pin, at speed ω to the left.
    near(centre[0], omega * flown, 1e-9);
    near(centre[1], -1.0 - 0.5 * GRAVITY * flown * flown, 1e-9);
}

/// Modes of a double rod with its elbow locked are those of one rod.
#[test]
fn modes_have_what_holds() {
    let bodies = json!({ "ground": { "points": { "O": [0.0, 0.0] } },
        "a": { "mass": 1.0, "inertia": 1.0 / 12.0, "com": [0.0, -0.5], "points": { "O": [0.0, 0.0], "E": [0.0, -1.0] } },
        "b": { "mass": 1.0, "inertia": 1.0 / 12.0, "com": [0.0, -0.5], "points": { "E": [0.0, 0.0] },
               "pose": { "position": [0.0, -1.0] } } });
    let mut elbow = pin("a.E", "b.E");
    elbow["lock"] = json!({ "until": "time >= 1 s" });
    let mut model = model(
        bodies,
        json!({ "o": pin("ground.O", "a.O"), "e": elbow }),
        json!({}),
    );
    model["analysis"] = json!({ "type": "statics" });
    let found = modes(&loaded(&model).model, false, &Control::default()).expect("modes");
    // 2 m and 2 kg about its end: ω² = m g l/J, l = 1 m, J = 8/3.
    assert_eq!(found.modes.len(), 1);
    near(
        found.modes[0].eigenvalue[1].abs(),
        (2.0 * GRAVITY / (8.0 / 3.0)).sqrt(),
        1e-9,
    );
}
