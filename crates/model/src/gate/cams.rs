//! What belongs together in a cam: the follower and what touches, the profile and the follower, a turn and its segments.

use std::f64::consts::{PI, TAU};

use super::Rules;
use super::motions::{RiseOrDwell, part};
use crate::cam::{ROUND_OFF, around, course};
use crate::error::Complaint;
use crate::{Cam, CamSegment, Follower, Joint, JointKind, Profile};

/// Complains about a cam that can't be.
pub(super) fn cam(rules: &mut Rules<'_>, joint: &Joint, path: &str) {
    let JointKind::Cam(cam) = &joint.kind else {
        return;
    };
    let known = |rules: &Rules<'_>, key: &str| !rules.holes.has(&format!("{path}.{key}"));
    if !known(rules, "type") || !known(rules, "follower") {
        return;
    }
    follower(rules, cam, path);
    if !known(rules, "profile") || !known(rules, "profile.type") {
        return;
    }
    let place = format!("{path}.profile");
    let before = rules.complaints.len();
    for (index, of) in cam.profile.segments().iter().enumerate() {
        let own = RiseOrDwell {
            law: of.law,
            rise: [of.rise, of.end],
            span: ("angle", of.angle),
            shares: [of.ramp, of.rounding],
            dwell: of.dwell,
            hints: OF_TURNS,
        };
        part(rules, &own, &format!("{place}.segments[{index}]"));
    }
    // What is out of its range, or says nothing, is followed no further.
    if rules.complaints.len() == before && !rules.holes.within(&place) {
        let found = turn(rules, cam).or_else(|| profile(rules, cam));
        if let Some((key, message, hint)) = found {
            let complaint = Complaint::new(format!("{place}{key}"), message).hint(hint);
            rules.complaints.push(complaint);
        }
    }
}

/// Key from the profile on, message and hint.
type Fault = (&'static str, String, String);

/// What touches has what it needs, and nothing else.
fn follower(rules: &mut Rules<'_>, cam: &Cam, path: &str) {
    let known = |key: &str| !rules.holes.has(&format!("{path}.{key}"));
    let (wants_face, wants_roller) = match cam.follower {
        Follower::Flat => (true, false),
        Follower::Roller => (false, true),
        Follower::Knife => (false, false),
    };
    let mut found = Vec::new();
    match (cam.face, wants_face) {
        (None, true) if known("face") => found.push((
            "",
            "\"face\" is missing, a flat follower needs its direction".to_owned(),
            "in the follower's frame, the cam to its right, as in \"face\": [1, 0] for a face above the cam",
        )),
        (Some(_), false) => found.push((
            ".face",
            "only a flat follower has a face".to_owned(),
            "leave it out, or write \"follower\": \"flat\"",
        )),
        _ => {}
    }
    match (cam.roller_radius, wants_roller) {
        (None, true) if known("roller_radius") => found.push((
            "",
            "\"roller_radius\" is missing".to_owned(),
            "as in \"roller_radius\": \"8 mm\"; what has none is \"follower\": \"knife\"",
        )),
        (Some(_), false) => found.push((
            ".roller_radius",
            "only a roller has a radius".to_owned(),
            "leave it out, or write \"follower\": \"roller\"",
        )),
        _ => {}
    }
    for (key, message, hint) in found {
        rules.complain(format!("{path}{key}"), message, hint);
    }
}

/// What is said of segments of a turn.
const OF_TURNS: [&str; 3] = [
    "\"dwell\" says over which angle it stays; what moves has a \"law\"",
    "how far it goes; back with the other sign, or \"end\": 0 to where it began",
    "the angle of the cam over which it goes, as in \"angle\": \"120 deg\"",
];

/// Segments fill a turn at most, and come back to where they began.
fn turn(rules: &Rules<'_>, cam: &Cam) -> Option<Fault> {
    let segments = cam.profile.segments();
    let (span, values) = course(segments);
    let degrees = |angle: f64| crate::display::number(angle * 180.0 / PI, 6);
    if span > TAU + ROUND_OFF {
        let message = format!(
            "the segments go over {} deg, more than a turn",
            degrees(span)
        );
        let hint =
            "the angles of rises and dwells come to 360 deg at most; what is left is a dwell";
        return Some((".segments", message, hint.to_owned()));
    }
    let largest = values
        .iter()
        .fold(0.0, |most: f64, value| most.max(value.abs()));
    let end = values.last()?;
    (end.abs() > ROUND_OFF * largest).then(|| {
        let left = match cam.profile {
            Profile::Swing { .. } => rules.model.display.angle(*end),
            Profile::Circle { .. } | Profile::Points { .. } | Profile::Law { .. } => {
                rules.model.display.length(*end)
            }
        };
        let message = format!("the follower does not return: after a turn it is {left} from where it began");
        let hint = "the rises of a turn come to nothing, as in \"rise\": \"20 mm\" and later \"rise\": \"-20 mm\", or \"end\": 0";
        (".segments", message, hint.to_owned())
    })
}

/// The profile goes around the cam's point, and fits the follower.
fn profile(rules: &Rules<'_>, cam: &Cam) -> Option<Fault> {
    let display = &rules.model.display;
    let fault = |key, message: String, hint: &str| Some((key, message, hint.to_owned()));
    let roller = cam.roller_radius.unwrap_or(0.0);
    let is_flat = cam.follower == Follower::Flat;
    match &cam.profile {
        Profile::Circle { centre, radius } => {
            let eccentricity = centre[0].hypot(centre[1]);
            if eccentricity < *radius {
                return None;
            }
            let message = format!(
                "the circle does not go around the cam's point: its centre is {} from it, its radius {}",
                display.length(eccentricity),
                display.length(*radius)
            );
            fault("", message, "an eccentric is larger than its eccentricity")
        }
        Profile::Points { points } => match around(points) {
            Some(_) => None,
            None => fault(
                ".points",
                "the curve is not star-shaped: seen from the cam's point, the points do not go once around in one sense"
                    .to_owned(),
                "list them in their order around the cam's point, and the first one once only",
            ),
        },
        Profile::Law { axis, offset, .. } if is_flat => {
            if axis.is_some() {
                let hint = "a flat follower slides across its face; leave it out";
                return fault(".axis", "the motion of a flat follower needs no axis".to_owned(), hint);
            }
            if *offset != 0.0 {
                let hint = "the profile under a flat face does not depend on where the face is guided; leave it out";
                return fault(".offset", "a flat follower has no offset".to_owned(), hint);
            }
            lowest(rules, cam, 0.0)
        }
        Profile::Law { axis: None, .. } => fault(
            "",
            "\"axis\" is missing, the direction in which the follower slides".to_owned(),
            "in the follower's frame, away from the cam, as in \"axis\": [0, 1]",
        ),
        Profile::Law { base_radius, offset, .. } => {
            if offset.abs() >= base_radius + roller {
                let message = format!(
                    "the line of motion misses the base circle: the offset {} is not less than {}",
                    display.length(offset.abs()),
                    display.length(base_radius + roller)
                );
                let hint = "the offset is less than the base radius and the roller's together";
                return fault(".offset", message, hint);
            }
            lowest(rules, cam, roller)
        }
        Profile::Swing { .. } if is_flat => fault(
            ".type",
            "the profile under a flat face that swings is not made from its motion".to_owned(),
            "give the profile by a circle or points, or take a roller",
        ),
        Profile::Swing { arm, distance, angle, segments, .. } => {
            swing(rules, [*arm, *distance, *angle], segments, roller)
        }
    }
}

/// The lowest point of a motion is above the cam's point.
fn lowest(rules: &Rules<'_>, cam: &Cam, roller: f64) -> Option<Fault> {
    let Profile::Law {
        base_radius,
        offset,
        segments,
        ..
    } = &cam.profile
    else {
        return None;
    };
    let pitch = base_radius + roller;
    let height = (pitch * pitch - offset * offset).sqrt();
    let (_, values) = course(segments);
    let least = values.iter().copied().fold(0.0, f64::min);
    (height + least <= 0.0).then(|| {
        let message = format!(
            "the follower comes down to the cam's point: {} below where it began",
            rules.model.display.length(-least)
        );
        let hint = "rises away from the cam are positive; a larger base radius leaves room";
        (".segments", message, hint.to_owned())
    })
}

/// The arm stays on one side of the line of centres, and its roller off the cam's point.
fn swing(
    rules: &Rules<'_>,
    [arm, distance, angle]: [f64; 3],
    segments: &[CamSegment],
    roller: f64,
) -> Option<Fault> {
    let (_, values) = course(segments);
    let all = || values.iter().map(|value| angle + value).chain([angle]);
    let crossed = |turned: f64| turned * angle.signum() <= 0.0 || turned.abs() >= PI;
    if let Some(turned) = all().find(|turned| angle == 0.0 || crossed(*turned)) {
        let message = format!(
            "the arm reaches the line of centres: its angle there is {}",
            rules.model.display.angle(turned)
        );
        let hint = "the angle at the pivot stays between 0 and 180 deg, or between -180 deg and 0";
        return Some((".angle", message, hint.to_owned()));
    }
    let radius = |turned: f64| {
        (arm * arm + distance * distance - 2.0 * arm * distance * turned.cos()).sqrt()
    };
    let least = all().map(radius).fold(f64::INFINITY, f64::min);
    (least <= roller).then(|| {
        let message = format!(
            "nothing is left of the cam: the roller's centre comes to {} of the cam's point",
            rules.model.display.length(least)
        );
        let hint =
            "a larger angle between arm and line of centres, or a smaller roller, leaves room";
        (".angle", message, hint.to_owned())
    })
}
