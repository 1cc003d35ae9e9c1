//! Drivers: prescribed motions.

use schemars::JsonSchema;
use serde::Deserialize;

use super::schema;

/// A prescribed coordinate.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
pub struct Driver {
    #[serde(flatten)]
    pub kind: DriverKind,
    /// The law of time that the coordinate follows.
    pub motion: Motion,
}

/// Which coordinate is prescribed.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(tag = "type", rename_all = "snake_case")]
pub enum DriverKind {
    /// Angle of `body`, relative to another body where given (default ground).
    #[schemars(extend("x-driven" = "angle"))]
    Rotation {
        /// The driven body.
        #[schemars(extend("x-reference" = "body"))]
        body: String,
        /// The body from which the angle counts.
        #[serde(default)]
        #[schemars(with = "String", extend("x-reference" = "body"))]
        relative_to: Option<String>,
    },
    /// Slide of a prismatic joint or a slot, along its axis, first point to second.
    #[schemars(extend("x-driven" = "length"))]
    Translation {
        /// Name of the prismatic joint or slot.
        #[schemars(extend("x-reference" = "joint"))]
        joint: String,
    },
}

/// A law of time f(t), SI (driven dimension, s, Hz, rad).
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(tag = "type", rename_all = "snake_case")]
pub enum Motion {
    /// Σ c_k t^k.
    Polynomial {
        /// c₀, c₁, c₂ …; a plain c_k is in the driven dimension's unit per second^k.
        #[schemars(schema_with = "schema::driven_coefficients")]
        coefficients: Vec<f64>,
    },
    /// offset + amplitude·sin(2π·frequency·t + phase).
    Harmonic {
        #[serde(default)]
        #[schemars(schema_with = "schema::driven")]
        offset: f64,
        #[schemars(schema_with = "schema::driven")]
        amplitude: f64,
        /// \[Hz\]
        #[schemars(schema_with = "schema::frequency")]
        frequency: f64,
        /// \[rad\]
        #[serde(default)]
        #[schemars(schema_with = "schema::angle")]
        phase: f64,
    },
    /// Cubic spline through (t, value); times strictly increasing, at least two.
    Table {
        /// [[t, value], …]
        #[schemars(schema_with = "schema::driven_table")]
        points: Vec<[f64; 2]>,
    },
    /// start + velocity·t.
    ConstantVelocity {
        #[serde(default)]
        #[schemars(schema_with = "schema::driven")]
        start: f64,
        #[schemars(schema_with = "schema::driven_velocity")]
        velocity: f64,
    },
    /// start + velocity·t + acceleration·t²/2.
    ConstantAcceleration {
        #[serde(default)]
        #[schemars(schema_with = "schema::driven")]
        start: f64,
        #[serde(default)]
        #[schemars(schema_with = "schema::driven_velocity")]
        velocity: f64,
        #[schemars(schema_with = "schema::driven_acceleration")]
        acceleration: f64,
    },
}
