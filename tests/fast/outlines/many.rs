//! Outlines of thousands of pieces.

use super::*;
use linkdyn_output::Status;

/// A disc on a wheel of so many straights, which turns under it.
fn wheel(pieces: u32, made: Value) -> Value {
    let place = |k: u32| {
        let angle = 2.0 * PI * f64::from(k % pieces) / f64::from(pieces);
        [angle.cos(), angle.sin()]
    };
    let outline: Vec<[f64; 2]> = (0..=pieces).map(place).collect();
    let mut model = disc([0.0, 1.0 + RADIUS], [0.0; 2], json!(outline), made, 0.01);
    let bodies = &mut model["bodies"];
    bodies["wheel"] =
        json!({ "mass": 1.0, "inertia": 1.0, "com": [0.0, 0.0], "points": { "O": [0.0, 0.0] } });
    model["joints"]["t"]["between"][0] = json!("wheel.O");
    model["joints"]["axle"] = pin("ground.O", "wheel.O");
    model["joints"]["guide"] =
        json!({ "type": "prismatic", "between": ["ground.O", "disc.C"], "axis": [0.0, 1.0] });
    model["drivers"] = json!({ "turn": { "type": "rotation", "body": "wheel",
        "motion": { "type": "constant_velocity", "start": 0.0, "velocity": 0.5 } } });
    model["analysis"]["outputs"] = json!(3);
    model["analysis"]["solver"] = json!({ "rtol": 1e-6 });
    model
}

/// Memory grows with the number of pieces, and no faster: a few kilobytes each.
#[test]
fn an_outline_takes_memory_by_its_pieces() {
    for made in [
        json!({ "restitution": 0.0 }),
        json!({ "stiffness": 1e6, "damping": 500.0 }),
    ] {
        let bytes = [500, 2000].map(|pieces| {
            let model = wheel(pieces, made.clone());
            let run = || {
                let run = completed(&model);
                assert_eq!(run.report.status, Status::Completed);
            };
            allocation_counter::measure(run).bytes_max
        });
        let each = (bytes[1] - bytes[0]) / 1500;
        assert!(each < 10_000, "{each} bytes for a piece");
        assert!(bytes[1] < 5 * bytes[0], "{bytes:?}");
    }
}

/// It rests on one straight after the other, over the corners between, all in one touch; every corner is passed where round-off of the
/// position could have left the tip on either side.
#[test]
fn a_wheel_of_many_straights_is_touched_once() {
    // Slower than where it would fly off the corners, v² = g r.
    for speed in [0.5, 0.1] {
        let mut model = wheel(300, json!({ "restitution": 0.0 }));
        model["drivers"]["turn"]["motion"]["velocity"] = json!(speed);
        model["analysis"]["end"] = json!(0.6 / speed);
        let run = completed(&model);
        assert_eq!(run.report.status, Status::Completed);
        assert_eq!(run.report.stops[0].episodes, 1);
        near(run.report.stops[0].time_in_contact, 0.6 / speed, 1e-9);
    }
}
