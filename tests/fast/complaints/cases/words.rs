//! What stands at the top of a model, and values of the wrong type or dimension.

use super::Case;

pub const CASES: &[Case] = &[
    Case {
        what: "another format, nothing else said of it",
        edits: &[("linkdyn/1", "linkdyn/2"), (r#""mass""#, r#""mas""#)],
        sets: &[],
        complaints: &[
            r#"line 2, column 13: format: "linkdyn/2": unknown format ("linkdyn/1" is expected)"#,
        ],
    },
    Case {
        what: "format missing",
        edits: &[("  \"format\": \"linkdyn/1\",\n", "")],
        sets: &[],
        complaints: &[r#"line 1, column 1: "format" is missing (write "format": "linkdyn/1")"#],
    },
    Case {
        what: "a transmission to ground, and from one of two drivers",
        edits: &[(
            r#""outputs": 401"#,
            r#""outputs": 401, "transmission": { "output": "ground" }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 32, column 89: analysis.transmission: "driver" is missing, the model has 2 of them (name the driver from which the transmission leads)"#,
            r#"line 32, column 101: analysis.transmission.output: "ground": ground is fixed, nothing is transmitted to it"#,
        ],
    },
    Case {
        what: "a transmission between things that are not there",
        edits: &[(
            r#""outputs": 401"#,
            r#""outputs": 401, "transmission": { "driver": "motr", "output": "rocket" }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 32, column 101: analysis.transmission.driver: "motr": there is no driver "motr" (did you mean "motor"?)"#,
            r#"line 32, column 119: analysis.transmission.output: "rocket": there is no body "rocket" (did you mean "rocker"?)"#,
        ],
    },
    Case {
        what: "units missing",
        edits: &[(
            "  \"units\": { \"length\": \"mm\", \"angle\": \"deg\" },\n",
            "",
        )],
        sets: &[],
        complaints: &[
            r#"line 1, column 1: "units" is missing (write "units": "SI", or name other units: {"length": "mm", "angle": "deg"})"#,
        ],
    },
    Case {
        what: "units in lower case",
        edits: &[(r#"{ "length": "mm", "angle": "deg" }"#, r#""si""#)],
        sets: &[],
        complaints: &[
            r#"line 4, column 12: units: "si": unknown units (write "units": "SI", or name other units: {"length": "mm", "angle": "deg"})"#,
        ],
    },
    Case {
        what: "unit of no dimension",
        edits: &[(r#""angle": "deg""#, r#""angel": "deg""#)],
        sets: &[],
        complaints: &[
            r#"line 4, column 30: units.angel: "angel": unknown key (did you mean "angle"?)"#,
        ],
    },
    Case {
        what: "unknown unit",
        edits: &[(r#""length": "mm""#, r#""length": "millimetres""#)],
        sets: &[],
        complaints: &[
            r#"line 4, column 24: units.length: "millimetres": unknown unit "millimetres" (did you mean "mm"?)"#,
        ],
    },
    Case {
        what: "unit misspelt",
        edits: &[(r#""length": "mm""#, r#""length": "mmm""#)],
        sets: &[],
        complaints: &[
            r#"line 4, column 24: units.length: "mmm": unknown unit "mmm" (did you mean "mm"?)"#,
        ],
    },
    Case {
        what: "unit of another dimension",
        edits: &[(r#""length": "mm""#, r#""length": "kg*mm^2""#)],
        sets: &[],
        complaints: &[
            r#"line 4, column 24: units.length: "kg*mm^2": "kg*mm^2" is not a unit of length (such as "m")"#,
        ],
    },
    Case {
        what: "unit that cannot be read",
        edits: &[(r#""length": "mm""#, r#""length": "mm^""#)],
        sets: &[],
        complaints: &[
            r#"line 4, column 24: units.length: "mm^": "mm^" cannot be read as a unit (such as "m")"#,
        ],
    },
    Case {
        what: "root misspelt, its contents not missed elsewhere",
        edits: &[(r#""bodies""#, r#""bodys""#)],
        sets: &[],
        complaints: &[r#"line 6, column 3: bodys: "bodys": unknown key (did you mean "bodies"?)"#],
    },
    Case {
        what: "top key unknown",
        edits: &[(r#""name""#, r#""titel""#)],
        sets: &[],
        complaints: &[
            r#"line 3, column 3: titel: "titel": unknown key (known keys: format, units, parameters, name, about, source, gravity, bodies, joints, drivers, forces, tables, inputs, states, initial, points, measures, analysis, accuracy, outputs, responses, study, optimise, synthesise, note)"#,
        ],
    },
    Case {
        what: "wrong type: text",
        edits: &[(r#""name": "four-bar and slider""#, r#""name": 5"#)],
        sets: &[],
        complaints: &["line 3, column 11: name: 5: text is expected, not a number"],
    },
    Case {
        what: "wrong type: object",
        edits: &[(
            r#""initial": { "crank": { "angle": 60 } }"#,
            r#""initial": []"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 30, column 14: initial: an object is expected, not a list (as in "initial": { "crank": { "angle": "60 deg" } })"#,
        ],
    },
    Case {
        what: "wrong type: list",
        edits: &[(r#""gravity": [0, -9.81]"#, r#""gravity": -9.81"#)],
        sets: &[],
        complaints: &[
            r#"line 5, column 14: gravity: -9.81: a list is expected, not a number (as in "gravity": [0, -9.81])"#,
        ],
    },
    Case {
        what: "wrong length",
        edits: &[(r#""gravity": [0, -9.81]"#, r#""gravity": [0, 0, -9.81]"#)],
        sets: &[],
        complaints: &["line 5, column 14: gravity: a list of 2 is expected, this one has 3"],
    },
    Case {
        what: "quantity without a unit",
        edits: &[(r#""gravity": [0, -9.81]"#, r#""gravity": [0, "-9.81"]"#)],
        sets: &[],
        complaints: &[
            r#"line 5, column 18: gravity[1]: "-9.81": the unit is missing, a unit of acceleration (such as "m/s^2")"#,
        ],
    },
    Case {
        what: "quantity of another dimension",
        edits: &[(r#""gravity": [0, -9.81]"#, r#""gravity": [0, "-9.81 m/s"]"#)],
        sets: &[],
        complaints: &[
            r#"line 5, column 18: gravity[1]: "-9.81 m/s": "m/s" is not a unit of acceleration (such as "m/s^2")"#,
        ],
    },
    Case {
        what: "quantity that is none",
        edits: &[(r#""gravity": [0, -9.81]"#, r#""gravity": [0, "down"]"#)],
        sets: &[],
        complaints: &[
            r#"line 5, column 18: gravity[1]: "down": this does not begin with a number (a number, or text such as "5 m/s^2")"#,
        ],
    },
    Case {
        what: "null",
        edits: &[(r#""gravity": [0, -9.81]"#, r#""gravity": [0, null]"#)],
        sets: &[],
        complaints: &[
            r#"line 5, column 18: gravity[1]: null: a number is expected, not null (or text with a unit, such as "5 m/s^2")"#,
        ],
    },
    Case {
        what: "number too large",
        edits: &[("-9.81", "-9.81e999")],
        sets: &[],
        complaints: &[
            "line 5, column 18: not JSON: -9.81e999: the number is too large for a double",
        ],
    },
    Case {
        what: "quantity too large",
        edits: &[("-9.81", r#""1e308 km/s^2""#)],
        sets: &[],
        complaints: &[
            r#"line 5, column 18: gravity[1]: "1e308 km/s^2": the number is too large for a double"#,
        ],
    },
    Case {
        what: "NaN",
        edits: &[("-9.81", "NaN")],
        sets: &[],
        complaints: &[
            "line 5, column 18: not JSON: 'N' where a value is expected (JSON knows neither NaN nor Infinity)",
        ],
    },
];
