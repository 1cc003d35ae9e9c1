//! Bodies: points, mass, pose guess, and initial values.

mod words;

use indexmap::IndexMap;
use serde::{Deserialize, Serialize};

/// A rigid body. `ground` has only points.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(from = "words::BodyWords")]
pub struct Body {
    /// Mass \[kg\].
    pub mass: Option<f64>,
    /// Moment of inertia about the centre of mass [kg·m²].
    pub inertia: Option<f64>,
    /// Centre of mass in the body's frame \[m\]; has no default where there is mass.
    pub com: Option<[f64; 2]>,
    /// Named points in the body's frame \[m\].
    pub points: IndexMap<String, [f64; 2]>,
    /// Diameters of the position tolerance zones of those points that have one \[m\].
    #[doc(hidden)]
    pub point_tolerances: IndexMap<String, f64>,
    /// Where the body's frame is guessed to be.
    pub pose: Pose,
}

/// Guess of a body frame's place for the assembly.
#[derive(Debug, Clone, Copy, PartialEq, Default, Deserialize, Serialize)]
#[serde(default)]
pub struct Pose {
    /// Origin \[m\].
    pub position: [f64; 2],
    /// Angle \[rad\].
    pub angle: f64,
}

/// Exact values at t = 0 of a body's coordinates (frame origin) and velocities.
#[derive(Debug, Clone, Copy, PartialEq, Default, Deserialize, Serialize)]
#[serde(default)]
pub struct Initial {
    /// Frame origin \[m\].
    pub x: Option<f64>,
    /// Frame origin \[m\].
    pub y: Option<f64>,
    /// Angle \[rad\].
    pub angle: Option<f64>,
    /// Velocity of the frame origin [m/s].
    pub vx: Option<f64>,
    /// Velocity of the frame origin [m/s].
    pub vy: Option<f64>,
    /// Angular velocity [rad/s].
    pub angular_velocity: Option<f64>,
    /// How it turns, by the others, on the branch of motion on which a singular start is left.
    #[doc(hidden)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub branch: Option<f64>,
}
