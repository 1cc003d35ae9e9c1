//! Where the way of a joint ends.

use super::Rules;
use crate::error::Complaint;
use crate::{Force, Joint, JointKind, Model};

/// Limits are the right way round, and what their stops are made of belongs together.
pub(super) fn stops(rules: &mut Rules<'_>, joint: &Joint, path: &str) {
    let holes = &rules.holes;
    let known = |key: &str| !holes.has(&format!("{path}.{key}"));
    if !known("type") || !known("limits") {
        return;
    }
    if let JointKind::Belt { .. } = joint.kind {
        if joint.stops.damping.is_some() && joint.stops.stiffness.is_none() && known("stiffness") {
            let message = "\"stiffness\" is missing: a belt with damping stretches";
            let hint = "give the stiffness of a strand, as in \"stiffness\": \"50 N/mm\"";
            rules.complain(format!("{path}.damping"), message, hint);
        }
        return;
    }
    let found = match joint.stops.limits {
        None if matches!(joint.kind, JointKind::Contact { .. }) => None,
        None => of_nothing(joint),
        Some(limits) if known("limits[0]") && known("limits[1]") => {
            order(rules.model, joint, limits)
        }
        Some(_) => None,
    };
    let stops = [found, material(joint), latch(joint)];
    let stops = stops.map(|fault| fault.filter(|(key, ..)| known(key)));
    for (key, message, hint) in stops.into_iter().flatten() {
        let complaint = Complaint::new(format!("{path}.{key}"), message).hint(hint);
        rules.complaints.push(complaint);
    }
}

/// The same of a spring or an actuator.
pub(super) fn stroke(rules: &mut Rules<'_>, force: &Force, path: &str) {
    let holes = &rules.holes;
    let known = |key: &str| !holes.has(&format!("{path}.{key}"));
    if !known("type") || !known("limits") || !known("limits[0]") || !known("limits[1]") {
        return;
    }
    let stroke = &force.stroke;
    let given = [
        ("restitution", stroke.restitution),
        ("stop_stiffness", stroke.stop_stiffness),
        ("stop_damping", stroke.stop_damping),
    ];
    let said = |length: f64| rules.model.display.length(length);
    let fault = match (stroke.limits, stroke.stop_stiffness) {
        // a gas spring has its ends by other words
        (None, _) if force.limits().is_none() => given.iter().find(|(_, value)| value.is_some()).map(|(key, _)| (
            *key,
            "is of the stops at its limits, and there are no \"limits\"".to_owned(),
            "as in \"limits\": [\"300 mm\", \"500 mm\"]",
        )),
        (Some([None, None]), _) => Some((
            "limits",
            "neither end is given".to_owned(),
            "give one of them, or leave \"limits\" out",
        )),
        // one of a gas spring is told with its own words
        (Some([Some(lower), _]), _) if lower <= 0.0 => Some((
            "limits",
            format!("the lower limit {} is no length that its points could come to", said(lower)),
            "a distance is above 0: give a greater one, or null where the stroke has no end",
        )),
        (Some([_, Some(upper)]), _) if upper <= 0.0 => Some((
            "limits",
            format!("the upper limit {} leaves no stroke", said(upper)),
            "it is the greatest distance of its points",
        )),
        (Some([Some(lower), Some(upper)]), _) if lower >= upper => Some((
            "limits",
            format!("the lower limit {} is not below the upper limit {}", said(lower), said(upper)),
            "write [lower, upper]",
        )),
        (_, None) if stroke.stop_damping.is_some() => Some((
            "stop_damping",
            "\"stop_stiffness\" is missing: a stop with damping yields".to_owned(),
            "give the stiffness of the stops, or \"restitution\" instead of the damping",
        )),
        (_, Some(_)) if stroke.restitution.is_some() => Some((
            "restitution",
            "the stops yield, since there is a \"stop_stiffness\": what they give back follows from stiffness and damping".to_owned(),
            "leave out one of them",
        )),
        (_, _) => None,
    };
    if let Some((key, message, hint)) = fault.filter(|(key, ..)| known(key)) {
        rules.complain(format!("{path}.{key}"), message, hint);
    }
}

/// Key, message and hint.
type Fault = (&'static str, String, &'static str);

/// What there is of stops though there are no limits.
fn of_nothing(joint: &Joint) -> Option<Fault> {
    let stops = &joint.stops;
    let given = [
        ("restitution", stops.restitution),
        ("sense", stops.sense.map(|_| 0.0)),
        ("stiffness", stops.stiffness),
        ("damping", stops.damping),
        ("latch", stops.latch.map(|_| 0.0)),
        ("release", stops.release),
    ];
    let (key, _) = given.iter().find(|(_, value)| value.is_some())?;
    let hint = match joint.kind {
        JointKind::Revolute { .. } => "as in \"limits\": [\"-30 deg\", \"60 deg\"]",
        _ => "as in \"limits\": [\"0 mm\", \"80 mm\"]",
    };
    let message = "is of the stops at the joint's limits, and there are no \"limits\"";
    Some((key, message.to_owned(), hint))
}

/// Limits that leave no way.
fn order(model: &Model, joint: &Joint, limits: [Option<f64>; 2]) -> Option<Fault> {
    let said = |value: f64| match joint.kind {
        JointKind::Revolute { .. } => model.display.angle(value),
        _ => model.display.length(value),
    };
    match limits {
        [None, None] => Some((
            "limits",
            "neither end is given".to_owned(),
            "give one of them, or leave \"limits\" out",
        )),
        [Some(lower), Some(upper)] if lower >= upper => Some((
            "limits",
            format!(
                "the lower limit {} is not below the upper limit {}",
                said(lower),
                said(upper)
            ),
            "write [lower, upper]; a joint that does not move is \"fixed\"",
        )),
        _ => None,
    }
}

/// Stops that are rigid and yield.
fn material(joint: &Joint) -> Option<Fault> {
    let stops = &joint.stops;
    let is_contact = matches!(joint.kind, JointKind::Contact { .. });
    if stops.limits.is_none() && !is_contact {
        return None;
    }
    let given = [
        ("restitution", stops.restitution.is_some()),
        ("sense", stops.sense.is_some()),
    ];
    let rigid = given.into_iter().find(|(_, is_given)| *is_given);
    match (stops.stiffness, stops.damping, rigid) {
        (None, Some(_), _) => Some((
            "damping",
            match is_contact {
                true => "\"stiffness\" is missing: what has damping yields".to_owned(),
                false => "\"stiffness\" is missing: a stop with damping yields".to_owned(),
            },
            match is_contact {
                true => "give the stiffness, or \"restitution\" instead of the damping",
                false => {
                    "give the stiffness of the stops, or \"restitution\" instead of the damping"
                }
            },
        )),
        (Some(_), _, Some((key, _))) => Some((
            key,
            format!(
                "{} yield, since there is a \"stiffness\": what they give back follows from stiffness and damping",
                if is_contact { "both" } else { "the stops" }
            ),
            "leave out one of them",
        )),
        _ => None,
    }
}

/// Latches at ends that are not there, or that can't be what they are.
fn latch(joint: &Joint) -> Option<Fault> {
    let stops = &joint.stops;
    let limits = stops.limits?;
    let Some(latch) = stops.latch else {
        return stops.release.map(|_| {
            (
                "release",
                "there is no latch that could open".to_owned(),
                "say where the joint latches, as in \"latch\": \"upper\"",
            )
        });
    };
    if stops.stiffness.is_some() {
        return Some((
            "latch",
            "a latch is rigid, and these stops yield".to_owned(),
            "leave out \"stiffness\" and \"damping\"",
        ));
    }
    let lacks = |side: usize| latch.sides()[side] && limits[side].is_none();
    let side = (0..2).find(|&side| lacks(side))?;
    let message = format!("the joint has no {} limit", ["lower", "upper"][side]);
    Some(("latch", message, "a joint latches at one of its limits"))
}
