//! What belts of a run can't do: strands that push, pulleys that overlap, lines of centres that turn too far.

use super::rows::{Columns, Replay};
use crate::element::belt::Belt;
use crate::system::System;
use linkdyn_model::display::number;
use linkdyn_output::Trajectory;
use std::f64::consts::PI;

/// Tensions below this part of that of the other strand are round-off [–].
const ROUND_OFF: f64 = 1e-9;
/// A line of centres that has turned this far in its carrier \[rad\] may come round before the next row.
const FAR: f64 = 0.9 * PI;
/// Significant digits of forces and times.
const DIGITS: usize = 4;

/// What is said of the belts of a run, by its rows.
pub(super) fn notes(system: &System, rows: &Trajectory) -> Vec<String> {
    let belts = system.joints.iter();
    let belts =
        belts.filter_map(|joint| Some((joint.name.as_str(), joint.extras().belt.as_deref()?)));
    let belts: Vec<(&str, &Belt)> = belts.collect();
    if belts.is_empty() {
        return Vec::new();
    }
    let tensions = belts.iter();
    let mut notes: Vec<String> = tensions
        .filter(|(_, belt)| belt.pretension > 0.0)
        .filter_map(|(name, _)| slack(name, rows))
        .collect();
    notes.extend(geometry(system, &belts, rows));
    notes
}

/// A strand that would have to push.
fn slack(name: &str, rows: &Trajectory) -> Option<String> {
    let of = |quantity: &str| rows.values(&format!("joint.{name}.{quantity}"));
    let (times, slack, tight) = (rows.values("time")?, of("slack")?, of("tight")?);
    let is_slack = |row: &usize| slack[*row] < -ROUND_OFF * tight[*row].abs();
    let first = (0..slack.len()).find(is_slack)?;
    let least = slack.iter().copied().fold(0.0, f64::min);
    Some(format!(
        "joint \"{name}\": from t = {} s on a strand would have to push, with up to {} N: it hangs slack there, and the results do not \
         hold; raise \"pretension\"",
        number(times[first], DIGITS),
        number(-least, DIGITS)
    ))
}

/// Pulleys that come too near to each other, and lines of centres that come round in their carrier.
fn geometry(system: &System, belts: &[(&str, &Belt)], rows: &Trajectory) -> Vec<String> {
    let Some(mut replay) = Replay::new(system, &Columns::of(&rows.columns)) else {
        return Vec::new();
    };
    let mut notes = Vec::new();
    let mut said = vec![false; belts.len()];
    for row in rows.rows() {
        replay.take(row);
        if !replay.is_there() {
            continue;
        }
        let at = replay.kinematics();
        for (k, (name, belt)) in belts.iter().enumerate() {
            let fault = if belt.span(&at) <= belt.lean().abs() {
                "the pulleys are too near to each other for the strands between them"
            } else if belt.swing(&at).abs() > FAR {
                "the line of centres has turned by nearly half a turn in the body that \"carrier\" names, beyond which a belt is not \
                 followed; name a body that turns with the line"
            } else {
                continue;
            };
            if !std::mem::replace(&mut said[k], true) {
                notes.push(format!(
                    "joint \"{name}\": at t = {} s {fault}",
                    number(row[0], DIGITS)
                ));
            }
        }
    }
    notes
}
