//! Tips that touch outlines, against closed forms.
//!
//! ```text
//! a disc that rolls on a slope α      a = g sin α/(1 + I/m r²)          while tan α ≤ μ (1 + m r²/I)
//! a tip that slides over a corner     leaves at cos θ = 2/3 + v²/3gr
//! Geneva drive, λ = sin(π/n)          ω/ω₁ = λ (cos β − λ)/D,   α/ω₁² = −λ (1 − λ²) sin β/D²,   D = 1 − 2 λ cos β + λ²
//! ```
//!
//! (Geneva drive: J. H. Bickford, *Mechanisms for Intermittent Motion*, 1972, ch. 9.)

mod corners;
mod leaning;
mod many;
mod resting;
mod seams;
mod senses;
mod words;

use crate::mechanisms::{column, completed, model, near, pin};
use linkdyn_engine::analysis::Outcome;
use linkdyn_output::EventKind;
use serde_json::{Value, json};
use std::f64::consts::PI;

const GRAVITY: f64 = 9.81;
const RADIUS: f64 = 0.1;
const INERTIA: f64 = 0.004;

/// A disc of 1 kg over an outline of the ground.
fn disc(place: [f64; 2], speed: [f64; 2], outline: Value, more: Value, end: f64) -> Value {
    let bodies = json!({ "ground": { "points": { "O": [0.0, 0.0] } },
        "disc": { "mass": 1.0, "inertia": INERTIA, "com": [0.0, 0.0], "points": { "C": [0.0, 0.0] }, "pose": { "position": place } } });
    let mut touch = json!({ "type": "contact", "between": ["ground.O", "disc.C"], "outline": outline, "radius": RADIUS });
    join(&mut touch, more);
    let mut model = model(bodies, json!({ "t": touch }), json!({}));
    model["gravity"] = json!([0.0, -GRAVITY]);
    model["initial"] =
        json!({ "disc": { "x": place[0], "y": place[1], "vx": speed[0], "vy": speed[1] } });
    model["analysis"] =
        json!({ "type": "dynamics", "end": end, "outputs": 21, "solver": { "rtol": 1e-9 } });
    model
}

fn join(to: &mut Value, more: Value) {
    if let (Value::Object(to), Value::Object(more)) = (to, more) {
        to.extend(more);
    }
}

fn floor() -> Value {
    json!([[5.0, 0.0], [-5.0, 0.0]])
}

fn last(run: &Outcome, name: &str) -> f64 {
    *column(run, name).last().expect("rows")
}

#[test]
fn a_disc_bounces_on_a_floor_until_it_rests() {
    let run = completed(&disc(
        [0.0, 1.1],
        [0.0; 2],
        floor(),
        json!({ "restitution": 0.5 }),
        2.0,
    ));
    let first = (2.0 / GRAVITY).sqrt();
    let events = &run.report.events;
    near(events[0].time, first, 1e-9 * first);
    near(events[1].time, 2.0 * first, 1e-9 * first);
    let rests = events
        .iter()
        .find(|event| event.kind == EventKind::SustainedContact);
    near(rests.expect("it rests").time, 3.0 * first, 1e-9 * first);
    near(last(&run, "joint.t.fy"), GRAVITY, 1e-9);
    near(last(&run, "joint.t.normal_force"), GRAVITY, 1e-9);
    let stops = &run.report.stops;
    assert_eq!((stops.len(), stops[0].stop), (1, "contact"));
    near(stops[0].energy_lost, GRAVITY, 1e-9);
}

/// On a slope it rolls where friction is enough, and slides where it is not.
#[test]
fn a_disc_rolls_or_slides_on_a_slope() {
    let slope = 20f64.to_radians();
    let friction = |mu: f64| json!({ "friction": { "law": "coulomb", "coefficient": mu, "threshold_velocity": 1e-3 } });
    for (mu, a, alpha) in [
        (0.2, slope.sin() / 1.4, slope.sin() / 1.4 / RADIUS),
        (
            0.05,
            slope.sin() - 0.05 * slope.cos(),
            0.05 * slope.cos() * RADIUS / INERTIA,
        ),
    ] {
        let mut model = disc([0.0, RADIUS], [0.0; 2], floor(), friction(mu), 1.0);
        model["gravity"] = json!([GRAVITY * slope.sin(), -GRAVITY * slope.cos()]);
        let run = completed(&model);
        near(last(&run, "disc.x"), 0.5 * GRAVITY * a, 1e-9);
        near(last(&run, "disc.omega"), -GRAVITY * alpha, 1e-9);
        near(
            run.report.quality.energy_imbalance.expect("a ledger"),
            0.0,
            1e-12,
        );
    }
}

/// From a flat into a hollow and back, whatever the piece: it rolls, and the energy tells the speed.
#[test]
fn a_disc_rolls_through_a_hollow() {
    let hollow = json!([[1.0, 1.0], [0.0, 0.0, -1.0], [-3.0, 0.0]]);
    let friction =
        json!({ "friction": { "law": "coulomb", "coefficient": 2.0, "threshold_velocity": 1e-3 } });
    let mut model = disc([-0.5, RADIUS], [2.0, 0.0], hollow, friction, 1.6);
    model["initial"]["disc"]["angular_velocity"] = json!(-2.0 / RADIUS);
    let run = completed(&model);
    let (x, y) = (column(&run, "disc.x"), column(&run, "disc.y"));
    let (vx, vy) = (column(&run, "disc.vx"), column(&run, "disc.vy"));
    assert!(y.iter().any(|y| *y > 0.3));
    assert!(vx.last() < Some(&0.0) && x.last() < Some(&-0.1));
    for k in 0..y.len() {
        let height = y[k] - RADIUS;
        let square = vx[k] * vx[k] + vy[k] * vy[k];
        near(square, 4.0 - 2.0 * GRAVITY * height / 1.4, 1e-7);
        let expected = match x[k] > 0.0 {
            true => 1.0 - (0.81 - x[k] * x[k]).sqrt(),
            false => RADIUS,
        };
        near(y[k], expected, 1e-9);
    }
}

/// Over a corner of its floor it goes round, until it falls.
#[test]
fn a_disc_leaves_a_corner() {
    let speed = 0.3;
    let table = json!([[0.0, -2.0], [0.0, 0.0], [-5.0, 0.0]]);
    let run = completed(&disc([-0.15, RADIUS], [speed, 0.0], table, json!({}), 1.2));
    let leaves = 2.0 / 3.0 + speed * speed / (3.0 * GRAVITY * RADIUS);
    let ends: Vec<f64> = run
        .report
        .events
        .iter()
        .filter_map(|event| event.end_time)
        .collect();
    // Flat and corner are one touch.
    assert_eq!(ends.len(), 1);
    // From there on it falls.
    let mut model = disc(
        [-0.15, RADIUS],
        [speed, 0.0],
        json!([[0.0, -2.0], [0.0, 0.0], [-5.0, 0.0]]),
        json!({}),
        ends[0],
    );
    model["analysis"]["outputs"] = json!(2);
    let run = completed(&model);
    near(last(&run, "disc.y") / RADIUS, leaves, 1e-7);
    near(
        last(&run, "disc.x") / RADIUS,
        (1.0 - leaves * leaves).sqrt(),
        1e-7,
    );
}

/// Tips that yield: at rest, and about it.
#[test]
fn a_disc_swings_on_a_floor_that_yields() {
    let stiffness = 4000.0;
    let mut model = disc(
        [0.0, RADIUS],
        [0.0; 2],
        floor(),
        json!({ "stiffness": stiffness }),
        1.0,
    );
    let swings = completed(&model);
    // Let go where it touches, it swings about the place at which it would rest.
    let (sag, omega) = (GRAVITY / stiffness, stiffness.sqrt());
    for (t, y) in column(&swings, "time")
        .into_iter()
        .zip(column(&swings, "disc.y"))
    {
        near(y, RADIUS - sag * (1.0 - (omega * t).cos()), 1e-9);
    }
    let object = model.as_object_mut().expect("an object");
    object.remove("initial");
    model["joints"]["g"] =
        json!({ "type": "prismatic", "between": ["ground.O", "disc.C"], "axis": [0.0, 1.0] });
    model["analysis"] = json!({ "type": "statics" });
    near(last(&completed(&model), "disc.y"), RADIUS - sag, 1e-12);
    model["joints"]["t"]["stiffness"] = Value::Null;
    model["joints"]["t"]
        .as_object_mut()
        .expect("an object")
        .remove("stiffness");
    let rests = completed(&model);
    near(last(&rests, "disc.y"), RADIUS, 1e-12);
    near(last(&rests, "joint.t.fy"), GRAVITY, 1e-9);
}

/// A spring pulls a tip far below a step: it rests on it, however deep the place is at which it would rest without.
#[test]
fn a_tip_rests_on_the_step_below_it() {
    let step = json!([
        [0.5, -1.0],
        [0.5, 0.0],
        [-0.5, 0.0],
        [-0.5, -1.0],
        [0.5, -1.0]
    ]);
    let mut model = disc([0.1, 0.4], [0.0; 2], step, json!({ "radius": 0.02 }), 1.0);
    model.as_object_mut().expect("an object").remove("initial");
    model["bodies"]["ground"]["points"]["D"] = json!([0.1, -0.7]);
    model["joints"]["g"] =
        json!({ "type": "prismatic", "between": ["ground.O", "disc.C"], "axis": [0.0, 1.0] });
    model["bodies"]["ground"]["points"]["O"] = json!([0.1, 0.0]);
    model["forces"] = json!({ "s": { "type": "spring", "between": ["ground.D", "disc.C"], "stiffness": 50.0, "free_length": 0.1 } });
    model["analysis"] = json!({ "type": "statics" });
    let rests = completed(&model);
    near(last(&rests, "disc.y"), 0.02, 1e-12);
    near(last(&rests, "joint.t.fy"), GRAVITY + 50.0 * 0.62, 1e-8);
}

/// A Geneva drive whose pin fits its slots without clearance: crank and wheel 0.1 m apart, the crank at a constant speed.
fn geneva(slots: usize, turns: f64) -> Value {
    let (apart, pin_radius) = (0.1, 0.005);
    let share = PI / slots as f64;
    let (crank, mouth) = (apart * share.sin(), apart * share.cos());
    let bottom = apart - crank - 0.008;
    let start = -1.4 * (0.5 * PI - share);
    let bodies = json!({ "ground": { "points": { "O": [0.0, 0.0], "W": [apart, 0.0] } },
        "crank": { "mass": 0.1, "inertia": 1e-5, "com": [0.0, 0.0], "points": { "O": [0.0, 0.0], "P": [crank, 0.0] },
                   "pose": { "angle": start } },
        "wheel": { "mass": 0.5, "inertia": 5e-4, "com": [0.0, 0.0], "points": { "W": [0.0, 0.0] },
                   "pose": { "position": [apart, 0.0], "angle": PI - share } } });
    // To where the next slot begins.
    let (sin, cos) = (2.0 * share).sin_cos();
    let next = [
        cos * mouth + sin * pin_radius,
        sin * mouth - cos * pin_radius,
    ];
    let outline = json!([
        [mouth, -pin_radius],
        [bottom, -pin_radius],
        [bottom, pin_radius],
        [mouth, pin_radius],
        next
    ]);
    let joints = json!({ "o": pin("ground.O", "crank.O"), "w": pin("ground.W", "wheel.W"),
        "p": { "type": "contact", "between": ["wheel.W", "crank.P"], "outline": outline, "repeat": slots, "radius": pin_radius } });
    let drivers = json!({ "motor": { "type": "rotation", "body": "crank",
        "motion": { "type": "constant_velocity", "start": start, "velocity": 1.0 } } });
    let mut model = model(bodies, joints, drivers);
    model["analysis"] = json!({ "type": "dynamics", "end": 2.0 * PI * turns, "outputs": 121, "solver": { "rtol": 1e-9 } });
    model
}

#[test]
fn a_geneva_wheel_is_what_its_closed_form_says() {
    for slots in [4, 6] {
        let mut model = geneva(slots, 0.5);
        model["analysis"]["extremes"] = json!(true);
        model["analysis"]
            .as_object_mut()
            .expect("an object")
            .remove("extremes");
        let run = completed(&model);
        let lambda = (PI / slots as f64).sin();
        let half = 0.5 * PI - PI / slots as f64;
        let (beta, omega) = (column(&run, "crank.angle"), column(&run, "wheel.omega"));
        let (alpha, angle) = (column(&run, "wheel.alpha"), column(&run, "wheel.angle"));
        let mut met = 0;
        for k in 0..beta.len() {
            let d = 1.0 - 2.0 * lambda * beta[k].cos() + lambda * lambda;
            if beta[k].abs() < half - 1e-6 {
                near(omega[k], -lambda * (beta[k].cos() - lambda) / d, 1e-12);
                near(
                    alpha[k],
                    lambda * (1.0 - lambda * lambda) * beta[k].sin() / (d * d),
                    1e-11,
                );
                let turned = (lambda * beta[k].sin()).atan2(1.0 - lambda * beta[k].cos());
                near(angle[k], PI - turned - 2.0 * PI / slots as f64, 1e-12);
                met += 1;
            } else if beta[k] < -half {
                near(omega[k], 0.0, 1e-12);
            }
        }
        assert!(met > 30);
        let depths = column(&run, "joint.p.penetration");
        assert!(depths.iter().all(|depth| *depth < 1e-10));
    }
}

/// Peaks of four slots between the outputs: 2.414214 and 5.406981 at 11.46374°.
#[test]
fn a_geneva_wheel_has_its_peaks_where_they_are_known() {
    let run = completed(&geneva(4, 0.5));
    let curves = run.curves();
    let peak = |name: &str| {
        let values = curves.values(name).expect("a column").into_iter();
        values.fold(0.0, |most: f64, x| most.max(x.abs()))
    };
    near(peak("wheel.omega"), 2.414_213_562, 1e-8);
    near(peak("wheel.alpha"), 5.406_981_034, 1e-6);
}

/// Turn after turn it goes on by a quarter, and rests between.
#[test]
fn a_geneva_wheel_goes_on_turn_by_turn() {
    let run = completed(&geneva(4, 2.6));
    near(last(&run, "wheel.angle"), 0.75 * PI - 1.5 * PI, 1e-7);
}

/// A Geneva drive as a slot without end: the pin is within the points that draw it, and beyond them.
#[test]
fn a_pin_that_leaves_its_drawn_slot_is_warned_of() {
    let bodies = |mouth: f64| {
        json!({ "ground": { "points": { "A": [0.0, 0.0], "W": [0.1, 0.0] } },
            "crank": { "points": { "A": [0.0, 0.0], "P": [0.07, 0.0] } },
            "wheel": { "points": { "W": [0.0, 0.0], "mouth": [-mouth, 0.0] }, "pose": { "position": [0.1, 0.0] } } })
    };
    let warnings = |mouth: f64, limits: Value| {
        let mut slot =
            json!({ "type": "slot", "between": ["wheel.W", "crank.P"], "axis": [1.0, 0.0] });
        join(&mut slot, limits);
        let joints = json!({ "a": pin("ground.A", "crank.A"), "w": pin("ground.W", "wheel.W"), "slot": slot });
        let drivers = json!({ "m": { "type": "rotation", "body": "crank",
            "motion": { "type": "constant_velocity", "start": 0.0, "velocity": 2.0 * PI } } });
        let mut model = model(bodies(mouth), joints, drivers);
        model["analysis"] = json!({ "type": "kinematics", "end": 1.0, "outputs": 101 });
        completed(&model).report.warnings
    };
    let told = warnings(0.07, json!({}));
    assert_eq!(
        told,
        [
            "the pin of joint \"slot\" leaves its slot as the points of its body draw it, by 0.1 m at t = 0.5 s: a slot has no end of \
             its own; give it \"limits\", or let a joint of type \"contact\" set the pin free"
        ]
    );
    assert_eq!(warnings(0.18, json!({})), [""; 0]);
    let limited = warnings(0.07, json!({ "limits": [-0.07, 0.0] }));
    assert!(limited[0].contains("beyond its lower limit"), "{limited:?}");
}

/// A wheel that a motor drives through its outline: what is prescribed is warned of.
#[test]
fn a_motion_through_an_outline_is_warned_of() {
    let mut model = disc([0.0, 0.3], [0.0; 2], floor(), json!({}), 1.0);
    model.as_object_mut().expect("an object").remove("initial");
    model["joints"]["g"] =
        json!({ "type": "prismatic", "between": ["ground.O", "disc.C"], "axis": [0.0, 1.0] });
    model["drivers"] = json!({ "d": { "type": "translation", "joint": "g",
        "motion": { "type": "constant_velocity", "start": 0.3, "velocity": -0.205 } } });
    model["analysis"] = json!({ "type": "kinematics", "end": 1.0, "outputs": 11 });
    let run = completed(&model);
    let warnings = &run.report.warnings;
    assert_eq!(
        warnings,
        &[
            "the drivers take the tip of joint \"t\" into the outline, by 0.005 m at t = 1 s: a motion that is prescribed does not stop there"
        ]
    );
}
