//! What is asked of accuracy.

use crate::shape::{
    Bound, Choice, Default, Drives, Either, Measure, Named, Object, Shape, optional, required,
    silent,
};

/// What is asked of the mechanism's accuracy.
pub static ACCURACY: Object = Object {
    name: "Accuracy",
    about: "Which outputs must be accurate, under the tolerances and clearances of the model.",
    fields: &[
        silent(
            "outputs",
            Shape::Map(&Shape::Object(&OUTPUT)),
            Default::Empty,
            "Outputs by their names.",
        ),
        silent(
            "pins",
            Shape::Choice(&PINS),
            Default::Text("worst"),
            "Where pins are within their clearances.",
        ),
        silent(
            "levels",
            Shape::Choice(&LEVELS),
            Default::Text("certified"),
            "How much is worked out; each level has those before it, too.",
        ),
    ],
    refused: &[],
    drives: Drives::Nothing,
    either: None,
};

/// An output whose accuracy matters.
pub static OUTPUT: Object = Object {
    name: "AccuracyOutput",
    about: "An output whose accuracy matters: a result column, or the distance of two points.",
    fields: &[
        optional(
            "column",
            Shape::Text,
            "Name of a result column without unit: a position, an angle, or a force.",
        ),
        optional(
            "distance",
            Shape::Pair(&Shape::Point),
            "Two points `body.point`.",
        ),
        optional(
            "at",
            Shape::Object(&AT),
            "Where; left out: over the whole stroke.",
        ),
        optional(
            "limits",
            Shape::Pair(&Shape::Quantity(Measure::Driven, Bound::Any)),
            "Lower and upper deviation from the nominal value that are allowed.",
        ),
    ],
    refused: &[],
    drives: Drives::Measured,
    either: Some(Either {
        keys: ["column", "distance"],
        needed: Some("an output is a \"column\" of the results, or a \"distance\" of two points"),
        exclusive: true,
    }),
};

/// A position of the mechanism.
pub static AT: Object = Object {
    name: "At",
    about: "A position of the mechanism.",
    fields: &[
        optional(
            "driver",
            Shape::Name(Named::Driver),
            "Name of the driver; may be left out where there is only one.",
        ),
        required(
            "value",
            Shape::Quantity(Measure::Driven, Bound::Any),
            "Value of the driver.",
        ),
    ],
    refused: &[],
    drives: Drives::Posed,
    either: None,
};

/// How much is worked out.
pub static LEVELS: Choice = Choice {
    name: "Levels",
    about: "How much is worked out; each level has those before it, too.",
    words: &[
        (
            "first",
            "First order, contributions, spread and lost motion.",
        ),
        ("worst", "And the worst found."),
        ("certified", "And the certified bound."),
    ],
};

/// Where pins are within their clearances.
pub static PINS: Choice = Choice {
    name: "Pins",
    about: "Where pins are within their clearances.",
    words: &[
        ("worst", "Each where it moves the output most."),
        ("load", "On the side to which the load presses them."),
        ("rim", "On the rim, in any direction."),
        ("disc", "Anywhere in the clearance."),
        ("none", "In the middle: clearances are of no account."),
    ],
};
