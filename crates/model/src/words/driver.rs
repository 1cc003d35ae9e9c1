//! Drivers.

use crate::dimension::Dimension;
use crate::shape::{Bound, Drives, Measure, Named, Object, Shape, Tagged, optional, required};
use crate::words::MOTION;

/// A prescribed coordinate.
pub static DRIVER: Tagged = Tagged {
    name: "Driver",
    about: "A prescribed coordinate.",
    variants: &[
        Object {
            name: "rotation",
            about: "Angle of `body`, relative to another body where given (default ground).",
            fields: &[
                required("body", Shape::Name(Named::Body), "The driven body."),
                optional(
                    "relative_to",
                    Shape::Name(Named::Body),
                    "The body from which the angle counts.",
                ),
                required(
                    "motion",
                    Shape::Tagged(&MOTION),
                    "The law of time that the coordinate follows.",
                ),
                optional(
                    "tolerance",
                    Shape::Quantity(Measure::Driven, Bound::AtLeast(0.0)),
                    "How far the coordinate may be from what the motion says, to either side; for accuracy.",
                ),
            ],
            refused: &[],
            drives: Drives::Always(Dimension::Angle),
            either: None,
        },
        Object {
            name: "translation",
            about: "Slide of a prismatic joint or a slot, along its axis, first point to second.",
            fields: &[
                required(
                    "joint",
                    Shape::Name(Named::Joint),
                    "Name of the prismatic joint or slot.",
                ),
                required(
                    "motion",
                    Shape::Tagged(&MOTION),
                    "The law of time that the coordinate follows.",
                ),
                optional(
                    "tolerance",
                    Shape::Quantity(Measure::Driven, Bound::AtLeast(0.0)),
                    "How far the coordinate may be from what the motion says, to either side; for accuracy.",
                ),
            ],
            refused: &[],
            drives: Drives::Always(Dimension::Length),
            either: None,
        },
        Object {
            name: "length",
            about: "Distance of two points of two bodies, as a hydraulic cylinder has it.",
            fields: &[
                required(
                    "between",
                    Shape::Pair(&Shape::Point),
                    "Its ends, `body.point`.",
                ),
                required(
                    "motion",
                    Shape::Tagged(&MOTION),
                    "The law of time that the distance follows.",
                ),
                optional(
                    "tolerance",
                    Shape::Quantity(Measure::Driven, Bound::AtLeast(0.0)),
                    "How far the distance may be from what the motion says, to either side; for accuracy.",
                ),
            ],
            refused: &[],
            drives: Drives::Always(Dimension::Length),
            either: None,
        },
    ],
};
