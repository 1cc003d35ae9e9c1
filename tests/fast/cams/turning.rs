//! Cams whose follower is guided by a body that turns: all as on a fixed guide, by the angle against it, and turned with it.

use super::*;

/// Angle and speed of the guide.
const TURNED: f64 = 0.4;
const SPEED: f64 = -1.7;

/// The cam of [`sliding`] with its follower on a guide that turns about the cam's axis.
fn turning(cam: Value, start: f64) -> Value {
    let mut model = sliding(cam, 0.0, start);
    model["bodies"]["frame"] = json!({ "mass": 1.0, "inertia": 0.1, "com": [0.0, 0.0], "points": { "C": [0.0, 0.0] },
        "pose": { "angle": TURNED } });
    model["bodies"]["follower"]["pose"] =
        json!({ "position": [-0.06 * TURNED.sin(), 0.06 * TURNED.cos()], "angle": TURNED });
    model["joints"]["f"] = pin("ground.O", "frame.C");
    model["joints"]["g"]["between"] = json!(["frame.C", "follower.T"]);
    model["drivers"]["table"] = json!({ "type": "rotation", "body": "frame",
        "motion": { "type": "constant_velocity", "start": TURNED, "velocity": SPEED } });
    model["drivers"]["motor"]["motion"]["start"] = json!(start);
    model["gravity"] = json!([0.0, 0.0]);
    model
}

/// h, h′ and h″ by the cam's angle against the guide: of the flat face R + e sin α, of the roller a slider-crank.
fn lift(is_flat: bool, angle: f64) -> [f64; 3] {
    let (e, (sin, cos)) = (ECCENTRICITY, angle.sin_cos());
    if is_flat {
        return [RADIUS + e * sin, e * cos, -e * sin];
    }
    let rod = ((RADIUS + ROLLER).powi(2) - (e * cos).powi(2)).sqrt();
    let first = e * e * sin * cos / rod;
    let second = e * e * (cos * cos - sin * sin) / rod - first * first / rod;
    [e * sin + rod, e * cos + first, -e * sin + second]
}

#[test]
fn a_follower_on_a_turning_guide_moves_as_on_a_fixed_one() {
    let flat = json!({ "follower": "flat", "face": [1.0, 0.0], "profile": eccentric() });
    let roller = json!({ "follower": "roller", "roller_radius": ROLLER, "profile": eccentric() });
    for (cam, is_flat) in [(flat, true), (roller, false)] {
        let run = completed(&turning(cam, 1.1));
        let guide = column(&run, "frame.angle");
        let pace = OMEGA - SPEED;
        // In the guide: along it h, across it nothing.
        let seen = |row: usize, [across, along]: [f64; 2]| {
            let (sin, cos) = guide[row].sin_cos();
            [cos * across - sin * along, sin * across + cos * along]
        };
        let at = |angle: f64, row: usize| lift(is_flat, angle - guide[row]);
        for (axis, name) in ["x", "y"].into_iter().enumerate() {
            follows(&run, &format!("follower.{name}"), 1e-13, |angle, row| {
                seen(row, [0.0, at(angle, row)[0]])[axis]
            });
            follows(&run, &format!("follower.v{name}"), 1e-12, |angle, row| {
                let [h, first, _] = at(angle, row);
                seen(row, [-SPEED * h, pace * first])[axis]
            });
            follows(&run, &format!("follower.a{name}"), 1e-12, |angle, row| {
                let [h, first, second] = at(angle, row);
                let along = pace * pace * second - SPEED * SPEED * h;
                seen(row, [-2.0 * SPEED * pace * first, along])[axis]
            });
        }
        follows(&run, "joint.c.pressure_angle", 1e-12, |angle, row| {
            let angle = angle - guide[row];
            if is_flat {
                0.0
            } else {
                (ECCENTRICITY * angle.cos() / (RADIUS + ROLLER)).asin()
            }
        });
        // Without friction the cam presses along the guide, or across its face.
        follows(&run, "joint.c.normal_force", 1e-11, |angle, row| {
            let [h, _, second] = at(angle, row);
            let along = MASS * (pace * pace * second - SPEED * SPEED * h);
            let lean = if is_flat {
                0.0
            } else {
                (ECCENTRICITY * (angle - guide[row]).cos() / (RADIUS + ROLLER)).asin()
            };
            along / lean.cos()
        });
    }
}

/// The angle at which it jams is that of the cam against the guide.
#[test]
fn jamming_is_told_by_the_angle_against_the_guide() {
    let wide = json!({ "type": "circle", "centre": [0.03, 0.0], "radius": RADIUS });
    let cam = json!({ "follower": "roller", "roller_radius": ROLLER, "profile": wide });
    // It begins at the steepest point, e/(R + r) = 0.6.
    let run = completed(&turning(cam, TURNED));
    let said = run.report.warnings.join("\n");
    assert!(
        said.contains("reaches 0.6435 rad (36.87°), at a cam angle of 0 rad"),
        "{said}"
    );
}
