//! What is asked of an optimisation.

use crate::dimension::Dimension;
use crate::shape::{
    Asked, Bound, Default, Drives, Either, Measure, Named, Object, Shape, optional, required,
    silent,
};

/// Starts at most.
const MOST_STARTS: usize = 100_000;
/// Seeds at most: whole numbers that every reader of JSON keeps.
const MOST_SEED: usize = 1 << 53;

/// What is asked of an optimisation.
pub static OPTIMISE: Object = Object {
    name: "Optimise",
    about: "What `linkdyn optimise` looks for.",
    fields: &[
        required(
            "design",
            Shape::Asked(Asked::Design),
            "Parameters that may change, each between a lower and an upper bound; \"free\": a goal of one parameter, around its value.",
        ),
        optional(
            "objective",
            Shape::Object(&OBJECTIVE),
            "What is to be least or greatest.",
        ),
        silent(
            "constraints",
            Shape::List(&Shape::Asked(Asked::Constraint), 0),
            Default::Empty,
            "What must hold: equations and inequalities, as in `stroke = 80 mm` or `peak < 40 N*m`.",
        ),
        optional(
            "curve",
            Shape::Object(&CURVE),
            "The path that a point should take.",
        ),
        optional(
            "robust",
            Shape::Number(Bound::AtLeast(0.0)),
            "The objective gets so many standard deviations worse, by the tolerances of parameters.",
        ),
        optional(
            "starts",
            Shape::Count(1, MOST_STARTS),
            "How many starts there are.",
        ),
        optional(
            "seed",
            Shape::Count(0, MOST_SEED),
            "Seed of the points from which they start.",
        ),
    ],
    refused: &[],
    drives: Drives::Nothing,
    either: Some(Either {
        keys: ["objective", "curve"],
        needed: None,
        exclusive: true,
    }),
};

/// What is to be least or greatest.
pub static OBJECTIVE: Object = Object {
    name: "Objective",
    about: "What is to be least or greatest.",
    fields: &[
        optional(
            "minimise",
            Shape::Asked(Asked::Value),
            "What is to be least.",
        ),
        optional(
            "maximise",
            Shape::Asked(Asked::Value),
            "What is to be greatest.",
        ),
    ],
    refused: &[],
    drives: Drives::Nothing,
    either: Some(Either {
        keys: ["minimise", "maximise"],
        needed: Some("as in \"objective\": { \"minimise\": \"max(abs(driver.motor.effort))\" }"),
        exclusive: true,
    }),
};

/// The path that a point should take.
pub static CURVE: Object = Object {
    name: "Curve",
    about: "The path that a point should take.",
    fields: &[
        required("point", Shape::Point, "The point, `body.point`."),
        required(
            "through",
            Shape::List(
                &Shape::Pair(&Shape::Quantity(Measure::Of(Dimension::Length), Bound::Any)),
                2,
            ),
            "Points (x, y) that its path should pass.",
        ),
        optional(
            "driver",
            Shape::Name(Named::Driver),
            "Name of the driver; may be left out where there is only one.",
        ),
        optional(
            "at",
            Shape::List(&Shape::Quantity(Measure::Driven, Bound::Any), 2),
            "Value of the driver at each point; left out: it does not matter when the path passes them.",
        ),
    ],
    refused: &[],
    drives: Drives::Posed,
    either: None,
};
