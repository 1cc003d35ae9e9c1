//! Joints whose way has an end, against closed forms.
//!
//! ```text
//! constant acceleration a towards a stop at distance h, from rest, restitution e:
//! t₁ = √(2h/a),   t_n+1 − t_n = 2 eⁿ u/a,   u = a t₁,   at rest from t₁ (1 + e)/(1 − e)
//! ```

mod latches;
mod rest;
mod strokes;
mod words;

use crate::mechanisms::{column, completed, loaded, model, near, pin};
use linkdyn_engine::analysis::{self, Control, Outcome};
use linkdyn_output::{Episode, Event, EventKind};
use serde_json::{Value, json};
use std::f64::consts::PI;

const GRAVITY: f64 = 9.81;
const MASS: f64 = 2.0;

/// A block of 2 kg on an upright guide, let go at rest at a height.
fn block(height: f64, stops: &Value, end: f64) -> Value {
    let bodies = json!({ "ground": { "points": { "O": [0.0, 0.0] } },
        "block": { "mass": MASS, "inertia": 0.1, "com": [0.0, 0.0], "points": { "P": [0.0, 0.0] },
                   "pose": { "position": [0.0, height] } } });
    let mut guide =
        json!({ "type": "prismatic", "between": ["ground.O", "block.P"], "axis": [0.0, 1.0] });
    join(&mut guide, stops);
    let mut model = model(bodies, json!({ "g": guide }), json!({}));
    model["gravity"] = json!([0.0, -GRAVITY]);
    model["initial"] = json!({ "block": { "y": height, "vy": 0.0 } });
    model["analysis"] = json!({ "type": "dynamics", "end": end, "outputs": 41 });
    model
}

/// A rod of 1 kg and 2 m, hinged at its end, let go at rest at an angle.
fn rod(angle: f64, stops: &Value, end: f64) -> Value {
    let bodies = json!({ "ground": { "points": { "O": [0.0, 0.0] } },
        "rod": { "mass": 1.0, "inertia": 1.0 / 3.0, "com": [1.0, 0.0],
                 "points": { "O": [0.0, 0.0], "E": [2.0, 0.0] },
                 "pose": { "position": [0.0, 0.0], "angle": angle } } });
    let mut hinge = pin("ground.O", "rod.O");
    join(&mut hinge, stops);
    let mut model = model(bodies, json!({ "o": hinge }), json!({}));
    model["gravity"] = json!([0.0, -GRAVITY]);
    model["initial"] = json!({ "rod": { "angle": angle, "angular_velocity": 0.0 } });
    model["analysis"] = json!({ "type": "dynamics", "end": end, "outputs": 41 });
    model
}

fn join(to: &mut Value, more: &Value) {
    let more = more.as_object().expect("an object");
    to.as_object_mut().expect("an object").extend(more.clone());
}

fn contacts(run: &Outcome) -> Vec<(Event, Episode)> {
    let events = run.report.events.iter();
    events
        .filter_map(|event| Some((event.clone(), event.episode?)))
        .collect()
}

/// Impacts of a falling block, and the instant from which it rests.
#[test]
fn a_block_bounces_until_it_rests() {
    let (fall, e) = (0.8, 0.5);
    let stops = json!({ "limits": [0.2, 1.5], "restitution": e });
    let run = completed(&block(0.2 + fall, &stops, 2.0));
    let (first, speed) = ((2.0 * fall / GRAVITY).sqrt(), (2.0 * fall * GRAVITY).sqrt());
    let met = contacts(&run);
    let mut time = first;
    let mut left = speed;
    for (event, episode) in &met[..10] {
        assert_eq!(
            (event.joint.as_deref(), event.stop),
            (Some("g"), Some("lower"))
        );
        near(event.time, time, 1e-9 * first);
        near(episode.approach_speed, left, 1e-9 * speed);
        near(
            episode.impulse,
            MASS * left * (1.0 + e),
            1e-9 * MASS * speed,
        );
        near(
            episode.energy_lost,
            0.5 * MASS * left * left * (1.0 - e * e),
            1e-9 * MASS * speed * speed,
        );
        left *= e;
        time += 2.0 * left / GRAVITY;
    }
    let following = |event: &&Event| event.kind == EventKind::SustainedContact;
    let rests = run.report.events.iter().find(following).expect("it rests");
    near(rests.time, first * (1.0 + e) / (1.0 - e), 1e-9 * first);
    // From there the stop carries the weight.
    near(
        *column(&run, "joint.g.stop").last().expect("rows"),
        MASS * GRAVITY,
        1e-9,
    );
    near(
        *column(&run, "joint.g.fy").last().expect("rows"),
        MASS * GRAVITY,
        1e-9,
    );
    near(*column(&run, "block.y").last().expect("rows"), 0.2, 1e-9);
    let imbalance = run.report.quality.energy_imbalance.expect("a ledger");
    assert!(imbalance < 1e-12, "{imbalance:e}");
}

/// Nothing is lost where e = 1.
#[test]
fn a_perfect_stop_keeps_the_energy() {
    let stops = json!({ "limits": [-0.3, null], "restitution": 1.0 });
    let mut model = rod(1.0, &stops, 6.0);
    model["analysis"]["solver"] = json!({ "rtol": 1e-12 });
    let run = completed(&model);
    let met = contacts(&run);
    assert!(met.len() > 3, "{} impacts", met.len());
    let imbalance = run.report.quality.energy_imbalance.expect("a ledger");
    assert!(imbalance < 1e-12, "{imbalance:e}");
    // Of a parabola the steps have no error.
    let stops = json!({ "limits": [0.2, null], "restitution": 1.0 });
    let fallen = completed(&block(1.0, &stops, 5.0));
    let imbalance = fallen.report.quality.energy_imbalance.expect("a ledger");
    assert!(imbalance < 1e-13, "{imbalance:e}");
    // A drop lower than can be told apart has no flights.
    let dropped = completed(&block(0.2 + 1e-13, &stops, 1.0));
    let times = dropped.report.events.iter().map(|event| event.time);
    assert!(times.into_iter().all(f64::is_finite));
    // All flights are alike, to 1e-9 of one.
    let flight = met[1].0.time - met[0].0.time;
    near(flight, 2.0 * met[0].0.time, 1e-9 * flight);
    near(met[3].0.time - met[2].0.time, flight, 1e-9 * flight);
}

/// A rod falls onto a stop: t = ∫ dθ/ω by Gauss and Legendre, with θ = 1 − x², which is smooth at the start.
#[test]
fn a_rod_falls_onto_its_stop() {
    let (from, to) = (1.0, -0.3);
    let run = completed(&rod(from, &json!({ "limits": [to, null] }), 1.5));
    let met = &contacts(&run)[0];
    // ω² = 2 m g (sin θ₀ − sin θ)/I_O, with I_O = 4/3
    let rate = |angle: f64| (1.5 * GRAVITY * (from.sin() - angle.sin())).sqrt();
    let width = (from - to).sqrt();
    let nodes = 2000;
    // Simpson's rule.
    let f = |k: usize| {
        let x = width * k as f64 / nodes as f64;
        match k {
            0 => 2.0 / (1.5 * GRAVITY * from.cos()).sqrt(),
            _ => 2.0 * x / rate(from - x * x),
        }
    };
    let weight = |k: usize| match k {
        _ if k == 0 || k == nodes => 1.0,
        _ if k % 2 == 1 => 4.0,
        _ => 2.0,
    };
    let sum: f64 = (0..=nodes).map(|k| weight(k) * f(k)).sum();
    let time = sum * width / nodes as f64 / 3.0;
    near(met.0.time, time, 1e-9 * time);
    near(met.1.approach_speed, rate(to), 1e-9 * rate(to));
    // It stays: the stop carries the torque of the weight, 1 m from the hinge.
    let stop = column(&run, "joint.o.stop");
    near(*stop.last().expect("rows"), GRAVITY * to.cos(), 1e-9);
    assert_eq!(met.0.end_time, None);
}

/// A stop that yields holds a block for half a period of its spring; with damping the decrement is known.
#[test]
fn a_stop_that_yields_is_a_spring() {
    let (stiffness, damping) = (2e4, 40.0);
    let stops = json!({ "limits": [null, 0.5], "stiffness": stiffness, "damping": damping });
    let mut model = block(0.0, &stops, 1.0);
    model["gravity"] = json!([0.0, 0.0]);
    model["initial"] = json!({ "block": { "y": 0.0, "vy": 1.0 } });
    model["analysis"]["solver"] = json!({ "rtol": 1e-10 });
    let run = completed(&model);
    let (event, episode) = contacts(&run)[0].clone();
    assert_eq!(event.stop, Some("upper"));
    near(event.time, 0.5, 1e-10);
    let decay = damping / (2.0 * MASS);
    let rate = (stiffness / MASS - decay * decay).sqrt();
    // N = K δ + D δ̇ ends before δ does: tan(ω t) = −2 ζ ω/(…)
    let depth = |t: f64| (-decay * t).exp() * (rate * t).sin() / rate;
    let speed = |t: f64| (-decay * t).exp() * ((rate * t).cos() - decay / rate * (rate * t).sin());
    let (mut low, mut high) = (0.5 * PI / rate, PI / rate);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        match stiffness * depth(middle) + damping * speed(middle) > 0.0 {
            true => low = middle,
            false => high = middle,
        }
    }
    near(
        episode.end.expect("it leaves") - event.time,
        low,
        1e-8 * low,
    );
    near(
        episode.separation_speed.expect("it leaves"),
        -speed(low),
        1e-7,
    );
    let deepest = (rate / decay).atan() / rate;
    near(
        episode.peak_penetration,
        depth(deepest),
        1e-8 * depth(deepest),
    );
}

/// A rod that starts on its stop lies there until it is lifted.
#[test]
fn what_lies_on_a_stop_is_lifted() {
    let mut model = rod(0.0, &json!({ "limits": [0.0, 2.0] }), 1.0);
    // The torque of the weight is 9.81 N·m: it is outweighed after 0.5 s.
    model["forces"] = json!({ "m": { "type": "torque", "body": "rod",
        "value": "=2*9.81 N*m * time/(1 s)" } });
    let run = completed(&model);
    let met = &contacts(&run)[0];
    near(met.0.time, 0.0, 0.0);
    near(met.0.end_time.expect("it leaves"), 0.5, 1e-8);
    let (times, stop) = (column(&run, "time"), column(&run, "joint.o.stop"));
    for (t, stop) in times.iter().zip(stop) {
        near(stop, (GRAVITY * (1.0 - 2.0 * t)).max(0.0), 1e-8);
    }
}

/// A four-bar whose rocker strikes a stop: a one-sided contact in a closed loop loses ½ m_red v².
#[test]
fn a_loop_strikes_a_stop() {
    let bodies = json!({
        "ground": { "points": { "A": [0.0, 0.0], "D": [0.4, 0.0] } },
        "crank": { "mass": 0.5, "inertia": 0.002, "com": [0.05, 0.0], "points": { "A": [0.0, 0.0], "B": [0.1, 0.0] },
                   "pose": { "position": [0.0, 0.0], "angle": 1.2 } },
        "coupler": { "mass": 1.0, "inertia": 0.01, "com": [0.18, 0.0], "points": { "B": [0.0, 0.0], "C": [0.36, 0.0] },
                     "pose": { "position": [0.036, 0.093], "angle": 0.3 } },
        "rocker": { "mass": 0.8, "inertia": 0.006, "com": [0.12, 0.0], "points": { "D": [0.0, 0.0], "C": [0.24, 0.0] },
                    "pose": { "position": [0.4, 0.0], "angle": 1.6 } } });
    let mut hinge = pin("ground.D", "rocker.D");
    join(
        &mut hinge,
        &json!({ "limits": [null, 1.95], "restitution": 0.3 }),
    );
    let joints = json!({ "a": pin("ground.A", "crank.A"), "b": pin("crank.B", "coupler.B"),
        "c": pin("coupler.C", "rocker.C"), "d": hinge });
    let mut model = model(bodies, joints, json!({}));
    model["initial"] = json!({ "crank": { "angle": 1.2, "angular_velocity": 8.0 } });
    model["gravity"] = json!([0.0, 0.0]);
    model["analysis"] = json!({ "type": "dynamics", "end": 0.4, "outputs": 41 });
    let run = completed(&model);
    let met = contacts(&run);
    let (event, episode) = &met[0];
    near(
        episode.separation_speed.expect("it leaves"),
        0.3 * episode.approach_speed,
        1e-9 * episode.approach_speed,
    );
    // Loss by the reduced inertia at the rocker: p²/(2 m) (1 − e)/(1 + e) with p = m u (1 + e).
    let reduced = episode.impulse / (episode.approach_speed * 1.3);
    let lost = 0.5 * reduced * episode.approach_speed.powi(2) * (1.0 - 0.09);
    near(episode.energy_lost, lost, 1e-9 * lost);
    // The reduced inertia from the kinetic energy before it, which is ½ m u².
    let kinetic = column(&run, "energy.kinetic")[0];
    near(
        0.5 * reduced * episode.approach_speed.powi(2),
        kinetic,
        1e-8 * kinetic,
    );
    assert!(event.time < 0.4);
}

/// Bodies may be drawn at any turn; a start beyond the ends is refused; drivers that pass them are told of.
#[test]
fn ends_are_seen_from_the_start() {
    let stops = json!({ "limits": [-0.3 + 2.0 * PI, 1.5 + 2.0 * PI] });
    let run = completed(&rod(1.0, &stops, 1.5));
    near(*column(&run, "rod.angle").last().expect("rows"), -0.3, 1e-9);
    // Limits that hold the start as they are written are not turned on.
    let mut swung = rod(5.0, &json!({ "limits": [-5.2, 5.2] }), 0.5);
    swung["initial"]["rod"]["angular_velocity"] = json!(3.0);
    let run = completed(&swung);
    assert_eq!(contacts(&run)[0].0.stop, Some("upper"));
    let refused = |model: &Value| {
        let run = analysis::run(&loaded(model).model, &Control::default());
        run.expect_err("refused").to_string()
    };
    assert_eq!(
        refused(&rod(1.0, &json!({ "limits": [-0.3, 0.9] }), 1.0)),
        "joints.o.limits: the mechanism starts at 1 rad (57.2958°), beyond the upper limit 0.9 rad (51.5662°) (it is the angle of the second body in \
         the first: give wider limits, or another start)"
    );
    assert_eq!(
        refused(&block(0.1, &json!({ "limits": [0.2, 0.9] }), 1.0)),
        "joints.g.limits: the mechanism starts at 0.1 m, beyond the lower limit 0.2 m (it is the slide of the second point \
         along \"axis\": give wider limits, or another start)"
    );
    let mut driven = rod(1.0, &json!({ "limits": [-0.3, 2.0] }), 1.0);
    driven["initial"] = json!({});
    driven["drivers"] = json!({ "m": { "type": "rotation", "body": "rod",
        "motion": { "type": "polynomial", "coefficients": [1.0, 1.5] } } });
    driven["analysis"] = json!({ "type": "kinematics", "end": 1.0, "outputs": 5 });
    let run = completed(&driven);
    assert_eq!(
        run.report.warnings,
        [
            "the drivers take joint \"o\" beyond its upper limit 2 rad (114.592°), by 0.5 rad (28.6°) at t = 1 s: a motion that is prescribed does \
          not stop there"
        ]
    );
}

/// A toggle clamp: the workpiece yields, and beyond the dead centre the crank comes to a rigid stop. What the workpiece stores
/// then is not lost.
#[test]
fn a_clamp_presses_its_workpiece() {
    let bodies = json!({
        "ground": { "points": { "O": [0.0, 0.0] } },
        "crank": { "mass": 0.4, "inertia": 2e-4, "com": [0.03, 0.0], "points": { "O": [0.0, 0.0], "A": [0.06, 0.0] },
                   "pose": { "position": [0.0, 0.0], "angle": 1.0 } },
        "rod": { "mass": 0.5, "inertia": 6e-4, "com": [0.06, 0.0], "points": { "A": [0.0, 0.0], "B": [0.12, 0.0] },
                 "pose": { "position": [0.03, 0.05], "angle": -0.45 } },
        "ram": { "mass": 1.0, "inertia": 1e-4, "com": [0.0, 0.0], "points": { "B": [0.0, 0.0] },
                 "pose": { "position": [0.14, 0.0] } } });
    let mut hinge = pin("ground.O", "crank.O");
    join(&mut hinge, &json!({ "limits": [-0.1, 1.5] }));
    let (workpiece, stiffness) = (0.178, 4e6);
    let guide = json!({ "type": "prismatic", "between": ["ground.O", "ram.B"], "axis": [1.0, 0.0],
        "limits": [null, workpiece], "stiffness": stiffness, "damping": 2000.0 });
    let joints = json!({ "o": hinge, "a": pin("crank.A", "rod.A"), "b": pin("rod.B", "ram.B"), "guide": guide });
    let mut model = model(bodies, joints, json!({}));
    model["gravity"] = json!([0.0, 0.0]);
    model["forces"] = json!({ "hand": { "type": "torque", "body": "crank", "value": -20.0 } });
    model["initial"] = json!({ "crank": { "angle": 1.0, "angular_velocity": 0.0 } });
    model["analysis"] = json!({ "type": "dynamics", "end": 0.3, "outputs": 31 });
    let run = completed(&model);
    let imbalance = run.report.quality.energy_imbalance.expect("a ledger");
    assert!(imbalance < 1e-6, "{imbalance:e}");
    // Locked beyond the dead centre: the ram is where the crank's stop has it.
    let slide = 0.06 * 0.1_f64.cos() + (0.12_f64.powi(2) - (0.06 * 0.1_f64.sin()).powi(2)).sqrt();
    let last = |name: &str| *column(&run, name).last().expect("rows");
    near(last("ram.x"), slide, 1e-9);
    let press = stiffness * (slide - workpiece);
    near(last("joint.guide.stop"), -press, 1e-6 * press);
    // The stop of the crank carries the hand, and what the workpiece turns it on with.
    let lever = 0.06 * 0.1_f64.sin() * slide / (slide - 0.06 * 0.1_f64.cos());
    near(
        last("joint.o.stop"),
        20.0 + press * lever,
        1e-6 * press * lever,
    );
    // Its contact with the workpiece goes on through the impact.
    let of_guide = contacts(&run)
        .into_iter()
        .filter(|(event, _)| event.joint.as_deref() == Some("guide"));
    assert_eq!(of_guide.count(), 1);
}
