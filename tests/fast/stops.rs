//! Joints whose way has an end, against closed forms.
//!
//! ```text
//! constant acceleration a towards a stop at distance h, from rest, restitution e:
//! t₁ = √(2h/a),   t_n+1 − t_n = 2 eⁿ u/a,   u = a t₁,   at rest from t₁ (1 + e)/(1 − e)
//! ```

use crate::mechanisms::{column, loaded, model, outcome, pin};
use linkdyn_engine::analysis::{self, Control, Outcome};
use linkdyn_output::{Episode, Event, EventKind, Status};
use serde_json::{Value, json};
use std::f64::consts::{FRAC_PI_2, PI};

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

#[track_caller]
fn completed(model: &Value) -> Outcome {
    let run = outcome(model);
    assert_eq!(
        run.report.status,
        Status::Completed,
        "{:?}",
        run.report.message
    );
    run
}

fn contacts(run: &Outcome) -> Vec<(Event, Episode)> {
    let events = run.report.events.iter();
    events
        .filter_map(|event| Some((event.clone(), event.episode?)))
        .collect()
}

#[track_caller]
fn near(found: f64, expected: f64, tolerance: f64) {
    let off = (found - expected).abs();
    assert!(
        off <= tolerance,
        "{found} for {expected}: {off:e} > {tolerance:e}"
    );
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

/// Two bodies float, hinged to each other, and latch: momenta stay, and what is lost is what the one body that they are then
/// does not have.
#[test]
fn floating_bodies_latch() {
    let bodies = json!({
        "one": { "mass": 2.0, "inertia": 0.05, "com": [0.1, 0.02], "points": { "H": [0.3, 0.0] } },
        "two": { "mass": 1.0, "inertia": 0.03, "com": [0.2, -0.01], "points": { "H": [0.0, 0.0] },
                 "pose": { "position": [0.3, 0.0], "angle": 0.2 } } });
    let mut hinge = pin("one.H", "two.H");
    join(
        &mut hinge,
        &json!({ "limits": [null, 1.2], "latch": "upper" }),
    );
    let mut model = model(bodies, json!({ "h": hinge }), json!({}));
    model["gravity"] = json!([0.0, 0.0]);
    model["initial"] = json!({ "one": { "x": 0.0, "y": 0.0, "angle": 0.0, "vx": 0.3, "vy": -0.2, "angular_velocity": -0.5 },
        "two": { "angle": 0.2, "angular_velocity": 3.0 } });
    model["analysis"] =
        json!({ "type": "dynamics", "end": 1.0, "outputs": 21, "solver": { "rtol": 1e-12 } });
    let run = completed(&model);
    let of = |name: &str| column(&run, name);
    let body = |name: &str, mass: f64, inertia: f64, [a, b]: [f64; 2]| {
        let [x, y, angle, vx, vy, omega] =
            ["x", "y", "angle", "vx", "vy", "omega"].map(|word| of(&format!("{name}.{word}")));
        move |k: usize| {
            let (sin, cos) = angle[k].sin_cos();
            let rho = [a * cos - b * sin, a * sin + b * cos];
            let place = [x[k] + rho[0], y[k] + rho[1]];
            let rate = [vx[k] - omega[k] * rho[1], vy[k] + omega[k] * rho[0]];
            let spin = inertia * omega[k] + mass * (place[0] * rate[1] - place[1] * rate[0]);
            (
                [mass * rate[0], mass * rate[1], spin],
                [mass * place[0], mass * place[1]],
            )
        }
    };
    let (one, two) = (
        body("one", 2.0, 0.05, [0.1, 0.02]),
        body("two", 1.0, 0.03, [0.2, -0.01]),
    );
    let all = |k: usize| {
        let ((p, r), (q, s)) = (one(k), two(k));
        (
            [p[0] + q[0], p[1] + q[1], p[2] + q[2]],
            [r[0] + s[0], r[1] + s[1]],
        )
    };
    let last = of("time").len() - 1;
    let (before, after) = (all(0).0, all(last).0);
    for (before, after) in before.iter().zip(after) {
        near(after, *before, 1e-12);
    }
    // One body: its energy is that of its momenta.
    let ([px, py, spin], [mx, my]) = all(last);
    let mass = 3.0;
    let about = spin - (mx * py - my * px) / mass;
    let (h1, h2) = (two(last).1, one(last).1);
    let gap = [h1[0] / 1.0 - h2[0] / 2.0, h1[1] / 1.0 - h2[1] / 2.0];
    let inertia = 0.08 + 2.0 / mass * (gap[0] * gap[0] + gap[1] * gap[1]);
    let rigid = 0.5 * ((px * px + py * py) / mass + about * about / inertia);
    let kinetic = of("energy.kinetic");
    near(kinetic[last], rigid, 1e-12);
    let (event, episode) = contacts(&run)[0].clone();
    assert_eq!((event.stop, event.end_time), (Some("upper"), None));
    near(episode.energy_lost, kinetic[0] - rigid, 1e-11);
    near(of("two.angle")[last] - of("one.angle")[last], 1.2, 1e-12);
    let kinds: Vec<EventKind> = run.report.events.iter().map(|event| event.kind).collect();
    assert!(kinds.contains(&EventKind::Latch), "{kinds:?}");
}

/// A latch opens where it is pulled by more than it holds, and may close again.
#[test]
fn a_latch_opens_above_its_pull() {
    let mut model = rod(
        0.0,
        &json!({ "limits": [-1.0, 0.0], "latch": "upper", "release": 12.0 }),
        3.0,
    );
    // The weight pulls with 9.81 N·m, the torque with the rest; then it turns round.
    model["forces"] = json!({ "m": { "type": "torque", "body": "rod",
        "value": "=table(time; 0 s, 0 N*m; 1 s, -4 N*m; 1.5 s, 30 N*m; 4 s, 30 N*m)" } });
    let run = completed(&model);
    let at = |wanted: EventKind| {
        let events = run.report.events.iter();
        let times = events
            .filter(|event| event.kind == wanted)
            .map(|event| event.time);
        times.collect::<Vec<f64>>()
    };
    let (closed, opened) = (at(EventKind::Latch), at(EventKind::Unlatch));
    assert_eq!(
        (closed.len(), opened.len()),
        (2, 1),
        "{closed:?} {opened:?}"
    );
    near(opened[0], (12.0 - GRAVITY) / 4.0, 1e-8);
    let (times, stop) = (column(&run, "time"), column(&run, "joint.o.stop"));
    for (t, stop) in times.iter().zip(&stop).filter(|(t, _)| **t < opened[0]) {
        near(*stop, GRAVITY + 4.0 * t, 1e-8);
    }
    near(*stop.last().expect("rows"), GRAVITY - 30.0, 1e-8);
    // At rest, too, what begins latched stays so.
    let mut model = rod(
        0.0,
        &json!({ "limits": [-1.0, 0.0], "latch": "upper" }),
        1.0,
    );
    model["analysis"] = json!({ "type": "statics" });
    let run = completed(&model);
    near(column(&run, "rod.angle")[0], 0.0, 1e-12);
    near(column(&run, "joint.o.stop")[0], GRAVITY, 1e-9);
}
