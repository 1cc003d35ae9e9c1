//! Bodies: points, mass, pose guess, and initial values.

use indexmap::IndexMap;
use schemars::JsonSchema;
use serde::Deserialize;

use super::schema;

/// A rigid body. `ground` has only points.
#[derive(Debug, Clone, PartialEq, Default, Deserialize, JsonSchema)]
pub struct Body {
    /// Mass \[kg\].
    #[serde(default)]
    #[schemars(schema_with = "schema::mass", extend("minimum" = 0))]
    pub mass: Option<f64>,
    /// Moment of inertia about the centre of mass [kg·m²].
    #[serde(default)]
    #[schemars(schema_with = "schema::inertia", extend("minimum" = 0))]
    pub inertia: Option<f64>,
    /// Centre of mass in the body's frame \[m\]; has no default where there is mass.
    #[serde(default)]
    #[schemars(schema_with = "schema::length_pair")]
    pub com: Option<[f64; 2]>,
    /// Named points in the body's frame \[m\].
    #[serde(default)]
    #[schemars(schema_with = "schema::length_pairs")]
    pub points: IndexMap<String, [f64; 2]>,
    /// Where the body's frame is guessed to be.
    #[serde(default)]
    pub pose: Pose,
}

/// The reserved, fixed body: it has only points.
#[derive(JsonSchema)]
#[schemars(extend("x-refused" = {
    "mass": "ground is fixed, a mass of it would mean nothing",
    "inertia": "ground is fixed, an inertia of it would mean nothing",
    "com": "ground is fixed, a centre of mass of it would mean nothing",
    "pose": "ground is fixed, its frame is the global one"
}))]
pub struct Ground {
    /// Named points in global coordinates \[m\].
    #[serde(default)]
    #[schemars(schema_with = "schema::length_pairs")]
    pub points: IndexMap<String, [f64; 2]>,
}

/// Guess of a body frame's place for the assembly.
#[derive(Debug, Clone, Copy, PartialEq, Default, Deserialize, JsonSchema)]
#[serde(default)]
pub struct Pose {
    /// Origin \[m\].
    #[schemars(schema_with = "schema::length_pair")]
    pub position: [f64; 2],
    /// Angle \[rad\].
    #[schemars(schema_with = "schema::angle")]
    pub angle: f64,
}

/// Exact values at t = 0 of a body's coordinates (frame origin) and velocities.
#[derive(Debug, Clone, Copy, PartialEq, Default, Deserialize, JsonSchema)]
#[serde(default)]
pub struct Initial {
    /// Frame origin \[m\].
    #[schemars(schema_with = "schema::length")]
    pub x: Option<f64>,
    /// Frame origin \[m\].
    #[schemars(schema_with = "schema::length")]
    pub y: Option<f64>,
    /// Angle \[rad\].
    #[schemars(schema_with = "schema::angle")]
    pub angle: Option<f64>,
    /// Velocity of the frame origin [m/s].
    #[schemars(schema_with = "schema::velocity")]
    pub vx: Option<f64>,
    /// Velocity of the frame origin [m/s].
    #[schemars(schema_with = "schema::velocity")]
    pub vy: Option<f64>,
    /// Angular velocity [rad/s].
    #[schemars(schema_with = "schema::angular_velocity")]
    pub angular_velocity: Option<f64>,
}
