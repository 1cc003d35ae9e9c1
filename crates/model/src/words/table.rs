//! Tables of formulas, and integrated states.

use crate::shape::{Default, Drives, Either, Field, Object, Shape, optional, required, silent};

use super::motion::INTERPOLATION;

const POINTS: Field = optional(
    "points",
    Shape::Entries,
    "[[place, value], …]; places strictly increasing, at least two.",
);
const FILE: Field = optional(
    "file",
    Shape::Text,
    "A table in a file beside the model, instead of `points`.",
);
const COLUMNS: Field = optional(
    "columns",
    Shape::Pair(&Shape::Text),
    "The names of the file's columns; the first two where it is left out.",
);
const UNITS: Field = optional(
    "units",
    Shape::Pair(&Shape::Text),
    "The units of plain numbers in both columns.",
);
const BETWEEN: Field = optional(
    "interpolation",
    Shape::Choice(&INTERPOLATION),
    "What is between the points: `natural`, with a `period` `periodic` where it is left out. Beyond them the ends hold.",
);
const PERIOD: Field = optional("period", Shape::Entry, "After which it repeats.");

const SOURCE: Option<Either> = Some(Either {
    keys: ["points", "file"],
    needed: Some(
        "as in \"points\": [[\"0 deg\", \"30 bar\"], [\"90 deg\", \"5 bar\"]], or \"file\": \"gas.csv\"",
    ),
    exclusive: true,
});

/// A table that formulas call by its name.
pub static TABLE: Object = Object {
    name: "Table",
    about: "A function by its points, which formulas call by its name: `gas(crank.angle)`.",
    fields: &[POINTS, FILE, COLUMNS, UNITS, BETWEEN, PERIOD],
    refused: &[],
    drives: Drives::Nothing,
    either: SOURCE,
};

/// A table where a value stands.
pub static TABLE_OF: Object = Object {
    name: "TableOf",
    about: "A table over a quantity that moves.",
    fields: &[
        required("of", Shape::Text, "What is looked up, as in `crank.angle`."),
        POINTS,
        FILE,
        COLUMNS,
        UNITS,
        BETWEEN,
        PERIOD,
    ],
    refused: &[(
        "type",
        "a table over what moves has no type, a motion over time has no \"of\"",
    )],
    drives: Drives::Nothing,
    either: SOURCE,
};

/// A quantity of which the rate is known.
pub static STATE: Object = Object {
    name: "State",
    about: "A quantity that is integrated with the motion; formulas name it `state.NAME`.",
    fields: &[
        required(
            "rate",
            Shape::Text,
            "Its rate, as in `=target - rotor.omega`.",
        ),
        silent("start", Shape::Entry, Default::Zero, "Its value at t = 0."),
    ],
    refused: &[],
    drives: Drives::Nothing,
    either: None,
};
