//! Bushings against closed forms: oscillators in two directions and in torsion, deflections, and what momentum and energy must do.

use crate::mechanisms::*;
use linkdyn_engine::analysis::{Control, modes};
use linkdyn_output::Status;
use serde_json::{Value, json};

const MASS: f64 = 2.0;
const INERTIA: f64 = 0.03;
const STIFFNESS: [f64; 2] = [5000.0, 800.0];
const DAMPING: [f64; 2] = [12.0, 30.0];
const TORSION: f64 = 40.0;

/// A block on a bushing at its centre of mass; the ground is the first body, so that its axes stay.
fn block(words: &Value) -> Value {
    let mut bushing = json!({ "type": "bushing", "between": ["ground.O", "block.C"],
        "radial_stiffness": STIFFNESS, "torsional_stiffness": TORSION });
    for (key, value) in words.as_object().expect("keys") {
        bushing[key] = value.clone();
    }
    let bodies = json!({ "ground": { "points": { "O": [0.0, 0.0] } },
        "block": { "mass": MASS, "inertia": INERTIA, "com": [0.0, 0.0], "points": { "C": [0.0, 0.0], "P": [0.1, 0.0] } } });
    let mut block = model(bodies, json!({ "mount": bushing }), json!({}));
    block["gravity"] = json!([0.0, 0.0]);
    block
}

/// Three oscillators that know nothing of each other, each with its frequency and its damping ratio c/(2 √(k m)).
#[test]
fn a_block_swings_along_both_axes_and_in_torsion() {
    let torsional = 0.2;
    let mut damped = block(&json!({ "radial_damping": DAMPING, "torsional_damping": torsional }));
    damped["analysis"] = json!({ "type": "statics" });
    let found = modes(&loaded(&damped).model, true, &Control::default()).expect("modes");
    let mut known: Vec<[f64; 2]> = [
        (STIFFNESS[0], DAMPING[0], MASS),
        (STIFFNESS[1], DAMPING[1], MASS),
        (TORSION, torsional, INERTIA),
    ]
    .map(|(k, c, m): (f64, f64, f64)| [(k / m).sqrt(), c / (2.0 * (k * m).sqrt())])
    .into();
    known.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let ours: Vec<[f64; 2]> = found
        .modes
        .iter()
        .map(|mode| [mode.frequency(), mode.damping_ratio().expect("it swings")])
        .collect();
    assert_eq!(ours.len(), 3, "{ours:?}");
    for (ours, known) in ours.iter().zip(known) {
        close(ours[0], known[0], 1e-12 * known[0]);
        close(ours[1], known[1], 1e-12);
    }
}

/// The free oscillation x₀ e^(−ζωt) (cos ω_d t + ζ/√(1 − ζ²) sin ω_d t) along each axis at once, with an explicit method and a stiff one.
#[test]
fn damped_oscillations_are_those_of_the_closed_form() {
    for method in ["dop853", "radau5"] {
        let mut swings = block(&json!({ "radial_damping": DAMPING }));
        swings["initial"] = json!({ "block": { "x": 0.01, "y": -0.02, "angle": 0.3, "vx": 0, "vy": 0, "angular_velocity": 0 } });
        swings["analysis"] = json!({ "type": "dynamics", "end": 0.3, "outputs": 31,
            "solver": { "method": method, "rtol": 1e-12, "atol": 1e-14 } });
        let run = outcome(&swings);
        assert_eq!(run.report.status, Status::Completed, "{:?}", run.report);
        let of = |name: &str| column(&run, name);
        let (x, y, angle) = (of("block.x"), of("block.y"), of("block.angle"));
        for (row, t) in of("time").into_iter().enumerate() {
            let at = |k: f64, c: f64, m: f64, start: f64| {
                let (omega, zeta) = ((k / m).sqrt(), c / (2.0 * (k * m).sqrt()));
                let free = (1.0 - zeta * zeta).sqrt();
                let turn = omega * free * t;
                start * (-zeta * omega * t).exp() * (turn.cos() + zeta / free * turn.sin())
            };
            close(
                x[row],
                at(STIFFNESS[0], DAMPING[0], MASS, 0.01),
                1e-10 * 0.01,
            );
            close(
                y[row],
                at(STIFFNESS[1], DAMPING[1], MASS, -0.02),
                1e-10 * 0.02,
            );
            close(angle[row], at(TORSION, 0.0, INERTIA, 0.3), 1e-10 * 0.3);
            // What the ground exerts on the block, and its torque about the block's point.
            let (vx, vy) = (of("block.vx")[row], of("block.vy")[row]);
            let known = [
                ("joint.mount.fx", -STIFFNESS[0] * x[row] - DAMPING[0] * vx),
                ("joint.mount.fy", -STIFFNESS[1] * y[row] - DAMPING[1] * vy),
                ("joint.mount.torque", -TORSION * angle[row]),
            ];
            for (name, known) in known {
                close(of(name)[row], known, 1e-11);
            }
        }
        let imbalance = run.report.quality.power_imbalance.expect("known");
        assert!(imbalance < 1e-10, "{imbalance}");
    }
}

/// The weight, a load and a moment at rest: F/k along each axis, and T/k from the free angle.
#[test]
fn a_load_deflects_it_by_its_compliance() {
    let mut rests = block(&json!({ "free_angle": 0.4 }));
    rests["gravity"] = json!([0.0, -9.81]);
    rests["bodies"]["block"]["pose"] = json!({ "angle": 0.4 });
    rests["forces"] = json!({
        "push": { "type": "force", "at": "block.C", "vector": [60.0, 0.0] },
        "twist": { "type": "torque", "body": "block", "value": 3.0 } });
    rests["analysis"] = json!({ "type": "statics" });
    let run = outcome(&rests);
    assert_eq!(run.report.status, Status::Completed, "{:?}", run.report);
    assert!(run.report.warnings.is_empty(), "{:?}", run.report.warnings);
    let mobility = &run.report.mobility;
    assert_eq!((mobility.grubler, mobility.rank), (3, 3));
    let of = |name: &str| column(&run, name)[0];
    close(of("block.x"), 60.0 / STIFFNESS[0], 1e-13);
    close(of("block.y"), -9.81 * MASS / STIFFNESS[1], 1e-13);
    close(of("block.angle"), 0.4 + 3.0 / TORSION, 1e-12);
    close(of("joint.mount.fx"), -60.0, 1e-10);
    close(of("joint.mount.fy"), 9.81 * MASS, 1e-10);
    close(of("joint.mount.torque"), -3.0, 1e-10);
}

/// Two bodies in space: their momentum and the angular one stay, though the axes turn; the energy stays, or falls by what is damped.
#[test]
fn two_free_bodies_keep_their_momentum() {
    for damped in [false, true] {
        let bodies = json!({
            "frame": { "mass": 3.0, "inertia": 0.2, "com": [0.1, 0.0], "points": { "A": [0.3, 0.1] } },
            "arm": { "mass": 1.0, "inertia": 0.05, "com": [0.2, -0.1], "points": { "B": [-0.1, 0.2] },
                     "pose": { "position": [0.45, -0.12], "angle": 0.2 } } });
        let mut bushing = json!({ "type": "bushing", "between": ["frame.A", "arm.B"],
            "radial_stiffness": [900.0, 200.0], "torsional_stiffness": 5.0, "free_angle": -0.3 });
        if damped {
            bushing["radial_damping"] = json!([4.0, 9.0]);
            bushing["torsional_damping"] = json!(0.1);
        }
        let mut pair = model(bodies, json!({ "mount": bushing }), json!({}));
        pair["gravity"] = json!([0.0, 0.0]);
        pair["initial"] = json!({
            "frame": { "vx": 0.5, "vy": 0.2, "angular_velocity": 3.0 },
            "arm": { "vx": -0.4, "vy": 0.9, "angular_velocity": -2.0 } });
        pair["analysis"] = json!({ "type": "dynamics", "end": 1.0, "outputs": 51,
            "columns": ["*", "joint.*.angle"], "solver": { "rtol": 1e-12, "atol": 1e-14 } });
        let run = outcome(&pair);
        assert_eq!(run.report.status, Status::Completed, "{:?}", run.report);
        let of = |name: &str| column(&run, name);
        let bodies = [
            ("frame", 3.0, 0.2, [0.1, 0.0]),
            ("arm", 1.0, 0.05, [0.2, -0.1]),
        ];
        let sums = |row: usize| momenta(&run, row, &bodies);
        let energy: Vec<f64> = of("energy.kinetic")
            .into_iter()
            .zip(of("energy.potential"))
            .map(|(kinetic, potential)| kinetic + potential)
            .collect();
        let first = sums(0);
        for row in 0..51 {
            for (ours, known) in sums(row).into_iter().zip(first) {
                close(ours, known, 1e-11);
            }
            close(
                of("joint.mount.angle")[row],
                of("arm.angle")[row] - of("frame.angle")[row],
                1e-15,
            );
        }
        if damped {
            assert!(energy.windows(2).all(|pair| pair[1] < pair[0] + 1e-12));
            assert!(energy[50] < 0.9 * energy[0]);
        } else {
            for each in &energy {
                close(*each, energy[0], 1e-10 * energy[0]);
            }
        }
        let imbalance = run.report.quality.power_imbalance.expect("known");
        assert!(imbalance < 1e-10, "{imbalance}");
    }
}

/// Against a pin: a pendulum on ever stiffer rubber comes to swing as one on a pin, by the compliance.
#[test]
fn stiff_rubber_is_a_pin() {
    let swing = |joint: Value| {
        let bodies = json!({ "ground": { "points": { "O": [0.0, 0.0] } }, "rod": rod(0.5, [0.0, 0.0], -1.2) });
        let mut pendulum = model(bodies, json!({ "pin": joint }), json!({}));
        pendulum["analysis"] = json!({ "type": "statics" });
        let found = modes(&loaded(&pendulum).model, false, &Control::default()).expect("modes");
        let slowest = found.modes.iter().map(|mode| mode.frequency());
        slowest.fold(f64::INFINITY, f64::min)
    };
    let pinned = swing(pin("ground.O", "rod.A"));
    close(pinned, (1.5 * 9.81_f64 / 0.5).sqrt(), 1e-12);
    let off = [1e6, 1e7].map(|stiffness: f64| {
        let rubber = json!({ "type": "bushing", "between": ["ground.O", "rod.A"], "radial_stiffness": stiffness });
        1.0 - swing(rubber) / pinned
    });
    assert!(off[0].abs() < 1e-4 && off[0].abs() > 1e-8, "{off:?}");
    close(off[0] / off[1], 10.0, 0.01);
}
