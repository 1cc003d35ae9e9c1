//! Laws of motions and of values that vary.

use crate::motion::{Law, Spline};
use linkdyn_model::{Motion, Value};

/// A motion's law.
pub fn law(motion: &Motion) -> Law {
    match motion {
        Motion::Polynomial { coefficients } => Law::Polynomial(coefficients.clone()),
        Motion::Harmonic {
            offset,
            amplitude,
            frequency,
            phase,
        } => Law::Harmonic {
            offset: *offset,
            amplitude: *amplitude,
            frequency: *frequency,
            phase: *phase,
        },
        Motion::Table { points } => Law::Spline(Spline::natural(points)),
        Motion::ConstantVelocity { start, velocity } => Law::Polynomial(vec![*start, *velocity]),
        Motion::ConstantAcceleration {
            start,
            velocity,
            acceleration,
        } => Law::Polynomial(vec![*start, *velocity, 0.5 * acceleration]),
    }
}

/// The law of a value that may vary.
pub fn value_law(value: &Value) -> Law {
    match value {
        Value::Constant(value) => Law::Polynomial(vec![*value]),
        Value::Motion(motion) => law(motion),
        // the gate lets these stand only where a force is wanted
        Value::Formula(_) => Law::Polynomial(vec![0.0]),
    }
}
