//! What to compute, and for which instants.

use crate::analysis::MOST_OUTPUTS;
use crate::dimension::Dimension;
use crate::shape::{
    Bound, Choice, Default, Drives, Measure, Named, Object, Shape, default, optional, required,
    silent,
};

/// The wanted analysis.
pub static ANALYSIS: Object = Object {
    name: "Analysis",
    about: "The wanted analysis.",
    fields: &[
        required("type", Shape::Choice(&ANALYSIS_KIND), ""),
        optional(
            "end",
            Shape::Quantity(Measure::Of(Dimension::Time), Bound::Above(0.0)),
            "End time \\[s\\], start is 0.",
        ),
        optional(
            "outputs",
            Shape::Count(2, MOST_OUTPUTS),
            "Number of equally spaced output instants, both ends included.",
        ),
        optional(
            "sample",
            Shape::Object(&SAMPLE),
            "Instead of both: outputs equally spaced in a driver's value.",
        ),
        silent(
            "outputs_at",
            Shape::Choice(&OUTPUTS_AT),
            Default::Text("equidistant"),
            "Which instants are outputs: equally spaced ones alone, or those of located events, too.",
        ),
        silent("solver", Shape::Object(&SOLVER), Default::Same, ""),
        default(
            "columns",
            Shape::List(&Shape::Text, 0),
            Default::Empty,
            "Patterns of the result columns to keep; `*` and `?` match the name without its `[unit]`; none means all.",
        ),
        optional(
            "transmission",
            Shape::Object(&TRANSMISSION),
            "What the report's mechanical advantage and transmission angles are of.",
        ),
    ],
    refused: &[],
    drives: Drives::Nothing,
    either: None,
};

/// Kind of analysis.
pub static ANALYSIS_KIND: Choice = Choice {
    name: "AnalysisKind",
    about: "Kind of analysis.",
    words: &[
        ("assembly", "Puts the parts together, nothing more."),
        (
            "kinematics",
            "Positions, velocities and accelerations of a driven mechanism.",
        ),
        (
            "inverse_dynamics",
            "Kinematics, and the forces and torques that this motion needs.",
        ),
        ("dynamics", "The motion that forces and masses bring about."),
        ("statics", "Equilibrium."),
    ],
};

/// Outputs equally spaced in a driver's value (SI: rad or m).
pub static SAMPLE: Object = Object {
    name: "Sample",
    about: "Outputs equally spaced in a driver's value (SI: rad or m).",
    fields: &[
        required("driver", Shape::Name(Named::Driver), "Name of the driver."),
        required(
            "from",
            Shape::Quantity(Measure::Driven, Bound::Any),
            "First value.",
        ),
        required(
            "to",
            Shape::Quantity(Measure::Driven, Bound::Any),
            "Last value, always among the outputs.",
        ),
        required(
            "step",
            Shape::Quantity(Measure::Driven, Bound::NotZero),
            "Spacing; the direction is that from `from` to `to`, the sign does not matter.",
        ),
    ],
    refused: &[],
    drives: Drives::Sampled,
    either: None,
};

/// Which instants are outputs.
pub static OUTPUTS_AT: Choice = Choice {
    name: "OutputsAt",
    about: "Which instants are outputs.",
    words: &[
        ("equidistant", "Equally spaced ones."),
        ("events", "These, and those of located events."),
    ],
};

/// Who solves for the accelerations of forward dynamics.
pub static ACCELERATIONS: Choice = Choice {
    name: "Accelerations",
    about: "Who solves for the accelerations of forward dynamics.",
    words: &[
        ("auto", "What costs least."),
        (
            "dense",
            "Small dense matrices of the independent coordinates' tangents.",
        ),
        (
            "sparse",
            "One sparse matrix of all coordinates and constraints.",
        ),
    ],
};

/// With a looser tolerance no digit of a result would be right, and estimates of errors mean nothing.
const LOOSEST: f64 = 0.1;

/// Solver settings; the defaults are right for most models.
pub static SOLVER: Object = Object {
    name: "Solver",
    about: "Solver settings; the defaults are right for most models.",
    fields: &[
        default(
            "method",
            Shape::Text,
            Default::Text("auto"),
            "Method of integration.",
        ),
        silent(
            "accelerations",
            Shape::Choice(&ACCELERATIONS),
            Default::Text("auto"),
            "Who solves for accelerations: by few dense numbers or many sparse ones.",
        ),
        default(
            "rtol",
            Shape::Number(Bound::Within(0.0, LOOSEST)),
            Default::Number(1e-06),
            "Relative tolerance.",
        ),
        default(
            "atol",
            Shape::Number(Bound::Within(0.0, LOOSEST)),
            Default::Number(1e-09),
            "Absolute tolerance, in SI units of each coordinate.",
        ),
        optional(
            "max_step",
            Shape::Quantity(Measure::Of(Dimension::Time), Bound::Above(0.0)),
            "Longest step \\[s\\].",
        ),
        optional(
            "initial_step",
            Shape::Quantity(Measure::Of(Dimension::Time), Bound::Above(0.0)),
            "First step \\[s\\].",
        ),
        optional(
            "max_wall_time",
            Shape::Quantity(Measure::Of(Dimension::Time), Bound::Above(0.0)),
            "Time of the clock on the wall after which to give up \\[s\\].",
        ),
    ],
    refused: &[],
    drives: Drives::Nothing,
    either: None,
};

/// From which driver to which body motion and force are transmitted.
pub static TRANSMISSION: Object = Object {
    name: "Transmission",
    about: "From which driver to which body motion and force are transmitted.",
    fields: &[
        optional(
            "driver",
            Shape::Name(Named::Driver),
            "Name of the driver; may be left out where there is only one.",
        ),
        required(
            "output",
            Shape::Name(Named::Body),
            "The driven body: its slide where a prismatic joint holds it to ground, else its angle.",
        ),
    ],
    refused: &[],
    drives: Drives::Nothing,
    either: None,
};
