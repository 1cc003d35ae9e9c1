//! Drivers prescribe coordinates that exist, each once.

use std::collections::HashMap;

use super::Rules;
use crate::tree::word;
use crate::{DriverKind, GROUND, PointAxis, PointRef};

/// Complains about drivers of what can't be driven, or is driven already.
pub(super) fn drivers(rules: &mut Rules<'_>) {
    let model = rules.model;
    let mut driven: HashMap<String, &String> = HashMap::new();
    for (name, driver) in &model.drivers {
        let path = format!("drivers.{name}");
        let known = |key: &str| !rules.holes.has(&format!("{path}.{key}"));
        if !known("type") {
            continue;
        }
        let coordinate = match &driver.kind {
            DriverKind::Rotation { body, relative_to } => {
                if !known("body") || !known("relative_to") {
                    continue;
                }
                rotation(rules, &path, body, relative_to.as_deref())
            }
            DriverKind::Translation { joint } => {
                if !known("joint") {
                    continue;
                }
                translation(rules, &path, joint)
            }
            DriverKind::Length { between } => {
                if !known("between") || !known("between[0]") || !known("between[1]") {
                    continue;
                }
                length(rules, &path, between)
            }
            DriverKind::Point { point, axis } => {
                if !known("point") || !known("axis") {
                    continue;
                }
                coordinate(rules, &path, point, *axis)
            }
        };
        let Some(coordinate) = coordinate else {
            continue;
        };
        if let Some(first) = driven.get(&coordinate) {
            let message = format!("{coordinate} is driven by {first:?} already");
            rules.complain(path, message, "keep one of them");
        } else {
            driven.insert(coordinate, name);
        }
    }
}

/// The angle that a rotation prescribes, in words.
fn rotation(
    rules: &mut Rules<'_>,
    path: &str,
    body: &str,
    relative_to: Option<&str>,
) -> Option<String> {
    let other = relative_to.unwrap_or(GROUND);
    if body == GROUND && other == GROUND {
        let hint = "name the body that the driver turns";
        let message = "ground is fixed, nothing can turn it";
        rules.complain(format!("{path}.body"), message, hint);
        return None;
    }
    if body == other {
        let message = format!("the angle of {body:?} relative to itself cannot be driven");
        let complaint = crate::error::Complaint::new(format!("{path}.body"), message);
        rules.complaints.push(complaint);
        return None;
    }
    let (first, second) = if body < other {
        (body, other)
    } else {
        (other, body)
    };
    Some(format!("the angle between {first:?} and {second:?}"))
}

/// The distance that a length prescribes, in words.
fn length(rules: &mut Rules<'_>, path: &str, between: &[PointRef; 2]) -> Option<String> {
    let [mut first, mut second] = between.each_ref().map(PointRef::to_string);
    if between[0].body == between[1].body {
        let message = format!(
            "both points are of {:?}, whose distance is what it is",
            between[0].body
        );
        let hint = "name points of two bodies";
        rules.complain(format!("{path}.between"), message, hint);
        return None;
    }
    if second < first {
        std::mem::swap(&mut first, &mut second);
    }
    Some(format!("the distance of {first} and {second}"))
}

/// The coordinate that a driver of a point prescribes, in words.
fn coordinate(
    rules: &mut Rules<'_>,
    path: &str,
    point: &PointRef,
    axis: PointAxis,
) -> Option<String> {
    if point.body == GROUND {
        let message = "ground is fixed, its points can't be moved";
        rules.complain(
            format!("{path}.point"),
            message,
            "name a point of a body that moves",
        );
        return None;
    }
    let axis = match axis {
        PointAxis::X => "x",
        PointAxis::Y => "y",
    };
    Some(format!("{axis} of {point}"))
}

/// The slide that a translation prescribes, in words.
fn translation(rules: &mut Rules<'_>, path: &str, joint: &str) -> Option<String> {
    let found = rules.model.joints.get(joint);
    let found = found.filter(|_| !rules.holes.has(&format!("joints.{joint}.type")));
    match found.filter(|found| found.kind.guide().is_none()) {
        Some(found) => {
            let kind = word(&found.kind);
            let message = format!("this joint is {kind}, neither prismatic nor slot");
            let hint = "a translation drives the slide of a prismatic joint or a slot";
            rules.complain(format!("{path}.joint"), message, hint);
            None
        }
        None => Some(format!("the slide of joint {joint:?}")),
    }
}
