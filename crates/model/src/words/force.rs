//! Springs, loads and torques.

use crate::dimension::Dimension;
use crate::shape::{
    Bound, Choice, Default, Drives, Either, Field, Measure, Named, Object, Shape, Tagged, default,
    optional, required, silent,
};

/// A spring may be a damper, and the other way round.
const DAMPED: Either = Either {
    keys: ["stiffness", "damping"],
    needed: Some("with \"damping\" alone it would be a damper"),
    exclusive: false,
};

static LENGTH: Shape = Shape::End(Measure::Of(Dimension::Length));

/// Stops of springs and actuators.
const LIMITS: Field = optional(
    "limits",
    Shape::Pair(&LENGTH),
    "Where its stroke ends: least and greatest distance of its points \\[m\\]; `null` where it does not.",
);
const RESTITUTION: Field = optional(
    "restitution",
    Shape::Number(Bound::Between(0.0, 1.0)),
    "Of rigid stops at its limits, 0 where left out [–].",
);
const STOP_STIFFNESS: Field = optional(
    "stop_stiffness",
    Shape::Quantity(Measure::Of(Dimension::Stiffness), Bound::Above(0.0)),
    "Of stops that yield [N/m]; left out: they are rigid.",
);
const STOP_DAMPING: Field = optional(
    "stop_damping",
    Shape::Quantity(Measure::Of(Dimension::Damping), Bound::AtLeast(0.0)),
    "Of stops that yield [N·s/m].",
);

/// A force element.
pub static FORCE: Tagged = Tagged {
    name: "Force",
    about: "A force element.",
    variants: &[
        Object {
            name: "spring",
            about: "Along the line of two points: stiffness [N/m], damping [N·s/m], free length \\[m\\].",
            fields: &[
                required(
                    "between",
                    Shape::Pair(&Shape::Point),
                    "Two points, `body.point`.",
                ),
                default(
                    "stiffness",
                    Shape::Quantity(Measure::Of(Dimension::Stiffness), Bound::AtLeast(0.0)),
                    Default::Zero,
                    "[N/m]; may be left out where `damping` is given.",
                ),
                default(
                    "damping",
                    Shape::Quantity(Measure::Of(Dimension::Damping), Bound::AtLeast(0.0)),
                    Default::Zero,
                    "[N·s/m]",
                ),
                silent(
                    "free_length",
                    Shape::Varying(Dimension::Length),
                    Default::Zero,
                    "\\[m\\]",
                ),
                LIMITS,
                RESTITUTION,
                STOP_STIFFNESS,
                STOP_DAMPING,
            ],
            refused: &[],
            drives: Drives::Nothing,
            either: Some(DAMPED),
        },
        Object {
            name: "actuator",
            about: "Along the line of two points, a hydraulic cylinder or a gas spring: a force that pushes them apart \\[N\\].",
            fields: &[
                required(
                    "between",
                    Shape::Pair(&Shape::Point),
                    "Two points, `body.point`.",
                ),
                required(
                    "force",
                    Shape::Formula(Dimension::Force),
                    "\\[N\\]; negative, it pulls them together.",
                ),
                LIMITS,
                RESTITUTION,
                STOP_STIFFNESS,
                STOP_DAMPING,
            ],
            refused: &[],
            drives: Drives::Nothing,
            either: None,
        },
        Object {
            name: "cable",
            about: "Over points, small pulleys among them: a tension k(L − L₀) + c L̇ of its whole length, which never pushes \\[N\\].",
            fields: &[
                required(
                    "through",
                    Shape::List(&Shape::Point, 2),
                    "Points in their order, `body.point`.",
                ),
                required(
                    "stiffness",
                    Shape::Quantity(Measure::Of(Dimension::Stiffness), Bound::Above(0.0)),
                    "[N/m]",
                ),
                default(
                    "damping",
                    Shape::Quantity(Measure::Of(Dimension::Damping), Bound::AtLeast(0.0)),
                    Default::Zero,
                    "[N·s/m]",
                ),
                required(
                    "free_length",
                    Shape::Varying(Dimension::Length),
                    "\\[m\\]; shorter than this it is slack.",
                ),
            ],
            refused: &[],
            drives: Drives::Nothing,
            either: None,
        },
        Object {
            name: "torsion_spring",
            about: "Between two bodies: torque on the first k(θ₂ − θ₁ − θ₀) + c(ω₂ − ω₁), the opposite on the second.",
            fields: &[
                required(
                    "between",
                    Shape::Pair(&Shape::Name(Named::Body)),
                    "Two bodies.",
                ),
                default(
                    "stiffness",
                    Shape::Quantity(
                        Measure::Of(Dimension::AngularStiffness),
                        Bound::AtLeast(0.0),
                    ),
                    Default::Zero,
                    "[N·m/rad]; may be left out where `damping` is given.",
                ),
                default(
                    "damping",
                    Shape::Quantity(Measure::Of(Dimension::AngularDamping), Bound::AtLeast(0.0)),
                    Default::Zero,
                    "[N·m·s/rad]",
                ),
                silent(
                    "free_angle",
                    Shape::Varying(Dimension::Angle),
                    Default::Zero,
                    "\\[rad\\]",
                ),
            ],
            refused: &[],
            drives: Drives::Nothing,
            either: Some(DAMPED),
        },
        Object {
            name: "force",
            about: "A force at a point, vector in the ground's or the body's frame \\[N\\].",
            fields: &[
                required("at", Shape::Point, "The point, `body.point`."),
                required(
                    "vector",
                    Shape::Pair(&Shape::Formula(Dimension::Force)),
                    "\\[N\\]",
                ),
                silent("frame", Shape::Choice(&FRAME), Default::Text("ground"), ""),
            ],
            refused: &[],
            drives: Drives::Nothing,
            either: None,
        },
        Object {
            name: "torque",
            about: "A torque [N·m] on a body; `relative_to` takes the opposite.",
            fields: &[
                required("body", Shape::Name(Named::Body), ""),
                required("value", Shape::Formula(Dimension::Torque), "[N·m]"),
                optional(
                    "relative_to",
                    Shape::Name(Named::Body),
                    "The body that takes the opposite.",
                ),
            ],
            refused: &[],
            drives: Drives::Nothing,
            either: None,
        },
    ],
};

/// Frame of a force vector.
pub static FRAME: Choice = Choice {
    name: "Frame",
    about: "Frame of a force vector.",
    words: &[
        ("ground", "The vector keeps its direction in space."),
        ("body", "The vector turns with the body."),
    ],
};
