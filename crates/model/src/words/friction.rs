//! Laws of friction.

use crate::dimension::Dimension;
use crate::shape::{Bound, Choice, Drives, Measure, Object, Shape, optional, required};

/// Friction of a contact.
pub static FRICTION: Object = Object {
    name: "Friction",
    about: "Friction of a contact.",
    fields: &[
        required("law", Shape::Choice(&FRICTION_LAW), ""),
        optional(
            "coefficient",
            Shape::Coefficient(Bound::AtLeast(0.0)),
            "(Kinetic) coefficient μ [–].",
        ),
        optional(
            "static_coefficient",
            Shape::Coefficient(Bound::AtLeast(0.0)),
            "Static coefficient μ_s [–], of `stribeck` and `lugre`.",
        ),
        optional(
            "threshold_velocity",
            Shape::Quantity(Measure::Of(Dimension::Velocity), Bound::Above(0.0)),
            "Velocity up to which the force grows from zero [m/s], of `coulomb`, `threlfall` and `stribeck`.",
        ),
        optional(
            "lower_velocity",
            Shape::Quantity(Measure::Of(Dimension::Velocity), Bound::AtLeast(0.0)),
            "Velocity v₀ of `ambrosio` [m/s].",
        ),
        optional(
            "upper_velocity",
            Shape::Quantity(Measure::Of(Dimension::Velocity), Bound::Above(0.0)),
            "Velocity v₁ of `ambrosio` [m/s].",
        ),
        optional(
            "stribeck_velocity",
            Shape::Quantity(Measure::Of(Dimension::Velocity), Bound::Above(0.0)),
            "Velocity v_s of `stribeck` and `lugre` [m/s].",
        ),
        optional(
            "stribeck_exponent",
            Shape::Coefficient(Bound::Above(0.0)),
            "Exponent of `stribeck` and `lugre` [–], default 2.",
        ),
        optional(
            "viscous",
            Shape::Coefficient(Bound::AtLeast(0.0)),
            "Viscous part of `stribeck` and `lugre`, σ₂ [s/m] (of the normal force), a plain SI number.",
        ),
        optional(
            "bristle_stiffness",
            Shape::Coefficient(Bound::Above(0.0)),
            "Stiffness of the bristles of `lugre`, σ₀ [1/m] (of the normal force), a plain SI number.",
        ),
        optional(
            "bristle_damping",
            Shape::Coefficient(Bound::AtLeast(0.0)),
            "Damping of the bristles of `lugre`, σ₁ [s/m] (of the normal force), a plain SI number.",
        ),
    ],
    refused: &[],
    drives: Drives::Nothing,
    either: None,
};

/// Law of the friction force, against the sliding velocity v.
pub static FRICTION_LAW: Choice = Choice {
    name: "FrictionLaw",
    about: "Law of the friction force, against the sliding velocity v.",
    words: &[
        ("none", "No friction."),
        (
            "coulomb",
            "μ F_n, linear up to `threshold_velocity` (Coulomb 1785).",
        ),
        (
            "ambrosio",
            "μ F_n, none below `lower_velocity`, linear up to `upper_velocity` (Ambrósio 2003).",
        ),
        (
            "threlfall",
            "μ F_n (1 − exp(−3v/`threshold_velocity`)) up to it, 0.95 μ F_n from there (Threlfall 1978).",
        ),
        (
            "stribeck",
            "From static to kinetic as exp(−(v/`stribeck_velocity`)^`stribeck_exponent`) (Stribeck 1902; Bo and Pavelescu 1982).",
        ),
        (
            "lugre",
            "Bristles with a state (Canudas de Wit et al. 1995).",
        ),
    ],
};
