//! Degrees and radians taken for each other.

use std::f64::consts::{PI, TAU};

use super::bodies::{DIGITS, moving};
use linkdyn_model::display::number;
use linkdyn_model::error::Complaint;
use linkdyn_model::{DriverKind, JointKind, Model, Motion};

/// Angles of a drawing beyond this are degrees taken for radians \[rad\].
const MOST_TURNED: f64 = 4.0 * PI;
/// Angles that are written in radians, as fractions of π.
const FRACTIONS: [f64; 10] = [
    1.0 / 6.0,
    0.25,
    1.0 / 3.0,
    0.5,
    2.0 / 3.0,
    0.75,
    5.0 / 6.0,
    1.0,
    1.5,
    2.0,
];
/// How near to one of them a number of degrees must be: 6.28, 1.57 and 0.785 are [–].
const NEAR_FRACTION: f64 = 6e-4;
/// The same for other multiples of π/6, which lie closer: 104.72 (1000 rpm) is [–].
const NEAR_MULTIPLE: f64 = 1e-5;
/// Multiples of π above this, the speed of 3000 rpm, lie too close to be told from other numbers.
const MOST_MULTIPLE: f64 = 100.0;

/// Angles of the drawing and of drivers that look like a slip.
pub(super) fn angles(model: &Model, degrees: bool, found: &mut Vec<Complaint>) {
    let mut look = |path: String, angle: f64| {
        let shown = angle * 180.0 / PI;
        if angle.abs() > MOST_TURNED {
            let message = format!(
                "the angle is {} rad, {} turns",
                number(angle, DIGITS),
                number(angle.abs() / TAU, DIGITS)
            );
            let hint = "for degrees write \"60 deg\", or name \"angle\": \"deg\" in units";
            found.push(Complaint::new(path, message).hint(hint));
        } else if degrees
            && FRACTIONS
                .iter()
                .any(|part| near(shown.abs() / PI, *part, NEAR_FRACTION))
        {
            let message = format!(
                "the angle is {} deg, which looks like radians",
                number(shown, DIGITS)
            );
            found.push(
                Complaint::new(path, message)
                    .hint("plain angles are in degrees here; write \"1.5708 rad\""),
            );
        }
    };
    for (name, body) in moving(model) {
        look(format!("bodies.{name}.pose.angle"), body.pose.angle);
    }
    for (name, joint) in &model.joints {
        if let JointKind::Prismatic { angle, .. } | JointKind::Fixed { angle } = joint.kind {
            look(format!("joints.{name}.angle"), angle);
        }
    }
    for (name, initial) in &model.initial {
        if let Some(angle) = initial.angle {
            look(format!("initial.{name}.angle"), angle);
        }
    }
    for (name, driver) in &model.drivers {
        let start = match (&driver.kind, &driver.motion) {
            (
                DriverKind::Translation { .. }
                | DriverKind::Length { .. }
                | DriverKind::Point { .. },
                _,
            ) => continue,
            (DriverKind::Rotation { .. }, Motion::Polynomial { coefficients }) => coefficients
                .first()
                .map(|start| ("coefficients[0]", *start)),
            (
                DriverKind::Rotation { .. },
                Motion::ConstantVelocity { start, .. } | Motion::ConstantAcceleration { start, .. },
            ) => Some(("start", *start)),
            (DriverKind::Rotation { .. }, Motion::Harmonic { .. } | Motion::Table { .. }) => None,
            (
                DriverKind::Rotation { .. },
                Motion::Cycloidal(rise)
                | Motion::Polynomial345(rise)
                | Motion::Polynomial4567(rise)
                | Motion::ModifiedSine(rise)
                | Motion::ModifiedTrapezoid(rise),
            ) => Some(("start", rise.start)),
            (
                DriverKind::Rotation { .. },
                Motion::TrapezoidalVelocity(rise) | Motion::SCurve(rise),
            ) => Some(("start", rise.start)),
            (DriverKind::Rotation { .. }, Motion::Sequence { start, .. }) => {
                Some(("start", *start))
            }
        };
        if let Some((key, start)) = start {
            look(format!("drivers.{name}.motion.{key}"), start);
        }
    }
    if degrees {
        radians(model, found);
    }
}

/// Driven angles whose number of degrees is one of radians.
fn radians(model: &Model, found: &mut Vec<Complaint>) {
    for (name, driver) in &model.drivers {
        if !matches!(driver.kind, DriverKind::Rotation { .. }) {
            continue;
        }
        let looked: Vec<(String, f64, &str)> = match &driver.motion {
            // The first value is looked at like the angles of a drawing.
            Motion::Polynomial { coefficients } => {
                (coefficients.iter().zip(RATES).enumerate().skip(1))
                    .map(|(k, (value, per))| (format!("coefficients[{k}]"), *value, per))
                    .collect()
            }
            Motion::Harmonic {
                offset, amplitude, ..
            } => {
                vec![
                    ("offset".into(), *offset, RATES[0]),
                    ("amplitude".into(), *amplitude, RATES[0]),
                ]
            }
            Motion::Table { points, .. } => travel(points)
                .map(|travel| ("points".into(), travel, RATES[0]))
                .to_vec(),
            Motion::ConstantVelocity { velocity, .. } => {
                vec![("velocity".into(), *velocity, RATES[1])]
            }
            Motion::ConstantAcceleration {
                velocity,
                acceleration,
                ..
            } => {
                vec![
                    ("velocity".into(), *velocity, RATES[1]),
                    ("acceleration".into(), *acceleration, RATES[2]),
                ]
            }
            Motion::Cycloidal(rise)
            | Motion::Polynomial345(rise)
            | Motion::Polynomial4567(rise)
            | Motion::ModifiedSine(rise)
            | Motion::ModifiedTrapezoid(rise) => heights("", rise.rise, rise.end),
            Motion::TrapezoidalVelocity(rise) | Motion::SCurve(rise) => {
                let limits = [
                    ("velocity", rise.velocity, RATES[1]),
                    ("acceleration", rise.acceleration, RATES[2]),
                ];
                let limits = limits.into_iter();
                let limits = limits.filter_map(|(key, value, per)| Some((key.into(), value?, per)));
                let heights = heights("", rise.rise, rise.end);
                heights.into_iter().chain(limits).collect()
            }
            Motion::Sequence { segments, .. } => {
                let parts = segments.iter().enumerate();
                parts
                    .flat_map(|(index, part)| {
                        heights(&format!("segments[{index}]."), part.rise, part.end)
                    })
                    .collect()
            }
        };
        let odd = looked
            .iter()
            .find(|(_, value, _)| looks_like_radians(value.to_degrees()));
        found.extend(odd.map(|(key, value, per)| {
            let degrees = value.to_degrees();
            let shown: f64 = format!("{degrees:.6}").parse().unwrap_or(degrees);
            let what = if key == "points" {
                "the motion goes over"
            } else {
                "this is"
            };
            let message = format!("{what} {shown} deg{per}, which looks like radians");
            let hint = format!(
                "plain numbers are in degrees here; write degrees, or text with the unit rad{per}"
            );
            Complaint::new(format!("drivers.{name}.motion.{key}"), message).hint(hint)
        }));
    }
}

/// How far a rise goes, with its key.
fn heights(path: &str, rise: Option<f64>, end: Option<f64>) -> Vec<(String, f64, &'static str)> {
    let given = [("rise", rise), ("end", end)].into_iter();
    given
        .filter_map(|(key, value)| Some((format!("{path}{key}"), value?, RATES[0])))
        .collect()
}

/// The unit of time of a derivative, by its order.
const RATES: [&str; 3] = ["", "/s", "/s^2"];

/// From the first value of a table to the last, and from the least to the greatest.
fn travel(points: &[[f64; 2]]) -> [f64; 2] {
    let values = || points.iter().map(|point| point[1]);
    let ends = points
        .first()
        .zip(points.last())
        .map_or(0.0, |(first, last)| last[1] - first[1]);
    [
        ends,
        values().fold(f64::NEG_INFINITY, f64::max) - values().fold(f64::INFINITY, f64::min),
    ]
}

/// Whether a number of degrees is a usual fraction or multiple of π, and no whole number.
fn looks_like_radians(degrees: f64) -> bool {
    let multiple = degrees.abs() / PI;
    // Turned into radians and back, a whole number is off by round-off.
    let whole = (degrees - degrees.round()).abs() <= 1e-9 * degrees.abs();
    let sixth = (6.0 * multiple).round() / 6.0;
    let large = (2.0..=MOST_MULTIPLE).contains(&multiple) && near(multiple, sixth, NEAR_MULTIPLE);
    !whole
        && (large
            || FRACTIONS
                .iter()
                .any(|&fraction| near(multiple, fraction, NEAR_FRACTION)))
}

fn near(multiple: f64, wanted: f64, within: f64) -> bool {
    (multiple - wanted).abs() <= within * wanted
}
