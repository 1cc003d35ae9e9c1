//! What is said of an output over all its poses, those that are not in the page included.

use serde_json::{Value, json};

use super::chosen::{Chosen, farthest, least_within};
use super::parts::{AccuracyPage, Output, Pose};
use crate::cut::Cut;

/// Words and counts of an output; its numbers are among the values of the page.
pub fn of_output(page: &AccuracyPage, output: &Output, chosen: &Chosen) -> Value {
    let at = |pose: Option<usize>| pose.map(|pose| where_(page, &output.poses[pose]));
    json!({
        "name": output.name,
        "of": output.of,
        "unit": output.unit,
        "limits": output.limits,
        "poses": output.poses.len(),
        "rows": chosen.rows.len(),
        "details": chosen.details,
        "contributes": chosen.details.iter().map(|&row| !output.poses[chosen.rows[row]].contributions.is_empty()).collect::<Vec<_>>(),
        "needed": needed(output, chosen),
        "worst": chosen.worst,
        "along_driver": is_along_driver(output),
        "certified": output.poses.iter().filter(|pose| pose.certified.is_some()).count(),
        "kept": output.poses.iter().filter(|pose| is_kept(output, pose)).count(),
        "exceeded": output.poses.iter().filter(|pose| is_exceeded(page, output, pose)).count(),
        "farthest_at": at(farthest(output)),
        "least_within": least_within(output).and_then(|pose| output.poses[pose].capability),
        "least_within_at": at(least_within(output)),
        "range": range(page, output),
    })
}

/// Of each pose that can be chosen what a deviation needs, as [[deviation, share], …] to either side; null where that is not
/// known.
fn needed(output: &Output, chosen: &Chosen) -> Value {
    let digits = |value: f64| format!("{value:.5e}").parse().unwrap_or(value);
    let side = |points: &[[f64; 2]]| -> Value {
        let points = points.iter();
        points.map(|point| json!(point.map(digits))).collect()
    };
    let poses = chosen
        .details
        .iter()
        .map(|&row| &output.poses[chosen.rows[row]]);
    let of = |pose: &Pose| match pose.needed {
        [[], []] => Value::Null,
        [low, high] => json!([side(low), side(high)]),
    };
    poses.map(of).collect()
}

/// Values of the drivers at a pose.
fn where_(page: &AccuracyPage, pose: &Pose) -> Value {
    let values = page.drivers.iter().zip(pose.drivers);
    values
        .map(|((name, unit), value)| json!([name, value, unit]))
        .collect()
}

/// Whether nothing exceeds the limits.
fn is_kept(output: &Output, pose: &Pose) -> bool {
    let both = output.limits.zip(pose.certified);
    both.is_some_and(|(limits, bound)| bound[0] >= limits[0] && bound[1] <= limits[1])
}

/// Whether something exceeds the limits.
fn is_exceeded(page: &AccuracyPage, output: &Output, pose: &Pose) -> bool {
    let [low, high] = match page.level {
        0 => pose.first.map_or([None; 2], |first| first.map(Some)),
        _ => pose.found,
    };
    output.limits.is_some_and(|limits| {
        low.is_some_and(|low| low < limits[0]) || high.is_some_and(|high| high > limits[1])
    })
}

/// Whether each pose has another value of the first driver.
fn is_along_driver(output: &Output) -> bool {
    let value = |pose: &Pose| pose.drivers.first().copied().unwrap_or(f64::NAN);
    let values: Vec<f64> = output.poses.iter().map(value).collect();
    let rises = |sign: f64| {
        values
            .windows(2)
            .all(|pair| sign * pair[0] < sign * pair[1])
    };
    rises(1.0) || rises(-1.0)
}

/// The range of deviations to show where peaks are cut.
fn range(page: &AccuracyPage, output: &Output) -> Option<[f64; 2]> {
    let curve = |value: fn(&Pose) -> Option<f64>| -> Vec<f64> {
        output.poses.iter().filter_map(value).collect()
    };
    let first = |end: usize| {
        let poses = output.poses.iter().filter(|_| page.level == 0);
        poses.filter_map(|pose| Some(pose.first?[end])).collect()
    };
    let curves = [
        first(0),
        first(1),
        curve(|pose| pose.found[0]),
        curve(|pose| pose.found[1]),
        curve(|pose| pose.certified.map(|by| by[0])),
        curve(|pose| pose.certified.map(|by| by[1])),
        curve(|pose| pose.moments.map(|[mean, sigma]| mean - 3.0 * sigma)),
        curve(|pose| pose.moments.map(|[mean, sigma]| mean + 3.0 * sigma)),
    ];
    Cut::range(curves.into_iter())
}
