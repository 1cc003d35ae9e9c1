//! The mechanism's own length, mass and time, by which tolerances are measured.
//!
//! ```text
//! L   largest distance of two points of one body                                     [m]
//! M   heaviest body, inertias by I/L²                                                [kg]
//! 1/T fastest rate that the model names:                                             [1/s]
//!     drivers          |c_k k!|^(1/k), 2π ν, steepest stretch of a table              values by L or 1 rad
//!     initial rates    |v|/L, |ω|
//!     gravity          √(g/L)
//!     forces           √(|Q_x|/(m L)), √(|Q_θ|/I)         of force elements as drawn, and a little beside
//! ```
//!
//! A model in other units, or one that is enlarged with its masses and times by similarity, has the same numbers in
//! these. Where nothing has a mass or moves, kilogram and second stand in: nothing is measured by them then.

use super::{Evaluation, Inputs, System};
use crate::element::{Applied, Measure};

/// Part of L, or radians, by which bodies are moved to see what springs do that are relaxed as drawn.
const BESIDE: f64 = 0.1;

/// Characteristic length, mass and time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scale {
    /// L \[m\].
    pub length: f64,
    /// M \[kg\].
    pub(crate) mass: f64,
    /// T \[s\].
    pub(crate) time: f64,
}

impl Scale {
    /// Metre, kilogram and second.
    pub(crate) const SI: Scale = Scale {
        length: 1.0,
        mass: 1.0,
        time: 1.0,
    };

    /// Those of a system whose length is known.
    pub(crate) fn of(system: &System) -> Self {
        Scale {
            length: system.size,
            mass: usable(heaviest(system)),
            time: 1.0 / usable(fastest(system)),
        }
    }

    /// L/T [m/s].
    pub(crate) fn velocity(&self) -> f64 {
        self.length / self.time
    }

    /// L/T² [m/s²].
    pub(crate) fn acceleration(&self) -> f64 {
        self.velocity() / self.time
    }

    /// M L/T² \[N\].
    pub(crate) fn force(&self) -> f64 {
        self.mass * self.acceleration()
    }
}

/// A scale that is none is 1.
fn usable(scale: f64) -> f64 {
    if scale.is_normal() && (1.0 / scale).is_normal() {
        scale
    } else {
        1.0
    }
}

impl System {
    /// Largest coordinate, lengths divided by the mechanism's size [–].
    pub fn scaled_norm(&self, dq: &[f64]) -> f64 {
        let (mut length, mut angle) = (0.0, 0.0);
        for body in self.layout.bodies() {
            let [x, y, theta] = body.read(dq);
            length = larger(larger(length, x), y);
            angle = larger(angle, theta);
        }
        larger(length / self.size, angle)
    }

    /// Largest residual, lengths divided by the mechanism's size [–].
    pub(crate) fn scaled_residual(&self, phi: &[f64]) -> f64 {
        let (mut length, mut angle) = (0.0, 0.0);
        for (&phi, measure) in phi.iter().zip(&self.measures) {
            match measure {
                Measure::Length => length = larger(length, phi),
                Measure::Angle => angle = larger(angle, phi),
            }
        }
        larger(length / self.size, angle)
    }
}

/// The larger of `most` and |x|; NaN where either is.
pub(crate) fn larger(most: f64, x: f64) -> f64 {
    let x = x.abs();
    if x > most || x.is_nan() { x } else { most }
}

/// The heaviest body; an inertia counts as a mass at the length \[kg\].
fn heaviest(system: &System) -> f64 {
    let diagonal = system.mass.diagonal().iter().enumerate();
    let masses = diagonal.map(|(column, m)| {
        let arm = system.column_scale(column) / system.size;
        m * arm * arm
    });
    masses.fold(0.0, f64::max)
}

/// The fastest rate [1/s].
fn fastest(system: &System) -> f64 {
    let drivers = system
        .drivers
        .iter()
        .map(|driver| driver.law.rate(system.measure_scale(driver.measure)));
    let initial = system
        .initial_rates
        .iter()
        .map(|(_, rate)| rate.value.abs() / system.axis_scale(rate.axis));
    let gravity = (system.gravity.norm() / system.size).sqrt();
    let forces = [0.0, BESIDE].map(|by| forced(system, by));
    drivers
        .chain(initial)
        .chain([gravity])
        .chain(forces)
        .filter(|rate| rate.is_finite())
        .fold(0.0, f64::max)
}

/// Rate at which force elements move the bodies from rest, bodies moved from their guesses by parts of `by` [1/s].
fn forced(system: &System, by: f64) -> f64 {
    let mut evaluation = Evaluation::new(system);
    let mut q = system.guess.clone();
    for (column, q) in q.iter_mut().enumerate() {
        // Multiples of the golden ratio are spread evenly, and never alike.
        let part = (0.618_033_988_749_895 * (column + 1) as f64).fract();
        *q += by * part * system.column_scale(column);
    }
    evaluation.set_position(&q);
    let inputs = Inputs::at_time(system, 0.0);
    let at = evaluation.kinematics(&inputs);
    let mut force = vec![0.0; system.n()];
    let mut applied = Applied::to(&mut force, &system.layout);
    for element in &system.forces {
        element.apply(&at, &mut applied);
    }
    let acting = force.iter().zip(system.mass.diagonal()).enumerate();
    acting
        .map(|(column, (force, m))| (force.abs() / (m * system.column_scale(column))).sqrt())
        .filter(|rate| rate.is_finite())
        .fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::compile::compile;
    use linkdyn_model::AnalysisKind;

    /// A driven crank beside a pendulum on a spring, in units of L, M and T.
    const MODEL: &str = r#"{
      "format": "linkdyn/1",
      "units": "SI",
      "parameters": { "L": "1 m", "M": "1 kg", "T": "1 s" },
      "gravity": [0, "=-3*L/T^2"],
      "bodies": {
        "ground": { "points": { "O": [0, 0], "Q": ["=2*L", 0] } },
        "crank": { "mass": "=M", "inertia": "=2*M*L^2", "com": [0, 0], "points": { "O": [0, 0] } },
        "rod": { "mass": "=3*M", "inertia": "=4*M*L^2", "com": ["=L", 0],
                 "points": { "Q": [0, 0] }, "pose": { "position": ["=2*L", 0] } }
      },
      "joints": {
        "o": { "type": "revolute", "between": ["ground.O", "crank.O"] },
        "q": { "type": "revolute", "between": ["ground.Q", "rod.Q"] }
      },
      "drivers": {
        "motor": { "type": "rotation", "body": "crank",
                   "motion": { "type": "constant_velocity", "start": 0, "velocity": "=5 rad/T" } }
      },
      "forces": {
        "s": { "type": "torsion_spring", "between": ["ground", "rod"],
               "stiffness": "=2000*M*L^2/T^2", "damping": 0, "free_angle": 0 }
      },
      "analysis": { "type": "dynamics", "end": "=T", "outputs": 3 }
    }"#;

    fn scale(sets: &[&str]) -> Scale {
        let sets: Vec<String> = sets.iter().map(|set| set.to_string()).collect();
        let loaded = linkdyn_model::load(MODEL.as_bytes(), &sets).expect("a model");
        let system = compile(&loaded.model, AnalysisKind::Dynamics).expect("a system");
        system.scale
    }

    #[test]
    fn heaviest_and_fastest() {
        let found = scale(&[]);
        assert_eq!((found.length, found.mass), (2.0, 3.0));
        // The spring as drawn is relaxed: it is seen a little beside.
        assert!(found.time < 1.0 / 5.0, "{found:?}");
        let slack = scale(&["forces.s.stiffness=0"]);
        assert_eq!(slack.time, 1.0 / 5.0);
        let driven = scale(&["drivers.motor.motion.velocity=500"]);
        assert_eq!(driven.time, 1.0 / 500.0);
    }

    #[test]
    fn similar_mechanisms_have_similar_scales() {
        let (one, other) = (
            scale(&[]),
            scale(&[
                "parameters.L=0.001 m",
                "parameters.M=7 kg",
                "parameters.T=0.003 s",
            ]),
        );
        let close = |a: f64, b: f64| assert!((a / b - 1.0).abs() < 1e-13, "{a} {b}");
        close(other.length, 0.001 * one.length);
        close(other.mass, 7.0 * one.mass);
        close(other.time, 0.003 * one.time);
        close(other.velocity(), 0.001 / 0.003 * one.velocity());
        close(other.force(), 7.0 * 0.001 / 0.003 / 0.003 * one.force());
    }
}
