//! Bodies: points, mass, pose guess, and initial values.

use indexmap::IndexMap;

/// A rigid body. `ground` has only points.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Body {
    /// Mass [kg].
    pub mass: Option<f64>,
    /// Moment of inertia about the centre of mass [kg·m²].
    pub inertia: Option<f64>,
    /// Centre of mass in the body's frame [m].
    pub com: Option<[f64; 2]>,
    /// Named points in the body's frame [m].
    pub points: IndexMap<String, [f64; 2]>,
    /// Where the body's frame is guessed to be.
    pub pose: Pose,
}

/// Guess of a body frame's place for the assembly.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Pose {
    /// Origin [m].
    pub position: [f64; 2],
    /// Angle [rad].
    pub angle: f64,
}

/// Exact values at t = 0 of a body's coordinates (frame origin) and velocities.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Initial {
    pub x: Option<f64>,
    pub y: Option<f64>,
    pub angle: Option<f64>,
    pub vx: Option<f64>,
    pub vy: Option<f64>,
    pub angular_velocity: Option<f64>,
}
