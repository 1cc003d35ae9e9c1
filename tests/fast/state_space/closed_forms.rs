//! Matrices that are known.

use super::*;
use std::f64::consts::FRAC_PI_2;

/// J θ″ = T − m g l sin: A and B of a rod that hangs, and its reaction in D.
#[test]
fn a_pendulum_has_its_matrices() {
    let bodies =
        json!({ "ground": { "points": { "O": [0.0, 0.0] } }, "rod": rod(0.8, [0.0, 0.0], -1.0) });
    let model = model(bodies, json!({ "o": pin("ground.O", "rod.A") }), json!({}));
    let outputs = ["rod.angle", "rod.alpha", "rod.B.x", "joint.o.fx"];
    let mut model = model;
    model["points"] = json!(["rod.B"]);
    let found = linear(&model, &["rod.torque", "rod.B.fx"], &outputs);
    let (inertia, stiffness) = (0.64 / 3.0, 0.4 * G);
    let square = stiffness / inertia;
    assert_eq!(names(&found.states), ["rod.angle", "rod.angle.rate"]);
    assert_eq!(names(&found.inputs), ["rod.torque", "rod.B.fx"]);
    assert_eq!(names(&found.outputs), outputs);
    near(found.states[0].value, -FRAC_PI_2, 1e-13);
    is(&found.a, &[&[0.0, 1.0], &[-square, 0.0]], 1e-12);
    is(
        &found.b,
        &[&[0.0, 0.0], &[1.0 / inertia, 0.8 / inertia]],
        1e-12,
    );
    // The centre of mass goes 0.4 θ″ to the right, by the reaction and the push.
    let c: [&[f64]; 4] = [
        &[1.0, 0.0],
        &[-square, 0.0],
        &[0.8, 0.0],
        &[-0.4 * square, 0.0],
    ];
    is(&found.c, &c, 1e-12);
    let by_push = 0.4 * 0.8 / inertia - 1.0;
    let d: [&[f64]; 4] = [
        &[0.0, 0.0],
        &[1.0 / inertia, 0.8 / inertia],
        &[0.0, 0.0],
        &[0.4 / inertia, by_push],
    ];
    is(&found.d, &d, 1e-12);
    assert_eq!(found.poles.len(), 1);
    near(found.poles[0][1], square.sqrt(), 1e-12);
    assert_eq!(found.poles[0][0], 0.0);
    assert!(
        found.errors.iter().all(|error| *error < 1e-9),
        "{:?}",
        found.errors
    );
    assert_eq!(found.rates, [0.0, found.rates[1]]);
    near(found.rates[1], 0.0, 1e-12);
}

/// m ẍ + c ẋ + k x = f.
#[test]
fn a_mass_on_a_spring_has_its_matrices() {
    let bodies = json!({ "ground": { "points": { "O": [0.0, 0.0] } },
        "mass": { "mass": 2.5, "inertia": 1.0, "com": [0.0, 0.0], "points": { "P": [0.0, 0.0] },
                  "pose": { "position": [0.3, 0.0] } } });
    let guide = json!({ "g": { "type": "prismatic", "between": ["ground.O", "mass.P"], "axis": [1.0, 0.0] } });
    let mut model = model(bodies, guide, json!({}));
    model["forces"] = json!({
        "s": { "type": "spring", "between": ["ground.O", "mass.P"], "stiffness": 400.0, "damping": 12.0, "free_length": 0.2 } });
    let outputs = ["mass.x", "mass.vx", "mass.ax", "force.s.f"];
    let found = linear(&model, &["mass.P.fx", "force.s"], &outputs);
    is(&found.a, &[&[0.0, 1.0], &[-160.0, -4.8]], 1e-12);
    is(&found.b, &[&[0.0, 0.0], &[0.4, 0.4]], 1e-12);
    let c: [&[f64]; 4] = [&[1.0, 0.0], &[0.0, 1.0], &[-160.0, -4.8], &[-400.0, -12.0]];
    is(&found.c, &c, 1e-12);
    is(
        &found.d,
        &[&[0.0, 0.0], &[0.0, 0.0], &[0.4, 0.4], &[0.0, 0.0]],
        1e-12,
    );
    let gain = found.gain.expect("a static gain");
    is(&gain[..1], &[&[1.0 / 400.0, 1.0 / 400.0]], 1e-12);
}

/// (M + m) ẍ − m l θ̈ = f and (J + m l²) θ̈ = m g l θ + m l ẍ of a pole that stands, θ to the left.
#[test]
fn a_cart_with_a_pole_has_its_matrices() {
    let (cart, pole, l, inertia) = (2.0, 0.3, 0.4, 0.02);
    let about = inertia + pole * l * l;
    let whole = (cart + pole) * about - pole * pole * l * l;
    let found = posed(
        &cart_pole(),
        &["driver.belt"],
        &["driver.belt.value", "pole.angle", "hinge"].map(|name| {
            if name == "hinge" {
                "joint.hinge.fx"
            } else {
                name
            }
        }),
    );
    assert_eq!(
        names(&found.states),
        [
            "pole.angle",
            "driver.belt",
            "pole.angle.rate",
            "driver.belt.rate"
        ]
    );
    assert_eq!(
        (found.inputs[0].name.as_str(), found.inputs[0].unit.as_str()),
        ("driver.belt.effort", "N")
    );
    let tilt = (cart + pole) * pole * G * l / whole;
    let push = pole * l * pole * G * l / whole;
    let a: [&[f64]; 4] = [
        &[0.0, 0.0, 1.0, 0.0],
        &[0.0, 0.0, 0.0, 1.0],
        &[tilt, 0.0, 0.0, 0.0],
        &[push, 0.0, 0.0, 0.0],
    ];
    is(&found.a, &a, 1e-12);
    is(
        &found.b,
        &[&[0.0], &[0.0], &[pole * l / whole], &[about / whole]],
        1e-12,
    );
    is(
        &found.c[..2],
        &[&[0.0, 1.0, 0.0, 0.0], &[1.0, 0.0, 0.0, 0.0]],
        1e-13,
    );
    // The hinge moves the pole: m (ẍ − l θ̈).
    is(
        &found.c[2..],
        &[&[pole * (push - l * tilt), 0.0, 0.0, 0.0]],
        1e-11,
    );
    near(found.states[1].value, 0.25, 0.0);
    let root = tilt.sqrt();
    let mut reals: Vec<f64> = found.poles.iter().map(|pole| pole[0]).collect();
    reals.sort_by(f64::total_cmp);
    assert_eq!(reals[1..3], [0.0, 0.0]);
    near(reals[0], -root, 1e-12);
    near(reals[3], root, 1e-12);
    assert_eq!(found.gain, None, "the cart runs away");
}

/// The same cart moved by its acceleration: a double integrator beside the pole.
#[test]
fn a_motion_that_is_led_is_a_double_integrator() {
    let (pole, l, inertia) = (0.3, 0.4, 0.02);
    let about = inertia + pole * l * l;
    let outputs = ["driver.belt.effort", "cart.x", "cart.ax"];
    let found = posed(&cart_pole(), &["driver.belt.acceleration"], &outputs);
    assert_eq!(
        names(&found.states),
        [
            "pole.angle",
            "pole.angle.rate",
            "driver.belt",
            "driver.belt.rate"
        ]
    );
    let a: [&[f64]; 4] = [
        &[0.0, 1.0, 0.0, 0.0],
        &[pole * G * l / about, 0.0, 0.0, 0.0],
        &[0.0, 0.0, 0.0, 1.0],
        &[0.0, 0.0, 0.0, 0.0],
    ];
    is(&found.a, &a, 1e-12);
    is(
        &found.b,
        &[&[0.0], &[pole * l / about], &[0.0], &[1.0]],
        1e-12,
    );
    assert_eq!(found.a[2], [0.0, 0.0, 0.0, 1.0], "exactly");
    assert_eq!(found.b[3], [1.0]);
    let by_tilt = -pole * l * pole * G * l / about;
    let c: [&[f64]; 3] = [&[by_tilt, 0.0, 0.0, 0.0], &[0.0, 0.0, 1.0, 0.0], &[0.0; 4]];
    is(&found.c, &c, 1e-11);
    is(
        &found.d,
        &[&[2.3 - pole * pole * l * l / about], &[0.0], &[1.0]],
        1e-12,
    );
}

/// A motor with an inductance: its current is a state at rest.
#[test]
fn a_motor_has_its_current() {
    let bodies = json!({ "ground": { "points": { "O": [0.0, 0.0] } },
        "rotor": { "mass": 1.0, "inertia": 0.2, "com": [0.0, 0.0], "points": { "O": [0.0, 0.0] } } });
    let mut model = model(
        bodies,
        json!({ "o": pin("ground.O", "rotor.O") }),
        json!({}),
    );
    model["analysis"]["type"] = json!("dynamics");
    model["forces"] = json!({
        "s": { "type": "torsion_spring", "between": ["ground", "rotor"], "stiffness": 3.0, "damping": 0.0, "free_angle": 0.0 },
        "m": { "type": "dc_motor", "body": "rotor", "voltage": "12 V", "resistance": "2 ohm", "inductance": "0.05 H",
               "torque_constant": "0.4 N*m/A" } });
    let found = linear(&model, &["rotor.torque"], &["rotor.angle"]);
    assert_eq!(
        names(&found.states),
        ["rotor.angle", "rotor.angle.rate", "state.m.current"]
    );
    near(found.states[0].value, 0.8, 1e-12);
    near(found.states[2].value, 6.0, 1e-12);
    let a: [&[f64]; 3] = [&[0.0, 1.0, 0.0], &[-15.0, 0.0, 2.0], &[0.0, -8.0, -40.0]];
    is(&found.a, &a, 1e-12);
}

/// A number that formulas name is an input, beside an integrated state: J θ″ = 2 u − 0.5 e, e′ = θ − v.
#[test]
fn numbers_from_outside_are_inputs() {
    let bodies = json!({ "ground": { "points": { "O": [0.0, 0.0] } },
        "rotor": { "mass": 1.0, "inertia": 0.2, "com": [0.0, 0.0], "points": { "O": [0.0, 0.0] } } });
    let mut model = model(
        bodies,
        json!({ "o": pin("ground.O", "rotor.O") }),
        json!({}),
    );
    model["inputs"] = json!({ "u": "0.5 N*m", "v": "0 rad" });
    model["states"] = json!({ "e": { "rate": "=rotor.angle - input.v", "start": "0.25 rad*s" } });
    model["forces"] = json!({
        "m": { "type": "torque", "body": "rotor", "value": "=2*input.u - 0.5 N*m/(rad*s)*state.e" } });
    model["analysis"] = json!({ "type": "dynamics", "end": 1.0, "outputs": 11 });
    let outputs = ["force.m.torque", "rotor.alpha", "state.e.rate"];
    let found = posed(&model, &["input.u", "input.v"], &outputs);
    assert_eq!(names(&found.states)[2], "state.e");
    let (u, v) = (&found.inputs[0], &found.inputs[1]);
    assert_eq!(
        [(u.unit.as_str(), u.value), (v.unit.as_str(), v.value)],
        [("N*m", 0.5), ("rad", 0.0)]
    );
    near(found.states[2].value, 0.25, 0.0);
    near(found.outputs[0].value, 0.875, 1e-15);
    is(
        &found.a,
        &[&[0.0, 1.0, 0.0], &[0.0, 0.0, -2.5], &[1.0, 0.0, 0.0]],
        1e-12,
    );
    is(&found.b, &[&[0.0, 0.0], &[10.0, 0.0], &[0.0, -1.0]], 1e-12);
    let c: [&[f64]; 3] = [&[0.0, 0.0, -0.5], &[0.0, 0.0, -2.5], &[1.0, 0.0, 0.0]];
    is(&found.c, &c, 1e-12);
    is(&found.d, &[&[2.0, 0.0], &[10.0, 0.0], &[0.0, -1.0]], 1e-12);
}
