//! A parameter with its tolerance.

use crate::shape::{Bound, Choice, Default, Drives, Object, Shape, optional, required, silent};

/// A named number with its tolerance.
pub static PARAMETER: Object = Object {
    name: "Parameter",
    about: "A named number with its tolerance.",
    fields: &[
        required(
            "value",
            Shape::Nominal,
            "A plain number, text with a unit, or \"=\" and an expression of other parameters.",
        ),
        optional(
            "tolerance",
            Shape::Deviations,
            "Its own deviation: `\"0.05 mm\"` to either side, `[lower, upper]`, or `\"2 %\"` of the value.",
        ),
        silent(
            "distribution",
            Shape::Choice(&DISTRIBUTION),
            Default::Text("normal"),
            "How parts are spread between the limits.",
        ),
        silent(
            "sigma",
            Shape::Number(Bound::Above(0.0)),
            Default::Number(3.0),
            "Standard deviations from the middle to each limit, of `normal`.",
        ),
        optional(
            "cost",
            Shape::Alike(Bound::Above(0.0)),
            "Coefficient a of the cost a/t of a tolerance ±t, for `allocate`.",
        ),
    ],
    refused: &[],
    drives: Drives::Nothing,
    either: None,
};

/// How parts are spread between their limits.
pub static DISTRIBUTION: Choice = Choice {
    name: "Distribution",
    about: "How parts are spread between their limits.",
    words: &[
        ("normal", "Normal, cut off at the limits."),
        (
            "uniform",
            "All values between the limits are equally frequent.",
        ),
        (
            "triangular",
            "Most frequent in the middle, falling off to zero at the limits.",
        ),
    ],
};
