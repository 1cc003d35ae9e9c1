//! Many variants of a model.

use crate::shape::{Choice, Default, Drives, Object, Shape, optional, silent};

/// A study of many variants.
pub static STUDY: Object = Object {
    name: "Study",
    about: "Many variants, which `linkdyn study` runs; options of the command go before these words.",
    fields: &[
        silent(
            "vary",
            Shape::Map(&Shape::Text),
            Default::Empty,
            "Parameters by their names, and their values as `--vary` takes them: `40 mm:60 mm:21` (from, to, count) or `40 mm, 50 mm`; several multiply.",
        ),
        optional(
            "samples",
            Shape::Count(1, usize::MAX >> 11),
            "How many samples are drawn of all parameters that have a tolerance.",
        ),
        silent(
            "method",
            Shape::Choice(&METHOD),
            Default::Text("random"),
            "How samples are drawn.",
        ),
        silent(
            "indices",
            Shape::Choice(&INDICES),
            Default::Text("none"),
            "Whether samples are drawn so that it can be told which parameter matters.",
        ),
        optional(
            "seed",
            Shape::Count(0, usize::MAX >> 11),
            "Seed of the samples; 1 where left out.",
        ),
    ],
    refused: &[],
    drives: Drives::Nothing,
    either: None,
};

/// How samples are drawn.
pub static METHOD: Choice = Choice {
    name: "SampleMethod",
    about: "How samples are drawn.",
    words: &[
        ("random", "Each by itself."),
        ("latin", "A Latin hypercube."),
        ("sobol", "Scrambled Sobol points."),
    ],
};

/// What the samples are for besides.
pub static INDICES: Choice = Choice {
    name: "SampleIndices",
    about: "Whether samples are drawn so that it can be told which parameter matters.",
    words: &[
        ("none", "No."),
        ("sobol", "Sobol indices: inputs + 2 rows for each sample."),
    ],
};
