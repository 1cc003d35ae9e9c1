//! Texts that are no JSON.

use super::Case;

pub const CASES: &[Case] = &[
    Case {
        what: "repeated key",
        edits: &[(r#""mass": 0.8,"#, r#""mass": 0.8, "mass": 0.9,"#)],
        sets: &[],
        complaints: &[
            r#"line 8, column 29: bodies.crank.mass: "mass": the key is given twice (first on line 8, column 16)"#,
        ],
    },
    Case {
        what: "comment",
        edits: &[(r#""gravity""#, "// down\n  \"gravity\"")],
        sets: &[],
        complaints: &[
            r#"line 5, column 3: not JSON: '/' where a key in double quotes is expected (JSON has no comments; use "note")"#,
        ],
    },
    Case {
        what: "comma too many",
        edits: &[(r#""outputs": 401 }"#, r#""outputs": 401, }"#)],
        sets: &[],
        complaints: &[
            "line 32, column 73: not JSON: '}' where a key in double quotes is expected (there may be a comma too many before it)",
        ],
    },
    Case {
        what: "comma missing",
        edits: &[(
            r#""name": "four-bar and slider","#,
            r#""name": "four-bar and slider""#,
        )],
        sets: &[],
        complaints: &[
            r#"line 4, column 3: not JSON: '"' where "," or "}" is expected (a comma may be missing before it)"#,
        ],
    },
    Case {
        what: "single quotes",
        edits: &[(r#""mm""#, "'mm'")],
        sets: &[],
        complaints: &[
            r#"line 4, column 24: not JSON: '\'' where a value is expected (text stands in double quotes)"#,
        ],
    },
    Case {
        what: "quote not closed",
        edits: &[(r#""mm""#, r#""mm"#)],
        sets: &[],
        complaints: &[
            r#"line 4, column 30: not JSON: 'a' where "," or "}" is expected (a quote or a comma may be missing before it)"#,
        ],
    },
    Case {
        what: "leading zero",
        edits: &[("-9.81", "-09.81")],
        sets: &[],
        complaints: &[
            "line 5, column 18: not JSON: a number must not begin with a zero that counts nothing",
        ],
    },
    Case {
        what: "unknown escape",
        edits: &[(r#""measured""#, r#""C:\models""#)],
        sets: &[],
        complaints: &[
            r#"line 11, column 70: not JSON: an escape that JSON does not know; a backslash itself is written \\"#,
        ],
    },
    Case {
        what: "broken surrogate",
        edits: &[(r#""measured""#, r#""\ud800""#)],
        sets: &[],
        complaints: &[
            r#"line 11, column 68: not JSON: a broken \u escape (\u and four hex digits)"#,
        ],
    },
];
