//! Mechanisms from MJCF, URDF and SDF move as they do by closed forms and in MuJoCo, and models go to MJCF and back.

use std::f64::consts::{FRAC_PI_3, PI};

use linkdyn_engine::analysis::Outcome;
use linkdyn_exchange::{Draft, Format, Options, export, import};
use linkdyn_model::bundled;
use serde_json::{Value, json};

use crate::mechanisms::{column, completed, near};

type Vec2 = [f64; 2];

const FOUR_BAR: &str = include_str!("../cases/robots/four-bar.xml");
const MANY_JOINTS: &str = include_str!("../cases/robots/many-joints.xml");
const DOUBLE: &str = include_str!("../cases/robots/double-pendulum.xml");
const FIVE_BAR: &str = include_str!("../cases/robots/five-bar.urdf");
const SIX_BAR: &str = include_str!("../cases/robots/six-bar.sdf");

fn read(format: Format, text: &str) -> Draft {
    let read = import("", text.as_bytes(), Some(format), &Options::default());
    read.unwrap_or_else(|refused| panic!("{refused}")).draft
}

/// The run of a model that was read, with these points, drivers and analysis.
#[track_caller]
fn run(mut draft: Draft, points: &[&str], turned: &[(&str, f64)], analysis: Value) -> Outcome {
    draft.points = points.iter().map(ToString::to_string).collect();
    for (body, speed) in turned {
        let motion = json!({ "type": "constant_velocity", "start": 0, "velocity": format!("{speed} rad/s") });
        let driver = json!({ "type": "rotation", "body": body, "motion": motion });
        draft.drivers.insert(body.to_string(), driver);
    }
    draft.analysis = analysis.as_object().cloned().expect("an object");
    completed(&serde_json::from_str(&draft.text()).expect("JSON"))
}

fn turn([x, y]: Vec2, angle: f64) -> Vec2 {
    let (sin, cos) = angle.sin_cos();
    [cos * x - sin * y, sin * x + cos * y]
}

fn plus(a: Vec2, b: Vec2) -> Vec2 {
    [a[0] + b[0], a[1] + b[1]]
}

fn minus(a: Vec2, b: Vec2) -> Vec2 {
    [a[0] - b[0], a[1] - b[1]]
}

/// Where two bars of these lengths meet, on the left of the way from the first point to the second, or on the right.
fn meeting(a: Vec2, b: Vec2, lengths: Vec2, is_left: bool) -> Vec2 {
    let way = minus(b, a);
    let d = way[0].hypot(way[1]);
    let [p, q] = lengths;
    let cos = (d * d + p * p - q * q) / (2.0 * d * p);
    let angle = if is_left { cos.acos() } else { -cos.acos() };
    plus(a, turn(way, angle).map(|part| part * p / d))
}

fn length(a: Vec2, b: Vec2) -> f64 {
    let [x, y] = minus(b, a);
    x.hypot(y)
}

/// Whether c is on the left of the way from a to b.
fn is_left(a: Vec2, b: Vec2, c: Vec2) -> bool {
    let ([x, y], [u, v]) = (minus(b, a), minus(c, a));
    x * v - y * u > 0.0
}

#[track_caller]
fn path(outcome: &Outcome, point: &str, known: impl Fn(f64) -> Vec2) {
    let [x, y] = ["x", "y"].map(|part| column(outcome, &format!("{point}.{part}")));
    for (row, time) in column(outcome, "time").into_iter().enumerate() {
        let known = known(time);
        near(x[row], known[0], 1e-12);
        near(y[row], known[1], 1e-12);
    }
}

fn motion(end: f64) -> Value {
    json!({ "type": "kinematics", "end": end, "outputs": 41 })
}

#[test]
fn a_four_bar_of_mjcf_moves_by_its_closed_form() {
    let found = run(
        read(Format::Mjcf, FOUR_BAR),
        &["coupler.C", "coupler.trace"],
        &[("crank", PI)],
        motion(2.0),
    );
    let crank = |angle: f64| turn([0.1, 0.0], FRAC_PI_3 + angle);
    let (start, pivot) = (crank(0.0), [0.4, 0.0]);
    let end = plus(start, turn([0.35, 0.0], 25f64.to_radians()));
    let rocker = length(end, pivot);
    let side = is_left(start, pivot, end);
    let tip = |time: f64| meeting(crank(PI * time), pivot, [0.35, rocker], side);
    path(&found, "coupler.C", tip);
    path(&found, "coupler.trace", |time| {
        let (from, to) = (crank(PI * time), tip(time));
        let along = minus(to, from).map(|part| part / 0.35);
        plus(
            from,
            [
                0.2 * along[0] - 0.1 * along[1],
                0.2 * along[1] + 0.1 * along[0],
            ],
        )
    });
}

#[test]
fn a_five_bar_of_urdf_moves_by_its_closed_form() {
    let speeds = [-0.4, 0.3];
    let turned = [("left_crank", speeds[0]), ("right_crank", speeds[1])];
    let found = run(
        read(Format::Urdf, FIVE_BAR),
        &["left_rod.tip"],
        &turned,
        motion(1.0),
    );
    let elbows = |time: f64| {
        let left = turn([0.1, 0.0], 2.0 + speeds[0] * time);
        let right = plus([0.2, 0.0], turn([0.12, 0.0], 0.9 + speeds[1] * time));
        [left, right]
    };
    let [left, right] = elbows(0.0);
    let tip = plus(right, turn([0.2, 0.01], 0.9 + 1.5));
    let lengths = [length(left, tip), length(right, tip)];
    let side = is_left(left, right, tip);
    path(&found, "left_rod.tip", |time| {
        let [left, right] = elbows(time);
        meeting(left, right, lengths, side)
    });
}

#[test]
fn a_six_bar_of_sdf_moves_by_its_closed_form() {
    let found = run(
        read(Format::Sdf, SIX_BAR),
        &["coupler.C", "link.F"],
        &[("crank", -0.5)],
        motion(2.0),
    );
    let crank = |angle: f64| turn([0.1, 0.0], 1.0 + angle);
    let (d, g) = ([0.4, 0.0], [0.75, 0.05]);
    let c0 = plus(crank(0.0), turn([0.33, 0.0], 0.3));
    let e0 = plus(d, turn([0.15, -0.06], 1.8));
    let f0 = plus(g, turn([0.2, 0.02], 110f64.to_radians()));
    let sides = [is_left(crank(0.0), d, c0), is_left(e0, g, f0)];
    let c = |time: f64| meeting(crank(-0.5 * time), d, [0.33, length(c0, d)], sides[0]);
    path(&found, "coupler.C", c);
    let lengths = [length(e0, f0), length(g, f0)];
    path(&found, "link.F", |time| {
        let angle = |c: Vec2| (c[1] - d[1]).atan2(c[0] - d[0]);
        let e = plus(d, turn(minus(e0, d), angle(c(time)) - angle(c0)));
        meeting(e, g, lengths, sides[1])
    });
}

/// Centres of mass at the end of a free motion.
#[track_caller]
fn swings(text: &str, end: f64, known: &[(&str, Vec2)], tolerance: f64) {
    let draft = read(Format::Mjcf, text);
    let bodies = draft.bodies.clone();
    let solver = json!({ "rtol": 1e-11, "atol": 1e-12 });
    let analysis = json!({ "type": "dynamics", "end": end, "outputs": 2, "solver": solver });
    let found = run(draft, &[], &[], analysis);
    let last = |name: String| column(&found, &name).last().copied().expect("a row");
    for (body, place) in known {
        let com: Vec2 = serde_json::from_value(bodies[*body]["com"].clone()).expect("a com");
        let own = turn(com, last(format!("{body}.angle")));
        near(last(format!("{body}.x")) + own[0], place[0], tolerance);
        near(last(format!("{body}.y")) + own[1], place[1], tolerance);
    }
}

/// MuJoCo 4.0.0 with RK4 and steps of 0.1 ms; with 0.2 ms it differs by 1e-10.
#[test]
fn a_double_pendulum_swings_as_in_mujoco() {
    let known = [
        ("upper", [0.2751812867501133, 0.7615722874274108]),
        ("lower", [0.3983917891306321, 0.32873985668695405]),
    ];
    swings(DOUBLE, 2.0, &known, 1e-10);
}

/// The same of slides, slots, springs, a rope and an armature.
#[test]
fn many_joints_move_as_in_mujoco() {
    let known = [
        ("cart", [0.24993464539794044, 0.3]),
        ("pole", [0.33913372315429435, 0.6540541763628693]),
        ("free", [2.1, 0.6737500000000578]),
        ("block", [2.7928658229684995, -0.4534656945058473]),
        ("lever", [3.183894645066877, -1.0467584410394257]),
        ("two", [4.027740172520799, -0.23133680752626623]),
    ];
    swings(MANY_JOINTS, 0.5, &known, 1e-10);
}

/// Models in their own frames: all that has a counterpart in MJCF comes back, each point and mass where it was assembled.
#[test]
fn bundled_models_come_back_from_mjcf() {
    let mut count = 0;
    for bundled in bundled::MODELS {
        let mut file: Value = serde_json::from_str(bundled.text).expect("JSON");
        let keys = file.as_object_mut().expect("an object");
        keys.retain(|key, _| {
            let of_results = [
                "responses",
                "study",
                "optimise",
                "accuracy",
                "outputs",
                "points",
            ];
            !of_results.contains(&key.as_str())
        });
        file["analysis"] = json!({ "type": "assembly" });
        let found = completed(&file);
        let model = linkdyn_model::load(file.to_string().as_bytes(), &[]);
        let model = model.expect("it loads").model;
        let pose = |name: &str| {
            ["x", "y", "angle"].map(|part| match name {
                "ground" => 0.0,
                _ => column(&found, &format!("{name}.{part}"))[0],
            })
        };
        let poses: Vec<(String, [f64; 3])> = model
            .bodies
            .keys()
            .map(|name| (name.clone(), pose(name)))
            .collect();
        let Ok(exported) = export::mjcf(&model, &poses) else {
            continue;
        };
        count += 1;
        let back = read(Format::Mjcf, &exported.text);
        let place = |name: &str, own: Vec2| {
            let [x, y, angle] = pose(name);
            plus([x, y], turn(own, angle))
        };
        let size = model
            .bodies
            .iter()
            .flat_map(|(name, body)| body.points.values().map(move |at| (name, at)));
        let size = size
            .map(|(name, at)| length(place(name, *at), [0.0; 2]))
            .fold(0.0, f64::max);
        for (name, body) in &model.bodies {
            let other = &back.bodies[name];
            let check = |found: &Value, own: Vec2| {
                let (known, tolerance) = (place(name, own), 1e-11 * size);
                let found: Vec2 = serde_json::from_value(found.clone()).expect("numbers");
                (0..2).for_each(|k| near(found[k], known[k], tolerance));
            };
            body.points
                .iter()
                .for_each(|(point, at)| check(&other["points"][point], *at));
            if let (Some(mass), Some(com)) = (body.mass.filter(|mass| *mass > 0.0), body.com) {
                near(other["mass"].as_f64().expect("a mass"), mass, 1e-14 * mass);
                check(&other["com"], com);
            }
        }
    }
    assert_eq!(count, 27);
}
