//! Bodies and points.

use super::Case;

pub const CASES: &[Case] = &[
    Case {
        what: "ground with mass and pose",
        edits: &[(r#""ground": { "#, r#""ground": { "mass": 1, "pose": {}, "#)],
        sets: &[],
        complaints: &[
            r#"line 7, column 17: bodies.ground.mass: "mass": ground is fixed, a mass of it would mean nothing"#,
            r#"line 7, column 28: bodies.ground.pose: "pose": ground is fixed, its frame is the global one"#,
        ],
    },
    Case {
        what: "negative mass and inertia, both at once",
        edits: &[(
            r#""mass": 0.8, "inertia": 7e-4"#,
            r#""mass": -0.8, "inertia": "-7 kg*mm^2""#,
        )],
        sets: &[],
        complaints: &[
            "line 8, column 24: bodies.crank.mass: -0.8: must not be negative",
            r#"line 8, column 41: bodies.crank.inertia: "-7 kg*mm^2": must not be negative"#,
        ],
    },
    Case {
        what: "centre of mass missing",
        edits: &[(r#", "com": [50, 0]"#, "")],
        sets: &[],
        complaints: &[
            r#"line 8, column 14: bodies.crank: "com" is missing, it has no default where there is mass (give the centre of mass in the body's frame, as in "com": [0, 0])"#,
        ],
    },
    Case {
        what: "points misspelt, references to them not missed",
        edits: &[(
            r#""points": { "O": [0, 0], "A""#,
            r#""pionts": { "O": [0, 0], "A""#,
        )],
        sets: &[],
        complaints: &[
            r#"line 9, column 7: bodies.crank.pionts: "pionts": unknown key (did you mean "points"?)"#,
        ],
    },
    Case {
        what: "key far from all",
        edits: &[(r#""pose""#, r#""colour""#)],
        sets: &[],
        complaints: &[
            r#"line 9, column 49: bodies.crank.colour: "colour": unknown key (known keys: mass, inertia, com, points, pose, section, elastic, note)"#,
        ],
    },
    Case {
        what: "note of another type",
        edits: &[(r#""measured""#, r#"["measured"]"#)],
        sets: &[],
        complaints: &["line 11, column 67: bodies.rocker.note: text is expected, not a list"],
    },
    Case {
        what: "name with a dot, references to it not missed",
        edits: &[
            (r#""rocker": {"#, r#""rock.er": {"#),
            ("rocker.B", "rock.er.B"),
            ("rocker.Q", "rock.er.Q"),
        ],
        sets: &[],
        complaints: &[
            r#"line 11, column 5: bodies.rock.er: "rock.er": a name must not contain "." (nor any of . [ ] , = * ? and control characters)"#,
        ],
    },
    Case {
        what: "empty name",
        edits: &[(r#""load": {"#, r#""": {"#)],
        sets: &[],
        complaints: &[r#"line 28, column 5: forces.: "": a name must not be empty"#],
    },
    Case {
        what: "name with a control character",
        edits: &[(r#""load": {"#, r#""lo\tad": {"#)],
        sets: &[],
        complaints: &[
            r#"line 28, column 5: forces.lo ad: "lo ad": a name must not contain "\t" (nor any of . [ ] , = * ? and control characters)"#,
        ],
    },
    Case {
        what: "bodies far from all",
        edits: &[(r#""bodies": {"#, r#""parts": {"#)],
        sets: &[],
        complaints: &[
            r#"line 1, column 1: "bodies" is missing (as in "bodies": { "crank": { "points": { "A": [0, 0], "B": [50, 0] } } })"#,
            r#"line 6, column 3: parts: "parts": unknown key (known keys: format, units, parameters, name, about, source, gravity, bodies, joints, drivers, forces, tables, inputs, states, initial, points, measures, analysis, accuracy, outputs, responses, study, optimise, synthesise, note)"#,
        ],
    },
    Case {
        what: "no bodies",
        edits: &[(r#""bodies": {"#, r#""bodies": {}, "initials": {"#)],
        sets: &[],
        complaints: &[
            "line 6, column 13: bodies: it is empty, at least one is needed",
            r#"line 6, column 17: initials: "initials": unknown key (known keys: format, units, parameters, name, about, source, gravity, bodies, joints, drivers, forces, tables, inputs, states, initial, points, measures, analysis, accuracy, outputs, responses, study, optimise, synthesise, note)"#,
        ],
    },
];
