//! Laws of time with breaks, in free motions.

use super::*;

const METHODS: [&str; 3] = ["dop853", "radau5", "auto"];

fn body(mass: f64) -> Value {
    json!({ "mass": mass, "inertia": 0.1, "com": [0.0, 0.0], "points": { "P": [0.0, 0.0] } })
}

/// A slider of 2 kg, without gravity along its guide.
fn slider() -> Value {
    let block = body(2.0);
    let bodies = json!({ "ground": { "points": { "O": [0.0, 0.0] } }, "block": block });
    let guide = json!({ "type": "prismatic", "between": ["ground.O", "block.P"], "axis": [1, 0] });
    model(bodies, json!({ "guide": guide }), json!({}))
}

/// A force along straight lines: the motion is a cubic between its corners. Steps that end at the corners make no error, however
/// loose the tolerance; one step across a corner makes one of its square.
#[test]
fn steps_end_at_the_corners_of_a_force() {
    let points = [[0.1, 0.0], [0.4, 6.0], [0.5, -8.0], [1.3, 2.0], [1.7, 2.0]];
    let mut model = slider();
    model["forces"] = json!({ "push": { "type": "force", "at": "block.P",
        "vector": [{ "type": "table", "interpolation": "linear", "points": points }, 0] } });
    for method in METHODS {
        model["analysis"] = dynamics(1.7, 18, 1e-4);
        model["analysis"]["solver"]["method"] = json!(method);
        let run = completed(&model);
        let (time, x) = (column(&run, "time"), column(&run, "block.x"));
        let v = column(&run, "block.vx");
        let a = column(&run, "block.ax");
        // what the force has pushed and moved since it began; before that it goes on as a line of its first slope
        let exact = |t: f64| {
            let (mut v, mut x) = (0.0, 0.0);
            let mut left = [0.0, -2.0];
            for right in points.into_iter().chain([[9.0, f64::NAN]]) {
                let h = right[0].min(t) - left[0];
                let slope = match right[1].is_nan() {
                    true => 0.0,
                    false => (right[1] - left[1]) / (right[0] - left[0]),
                };
                if h > 0.0 {
                    x += h * v + h * h / 4.0 * (left[1] + slope * h / 3.0);
                    v += h / 2.0 * (left[1] + slope * h / 2.0);
                }
                left = right;
            }
            [x, v]
        };
        for k in 0..time.len() {
            let [x0, v0] = exact(time[k]);
            assert!(
                (x[k] - x0).abs() < 1e-13,
                "{method} {}: {:e}",
                time[k],
                x[k] - x0
            );
            assert!(
                (v[k] - v0).abs() < 1e-13,
                "{method} {}: {:e}",
                time[k],
                v[k] - v0
            );
        }
        assert!((a[17] - 1.0).abs() < 1e-12, "{method}: {}", a[17]);
        assert!((a[5] + 4.0).abs() < 1e-9, "{method}: {}", a[5]);
    }
}

/// A slider on a spring whose other end rises with constant accelerations: x″ = −ω²(x − y), in closed form from corner to corner.
#[test]
fn a_driver_with_jumps_of_acceleration_shakes_a_spring() {
    let mut model = slider();
    model["bodies"]["table"] = body(1.0);
    model["joints"]["rail"] =
        json!({ "type": "prismatic", "between": ["ground.O", "table.P"], "axis": [1, 0] });
    model["forces"] = json!({ "spring": { "type": "spring", "between": ["table.P", "block.P"],
        "stiffness": 800.0, "free_length": 0.5 } });
    model["bodies"]["block"]["pose"] = json!({ "position": [0.5, 0.0] });
    model["initial"] = json!({ "block": { "x": 0.5, "vx": 0.0 } });
    model["drivers"] = json!({ "motor": { "type": "translation", "joint": "rail",
        "motion": { "type": "trapezoidal_velocity", "rise": 0.1, "velocity": 0.4, "acceleration": 4.0 } } });
    // T = h/v + v/a = 0.35 s: the run ends where the last acceleration does, and long after
    for (end, outputs) in [(0.35, 8), (1.05, 22)] {
        model["analysis"] = dynamics(end, outputs, 1e-9);
        let run = completed(&model);
        let [time, x, y] = ["time", "block.x", "driver.motor.value"].map(|name| column(&run, name));
        let ay = column(&run, "table.ax");
        let w = 20.0;
        for k in 0..time.len() {
            let t = time[k];
            // y″ = 4 to 0.1, 0 to 0.25, −4 to 0.35; each of them adds a(1 − cos ω(t − t₀))/ω² to what follows y
            let jumps = [(0.0, 4.0), (0.1, -4.0), (0.25, -4.0), (0.35, 4.0)];
            let (mut platform, mut lag) = (0.0, 0.0);
            for (from, jump) in jumps {
                let since = (t - from).max(0.0);
                platform += 0.5 * jump * since * since;
                lag += jump * (1.0 - (w * since).cos()) / (w * w);
            }
            assert!((y[k] - platform).abs() < 1e-15, "{t}: {}", y[k]);
            assert!(
                (x[k] - 0.5 - (platform - lag)).abs() < 1e-9,
                "{t}: {:e}",
                x[k] - 0.5 - (platform - lag)
            );
        }
        // after the jump
        for (row, wanted) in [(0, 4.0), (2, 0.0), (5, -4.0), (7, 0.0)] {
            assert!((ay[row] - wanted).abs() < 1e-13, "{row}: {}", ay[row]);
        }
    }
}

/// Rounds of a sequence, each with breaks of its own: all of them end steps.
#[test]
fn a_sequence_goes_on_for_many_rounds() {
    let mut model = slider();
    model["drivers"] = json!({ "motor": { "type": "translation", "joint": "guide", "motion": {
        "type": "sequence", "start": 0.01, "begin": 0.05, "repeat": 20, "segments": [
            { "law": "modified_sine", "rise": 0.03, "duration": 0.07 }, { "dwell": 0.02 },
            { "law": "trapezoidal_velocity", "rise": -0.02, "duration": 0.01, "ramp": 0.5 }] } } });
    model["bodies"]["bob"] = body(1.0);
    model["bodies"]["bob"]["com"] = json!([0.0, -0.1]);
    model["joints"]["pin"] = json!({ "type": "revolute", "between": ["block.P", "bob.P"] });
    model["analysis"] = dynamics(2.1, 22, 1e-9);
    let run = completed(&model);
    let (time, value) = (column(&run, "time"), column(&run, "driver.motor.value"));
    for (t, value) in time.iter().zip(&value) {
        let rounds = ((t - 0.05 + 1e-9) / 0.1).floor().clamp(0.0, 20.0);
        let rest = match *t {
            // halfway up the modified sine, at 0.05 of 0.07 a round, and at rest at the end
            t if !(0.05..2.04).contains(&t) => 0.0,
            _ => 0.03 * MODIFIED_SINE_AT_5_7,
        };
        let wanted = 0.01 + 0.01 * rounds + rest;
        assert!((value - wanted).abs() < 1e-12, "{t}: {value} {wanted}");
    }
}

/// s(5/7) = (2 + 5π/7 − (9/4) sin((π + 20π/7)/3))/(4 + π).
const MODIFIED_SINE_AT_5_7: f64 = 0.840_584_989_834_120_3;
