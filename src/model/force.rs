//! Springs, torsion springs, forces and torques.

use super::driver::Motion;
use super::joint::PointRef;

/// A value that may vary with time.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    Constant(f64),
    Motion(Motion),
}

/// Frame of a force vector.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Frame {
    #[default]
    Ground,
    Body,
}

/// A force element.
#[derive(Debug, Clone, PartialEq)]
pub struct Force {
    pub kind: ForceKind,
}

/// What acts.
#[derive(Debug, Clone, PartialEq)]
pub enum ForceKind {
    /// Along the line of two points: stiffness [N/m], damping [N·s/m], free length [m].
    Spring { between: [PointRef; 2], stiffness: f64, damping: f64, free_length: Value },
    /// Between two bodies: torque on the first k(θ₂ − θ₁ − θ₀) + c(ω₂ − ω₁), the opposite on the second.
    TorsionSpring { between: [String; 2], stiffness: f64, damping: f64, free_angle: Value },
    /// A force at a point, vector in the ground's or the body's frame [N].
    Load { at: PointRef, vector: [Value; 2], frame: Frame },
    /// A torque [N·m] on a body; `relative_to` takes the opposite.
    Torque { body: String, value: Value, relative_to: Option<String> },
}
