//! Slips that show only beside the rest of the mechanism: a length or a centre of mass a hundred times off, and driven
//! angles in radians where the file has degrees.

use std::f64::consts::PI;

use crate::analysis::assembly::length_text;
use crate::error::Complaint;
use crate::math::Vec2;
use crate::model::{Body, DriverKind, GROUND, Model, Motion};

/// A length this many times longer or shorter than the middle one is rarely meant; a slip of the unit is a thousand [–].
const LENGTH_SPREAD: f64 = 100.0;
/// Fewer lengths have no middle one that tells which of them is wrong.
const LEAST_LENGTHS: usize = 3;
/// A centre of mass this much nearer to a point than the body is long is mostly on it or far from it [–].
const COM_BESIDE: f64 = 1.0 / 500.0;
/// Millimetres in a metre: how much too small metres are among millimetres [–].
const THOUSAND: f64 = 1000.0;
/// Angles that are written in radians, as fractions of π.
const FRACTIONS: [f64; 10] = [1.0 / 6.0, 0.25, 1.0 / 3.0, 0.5, 2.0 / 3.0, 0.75, 5.0 / 6.0, 1.0, 1.5, 2.0];
/// How near to one of them a number of degrees must be: 6.28, 1.57 and 0.785 are [–].
const NEAR_FRACTION: f64 = 6e-4;
/// The same for other multiples of π/6, which lie closer: 104.72 (1000 rpm) is [–].
const NEAR_MULTIPLE: f64 = 1e-5;
/// Multiples of π above this, the speed of 3000 rpm, lie too close to be told from other numbers.
const MOST_MULTIPLE: f64 = 100.0;

/// What looks like a slip beside the rest of the mechanism; `degrees`: plain angles are in degrees.
pub fn slips(model: &Model, degrees: bool) -> Vec<Complaint> {
    let mut found = Vec::new();
    lengths(model, &mut found);
    if degrees {
        radians(model, &mut found);
    }
    found
}

fn points(body: &Body) -> impl Iterator<Item = Vec2> {
    body.points.values().map(|&point| Vec2::from(point))
}

/// Largest distance of two points of a body [m]; zero where it has one or none.
fn extent(body: &Body) -> f64 {
    let low = points(body).fold(Vec2::repeat(f64::INFINITY), |low, point| low.inf(&point));
    let high = points(body).fold(Vec2::repeat(f64::NEG_INFINITY), |high, point| high.sup(&point));
    if body.points.len() < 2 { 0.0 } else { (high - low).norm() }
}

/// The middle one of the mechanism's lengths: of bodies, from their centres of mass to their points, between their drawn
/// places.
fn middle(model: &Model) -> Option<f64> {
    let mut lengths = Vec::new();
    let mut first = None;
    for (name, body) in &model.bodies {
        lengths.push(extent(body));
        if name == GROUND {
            continue;
        }
        let com = body.com.map(Vec2::from);
        lengths.extend(com.map(|com| points(body).map(|point| (point - com).norm()).fold(0.0, f64::max)));
        let place = Vec2::from(body.pose.position);
        lengths.push((place - *first.get_or_insert(place)).norm());
    }
    lengths.retain(|length| *length > 0.0);
    lengths.sort_by(f64::total_cmp);
    if lengths.len() < LEAST_LENGTHS { None } else { lengths.get((lengths.len() - 1) / 2).copied() }
}

fn lengths(model: &Model, found: &mut Vec<Complaint>) {
    let Some(middle) = middle(model) else { return };
    for (name, body) in &model.bodies {
        let extent = extent(body);
        let long = extent > LENGTH_SPREAD * middle;
        // Points of ground are often close together, by an offset that is meant.
        if long || (extent > 0.0 && extent * LENGTH_SPREAD < middle && name != GROUND) {
            let message = format!(
                "the points are {} apart, {} than most lengths of the mechanism, near {}",
                length_text(extent),
                if long { "much longer" } else { "much shorter" },
                length_text(middle)
            );
            let hint = "check its points and their unit";
            found.push(Complaint::new(format!("bodies.{name}.points"), message).hint(hint));
        } else if let Some(message) = body.com.and_then(|com| stray_com(body, Vec2::from(com), extent, middle)) {
            let hint = "check its numbers and their unit; \"com\" is in the body's frame";
            found.push(Complaint::new(format!("bodies.{name}.com"), message).hint(hint));
        }
    }
}

/// What is odd about a centre of mass.
fn stray_com(body: &Body, com: Vec2, extent: f64, middle: f64) -> Option<String> {
    let (point, nearest) = body
        .points
        .iter()
        .map(|(name, &point)| (name, (Vec2::from(point) - com).norm()))
        .min_by(|a, b| a.1.total_cmp(&b.1))?;
    let reach = extent.max(middle);
    if nearest > LENGTH_SPREAD * reach {
        let (far, reach) = (length_text(nearest), length_text(reach));
        return Some(format!("the centre of mass is {far} from the nearest point, {point}, in a mechanism of {reach}"));
    }
    // A balanced crank has its centre of mass near its pin, but hardly at a thousandth of a place amid its points.
    let amid = points(body).sum::<Vec2>() / body.points.len() as f64;
    let within = (com * THOUSAND - amid).norm() <= 0.25 * extent;
    if nearest > 0.0 && nearest < COM_BESIDE * extent && within {
        let (near, extent) = (length_text(nearest), length_text(extent));
        return Some(format!("the centre of mass is beside point {point}, {near} off it, in a body of {extent}"));
    }
    None
}

/// Driven angles whose number of degrees is one of radians.
fn radians(model: &Model, found: &mut Vec<Complaint>) {
    for (name, driver) in &model.drivers {
        if !matches!(driver.kind, DriverKind::Rotation { .. }) {
            continue;
        }
        let looked: Vec<(String, f64, &str)> = match &driver.motion {
            // The first value is looked at like the angles of a drawing.
            Motion::Polynomial { coefficients } => (coefficients.iter().zip(RATES).enumerate().skip(1))
                .map(|(k, (value, per))| (format!("coefficients[{k}]"), *value, per))
                .collect(),
            Motion::Harmonic { offset, amplitude, .. } => {
                vec![("offset".into(), *offset, RATES[0]), ("amplitude".into(), *amplitude, RATES[0])]
            }
            Motion::Table { points } => travel(points).map(|travel| ("points".into(), travel, RATES[0])).to_vec(),
            Motion::ConstantVelocity { velocity, .. } => vec![("velocity".into(), *velocity, RATES[1])],
            Motion::ConstantAcceleration { velocity, acceleration, .. } => {
                vec![("velocity".into(), *velocity, RATES[1]), ("acceleration".into(), *acceleration, RATES[2])]
            }
        };
        let odd = looked.iter().find(|(_, value, _)| looks_like_radians(value.to_degrees()));
        found.extend(odd.map(|(key, value, per)| {
            let degrees = value.to_degrees();
            let shown: f64 = format!("{degrees:.6}").parse().unwrap_or(degrees);
            let what = if key == "points" { "the motion goes over" } else { "this is" };
            let message = format!("{what} {shown} deg{per}, which looks like radians");
            let hint = format!("plain numbers are in degrees here; write degrees, or text with the unit rad{per}");
            Complaint::new(format!("drivers.{name}.motion.{key}"), message).hint(hint)
        }));
    }
}

/// The unit of time of a derivative, by its order.
const RATES: [&str; 3] = ["", "/s", "/s^2"];

/// From the first value of a table to the last, and from the least to the greatest.
fn travel(points: &[[f64; 2]]) -> [f64; 2] {
    let values = || points.iter().map(|point| point[1]);
    let ends = points.first().zip(points.last()).map_or(0.0, |(first, last)| last[1] - first[1]);
    [ends, values().fold(f64::NEG_INFINITY, f64::max) - values().fold(f64::INFINITY, f64::min)]
}

/// Whether a number of degrees is a usual fraction or multiple of π, and no whole number.
fn looks_like_radians(degrees: f64) -> bool {
    let multiple = degrees.abs() / PI;
    let near = |wanted: f64, within: f64| (multiple - wanted).abs() <= within * wanted;
    // Turned into radians and back, a whole number is off by round-off.
    let whole = (degrees - degrees.round()).abs() <= 1e-9 * degrees.abs();
    let sixth = (6.0 * multiple).round() / 6.0;
    let large = (2.0..=MOST_MULTIPLE).contains(&multiple) && near(sixth, NEAR_MULTIPLE);
    !whole && (large || FRACTIONS.iter().any(|&fraction| near(fraction, NEAR_FRACTION)))
}
