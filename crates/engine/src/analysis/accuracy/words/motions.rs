//! The numbers of drivers' motions that have derivatives.

use super::super::dimensions::{Dimension, Dimensions, MotionNumber};
use crate::motion::Law;
use crate::system::compile::law;
use linkdyn_model::{Interpolation, Model, Motion};

/// The numbers of a motion that stand in the file and have derivatives, in the order of [`add_motions`].
pub(super) fn motion_values(motion: &Motion) -> Vec<f64> {
    match motion {
        Motion::Polynomial { coefficients } => coefficients.clone(),
        Motion::ConstantVelocity { start, velocity } => vec![*start, *velocity],
        Motion::ConstantAcceleration {
            start,
            velocity,
            acceleration,
        } => vec![*start, *velocity, *acceleration],
        Motion::Harmonic {
            offset,
            amplitude,
            frequency,
            phase,
        } => vec![*offset, *amplitude, *phase, *frequency],
        Motion::Table { .. }
        | Motion::Cycloidal(_)
        | Motion::Polynomial345(_)
        | Motion::Polynomial4567(_)
        | Motion::ModifiedSine(_)
        | Motion::ModifiedTrapezoid(_)
        | Motion::TrapezoidalVelocity(_)
        | Motion::SCurve(_)
        | Motion::Sequence { .. } => {
            let mut motion = motion.clone();
            let numbers = linear_numbers(&mut motion);
            numbers.into_iter().map(|(_, value)| *value).collect()
        }
    }
}

/// The numbers in which a table, a rise or a sequence is linear, with their keys: values, but no times. Where a rise is as fast as
/// its limits allow, its duration follows from how far it goes, and the values of a monotone table weigh each other; there are
/// none then.
fn linear_numbers(motion: &mut Motion) -> Vec<(String, &mut f64)> {
    match motion {
        Motion::Polynomial { .. }
        | Motion::Harmonic { .. }
        | Motion::ConstantVelocity { .. }
        | Motion::ConstantAcceleration { .. } => Vec::new(),
        Motion::Table {
            interpolation: Interpolation::Monotone,
            ..
        } => Vec::new(),
        Motion::Table { points, .. } => {
            let points = points.iter_mut().enumerate();
            points
                .map(|(index, [_, value])| (format!("points[{index}][1]"), value))
                .collect()
        }
        Motion::Cycloidal(rise)
        | Motion::Polynomial345(rise)
        | Motion::Polynomial4567(rise)
        | Motion::ModifiedSine(rise)
        | Motion::ModifiedTrapezoid(rise) => {
            of_rise(&mut rise.start, &mut rise.rise, &mut rise.end)
        }
        Motion::TrapezoidalVelocity(rise) | Motion::SCurve(rise) => match rise.duration {
            Some(_) => of_rise(&mut rise.start, &mut rise.rise, &mut rise.end),
            None => Vec::new(),
        },
        Motion::Sequence {
            start, segments, ..
        } => {
            let parts = segments.iter_mut().enumerate().flat_map(|(index, part)| {
                let numbers = [("rise", &mut part.rise), ("end", &mut part.end)];
                numbers.into_iter().filter_map(move |(key, number)| {
                    let number = number.as_mut()?;
                    Some((format!("segments[{index}].{key}"), number))
                })
            });
            [("start".to_owned(), start)]
                .into_iter()
                .chain(parts)
                .collect()
        }
    }
}

fn of_rise<'m>(
    start: &'m mut f64,
    rise: &'m mut Option<f64>,
    end: &'m mut Option<f64>,
) -> Vec<(String, &'m mut f64)> {
    let given = [("rise", rise), ("end", end)].into_iter();
    let given = given.filter_map(|(key, number)| Some((key.to_owned(), number.as_mut()?)));
    [("start".to_owned(), start)]
        .into_iter()
        .chain(given)
        .collect()
}

/// The derivatives by these numbers: with one of them 1 and the others 0, the motion is its own derivative.
fn linear_slopes(motion: &Motion) -> Vec<(String, Law)> {
    let mut still = motion.clone();
    let numbers = linear_numbers(&mut still).into_iter();
    let keys: Vec<String> = numbers
        .map(|(key, number)| {
            *number = 0.0;
            key
        })
        .collect();
    let slopes = keys.into_iter().enumerate().map(|(index, key)| {
        let mut unit = still.clone();
        for (_, number) in linear_numbers(&mut unit).into_iter().skip(index).take(1) {
            *number = 1.0;
        }
        (key, law(&unit))
    });
    slopes.collect()
}

pub(super) fn add_motions(found: &mut Dimensions, model: &Model) {
    for (driver, (name, data)) in model.drivers.iter().enumerate() {
        let mut add = |key: &str, number: MotionNumber| {
            let dimension = found.add(Dimension::Motion { driver, number });
            found.tell(format!("drivers.{name}.motion.{key}"), dimension, 1.0);
        };
        let power = |exponent: i32, factor: f64| MotionNumber::Power { exponent, factor };
        match &data.motion {
            Motion::Polynomial { coefficients } => {
                for k in 0..coefficients.len() {
                    add(&format!("coefficients[{k}]"), power(k as i32, 1.0));
                }
            }
            Motion::ConstantVelocity { .. } => {
                add("start", power(0, 1.0));
                add("velocity", power(1, 1.0));
            }
            Motion::ConstantAcceleration { .. } => {
                add("start", power(0, 1.0));
                add("velocity", power(1, 1.0));
                add("acceleration", power(2, 0.5));
            }
            &Motion::Harmonic {
                amplitude,
                frequency,
                phase,
                ..
            } => {
                let (by_phase, by_frequency) = (
                    MotionNumber::Phase {
                        amplitude,
                        frequency,
                        phase,
                    },
                    MotionNumber::Frequency {
                        amplitude,
                        frequency,
                        phase,
                    },
                );
                add("offset", power(0, 1.0));
                add("amplitude", MotionNumber::Amplitude { frequency, phase });
                add("phase", by_phase);
                add("frequency", by_frequency);
            }
            Motion::Table { .. }
            | Motion::Cycloidal(_)
            | Motion::Polynomial345(_)
            | Motion::Polynomial4567(_)
            | Motion::ModifiedSine(_)
            | Motion::ModifiedTrapezoid(_)
            | Motion::TrapezoidalVelocity(_)
            | Motion::SCurve(_)
            | Motion::Sequence { .. } => {
                for (key, slope) in linear_slopes(&data.motion) {
                    add(&key, MotionNumber::Value(slope));
                }
            }
        }
    }
}
