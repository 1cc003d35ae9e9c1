//! Outlines of contacts.

use super::Rules;
use crate::{Joint, JointKind};

/// Part of an arc's diameter that may be missing by round-off.
const ROUND_OFF: f64 = 1e-9;

/// Key, message and hint.
type Fault = (String, String, &'static str);

/// An outline has a way that an arc can follow, and room for the tip.
pub(super) fn outline(rules: &mut Rules<'_>, joint: &Joint, path: &str) {
    let JointKind::Contact {
        outline,
        radius,
        arc,
        ..
    } = &joint.kind
    else {
        return;
    };
    let holes = &rules.holes;
    let known = |key: &str| !holes.has(&format!("{path}.{key}"));
    if !known("type") || !known("outline") {
        return;
    }
    let length = |value: f64| rules.model.display.length(value);
    let tip = known("radius").then_some(*radius);
    let mut found: Vec<Fault> = Vec::new();
    let mut last = None;
    for (k, node) in outline.iter().enumerate() {
        let at = format!("outline[{k}]");
        // A list that is too short has been refused, and is empty.
        let place = !node.is_empty()
            && known(&at)
            && (0..node.len()).all(|part| known(&format!("{at}[{part}]")));
        match place.then(|| point(&at, node)) {
            None => last = None,
            Some(Err(fault)) => found.push(fault),
            Some(Ok((place, arc))) => {
                found.extend(way((k, last), place, (arc, tip), &length));
                last = Some(place);
            }
        }
    }
    if arc.is_some_and(|[from, to]| from == to) && known("arc") {
        let message = "both ends of the tip are one".to_owned();
        found.push((
            "arc".to_owned(),
            message,
            "leave it out where the tip is a full circle",
        ));
    }
    for (key, message, hint) in found {
        rules.complain(format!("{path}.{key}"), message, hint);
    }
}

/// A point of an outline, and the radius of the arc that leads to it.
fn point(at: &str, node: &[f64]) -> Result<([f64; 2], Option<f64>), Fault> {
    match *node {
        [x, y] => Ok(([x, y], None)),
        [x, y, arc] => Ok(([x, y], Some(arc))),
        _ => Err((
            at.to_owned(),
            format!(
                "a point of an outline has two or three numbers, not {}",
                node.len()
            ),
            "write [x, y], or [x, y, r] where an arc of radius r leads to it",
        )),
    }
}

/// What is wrong with the way from the last point to point `k`.
fn way(
    (k, last): (usize, Option<[f64; 2]>),
    place: [f64; 2],
    (arc, tip): (Option<f64>, Option<f64>),
    length: &dyn Fn(f64) -> String,
) -> Option<Fault> {
    let (at, radius) = (format!("outline[{k}]"), format!("outline[{k}][2]"));
    if arc == Some(0.0) {
        let message = "an arc has a radius".to_owned();
        return Some((
            radius,
            message,
            "leave it out where a straight leads to the point",
        ));
    }
    if arc.is_some() && k == 0 {
        let message = "no arc leads to the first point of an outline".to_owned();
        return Some((
            radius,
            message,
            "the radius stands at the point that the arc leads to",
        ));
    }
    let last = last?;
    let chord = (place[0] - last[0]).hypot(place[1] - last[1]);
    if chord == 0.0 {
        let message = format!("this is where point {} of the outline is", k - 1);
        return Some((at, message, "leave out one of them"));
    }
    let arc = arc?;
    if 2.0 * arc.abs() < chord * (1.0 - ROUND_OFF) {
        let (arc, chord) = (length(arc.abs()), length(chord));
        return Some((
            radius,
            format!("an arc of radius {arc} can't lead over {chord} from the point before"),
            "its diameter is no less than the distance; an arc is never more than half a turn",
        ));
    }
    let tip = tip.filter(|tip| arc < 0.0 && -arc <= *tip)?;
    Some((
        radius,
        format!(
            "the tip of radius {} does not fit into this arc of radius {}",
            length(tip),
            length(-arc)
        ),
        "an arc that turns right is hollow: give it a larger radius than the tip",
    ))
}
