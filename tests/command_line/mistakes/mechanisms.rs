//! Mistakes about the mechanism: bodies, joints, drivers, units.

use super::Mistake;

pub const MISTAKES: &[Mistake] = &[
    Mistake {
        what: "fixed body called base",
        edits: &[("ground", "base"), ("inverse_dynamics", "kinematics")],
        status: 2,
        said: &[
            r#"line 16, column 14: drivers: too few drivers: the joints leave 4 degrees of freedom, 1 driven; "base", "crank", "rod", "rocker" can still move (drive what is free, or hold it by a joint)"#,
            r#"line 4, column 13: bodies: nothing holds the mechanism: no body is called "ground", which is the name of the fixed one (rename the fixed body, probably "base", to "ground", unless all of it is to move freely)"#,
        ],
    },
    Mistake {
        what: "fixed body called base, which has no mass",
        edits: &[("ground", "base")],
        status: 2,
        said: &[
            r#"line 5, column 13: bodies.base: inverse dynamics needs the mass of body "base" (give "mass"; 0 is allowed where the joints determine its motion)"#,
            r#"line 5, column 13: bodies.base: inverse dynamics needs the inertia of body "base" (give "inertia"; 0 is allowed where the joints determine its motion)"#,
            r#"line 4, column 13: bodies: nothing holds the mechanism: no body is called "ground", which is the name of the fixed one (rename the fixed body, probably "base", to "ground", unless all of it is to move freely)"#,
        ],
    },
    Mistake {
        what: "table over crank degrees instead of seconds",
        edits: &[
            (
                r#"{ "type": "constant_velocity", "start": 60, "velocity": "60 rpm" }"#,
                r#"{ "type": "table", "points": [[0, 60], [360, 420], [720, 780]] }"#,
            ),
            (r#""end": 1,"#, r#""end": 0.16,"#),
        ],
        status: 0,
        said: &[
            r#"line 17, column 92: drivers.motor.motion.points: the table ends at t = 720 s, the run at t = 0.16 s: only its beginning is used (check the unit of its times: they are in s unless "units" names another "time", never in crank angle)"#,
        ],
    },
    Mistake {
        what: "misspelt body",
        edits: &[(r#""rod.B", "rocker.B""#, r#""rod.B", "roker.B""#)],
        status: 2,
        said: &[
            r#"line 13, column 53: joints.c.between[1]: "roker.B": there is no body "roker" (did you mean "rocker"?)"#,
        ],
    },
    Mistake {
        what: "joint to a missing point",
        edits: &[(r#""crank.A", "rod.A""#, r#""crank.C", "rod.A""#)],
        status: 2,
        said: &[
            r#"line 12, column 44: joints.b.between[0]: "crank.C": body "crank" has no point "C" (its points: O, A)"#,
        ],
    },
    Mistake {
        what: "degrees as radians",
        edits: &[(r#""angle": "deg", "#, r#""#)],
        status: 0,
        said: &[
            r#"line 6, column 122: bodies.crank.pose.angle: 60: the angle is 60 rad, 9.549 turns (for degrees write "60 deg", or name "angle": "deg" in units)"#,
            r#"line 7, column 144: bodies.rod.pose.angle: 20: the angle is 20 rad, 3.183 turns (for degrees write "60 deg", or name "angle": "deg" in units)"#,
            r#"line 8, column 147: bodies.rocker.pose.angle: 95: the angle is 95 rad, 15.12 turns (for degrees write "60 deg", or name "angle": "deg" in units)"#,
            r#"line 17, column 103: drivers.motor.motion.start: 60: the angle is 60 rad, 9.549 turns (for degrees write "60 deg", or name "angle": "deg" in units)"#,
            r#"line 8, column 114: bodies.rocker.pose: it assembles turned by 1.91 rad (109°) from this drawing, perhaps on the other branch (draw the pose nearer to the assembly that you want)"#,
        ],
    },
    Mistake {
        what: "millimetres as metres",
        edits: &[(r#""length": "mm", "#, r#""#)],
        status: 0,
        said: &[
            r#"line 7, column 71: bodies.rod.points: the bodies are very long, this one 250 m (check the unit of length: "units": { "length": "mm" } reads plain numbers as millimetres)"#,
        ],
    },
    Mistake {
        what: "inertia in kg*m^2 written in kg*mm^2",
        edits: &[(r#""inertia": 9000"#, r#""inertia": 0.009"#)],
        status: 0,
        said: &[
            r#"line 7, column 38: bodies.rod.inertia: 0.009: the inertia is small: that of the mass at 0.06882 mm, where the body reaches 125 mm (check the unit: a plain inertia is in kg*m^2 unless "units" names another)"#,
        ],
    },
    Mistake {
        what: "pose drawn the wrong way round",
        edits: &[(
            r#""position": [50, 87], "angle": 20"#,
            r#""position": [50, 87], "angle": 200"#,
        )],
        status: 0,
        said: &[
            r#"line 7, column 111: bodies.rod.pose: it assembles turned by 95.3° from this drawing, perhaps on the other branch (draw the pose nearer to the assembly that you want)"#,
            r#"line 8, column 114: bodies.rocker.pose: it assembles turned by 129° from this drawing, perhaps on the other branch (draw the pose nearer to the assembly that you want)"#,
        ],
    },
    Mistake {
        what: "loop that can't close",
        edits: &[(r#""B": [250, 0]"#, r#""B": [25, 0]"#)],
        status: 3,
        said: &[
            r#"can't assemble: the joints alone close, but with the drivers at their first values the loop a – b – c – d does not close; it lacks 39.58 mm at the best position found; change the start of a driver, or the lengths that keep it from there"#,
        ],
    },
    Mistake {
        what: "driver start out of reach",
        edits: &[
            (r#""A": [100, 0]"#, r#""A": [250, 0]"#),
            (r#""start": 60"#, r#""start": 170"#),
        ],
        status: 3,
        said: &[
            r#"can't assemble: the joints alone close, but with the drivers at their first values the loop a – b – c – d does not close; it lacks 97.92 mm at the best position found; change the start of a driver, or the lengths that keep it from there"#,
        ],
    },
    Mistake {
        what: "over-driven",
        edits: &[(
            "\"motor\": {",
            "\"second\": { \"type\": \"rotation\", \"body\": \"rocker\", \"motion\": { \"type\": \"constant_velocity\", \"start\": 95, \"velocity\": 1 } },\n    \"motor\": {",
        )],
        status: 2,
        said: &[
            r#"line 16, column 14: drivers: too many drivers: the joints leave 1 degree of freedom, and there are 2 drivers ("second", "motor") (take drivers out until their number is that of the degrees of freedom)"#,
        ],
    },
    Mistake {
        what: "under-driven",
        edits: &[
            (
                "\"drivers\": {\n",
                "\"drivers\": {},\n  \"note\": \"x\", \"forces\": {\n",
            ),
            (
                r#""motor": { "type": "rotation", "body": "crank", "motion": { "type": "constant_velocity", "start": 60, "velocity": "60 rpm" } }"#,
                r#""#,
            ),
        ],
        status: 2,
        said: &[
            r#"line 16, column 14: drivers: too few drivers: the joints leave 1 degree of freedom, 0 driven; "crank", "rod", "rocker" can still move (drive what is free, or hold it by a joint)"#,
        ],
    },
    Mistake {
        what: "missing mass",
        edits: &[(r#""mass": 1.9, "inertia": 9000, "#, r#""#)],
        status: 2,
        said: &[
            r#"line 7, column 12: bodies.rod: inverse dynamics needs the mass of body "rod" (give "mass"; 0 is allowed where the joints determine its motion)"#,
            r#"line 7, column 12: bodies.rod: inverse dynamics needs the inertia of body "rod" (give "inertia"; 0 is allowed where the joints determine its motion)"#,
        ],
    },
    Mistake {
        what: "a body without mass that no joint holds",
        edits: &[(
            "    \"rod\":",
            "    \"arm\": { \"inertia\": 0 },\n    \"rod\":",
        )],
        status: 2,
        said: &[
            r#"line 7, column 12: bodies.arm: inverse dynamics needs the mass of body "arm", which no joint holds (give "mass"; 0 is allowed where the joints determine its motion; or take the body out, or connect it by a joint)"#,
        ],
    },
    Mistake {
        what: "a body that no joint holds",
        edits: &[
            (
                "    \"rod\":",
                "    \"arm\": { \"inertia\": 1, \"mass\": 1, \"com\": [0, 0] },\n    \"rod\":",
            ),
            (r#""inverse_dynamics""#, r#""dynamics""#),
        ],
        status: 0,
        said: &[
            r#"line 7, column 12: bodies.arm: no joint holds it (connect it by a joint or take it out, unless it is to move freely)"#,
        ],
    },
    Mistake {
        what: "two grounds",
        edits: &[(
            "    \"crank\":",
            "    \"ground\": { \"points\": { \"P\": [0, 0] } },\n    \"crank\":",
        )],
        status: 2,
        said: &[
            r#"line 6, column 5: bodies.ground: "ground": the key is given twice (first on line 5, column 5)"#,
        ],
    },
    Mistake {
        what: "ground misspelt",
        edits: &[(r#"    "ground":"#, r#"    "Ground":"#)],
        status: 2,
        said: &[
            r#"line 11, column 44: joints.a.between[0]: "ground.O": there is no body "ground" (the fixed body is written "ground", not "Ground")"#,
            r#"line 14, column 44: joints.d.between[0]: "ground.Q": there is no body "ground" (the fixed body is written "ground", not "Ground")"#,
        ],
    },
    Mistake {
        what: "clearance on a prismatic joint",
        edits: &[(
            r#""d": { "type": "revolute", "between": ["ground.Q", "rocker.Q"] }"#,
            r#""d": { "type": "prismatic", "between": ["ground.Q", "rocker.Q"], "axis": [1, 0], "clearance": { "model": "ideal" } }"#,
        )],
        status: 2,
        said: &[
            r#"line 14, column 86: joints.d.clearance: "clearance": only a revolute joint can have clearance"#,
        ],
    },
    Mistake {
        what: "missing units",
        edits: &[(
            "  \"units\": { \"length\": \"mm\", \"angle\": \"deg\", \"inertia\": \"kg*mm^2\" },\n",
            "",
        )],
        status: 2,
        said: &[
            r#"line 1, column 1: "units" is missing (write "units": "SI", or name other units: {"length": "mm", "angle": "deg"})"#,
        ],
    },
    Mistake {
        what: "two joints with the same name",
        edits: &[(r#"    "c": {"#, r#"    "b": {"#)],
        status: 2,
        said: &[
            r#"line 13, column 5: joints.b: "b": the key is given twice (first on line 12, column 5)"#,
        ],
    },
    Mistake {
        what: "motion type misspelt",
        edits: &[(r#"constant_velocity"#, r#"constant_velocty"#)],
        status: 2,
        said: &[
            r#"line 17, column 73: drivers.motor.motion.type: "constant_velocty": unknown type (did you mean "constant_velocity"?)"#,
        ],
    },
    Mistake {
        what: "driver on ground",
        edits: &[(r#""body": "crank""#, r#""body": "ground""#)],
        status: 2,
        said: &[
            r#"line 17, column 44: drivers.motor.body: "ground": ground is fixed, nothing can turn it (name the body that the driver turns)"#,
        ],
    },
    Mistake {
        what: "wrong unit dimension",
        edits: &[(r#""60 rpm""#, r#""60 mm/s""#)],
        status: 2,
        said: &[
            r#"line 17, column 119: drivers.motor.motion.velocity: "60 mm/s": "mm/s" is not a unit of angular velocity (such as "rad/s", "deg/s" or "rpm")"#,
        ],
    },
    Mistake {
        what: "com missing with mass",
        edits: &[(r#""com": [125, 0], "#, r#""#)],
        status: 2,
        said: &[
            r#"line 7, column 12: bodies.rod: "com" is missing, it has no default where there is mass (give the centre of mass in the body's frame, as in "com": [0, 0])"#,
        ],
    },
    Mistake {
        what: "sample with the wrong driver",
        edits: &[(
            r#""end": 1, "outputs": 101"#,
            r#""sample": { "driver": "moter", "from": 60, "to": 420, "step": 1 }"#,
        )],
        status: 2,
        said: &[
            r#"line 19, column 67: analysis.sample.driver: "moter": there is no driver "moter" (did you mean "motor"?)"#,
        ],
    },
    Mistake {
        what: "sample beyond its driver",
        edits: &[(
            r#""end": 1, "outputs": 101"#,
            r#""sample": { "driver": "motor", "from": 0, "to": 420, "step": 1 }"#,
        )],
        status: 2,
        said: &[
            r#"line 19, column 84: analysis.sample.from: 0: driver "motor" does not reach 0° on its first monotone stretch from 60° (sample within the values the motion passes before it first turns back)"#,
        ],
    },
    Mistake {
        what: "negative mass",
        edits: &[(r#""mass": 0.8"#, r#""mass": -0.8"#)],
        status: 2,
        said: &[r#"line 6, column 24: bodies.crank.mass: -0.8: must not be negative"#],
    },
];
