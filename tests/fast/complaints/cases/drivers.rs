//! Drivers and their motions.

use super::Case;

pub const CASES: &[Case] = &[
    Case {
        what: "driver of no body",
        edits: &[(r#""body": "crank""#, r#""body": "crnak""#)],
        sets: &[],
        complaints: &[
            r#"line 23, column 44: drivers.motor.body: "crnak": there is no body "crnak" (did you mean "crank"?)"#,
        ],
    },
    Case {
        what: "driver of a point",
        edits: &[(r#""body": "crank""#, r#""body": "crank.A""#)],
        sets: &[],
        complaints: &[
            r#"line 23, column 44: drivers.motor.body: "crank.A": a body is expected, this is a point (write "crank")"#,
        ],
    },
    Case {
        what: "driver of a body relative to itself",
        edits: &[(
            r#""body": "crank""#,
            r#""body": "crank", "relative_to": "crank""#,
        )],
        sets: &[],
        complaints: &[
            r#"line 23, column 44: drivers.motor.body: "crank": the angle of "crank" relative to itself cannot be driven"#,
        ],
    },
    Case {
        what: "two drivers of one angle",
        edits: &[(
            r#""drivers": {"#,
            "\"drivers\": {\n    \"first\": { \"type\": \"rotation\", \"body\": \"ground\", \"relative_to\": \"crank\", \"motion\": { \"type\": \"constant_velocity\", \"velocity\": 1 } },",
        )],
        sets: &[],
        complaints: &[
            r#"line 24, column 14: drivers.motor: the angle between "crank" and "ground" is driven by "first" already (keep one of them)"#,
        ],
    },
    Case {
        what: "translation of no joint",
        edits: &[(r#""joint": "e""#, r#""joint": "f""#)],
        sets: &[],
        complaints: &[
            r#"line 24, column 49: drivers.pusher.joint: "f": there is no joint "f" (the joints: a, b, c, d, e)"#,
        ],
    },
    Case {
        what: "translation of a revolute joint",
        edits: &[(r#""joint": "e""#, r#""joint": "a""#)],
        sets: &[],
        complaints: &[
            r#"line 24, column 49: drivers.pusher.joint: "a": this joint is revolute, neither prismatic nor slot (a translation drives the slide of a prismatic joint or a slot)"#,
        ],
    },
    Case {
        what: "length of one body, and of a point that is not there",
        edits: &[(
            r#""drivers": {"#,
            "\"drivers\": {\n    \"oil\": { \"type\": \"length\", \"between\": [\"crank.O\", \"crank.A\"], \"motion\": { \"type\": \"constant_velocity\", \"velocity\": 1 } },\n    \"air\": { \"type\": \"length\", \"between\": [\"crank.O\", \"rocker.Z\"], \"motion\": { \"type\": \"constant_velocity\", \"velocity\": 1 } },",
        )],
        sets: &[],
        complaints: &[
            r#"line 23, column 43: drivers.oil.between: both points are of "crank", whose distance is what it is (name points of two bodies)"#,
            r#"line 24, column 55: drivers.air.between[1]: "rocker.Z": body "rocker" has no point "Z" (its points: Q, B)"#,
        ],
    },
    Case {
        what: "two drivers of one length",
        edits: &[(
            r#""drivers": {"#,
            "\"drivers\": {\n    \"oil\": { \"type\": \"length\", \"between\": [\"crank.A\", \"ground.Q\"], \"motion\": { \"type\": \"constant_velocity\", \"velocity\": 1 } },\n    \"air\": { \"type\": \"length\", \"between\": [\"ground.Q\", \"crank.A\"], \"motion\": { \"type\": \"constant_velocity\", \"velocity\": 1 } },",
        )],
        sets: &[],
        complaints: &[
            r#"line 24, column 12: drivers.air: the distance of crank.A and ground.Q is driven by "oil" already (keep one of them)"#,
        ],
    },
    Case {
        what: "length that is an angle, between nothing",
        edits: &[(
            r#""drivers": {"#,
            "\"drivers\": {\n    \"oil\": { \"type\": \"length\", \"motion\": { \"type\": \"constant_velocity\", \"start\": \"20 deg\", \"velocity\": 1 } },",
        )],
        sets: &[],
        complaints: &[
            r#"line 23, column 12: drivers.oil: "between" is missing (the two ends, as in "between": ["ground.A", "crank.A"])"#,
            r#"line 23, column 82: drivers.oil.motion.start: "20 deg": "deg" is not a unit of length (such as "m")"#,
        ],
    },
    Case {
        what: "coefficient of another order",
        edits: &[(r#"[60, "10 rad/s"]"#, r#"[60, 0, "10 rad/s"]"#)],
        sets: &[],
        complaints: &[
            r#"line 23, column 111: drivers.motor.motion.coefficients[2]: "10 rad/s": "rad/s" is not a unit of angular acceleration (such as "rad/s^2")"#,
        ],
    },
    Case {
        what: "coefficient of another dimension",
        edits: &[(r#"[60, "10 rad/s"]"#, r#"["60 mm", 0, 0, "1 mm/s^3"]"#)],
        sets: &[],
        complaints: &[
            r#"line 23, column 104: drivers.motor.motion.coefficients[0]: "60 mm": "mm" is not a unit of angle (such as "rad")"#,
            r#"line 23, column 119: drivers.motor.motion.coefficients[3]: "1 mm/s^3": "mm/s^3" is not a unit of angle per second^3 (such as "rad/s^3")"#,
        ],
    },
    Case {
        what: "polynomial without coefficients",
        edits: &[(r#"[60, "10 rad/s"]"#, "[]")],
        sets: &[],
        complaints: &[
            "line 23, column 103: drivers.motor.motion.coefficients: a list of at least 1 is expected, this one has 0",
        ],
    },
    Case {
        what: "motion unknown",
        edits: &[(r#""polynomial""#, r#""sine""#)],
        sets: &[],
        complaints: &[
            r#"line 23, column 73: drivers.motor.motion.type: "sine": unknown type (did you mean "harmonic"?)"#,
        ],
    },
    Case {
        what: "table of one point",
        edits: &[("[[0, 0], [1, 5]]", "[[0, 0]]")],
        sets: &[],
        complaints: &[
            "line 24, column 93: drivers.pusher.motion.points: a list of at least 2 is expected, this one has 1",
        ],
    },
    Case {
        what: "table that goes back in time",
        edits: &[("[[0, 0], [1, 5]]", r#"[[0, 0], [1, 5], ["900 ms", 6]]"#)],
        sets: &[],
        complaints: &[
            r#"line 24, column 111: drivers.pusher.motion.points[2][0]: "900 ms": the time is not later than that of the point before (the times of a table increase)"#,
        ],
    },
    Case {
        what: "table with a short point",
        edits: &[("[[0, 0], [1, 5]]", "[[0, 0], [1]]")],
        sets: &[],
        complaints: &[
            "line 24, column 102: drivers.pusher.motion.points[1]: a list of 2 is expected, this one has 1",
        ],
    },
];
