//! What `linkdyn accuracy` says of questions that it can't answer: place, cause, mend.

use super::asked_in_vain;

/// A question over a four-bar whose crank has a tolerance.
const BASE: &str = r#"{
  "format": "linkdyn/1",
  "units": { "length": "mm", "angle": "deg" },
  "parameters": {
    "crank": { "value": "100 mm", "tolerance": "0.05 mm" },
    "coupler": "250 mm"
  },
  "bodies": {
    "ground": { "points": { "O": [0, 0], "Q": [300, 0] } },
    "crank": { "points": { "O": [0, 0], "A": ["=crank", 0] }, "pose": { "angle": 60 } },
    "coupler": { "points": { "A": [0, 0], "B": ["=coupler", 0] }, "pose": { "position": [50, 86], "angle": 20 } },
    "rocker": { "points": { "Q": [0, 0], "B": [200, 0] }, "pose": { "position": [300, 0], "angle": 100 } }
  },
  "joints": {
    "a": { "type": "revolute", "between": ["ground.O", "crank.O"] },
    "b": { "type": "revolute", "between": ["crank.A", "coupler.A"] },
    "c": { "type": "revolute", "between": ["coupler.B", "rocker.B"] },
    "d": { "type": "revolute", "between": ["ground.Q", "rocker.Q"] }
  },
  "drivers": {
    "motor": { "type": "rotation", "body": "crank", "motion": { "type": "polynomial", "coefficients": [60, 90] } }
  },
  "analysis": { "type": "kinematics", "end": 1, "outputs": 11 },
  "accuracy": { "outputs": {
    "swing": { "column": "rocker.angle", "at": { "value": 90 } }
  } }
}
"#;

struct Case {
    edits: &'static [(&'static str, &'static str)],
    options: &'static [&'static str],
    status: u8,
    says: &'static str,
}

const CASES: &[Case] = &[
    Case {
        edits: &[],
        options: &["--output", "swong"],
        status: 2,
        says: r#"line 24, column 28: accuracy.outputs: there is no output "swong" (did you mean "swing"?)"#,
    },
    Case {
        edits: &[(
            "\"swing\": { \"column\": \"rocker.angle\", \"at\": { \"value\": 90 } }",
            "",
        )],
        options: &[],
        status: 2,
        says: r#"line 24, column 28: accuracy.outputs: the model says no output whose accuracy is asked (add "accuracy": { "outputs": { "NAME": { "column": "rocker.angle" } } })"#,
    },
    Case {
        edits: &[("\"value\": 90", "\"value\": 151")],
        options: &[],
        status: 2,
        says: r#"line 25, column 59: accuracy.outputs.swing.at.value: 151°: "motor" does not have this value in its motion (it goes from 60° to 150°)"#,
    },
    Case {
        edits: &[("\"value\": 90", "\"value\": \"0.5 rad\"")],
        options: &[],
        status: 2,
        says: r#"line 25, column 59: accuracy.outputs.swing.at.value: 28.6479°: "motor" does not have this value in its motion (it goes from 60° to 150°)"#,
    },
    Case {
        edits: &[
            ("\"coupler\": \"250 mm\"", "\"coupler\": \"140 mm\""),
            ("\"value\": 90", "\"value\": 110"),
        ],
        options: &[],
        status: 2,
        says: r#"line 25, column 59: accuracy.outputs.swing.at.value: 110°: the mechanism locks before "motor" has this value (it goes from 60° to 105.07°)"#,
    },
    Case {
        edits: &[(", \"tolerance\": \"0.05 mm\"", "")],
        options: &[],
        status: 2,
        says: r#"line 4, column 17: parameters: nothing may be off: no parameter has a tolerance, and no joint a clearance (as in "parameters": { "rod": { "value": "200 mm", "tolerance": "0.05 mm" } }, or "clearance": { "model": "ideal", "radius": "10 um" } of a joint)"#,
    },
    Case {
        edits: &[
            ("[\"=crank\", 0]", "[100, 0]"),
            ("\"position\": [50, 86]", "\"position\": [\"=crank/2\", 86]"),
        ],
        options: &[],
        status: 2,
        says: r#"line 5, column 48: parameters.crank.tolerance: "0.05 mm": no point, axis, angle or ratio of the mechanism follows from this parameter (take the tolerance away, or use the parameter in a dimension)"#,
    },
    Case {
        edits: &[("[\"=crank\", 0]", "[\"=abs(crank-100 mm)+100 mm\", 0]")],
        options: &[],
        status: 2,
        says: r#"line 10, column 47: bodies.crank.points.A[0]: "=abs(crank-100 mm)+100 mm": this dimension has no derivative here: abs has a kink at zero"#,
    },
    Case {
        edits: &[("rocker.angle", "joint.b.fx")],
        options: &[],
        status: 2,
        says: r#"line 10, column 14: bodies.crank: inverse dynamics needs the mass of body "crank" (give "mass"; 0 is allowed where the joints determine its motion)
line 10, column 14: bodies.crank: inverse dynamics needs the inertia of body "crank" (give "inertia"; 0 is allowed where the joints determine its motion)
line 11, column 16: bodies.coupler: inverse dynamics needs the mass of body "coupler" (give "mass"; 0 is allowed where the joints determine its motion)
line 11, column 16: bodies.coupler: inverse dynamics needs the inertia of body "coupler" (give "inertia"; 0 is allowed where the joints determine its motion)
line 12, column 15: bodies.rocker: inverse dynamics needs the mass of body "rocker" (give "mass"; 0 is allowed where the joints determine its motion)
line 12, column 15: bodies.rocker: inverse dynamics needs the inertia of body "rocker" (give "inertia"; 0 is allowed where the joints determine its motion)"#,
    },
    Case {
        edits: &[("rocker.angle", "joint.b.torque")],
        options: &[],
        status: 2,
        says: r#"line 25, column 26: accuracy.outputs.swing.column: "joint.b.torque": the results have no such column of a position, an effort or a joint force (there are joint.b.fx, joint.b.fy)"#,
    },
    Case {
        edits: &[(
            "  \"analysis\": { \"type\": \"kinematics\", \"end\": 1, \"outputs\": 11 },\n",
            "",
        )],
        options: &[],
        status: 2,
        says: r#"line 1, column 1: analysis: accuracy is asked along a motion, and the model says none (add "analysis": { "type": "kinematics", "end": 1, "outputs": 101 })"#,
    },
    Case {
        edits: &[
            (
                "\"motor\": { \"type\": \"rotation\", \"body\": \"crank\", \"motion\": { \"type\": \"polynomial\", \"coefficients\": [60, 90] } }",
                "",
            ),
            (", \"at\": { \"value\": 90 }", ""),
        ],
        options: &[],
        status: 2,
        says: r#"line 20, column 14: drivers: too few drivers: the joints leave 1 degree of freedom, 0 driven; "crank", "coupler", "rocker" can still move (drive what is free, or hold it by a joint)"#,
    },
    Case {
        edits: &[("\"coupler\": \"250 mm\"", "\"coupler\": \"40 mm\"")],
        options: &[],
        status: 3,
        says: r#"error: can't assemble: the joints alone close, but with the drivers at their first values the loop a – b – c – d does not close; it lacks 24.58 mm at the best position found; change the start of a driver, or the lengths that keep it from there"#,
    },
    Case {
        edits: &[
            ("\"coupler\": \"250 mm\"", "\"coupler\": \"300 mm\""),
            ("[200, 0]", "[100, 0]"),
            ("\"coefficients\": [60, 90]", "\"coefficients\": [0, 90]"),
            ("\"angle\": 60", "\"angle\": 0"),
            (
                "\"position\": [50, 86], \"angle\": 20",
                "\"position\": [100, 0], \"angle\": 0",
            ),
            ("\"angle\": 100", "\"angle\": 0"),
        ],
        options: &[],
        status: 3,
        says: r#"error: the start is a singular position (the constraints lose rank there: "crank", "coupler" and "rocker" are in line), so that more than one motion leads away from it, or none; start a little beside it"#,
    },
    Case {
        edits: &[
            (
                "\"O\": [0, 0], \"Q\": [300, 0]",
                "\"O\": [0, 0], \"Q\": [250, 0], \"M\": [125, 0]",
            ),
            (
                "[200, 0] }, \"pose\": { \"position\": [300, 0], \"angle\": 100 }",
                "[100, 0] }, \"pose\": { \"position\": [250, 0], \"angle\": 60 }",
            ),
            (
                "\"position\": [50, 86], \"angle\": 20",
                "\"position\": [50, 86], \"angle\": 0",
            ),
            (
                "\"B\": [\"=coupler\", 0] }",
                "\"B\": [\"=coupler\", 0], \"M\": [\"=coupler/2\", 0] }",
            ),
            (
                "\"rocker\": {",
                "\"third\": { \"points\": { \"M\": [0, 0], \"E\": [100, 0] }, \"pose\": { \"position\": [125, 0], \"angle\": 60 } },\n    \"rocker\": {",
            ),
            (
                "\"joints\": {",
                "\"joints\": {\n    \"e\": { \"type\": \"revolute\", \"between\": [\"ground.M\", \"third.M\"] },\n    \"f\": { \"type\": \"revolute\", \"between\": [\"third.E\", \"coupler.M\"] },",
            ),
        ],
        options: &[],
        status: 2,
        says: r#"line 15, column 13: joints: joints e, f, a, b, c, d hold the same freedom more than once, so what each clearance does is not unique (take a joint or body out that only repeats what others do)"#,
    },
    Case {
        edits: &[(
            "\"polynomial\", \"coefficients\": [60, 90]",
            "\"table\", \"points\": [[0, 60], [\"=crank/100 mm*1 s\", 150]]",
        )],
        options: &[],
        status: 2,
        says: r#"line 21, column 103: drivers.motor.motion.points[1][0]: "=crank/100 mm*1 s": a tolerance of the times of a table is not followed (give the values of the table the tolerance, or take another law of motion)"#,
    },
    Case {
        edits: &[(
            r#"["ground.Q", "rocker.Q"] }"#,
            r#"["ground.Q", "rocker.Q"] },
    "mesh": { "type": "rack", "between": ["crank.O", "coupler.A"], "axis": [1, 0], "radius": "20 mm" }"#,
        )],
        options: &[],
        status: 2,
        says: r#"line 19, column 13: joints.mesh: accuracy does not count yet what is off in a joint of type "rack", and gives no answer that leaves it out (vary its numbers as parameters of a `study`, which runs the model with each)"#,
    },
    Case {
        edits: &[(
            r#"["ground.Q", "rocker.Q"] }"#,
            r#"["ground.Q", "rocker.Q"] },
    "loop": { "type": "belt", "between": ["crank.O", "rocker.Q"], "radii": ["20 mm", "20 mm"] }"#,
        )],
        options: &[],
        status: 2,
        says: r#"line 19, column 13: joints.loop: accuracy does not count yet what is off in a joint of type "belt", and gives no answer that leaves it out (vary its numbers as parameters of a `study`, which runs the model with each)"#,
    },
    Case {
        edits: &[(
            r#"["ground.Q", "rocker.Q"] }"#,
            r#"["ground.Q", "rocker.Q"] },
    "mount": { "type": "bushing", "between": ["crank.O", "rocker.Q"], "radial_stiffness": "800 N/mm" }"#,
        )],
        options: &[],
        status: 2,
        says: r#"line 19, column 14: joints.mount: accuracy does not count yet what is off in a joint of type "bushing", and gives no answer that leaves it out (vary its numbers as parameters of a `study`, which runs the model with each)"#,
    },
    Case {
        edits: &[
            (
                r#""motor": { "type": "rotation", "body": "crank", "motion": { "type": "polynomial", "coefficients": [60, 90] } }"#,
                r#""oil": { "type": "length", "between": ["ground.Q", "crank.A"], "motion": { "type": "constant_velocity", "start": 260, "velocity": 1 } }"#,
            ),
            (r#", "at": { "value": 90 }"#, ""),
        ],
        options: &[],
        status: 2,
        says: r#"line 21, column 12: drivers.oil: accuracy does not count yet what is off in a driven length, and gives no answer that leaves it out (vary its numbers as parameters of a `study`, which runs the model with each)"#,
    },
];

#[test]
fn questions_without_an_answer_are_told_so() {
    let mut wrong = Vec::new();
    for (number, case) in CASES.iter().enumerate() {
        let mut text = BASE.to_owned();
        for (from, to) in case.edits {
            assert!(text.contains(from), "case {number}: {from}");
            text = text.replace(from, to);
        }
        let (status, said) = asked_in_vain(number, &text, case.options);
        if (status, said.as_str()) != (case.status, case.says) {
            wrong.push(format!("case {number}, {status}: {said}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn the_length_of_a_spring_is_the_distance_of_its_points() {
    let told = |of: &str| {
        let output = format!("accuracy={{\"outputs\":{{\"reach\":{of}}}}}");
        let sets = ["parameters.crank={\"value\":\"50 mm\",\"tolerance\":\"0.1 mm\"}".to_owned(), output,
            "bodies.ground.points.S=[20, -100]".to_owned(),
            "forces.shock={\"type\":\"spring\",\"between\":[\"ground.S\",\"piston.B\"],\"stiffness\":1}".to_owned()];
        super::asked("slider-crank", &sets)
    };
    let length = told("{\"column\":\"force.shock.length\"}");
    let distance = told("{\"distance\":[\"ground.S\",\"piston.B\"]}");
    let poses = |told: &serde_json::Value| told["outputs"]["reach"]["poses"].clone();
    assert!(
        poses(&length)
            .as_array()
            .is_some_and(|poses| !poses.is_empty()),
        "{length:#}"
    );
    assert_eq!(poses(&length), poses(&distance));
}

/// Profiles have tolerances of their own, which nobody works out here.
#[test]
fn mechanisms_with_cams_are_refused() {
    let asked = r#""accuracy": { "outputs": { "lift": { "column": "follower.y" } } }, "analysis":"#;
    let text = include_str!("../../../models/cam-roller.json").replace("\"analysis\":", asked);
    let (status, said) = asked_in_vain(CASES.len(), &text, &[]);
    let expected = "joints.lobe: accuracy does not count yet what is off in a joint of type \"cam\", and gives no answer that leaves it out (vary its \
        numbers as parameters of a `study`, which runs the model with each)";
    assert_eq!((status, said.contains(expected)), (2, true), "{said}");
}
