//! Mistakes of writing: JSON, words, values of another type.

use super::Mistake;

pub const MISTAKES: &[Mistake] = &[
    Mistake {
        what: "trailing comma",
        edits: &[(r#""outputs": 101 }"#, r#""outputs": 101, }"#)],
        status: 2,
        said: &[
            r#"line 19, column 71: not JSON: '}' where a key in double quotes is expected (there may be a comma too many before it)"#,
        ],
    },
    Mistake {
        what: "trailing comma in a list",
        edits: &[(r#"[100, 0]"#, r#"[100, 0,]"#)],
        status: 2,
        said: &[
            r#"line 6, column 99: not JSON: ']' where a value is expected (there may be a comma too many before it)"#,
        ],
    },
    Mistake {
        what: "comment",
        edits: &[("  \"joints\"", "  // the pins\n  \"joints\"")],
        status: 2,
        said: &[
            r#"line 10, column 3: not JSON: '/' where a key in double quotes is expected (JSON has no comments; use "note")"#,
        ],
    },
    Mistake {
        what: "hash comment",
        edits: &[("  \"joints\"", "  # the pins\n  \"joints\"")],
        status: 2,
        said: &[
            r#"line 10, column 3: not JSON: '#' where a key in double quotes is expected (JSON has no comments; use "note")"#,
        ],
    },
    Mistake {
        what: "single quotes",
        edits: &[(r#""crank.A""#, r#"'crank.A'"#)],
        status: 2,
        said: &[
            r#"line 12, column 44: not JSON: '\'' where a value is expected (text stands in double quotes)"#,
        ],
    },
    Mistake {
        what: "NaN",
        edits: &[(r#""mass": 0.8"#, r#""mass": NaN"#)],
        status: 2,
        said: &[
            r#"line 6, column 24: not JSON: 'N' where a value is expected (JSON knows neither NaN nor Infinity)"#,
        ],
    },
    Mistake {
        what: "decimal comma",
        edits: &[(r#""mass": 0.8"#, r#""mass": 0,8"#)],
        status: 2,
        said: &[
            r#"line 6, column 26: not JSON: '8' where a key in double quotes is expected (a decimal point is a point: 0.8, not 0,8)"#,
        ],
    },
    Mistake {
        what: "plus sign",
        edits: &[(r#"[300, 0]"#, r#"[+300, 0]"#)],
        status: 2,
        said: &[
            r#"line 5, column 48: not JSON: '+' where a value is expected (a number begins with a digit or a minus sign, as in 0.5)"#,
        ],
    },
    Mistake {
        what: "decimal point first",
        edits: &[(r#""mass": 0.8"#, r#""mass": .8"#)],
        status: 2,
        said: &[
            r#"line 6, column 24: not JSON: '.' where a value is expected (a number begins with a digit or a minus sign, as in 0.5)"#,
        ],
    },
    Mistake {
        what: "typographic quotes",
        edits: &[(r#""crank.A""#, r#"“crank.A”"#)],
        status: 2,
        said: &[
            r#"line 12, column 44: not JSON: '“' where a value is expected (text stands in straight double quotes)"#,
        ],
    },
    Mistake {
        what: "tab in a text",
        edits: &[("\"format\"", "\"about\": \"a\tb\",\n  \"format\"")],
        status: 2,
        said: &[
            r#"line 2, column 14: not JSON: a control character in a text; write a tab as \t, another as \u00XX"#,
        ],
    },
    Mistake {
        what: "unquoted key",
        edits: &[(r#""mass": 0.8"#, r#"mass: 0.8"#)],
        status: 2,
        said: &[
            r#"line 6, column 16: not JSON: 'm' where a key in double quotes is expected (text stands in double quotes)"#,
        ],
    },
    Mistake {
        what: "True",
        edits: &[(r#""mass": 0.8"#, r#""mass": True"#)],
        status: 2,
        said: &[
            r#"line 6, column 24: not JSON: 'T' where a value is expected (true and false are written in lower case)"#,
        ],
    },
    Mistake {
        what: "between of three",
        edits: &[(
            r#"["ground.O", "crank.O"]"#,
            r#"["ground.O", "crank.O", "rod.A"]"#,
        )],
        status: 2,
        said: &[r#"line 11, column 43: joints.a.between: a list of 2 is expected, this one has 3"#],
    },
    Mistake {
        what: "pin instead of revolute",
        edits: &[(
            r#""revolute", "between": ["ground.O""#,
            r#""pin", "between": ["ground.O""#,
        )],
        status: 2,
        said: &[
            r#"line 11, column 20: joints.a.type: "pin": unknown type (did you mean "revolute"?)"#,
        ],
    },
    Mistake {
        what: "number as text",
        edits: &[(r#""mass": 0.8"#, r#""mass": "0.8""#)],
        status: 2,
        said: &[
            r#"line 6, column 24: bodies.crank.mass: "0.8": the unit is missing, a unit of mass (such as "kg")"#,
        ],
    },
    Mistake {
        what: "no analysis",
        edits: &[(
            ",\n  \"analysis\": { \"type\": \"inverse_dynamics\", \"end\": 1, \"outputs\": 101 }",
            "",
        )],
        status: 2,
        said: &[
            r#"line 1, column 1: analysis: the model says no analysis to run (add "analysis": { "type": "kinematics", "end": 1, "outputs": 101 }, or use `linkdyn check`)"#,
        ],
    },
    Mistake {
        what: "analysis as text",
        edits: &[(
            r#"{ "type": "inverse_dynamics", "end": 1, "outputs": 101 }"#,
            r#""kinematics""#,
        )],
        status: 2,
        said: &[
            r#"line 19, column 15: analysis: "kinematics": an object is expected, not text (as in "analysis": { "type": "kinematics", "end": 1, "outputs": 101 })"#,
        ],
    },
    Mistake {
        what: "spring without stiffness",
        edits: &[(
            "  \"analysis\"",
            "  \"forces\": { \"s\": { \"type\": \"spring\", \"between\": [\"ground.O\", \"rod.B\"] } },\n  \"analysis\"",
        )],
        status: 2,
        said: &[
            r#"line 19, column 20: forces.s: "stiffness" is missing (with "damping" alone it would be a damper)"#,
        ],
    },
    Mistake {
        what: "force at a body",
        edits: &[(
            "  \"analysis\"",
            "  \"forces\": { \"s\": { \"type\": \"force\", \"at\": \"rod\", \"vector\": [0, 1] } },\n  \"analysis\"",
        )],
        status: 2,
        said: &[
            r#"line 19, column 45: forces.s.at: "rod": this is no point of a body (write it as body.point; the points of "rod": A, B)"#,
        ],
    },
];
