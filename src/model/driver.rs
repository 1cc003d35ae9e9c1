//! Drivers: prescribed motions.

/// A prescribed coordinate.
#[derive(Debug, Clone, PartialEq)]
pub struct Driver {
    pub kind: DriverKind,
    pub motion: Motion,
}

/// Which coordinate is prescribed.
#[derive(Debug, Clone, PartialEq)]
pub enum DriverKind {
    /// Angle of `body`, relative to another body where given (default ground).
    Rotation { body: String, relative_to: Option<String> },
    /// Slide of a prismatic joint, along its axis, first point to second.
    Translation { joint: String },
}

/// A law of time f(t), SI (driven dimension, s, Hz, rad).
#[derive(Debug, Clone, PartialEq)]
pub enum Motion {
    /// Σ c_k t^k.
    Polynomial { coefficients: Vec<f64> },
    /// offset + amplitude·sin(2π·frequency·t + phase).
    Harmonic { offset: f64, amplitude: f64, frequency: f64, phase: f64 },
    /// Cubic spline through (t, value); times strictly increasing, at least two.
    Table { points: Vec<[f64; 2]> },
    /// start + velocity·t.
    ConstantVelocity { start: f64, velocity: f64 },
    /// start + velocity·t + acceleration·t²/2.
    ConstantAcceleration { start: f64, velocity: f64, acceleration: f64 },
}
