//! Two bodies in free flight that meet.

use crate::mechanisms::{column, model};
use linkdyn_engine::analysis::Outcome;
use serde_json::{Value, json};

/// Two bodies in free flight whose hooks meet at an instant, with another velocity each.
pub struct Flight {
    pub masses: [f64; 2],
    pub inertias: [f64; 2],
    pub hooks: [[f64; 2]; 2],
    /// At the instant.
    pub places: [[f64; 2]; 2],
    pub angles: [f64; 2],
    pub velocities: [[f64; 2]; 2],
    pub omegas: [f64; 2],
}

/// When they meet \[s\].
pub const MEETING: f64 = 0.5;

/// A vector, turned.
pub fn turned([x, y]: [f64; 2], angle: f64) -> [f64; 2] {
    let (sin, cos) = angle.sin_cos();
    [cos * x - sin * y, sin * x + cos * y]
}

/// They meet at these angles.
pub fn flight(angles: [f64; 2]) -> Flight {
    let hooks = [[0.3, 0.1], [-0.2, 0.05]];
    let first = [0.1, -0.05];
    let [a, b] = [turned(hooks[0], angles[0]), turned(hooks[1], angles[1])];
    Flight {
        masses: [2.0, 1.0],
        inertias: [0.05, 0.03],
        hooks,
        places: [first, [first[0] + a[0] - b[0], first[1] + a[1] - b[1]]],
        angles,
        velocities: [[0.3, -0.2], [-0.7, 0.4]],
        omegas: [-0.5, 3.0],
    }
}

impl Flight {
    /// The model, with the joint of both.
    pub fn model(&self, joint: &Value) -> Value {
        let body = |k: usize| {
            json!({ "mass": self.masses[k], "inertia": self.inertias[k], "com": [0.0, 0.0],
                    "points": { "H": self.hooks[k], "C": [0.0, 0.0] } })
        };
        let initial = |k: usize| {
            let at = |axis: usize| self.places[k][axis] - MEETING * self.velocities[k][axis];
            json!({ "x": at(0), "y": at(1), "angle": self.angles[k] - MEETING * self.omegas[k],
                    "vx": self.velocities[k][0], "vy": self.velocities[k][1],
                    "angular_velocity": self.omegas[k] })
        };
        let pose = |k: usize| json!({ "position": self.places[k], "angle": self.angles[k] });
        let mut bodies = json!({ "one": body(0), "two": body(1) });
        (bodies["one"]["pose"], bodies["two"]["pose"]) = (pose(0), pose(1));
        let mut model = model(bodies, json!({ "hook": joint }), json!({}));
        model["gravity"] = json!([0.0, 0.0]);
        model["initial"] = json!({ "one": initial(0), "two": initial(1) });
        model["analysis"] =
            json!({ "type": "dynamics", "end": 1.0, "outputs": 21, "solver": { "rtol": 1e-12 } });
        model
    }

    /// ½ wᵀ W⁻¹ w of the rows that close: two of the hooks, and with `turns` the angle.
    pub fn lost(&self, turns: bool) -> f64 {
        let arms = [0, 1].map(|k| turned(self.hooks[k], self.angles[k]));
        let rate = |k: usize| {
            [
                self.velocities[k][0] - self.omegas[k] * arms[k][1],
                self.velocities[k][1] + self.omegas[k] * arms[k][0],
            ]
        };
        let (a, b) = (rate(0), rate(1));
        let w = [a[0] - b[0], a[1] - b[1], self.omegas[0] - self.omegas[1]];
        // Rows of J by body: the point's x and y, and the angle.
        let rows = |k: usize| {
            [
                [1.0, 0.0, -arms[k][1]],
                [0.0, 1.0, arms[k][0]],
                [0.0, 0.0, 1.0],
            ]
        };
        let count = if turns { 3 } else { 2 };
        let mut mobility = [[0.0; 3]; 3];
        for k in 0..2 {
            let inverse = [
                1.0 / self.masses[k],
                1.0 / self.masses[k],
                1.0 / self.inertias[k],
            ];
            let rows = rows(k);
            for (i, row) in mobility.iter_mut().enumerate() {
                for (j, entry) in row.iter_mut().enumerate() {
                    *entry += (0..3)
                        .map(|c| rows[i][c] * inverse[c] * rows[j][c])
                        .sum::<f64>();
                }
            }
        }
        // Gauss without pivoting: W is positive definite.
        let mut p = w;
        for i in 0..count {
            for j in i + 1..count {
                let part = mobility[j][i] / mobility[i][i];
                let pivot = mobility[i];
                let entries = mobility[j].iter_mut().zip(pivot);
                entries.for_each(|(entry, own)| *entry -= part * own);
                p[j] -= part * p[i];
            }
        }
        for i in (0..count).rev() {
            for c in i + 1..count {
                p[i] -= mobility[i][c] * p[c];
            }
            p[i] /= mobility[i][i];
        }
        0.5 * (0..count).map(|k| p[k] * w[k]).sum::<f64>()
    }

    /// Momenta and kinetic energy in a row.
    pub fn sums(&self, run: &Outcome, k: usize) -> [f64; 4] {
        let mut sums = [0.0; 4];
        for (body, name) in ["one", "two"].iter().enumerate() {
            let of = |word: &str| column(run, &format!("{name}.{word}"))[k];
            let (m, j) = (self.masses[body], self.inertias[body]);
            let [x, y, vx, vy, omega] = ["x", "y", "vx", "vy", "omega"].map(of);
            let parts = [
                m * vx,
                m * vy,
                j * omega + m * (x * vy - y * vx),
                0.5 * (m * (vx * vx + vy * vy) + j * omega * omega),
            ];
            sums.iter_mut()
                .zip(parts)
                .for_each(|(sum, part)| *sum += part);
        }
        sums
    }
}
