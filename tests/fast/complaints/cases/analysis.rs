//! Forces, initial values and the analysis.

use super::Case;

pub const CASES: &[Case] = &[
    Case {
        what: "spring with neither stiffness nor damping",
        edits: &[(r#""stiffness": 200, "#, "")],
        sets: &[],
        complaints: &[
            r#"line 27, column 15: forces.return: "stiffness" is missing (with "damping" alone it would be a damper)"#,
        ],
    },
    Case {
        what: "force at no point",
        edits: &[(r#""at": "coupler.B""#, r#""at": "coupler.b""#)],
        sets: &[],
        complaints: &[
            r#"line 28, column 38: forces.load.at: "coupler.b": body "coupler" has no point "b" (did you mean "coupler.B"? its points: A, B)"#,
        ],
    },
    Case {
        what: "force varies as a torque",
        edits: &[(
            r#""vector": [0, 5]"#,
            r#""vector": [0, { "type": "harmonic", "amplitude": "5 N*m", "frequency": 1 }]"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 28, column 100: forces.load.vector[1].amplitude: "5 N*m": "N*m" is not a unit of force (such as "N")"#,
        ],
    },
    Case {
        what: "frame unknown",
        edits: &[(
            r#""vector": [0, 5]"#,
            r#""vector": [0, 5], "frame": "world""#,
        )],
        sets: &[],
        complaints: &[
            r#"line 28, column 78: forces.load.frame: "world": unknown frame (one of "ground" or "body")"#,
        ],
    },
    Case {
        what: "initial of ground and of nobody",
        edits: &[(
            r#""initial": { "crank""#,
            r#""initial": { "ground": {}, "krank""#,
        )],
        sets: &[],
        complaints: &[
            "line 30, column 26: initial.ground: ground is fixed, it has no initial values",
            r#"line 30, column 39: initial.krank: there is no body "krank" (did you mean "crank"?)"#,
        ],
    },
    Case {
        what: "point twice",
        edits: &[(r#"["coupler.B"]"#, r#"["coupler.B", "coupler.B"]"#)],
        sets: &[],
        complaints: &[
            r#"line 31, column 27: points[1]: "coupler.B": the point is listed twice (first as points[0])"#,
        ],
    },
    Case {
        what: "analysis unknown",
        edits: &[(r#""inverse_dynamics""#, r#""inverse dynamics""#)],
        sets: &[],
        complaints: &[
            r#"line 32, column 25: analysis.type: "inverse dynamics": unknown type (did you mean "inverse_dynamics"?)"#,
        ],
    },
    Case {
        what: "both ways to say when",
        edits: &[(
            r#""outputs": 401"#,
            r#""outputs": 401, "sample": { "driver": "motor", "from": 0, "to": 360, "step": 1 }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 32, column 52: analysis.end: 2.0: "end" and "sample" exclude each other (keep one of them)"#,
        ],
    },
    Case {
        what: "neither way to say when",
        edits: &[(r#", "end": 2.0, "outputs": 401"#, "")],
        sets: &[],
        complaints: &[
            r#"line 32, column 15: analysis: it is not said for which instants (give "end" and "outputs", or "sample")"#,
        ],
    },
    Case {
        what: "outputs missing",
        edits: &[(r#", "outputs": 401"#, "")],
        sets: &[],
        complaints: &[
            r#"line 32, column 15: analysis: "outputs" is missing (the number of output instants, both ends included)"#,
        ],
    },
    Case {
        what: "end missing",
        edits: &[(r#""end": 2.0, "#, "")],
        sets: &[],
        complaints: &[
            r#"line 32, column 15: analysis: "end" is missing (the end time, the start is 0)"#,
        ],
    },
    Case {
        what: "end and outputs out of range",
        edits: &[(r#""end": 2.0, "outputs": 401"#, r#""end": 0, "outputs": 1"#)],
        sets: &[],
        complaints: &[
            "line 32, column 52: analysis.end: 0: must be greater than 0",
            "line 32, column 66: analysis.outputs: 1: must not be less than 2",
        ],
    },
    Case {
        what: "outputs not whole",
        edits: &[("401", "401.5")],
        sets: &[],
        complaints: &["line 32, column 68: analysis.outputs: 401.5: a whole number is expected"],
    },
    Case {
        what: "sample of no driver, step zero",
        edits: &[(
            r#""end": 2.0, "outputs": 401"#,
            r#""sample": { "driver": "engine", "from": 0, "to": 360, "step": 1 }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 32, column 67: analysis.sample.driver: "engine": there is no driver "engine" (the drivers: motor, pusher)"#,
        ],
    },
    Case {
        what: "sample step zero, limit of another dimension",
        edits: &[(
            r#""end": 2.0, "outputs": 401"#,
            r#""sample": { "driver": "motor", "from": 0, "to": "1 m", "step": 0 }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 32, column 93: analysis.sample.to: "1 m": "m" is not a unit of angle (such as "rad")"#,
            "line 32, column 108: analysis.sample.step: 0: must not be zero",
        ],
    },
    Case {
        what: "column that is no text",
        edits: &[(
            r#""outputs": 401"#,
            r#""outputs": 401, "columns": ["crank.*", 5]"#,
        )],
        sets: &[],
        complaints: &["line 32, column 96: analysis.columns[1]: 5: text is expected, not a number"],
    },
    Case {
        what: "solver option unknown",
        edits: &[(
            r#""outputs": 401"#,
            r#""outputs": 401, "solver": { "tol": 1e-9, "rtol": 0 }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 32, column 85: analysis.solver.tol: "tol": unknown key (did you mean "atol"?)"#,
            "line 32, column 106: analysis.solver.rtol: 0: must be greater than 0",
        ],
    },
];
