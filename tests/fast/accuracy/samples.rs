//! Random deviations, solved for without the engine, never leave what is certified.

use super::file;
use super::newton::{Gaps, Newton};
use super::told::{Random, Told, ask_outputs, parametric, spoil, tolerate};
use crate::models;
use linkdyn_model::{JointKind, Model};
use serde_json::Value;

/// Newton's own round-off, times how far a joint's gap carries an output [m or rad].
const ROUND_OFF: f64 = 1e-12;

/// What is tried: a model, a value of its driver, the size of all deviations.
pub struct Case {
    pub name: &'static str,
    pub at: f64,
    /// Of pins, plays, zones and drivers [m or rad].
    pub c: f64,
    /// Of all numbers of the geometry [m or rad]; 0: none.
    pub t: f64,
    /// Whether a bound is to be had for all outputs.
    pub is_certain: bool,
}

const fn case(name: &'static str, at: f64, c: f64, t: f64, is_certain: bool) -> Case {
    Case {
        name,
        at,
        c,
        t,
        is_certain,
    }
}

const DEGREE: f64 = std::f64::consts::PI / 180.0;

/// All cases.
pub const CASES: &[Case] = &[
    case("four-bar", 60.0 * DEGREE, 5e-5, 0.0, true),
    case("four-bar", 60.0 * DEGREE, 5e-4, 1e-4, true),
    case("slider-crank", 90.0 * DEGREE, 5e-5, 0.0, true),
    case("slider-crank", 75.0 * DEGREE, 2e-4, 0.0, true),
    case("whitworth", 10.0 * DEGREE, 1e-4, 0.0, true),
    case("quick-return", 10.0 * DEGREE, 1e-4, 0.0, true),
    case("scotch-yoke", 50.0 * DEGREE, 1e-4, 0.0, true),
    case("geared-five-bar", 70.0 * DEGREE, 1e-4, 0.0, true),
    case("watt-i-lock", 0.0, 1e-5, 0.0, true),
    case("watt-i-lock", 60.0 * DEGREE, 1e-5, 1e-6, true),
    case("watt-i-lock", 105.0 * DEGREE, 1e-5, 0.0, true),
    case("watt-i-lock", 114.0 * DEGREE, 1e-5, 0.0, true),
    case("watt-i-lock", 117.0 * DEGREE, 1e-5, 0.0, false),
];

/// What came of a case.
#[derive(Debug, Default)]
pub struct Tried {
    pub solved: usize,
    /// Largest deviation over the certified one, and over the worst found.
    pub certified: f64,
    pub found: f64,
    /// Outputs with a bound, of all.
    pub bounded: [usize; 2],
    pub beyond: Vec<String>,
}

fn read(name: &str) -> Model {
    if let Some(bundled) = linkdyn_model::bundled::find(name) {
        let loaded = linkdyn_model::load(bundled.text.as_bytes(), &[]).expect("legal");
        return loaded.model.into_model();
    }
    let path = file(&format!("validation/{name}/model.json"));
    let text = std::fs::read_to_string(path).expect("a model");
    models::load(&serde_json::from_str::<Value>(&text).expect("JSON"))
}

/// A point of a disc: of its rim, or anywhere.
fn disc(random: &mut Random, radius: f64) -> [f64; 2] {
    let angle = std::f64::consts::PI * random.both();
    let part = if random.next() < 0.5 {
        1.0
    } else {
        random.next().sqrt()
    };
    [radius * part * angle.cos(), radius * part * angle.sin()]
}

fn side(random: &mut Random) -> f64 {
    if random.next() < 0.5 {
        random.both().signum()
    } else {
        random.both()
    }
}

/// Gaps that a model's own words allow.
fn gaps(model: &Model, pitch: &[f64], random: &mut Random) -> Gaps {
    let joints = model
        .joints
        .values()
        .zip(pitch)
        .map(|(joint, pitch)| match &joint.kind {
            JointKind::Revolute { clearance, .. } => {
                let limits = clearance.as_ref().and_then(|own| own.limits());
                disc(random, limits.map_or(0.0, |limits| limits[1]))
            }
            JointKind::Prismatic {
                play, guide_length, ..
            } => {
                let most = play.as_ref().map_or(0.0, |play| play.most);
                let part = random.next();
                let turn = guide_length.map_or(0.0, |length| 2.0 * most * (1.0 - part) / length);
                [most * part * side(random), turn * side(random)]
            }
            JointKind::Slot { play, .. } => [
                play.as_ref().map_or(0.0, |play| play.most) * side(random),
                0.0,
            ],
            JointKind::Gear { backlash, .. } => {
                [0.5 * backlash.unwrap_or(0.0) / pitch * side(random), 0.0]
            }
            JointKind::Fixed { .. } => [0.0; 2],
        });
    let joints = joints.collect();
    let drivers = model.drivers.values();
    let drivers = drivers.map(|driver| driver.tolerance.unwrap_or(0.0) * side(random));
    Gaps {
        joints,
        drivers: drivers.collect(),
    }
}

/// Radii of the second wheels of gears; 1 of other joints.
fn pitch(model: &Model) -> Vec<f64> {
    model
        .joints
        .values()
        .map(|joint| match &joint.kind {
            // The gears here have equal wheels, whose centres are on the ground.
            JointKind::Gear { ratio, .. } => {
                let at = |k: usize| {
                    let end = &joint.between[k];
                    let pose = model.bodies[&end.body].pose.position;
                    let own = model.bodies[&end.body].points[&end.point];
                    assert_eq!(own, [0.0, 0.0]);
                    pose
                };
                let ([a, b], [c, d]) = (at(0), at(1));
                (a - c).hypot(b - d) / (1.0 - ratio)
            }
            JointKind::Revolute { .. }
            | JointKind::Prismatic { .. }
            | JointKind::Slot { .. }
            | JointKind::Fixed { .. } => 1.0,
        })
        .collect()
}

/// The model with its parameters at corners, and its points anywhere in their zones.
fn deviated(case: &Case, told: &Told, random: &mut Random) -> Model {
    let mut off = told.loaded.model.clone().into_model();
    if case.t > 0.0 {
        let by = told.loaded.parameters.iter().map(|parameter| {
            let tolerance = parameter.tolerance.as_ref().expect("a tolerance");
            let value = if random.next() < 0.5 {
                tolerance.lower
            } else {
                tolerance.upper
            };
            (parameter.name.as_str(), value)
        });
        let by: Vec<(&str, f64)> = by.collect();
        off = told
            .loaded
            .source
            .with_deviations(&by)
            .expect("legal")
            .into_model();
    }
    for body in off.bodies.values_mut() {
        for (name, diameter) in &body.point_tolerances {
            let [x, y] = disc(random, 0.5 * diameter);
            let point = body.points.get_mut(name).expect("a point");
            *point = [point[0] + x, point[1] + y];
        }
    }
    off
}

/// Tries random deviations of a case.
pub fn sample(case: &Case, tries: usize, random: &mut Random) -> Tried {
    let model = read(case.name);
    let mut json = parametric(&model, 5);
    ask_outputs(&mut json, &model, Some(case.at));
    spoil(&mut json, case.c);
    if case.t > 0.0 {
        tolerate(&mut json, case.t);
    }
    let told = Told::read(&json).unwrap_or_else(|said| panic!("{}: {said}", case.name));
    let found = told.answer();
    let accuracy = told.loaded.model.accuracy.as_ref().expect("outputs");
    let start = &found.outputs[0].poses[0].position;
    let drive = &found.outputs[0].poses[0].drivers;
    let pitch = pitch(&model);
    let mut tried = Tried::default();
    for output in &found.outputs {
        tried.bounded[0] += usize::from(output.poses[0].certified.is_some());
        tried.bounded[1] += 1;
    }
    for _ in 0..tries {
        let off = deviated(case, &told, random);
        let gaps = gaps(&off, &pitch, random);
        let newton = Newton::new(&off, start);
        let Some(q) = newton.solve(drive, &gaps, start) else {
            continue;
        };
        tried.solved += 1;
        for output in &found.outputs {
            let pose = &output.poses[0];
            let Some([low, high]) = pose.certified else {
                continue;
            };
            let y = newton.value(&accuracy.outputs[&output.name].of, &q) - pose.nominal;
            let most = if y < 0.0 { low } else { high };
            if y < low - ROUND_OFF || y > high + ROUND_OFF {
                let what = format!(
                    "{} at {}: {}: {y:e} in {low:e} … {high:e}",
                    case.name, case.at, output.of
                );
                tried.beyond.push(what);
            }
            if y.abs() > 1e-9 {
                tried.certified = tried.certified.max(y / most);
                let found = pose.found[usize::from(y > 0.0)];
                tried.found = tried.found.max(found.map_or(0.0, |found| y / found));
            }
        }
    }
    tried
}

#[test]
fn random_deviations_stay_within_what_is_certified() {
    let mut random = Random(3);
    let mut beyond = Vec::new();
    for case in CASES {
        let tried = sample(case, 100, &mut random);
        println!(
            "{} at {:.4}, c {:e}, t {:e}: {} solved, bounds {:?}, {:.4} of certified, {:.4} of found",
            case.name,
            case.at,
            case.c,
            case.t,
            tried.solved,
            tried.bounded,
            tried.certified,
            tried.found
        );
        beyond.extend(tried.beyond);
        if case.is_certain {
            assert_eq!(tried.solved, 100, "{} at {}", case.name, case.at);
            assert_eq!(
                tried.bounded[0], tried.bounded[1],
                "{} at {}",
                case.name, case.at
            );
            // Some of them come near, or nothing was tried.
            assert!(tried.certified > 0.2, "{}: {}", case.name, tried.certified);
            // Of several stationary positions one was found; they differ by the square of the deviations.
            let square = (case.c + case.t) / 0.1;
            assert!(
                tried.found <= 1.0 + square,
                "{}: {}",
                case.name,
                tried.found
            );
        }
    }
    assert!(beyond.is_empty(), "{}", beyond.join("\n"));
}
