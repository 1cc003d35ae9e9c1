//! The numbers of drivers' motions that have derivatives.
//!
//! A motion is linear in most of its numbers: with one of them 1 and the others 0 it is its own derivative. Of A sin(2πνt + φ) the
//! phase has the slope A sin(2πνt + φ + π/2), and the frequency 2πt times that.

use super::super::geometry::{Dimension, Dimensions};
use linkdyn_engine::system::compile::law;
use linkdyn_model::{Interpolation, Model, Motion};
use std::f64::consts::{FRAC_PI_2, TAU};

/// The numbers of a motion that stand in the file and have derivatives, in the order of [`add_motions`].
pub(super) fn motion_values(motion: &Motion) -> Vec<f64> {
    let mut own = motion.clone();
    let mut values: Vec<f64> = linear(&mut own)
        .into_iter()
        .map(|(_, value)| *value)
        .collect();
    if let Motion::Harmonic {
        frequency, phase, ..
    } = motion
    {
        values.extend([phase, frequency]);
    }
    values
}

/// The numbers in which a motion is linear, with their keys: values, but no times. Where a rise is as fast as its limits allow, its
/// duration follows from how far it goes, and the values of a monotone table weigh each other; there are none then.
fn linear(motion: &mut Motion) -> Vec<(String, &mut f64)> {
    let named = |name: &str, number| (name.to_owned(), number);
    match motion {
        Motion::Polynomial { coefficients } => {
            let coefficients = coefficients.iter_mut().enumerate();
            coefficients
                .map(|(k, own)| (format!("coefficients[{k}]"), own))
                .collect()
        }
        Motion::ConstantVelocity { start, velocity } => {
            vec![named("start", start), named("velocity", velocity)]
        }
        Motion::ConstantAcceleration {
            start,
            velocity,
            acceleration,
        } => vec![
            named("start", start),
            named("velocity", velocity),
            named("acceleration", acceleration),
        ],
        Motion::Harmonic {
            offset, amplitude, ..
        } => vec![named("offset", offset), named("amplitude", amplitude)],
        Motion::Table {
            interpolation: Interpolation::Monotone,
            ..
        } => Vec::new(),
        Motion::Table { points, .. } => {
            let points = points.iter_mut().enumerate();
            points
                .map(|(k, [_, value])| (format!("points[{k}][1]"), value))
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
            let mut all = vec![named("start", start)];
            for (k, part) in segments.iter_mut().enumerate() {
                all.extend(given(
                    &format!("segments[{k}]."),
                    &mut part.rise,
                    &mut part.end,
                ));
            }
            all
        }
    }
}

fn of_rise<'m>(
    start: &'m mut f64,
    rise: &'m mut Option<f64>,
    end: &'m mut Option<f64>,
) -> Vec<(String, &'m mut f64)> {
    let mut all = vec![("start".to_owned(), start)];
    all.extend(given("", rise, end));
    all
}

/// How far a rise goes, as the file says it.
fn given<'m>(
    path: &str,
    rise: &'m mut Option<f64>,
    end: &'m mut Option<f64>,
) -> impl Iterator<Item = (String, &'m mut f64)> {
    let both = [("rise", rise), ("end", end)].into_iter();
    both.filter_map(move |(key, number)| Some((format!("{path}{key}"), number.as_mut()?)))
}

pub(super) fn add_motions(found: &mut Dimensions, model: &Model) {
    for (driver, (name, data)) in model.drivers.iter().enumerate() {
        let mut add = |key: &str, slope: &Motion, by_time: bool, is_linear: bool| {
            let slope = law(slope);
            let dimension = found.add(Dimension::Motion {
                driver,
                slope,
                by_time,
                is_linear,
            });
            found.tell(format!("drivers.{name}.motion.{key}"), dimension, 1.0);
        };
        let mut still = data.motion.clone();
        let keys = linear(&mut still).into_iter().map(|(key, number)| {
            *number = 0.0;
            key
        });
        let keys: Vec<String> = keys.collect();
        for (k, key) in keys.iter().enumerate() {
            let mut unit = still.clone();
            if let Some((_, number)) = linear(&mut unit).into_iter().nth(k) {
                *number = 1.0;
            }
            add(key, &unit, false, true);
        }
        if let &Motion::Harmonic {
            amplitude,
            frequency,
            phase,
            ..
        } = &data.motion
        {
            let slope = |amplitude: f64| Motion::Harmonic {
                offset: 0.0,
                amplitude,
                frequency,
                phase: phase + FRAC_PI_2,
            };
            add("phase", &slope(amplitude), false, false);
            add("frequency", &slope(TAU * amplitude), true, false);
        }
    }
}
