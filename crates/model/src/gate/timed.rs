//! Joints that close and open at events.

use super::Rules;
use crate::error::Complaint;
use crate::event::Event;
use crate::response::Catalogue;
use crate::{AnalysisKind, Joint, Timed};

/// The keys under which something of a joint holds for a time.
fn of(joint: &Joint) -> [(&'static str, Option<&Timed>); 2] {
    [
        ("active", joint.stops.active.as_deref()),
        ("lock", joint.stops.lock.as_deref()),
    ]
}

/// What closes or opens has an event for that, and is a joint that can be open.
pub(super) fn joint(rules: &mut Rules<'_>, joint: &Joint, path: &str) {
    if rules.holes.has(&format!("{path}.type")) {
        return;
    }
    for (key, timed) in of(joint) {
        let Some(timed) = timed else { continue };
        let at = format!("{path}.{key}");
        let known = |rules: &Rules<'_>, key: &str| !rules.holes.has(&format!("{at}.{key}"));
        if rules.holes.has(&at) {
            continue;
        }
        let all_known = ["from", "until", "release"]
            .iter()
            .all(|key| known(rules, key));
        if timed == &Timed::default() && all_known {
            let message = "it neither closes nor opens";
            let hint = "say from when or until when it holds, as in \"from\": \"time >= 1 s\"";
            rules.complain(&at, message, hint);
        }
        let has_end = timed.until.is_some() || timed.release.is_some();
        if let (Some(from), Some(until)) = (&timed.from, &timed.until)
            && from == until
        {
            let message = "it opens at the event at which it closes";
            rules.complain(
                format!("{at}.until"),
                message,
                "let it open at another event",
            );
        }
        if key == "active" {
            whole(rules, joint, &at, has_end);
        } else if !joint.kind.has("lock") {
            let hint = "revolute and prismatic joints and slots can";
            rules.complain(&at, "this joint can't be locked", hint);
        }
    }
    let has_one_way = joint.stops.one_way.is_some();
    if has_one_way && !joint.kind.has("one_way") {
        let at = format!("{path}.one_way");
        rules.complain(at, "only a revolute joint turns", "leave it out");
    }
}

/// What a joint that may be open can't have.
fn whole(rules: &mut Rules<'_>, joint: &Joint, at: &str, has_end: bool) {
    if !joint.kind.has("active") {
        let hint = "revolute, prismatic, slot and fixed joints can";
        return rules.complain(at, "this joint can't be open", hint);
    }
    let stops = &joint.stops;
    let given = [
        ("clearance", joint.kind.clearance().is_some()),
        ("friction", joint.kind.friction().is_some()),
        ("limits", stops.limits.is_some()),
        ("one_way", stops.one_way.is_some()),
        ("lock", stops.lock.is_some()),
    ];
    if let Some((key, _)) = given.iter().find(|(_, is_given)| *is_given) {
        let when = if has_end { "opens" } else { "is open at first" };
        let message = format!("a joint that {when} is ideal, and this one has \"{key}\"");
        rules.complain(
            at,
            message,
            format!("leave out \"{key}\", or give it to another joint"),
        );
    }
}

/// Why a motion is not free.
pub(super) fn not_free(kind: AnalysisKind) -> Option<&'static str> {
    match kind {
        AnalysisKind::Kinematics | AnalysisKind::InverseDynamics => {
            Some("drivers prescribe this one")
        }
        AnalysisKind::QuasiStatics => Some("quasi-statics has none"),
        AnalysisKind::Assembly | AnalysisKind::Dynamics | AnalysisKind::Statics => None,
    }
}

/// Events can be evaluated, and the motion is one that has them.
pub(super) fn events(rules: &mut Rules<'_>) {
    let model = rules.model;
    let kind = model.analysis.as_ref().map(|analysis| analysis.kind);
    let why = kind.and_then(not_free);
    let mut catalogue = None;
    for (name, joint) in &model.joints {
        for (key, timed) in of(joint) {
            let Some(timed) = timed else { continue };
            let path = format!("joints.{name}.{key}");
            if let Some(why) = why
                && !rules.holes.has("analysis.type")
            {
                let message = format!("what closes or opens needs a free motion, and {why}");
                let hint =
                    "take \"dynamics\", where drivers may leave something free, or leave it out";
                rules.complain(&path, message, hint);
            }
            for (key, event) in [("from", &timed.from), ("until", &timed.until)] {
                if let Some(event) = event {
                    self::event(rules, &mut catalogue, event, format!("{path}.{key}"));
                }
            }
        }
    }
}

fn event(rules: &mut Rules<'_>, catalogue: &mut Option<Catalogue>, event: &Event, path: String) {
    // a name that is faulty elsewhere is not blamed once more
    if !rules.complaints.is_empty() || !rules.holes.is_empty() {
        return;
    }
    let catalogue = catalogue.get_or_insert_with(|| Catalogue::of(rules.model));
    if let Err(complaint) = event.compile(catalogue) {
        rules.complaints.push(Complaint { path, ..complaint });
    }
}
