//! Drivers and motions.

use crate::dimension::Dimension;
use crate::shape::{
    Bound, Default, Drives, Measure, Named, Object, Shape, Tagged, default, optional, required,
};

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
    ],
};

/// A law of time f(t), SI (driven dimension, s, Hz, rad).
pub static MOTION: Tagged = Tagged {
    name: "Motion",
    about: "A law of time f(t), SI (driven dimension, s, Hz, rad).",
    variants: &[
        Object {
            name: "polynomial",
            about: "Σ c_k t^k.",
            fields: &[required(
                "coefficients",
                Shape::List(&Shape::Quantity(Measure::DrivenCoefficient, Bound::Any), 1),
                "c₀, c₁, c₂ …; a plain c_k is in the driven dimension's unit per second^k.",
            )],
            refused: &[],
            drives: Drives::Nothing,
            either: None,
        },
        Object {
            name: "harmonic",
            about: "offset + amplitude·sin(2π·frequency·t + phase).",
            fields: &[
                default(
                    "offset",
                    Shape::Quantity(Measure::Driven, Bound::Any),
                    Default::Zero,
                    "",
                ),
                required(
                    "amplitude",
                    Shape::Quantity(Measure::Driven, Bound::Any),
                    "",
                ),
                required(
                    "frequency",
                    Shape::Quantity(Measure::Of(Dimension::Frequency), Bound::Any),
                    "\\[Hz\\]",
                ),
                default(
                    "phase",
                    Shape::Quantity(Measure::Of(Dimension::Angle), Bound::Any),
                    Default::Zero,
                    "\\[rad\\]",
                ),
            ],
            refused: &[],
            drives: Drives::Nothing,
            either: None,
        },
        Object {
            name: "table",
            about: "Cubic spline through (t, value); times strictly increasing, at least two.",
            fields: &[required("points", Shape::Table, "[[t, value], …]")],
            refused: &[],
            drives: Drives::Nothing,
            either: None,
        },
        Object {
            name: "constant_velocity",
            about: "start + velocity·t.",
            fields: &[
                default(
                    "start",
                    Shape::Quantity(Measure::Driven, Bound::Any),
                    Default::Zero,
                    "",
                ),
                required(
                    "velocity",
                    Shape::Quantity(Measure::DrivenVelocity, Bound::Any),
                    "",
                ),
            ],
            refused: &[],
            drives: Drives::Nothing,
            either: None,
        },
        Object {
            name: "constant_acceleration",
            about: "start + velocity·t + acceleration·t²/2.",
            fields: &[
                default(
                    "start",
                    Shape::Quantity(Measure::Driven, Bound::Any),
                    Default::Zero,
                    "",
                ),
                default(
                    "velocity",
                    Shape::Quantity(Measure::DrivenVelocity, Bound::Any),
                    Default::Zero,
                    "",
                ),
                required(
                    "acceleration",
                    Shape::Quantity(Measure::DrivenAcceleration, Bound::Any),
                    "",
                ),
            ],
            refused: &[],
            drives: Drives::Nothing,
            either: None,
        },
    ],
};
