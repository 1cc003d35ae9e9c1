//! Joints and locks that close and open at events, and one-way clutches, against closed forms.

mod flight;
mod laws;
mod one_way;
mod rest;
mod words;

use flight::{Flight, MEETING, flight, turned};

use crate::mechanisms::{column, completed, loaded, model, near, outcome, pin};
use linkdyn_engine::analysis::Outcome;
use linkdyn_output::{Episode, Event, EventKind, Status};
use serde_json::{Value, json};

fn times(run: &Outcome, kind: EventKind) -> Vec<f64> {
    let events = run.report.events.iter();
    let events = events.filter(|event| event.kind == kind);
    events.map(|event| event.time).collect()
}

fn episodes(run: &Outcome) -> Vec<(&Event, Episode)> {
    let events = run.report.events.iter();
    events
        .filter_map(|event| Some((event, event.episode?)))
        .collect()
}

fn join(to: &mut Value, more: &Value) {
    let more = more.as_object().expect("an object");
    to.as_object_mut().expect("an object").extend(more.clone());
}

/// A rotor on ground and a load on the rotor, both about their centres, of these inertias; `between` goes to the joint of both.
fn shaft(inertias: [f64; 2], omegas: [f64; 2], between: &Value, end: f64) -> Value {
    let wheel = |inertia: f64| {
        json!({ "mass": 1.0, "inertia": inertia, "com": [0.0, 0.0],
                "points": { "O": [0.0, 0.0], "R": [0.2, 0.0] } })
    };
    let bodies = json!({ "ground": { "points": { "O": [0.0, 0.0] } },
        "rotor": wheel(inertias[0]), "load": wheel(inertias[1]) });
    let mut clutch = pin("rotor.O", "load.O");
    join(&mut clutch, between);
    let joints = json!({ "bearing": pin("ground.O", "rotor.O"), "clutch": clutch });
    let mut model = model(bodies, joints, json!({}));
    model["gravity"] = json!([0.0, 0.0]);
    model["initial"] = json!({ "rotor": { "angle": 0.0, "angular_velocity": omegas[0] },
                               "load": { "angle": 0.0, "angular_velocity": omegas[1] } });
    model["analysis"] =
        json!({ "type": "dynamics", "end": end, "outputs": 41, "solver": { "rtol": 1e-12 } });
    model
}

/// A clutch closes at an angle and opens later: both turn as one from there on, and what is lost is that of the reduced inertia.
#[test]
fn a_clutch_makes_two_rotors_one() {
    let lock = json!({ "lock": { "from": "rotor.angle >= 3 rad", "until": "time >= 1 s" } });
    let run = completed(&shaft([0.5, 0.3], [10.0, 2.0], &lock, 2.0));
    near(times(&run, EventKind::Close)[0], 0.3, 1e-11);
    near(times(&run, EventKind::Open)[0], 1.0, 1e-11);
    let (time, rotor, load) = (
        column(&run, "time"),
        column(&run, "rotor.omega"),
        column(&run, "load.omega"),
    );
    for (k, t) in time.iter().enumerate() {
        let [first, second] = if *t > 0.3 { [7.0, 7.0] } else { [10.0, 2.0] };
        near(rotor[k], first, 1e-12 * 10.0);
        near(load[k], second, 1e-12 * 10.0);
    }
    let (event, episode) = episodes(&run)[0];
    assert_eq!(
        (event.joint.as_deref(), event.stop),
        (Some("clutch"), Some("lock"))
    );
    near(episode.energy_lost, 0.5 * 0.1875 * 64.0, 1e-11);
    near(episode.approach_speed, 8.0, 1e-11);
    near(episode.impulse.abs(), 0.3 * 5.0, 1e-11);
    near(episode.end.expect("it opens"), 1.0, 1e-11);
    let sums = &run.report.stops[0];
    assert_eq!((sums.joint.as_str(), sums.stop), ("clutch", "lock"));
    near(sums.energy_lost, 6.0, 1e-11);
    near(
        *column(&run, "energy.dissipated").last().expect("rows"),
        6.0,
        1e-11,
    );
    // What holds at the start and is opened by what it carries.
    let lock = json!({ "lock": { "release": 0.6 } });
    let mut model = shaft([0.5, 0.3], [0.0, 0.0], &lock, 2.0);
    model["forces"] =
        json!({ "m": { "type": "torque", "body": "rotor", "value": "=1.6 N*m/s*time" } });
    let run = completed(&model);
    near(times(&run, EventKind::Open)[0], 1.0, 1e-8);
    let stop = column(&run, "joint.clutch.stop");
    let load = column(&run, "load.omega");
    let beside = |t: &f64| (t - 1.0).abs() > 1e-6;
    for (k, t) in time.iter().enumerate().filter(|(_, t)| beside(t)) {
        near(stop[k], if *t < 1.0 { 0.6 * t } else { 0.0 }, 1e-8);
        near(load[k], if *t < 1.0 { t * t } else { 1.0 }, 1e-7);
    }
}

/// Hooks that meet in flight close as a pin, a weld, a slot and a slide: momenta stay, and what is lost is ½ wᵀ W⁻¹ w; opened
/// again, nothing is lost, and both fly on.
#[test]
fn hooks_close_and_open_in_flight() {
    let angles = [0.3, -0.4];
    let flight = flight(angles);
    for (joint, turns) in [
        (json!({ "type": "revolute" }), Some(false)),
        (
            json!({ "type": "fixed", "angle": angles[1] - angles[0] }),
            Some(true),
        ),
        (json!({ "type": "slot", "axis": [1.0, 0.5] }), None),
        (
            json!({ "type": "prismatic", "axis": [1.0, 0.5], "angle": angles[1] - angles[0] }),
            None,
        ),
    ] {
        let mut joint = joint;
        join(
            &mut joint,
            &json!({ "between": ["one.H", "two.H"],
                     "active": { "from": "time >= 0.5 s", "until": "time reaches 0.8 s" } }),
        );
        let run = completed(&flight.model(&joint));
        near(times(&run, EventKind::Close)[0], MEETING, 1e-11);
        near(times(&run, EventKind::Open)[0], 0.8, 1e-11);
        let last = column(&run, "time").len() - 1;
        let (before, after) = (flight.sums(&run, 0), flight.sums(&run, last));
        for (after, before) in after.iter().zip(before).take(3) {
            near(*after, before, 1e-12);
        }
        let lost = before[3] - after[3];
        let (_, episode) = episodes(&run)[0];
        near(episode.energy_lost, lost, 1e-11);
        assert!(lost > 0.1, "{lost} J");
        if let Some(turns) = turns {
            near(episode.energy_lost, flight.lost(turns), 1e-12);
        }
        let state = column(&run, "joint.hook.state");
        let (time, force) = (column(&run, "time"), column(&run, "joint.hook.fx"));
        for (k, t) in time.iter().enumerate() {
            // Outputs at the events themselves may be on either side.
            if (t - MEETING).abs() < 1e-9 || (t - 0.8).abs() < 1e-9 {
                continue;
            }
            let is_closed = (MEETING..0.8).contains(t);
            near(state[k], f64::from(u8::from(is_closed)), 0.0);
            assert_eq!(force[k] != 0.0, is_closed, "at {t}");
            // Once it has opened, each goes on alone.
            if *t > 0.8 {
                let omega = column(&run, "two.omega");
                near(omega[k], omega[last], 1e-12);
            }
        }
    }
}

/// What opens by the speed that its closing leaves opens at once, and closes when its event comes again.
#[test]
fn a_closing_may_open_it_again() {
    let lock =
        json!({ "lock": { "from": "rotor.omega >= 6 rad/s", "until": "rotor.omega <= 5 rad/s" } });
    let mut model = shaft([0.5, 0.5], [5.0, 0.0], &lock, 2.0);
    model["forces"] = json!({ "m": { "type": "torque", "body": "rotor", "value": 2.0 } });
    let run = completed(&model);
    let (closed, opened) = (times(&run, EventKind::Close), times(&run, EventKind::Open));
    // From 6 and 0 to 3 and 3; from 6 and 3 to 4.5 each; from 6 and 4.5 to 5.25, which is enough to stay.
    for (k, time) in [0.25, 1.0, 1.375].iter().enumerate() {
        near(closed[k], *time, 1e-11);
    }
    assert_eq!(
        (closed.len(), opened.len()),
        (3, 2),
        "{closed:?} {opened:?}"
    );
    near(opened[0], closed[0], 0.0);
    let omega = *column(&run, "load.omega").last().expect("rows");
    near(omega, 5.25 + 2.0 * 0.625, 1e-10);
}

/// A pin that closes where its points do not meet ends the run, and says how far they are apart.
#[test]
fn points_that_do_not_meet_are_told() {
    let mut flight = flight([0.3, -0.4]);
    flight.places[1][0] += 0.012;
    let joint = json!({ "type": "revolute", "between": ["one.H", "two.H"], "active": { "from": "time >= 0.5 s" } });
    let run = outcome(&flight.model(&joint));
    assert_eq!(run.report.status, Status::Singular);
    assert_eq!(
        run.report.message.as_deref(),
        Some(
            "at t = 0.5 s joint \"hook\" closes, and its points are 0.012 m apart; the rows until there are kept. Let its event \
             be where they meet"
        )
    );
    assert_eq!(column(&run, "time").len(), 11);
    let weld = json!({ "type": "fixed", "between": ["one.H", "two.H"], "angle": "-30 deg",
                       "active": { "from": "time >= 0.5 s" } });
    let run = outcome(&self::flight([0.3, -0.4]).model(&weld));
    assert_eq!(
        run.report.message.as_deref(),
        Some(
            "at t = 0.5 s joint \"hook\" closes, and its bodies are 0.1764 rad (10.11°) off their angle; the rows until there are kept. Let \
             its event be where they meet"
        )
    );
}

/// A shear pin holds up to its force, and lets go for good.
#[test]
fn a_shear_pin_breaks() {
    let bodies = json!({ "ground": { "points": { "O": [0.0, 0.0] } },
        "block": { "mass": 2.0, "inertia": 0.1, "com": [0.0, 0.0], "points": { "P": [0.0, 0.0], "R": [0.3, 0.0] } } });
    let mut held = pin("ground.O", "block.P");
    held["active"] = json!({ "release": "5 N" });
    let mut model = model(bodies, json!({ "shear": held }), json!({}));
    model["gravity"] = json!([0.0, 0.0]);
    model["forces"] = json!({ "pull": { "type": "force", "at": "block.P", "vector": ["=2.4 N/s*time", "=3.2 N/s*time"] } });
    model["initial"] = json!({ "block": { "angle": 0.0, "angular_velocity": 0.0 } });
    model["analysis"] =
        json!({ "type": "dynamics", "end": 2.5, "outputs": 26, "solver": { "rtol": 1e-12 } });
    model["responses"] = json!({ "opened": "max(events.open)" });
    let run = completed(&model);
    let opened = times(&run, EventKind::Open);
    assert_eq!(opened.len(), 1);
    near(opened[0], 1.25, 1e-8);
    assert_eq!(run.responses[0].value, Some(opened[0]));
    let (time, x, fx) = (
        column(&run, "time"),
        column(&run, "block.x"),
        column(&run, "joint.shear.fx"),
    );
    for (k, &t) in time.iter().enumerate() {
        let a: f64 = 1.25;
        let free = 2.4 / 2.0 * ((t.powi(3) - a.powi(3)) / 6.0 - a * a / 2.0 * (t - a));
        near(x[k], if t > a { free } else { 0.0 }, 1e-8);
        near(fx[k], if t > a { 0.0 } else { -2.4 * t }, 1e-8);
    }
    let (_, episode) = episodes(&run)[0];
    near(episode.energy_lost, 0.0, 1e-12);
    near(episode.impulse, 4.0 * 1.25 * 1.25 / 2.0, 1e-7);
}

/// What a driver moves can't be locked: that is told, with what was computed before.
#[test]
fn a_lock_on_a_driver_is_told() {
    let lock = json!({ "lock": { "from": "time >= 0.25 s" } });
    let mut model = shaft([0.5, 0.3], [0.0, 0.0], &lock, 1.0);
    model["drivers"] = json!({ "m": { "type": "rotation", "body": "load", "relative_to": "rotor",
        "motion": { "type": "constant_velocity", "velocity": 2.0 } } });
    model["initial"] = json!({ "rotor": { "angle": 0.0, "angular_velocity": 0.0 } });
    let run = outcome(&model);
    assert_eq!(
        run.report.message.as_deref(),
        Some(
            "at t = 0.25 s the lock of joint \"clutch\" closes on what a driver moves on; the rows until there are kept. Let the \
             driver rest there, or let a torque drive instead of it"
        )
    );
}
