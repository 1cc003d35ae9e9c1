//! A row of masses with stiff springs, and its motion in closed form.
//!
//! ```text
//! m ẍ₁ = k (x₂ − x₁) − c x₁,   m ẍ_j = k (x_{j−1} − 2 x_j + x_{j+1}),   m ẍ_N = k (x_{N−1} − x_N)
//! x_j = cos((N − j + ½) θ) cos(ω t),   ω² = 4 (k/m) sin²(θ/2),   c/k = 1 − cos((N + ½) θ) / cos((N − ½) θ)
//! ```
//!
//! N masses on guides, stiff springs between them, a soft one from the first to the ground. c is chosen so that the
//! fastest mode is [`RATIO`] times as fast as the slowest, and k so that the slowest has a period of one second. The row moves in
//! its slowest mode.

use serde_json::{Value, json};
use std::f64::consts::PI;

/// Fastest over slowest frequency.
pub const RATIO: f64 = 1e4;
/// Periods of the slowest mode.
pub const PERIODS: f64 = 10.0;

/// The springs and the slowest mode of so many masses of 1 kg.
#[derive(Debug, Clone, Copy)]
pub struct Row {
    pub masses: usize,
    /// Of the springs between the masses [N/m].
    pub stiffness: f64,
    /// Of the one to the ground [N/m].
    pub soft: f64,
    /// θ of the slowest mode.
    angle: f64,
}

impl Row {
    pub fn new(masses: usize) -> Self {
        let n = masses as f64;
        let bedding = |angle: f64| 1.0 - ((n + 0.5) * angle).cos() / ((n - 0.5) * angle).cos();
        // The fastest mode hardly feels the soft spring: two rounds settle it.
        let mut fastest = PI * (n - 1.0) / n;
        let mut angle = 0.0;
        for _ in 0..20 {
            angle = 2.0 * ((0.5 * fastest).sin() / RATIO).asin();
            let soft = bedding(angle);
            // c/k grows with θ from 0 at the free row's mode.
            let (mut low, mut high) = (PI * (n - 1.0) / n, PI * n / (n + 0.5));
            for _ in 0..200 {
                let middle = 0.5 * (low + high);
                if bedding(middle) < soft {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            fastest = low;
        }
        let stiffness = (PI / (0.5 * angle).sin()).powi(2);
        Row {
            masses,
            stiffness,
            soft: stiffness * bedding(angle),
            angle,
        }
    }

    /// Displacement of mass j, counted from 0, at a time [m].
    pub fn place(&self, j: usize, time: f64) -> f64 {
        let from_end = (self.masses - j) as f64 - 0.5;
        (from_end * self.angle).cos() * (2.0 * PI * time).cos()
    }

    /// The model. The masses lie over each other, so that coordinates are displacements: springs run from the right side of one
    /// to the left side of the next, 1 m away, and to a point of the ground.
    pub fn json(&self, method: &str) -> Value {
        let mut bodies = serde_json::Map::new();
        let mut joints = serde_json::Map::new();
        let mut forces = serde_json::Map::new();
        bodies.insert(
            "ground".into(),
            json!({ "points": { "O": [0, 0], "E": [-3, 0] } }),
        );
        for j in 0..self.masses {
            let mass = json!({ "mass": 1, "inertia": 1, "com": [0, 0],
                "points": { "O": [0, 0], "L": [-0.5, 0], "R": [0.5, 0] },
                "pose": { "position": [self.place(j, 0.0), 0], "angle": 0 } });
            bodies.insert(format!("m{j}"), mass);
            let guide = json!({ "type": "prismatic", "between": ["ground.O", format!("m{j}.O")],
                "axis": [1, 0] });
            joints.insert(format!("g{j}"), guide);
            let (from, stiffness, length) = match j.checked_sub(1) {
                None => ("ground.E".into(), self.soft, 3.0),
                Some(before) => (format!("m{before}.R"), self.stiffness, 1.0),
            };
            let to = if j == 0 {
                "m0.O".into()
            } else {
                format!("m{j}.L")
            };
            let spring = json!({ "type": "spring", "between": [from, to], "stiffness": stiffness,
                "free_length": length });
            forces.insert(format!("s{j}"), spring);
        }
        json!({
            "format": "linkdyn/1", "name": format!("row of {} masses", self.masses), "units": "SI",
            "bodies": bodies, "joints": joints, "forces": forces,
            "analysis": { "type": "dynamics", "end": PERIODS, "outputs": 24,
                "solver": { "method": method } },
        })
    }
}
