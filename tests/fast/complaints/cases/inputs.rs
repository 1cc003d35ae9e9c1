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
        complaints: &[],
    },
    Case {
        what: "input of an unknown unit",
        edits: &[(
            r#""joints": {"#,
            r#""inputs": { "torque": "2 N*mx" }, "joints": {"#,
        )],
        sets: &[],
        complaints: &[],
    },
    Case {
        what: "input without a number",
        edits: &[(
            r#""joints": {"#,
            r#""inputs": { "torque": "N*m" }, "joints": {"#,
        )],
        sets: &[],
        complaints: &[],
    },
    Case {
        what: "input by a parameter that is not there",
        edits: &[(
            r#""joints": {"#,
            r#""inputs": { "torque": "=first" }, "joints": {"#,
        )],
        sets: &[],
        complaints: &[],
    },
    Case {
        what: "input too large",
        edits: &[(
            r#""joints": {"#,
            r#""inputs": { "torque": 1e999 }, "joints": {"#,
        )],
        sets: &[],
        complaints: &[],
    },
    Case {
        what: "input called as a coordinate",
        edits: &[(
            r#""joints": {"#,
            r#""inputs": { "angle": "2 rad" }, "joints": {"#,
        )],
        sets: &[],
        complaints: &[],
    },
    Case {
        what: "inputs as a list",
        edits: &[(r#""joints": {"#, r#""inputs": ["2 rad"], "joints": {"#)],
        sets: &[],
        complaints: &[],
    },
    Case {
        what: "input with a fractional dimension",
        edits: &[(
            r#""joints": {"#,
            r#""inputs": { "torque": "=sqrt(2 N)" }, "joints": {"#,
        )],
        sets: &[],
        complaints: &[],
    },
    Case {
        what: "unknown input in a force",
        edits: &[(
            r#""joints": {"#,
            r#""inputs": { "torque": "2 N*m" }, "forces": { "t": { "type": "torque", "body": "crank", "value": "=input.torqe" } }, "joints": {"#,
        )],
        sets: &[],
        complaints: &[],
    },
    Case {
        what: "input of another dimension than the force",
        edits: &[(
            r#""joints": {"#,
            r#""inputs": { "torque": "2 N" }, "forces": { "t": { "type": "torque", "body": "crank", "value": "=input.torque" } }, "joints": {"#,
        )],
        sets: &[],
        complaints: &[],
    },
];
