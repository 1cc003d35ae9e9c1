//! Cams: what touches the profile, and the profile.

use super::motion::RISE_LAW;
use crate::dimension::Dimension;
use crate::shape::{
    Bound, Choice, Default, Drives, Either, Field, Measure, Object, Shape, Tagged, default,
    optional, required,
};

const ANY_LENGTH: Shape = Shape::Quantity(Measure::Of(Dimension::Length), Bound::Any);
const SOME_LENGTH: Shape = Shape::Quantity(Measure::Of(Dimension::Length), Bound::Above(0.0));
const ANY_ANGLE: Shape = Shape::Quantity(Measure::Of(Dimension::Angle), Bound::Any);
const SOME_ANGLE: Shape = Shape::Quantity(Measure::Of(Dimension::Angle), Bound::Above(0.0));
static COORDINATE: Shape = ANY_LENGTH;
static PLACE: Shape = Shape::Pair(&COORDINATE);

/// Points of a curve, at least: with fewer a periodic spline is hardly the curve that is meant.
const LEAST_POINTS: usize = 8;

/// What touches the profile of a cam.
pub static FOLLOWER: Choice = Choice {
    name: "Follower",
    about: "What touches the profile of a cam.",
    words: &[
        ("flat", "A straight face through the follower's point."),
        ("roller", "A roller about the follower's point."),
        ("knife", "The follower's point itself."),
    ],
};

const LAW: Field = optional("law", Shape::Choice(&RISE_LAW), "How it rises.");
const SPAN: Field = optional(
    "angle",
    SOME_ANGLE,
    "Angle of the cam over which it goes \\[rad\\].",
);
const RAMP: Field = optional(
    "ramp",
    Shape::Number(Bound::Above(0.0)),
    "Share of `angle` in which it speeds up, and the same in which it slows down; a third where it is left out, a half at most.",
);
const ROUNDING: Field = optional(
    "rounding",
    Shape::Number(Bound::Above(0.0)),
    "Share of a ramp in which the acceleration changes; a half where it is left out, 1 at most.",
);
const DWELL: Field = optional(
    "dwell",
    SOME_ANGLE,
    "Angle of the cam over which it stays where it is \\[rad\\].",
);
const BEGIN: Field = default(
    "begin",
    ANY_ANGLE,
    Default::Zero,
    "Angle of the cam at which the segments begin \\[rad\\].",
);

/// A segment is a rise or a dwell.
const RISES_OR_DWELLS: Option<Either> = Some(Either {
    keys: ["law", "dwell"],
    needed: Some(
        "a segment is a rise, as in { \"law\": \"cycloidal\", \"rise\": …, \"angle\": \"120 deg\" }, or { \"dwell\": \"60 deg\" }",
    ),
    exclusive: true,
});

/// A part of a turn of a cam whose follower slides.
pub static CAM_SEGMENT: Object = Object {
    name: "CamSegment",
    about: "A part of a turn of a cam: a rise by a `law`, or a `dwell`.",
    fields: &[
        LAW,
        optional(
            "rise",
            ANY_LENGTH,
            "How far the follower goes \\[m\\]; back with the other sign.",
        ),
        optional(
            "end",
            ANY_LENGTH,
            "Where it is afterwards, from where it began, instead of `rise` \\[m\\].",
        ),
        SPAN,
        RAMP,
        ROUNDING,
        DWELL,
    ],
    refused: &[("duration", "a cam goes by its angle: write \"angle\"")],
    drives: Drives::Nothing,
    either: RISES_OR_DWELLS,
};

/// A part of a turn of a cam whose follower swings.
pub static SWING_SEGMENT: Object = Object {
    name: "SwingSegment",
    about: "A part of a turn of a cam that swings an arm: a rise by a `law`, or a `dwell`.",
    fields: &[
        LAW,
        optional(
            "rise",
            ANY_ANGLE,
            "How far the arm turns \\[rad\\]; back with the other sign.",
        ),
        optional(
            "end",
            ANY_ANGLE,
            "How far it is turned afterwards, from where it began, instead of `rise` \\[rad\\].",
        ),
        SPAN,
        RAMP,
        ROUNDING,
        DWELL,
    ],
    refused: &[("duration", "a cam goes by its angle: write \"angle\"")],
    drives: Drives::Nothing,
    either: RISES_OR_DWELLS,
};

static CAM_SEGMENTS: Shape = Shape::Object(&CAM_SEGMENT);
static SWING_SEGMENTS: Shape = Shape::Object(&SWING_SEGMENT);

/// The shape of a cam, or the motion that it gives.
pub static PROFILE: Tagged = Tagged {
    name: "Profile",
    about: "The shape of a cam about its point, or the motion that it gives.",
    variants: &[
        Object {
            name: "circle",
            about: "A circle: an eccentric.",
            fields: &[
                default(
                    "centre",
                    PLACE,
                    Default::Zeros,
                    "From the cam's point, in its frame \\[m\\].",
                ),
                required("radius", SOME_LENGTH, "\\[m\\]"),
            ],
            refused: &[],
            drives: Drives::Nothing,
            either: None,
        },
        Object {
            name: "points",
            about: "A closed curve through points, a periodic spline of the radius over the angle.",
            fields: &[required(
                "points",
                Shape::List(&PLACE, LEAST_POINTS),
                "From the cam's point, in its frame, once around it \\[m\\]; the last is joined to the first.",
            )],
            refused: &[],
            drives: Drives::Nothing,
            either: None,
        },
        Object {
            name: "law",
            about: "The motion of a follower that slides, over the angle of the cam.",
            fields: &[
                required(
                    "base_radius",
                    SOME_LENGTH,
                    "Radius of the base circle \\[m\\].",
                ),
                optional(
                    "axis",
                    Shape::Direction,
                    "Direction away from the cam in which a roller or a knife edge slides, in the follower's frame.",
                ),
                default(
                    "offset",
                    ANY_LENGTH,
                    Default::Zero,
                    "How far to the right of the cam's point, seen along `axis`, the line lies on which it slides \\[m\\].",
                ),
                BEGIN,
                required(
                    "segments",
                    Shape::List(&CAM_SEGMENTS, 1),
                    "Rises and dwells as the cam turns counterclockwise; what is left of the turn is a dwell.",
                ),
            ],
            refused: &[],
            drives: Drives::Nothing,
            either: None,
        },
        Object {
            name: "swing",
            about: "The motion of a roller or a knife edge on an arm, over the angle of the cam.",
            fields: &[
                required(
                    "arm",
                    SOME_LENGTH,
                    "Distance of the follower's point from the pivot of its arm \\[m\\].",
                ),
                required(
                    "distance",
                    SOME_LENGTH,
                    "Distance of the pivot from the cam's point \\[m\\].",
                ),
                required(
                    "axis",
                    Shape::Direction,
                    "Direction from the cam's point to the pivot, in the frame of the body that bears both.",
                ),
                required(
                    "angle",
                    ANY_ANGLE,
                    "Angle at the pivot from the cam's point to the follower's before the first rise \\[rad\\].",
                ),
                BEGIN,
                required(
                    "segments",
                    Shape::List(&SWING_SEGMENTS, 1),
                    "Rises and dwells as the cam turns counterclockwise; what is left of the turn is a dwell.",
                ),
            ],
            refused: &[],
            drives: Drives::Nothing,
            either: None,
        },
    ],
};
