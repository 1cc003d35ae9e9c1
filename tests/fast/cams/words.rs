//! Bad cams.

use super::*;
use linkdyn_model::load;

/// A cam, and what is said of it.
type Case = (Value, &'static str);

#[track_caller]
fn are_told(cases: Vec<Case>) {
    for (cam, expected) in cases {
        let model = sliding(cam, 0.0, 0.0).to_string();
        let faults = load(model.as_bytes(), &[])
            .expect_err("refused")
            .to_string();
        let at = faults.find("joints.").unwrap_or(0);
        assert_eq!(&faults[at..], expected);
    }
}

fn circle() -> Value {
    json!({ "type": "circle", "radius": 0.04 })
}

fn up() -> Value {
    json!({ "law": "cycloidal", "rise": 0.01, "angle": "100 deg" })
}

fn down() -> Value {
    json!({ "law": "cycloidal", "rise": -0.01, "angle": "100 deg" })
}

fn roller(profile: Value) -> Value {
    json!({ "follower": "roller", "roller_radius": 0.01, "profile": profile })
}

fn law(segments: Value) -> Value {
    roller(json!({ "type": "law", "base_radius": 0.04, "axis": [0, 1], "segments": segments }))
}

#[test]
fn faults_of_followers_are_told() {
    are_told(vec![
        (
            json!({ "follower": "flat", "profile": circle() }),
            "joints.c: \"face\" is missing, a flat follower needs its direction (in the follower's frame, the cam to its \
             right, as in \"face\": [1, 0] for a face above the cam)",
        ),
        (
            json!({ "follower": "roller", "profile": circle() }),
            "joints.c: \"roller_radius\" is missing (as in \"roller_radius\": \"8 mm\"; what has none is \"follower\": \
             \"knife\")",
        ),
        (
            json!({ "follower": "knife", "roller_radius": 0.01, "profile": circle() }),
            "joints.c.roller_radius: 0.01: only a roller has a radius (leave it out, or write \"follower\": \"roller\")",
        ),
        (
            json!({ "follower": "knife", "face": [1, 0], "profile": circle() }),
            "joints.c.face: only a flat follower has a face (leave it out, or write \"follower\": \"flat\")",
        ),
        (
            json!({ "follower": "roller", "roller_radius": -0.01, "profile": circle() }),
            "joints.c.roller_radius: -0.01: must be greater than 0",
        ),
        (
            json!({ "follower": "pointed", "profile": circle() }),
            "joints.c.follower: \"pointed\": unknown follower (one of \"flat\", \"roller\" or \"knife\")",
        ),
        (
            json!({ "follower": "knife" }),
            "joints.c: \"profile\" is missing",
        ),
        (
            json!({ "follower": "knife", "profile": { "type": "ellipse" } }),
            "joints.c.profile.type: \"ellipse\": unknown type (one of \"circle\", \"points\", \"law\" or \"swing\")",
        ),
        (
            json!({ "follower": "knife", "limits": [0, 1], "profile": circle() }),
            "joints.c.limits: \"limits\": a cam turns without end: give limits to the joints that hold cam and follower",
        ),
        (
            json!({ "follower": "knife", "profile": circle(), "between": ["cam.C", "cam.C"] }),
            "joints.c.between: both points are of \"cam\" (a joint connects two bodies)",
        ),
    ]);
}

#[test]
fn faults_of_shapes_are_told() {
    are_told(vec![
        (
            roller(json!({ "type": "circle", "radius": 0.0 })),
            "joints.c.profile.radius: 0.0: must be greater than 0",
        ),
        (
            roller(json!({ "type": "circle", "radius": 0.04, "centre": [0.04, 0.01] })),
            "joints.c.profile: the circle does not go around the cam's point: its centre is 0.0412311 m from it, its \
             radius 0.04 m (an eccentric is larger than its eccentricity)",
        ),
        (
            roller(json!({ "type": "points", "points": [[1, 0], [0, 1], [-1, 0], [0, -1]] })),
            "joints.c.profile.points: a list of at least 8 is expected, this one has 4",
        ),
        (
            roller(
                json!({ "type": "points", "points": [[1, 0], [2, 1], [0, 1], [1, 2], [-1, 0], [-1, -1], [0, -1], [1, -1]] }),
            ),
            "joints.c.profile.points: the curve is not star-shaped: seen from the cam's point, the points do not go once \
             around in one sense (list them in their order around the cam's point, and the first one once only)",
        ),
        (
            roller(
                json!({ "type": "law", "base_radius": 0.0, "axis": [0, 1], "segments": [up(), down()] }),
            ),
            "joints.c.profile.base_radius: 0.0: must be greater than 0",
        ),
        (
            roller(json!({ "type": "law", "base_radius": 0.04, "segments": [up(), down()] })),
            "joints.c.profile: \"axis\" is missing, the direction in which the follower slides (in the follower's frame, \
             away from the cam, as in \"axis\": [0, 1])",
        ),
        (
            roller(
                json!({ "type": "law", "base_radius": 0.04, "axis": [0, 1], "offset": 0.05, "segments": [up(), down()] }),
            ),
            "joints.c.profile.offset: 0.05: the line of motion misses the base circle: the offset 0.05 m is not less than \
             0.05 m (the offset is less than the base radius and the roller's together)",
        ),
        (
            json!({ "follower": "flat", "face": [1, 0], "profile": { "type": "law", "base_radius": 0.04, "axis": [0, 1], "segments": [up(), down()] } }),
            "joints.c.profile.axis: the motion of a flat follower needs no axis (a flat follower slides across its face; \
             leave it out)",
        ),
        (
            json!({ "follower": "flat", "face": [1, 0], "profile": { "type": "law", "base_radius": 0.04, "offset": 0.01, "segments": [up(), down()] } }),
            "joints.c.profile.offset: 0.01: a flat follower has no offset (the profile under a flat face does not depend \
             on where the face is guided; leave it out)",
        ),
        (
            json!({ "follower": "flat", "face": [0, 0], "profile": circle() }),
            "joints.c.face: both components are zero, which is no direction",
        ),
    ]);
}

#[test]
fn faults_of_segments_are_told() {
    are_told(vec![
        (
            law(json!([up()])),
            "joints.c.profile.segments: the follower does not return: after a turn it is 0.01 m from where it began (the \
             rises of a turn come to nothing, as in \"rise\": \"20 mm\" and later \"rise\": \"-20 mm\", or \"end\": 0)",
        ),
        (
            law(json!([])),
            "joints.c.profile.segments: a list of at least 1 is expected, this one has 0",
        ),
        (
            law(json!([up(), down(), { "dwell": "200 deg" }])),
            "joints.c.profile.segments: the segments go over 400 deg, more than a turn (the angles of rises and dwells \
             come to 360 deg at most; what is left is a dwell)",
        ),
        (
            law(json!([{ "law": "cycloidal", "angle": "100 deg" }, down()])),
            "joints.c.profile.segments[0]: \"rise\" is missing (how far it goes; back with the other sign, or \"end\": 0 \
             to where it began)",
        ),
        (
            law(json!([{ "law": "cycloidal", "rise": 0.01 }, down()])),
            "joints.c.profile.segments[0]: \"angle\" is missing (the angle of the cam over which it goes, as in \"angle\": \
             \"120 deg\")",
        ),
        (
            law(json!([{ "law": "cycloidal", "rise": 0.01, "duration": 1.0 }, down()])),
            "joints.c.profile.segments[0]: \"angle\" is missing (the angle of the cam over which it goes, as in \"angle\": \
             \"120 deg\")\nline 1, column 674: joints.c.profile.segments[0].duration: \"duration\": a cam goes by its \
             angle: write \"angle\"",
        ),
        (
            law(json!([{ "rise": 0.01, "angle": 1.0 }, down()])),
            "joints.c.profile.segments[0]: \"law\" is missing (a segment is a rise, as in { \"law\": \"cycloidal\", \
             \"rise\": …, \"angle\": \"120 deg\" }, or { \"dwell\": \"60 deg\" })",
        ),
        (
            law(json!([{ "dwell": 1.0, "angle": 1.0 }])),
            "joints.c.profile.segments[0].angle: 1.0: a dwell has no \"angle\" (\"dwell\" says over which angle it stays; \
             what moves has a \"law\")",
        ),
        (
            law(json!([{ "law": "cycloidal", "rise": 0.01, "angle": 1.0, "ramp": 0.2 }, down()])),
            "joints.c.profile.segments[0].ramp: 0.2: this law has no \"ramp\" (\"trapezoidal_velocity\" has a \"ramp\", \
             \"s_curve\" a \"ramp\" and a \"rounding\")",
        ),
        (
            law(
                json!([{ "law": "cycloidal", "rise": -0.06, "angle": 1.0 }, { "law": "cycloidal", "end": 0, "angle": 1.0 }]),
            ),
            "joints.c.profile.segments: the follower comes down to the cam's point: 0.06 m below where it began (rises \
             away from the cam are positive; a larger base radius leaves room)",
        ),
        (
            law(json!([{ "law": "cycloidal", "rise": "2 deg", "angle": 1.0 }, down()])),
            "joints.c.profile.segments[0].rise: \"2 deg\": \"deg\" is not a unit of length (such as \"m\")",
        ),
    ]);
}

#[test]
fn faults_of_arms_are_told() {
    are_told(vec![
        (
            json!({ "follower": "flat", "face": [1, 0], "profile": { "type": "swing", "arm": 0.08, "distance": 0.1, "axis": [1, 0], "angle": 0.5, "segments": [{ "dwell": 1.0 }] } }),
            "joints.c.profile.type: \"swing\": the profile under a flat face that swings is not made from its motion (give \
             the profile by a circle or points, or take a roller)",
        ),
        (
            roller(
                json!({ "type": "swing", "arm": 0.08, "distance": 0.1, "axis": [1, 0], "angle": 0.2, "segments": [{ "law": "cycloidal", "rise": -0.3, "angle": 1.0 }, { "law": "cycloidal", "end": 0, "angle": 1.0 }] }),
            ),
            "joints.c.profile.angle: 0.2: the arm reaches the line of centres: its angle there is -0.1 rad (-5.72958°) \
             (the angle at the pivot stays between 0 and 180 deg, or between -180 deg and 0)",
        ),
        (
            roller(
                json!({ "type": "swing", "arm": 0.1, "distance": 0.1, "axis": [1, 0], "angle": 0.05, "segments": [{ "dwell": 1.0 }] }),
            ),
            "joints.c.profile.angle: 0.05: nothing is left of the cam: the roller's centre comes to 0.00499948 m of the \
             cam's point (a larger angle between arm and line of centres, or a smaller roller, leaves room)",
        ),
    ]);
}
