//! Simulations that are stepped from outside: against runs, closed forms, and themselves from a checkpoint.

use crate::mechanisms::{column, completed, model, near};
use linkdyn::prelude::*;
use serde_json::{Value, json};
use std::f64::consts::PI;

const MASS: f64 = 2.0;
const GRAVITY: f64 = 9.81;

/// A block of 2 kg on a guide along x (or upright), without weight but where it is upright.
fn block(is_upright: bool, place: f64, stops: &Value) -> Value {
    let (axis, key) = match is_upright {
        true => ([0.0, 1.0], "y"),
        false => ([1.0, 0.0], "x"),
    };
    let position = axis.map(|a| a * place);
    let bodies = json!({ "ground": { "points": { "O": [0.0, 0.0] } },
        "block": { "mass": MASS, "inertia": 0.1, "com": [0.0, 0.0], "points": { "P": [0.0, 0.0] },
                   "pose": { "position": position } } });
    let mut guide =
        json!({ "type": "prismatic", "between": ["ground.O", "block.P"], "axis": axis });
    let more = stops.as_object().expect("an object").clone();
    guide.as_object_mut().expect("an object").extend(more);
    let mut model = model(bodies, json!({ "g": guide }), json!({}));
    model["gravity"] = json!([0.0, -GRAVITY]);
    model["initial"] = json!({ "block": { key: place, format!("v{key}"): 0.0 } });
    model["analysis"] = json!({ "type": "dynamics", "end": 1, "outputs": 11 });
    model
}

fn mechanism(model: &Value) -> Mechanism {
    model.to_string().parse().expect("a sound model")
}

fn simulation(model: &Value) -> Simulation {
    mechanism(model).simulation().expect("it starts")
}

#[test]
fn forces_that_are_held_are_constant() {
    let mut own = simulation(&block(false, 0.0, &json!({})));
    let x = own.coordinate("block.x").expect("there");
    own.set_force(x, 3.0);
    own.step_to(0.5).expect("it moves");
    let (speed, place) = (3.0 / MASS * 0.5, 3.0 / MASS * 0.125);
    near(own.velocity()[x], speed, 1e-12);
    near(own.position()[x], place, 1e-12);
    own.set_force(x, -1.0);
    own.step_to(1.5).expect("it moves");
    near(own.velocity()[x], speed - 1.0 / MASS, 1e-12);
    near(own.position()[x], place + speed - 0.5 / MASS, 1e-12);
    assert_eq!(own.time(), 1.5);
}

#[test]
fn a_law_is_asked_within_steps() {
    let mut own = simulation(&block(false, 0.4, &json!({})));
    let x = own.coordinate("block.x").expect("there");
    own.set_law(move |_, q, _, force| force[x] = -50.0 * q[x]);
    for k in 1..=10 {
        let t = 0.1 * f64::from(k);
        own.step_to(t).expect("it swings");
        near(own.position()[x], 0.4 * (5.0 * t).cos(), 1e-6);
    }
    // A law in time, on which nothing but F depends.
    own.set_law(move |t, _, _, force| force[x] = t);
    let (from, speed) = (own.position()[x], own.velocity()[x]);
    own.step_to(2.0).expect("it moves");
    near(
        own.position()[x],
        from + speed + (0.5 + 1.0 / 6.0) / MASS,
        1e-9,
    );
}

/// Weights alone act on a pendulum, for which accelerations along its curve are known: not where a torque comes from outside.
#[test]
fn a_torque_from_outside_is_one_of_the_model() {
    let text = std::fs::read_to_string("models/pendulum.json").expect("there");
    let mut json: Value = serde_json::from_str(&text).expect("JSON");
    let mut own = simulation(&json);
    let angle = own.coordinate("rod.angle").expect("there");
    own.set_force(angle, 2.5);
    json["forces"] = json!({ "motor": { "type": "torque", "body": "rod", "value": 2.5 } });
    let run = completed(&json);
    let (times, angles) = (column(&run, "time"), column(&run, "rod.angle"));
    for (time, expected) in times.iter().zip(angles).take(60) {
        own.step_to(*time).expect("it swings");
        near(own.position()[angle], expected, 1e-6);
    }
}

#[test]
fn it_goes_as_the_run_does_and_reads_its_columns() {
    for name in ["double-pendulum", "slider-crank-clearance", "toggle-clamp"] {
        let mechanism = Mechanism::bundled(name).expect("bundled");
        let run = mechanism.run().expect("runs");
        let mut own = mechanism.simulation().expect("it starts");
        assert_eq!(own.row().len(), mechanism.columns().count());
        for (row, time) in run.time().iter().enumerate().take(20) {
            own.step_to(time).expect("it moves");
            for (name, column) in mechanism.columns().filter(|(name, _)| name.ends_with(".x")) {
                let expected = run.column(column).get(row).expect("a row");
                let found = own.value(column);
                assert!(
                    (found - expected).abs() < 1e-4,
                    "{name} at {time}: {found} for {expected}"
                );
            }
        }
    }
}

/// Impacts on a rigid stop, by their closed forms: each is told with its approach and impulse as it happens.
#[test]
fn impacts_are_told_as_they_happen() {
    let (fall, e) = (0.8, 0.5);
    let model = block(
        true,
        0.2 + fall,
        &json!({ "limits": [0.2, 1.5], "restitution": e }),
    );
    let first = (2.0 * fall / GRAVITY).sqrt();
    let mut speed = GRAVITY * first;
    let mut own = simulation(&model);
    assert!(own.step_to(0.9 * first).expect("it falls").is_empty());
    let mut time = first;
    for _ in 0..5 {
        let told = own.step_to_event(10.0).expect("it meets the stop");
        let [event] = &told[..] else {
            panic!("{told:?}")
        };
        let episode = event.episode.expect("an impact");
        near(own.time(), time, 1e-9);
        near(event.time, time, 1e-9);
        near(episode.approach_speed, speed, 1e-8);
        near(episode.impulse, MASS * (1.0 + e) * speed, 1e-8);
        let y = own.coordinate("block.y").expect("there");
        near(own.velocity()[y], e * speed, 1e-8);
        speed *= e;
        time += 2.0 * speed / GRAVITY;
    }
    // A force from below takes it off the stop.
    own.step_to(3.0).expect("it rests");
    let y = own.coordinate("block.y").expect("there");
    near(own.position()[y], 0.2, 1e-9);
    own.set_force(y, MASS * (GRAVITY + 1.0));
    own.step_to(3.5).expect("it rises");
    near(own.position()[y], 0.2 + 0.125, 1e-6);
}

#[test]
fn from_a_checkpoint_it_goes_on_bit_by_bit() {
    for name in [
        "pendulum",
        "double-pendulum",
        "slider-crank-clearance",
        "toggle-clamp",
        "geneva",
        "walking-strandbeest",
    ] {
        let mechanism = Mechanism::bundled(name).expect("bundled");
        let mut own = mechanism.simulation().expect("it starts");
        let step = 0.002;
        let walk = |own: &mut Simulation, from: i32, to: i32| {
            let mut seen = Vec::new();
            for k in from..to {
                let push = (f64::from(k) * PI / 7.0).sin();
                own.set_force(2, 1e-3 * push);
                let events = own.step_to(step * f64::from(k + 1)).expect("it moves");
                let bits = own.row().iter().map(|value| value.to_bits());
                seen.push((bits.collect::<Vec<_>>(), events));
            }
            seen
        };
        walk(&mut own, 0, 10);
        let checkpoint = own.checkpoint();
        let straight = walk(&mut own, 10, 25);
        own.restore(&checkpoint).expect("its own");
        near(own.time(), 10.0 * step, 0.0);
        assert!(walk(&mut own, 10, 25) == straight, "{name}");
        let mut other = mechanism.simulation().expect("it starts");
        assert!(other.restore(&checkpoint).is_err());
    }
}

#[test]
fn what_can_not_be_stepped_says_why() {
    let refused = |mechanism: &Mechanism| {
        let refused = mechanism.simulation().err().expect("refused");
        (refused.complaints()[0].path.clone(), refused.to_string())
    };
    let driven = Mechanism::bundled("four-bar").expect("bundled");
    let (path, said) = refused(&driven);
    assert_eq!(path, "analysis.type", "{said}");
    let dynamics = driven.set("analysis.type", "dynamics").expect("sound");
    let (path, said) = refused(&dynamics);
    assert_eq!(path, "drivers", "{said}");
    let mut own = simulation(&block(false, 0.0, &json!({})));
    own.step_to(0.5).expect("it moves");
    let back = own.step_to(0.4).expect_err("it has passed");
    assert!(back.to_string().contains("does not step back"), "{back}");
    assert!(own.coordinate("block.z").is_err());
    for time in [f64::NAN, f64::INFINITY] {
        let refused = own.step_to(time).expect_err("no instant");
        assert!(refused.to_string().contains("finite"), "{refused}");
    }
}

/// Forces that are no numbers stop the motion where it is; with other forces it goes on from there.
#[test]
fn forces_that_are_no_numbers_stop_it_where_it_is() {
    let mut own = simulation(&block(false, 0.0, &json!({})));
    let x = own.coordinate("block.x").expect("there");
    own.set_force(x, 4.0);
    own.step_to(0.5).expect("it moves");
    let (place, speed) = (own.position()[x], own.velocity()[x]);
    for force in [f64::NAN, f64::INFINITY] {
        own.set_force(x, force);
        assert!(own.step_to(1.0).is_err());
        own.set_law(move |t, _, _, all| all[x] = if t > 0.6 { force } else { 4.0 });
        assert!(own.step_to(1.0).is_err());
        assert!(own.time() < 0.7 && own.row().iter().all(|value| !value.is_infinite()));
        own.set_force(x, 0.0);
        own.step_to(own.time() + 1e-3).expect("it moves on");
        assert!(own.position()[x] >= place && own.velocity()[x] >= speed);
    }
}
