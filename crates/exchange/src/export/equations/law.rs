//! Laws of time that are written as formulas.

use std::f64::consts::TAU;

use linkdyn_model::{Motion, Value};

/// A law of time, in SI units.
#[derive(Debug, Clone, PartialEq)]
pub enum TimeLaw {
    /// Coefficients of 1, t, t² …
    Polynomial(Vec<f64>),
    /// offset + amplitude sin(rate t + phase), the rate in rad/s.
    Harmonic([f64; 4]),
}

impl TimeLaw {
    /// That of a motion; none of one that is made of pieces.
    pub fn of_motion(motion: &Motion) -> Option<TimeLaw> {
        match motion {
            Motion::Polynomial { coefficients } => Some(TimeLaw::Polynomial(coefficients.clone())),
            &Motion::ConstantVelocity { start, velocity } => {
                Some(TimeLaw::Polynomial(vec![start, velocity]))
            }
            &Motion::ConstantAcceleration {
                start,
                velocity,
                acceleration,
            } => Some(TimeLaw::Polynomial(vec![
                start,
                velocity,
                acceleration / 2.0,
            ])),
            &Motion::Harmonic {
                offset,
                amplitude,
                frequency,
                phase,
            } => Some(TimeLaw::Harmonic([
                offset,
                amplitude,
                TAU * frequency,
                phase,
            ])),
            Motion::Table { .. }
            | Motion::Cycloidal(_)
            | Motion::Polynomial345(_)
            | Motion::Polynomial4567(_)
            | Motion::ModifiedSine(_)
            | Motion::ModifiedTrapezoid(_)
            | Motion::TrapezoidalVelocity(_)
            | Motion::SCurve(_)
            | Motion::Sequence { .. } => None,
        }
    }

    /// That of a value; none of one that depends on the motion.
    pub fn of_value(value: &Value) -> Option<TimeLaw> {
        match value {
            Value::Constant(value) => Some(TimeLaw::Polynomial(vec![*value])),
            Value::Motion(motion) => TimeLaw::of_motion(motion),
            Value::Formula(_) => None,
        }
    }

    /// Its numbers.
    pub fn numbers(&self) -> &[f64] {
        match self {
            TimeLaw::Polynomial(coefficients) => coefficients,
            TimeLaw::Harmonic(numbers) => numbers,
        }
    }

    /// The same, less a constant.
    #[must_use]
    pub fn less(mut self, constant: f64) -> TimeLaw {
        match &mut self {
            TimeLaw::Polynomial(coefficients) => match coefficients.first_mut() {
                Some(first) => *first -= constant,
                None => coefficients.push(-constant),
            },
            TimeLaw::Harmonic([offset, ..]) => *offset -= constant,
        }
        self
    }

    /// Its derivative.
    #[must_use]
    pub fn derivative(&self) -> TimeLaw {
        match self {
            TimeLaw::Polynomial(coefficients) => {
                let powers = coefficients.iter().enumerate().skip(1);
                TimeLaw::Polynomial(powers.map(|(power, c)| power as f64 * c).collect())
            }
            // cos x = sin(x + π/2)
            TimeLaw::Harmonic([_, amplitude, rate, phase]) => {
                TimeLaw::Harmonic([0.0, amplitude * rate, *rate, phase + TAU / 4.0])
            }
        }
    }

    /// Its value, where that does not vary.
    pub fn constant(&self) -> Option<f64> {
        match self {
            TimeLaw::Polynomial(coefficients) => {
                let varies = coefficients.iter().skip(1).any(|c| *c != 0.0);
                (!varies).then(|| coefficients.first().copied().unwrap_or_default())
            }
            TimeLaw::Harmonic([offset, amplitude, ..]) => (*amplitude == 0.0).then_some(*offset),
        }
    }
}
