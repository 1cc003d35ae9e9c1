//! Laws of motions and of values that vary.

use crate::motion::rise::{self, Limits, Segment, Shape};
use crate::motion::{Law, Pieces, Spline};
use linkdyn_model::{CamSegment, Interpolation, Model, Motion, Paced, Rise, RiseLaw, Value};

/// Share of a rise that a ramp takes where none is said: a third each to speed up, to go on, and to slow down \[–\].
const RAMP: f64 = 1.0 / 3.0;
/// Share of a ramp with jerk where none is said \[–\].
const ROUNDING: f64 = 0.5;

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
        Motion::Table {
            points,
            velocities: Some(slopes),
            ..
        } => Law::Pieces(Pieces::sloped(points, slopes)),
        Motion::Table {
            points,
            interpolation,
            velocities: None,
        } => table(points, *interpolation),
        Motion::ConstantVelocity { start, velocity } => Law::Polynomial(vec![*start, *velocity]),
        Motion::ConstantAcceleration {
            start,
            velocity,
            acceleration,
        } => Law::Polynomial(vec![*start, *velocity, 0.5 * acceleration]),
        Motion::Cycloidal(rise) => plain(rise, RiseLaw::Cycloidal),
        Motion::Polynomial345(rise) => plain(rise, RiseLaw::Polynomial345),
        Motion::Polynomial4567(rise) => plain(rise, RiseLaw::Polynomial4567),
        Motion::ModifiedSine(rise) => plain(rise, RiseLaw::ModifiedSine),
        Motion::ModifiedTrapezoid(rise) => plain(rise, RiseLaw::ModifiedTrapezoid),
        Motion::TrapezoidalVelocity(rise) => paced(rise, RiseLaw::TrapezoidalVelocity),
        Motion::SCurve(rise) => paced(rise, RiseLaw::SCurve),
        Motion::Sequence {
            start,
            begin,
            segments,
            repeat,
        } => {
            let rounds = repeat.unwrap_or(1);
            let segments = parts(*start, segments);
            Law::Pieces(rise::sequence(*start, *begin, &segments, rounds))
        }
    }
}

/// A table, or with another value at one of its points the part of it that follows from there.
pub fn table(points: &[[f64; 2]], interpolation: Interpolation) -> Law {
    match interpolation {
        Interpolation::Natural => Law::Spline(Spline::natural(points)),
        Interpolation::Linear => Law::Pieces(Pieces::linear(points)),
        Interpolation::Monotone => Law::Pieces(Pieces::monotone(points)),
        Interpolation::Periodic => Law::Pieces(Pieces::periodic(points)),
    }
}

fn shape(law: RiseLaw, ramp: Option<f64>, rounding: Option<f64>) -> Shape {
    let ramp = ramp.unwrap_or(RAMP);
    match law {
        RiseLaw::Cycloidal => Shape::Cycloidal,
        RiseLaw::Polynomial345 => Shape::Polynomial345,
        RiseLaw::Polynomial4567 => Shape::Polynomial4567,
        RiseLaw::ModifiedSine => Shape::ModifiedSine,
        RiseLaw::ModifiedTrapezoid => Shape::ModifiedTrapezoid,
        RiseLaw::TrapezoidalVelocity => Shape::Ramps {
            ramp,
            rounding: 0.0,
        },
        RiseLaw::SCurve => Shape::Ramps {
            ramp,
            rounding: rounding.unwrap_or(ROUNDING),
        },
    }
}

fn plain(rise: &Rise, law: RiseLaw) -> Law {
    let segment = Segment {
        shape: Some(shape(law, None, None)),
        height: rise.height(),
        duration: rise.duration,
    };
    Law::Pieces(rise::sequence(rise.start, rise.begin, &[segment], 1))
}

fn paced(rise: &Paced, law: RiseLaw) -> Law {
    let segment = match (rise.duration, rise.velocity, rise.acceleration) {
        (None, Some(velocity), Some(acceleration)) => Limits {
            velocity,
            acceleration,
            jerk: rise.jerk,
        }
        .fastest(rise.height()),
        (duration, ..) => Segment {
            shape: Some(shape(law, rise.ramp, rise.rounding)),
            height: rise.height(),
            duration: duration.unwrap_or(0.0),
        },
    };
    Law::Pieces(rise::sequence(rise.start, rise.begin, &[segment], 1))
}

/// The segments of a sequence, with how far each goes.
fn parts(start: f64, segments: &[linkdyn_model::Segment]) -> Vec<Segment> {
    let mut value = start;
    let parts = segments.iter().map(|segment| {
        let part = match segment.law {
            Some(law) => Segment {
                shape: Some(shape(law, segment.ramp, segment.rounding)),
                height: segment.height(value),
                duration: segment.duration.unwrap_or(0.0),
            },
            None => Segment {
                shape: None,
                height: 0.0,
                duration: segment.dwell.unwrap_or(0.0),
            },
        };
        value += part.height;
        part
    });
    parts.collect()
}

/// The law of a follower over the angle of its cam.
pub fn turn(begin: f64, segments: &[CamSegment]) -> Pieces {
    let mut value = 0.0;
    let parts = segments.iter().map(|segment| {
        let part = Segment {
            shape: (segment.law).map(|law| shape(law, segment.ramp, segment.rounding)),
            height: segment.height(value),
            duration: segment.span(),
        };
        value += part.height;
        part
    });
    rise::turn(begin, &parts.collect::<Vec<_>>())
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

/// All laws of a model that have breaks.
pub fn broken(model: &Model) -> Vec<Law> {
    let drivers = model.drivers.values().map(|driver| law(&driver.motion));
    let forces = model.forces.values().flat_map(|force| {
        let values = force.kind.values().into_iter();
        values.map(|(_, value, _)| value_law(value))
    });
    let all = drivers.chain(forces);
    all.filter(Law::has_breaks).collect()
}
