//! What acts for only a part of a long step: bodies that fly past stops, kinks and windows of formulas, and walls. Nothing of it is
//! missed, whatever the tolerance, against closed forms; where there are none, against steps of a thousandth of the run.
//!
//! `LINKDYN_FLY_BYS=2000 cargo test --release --test fast fly_bys::` tries more.

mod walls;

use crate::linkage::Random;
use crate::mechanisms::{column, outcome};
use linkdyn_engine::analysis::Outcome;
use linkdyn_output::{EventKind, Status};
use serde_json::{Value, json};
use std::f64::consts::{PI, TAU};

/// How many of each of the kinds are tried.
fn tries() -> u64 {
    let told = std::env::var("LINKDYN_FLY_BYS").ok();
    told.and_then(|told| told.parse::<u64>().ok())
        .unwrap_or(200)
        / 5
}

impl Random {
    /// Between two numbers.
    fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * 0.5 * (1.0 + self.signed())
    }

    /// A relative tolerance as somebody may ask for.
    fn tolerance(&mut self) -> f64 {
        10f64.powf(self.within(-10.0, -3.0))
    }
}

/// A body of 1 kg and 1 kg·m² with its motion at the start.
fn body(place: [f64; 2], speed: [f64; 2], spin: f64) -> Value {
    json!({ "format": "linkdyn/1", "units": "SI", "gravity": [0.0, 0.0],
        "bodies": { "ground": { "points": { "O": [0.0, 0.0] } },
            "b": { "mass": 1.0, "inertia": 1.0, "com": [0.0, 0.0], "points": { "P": [0.0, 0.0] }, "pose": { "position": place } } },
        "initial": { "b": { "x": place[0], "y": place[1], "angle": 0.0, "vx": speed[0], "vy": speed[1], "angular_velocity": spin } } })
}

fn with(mut model: Value, part: &str, value: Value) -> Value {
    model[part] = value;
    model
}

fn run(model: Value, end: f64, solver: Value) -> Outcome {
    let analysis = json!({ "type": "dynamics", "end": end, "outputs": 13, "solver": solver });
    let model = with(model, "analysis", analysis);
    let run = outcome(&model);
    let message = run.report.message.as_deref();
    assert_eq!(run.report.status, Status::Completed, "{message:?}: {model}");
    run
}

fn last(run: &Outcome, name: &str) -> f64 {
    *column(run, name).last().expect("rows")
}

/// Times at which contacts began.
fn touches(run: &Outcome) -> Vec<f64> {
    let kinds = [EventKind::Contact, EventKind::SustainedContact];
    let events = run.report.events.iter();
    let touches = events.filter(|event| kinds.contains(&event.kind));
    touches.map(|event| event.time).collect()
}

/// A body that flies past the ground's point O at a distance b, in some direction, from `ahead` before it for 2 ahead/v.
struct Past {
    place: [f64; 2],
    speed: [f64; 2],
    end: f64,
    /// Where it is nearest to O.
    nearest: f64,
}

impl Past {
    fn random(random: &mut Random, nearest: f64) -> Self {
        let (ahead, speed, turn) = (
            random.within(2.0, 8.0),
            random.within(0.3, 3.0),
            PI * random.signed(),
        );
        let (sin, cos) = turn.sin_cos();
        Past {
            place: [-ahead * cos - nearest * sin, -ahead * sin + nearest * cos],
            speed: [speed * cos, speed * sin],
            end: 2.0 * ahead / speed,
            nearest,
        }
    }

    fn model(&self, force: Value) -> Value {
        with(
            body(self.place, self.speed, 0.0),
            "forces",
            json!({ "f": force }),
        )
    }

    /// When it comes as near as this, and where and how fast it is at the end if it rebounds there, by e.
    fn rebound(&self, limit: f64, e: f64) -> Option<(f64, [f64; 2])> {
        let [p, v] = [self.place, self.speed];
        let square = v[0] * v[0] + v[1] * v[1];
        let half = limit * limit - self.nearest * self.nearest;
        let time = -(p[0] * v[0] + p[1] * v[1]) / square - (half / square).sqrt();
        let at = [0, 1].map(|k| p[k] + time * v[k]);
        let normal = at.map(|x| x / limit);
        let approach = normal[0] * v[0] + normal[1] * v[1];
        let left = [0, 1].map(|k| v[k] - (1.0 + e) * approach * normal[k]);
        (half > 0.0).then(|| (time, [0, 1].map(|k| at[k] + (self.end - time) * left[k])))
    }
}

#[test]
fn a_rigid_stop_is_never_flown_through() {
    let mut random = Random(11);
    for _ in 0..tries() {
        let limit = random.within(0.05, 0.5);
        let (nearest, e) = (limit * random.within(0.0, 1.3), random.within(0.0, 1.0));
        let past = Past::random(&mut random, nearest);
        let stroke = json!({ "type": "actuator", "between": ["ground.O", "b.P"], "force": 0.0, "limits": [limit, null], "restitution": e });
        let rtol = random.tolerance();
        let run = run(past.model(stroke), past.end, json!({ "rtol": rtol }));
        let found = touches(&run);
        let Some((time, place)) = past.rebound(limit, e) else {
            assert_eq!(found, [0.0; 0]);
            continue;
        };
        assert_eq!(
            found.len(),
            1,
            "{nearest} of {limit}, rtol {rtol:e}: {found:?}"
        );
        assert!(
            (found[0] - time).abs() < 1e-8 * past.end,
            "{found:?} for {time}"
        );
        for (name, place) in ["b.x", "b.y"].into_iter().zip(place) {
            assert!(
                (last(&run, name) - place).abs() < 1e-5,
                "{} for {place}",
                last(&run, name)
            );
        }
    }
}

/// The same where steps of a thousandth of the run tell what is right.
fn agrees(model: &Value, end: f64, rtol: f64) {
    let fine = json!({ "rtol": 1e-10, "max_step": 1e-3 * end });
    let fine = run(model.clone(), end, fine);
    let found = run(model.clone(), end, json!({ "rtol": rtol }));
    assert_eq!(touches(&found).len(), touches(&fine).len(), "rtol {rtol:e}");
    for name in ["b.x", "b.y"] {
        let (found, fine) = (last(&found, name), last(&fine, name));
        let size = 1.0 + fine.abs();
        assert!(
            (found - fine).abs() < (1e-6 + 50.0 * rtol) * size,
            "{name} {found} for {fine}, rtol {rtol:e}: {model}"
        );
    }
}

/// Bodies that fly past what pushes them back, an actuator for a limit [m] and a stiffness [N/m].
fn flies_past(seed: u64, push: impl Fn(f64, f64) -> Value) {
    let mut random = Random(seed);
    for _ in 0..tries() {
        let limit = random.within(0.05, 0.5);
        let past = Past::random_past(&mut random, limit);
        let push = push(limit, random.within(20.0, 2000.0));
        agrees(&past.model(push), past.end, random.tolerance());
    }
}

#[test]
fn a_yielding_stop_is_never_flown_through() {
    flies_past(12, |limit, stiffness| {
        json!({ "type": "actuator", "between": ["ground.O", "b.P"], "force": 0.0,
                "limits": [limit, null], "stop_stiffness": stiffness })
    });
}

#[test]
fn a_kink_of_a_formula_is_never_flown_past() {
    flies_past(13, |limit, stiffness| {
        let force = format!("={stiffness} N/m*max(0 m, {limit} m - force.f.length)");
        json!({ "type": "actuator", "between": ["ground.O", "b.P"], "force": force })
    });
}

impl Past {
    /// One that comes nearer than a limit, by a twentieth of it or more.
    fn random_past(random: &mut Random, limit: f64) -> Self {
        let nearest = limit * random.within(0.1, 0.95);
        Past::random(random, nearest)
    }
}

/// A rotor with a torque in windows of its angle: ω² grows by 2 T/I times the angle within them.
#[test]
fn windows_of_an_angle_are_never_passed() {
    let mut random = Random(14);
    for round in 0..tries() {
        let (spin, rtol) = (random.within(0.5, 3.0), random.tolerance());
        let end = random.within(5.0, 12.0);
        let from = random.within(0.3, 0.7) * spin * end;
        let (wide, formula, inside): (_, _, Box<dyn Fn(f64) -> f64>) = match round % 3 {
            0 => {
                let wide = spin * end * 10f64.powf(random.within(-6.0, -1.5));
                let torque = 0.3 * spin * spin / wide;
                let formula = format!(
                    "={torque} N*m*step(b.angle - {from} rad)*step({} rad - b.angle)",
                    from + wide
                );
                (
                    torque,
                    formula,
                    Box::new(move |angle: f64| (angle - from).clamp(0.0, wide)),
                )
            }
            1 => {
                let wide = spin * end * 10f64.powf(random.within(-6.0, -1.5));
                let torque = 0.3 * spin * spin / wide;
                let formula = format!(
                    "={torque} N*m*step({} rad - abs(b.angle - {from} rad))",
                    0.5 * wide
                );
                let begins = from - 0.5 * wide;
                (
                    torque,
                    formula,
                    Box::new(move |angle: f64| (angle - begins).clamp(0.0, wide)),
                )
            }
            _ => {
                let half = 10f64.powf(random.within(-3.0, -0.5));
                let torque = 0.1 * spin * spin / half;
                let formula = format!("={torque} N*m*step(sin(b.angle) - {})", half.cos());
                let inside = move |angle: f64| {
                    let turns = ((angle - 0.5 * PI) / TAU).round();
                    let within = (angle - 0.5 * PI - TAU * turns).clamp(-half, half) + half;
                    // The window before the first turn is not entered.
                    2.0 * half * turns + within
                };
                (torque, formula, Box::new(inside))
            }
        };
        let model = with(
            body([0.0; 2], [0.0; 2], spin),
            "joints",
            json!({ "j": { "type": "revolute", "between": ["ground.O", "b.P"] } }),
        );
        let model = with(
            model,
            "forces",
            json!({ "f": { "type": "torque", "body": "b", "value": formula } }),
        );
        let run = run(model, end, json!({ "rtol": rtol }));
        let (angle, omega) = (last(&run, "b.angle"), last(&run, "b.omega"));
        let expected = (spin * spin + 2.0 * wide * inside(angle)).sqrt();
        assert!(
            (omega - expected).abs() < (1e-7 + 20.0 * rtol) * expected,
            "{formula}: {omega} for {expected} at {angle}, rtol {rtol:e}"
        );
    }
}
