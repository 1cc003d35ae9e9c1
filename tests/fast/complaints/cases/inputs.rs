//! Inputs.

use super::Case;

pub const CASES: &[Case] = &[
    Case {
        what: "input that is an object",
        edits: &[(
            r#""joints": {"#,
            r#""inputs": { "torque": { "start": 2 } }, "joints": {"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 14, column 25: inputs.torque: a number is expected, not an object (its value until it is set, with its unit, as in "2 N*m")"#,
        ],
    },
    Case {
        what: "input of an unknown unit",
        edits: &[(
            r#""joints": {"#,
            r#""inputs": { "torque": "2 N*mx" }, "joints": {"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 14, column 25: inputs.torque: "2 N*mx": unknown unit "mx" (did you mean "mm"?)"#,
        ],
    },
    Case {
        what: "input without a number",
        edits: &[(
            r#""joints": {"#,
            r#""inputs": { "torque": "N*m" }, "joints": {"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 14, column 25: inputs.torque: "N*m": this does not begin with a number (a number, text with a unit such as "5 mm", or an expression such as "=2*r")"#,
        ],
    },
    Case {
        what: "input by a parameter that is not there",
        edits: &[(
            r#""joints": {"#,
            r#""inputs": { "torque": "=first" }, "joints": {"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 14, column 27: inputs.torque: "=first": there is no parameter "first" (write it into "parameters")"#,
        ],
    },
    Case {
        what: "input too large",
        edits: &[(
            r#""joints": {"#,
            r#""inputs": { "torque": 1e999 }, "joints": {"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 14, column 25: not JSON: 1e999: the number is too large for a double"#,
        ],
    },
    Case {
        what: "input called as a coordinate",
        edits: &[(
            r#""joints": {"#,
            r#""inputs": { "angle": "2 rad" }, "joints": {"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 14, column 24: inputs.angle: "2 rad": input.angle would be a column of a body called "input" (give the input another name)"#,
        ],
    },
    Case {
        what: "inputs as a list",
        edits: &[(r#""joints": {"#, r#""inputs": ["2 rad"], "joints": {"#)],
        sets: &[],
        complaints: &[r#"line 14, column 13: inputs: an object is expected, not a list"#],
    },
    Case {
        what: "input with a fractional dimension",
        edits: &[(
            r#""joints": {"#,
            r#""inputs": { "torque": "=sqrt(2 N)" }, "joints": {"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 14, column 25: inputs.torque: "=sqrt(2 N)": this is a quantity in kg^0.5*m^0.5/s, which no input is"#,
        ],
    },
    Case {
        what: "unknown input in a force",
        edits: &[(
            r#""joints": {"#,
            r#""inputs": { "torque": "2 N*m" }, "forces": { "t": { "type": "torque", "body": "crank", "value": "=input.torqe" } }, "joints": {"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 14, column 101: forces.t.value: "=input.torqe": there is no parameter, and nothing that moves, called "input.torqe" (did you mean "input.torque"?)"#,
            r#"line 26, column 3: forces: "forces": the key is given twice (first on line 14, column 36)"#,
        ],
    },
    Case {
        what: "input of another dimension than the force",
        edits: &[(
            r#""joints": {"#,
            r#""inputs": { "torque": "2 N" }, "forces": { "t": { "type": "torque", "body": "crank", "value": "=input.torque" } }, "joints": {"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 14, column 97: forces.t.value: "=input.torque": this is a force [N], where a torque [N*m] is wanted (its factors carry units, as in -0.5 N*s/m * slider.vx)"#,
            r#"line 26, column 3: forces: "forces": the key is given twice (first on line 14, column 34)"#,
        ],
    },
];
