//! What people write who mean the right thing.

use super::Case;

pub const CASES: &[Case] = &[
    Case {
        what: "units that are written out",
        edits: &[
            (
                r#""length": "mm", "angle": "deg""#,
                r#""length": "inch", "angle": "degrees""#,
            ),
            ("[100, 0]", r#"["5 inches", "1 millimeter"]"#),
            (r#""vector": [0, 5]"#, r#""vector": [0, "5 Newton"]"#),
        ],
        sets: &[],
        complaints: &[
            r#"line 4, column 24: units.length: "inch": unknown unit "inch" (did you mean "in"?)"#,
            r#"line 4, column 41: units.angle: "degrees": unknown unit "degrees" (did you mean "deg"?)"#,
            r#"line 9, column 38: bodies.crank.points.A[0]: "5 inches": unknown unit "inches" (did you mean "in"?)"#,
            r#"line 9, column 50: bodies.crank.points.A[1]: "1 millimeter": unknown unit "millimeter" (did you mean "mm"?)"#,
            r#"line 28, column 65: forces.load.vector[1]: "5 Newton": unknown unit "Newton" (did you mean "N"?)"#,
        ],
    },
    Case {
        what: "no units of angular velocity",
        edits: &[
            (r#""10 rad/s""#, r#""360 deg""#),
            (
                r#""crank": { "angle": 60 }"#,
                r#""crank": { "angle": 60, "angular_velocity": "6 1/s" }"#,
            ),
        ],
        sets: &[],
        complaints: &[
            r#"line 23, column 108: drivers.motor.motion.coefficients[1]: "360 deg": "deg" is not a unit of angular velocity (such as "rad/s", "deg/s" or "rpm")"#,
            r#"line 30, column 60: initial.crank.angular_velocity: "6 1/s": "1/s" is not a unit of angular velocity (such as "rad/s", "deg/s" or "rpm")"#,
        ],
    },
    Case {
        what: "decimal commas in texts",
        edits: &[(r#""free_length": 150"#, r#""free_length": "1,5 mm""#)],
        sets: &["bodies.crank.mass=0,5", "analysis.solver.rtol=0,001"],
        complaints: &[
            r#"line 27, column 106: forces.return.free_length: "1,5 mm": a number has no comma (a decimal point is a point: "1.5 mm")"#,
            r#"--set bodies.crank.mass=0,5: a number has no comma (a decimal point is a point: "0.5")"#,
            r#"--set analysis.solver.rtol=0,001: a number has no comma (a decimal point is a point: "0.001")"#,
        ],
    },
    Case {
        what: "units of no map",
        edits: &[(r#"{ "length": "mm", "angle": "deg" }"#, r#""metric""#)],
        sets: &[],
        complaints: &[
            r#"line 4, column 12: units: "metric": unknown units (write "units": "SI", or name other units: {"length": "mm", "angle": "deg"})"#,
        ],
    },
    Case {
        what: "lists and objects that are something else, each with an example",
        edits: &[
            ("[0, -9.81]", "-9.81"),
            (r#""pose": { "angle": 60 }"#, r#""pose": [50, 0, 0]"#),
            (r#"["ground.O", "crank.O"]"#, r#""ground.O, crank.O""#),
            (r#"{ "model": "massless_link", "radius": 0.1 }"#, "0.1"),
            (
                r#"["ground.Q", "rocker.Q"]"#,
                r#"["ground.Q", "rocker.Q"], "friction": 0.1"#,
            ),
            ("[1, 0]", r#""x""#),
            (
                r#"{ "type": "polynomial", "coefficients": [60, "10 rad/s"] }"#,
                "60",
            ),
            ("[0, 5] }\n", "5 }\n"),
            (
                r#""outputs": 401"#,
                r#""outputs": 401, "columns": "crank.*""#,
            ),
        ],
        sets: &[],
        complaints: &[
            r#"line 5, column 14: gravity: -9.81: a list is expected, not a number (as in "gravity": [0, -9.81])"#,
            r#"line 9, column 57: bodies.crank.pose: an object is expected, not a list (as in "pose": { "position": [50, 0], "angle": "60 deg" })"#,
            r#"line 15, column 43: joints.a.between: "ground.O, crank.O": a list is expected, not text (as in "between": ["ground.A", "crank.A"])"#,
            r#"line 17, column 20: joints.b.clearance: 0.1: an object is expected, not a number (as in "clearance": { "model": "massless_link", "radius": "0.1 mm" })"#,
            r#"line 19, column 81: joints.d.friction: 0.1: an object is expected, not a number (as in "friction": { "law": "coulomb", "coefficient": 0.1, "threshold_velocity": "1 mm/s" })"#,
            r#"line 20, column 78: joints.e.axis: "x": a list is expected, not text (as in "axis": [1, 0])"#,
            r#"line 23, column 63: drivers.motor.motion: 60: an object is expected, not a number (as in "motion": { "type": "constant_velocity", "velocity": "60 rpm" })"#,
            r#"line 28, column 61: forces.load.vector: 5: a list is expected, not a number (as in "vector": [0, -10])"#,
            r#"line 32, column 84: analysis.columns: "crank.*": a list is expected, not text (as in "columns": ["crank.*", "joint.b.f?"])"#,
        ],
    },
    Case {
        what: "forces as a list",
        edits: &[],
        sets: &[r#"forces=[{"type": "force"}]"#],
        complaints: &[
            r#"--set forces=[{"type": "force"}]: an object is expected, not a list (as in "forces": { "load": { "type": "force", "at": "crank.A", "vector": [0, -10] } })"#,
        ],
    },
    Case {
        what: "what a driver misses",
        edits: &[
            (
                r#""body": "crank", "motion": { "type": "polynomial", "coefficients": [60, "10 rad/s"] }"#,
                r#""motion": { "type": "harmonic", "amplitude": 1 }"#,
            ),
            (
                r#"{ "type": "table", "points": [[0, 0], [1, 5]] }"#,
                r#"{ "type": "constant_velocity" }"#,
            ),
        ],
        sets: &[],
        complaints: &[
            r#"line 23, column 14: drivers.motor: "body" is missing (the name of a body, as in "body": "crank")"#,
            r#"line 23, column 46: drivers.motor.motion: "frequency" is missing (as in "frequency": "2 Hz")"#,
            r#"line 24, column 64: drivers.pusher.motion: "velocity" is missing (as in "velocity": "60 rpm", or "10 mm/s" of a slide)"#,
        ],
    },
    Case {
        what: "drivers called as joints",
        edits: &[
            (r#""type": "rotation""#, r#""type": "revolute""#),
            (r#""type": "translation""#, r#""type": "prismatic""#),
        ],
        sets: &[],
        complaints: &[
            r#"line 23, column 24: drivers.motor.type: "revolute": unknown type (did you mean "rotation"?)"#,
            r#"line 24, column 25: drivers.pusher.type: "prismatic": unknown type (did you mean "translation"?)"#,
        ],
    },
    Case {
        what: "everything at once, in the order of the lines",
        edits: &[
            (r#""mass": 0.8"#, r#""mass": "0.8 kgg""#),
            (r#""rocker.B""#, r#""rocker.C""#),
            (r#""outputs": 401"#, r#""outputs": "many""#),
            (r#""measured""#, "1"),
        ],
        sets: &["analysis.solver.max_step=1 m"],
        complaints: &[
            r#"line 8, column 24: bodies.crank.mass: "0.8 kgg": unknown unit "kgg" (did you mean "kg"?)"#,
            "line 11, column 67: bodies.rocker.note: 1: text is expected, not a number",
            r#"line 18, column 57: joints.c.between[1]: "rocker.C": body "rocker" has no point "C" (its points: Q, B)"#,
            r#"line 32, column 68: analysis.outputs: "many": a plain number is expected, not text"#,
            r#"--set analysis.solver.max_step=1 m: "m" is not a unit of time (such as "s")"#,
        ],
    },
];
