//! Joints and locks that close and open at events, and one-way clutches, against closed forms.

mod laws;
mod one_way;
mod rest;
mod words;

use crate::mechanisms::{column, loaded, model, outcome, pin};
use linkdyn_engine::analysis::Outcome;
use linkdyn_output::{Episode, Event, EventKind, Status};
use serde_json::{Value, json};

#[track_caller]
fn near(found: f64, expected: f64, tolerance: f64) {
    let off = (found - expected).abs();
    assert!(
        off <= tolerance,
        "{found} for {expected}: {off:e} > {tolerance:e}"
    );
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

/// Two bodies in free flight whose hooks meet at an instant, with another velocity each.
struct Flight {
    masses: [f64; 2],
    inertias: [f64; 2],
    hooks: [[f64; 2]; 2],
    /// At the instant.
    places: [[f64; 2]; 2],
    angles: [f64; 2],
    velocities: [[f64; 2]; 2],
    omegas: [f64; 2],
}

const MEETING: f64 = 0.5;

fn turned([x, y]: [f64; 2], angle: f64) -> [f64; 2] {
    let (sin, cos) = angle.sin_cos();
    [cos * x - sin * y, sin * x + cos * y]
}

fn flight(angles: [f64; 2]) -> Flight {
    let hooks = [[0.3, 0.1], [-0.2, 0.05]];
    let first = [0.1, -0.05];
    let [a, b] = [turned(hooks[0], angles[0]), turned(hooks[1], angles[1])];
    Flight {
        masses: [2.0, 1.0],
        inertias: [0.05, 0.03],
        hooks,
        places: [first, [first[0] + a[0] - b[0], first[1] + a[1] - b[1]]],
        angles,
        velocities: [[0.3, -0.2], [-0.7, 0.4]],
        omegas: [-0.5, 3.0],
    }
}

impl Flight {
    fn model(&self, joint: &Value) -> Value {
        let body = |k: usize| {
            json!({ "mass": self.masses[k], "inertia": self.inertias[k], "com": [0.0, 0.0],
                    "points": { "H": self.hooks[k], "C": [0.0, 0.0] } })
        };
        let initial = |k: usize| {
            let at = |axis: usize| self.places[k][axis] - MEETING * self.velocities[k][axis];
            json!({ "x": at(0), "y": at(1), "angle": self.angles[k] - MEETING * self.omegas[k],
                    "vx": self.velocities[k][0], "vy": self.velocities[k][1],
                    "angular_velocity": self.omegas[k] })
        };
        let pose = |k: usize| json!({ "position": self.places[k], "angle": self.angles[k] });
        let mut bodies = json!({ "one": body(0), "two": body(1) });
        (bodies["one"]["pose"], bodies["two"]["pose"]) = (pose(0), pose(1));
        let mut model = model(bodies, json!({ "hook": joint }), json!({}));
        model["gravity"] = json!([0.0, 0.0]);
        model["initial"] = json!({ "one": initial(0), "two": initial(1) });
        model["analysis"] =
            json!({ "type": "dynamics", "end": 1.0, "outputs": 21, "solver": { "rtol": 1e-12 } });
        model
    }

    /// ½ wᵀ W⁻¹ w of the rows that close: two of the hooks, and with `turns` the angle.
    fn lost(&self, turns: bool) -> f64 {
        let arms = [0, 1].map(|k| turned(self.hooks[k], self.angles[k]));
        let rate = |k: usize| {
            [
                self.velocities[k][0] - self.omegas[k] * arms[k][1],
                self.velocities[k][1] + self.omegas[k] * arms[k][0],
            ]
        };
        let (a, b) = (rate(0), rate(1));
        let w = [a[0] - b[0], a[1] - b[1], self.omegas[0] - self.omegas[1]];
        // Rows of J by body: the point's x and y, and the angle.
        let rows = |k: usize| {
            [
                [1.0, 0.0, -arms[k][1]],
                [0.0, 1.0, arms[k][0]],
                [0.0, 0.0, 1.0],
            ]
        };
        let count = if turns { 3 } else { 2 };
        let mut mobility = [[0.0; 3]; 3];
        for k in 0..2 {
            let inverse = [
                1.0 / self.masses[k],
                1.0 / self.masses[k],
                1.0 / self.inertias[k],
            ];
            let rows = rows(k);
            for (i, row) in mobility.iter_mut().enumerate() {
                for (j, entry) in row.iter_mut().enumerate() {
                    *entry += (0..3)
                        .map(|c| rows[i][c] * inverse[c] * rows[j][c])
                        .sum::<f64>();
                }
            }
        }
        // Gauss without pivoting: W is positive definite.
        let mut p = w;
        for i in 0..count {
            for j in i + 1..count {
                let part = mobility[j][i] / mobility[i][i];
                let pivot = mobility[i];
                let entries = mobility[j].iter_mut().zip(pivot);
                entries.for_each(|(entry, own)| *entry -= part * own);
                p[j] -= part * p[i];
            }
        }
        for i in (0..count).rev() {
            for c in i + 1..count {
                p[i] -= mobility[i][c] * p[c];
            }
            p[i] /= mobility[i][i];
        }
        0.5 * (0..count).map(|k| p[k] * w[k]).sum::<f64>()
    }

    /// Momenta and kinetic energy in a row.
    fn sums(&self, run: &Outcome, k: usize) -> [f64; 4] {
        let mut sums = [0.0; 4];
        for (body, name) in ["one", "two"].iter().enumerate() {
            let of = |word: &str| column(run, &format!("{name}.{word}"))[k];
            let (m, j) = (self.masses[body], self.inertias[body]);
            let [x, y, vx, vy, omega] = ["x", "y", "vx", "vy", "omega"].map(of);
            let parts = [
                m * vx,
                m * vy,
                j * omega + m * (x * vy - y * vx),
                0.5 * (m * (vx * vx + vy * vy) + j * omega * omega),
            ];
            sums.iter_mut()
                .zip(parts)
                .for_each(|(sum, part)| *sum += part);
        }
        sums
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
    let run = completed(&model);
    let opened = times(&run, EventKind::Open);
    assert_eq!(opened.len(), 1);
    near(opened[0], 1.25, 1e-8);
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
