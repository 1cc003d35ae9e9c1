//! Change points of parts of a mechanism, with more freedom in the rest or drivers that move.

use crate::mechanisms::{column, loaded, pin, rod};
use linkdyn_engine::analysis::{Control, Outcome, run};
use linkdyn_output::Status;
use serde_json::{Value, json};

const CRANK: f64 = 0.1;
const COUPLER: f64 = 0.3;
const HUNG: f64 = 0.2;
const G: f64 = 9.81;
/// Start of the cranks [rad], their rate [rad/s], and start of the pendulum.
const START: [f64; 3] = [0.5, 30.0, -1.2];

#[track_caller]
fn completed(model: &Value) -> Outcome {
    let outcome =
        run(&loaded(model).model, &Control::default()).unwrap_or_else(|said| panic!("{said:?}"));
    assert_eq!(
        outcome.report.status,
        Status::Completed,
        "{:?}",
        outcome.report.message
    );
    outcome
}

/// A parallelogram, flat twice a turn, and a pendulum that hangs on `carrier`; either may be left out.
fn model(parallelogram: bool, carrier: Option<&str>, rtol: f64) -> Value {
    let [start, rate, hung] = START;
    let tip = [CRANK * start.cos(), CRANK * start.sin()];
    let mut bodies = json!({ "ground": { "points": { "O": [0.0, 0.0], "Q": [COUPLER, 0.0], "P": [0.1, 0.0] } } });
    let (mut joints, mut initial) = (json!({}), json!({}));
    if parallelogram {
        bodies["left"] = rod(CRANK, [0.0, 0.0], start);
        bodies["right"] = rod(CRANK, [COUPLER, 0.0], start);
        bodies["coupler"] = rod(COUPLER, tip, 0.0);
        bodies["coupler"]["points"]["P"] = json!([0.1, 0.0]);
        joints["o"] = pin("ground.O", "left.A");
        joints["q"] = pin("ground.Q", "right.A");
        joints["a"] = pin("left.B", "coupler.A");
        joints["b"] = pin("coupler.B", "right.B");
        initial["left"] = json!({ "angle": start, "angular_velocity": rate });
    }
    if let Some(carrier) = carrier {
        let place = if carrier == "coupler" {
            [tip[0] + 0.1, tip[1]]
        } else {
            [0.1, 0.0]
        };
        bodies["hung"] = rod(HUNG, place, hung);
        joints["p"] = pin(&format!("{carrier}.P"), "hung.A");
        initial["hung"] = json!({ "angle": hung, "angular_velocity": 0.0 });
    }
    json!({ "format": "linkdyn/1", "units": "SI", "gravity": [0.0, -G], "bodies": bodies, "joints": joints,
            "initial": initial,
            "analysis": { "type": "dynamics", "end": 3.0, "outputs": 301, "solver": { "rtol": rtol, "atol": rtol } } })
}

fn largest_difference(one: &[f64], two: &[f64]) -> f64 {
    one.iter()
        .zip(two)
        .map(|(a, b)| (a - b).abs())
        .fold(0.0, f64::max)
}

/// What has nothing to do with one another moves as if it were alone.
#[test]
fn a_pendulum_beside_a_parallelogram_changes_nothing() {
    let both = completed(&model(true, Some("ground"), 1e-11));
    let alone = completed(&model(true, None, 1e-11));
    let hung = completed(&model(false, Some("ground"), 1e-11));
    let turns = column(&alone, "left.angle").last().expect("rows") / std::f64::consts::TAU;
    assert!(turns > 3.0, "{turns}");
    for (name, other) in [
        ("left.angle", &alone),
        ("coupler.angle", &alone),
        ("coupler.vx", &alone),
        ("hung.angle", &hung),
    ] {
        let off = largest_difference(&column(&both, name), &column(other, name));
        println!("{name}: {off:e}");
        assert!(off < 1e-7, "{name}: {off:e}");
    }
}

/// A pendulum hung on the coupler, by the two equations of motion in the cranks' angle φ and its own ψ:
/// (2 m r²/3 + m r² + m r²) φ″ + (m r l/2) (cos(φ − ψ) ψ″ + sin(φ − ψ) ψ′²) = −3 m g r cos φ, and the like for ψ.
#[test]
fn a_pendulum_on_the_coupler_is_that_of_lagrange() {
    // All rods have 1 kg.
    let (r, l) = (CRANK, HUNG);
    let rates = |y: [f64; 4]| {
        let [phi, psi, dphi, dpsi] = y;
        let (sin, cos) = (phi - psi).sin_cos();
        let (a, b, c) = (
            2.0 * r * r / 3.0 + 2.0 * r * r,
            0.5 * r * l * cos,
            l * l / 3.0,
        );
        let f = -0.5 * r * l * sin * dpsi * dpsi - 3.0 * G * r * phi.cos();
        let h = 0.5 * r * l * sin * dphi * dphi - 0.5 * G * l * psi.cos();
        let det = a * c - b * b;
        [dphi, dpsi, (f * c - b * h) / det, (a * h - b * f) / det]
    };
    let [start, rate, hung] = START;
    let mut y = [start, hung, rate, 0.0];
    let mut wanted = vec![y];
    let (steps, h) = (1000, 1e-2 / 1000.0);
    // The motion is chaotic: differences grow tenfold in a quarter of a second.
    for _ in 0..100 {
        for _ in 0..steps {
            let at = |k: &[f64; 4], part: f64| std::array::from_fn(|i| y[i] + part * h * k[i]);
            let k1 = rates(y);
            let k2 = rates(at(&k1, 0.5));
            let k3 = rates(at(&k2, 0.5));
            let k4 = rates(at(&k3, 1.0));
            y = std::array::from_fn(|i| {
                y[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i])
            });
        }
        wanted.push(y);
    }
    let mut hanging = model(true, Some("coupler"), 1e-11);
    hanging["analysis"]["end"] = json!(1.0);
    hanging["analysis"]["outputs"] = json!(101);
    let outcome = completed(&hanging);
    let turns = (wanted[100][0] - start) / std::f64::consts::TAU;
    assert!(turns > 3.0, "{turns}");
    for (name, index) in [
        ("left.angle", 0),
        ("right.angle", 0),
        ("hung.angle", 1),
        ("left.omega", 2),
        ("hung.omega", 3),
    ] {
        let of: Vec<f64> = wanted.iter().map(|row| row[index]).collect();
        let off = largest_difference(&column(&outcome, name), &of);
        println!("{name}: {off:e}");
        assert!(off < 1e-7, "{name}: {off:e}");
    }
    let tilt = column(&outcome, "coupler.angle")
        .iter()
        .fold(0.0, |m: f64, angle| m.max(angle.abs()));
    assert!(tilt < 1e-10, "the coupler turns: {tilt:e}");
    let drift = outcome.report.quality.energy_drift.expect("conservative");
    assert!(drift < 1e-8, "{drift:e}");
}
