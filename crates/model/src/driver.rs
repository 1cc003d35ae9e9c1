//! Drivers: prescribed motions.

use serde::{Deserialize, Serialize};

/// A prescribed coordinate.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize)]
pub struct Driver {
    /// Which coordinate it prescribes.
    #[serde(flatten)]
    pub kind: DriverKind,
    /// The law of time that the coordinate follows.
    pub motion: Motion,
    /// How far the coordinate may be from what the motion says, to either side \[rad or m\].
    #[serde(default)]
    #[doc(hidden)]
    pub tolerance: Option<f64>,
}

/// Which coordinate is prescribed.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize)]
#[serde(tag = "type", rename_all = "snake_case")]
pub enum DriverKind {
    /// Angle of `body`, relative to another body where given (default ground).
    Rotation {
        /// The driven body.
        body: String,
        /// The body from which the angle counts.
        #[serde(default)]
        relative_to: Option<String>,
    },
    /// Slide of a prismatic joint or a slot, along its axis, first point to second.
    Translation {
        /// Name of the prismatic joint or slot.
        joint: String,
    },
}

/// A law of time f(t), SI (driven dimension, s, Hz, rad).
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize)]
#[serde(tag = "type", rename_all = "snake_case")]
pub enum Motion {
    /// Σ c_k t^k.
    Polynomial {
        /// c₀, c₁, c₂ …; a plain c_k is in the driven dimension's unit per second^k.
        coefficients: Vec<f64>,
    },
    /// offset + amplitude·sin(2π·frequency·t + phase).
    Harmonic {
        /// Middle of the oscillation.
        #[serde(default)]
        offset: f64,
        /// Half of its width.
        amplitude: f64,
        /// \[Hz\]
        frequency: f64,
        /// \[rad\]
        #[serde(default)]
        phase: f64,
    },
    /// Cubic spline through (t, value); times strictly increasing, at least two.
    Table {
        /// [[t, value], …]
        points: Vec<[f64; 2]>,
    },
    /// start + velocity·t.
    ConstantVelocity {
        /// Value at t = 0.
        #[serde(default)]
        start: f64,
        /// Rate at t = 0.
        velocity: f64,
    },
    /// start + velocity·t + acceleration·t²/2.
    ConstantAcceleration {
        /// Value at t = 0.
        #[serde(default)]
        start: f64,
        /// Rate at t = 0.
        #[serde(default)]
        velocity: f64,
        /// Rate of the rate.
        acceleration: f64,
    },
}
