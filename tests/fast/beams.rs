//! Beams against the textbook, and what energy and momenta must do. `validation/beams` has large deflections, shear and vibrations.

use crate::mechanisms::*;
use serde_json::{Value, json};

/// A cantilever along x from the ground, in equal parts with lumped masses; EA, EI, and GA where it shears.
struct Cantilever {
    length: f64,
    axial: f64,
    bending: f64,
    shear: Option<f64>,
    /// Mass and rotary inertia by length [kg/m, kg·m].
    heavy: [f64; 2],
}

const SLENDER: Cantilever = Cantilever {
    length: 1.0,
    axial: 1e6,
    bending: 1.0,
    shear: None,
    heavy: [0.0; 2],
};

impl Cantilever {
    fn section(&self) -> Value {
        let mut section = json!({ "type": "general", "young_modulus": 1.0, "area": self.axial, "second_moment": self.bending });
        if let Some(shear) = self.shear {
            // G = E/2.
            section["poisson_ratio"] = json!(0.0);
            section["shear_area"] = json!(2.0 * shear);
        }
        section
    }

    /// Nodes 1 … n, without loads.
    fn chain(&self, n: usize) -> Value {
        let step = self.length / n as f64;
        let mut bodies = json!({ "ground": { "points": { "A": [0.0, 0.0] } } });
        let mut joints = json!({});
        for k in 1..=n {
            let part = if k == n { 0.5 * step } else { step };
            let [mass, inertia] = self.heavy.map(|by| by * part);
            let before = if k == 1 {
                "ground.A".into()
            } else {
                format!("n{}.A", k - 1)
            };
            bodies[format!("n{k}")] = json!({ "mass": mass, "inertia": inertia, "com": [0.0, 0.0],
                "points": { "A": [0.0, 0.0] }, "pose": { "position": [step * k as f64, 0.0] } });
            joints[format!("b{k}")] = json!({ "type": "beam", "between": [before, format!("n{k}.A")], "section": self.section() });
        }
        let mut chain = model(bodies, joints, json!({}));
        chain["gravity"] = json!([0.0, 0.0]);
        chain["analysis"] = json!({ "type": "statics" });
        chain
    }

    /// Displacement of the end under a load there.
    fn tip(&self, n: usize, load: [f64; 2]) -> [f64; 2] {
        let mut chain = self.chain(n);
        chain["forces"] =
            json!({ "tip": { "type": "force", "at": format!("n{n}.A"), "vector": load } });
        let run = completed(&chain);
        let at = |axis: &str| column(&run, &format!("n{n}.{axis}"))[0];
        [at("x") - self.length, at("y")]
    }
}

/// Of small loads: w = P L³/3 EI and P L³/3 EI + P L/GA, the angle P L²/2 EI, for any number of parts; u = N L/EA.
#[test]
fn small_deflections_are_those_of_the_textbook() {
    for (n, shear) in [(1, None), (5, None), (1, Some(30.0)), (5, Some(30.0))] {
        let bar = Cantilever {
            axial: 1e3,
            shear,
            ..SLENDER
        };
        let load = 1e-7;
        let known = load / 3.0 + shear.map_or(0.0, |shear| load / shear);
        close(bar.tip(n, [0.0, load])[1], known, 1e-12 * known.max(1.0));
        close(bar.tip(n, [1.0, 0.0])[0], 1e-3, 1e-14);
    }
}

/// A bar that swings wide, alone: its energy stays, and its momenta; with damping the energy falls by what is dissipated.
#[test]
fn a_free_bar_keeps_its_energy() {
    for damping in [0.0, 2e-3] {
        let bar = Cantilever {
            axial: 400.0,
            shear: Some(120.0),
            heavy: [1.0, 1e-3],
            ..SLENDER
        };
        let mut chain = bar.chain(3);
        for joint in chain["joints"]
            .as_object_mut()
            .expect("joints")
            .values_mut()
        {
            joint["damping_time"] = json!(damping);
        }
        chain["bodies"]["n0"] = json!({ "mass": 0.2, "inertia": 0.01, "com": [0.05, 0.02], "points": { "A": [0.0, 0.0] } });
        chain["joints"]["b1"]["between"][0] = json!("n0.A");
        chain["initial"] =
            json!({ "n3": { "vy": 1.5, "angular_velocity": 2.0 }, "n1": { "vx": -0.4 } });
        chain["analysis"] = json!({ "type": "dynamics", "end": 0.5, "outputs": 51,
            "solver": { "method": "dop853", "rtol": 1e-11, "atol": 1e-13 } });
        let run = completed(&chain);
        let total: Vec<f64> = column(&run, "energy.kinetic")
            .iter()
            .zip(column(&run, "energy.potential"))
            .map(|(kinetic, potential)| kinetic + potential)
            .collect();
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
        let bodies = [("n0", 0.2, 0.01, [0.05, 0.02])]
            .into_iter()
            .chain((1..=3).map(|k: usize| {
                let part = if k == 3 { 0.5 } else { 1.0 } / 3.0;
                (["n1", "n2", "n3"][k - 1], part, 1e-3 * part, [0.0; 2])
            }));
        let bodies: Vec<_> = bodies.collect();
        let (first, last) = (momenta(&run, 0, &bodies), momenta(&run, 50, &bodies));
        for (first, last) in first.iter().zip(last) {
            close(last, *first, 1e-9);
        }
    }
}

/// A bar made bent, by the angles of its ends, rests as it was made; its reaction is none.
#[test]
fn a_bar_may_be_made_bent_and_short() {
    let mut chain = SLENDER.chain(1);
    chain["joints"]["b1"]["length"] = json!(0.9);
    chain["joints"]["b1"]["angles"] = json!([0.2, -0.1]);
    let run = completed(&chain);
    let at = |name: &str| column(&run, name)[0];
    // Straight in the direction of its first end, and turned against its last one.
    close(at("n1.x"), 0.9 * 0.2_f64.cos(), 1e-9);
    close(at("n1.y"), 0.9 * 0.2_f64.sin(), 1e-9);
    close(at("n1.angle"), 0.3, 1e-9);
    for quantity in ["fx", "fy", "torque"] {
        close(at(&format!("joint.b1.{quantity}")), 0.0, 1e-9);
    }
}
