//! What the steppers share: the norm of errors, the first step, and how steps are fitted to the end.

use super::{Limits, Ode, Refused, StepFailure, Tolerance};

/// Attempts at one step before it fails; halving comes from 1 to 1e-30 in as many.
pub(super) const ATTEMPTS: usize = 100;

/// A step that misses the end by less than this part of itself is stretched.
const STRETCH: f64 = 1.01;

/// First step where f tells nothing, rates that tell nothing, and second derivatives that are none, all by the unit of a
/// first step.
const FIRST: f64 = 1e-6;
const SLOW: f64 = 1e-5;
const STRAIGHT: f64 = 1e-15;

/// Units of a first step are powers of this: a first step need be known by its order alone, and steps of motions that last some
/// milliseconds or some minutes are chosen in seconds.
const UNITS: f64 = 1_048_576.0;

/// √(Σ (eᵢ wᵢ)² / n) for errors e and weights w.
pub(super) fn rms(errors: &[f64], weights: &[f64]) -> f64 {
    let sum: f64 = errors
        .iter()
        .zip(weights)
        .map(|(e, w)| (e * w) * (e * w))
        .sum();
    (sum / errors.len() as f64).sqrt()
}

/// w = 1 / (atol + rtol |y|), |y| capped.
pub(super) fn weigh(tolerance: &Tolerance, y: &[f64], weights: &mut [f64]) {
    for (i, (w, y)) in weights.iter_mut().zip(y).enumerate() {
        *w = 1.0 / tolerance.bound(i, *y);
    }
}

/// Whether all values are finite.
pub(super) fn finite(values: &[f64]) -> Result<(), Refused> {
    if values.iter().all(|v| v.is_finite()) {
        Ok(())
    } else {
        Err(Refused)
    }
}

/// The next step with its sign: `h` bounded by the longest step, and fitted to `end`.
///
/// What reaches the end nearly is stretched to it; what leaves less than another step is halved instead, so that no
/// crumb remains. The flag says that the step ends at `end`.
pub(super) fn fit(t: f64, h: f64, end: f64, limits: &Limits) -> (f64, bool) {
    let left = end - t;
    let longest = limits.max_step.unwrap_or(f64::INFINITY);
    let h = h.abs().min(longest);
    if left.abs() <= (STRETCH * h).min(longest) {
        (left, true)
    } else if left.abs() < 2.0 * h {
        (0.5 * left, false)
    } else {
        (h.copysign(left), false)
    }
}

/// The shortest step from t.
pub(super) fn shortest(t: f64, limits: &Limits) -> f64 {
    (10.0 * f64::EPSILON * t.abs())
        .max(limits.min_step.unwrap_or(0.0))
        .max(f64::MIN_POSITIVE)
}

/// Why a step was rejected.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Rejection {
    /// Its error was too large, or Newton's iteration did not converge.
    Error,
    /// A point was refused.
    Refused,
}

/// What becomes of integration where no step from t is left, the last one of length h.
pub(super) fn failure(rejection: Rejection, t: f64, h: f64) -> StepFailure {
    match rejection {
        Rejection::Error => StepFailure::TooSmall { t, h: h.abs() },
        Rejection::Refused => StepFailure::Refused { t },
    }
}

/// ⁴√x, the same everywhere.
pub(super) fn fourth_root(x: f64) -> f64 {
    x.sqrt().sqrt()
}

/// ⁸√x, the same everywhere.
pub(super) fn eighth_root(x: f64) -> f64 {
    x.sqrt().sqrt().sqrt()
}

/// Room for choosing a first step, each (n), and the root that the method's estimate asks for.
pub(super) struct Probe<'a> {
    /// Root of the method's order.
    pub root: fn(f64) -> f64,
    /// Weights of the errors (n).
    pub weights: &'a [f64],
    /// Room for an argument (n).
    pub y: &'a mut [f64],
    /// Room for a slope (n).
    pub dy: &'a mut [f64],
}

/// The power of [`UNITS`] that is nearest to a pace.
fn unit(pace: f64) -> f64 {
    let mut unit = 1.0;
    if !pace.is_normal() {
        return unit;
    }
    while unit * UNITS.sqrt() < pace {
        unit *= UNITS;
    }
    while unit > pace * UNITS.sqrt() {
        unit /= UNITS;
    }
    unit
}

/// Length of a first step (Hairer, Nørsett and Wanner, 1993, §II.4).
///
/// An Euler step that changes y by a hundredth gives |y″|; then hᵖ · max(|y′|, |y″|) = 0.01, where t is measured in units near
/// the pace of y. `dy` is f(t, y); the second result counts evaluations.
pub(super) fn first_step(
    ode: &mut dyn Ode,
    t: f64,
    y: &[f64],
    dy: &[f64],
    end: f64,
    limits: &Limits,
    probe: Probe,
) -> (f64, u64) {
    let longest = (end - t)
        .abs()
        .min(limits.max_step.unwrap_or(f64::INFINITY));
    if let Some(h) = limits.initial_step {
        return (h.abs().min(longest), 0);
    }
    let unit = unit(limits.pace.unwrap_or(1.0));
    let (size, slope) = (rms(y, probe.weights), rms(dy, probe.weights));
    let mut h = if size < SLOW || slope * unit < SLOW {
        FIRST * unit
    } else {
        0.01 * size / slope
    };
    h = h.min(longest);
    for evaluations in 1..=20 {
        let signed = h.copysign(end - t);
        for ((to, y), dy) in probe.y.iter_mut().zip(y).zip(dy) {
            *to = y + signed * dy;
        }
        if ode
            .eval(t + signed, probe.y, probe.dy)
            .and_then(|()| finite(probe.dy))
            .is_ok()
        {
            for (next, dy) in probe.dy.iter_mut().zip(dy) {
                *next -= dy;
            }
            let change = rms(probe.dy, probe.weights) * unit;
            let steepest = (slope * unit).max(change / (h / unit));
            let second = if steepest <= STRAIGHT {
                (1e-3 * h).max(FIRST * unit)
            } else {
                (probe.root)(0.01 / steepest) * unit
            };
            return (second.min(100.0 * h).min(longest), evaluations);
        }
        h *= 0.1;
    }
    (h, 20)
}
