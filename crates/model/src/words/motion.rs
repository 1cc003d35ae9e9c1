//! Motions: laws of time.

use crate::dimension::Dimension;
use crate::shape::{
    Bound, Choice, Default, Drives, Either, Field, Measure, Object, Shape, Tagged, default,
    optional, required, silent,
};

/// Rounds that are counted in a double without a gap, and more than anybody waits for.
const MOST_REPEATS: usize = 1_000_000_000;

const START: Field = default(
    "start",
    Shape::Quantity(Measure::Driven, Bound::Any),
    Default::Zero,
    "Value before.",
);
const RISE: Field = optional(
    "rise",
    Shape::Quantity(Measure::Driven, Bound::Any),
    "How far it goes.",
);
const END: Field = optional(
    "end",
    Shape::Quantity(Measure::Driven, Bound::Any),
    "Value after, instead of `rise`.",
);
const BEGIN: Field = default(
    "begin",
    Shape::Quantity(Measure::Of(Dimension::Time), Bound::Any),
    Default::Zero,
    "When it begins; it dwells before.",
);
const DURATION: Field = required(
    "duration",
    Shape::Quantity(Measure::Of(Dimension::Time), Bound::Above(0.0)),
    "How long it takes; it dwells after.",
);
const LASTING: Field = optional(
    "duration",
    Shape::Quantity(Measure::Of(Dimension::Time), Bound::Above(0.0)),
    "How long it takes; it dwells after.",
);
const RAMP: Field = optional(
    "ramp",
    Shape::Number(Bound::Above(0.0)),
    "Share of `duration` in which it speeds up, and the same in which it slows down; a third where it is left out, a half at most.",
);
const ROUNDING: Field = optional(
    "rounding",
    Shape::Number(Bound::Above(0.0)),
    "Share of a ramp in which the acceleration changes; a half where it is left out, 1 at most.",
);
const FASTEST: Field = optional(
    "velocity",
    Shape::Quantity(Measure::DrivenVelocity, Bound::Above(0.0)),
    "The greatest speed, instead of `duration`.",
);
const STEEPEST: Field = optional(
    "acceleration",
    Shape::Quantity(Measure::DrivenAcceleration, Bound::Above(0.0)),
    "The greatest acceleration.",
);

/// How far a rise goes is said once.
const RISES: Option<Either> = Some(Either {
    keys: ["rise", "end"],
    needed: Some("how far it goes, as in \"rise\": \"30 deg\", or \"end\", where to"),
    exclusive: true,
});

/// How fast a rise is is said once.
const PACED: Option<Either> = Some(Either {
    keys: ["duration", "velocity"],
    needed: Some(
        "say how long it takes, as in \"duration\": \"0.2 s\", or what it may reach, by \"velocity\" and \"acceleration\"",
    ),
    exclusive: true,
});

/// A part of a sequence.
pub static SEGMENT: Object = Object {
    name: "Segment",
    about: "A rise by a `law`, or a `dwell`.",
    fields: &[
        optional("law", Shape::Choice(&RISE_LAW), "How it rises."),
        optional(
            "rise",
            Shape::Quantity(Measure::Driven, Bound::Any),
            "How far it goes; back with the other sign.",
        ),
        END,
        LASTING,
        RAMP,
        ROUNDING,
        optional(
            "dwell",
            Shape::Quantity(Measure::Of(Dimension::Time), Bound::Above(0.0)),
            "How long it stays where it is.",
        ),
    ],
    refused: &[],
    drives: Drives::Nothing,
    either: Some(Either {
        keys: ["law", "dwell"],
        needed: Some(
            "a segment is a rise, as in { \"law\": \"cycloidal\", \"rise\": \"30 deg\", \"duration\": \"0.2 s\" }, or { \"dwell\": \"0.1 s\" }",
        ),
        exclusive: true,
    }),
};

/// The law of a rise.
pub static RISE_LAW: Choice = Choice {
    name: "RiseLaw",
    about: "The law of a rise in a sequence.",
    words: &[
        ("cycloidal", "Acceleration as a sine."),
        ("polynomial_3_4_5", "Polynomial of the fifth order."),
        ("polynomial_4_5_6_7", "Polynomial of the seventh order."),
        ("modified_sine", "Two paces of sines."),
        (
            "modified_trapezoid",
            "A trapezoid of acceleration with sines for its flanks.",
        ),
        (
            "trapezoidal_velocity",
            "Constant accelerations and a constant velocity.",
        ),
        ("s_curve", "The same with limited jerk."),
    ],
};

/// What is between the points of a table.
pub static INTERPOLATION: Choice = Choice {
    name: "Interpolation",
    about: "What is between the points of a table, and beyond them.",
    words: &[
        ("natural", "Cubic spline, straight beyond its ends."),
        ("linear", "Straight lines."),
        (
            "monotone",
            "Cubics that do not overshoot (Fritsch and Carlson 1980), straight beyond the ends.",
        ),
        ("periodic", "Periodic cubic spline, over and over."),
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
            about: "A curve through (t, value); times strictly increasing, at least two.",
            fields: &[
                optional("points", Shape::Table, "[[t, value], …]"),
                optional(
                    "file",
                    Shape::Text,
                    "A table in a file beside the model, instead of `points`.",
                ),
                optional(
                    "columns",
                    Shape::Pair(&Shape::Text),
                    "The names of the file's columns; the first two where it is left out.",
                ),
                optional(
                    "units",
                    Shape::Pair(&Shape::Text),
                    "Their units, where the file does not say them.",
                ),
                silent(
                    "interpolation",
                    Shape::Choice(&INTERPOLATION),
                    Default::Text("natural"),
                    "",
                ),
            ],
            refused: &[],
            drives: Drives::Nothing,
            either: Some(Either {
                keys: ["points", "file"],
                needed: Some("as in \"points\": [[0, 0], [1, \"90 deg\"]]"),
                exclusive: true,
            }),
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
        Object {
            name: "cycloidal",
            about: "A rise whose acceleration is a sine (VDI 2143: inclined sine line).",
            fields: &[START, RISE, END, BEGIN, DURATION],
            refused: &[],
            drives: Drives::Nothing,
            either: RISES,
        },
        Object {
            name: "polynomial_3_4_5",
            about: "A rise by 10 z³ − 15 z⁴ + 6 z⁵ (VDI 2143: polynomial of the fifth order).",
            fields: &[START, RISE, END, BEGIN, DURATION],
            refused: &[],
            drives: Drives::Nothing,
            either: RISES,
        },
        Object {
            name: "polynomial_4_5_6_7",
            about: "A rise by 35 z⁴ − 84 z⁵ + 70 z⁶ − 20 z⁷ (polynomial of the seventh order).",
            fields: &[START, RISE, END, BEGIN, DURATION],
            refused: &[],
            drives: Drives::Nothing,
            either: RISES,
        },
        Object {
            name: "modified_sine",
            about: "A rise whose acceleration is a sine of one pace at both ends, and of another between (VDI 2143: modified sine line).",
            fields: &[START, RISE, END, BEGIN, DURATION],
            refused: &[],
            drives: Drives::Nothing,
            either: RISES,
        },
        Object {
            name: "modified_trapezoid",
            about: "A rise whose acceleration is a trapezoid with sines for its flanks (VDI 2143: modified acceleration trapezoid).",
            fields: &[START, RISE, END, BEGIN, DURATION],
            refused: &[],
            drives: Drives::Nothing,
            either: RISES,
        },
        Object {
            name: "trapezoidal_velocity",
            about: "A rise with constant acceleration, constant velocity, constant deceleration.",
            fields: &[START, RISE, END, BEGIN, LASTING, RAMP, FASTEST, STEEPEST],
            refused: &[],
            drives: Drives::Nothing,
            either: PACED,
        },
        Object {
            name: "s_curve",
            about: "The same with accelerations that grow and fade at constant jerk: seven parts.",
            fields: &[
                START,
                RISE,
                END,
                BEGIN,
                LASTING,
                RAMP,
                ROUNDING,
                FASTEST,
                STEEPEST,
                optional(
                    "jerk",
                    Shape::Quantity(Measure::DrivenJerk, Bound::Above(0.0)),
                    "The greatest jerk.",
                ),
            ],
            refused: &[],
            drives: Drives::Nothing,
            either: PACED,
        },
        Object {
            name: "sequence",
            about: "Rises and dwells, one after the other.",
            fields: &[
                START,
                BEGIN,
                required(
                    "segments",
                    Shape::List(&Shape::Object(&SEGMENT), 1),
                    "Rises and dwells in their order.",
                ),
                optional(
                    "repeat",
                    Shape::Count(1, MOST_REPEATS),
                    "How often all of them are gone through; each time goes on from where the last ended.",
                ),
            ],
            refused: &[],
            drives: Drives::Nothing,
            either: None,
        },
    ],
};
