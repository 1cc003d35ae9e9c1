//! Bodies, poses, initial values.

use crate::dimension::Dimension;
use crate::shape::{
    Bound, Default, Drives, Measure, Object, Shape, default, optional, required, silent,
};

/// A length.
pub const LENGTH: Shape = Shape::Quantity(Measure::Of(Dimension::Length), Bound::Any);

/// A point with the tolerance of its place.
pub static PLACE: Object = Object {
    name: "Place",
    about: "A point with the tolerance of its place.",
    fields: &[
        required("position", Shape::Pair(&LENGTH), "Its place \\[m\\]."),
        optional(
            "tolerance",
            Shape::Quantity(Measure::Of(Dimension::Length), Bound::AtLeast(0.0)),
            "Diameter of its position tolerance zone \\[m\\] (ISO 1101): it is at most half of this away from its place.",
        ),
    ],
    refused: &[],
    drives: Drives::Nothing,
    either: None,
};

/// The reserved, fixed body: it has only points.
pub static GROUND: Object = Object {
    name: "Ground",
    about: "The reserved, fixed body: it has only points.",
    fields: &[default(
        "points",
        Shape::Map(&Shape::Place),
        Default::Empty,
        "Named points in global coordinates \\[m\\].",
    )],
    refused: &[
        ("mass", "ground is fixed, a mass of it would mean nothing"),
        (
            "inertia",
            "ground is fixed, an inertia of it would mean nothing",
        ),
        (
            "com",
            "ground is fixed, a centre of mass of it would mean nothing",
        ),
        ("pose", "ground is fixed, its frame is the global one"),
    ],
    drives: Drives::Nothing,
    either: None,
};

/// A rigid body. `ground` has only points.
pub static BODY: Object = Object {
    name: "Body",
    about: "A rigid body. `ground` has only points.",
    fields: &[
        optional(
            "mass",
            Shape::Quantity(Measure::Of(Dimension::Mass), Bound::AtLeast(0.0)),
            "Mass \\[kg\\].",
        ),
        optional(
            "inertia",
            Shape::Quantity(Measure::Of(Dimension::Inertia), Bound::AtLeast(0.0)),
            "Moment of inertia about the centre of mass [kg·m²].",
        ),
        optional(
            "com",
            Shape::Pair(&Shape::Quantity(Measure::Of(Dimension::Length), Bound::Any)),
            "Centre of mass in the body's frame \\[m\\]; has no default where there is mass.",
        ),
        default(
            "points",
            Shape::Map(&Shape::Place),
            Default::Empty,
            "Named points in the body's frame \\[m\\].",
        ),
        silent(
            "pose",
            Shape::Object(&POSE),
            Default::Same,
            "Where the body's frame is guessed to be.",
        ),
    ],
    refused: &[],
    drives: Drives::Nothing,
    either: None,
};

/// Guess of a body frame's place for the assembly.
pub static POSE: Object = Object {
    name: "Pose",
    about: "Guess of a body frame's place for the assembly.",
    fields: &[
        default(
            "position",
            Shape::Pair(&Shape::Quantity(Measure::Of(Dimension::Length), Bound::Any)),
            Default::Zeros,
            "Origin \\[m\\].",
        ),
        default(
            "angle",
            Shape::Quantity(Measure::Of(Dimension::Angle), Bound::Any),
            Default::Zero,
            "Angle \\[rad\\].",
        ),
    ],
    refused: &[],
    drives: Drives::Nothing,
    either: None,
};

/// Exact values at t = 0 of a body's coordinates (frame origin) and velocities.
pub static INITIAL: Object = Object {
    name: "Initial",
    about: "Exact values at t = 0 of a body's coordinates (frame origin) and velocities.",
    fields: &[
        optional(
            "x",
            Shape::Quantity(Measure::Of(Dimension::Length), Bound::Any),
            "Frame origin \\[m\\].",
        ),
        optional(
            "y",
            Shape::Quantity(Measure::Of(Dimension::Length), Bound::Any),
            "Frame origin \\[m\\].",
        ),
        optional(
            "angle",
            Shape::Quantity(Measure::Of(Dimension::Angle), Bound::Any),
            "Angle \\[rad\\].",
        ),
        optional(
            "vx",
            Shape::Quantity(Measure::Of(Dimension::Velocity), Bound::Any),
            "Velocity of the frame origin [m/s].",
        ),
        optional(
            "vy",
            Shape::Quantity(Measure::Of(Dimension::Velocity), Bound::Any),
            "Velocity of the frame origin [m/s].",
        ),
        optional(
            "angular_velocity",
            Shape::Quantity(Measure::Of(Dimension::AngularVelocity), Bound::Any),
            "Angular velocity [rad/s].",
        ),
        optional(
            "branch",
            Shape::Number(Bound::Any),
            "How it turns, by the others, on the branch of motion on which a singular start is left.",
        ),
    ],
    refused: &[],
    drives: Drives::Nothing,
    either: None,
};
