//! Bearings that turn: where they wear, and how fast their journals slide.

use super::*;
use crate::mechanisms::{model, pin, rod};
use std::f64::consts::{FRAC_PI_2, TAU};

/// A disc lies at the bottom of a ring that turns beneath it: the bottom passes the ring's own angles −90° − θ, and over each
/// goes the same work, m g ω (R_b + δ/2) by time.
#[test]
fn a_bearing_wears_where_its_own_angle_passes_the_load() {
    const RADIUS: f64 = 0.05;
    const GRAVITY: f64 = 9.81;
    let (start, speed, end) = (0.2, 1.8, 0.5);
    let stiffness = 1e9;
    // m g = K δ^(3/2), of 1 kg
    let sunk = (GRAVITY / stiffness).powf(2.0 / 3.0);
    let mut json = journal(
        json!({ "law": "hertz", "stiffness": stiffness }),
        none(),
        json!({ "x": 0.0, "y": -0.01 - sunk, "vx": 0.0, "vy": 0.0 }),
        end,
        5,
        1e-9,
    );
    json["gravity"] = json!([0.0, -GRAVITY]);
    json["bodies"]["ring"] = json!({ "mass": 1.0, "inertia": 1e-2, "com": [0.0, 0.0], "points": { "C": [0.0, 0.0] },
                                     "pose": { "angle": start } });
    json["joints"]["hub"] = pin("ground.O", "ring.C");
    json["joints"]["pin"]["between"] = json!(["ring.C", "disc.P"]);
    json["drivers"] = json!({ "motor": { "type": "rotation", "body": "ring",
        "motion": { "type": "constant_velocity", "start": start, "velocity": speed } } });
    let outcome = completed(&json);
    let wear = &outcome.report.clearances[0].wear;
    let all = GRAVITY * speed * (RADIUS + 0.5 * sunk) * end;
    let bin = TAU / wear.len() as f64;
    let (low, high) = (-FRAC_PI_2 - start - speed * end, -FRAC_PI_2 - start);
    for (k, found) in wear.iter().enumerate() {
        // The bins count from 0 on.
        let from = k as f64 * bin - TAU;
        let share = ((from + bin).min(high) - from.max(low)).max(0.0) / (high - low);
        assert!(
            (found - all * share).abs() < 1e-7 * all,
            "bin {k}: {found} instead of {}",
            all * share
        );
    }
}

/// An ideal pin with radii slides by r ω₂ − R_b ω₁, whichever body bears it.
#[test]
fn an_ideal_pin_slides_by_the_turning_of_both_bodies() {
    let (radius, clearance) = (0.02, 0.003);
    let (own, other) = (1.7, -2.9);
    for reversed in [false, true] {
        let bodies = json!({ "ground": { "points": { "O": [0.0, 0.0] } },
            "arm": rod(0.3, [0.0, 0.0], 0.4),
            "wheel": { "mass": 1.0, "inertia": 0.01, "com": [0.0, 0.0], "points": { "C": [0.0, 0.0] },
                       "pose": { "position": [0.3 * 0.4_f64.cos(), 0.3 * 0.4_f64.sin()] } } });
        let mut ends = ["arm.B", "wheel.C"];
        if reversed {
            ends.reverse();
        }
        let mut joints = json!({ "o": pin("ground.O", "arm.A"), "p": pin(ends[0], ends[1]) });
        joints["p"]["clearance"] =
            json!({ "model": "ideal", "radius": clearance, "bearing_radius": radius });
        let turns = |body: &str, start: f64, speed: f64| {
            json!({ "type": "rotation", "body": body,
                "motion": { "type": "constant_velocity", "start": start, "velocity": speed } })
        };
        let drivers = json!({ "a": turns("arm", 0.4, own), "w": turns("wheel", 0.0, other) });
        let outcome = completed(&model(bodies, joints, drivers));
        let (bearing, inner) = if reversed { (other, own) } else { (own, other) };
        let known = (radius - clearance) * inner - radius * bearing;
        for found in column(&outcome, "joint.p.sliding_speed") {
            assert!((found - known).abs() < 1e-15, "{found} instead of {known}");
        }
    }
}
