//! Profiles made of motions give these motions.

use super::*;
use linkdyn_engine::analysis::Outcome;

const BASE: f64 = 0.04;
const RISE: f64 = 0.012;
const BEGIN: f64 = 0.05;

const LAWS: [&str; 7] = [
    "cycloidal",
    "polynomial_3_4_5",
    "polynomial_4_5_6_7",
    "modified_sine",
    "modified_trapezoid",
    "trapezoidal_velocity",
    "s_curve",
];

/// A turn: rise, dwell, return, and what is left; over an angle or, at the speed of the cam, over a time.
fn segments(law: &str, rise: f64, key: &str, per: f64) -> Value {
    let spans = [130.0, 40.0, 150.0].map(|degrees: f64| degrees.to_radians() / per);
    let mut segments = json!([
        { "law": law, "rise": rise }, { "dwell": spans[1] }, { "law": law, "end": 0.0 }
    ]);
    segments[0][key] = json!(spans[0]);
    segments[2][key] = json!(spans[2]);
    segments
}

/// A second follower that a driver moves by the same law over time.
fn with_twin(model: &mut Value, law: &str, start: f64) {
    model["bodies"]["ground"]["points"]["W"] = json!([0.2, 0.0]);
    model["bodies"]["twin"] = json!({ "mass": 1.0, "inertia": 0.01, "com": [0.0, 0.0], "points": { "T": [0.0, 0.0] },
        "pose": { "position": [0.2, start] } });
    model["joints"]["w"] =
        json!({ "type": "prismatic", "between": ["ground.W", "twin.T"], "axis": [0.0, 1.0] });
    let mut parts = segments(law, RISE, "duration", OMEGA);
    parts[2]["end"] = json!(start);
    model["drivers"]["twin"] = json!({ "type": "translation", "joint": "w",
        "motion": { "type": "sequence", "start": start, "begin": BEGIN / OMEGA, "segments": parts } });
}

/// s, s′ and s″ of the twin at each row.
fn motion(run: &Outcome, start: f64) -> Vec<[f64; 3]> {
    let [y, vy, ay] = ["twin.y", "twin.vy", "twin.ay"].map(|name| column(run, name));
    let jets = y.iter().zip(&vy).zip(&ay);
    jets.map(|((y, vy), ay)| [y - start, vy / OMEGA, ay / (OMEGA * OMEGA)])
        .collect()
}

fn same(run: &Outcome) {
    for (own, twin, tolerance) in [
        ("follower.y", "twin.y", 1e-13),
        ("follower.vy", "twin.vy", 1e-12),
        ("follower.ay", "twin.ay", 1e-10),
    ] {
        let twin = column(run, twin);
        follows(run, own, tolerance, |_, k| twin[k]);
    }
}

fn profile(law: &str) -> Value {
    json!({ "type": "law", "base_radius": BASE, "begin": BEGIN, "segments": segments(law, RISE, "angle", 1.0) })
}

/// Rows beside the edges of segments, where accelerations may jump.
fn turn(model: &mut Value) {
    model["analysis"]["outputs"] = json!(48);
    model["analysis"]["end"] = json!(0.99 * TAU / OMEGA);
}

#[test]
fn a_flat_follower_moves_by_its_law() {
    for law in LAWS {
        let cam = json!({ "follower": "flat", "face": [1.0, 0.0], "profile": profile(law) });
        let mut model = sliding(cam, 0.0, 0.0);
        with_twin(&mut model, law, BASE);
        turn(&mut model);
        let run = completed(&model);
        same(&run);
        let jets = motion(&run, BASE);
        follows(&run, "joint.c.contact_x", 1e-12, |_, k| jets[k][1]);
        follows(&run, "joint.c.curvature", 1e-10, |_, k| {
            1.0 / (BASE + jets[k][0] + jets[k][2])
        });
    }
}

#[test]
fn a_roller_moves_by_its_law() {
    for law in LAWS {
        for offset in [0.0, 0.008, -0.012] {
            let mut profile = profile(law);
            profile["axis"] = json!([0.0, 1.0]);
            profile["offset"] = json!(offset);
            let cam = json!({ "follower": "roller", "roller_radius": ROLLER, "profile": profile });
            let mut model = sliding(cam, offset, 0.0);
            let pitch = BASE + ROLLER;
            let height = (pitch * pitch - offset * offset).sqrt();
            with_twin(&mut model, law, height);
            turn(&mut model);
            let run = completed(&model);
            same(&run);
            let jets = motion(&run, height);
            follows(&run, "joint.c.pressure_angle", 1e-9, |_, k| {
                ((jets[k][1] - offset) / (height + jets[k][0])).atan()
            });
            if offset == 0.0 {
                follows(&run, "joint.c.curvature", 1e-9, |_, k| {
                    let [s, s1, s2] = jets[k];
                    let p = pitch + s;
                    let radius = (p * p + s1 * s1).powf(1.5) / (p * p + 2.0 * s1 * s1 - p * s2);
                    1.0 / (radius - ROLLER)
                });
            }
        }
    }
}

#[test]
fn an_edge_moves_by_its_law_and_leans_with_its_frame() {
    for lean in [0.0_f64, 0.7] {
        let mut profile = profile("cycloidal");
        let (sin, cos) = (PI / 2.0 - lean).sin_cos();
        // the follower's frame leans against the guide's: its axis and the cam's angle are told in it
        profile["axis"] = json!([cos, sin]);
        profile["begin"] = json!(BEGIN - lean);
        let mut model = sliding(json!({ "follower": "knife", "profile": profile }), 0.0, 0.0);
        model["joints"]["g"]["angle"] = json!(lean);
        model["bodies"]["follower"]["pose"]["angle"] = json!(lean);
        with_twin(&mut model, "cycloidal", BASE);
        turn(&mut model);
        same(&completed(&model));
    }
}

/// An arm with its frame along it, from the pivot.
fn swinging(law: &str, angle: f64, rise: f64, start: f64) -> Value {
    let mut model = sliding(json!({}), 0.0, start);
    model["bodies"]["ground"]["points"]["P"] = json!([0.08, 0.06]);
    let toward = f64::atan2(-0.06, -0.08);
    model["bodies"]["follower"] = json!({ "mass": MASS, "inertia": 0.01, "com": [0.0, 0.0],
        "points": { "P": [0.0, 0.0], "T": [ARM, 0.0] },
        "pose": { "position": [0.08, 0.06], "angle": toward + angle + 0.02 } });
    model["joints"]["g"] = pin("ground.P", "follower.P");
    model["joints"]["c"] = json!({ "type": "cam", "between": ["cam.C", "follower.T"],
        "follower": "roller", "roller_radius": ROLLER,
        "profile": { "type": "swing", "arm": ARM, "distance": 0.1, "axis": [4.0, 3.0], "angle": angle, "begin": BEGIN,
                     "segments": segments(law, rise, "angle", 1.0) } });
    model
}

const ARM: f64 = 0.08;

#[test]
fn an_arm_swings_by_its_law() {
    let toward = f64::atan2(-0.06, -0.08);
    for law in LAWS {
        for (angle, rise) in [(0.55, 0.2), (-0.55, -0.2)] {
            let mut model = swinging(law, angle, rise, 0.0);
            // the law of time: RISE stands for the rise of the arm
            with_twin(&mut model, law, 0.0);
            turn(&mut model);
            let run = completed(&model);
            let part = rise / RISE;
            let jets = motion(&run, 0.0);
            let swung = |k: usize| angle + part * jets[k][0];
            let first = column(&run, "follower.angle")[0];
            let turns = ((first - toward - angle) / TAU).round() * TAU;
            follows(&run, "follower.angle", 1e-12, |_, k| {
                toward + swung(k) + turns
            });
            follows(&run, "follower.omega", 1e-11, |_, k| {
                part * jets[k][1] * OMEGA
            });
            follows(&run, "follower.alpha", 1e-9, |_, k| {
                part * jets[k][2] * OMEGA * OMEGA
            });
            follows(&run, "joint.c.pressure_angle", 1e-9, |_, k| {
                let (sin, cos) = swung(k).sin_cos();
                ((ARM * (part * jets[k][1] - 1.0) + 0.1 * cos) / (0.1 * sin)).atan()
            });
        }
    }
}

/// Turn after turn, and the other way round.
#[test]
fn laws_go_on_for_many_turns() {
    for turns in [25.0, -25.0] {
        let cam =
            json!({ "follower": "flat", "face": [1.0, 0.0], "profile": profile("modified_sine") });
        let mut model = sliding(cam, 0.0, 0.0);
        let once = completed(&model);
        model["drivers"]["motor"]["motion"]["velocity"] = json!(OMEGA * turns);
        // rows at the same places of the turn, one turn and a step apart
        model["analysis"]["outputs"] = json!(73);
        model["analysis"]["type"] = json!("kinematics");
        let many = completed(&model);
        let [few, all] = [&once, &many].map(|run| column(run, "follower.y"));
        for (k, y) in all.iter().enumerate() {
            let step = (25 * k) % 72;
            let place = if turns > 0.0 { step } else { (72 - step) % 72 };
            assert!(
                (y - few[place]).abs() < 1e-12,
                "{k}: {y} for {}",
                few[place]
            );
        }
    }
}
