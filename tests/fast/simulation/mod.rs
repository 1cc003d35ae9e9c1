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

/// A rotor of 2 kg·m² about ground, turned by an input, and a state that its steps feed.
fn rotor() -> Value {
    let mut rotor = model(
        json!({ "ground": { "points": { "O": [0.0, 0.0] } },
            "rotor": { "mass": 1.0, "inertia": 2.0, "com": [0.0, 0.0], "points": { "O": [0.0, 0.0] } } }),
        json!({ "o": { "type": "revolute", "between": ["ground.O", "rotor.O"] } }),
        json!({}),
    );
    rotor["parameters"] = json!({ "first": "2 N*m" });
    rotor["inputs"] = json!({ "torque": "=2*first", "gain": 1 });
    rotor["states"] = json!({ "sum": { "rate": "=input.torque", "start": 0 } });
    rotor["forces"] = json!({ "motor": { "type": "torque", "body": "rotor", "value": "=input.gain*input.torque" } });
    rotor["analysis"] = json!({ "type": "dynamics", "end": 1, "outputs": 11 });
    rotor
}

#[test]
fn inputs_are_constant_until_they_are_set() {
    let made = mechanism(&rotor());
    let first = made.parameter("first").expect("there");
    let other = made.with([(first, newton_metre(3.0))]).expect("sound");
    assert_eq!(other.model().inputs["torque"].start, 6.0);
    let mut own = made.simulation().expect("it starts");
    assert_eq!(own.inputs().collect::<Vec<_>>(), ["torque", "gain"]);
    own.step_to(1.0).expect("it turns");
    near(own.velocity()[2], 2.0, 1e-12);
    let there = own.checkpoint();
    own.set_input("torque", -8.0).expect("an input");
    own.set_input("gain", 0.5).expect("an input");
    own.step_to(3.0).expect("it turns");
    near(own.velocity()[2], 2.0 - 4.0, 1e-12);
    let sum = made.column("state.sum").expect("there");
    near(own.value(sum), 4.0 - 16.0, 1e-12);
    own.restore(&there).expect("its own");
    assert_eq!(own.input("torque").expect("an input"), 4.0);
    own.step_to(3.0).expect("it turns");
    near(own.velocity()[2], 6.0, 1e-12);
    let unknown = own.set_input("torqe", 1.0).expect_err("there is none");
    assert_eq!(
        unknown.to_string(),
        "no input is called \"torqe\"; did you mean \"torque\"?"
    );
    let endless = own.set_input("torque", f64::NAN).expect_err("no number");
    let said = endless.to_string();
    assert!(said.ends_with("NaN is not a finite number"), "{said}");
}

/// Columns that follow from rows have the numbers that were set.
#[test]
fn requested_columns_know_inputs_that_were_set() {
    let mut model = rotor();
    model["analysis"]["columns"] = json!(["*", "force.motor.torque"]);
    let made = mechanism(&model);
    let torque = made.column("force.motor.torque").expect("there");
    let mut own = made.simulation().expect("it starts");
    near(own.value(torque), 4.0, 0.0);
    own.set_input("torque", -8.0).expect("an input");
    own.step_to(1.0).expect("it turns");
    near(own.value(torque), -8.0, 0.0);
}

/// What an input turns over at once is an event at once: a step of a formula, and a lock that closes.
#[test]
fn inputs_may_jump_over_kinks_and_events() {
    let mut model = rotor();
    model["inputs"]["gain"] = json!(0);
    model["forces"]["motor"]["value"] = json!("=6 N*m*step(input.gain - 0.5)");
    model["joints"]["o"]["lock"] = json!({ "from": "input.torque >= 10 N*m" });
    let mut own = simulation(&model);
    own.step_to(1.0).expect("it rests");
    near(own.velocity()[2], 0.0, 0.0);
    own.set_input("gain", 1.0).expect("an input");
    own.step_to(2.0).expect("it turns");
    near(own.velocity()[2], 3.0, 1e-12);
    own.set_input("torque", 12.0).expect("an input");
    let told = own.step_to(3.0).expect("it is locked");
    assert_eq!(told.len(), 1, "{told:?}");
    near(told[0].time, 2.0, 1e-9);
    near(own.velocity()[2], 0.0, 1e-12);
}

/// A slider-crank whose motor is steered moves as one that follows the same law.
#[test]
fn a_steered_driver_goes_on_from_where_it_is() {
    let mut own: Value =
        serde_json::from_str(&linkdyn_model::bundled::text("slider-crank").expect("there"))
            .expect("JSON");
    own["analysis"] = json!({ "type": "dynamics", "end": 1, "outputs": 11, "solver": { "rtol": 1e-12, "atol": 1e-14 } });
    own["bodies"]["flag"] =
        json!({ "mass": 0.1, "inertia": 1e-4, "com": [0.0, -0.1], "points": { "P": [0.0, 0.0] } });
    let crank = own["joints"]
        .as_object()
        .expect("joints")
        .values()
        .find_map(|joint| {
            let ends = joint["between"].as_array()?;
            ends[1]
                .as_str()
                .filter(|end| end.starts_with("crank."))
                .map(str::to_owned)
        });
    let crank = crank.expect("the crank has a pin");
    own["joints"]["flag"] = json!({ "type": "revolute", "between": [crank, "flag.P"] });
    let driver = own["drivers"]
        .as_object()
        .expect("drivers")
        .keys()
        .next()
        .expect("one")
        .clone();
    own["drivers"][&driver]["motion"] =
        json!({ "type": "constant_velocity", "start": "0.5 rad", "velocity": "0 rad/s" });
    let made = mechanism(&own);
    let mut steered = made.steered_simulation(&[&driver]).expect("it starts");
    steered.set_acceleration(&driver, 4.0).expect("steered");
    steered.step_to(0.5).expect("it turns");
    steered.set_acceleration(&driver, -2.0).expect("steered");
    steered.step_to(1.0).expect("it turns");
    let value = made
        .column(&format!("driver.{driver}.value"))
        .expect("there");
    near(steered.value(value), 0.5 + 0.5 + 2.0 * 0.5 - 0.25, 1e-12);
    own["drivers"][&driver]["motion"] =
        json!({ "type": "polynomial", "coefficients": ["0.5 rad", "0 rad/s", "2 rad/s^2"] });
    own["analysis"]["end"] = json!(0.5);
    let run = mechanism(&own).run().expect("it runs");
    let mut again = made.steered_simulation(&[&driver]).expect("it starts");
    again.set_acceleration(&driver, 4.0).expect("steered");
    again.step_to(0.5).expect("it turns");
    for (column, place) in made.columns().map(|(_, column)| column).zip(0..) {
        let known = run.column(column).last().expect("rows");
        if known.is_nan() {
            continue;
        }
        near(again.row()[place], known, 1e-8 * known.abs().max(1.0));
    }
    let refused = made
        .simulation()
        .expect("it starts")
        .set_acceleration(&driver, 1.0)
        .expect_err("it follows its motion");
    let said = refused.to_string();
    let known = "its acceleration can't be set, it follows its motion (begin the simulation with this driver steered)";
    assert!(said.ends_with(known), "{said}");
}

/// Where a body is, how fast, and what accelerates it.
const WORDS: [&str; 9] = ["x", "y", "angle", "vx", "vy", "omega", "ax", "ay", "alpha"];

/// The effort that a driver had, put in as the input of the driver let go, moves the mechanism as the driver did, from where it did.
#[test]
fn released_drivers_are_moved_by_their_effort() {
    for (own_name, kind) in [
        ("excavator", "length"),
        ("slider-crank", "rotation"),
        ("parallel-crank", "rotation"),
    ] {
        let mut own: Value =
            serde_json::from_str(&linkdyn_model::bundled::text(own_name).expect("there"))
                .expect("JSON");
        own["analysis"] = json!({ "type": "inverse_dynamics", "end": 0.1, "outputs": 11 });
        let made = mechanism(&own);
        let driver = made.model().drivers.keys().next().expect("one").clone();
        assert_eq!(own["drivers"][&driver]["type"], kind, "{own_name}");
        let run = made.run().expect("it runs");
        let effort = run
            .column(
                made.column(&format!("driver.{driver}.effort"))
                    .expect("there"),
            )
            .get(0)
            .expect("rows");
        let released = made.release(&[&driver]).expect("it can be let go");
        let mut free = released.simulation().expect("it starts");
        free.set_input(&driver, effort).expect("an input");
        // What is read is what the forces until now have done.
        free.step_to(1e-10).expect("it starts");
        let names = released.model().bodies.keys();
        let names = names.flat_map(|body| WORDS.map(|word| format!("{body}.{word}")));
        let both = names.filter_map(|name| {
            let known = run.column(made.column(&name).ok()?).get(0)?;
            Some((free.value(released.column(&name).ok()?), known, name))
        });
        let both: Vec<(f64, f64, String)> = both.collect();
        assert!(both.len() > 17, "{own_name}: {}", both.len());
        // That of gravity where all rest.
        let size = both
            .iter()
            .fold(GRAVITY, |size: f64, one| size.max(one.1.abs()));
        for (found, known, name) in both {
            let off = (found - known).abs();
            assert!(off <= 1e-6 * size, "{own_name} {name}: {found} {known}");
        }
    }
}
