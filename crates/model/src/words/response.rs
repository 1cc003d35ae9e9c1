//! Named numbers of a run.

use crate::shape::{Drives, Object, Shape, optional, required};

/// A response with limits.
pub static RESPONSE: Object = Object {
    name: "Response",
    about: "A named number of a run, with limits.",
    fields: &[
        required(
            "value",
            Shape::Text,
            "An expression of result columns and parameters, as in `max(piston.x) - min(piston.x)`.",
        ),
        optional(
            "limits",
            Shape::Pair(&Shape::Limit),
            "Lower and upper limit, in the units of the file.",
        ),
        optional(
            "unit",
            Shape::Text,
            "The unit in which it is shown; files are in SI.",
        ),
    ],
    refused: &[],
    drives: Drives::Nothing,
    either: None,
};
