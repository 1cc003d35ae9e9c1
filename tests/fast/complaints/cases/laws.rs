//! Laws of motion: rises, sequences, tables.

use super::Case;

/// The motion of the base model that is exchanged.
const TABLE: &str = r#"{ "type": "table", "points": [[0, 0], [1, 5]] }"#;

pub const CASES: &[Case] = &[
    Case {
        what: "a rise of no height",
        edits: &[(TABLE, r#"{ "type": "cycloidal", "duration": "0.2 s" }"#)],
        sets: &[],
        complaints: &[
            r#"line 24, column 64: drivers.pusher.motion: "rise" is missing (how far it goes, as in "rise": "30 deg", or "end", where to)"#,
        ],
    },
    Case {
        what: "a rise that is said twice",
        edits: &[(
            TABLE,
            r#"{ "type": "modified_sine", "rise": 5, "end": 6, "duration": "0.2 s" }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 24, column 109: drivers.pusher.motion.end: 6: "rise" and "end" exclude each other (keep one of them)"#,
        ],
    },
    Case {
        what: "a rise without time",
        edits: &[(TABLE, r#"{ "type": "polynomial_3_4_5", "rise": 5 }"#)],
        sets: &[],
        complaints: &[
            r#"line 24, column 64: drivers.pusher.motion: "duration" is missing (as in "duration": "0.2 s")"#,
        ],
    },
    Case {
        what: "a rise in no time",
        edits: &[(
            TABLE,
            r#"{ "type": "polynomial_4_5_6_7", "rise": 5, "duration": 0 }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 24, column 119: drivers.pusher.motion.duration: 0: must be greater than 0"#,
        ],
    },
    Case {
        what: "a rise whose name is nearly right",
        edits: &[(
            TABLE,
            r#"{ "type": "polynomial_345", "rise": 5, "duration": 1 }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 24, column 74: drivers.pusher.motion.type: "polynomial_345": unknown type (did you mean "polynomial_3_4_5"?)"#,
        ],
    },
    Case {
        what: "a velocity without its point",
        edits: &[(
            TABLE,
            r#"{ "type": "table", "points": [[0, 0], [1, 5]], "velocities": [0, 1, 2] }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 24, column 125: drivers.pusher.motion.velocities: there are 3 velocities for 2 points (one for each point, in the same order)"#,
        ],
    },
    Case {
        what: "velocities beside an interpolation",
        edits: &[(
            TABLE,
            r#"{ "type": "table", "points": [[0, 0], [1, 5]], "velocities": [0, 1], "interpolation": "monotone" }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 24, column 150: drivers.pusher.motion.interpolation: "monotone": "velocities" say what is between the points (leave "interpolation" out, or "velocities")"#,
        ],
    },
    Case {
        what: "ramps that overlap",
        edits: &[(
            TABLE,
            r#"{ "type": "trapezoidal_velocity", "rise": 5, "duration": 1, "ramp": 0.6 }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 24, column 132: drivers.pusher.motion.ramp: 0.6: must not be greater than 0.5 (a ramp up and one down take all the time there is)"#,
        ],
    },
    Case {
        what: "a duration and a limit",
        edits: &[(
            TABLE,
            r#"{ "type": "trapezoidal_velocity", "rise": 5, "duration": 1, "acceleration": 7 }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 24, column 140: drivers.pusher.motion.acceleration: 7: "duration" and "acceleration" exclude each other (say how long it takes, or what it may reach: each follows from the other)"#,
        ],
    },
    Case {
        what: "a duration and a velocity",
        edits: &[(
            TABLE,
            r#"{ "type": "s_curve", "end": 5, "duration": 1, "velocity": 7 }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 24, column 122: drivers.pusher.motion.velocity: 7: "duration" and "velocity" exclude each other (keep one of them)"#,
        ],
    },
    Case {
        what: "neither duration nor limits",
        edits: &[(TABLE, r#"{ "type": "s_curve", "rise": 5 }"#)],
        sets: &[],
        complaints: &[
            r#"line 24, column 64: drivers.pusher.motion: "duration" is missing (say how long it takes, as in "duration": "0.2 s", or what it may reach, by "velocity" and "acceleration")"#,
        ],
    },
    Case {
        what: "limits that are not enough",
        edits: &[(
            TABLE,
            r#"{ "type": "s_curve", "rise": 5, "velocity": 1, "acceleration": 9 }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 24, column 64: drivers.pusher.motion: "jerk" is missing (without "duration" the greatest velocity, acceleration and jerk say how long it takes)"#,
        ],
    },
    Case {
        what: "a share of what follows",
        edits: &[(
            TABLE,
            r#"{ "type": "trapezoidal_velocity", "rise": 5, "velocity": 1, "acceleration": 9, "ramp": 0.2 }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 24, column 151: drivers.pusher.motion.ramp: 0.2: "ramp" is a share of a "duration" (here it follows from the limits)"#,
        ],
    },
    Case {
        what: "a jerk that has no limit",
        edits: &[(
            TABLE,
            r#"{ "type": "trapezoidal_velocity", "rise": 5, "velocity": 1, "acceleration": 9, "jerk": 8 }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 24, column 143: drivers.pusher.motion.jerk: "jerk": unknown key (known keys: type, start, rise, end, begin, duration, ramp, velocity, acceleration, note)"#,
        ],
    },
    Case {
        what: "a rounding beyond the ramp",
        edits: &[(
            TABLE,
            r#"{ "type": "s_curve", "rise": 5, "duration": 1, "rounding": 1.2 }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 24, column 123: drivers.pusher.motion.rounding: 1.2: must not be greater than 1 (the share of a ramp in which the acceleration changes)"#,
        ],
    },
    Case {
        what: "a driver with corners",
        edits: &[(
            TABLE,
            r#"{ "type": "table", "interpolation": "linear", "points": [[0, 0], [1, 5]] }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 24, column 100: drivers.pusher.motion.interpolation: "linear": a linear table has corners, which no driver can follow ("monotone" and "natural" have none; "linear" is for forces)"#,
        ],
    },
    Case {
        what: "an interpolation that there is not",
        edits: &[(
            TABLE,
            r#"{ "type": "table", "interpolation": "quadratic", "points": [[0, 0], [1, 5]] }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 24, column 100: drivers.pusher.motion.interpolation: "quadratic": unknown interpolation (one of "natural", "linear", "monotone" or "periodic")"#,
        ],
    },
    Case {
        what: "a sequence of nothing",
        edits: &[(TABLE, r#"{ "type": "sequence", "segments": [] }"#)],
        sets: &[],
        complaints: &[
            r#"line 24, column 98: drivers.pusher.motion.segments: a list of at least 1 is expected, this one has 0"#,
        ],
    },
    Case {
        what: "segments that are neither rise nor dwell",
        edits: &[(
            TABLE,
            r#"{ "type": "sequence", "segments": [{ "rise": 5 }, { "law": "cycloidal", "dwell": 1 }, { "dwell": 1, "rise": 4 }] }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 24, column 99: drivers.pusher.motion.segments[0]: "law" is missing (a segment is a rise, as in { "law": "cycloidal", "rise": "30 deg", "duration": "0.2 s" }, or { "dwell": "0.1 s" })"#,
            r#"line 24, column 145: drivers.pusher.motion.segments[1].dwell: 1: "law" and "dwell" exclude each other (keep one of them)"#,
            r#"line 24, column 172: drivers.pusher.motion.segments[2].rise: 4: a dwell has no "rise" ("dwell" says how long it stays; what moves has a "law")"#,
        ],
    },
    Case {
        what: "segments that miss something",
        edits: &[(
            TABLE,
            r#"{ "type": "sequence", "segments": [{ "law": "cycloidal", "duration": 1 }, { "law": "cycloidal", "rise": 1 }, { "law": "cycloid", "rise": 1, "duration": 1 }] }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 24, column 99: drivers.pusher.motion.segments[0]: "rise" is missing (how far it goes, as in "rise": "30 deg", or "end", where to)"#,
            r#"line 24, column 138: drivers.pusher.motion.segments[1]: "duration" is missing (how long the rise takes, as in "duration": "0.2 s")"#,
            r#"line 24, column 182: drivers.pusher.motion.segments[2].law: "cycloid": unknown law (did you mean "cycloidal"?)"#,
        ],
    },
    Case {
        what: "a ramp of a law that has none",
        edits: &[(
            TABLE,
            r#"{ "type": "sequence", "repeat": 0, "segments": [{ "law": "cycloidal", "rise": 5, "duration": 1, "ramp": 0.2 }] }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 24, column 96: drivers.pusher.motion.repeat: 0: must not be less than 1"#,
            r#"line 24, column 168: drivers.pusher.motion.segments[0].ramp: 0.2: this law has no "ramp" ("trapezoidal_velocity" has a "ramp", "s_curve" a "ramp" and a "rounding")"#,
        ],
    },
    Case {
        what: "a force that jumps from period to period",
        edits: &[(
            r#""vector": [0, 5]"#,
            r#""vector": [0, { "type": "table", "interpolation": "periodic", "points": [[0, 0], [1, 5]] }]"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 28, column 136: forces.load.vector[1].points[1][1]: 5: the last value of a periodic table is not its first (the last point is the first one of the next period; a force has the same value there)"#,
        ],
    },
];
