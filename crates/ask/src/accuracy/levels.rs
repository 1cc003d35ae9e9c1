//! The levels of accuracy in words: numbers with their units, and why there are none.

use linkdyn_model::display::DisplayUnits;
use linkdyn_variation::{Levels, OutputAccuracy, PoseAccuracy};

use crate::text::number;

/// Digits of deviations and of sensitivities.
const DIGITS: usize = 5;
const NO_FIRST: &str =
    "does not exist: a change point, where accuracy goes with the root of the clearance";
const NOT_FOUND: &str = "not found (what may be off might lead to a singular position)";
/// Shares of the clearances and tolerances whose reach is printed where nothing is certified.
const SHARES: [f64; 3] = [0.1, 0.5, 1.0];

/// A value in the units of the file.
pub fn value(display: &DisplayUnits, unit: &str, value: f64) -> String {
    match unit {
        "rad" => display.angle_to(value, DIGITS),
        "m" => display.length_to(value, DIGITS),
        _ => format!("{} {}", number(value, DIGITS), unit.replace('*', "·")),
    }
}

/// `±a`, or `-a / +b`.
pub fn both(display: &DisplayUnits, unit: &str, [low, high]: [f64; 2]) -> String {
    let [below, above] = [-low, high].map(|by| value(display, unit, by));
    if below == above {
        format!("±{above}")
    } else if low == high {
        signed(display, unit, high)
    } else {
        format!(
            "{} / {}",
            signed(display, unit, low),
            signed(display, unit, high)
        )
    }
}

/// With its sign.
pub fn signed(display: &DisplayUnits, unit: &str, by: f64) -> String {
    let sign = if by < 0.0 { "-" } else { "+" };
    format!("{sign}{}", value(display, unit, by.abs()))
}

/// How far parts of all clearances and tolerances let the output go, where nothing is certified: beside a change point a part
/// of them allows more than that part of the deviation.
pub fn allowed(display: &DisplayUnits, unit: &str, pose: &PoseAccuracy) -> Vec<String> {
    let at = |side: usize, share: f64| {
        let points = pose.needed[side].iter();
        points
            .clone()
            .find(|[_, needed]| *needed == share)
            .map(|[by, _]| *by)
    };
    let row = |share: f64| {
        let by = match [at(0, share), at(1, share)] {
            [None, None] => return None,
            [Some(low), Some(high)] => both(display, unit, [low, high]),
            [Some(by), None] | [None, Some(by)] => signed(display, unit, by),
        };
        let part = number(100.0 * share, 3);
        Some(format!("{part} % of all clearances and tolerances: {by}"))
    };
    SHARES.iter().filter_map(|share| row(*share)).collect()
}

/// The farthest to both sides.
pub fn found_of(display: &DisplayUnits, unit: &str, pose: &PoseAccuracy) -> String {
    match pose.found {
        [Some(low), Some(high)] => both(display, unit, [low, high]),
        [None, None] if unit.starts_with('N') => {
            "not found: the position is lost before all is off that may be (a singular position is near)".into()
        }
        [low, high] => {
            let side =
                |by: Option<f64>| by.map_or(NOT_FOUND.to_owned(), |by| signed(display, unit, by));
            format!("{} / {}", side(low), side(high))
        }
    }
}

/// The bound, or why there is none.
pub fn certified(display: &DisplayUnits, output: &OutputAccuracy, pose: &PoseAccuracy) -> String {
    match pose.certified {
        Some(bound) => both(display, output.unit, bound),
        None if output.is_force() => "no bound is proved for forces; the worst found is a corner of all that may be off".into(),
        None => "no bound could be proved here (what may be off might lead to a singular position, or an axis or gear centre has a tolerance)".into(),
    }
}

/// What limits allow, and whether it is kept.
pub fn of_limits(
    display: &DisplayUnits,
    unit: &str,
    (limits, levels): ([f64; 2], Levels),
    pose: &PoseAccuracy,
) -> String {
    let allowed = both(display, unit, limits);
    let held = |bound: Option<[f64; 2]>| {
        bound.is_some_and(|bound| bound[0] >= limits[0] && bound[1] <= limits[1])
    };
    let found = match pose.found {
        [Some(low), Some(high)] => Some([low, high]),
        _ => None,
    };
    let exceeds = |found: Option<[f64; 2]>| {
        found.is_some_and(|found| found[0] < limits[0] || found[1] > limits[1])
    };
    let verdict = match levels {
        Levels::First if held(pose.first) => "kept to first order",
        Levels::First if exceeds(pose.first) => "exceeded to first order",
        Levels::First => "not known here",
        Levels::Worst | Levels::Certified if held(pose.certified) => "always kept (certified)",
        Levels::Worst | Levels::Certified if exceeds(found) => "exceeded by the worst found",
        Levels::Worst => "kept by the worst found",
        Levels::Certified => "kept by the worst found, not certified",
    };
    match &pose.capability {
        Some(capability) => format!(
            "{allowed}: {verdict}; {} % within, Cp {}, Cpk {}",
            number(100.0 * capability.within, 6),
            number(capability.cp, 4),
            number(capability.cpk, 4)
        ),
        None => format!("{allowed}: {verdict}"),
    }
}

/// The first order, or why there is none.
pub fn first_of(display: &DisplayUnits, unit: &str, pose: &PoseAccuracy) -> String {
    match (pose.first, &pose.missing) {
        (Some(first), _) => both(display, unit, first),
        (None, Some(missing)) => missing.clone(),
        (None, None) => NO_FIRST.into(),
    }
}
