//! Laws of motion: times of tables increase, rises say once how far and how fast, drivers have no corners.

use super::Rules;
use crate::Value;
use crate::motion::{Interpolation, Motion, Paced, RiseLaw};

/// Share of a rise, or of a ramp, that is too large.
const HALF: f64 = 0.5;

/// Whether a motion moves a coordinate, or a force.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Of {
    Driver,
    Force,
}

/// Complains about laws that contradict themselves, and about those that a driver can't follow.
pub(super) fn motions(rules: &mut Rules<'_>) {
    let model = rules.model;
    for (name, driver) in &model.drivers {
        let path = format!("drivers.{name}.motion");
        motion(rules, &driver.motion, Of::Driver, &path);
    }
    for (name, force) in &model.forces {
        for (key, value, _) in force.kind.values() {
            if let Value::Motion(of_time) = value {
                motion(rules, of_time, Of::Force, &format!("forces.{name}.{key}"));
            }
        }
    }
}

fn motion(rules: &mut Rules<'_>, motion: &Motion, of: Of, path: &str) {
    match motion {
        Motion::Polynomial { .. }
        | Motion::Harmonic { .. }
        | Motion::ConstantVelocity { .. }
        | Motion::ConstantAcceleration { .. } => {}
        Motion::Table {
            points,
            interpolation,
            velocities,
        } => {
            increasing(rules, points, path);
            if let Some(velocities) = velocities {
                sloped(
                    rules,
                    [points.len(), velocities.len()],
                    *interpolation,
                    path,
                );
            }
            match (interpolation, of) {
                (Interpolation::Linear, Of::Driver) => {
                    let message = "a linear table has corners, which no driver can follow";
                    let hint = "\"monotone\" and \"natural\" have none; \"linear\" is for forces";
                    rules.complain(format!("{path}.interpolation"), message, hint);
                }
                (Interpolation::Periodic, Of::Force) => closed(rules, points, path),
                (Interpolation::Periodic, Of::Driver)
                | (Interpolation::Linear, Of::Force)
                | (Interpolation::Natural | Interpolation::Monotone, _) => {}
            }
        }
        Motion::Cycloidal(rise)
        | Motion::Polynomial345(rise)
        | Motion::Polynomial4567(rise)
        | Motion::ModifiedSine(rise)
        | Motion::ModifiedTrapezoid(rise) => {
            how_far(rules, [rise.rise, rise.end], HOW_FAR, path);
        }
        Motion::TrapezoidalVelocity(rise) => {
            if rise.jerk.is_some() || rise.rounding.is_some() {
                let message = "the jerk of \"trapezoidal_velocity\" has no limit";
                rules.complain(path, message, "\"s_curve\" is the law with one");
            }
            paced(rules, rise, false, path);
        }
        Motion::SCurve(rise) => paced(rules, rise, true, path),
        Motion::Sequence { segments, .. } => {
            for (index, of) in segments.iter().enumerate() {
                let own = RiseOrDwell {
                    law: of.law,
                    rise: [of.rise, of.end],
                    span: ("duration", of.duration),
                    shares: [of.ramp, of.rounding],
                    dwell: of.dwell,
                    hints: OF_SEQUENCES,
                };
                part(rules, &own, &format!("{path}.segments[{index}]"));
            }
        }
    }
}

/// Complains about the first time of a table that is not later than the one before.
fn increasing(rules: &mut Rules<'_>, points: &[[f64; 2]], path: &str) {
    let place = |index: usize| format!("{path}.points[{index}][0]");
    for (index, pair) in points.windows(2).enumerate() {
        let known = !rules.holes.has(&place(index)) && !rules.holes.has(&place(index + 1));
        if known && pair[1][0] <= pair[0][0] {
            let message = "the time is not later than that of the point before";
            rules.complain(place(index + 1), message, "the times of a table increase");
            return;
        }
    }
}

/// Complains about rates that are not one for each point, and beside a law of what is between the points.
fn sloped(
    rules: &mut Rules<'_>,
    [points, velocities]: [usize; 2],
    interpolation: Interpolation,
    path: &str,
) {
    if points != velocities {
        let message = format!("there are {velocities} velocities for {points} points");
        let hint = "one for each point, in the same order";
        rules.complain(format!("{path}.velocities"), message, hint);
    }
    if interpolation != Interpolation::Natural {
        let message = "\"velocities\" say what is between the points";
        let hint = "leave \"interpolation\" out, or \"velocities\"";
        rules.complain(format!("{path}.interpolation"), message, hint);
    }
}

/// Complains where a force would jump from one period to the next.
fn closed(rules: &mut Rules<'_>, points: &[[f64; 2]], path: &str) {
    let (Some(first), Some(last)) = (points.first(), points.last()) else {
        return;
    };
    let place = |index: usize| format!("{path}.points[{index}][1]");
    let known = !rules.holes.has(&place(0)) && !rules.holes.has(&place(points.len() - 1));
    if known && first[1] != last[1] {
        let message = "the last value of a periodic table is not its first";
        let hint =
            "the last point is the first one of the next period; a force has the same value there";
        rules.complain(place(points.len() - 1), message, hint);
    }
}

/// How far a rise goes.
const HOW_FAR: &str = "how far it goes, as in \"rise\": \"30 deg\", or \"end\", where to";

/// A rise says once how far it goes.
fn how_far(rules: &mut Rules<'_>, rise: [Option<f64>; 2], hint: &str, path: &str) {
    let known = |key: &str| !rules.holes.has(&format!("{path}.{key}"));
    if !known("rise") || !known("end") {
        return;
    }
    match rise {
        [None, None] => rules.complain(path, "\"rise\" is missing", hint),
        [Some(_), Some(_)] => {
            let message = "\"rise\" and \"end\" exclude each other";
            rules.complain(format!("{path}.end"), message, "keep one of them");
        }
        [Some(_), None] | [None, Some(_)] => {}
    }
}

/// A share that is too large.
fn share(rules: &mut Rules<'_>, share: Option<f64>, most: f64, path: &str) {
    if share.is_some_and(|share| share > most) && !rules.holes.has(path) {
        let message = format!("must not be greater than {most}");
        let hint = if most == HALF {
            "a ramp up and one down take all the time there is"
        } else {
            "the share of a ramp in which the acceleration changes"
        };
        rules.complain(path, message, hint);
    }
}

fn shares(rules: &mut Rules<'_>, ramp: Option<f64>, rounding: Option<f64>, path: &str) {
    share(rules, ramp, HALF, &format!("{path}.ramp"));
    share(rules, rounding, 1.0, &format!("{path}.rounding"));
}

/// A rise says once how fast it is: by its duration and shares of it, or by what it may reach.
fn paced(rules: &mut Rules<'_>, rise: &Paced, is_rounded: bool, path: &str) {
    how_far(rules, [rise.rise, rise.end], HOW_FAR, path);
    shares(rules, rise.ramp, rise.rounding, path);
    let known = |key: &str| !rules.holes.has(&format!("{path}.{key}"));
    if !known("duration") || !known("velocity") {
        return;
    }
    let limits = [
        ("velocity", rise.velocity, true),
        ("acceleration", rise.acceleration, true),
        ("jerk", rise.jerk, is_rounded),
    ];
    let parts = [("ramp", rise.ramp), ("rounding", rise.rounding)];
    if rise.duration.is_some() {
        if let Some((key, ..)) = limits.iter().find(|(_, limit, _)| limit.is_some()) {
            let message = format!("\"duration\" and {key:?} exclude each other");
            let hint = "say how long it takes, or what it may reach: each follows from the other";
            rules.complain(format!("{path}.{key}"), message, hint);
        }
        return;
    }
    let missing = limits
        .iter()
        .find(|(key, limit, needed)| *needed && limit.is_none() && known(key));
    if let Some((key, ..)) = missing {
        let message = format!("{key:?} is missing");
        let hint = match is_rounded {
            true => {
                "without \"duration\" the greatest velocity, acceleration and jerk say how long it takes"
            }
            false => {
                "without \"duration\" the greatest velocity and acceleration say how long it takes"
            }
        };
        rules.complain(path, message, hint);
    }
    if let Some((key, _)) = parts.iter().find(|(_, part)| part.is_some()) {
        let message = format!("{key:?} is a share of a \"duration\"");
        let hint = "here it follows from the limits";
        rules.complain(format!("{path}.{key}"), message, hint);
    }
}

/// A part of a sequence, or of a turn of a cam: a rise or a dwell.
pub(super) struct RiseOrDwell {
    pub law: Option<RiseLaw>,
    /// How far, or where to.
    pub rise: [Option<f64>; 2],
    /// Over which time or angle, with its key.
    pub span: (&'static str, Option<f64>),
    /// Ramp and rounding.
    pub shares: [Option<f64>; 2],
    pub dwell: Option<f64>,
    /// Of a dwell with other keys, of a rise that does not say how far, and of one without span.
    pub hints: [&'static str; 3],
}

const OF_SEQUENCES: [&str; 3] = [
    "\"dwell\" says how long it stays; what moves has a \"law\"",
    HOW_FAR,
    "how long the rise takes, as in \"duration\": \"0.2 s\"",
];

/// A segment is a rise that says how far it goes and over what, or a dwell.
pub(super) fn part(rules: &mut Rules<'_>, part: &RiseOrDwell, path: &str) {
    let known = |key: &str| !rules.holes.has(&format!("{path}.{key}"));
    if !known("law") || !known("dwell") {
        return;
    }
    let [of_dwell, of_rise, of_span] = part.hints;
    let ([ramp, rounding], (span, over)) = (part.shares, part.span);
    let Some(law) = part.law else {
        let own = [
            ("rise", part.rise[0]),
            ("end", part.rise[1]),
            (span, over),
            ("ramp", ramp),
            ("rounding", rounding),
        ];
        if let Some((key, _)) = own.iter().find(|(_, value)| value.is_some()) {
            let message = format!("a dwell has no {key:?}");
            rules.complain(format!("{path}.{key}"), message, of_dwell);
        } else if part.dwell.is_none() {
            let hint = "a segment has a \"law\", or is a \"dwell\"";
            rules.complain(path, "\"law\" is missing", hint);
        }
        return;
    };
    how_far(rules, part.rise, of_rise, path);
    shares(rules, ramp, rounding, path);
    if over.is_none() && !rules.holes.has(&format!("{path}.{span}")) {
        rules.complain(path, format!("{span:?} is missing"), of_span);
    }
    let (ramped, rounded) = match law {
        RiseLaw::Cycloidal
        | RiseLaw::Polynomial345
        | RiseLaw::Polynomial4567
        | RiseLaw::ModifiedSine
        | RiseLaw::ModifiedTrapezoid => (false, false),
        RiseLaw::TrapezoidalVelocity => (true, false),
        RiseLaw::SCurve => (true, true),
    };
    let foreign = [("ramp", ramp, ramped), ("rounding", rounding, rounded)];
    if let Some((key, ..)) = (foreign.iter()).find(|(_, value, own)| value.is_some() && !own) {
        let message = format!("this law has no {key:?}");
        let hint =
            "\"trapezoidal_velocity\" has a \"ramp\", \"s_curve\" a \"ramp\" and a \"rounding\"";
        rules.complain(format!("{path}.{key}"), message, hint);
    }
}
