//! Beams: what energy and momenta must do, and bars that are made bent. `validation/beams` has deflections, shear and vibrations.

use crate::mechanisms::*;
use serde_json::{Value, json};

/// EA \[N\], EI [N·m²] and GA \[N\] as a cross-section with E = 1 Pa and G = E/2.
fn section([axial, bending, shear]: [f64; 3]) -> Value {
    json!({ "type": "general", "young_modulus": 1.0, "area": axial, "second_moment": bending,
        "poisson_ratio": 0.0, "shear_area": 2.0 * shear })
}

/// A bar of two beams between three bodies, alone: its energy stays, and its momenta; with damping the energy falls.
#[test]
fn a_free_bar_keeps_its_energy() {
    let bodies = [
        ("a", 0.2, 0.01, [0.05, 0.02]),
        ("b", 0.35, 3e-4, [0.0, 0.0]),
        ("c", 0.15, 2e-4, [0.0, 0.0]),
    ];
    for damping in [0.0, 2e-3] {
        let mut drawn = json!({ "ground": { "points": {} } });
        for (k, (name, mass, inertia, com)) in bodies.into_iter().enumerate() {
            drawn[name] = json!({ "mass": mass, "inertia": inertia, "com": com, "points": { "A": [0.0, 0.0] },
                "pose": { "position": [0.35 * k as f64, 0.0] } });
        }
        let beam = |from: &str, to: &str| json!({ "type": "beam", "between": [from, to], "section": section([400.0, 1.0, 120.0]), "damping_time": damping });
        let joints = json!({ "ab": beam("a.A", "b.A"), "bc": beam("b.A", "c.A") });
        let mut bar = model(drawn, joints, json!({}));
        bar["gravity"] = json!([0.0, 0.0]);
        bar["initial"] =
            json!({ "c": { "vy": 1.5, "angular_velocity": 2.0 }, "b": { "vx": -0.4 } });
        bar["analysis"] = json!({ "type": "dynamics", "end": 0.5, "outputs": 51,
            "solver": { "method": "dop853", "rtol": 1e-11, "atol": 1e-13 } });
        let run = completed(&bar);
        let kinetic = column(&run, "energy.kinetic").into_iter();
        let potential = column(&run, "energy.potential");
        let total: Vec<f64> = kinetic.zip(potential).map(|(t, v)| t + v).collect();
        if damping == 0.0 {
            for energy in &total {
                close(*energy, total[0], 1e-9 * total[0]);
            }
        } else {
            assert!(
                total.windows(2).all(|pair| pair[1] < pair[0] + 1e-12),
                "{total:?}"
            );
        }
        let imbalance = run.report.quality.power_imbalance.expect("known");
        assert!(imbalance < 1e-9, "{imbalance}");
        let (first, last) = (momenta(&run, 0, &bodies), momenta(&run, 50, &bodies));
        for (first, last) in first.iter().zip(last) {
            close(last, *first, 1e-9);
        }
    }
}

/// A bar made bent, by the angles of its ends, rests as it was made; its reaction is none.
#[test]
fn a_bar_may_be_made_bent_and_short() {
    let bodies = json!({ "ground": { "points": { "A": [0.0, 0.0] } },
        "end": { "mass": 0.0, "inertia": 0.0, "com": [0.0, 0.0], "points": { "A": [0.0, 0.0] }, "pose": { "position": [1.0, 0.0] } } });
    let joints = json!({ "bar": { "type": "beam", "between": ["ground.A", "end.A"], "section": section([1e6, 1.0, 120.0]),
        "length": 0.9, "angles": [0.2, -0.1] } });
    let mut bent = model(bodies, joints, json!({}));
    bent["gravity"] = json!([0.0, 0.0]);
    bent["analysis"] = json!({ "type": "statics" });
    let run = completed(&bent);
    let at = |name: &str| column(&run, name)[0];
    // Straight in the direction of its first end, and turned against its last one.
    close(at("end.x"), 0.9 * 0.2_f64.cos(), 1e-9);
    close(at("end.y"), 0.9 * 0.2_f64.sin(), 1e-9);
    close(at("end.angle"), 0.3, 1e-9);
    for quantity in ["fx", "fy", "torque"] {
        close(at(&format!("joint.bar.{quantity}")), 0.0, 1e-9);
    }
}
