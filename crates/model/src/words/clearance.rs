//! Clearance and the laws of its contact.

use super::friction::FRICTION;
use crate::dimension::Dimension;
use crate::shape::{
    Bound, Choice, Default, Drives, Either, Measure, Object, Shape, default, optional, required,
};

/// Clearance of a revolute joint; parameters of models other than the one in use are kept as written.
pub static CLEARANCE: Object = Object {
    name: "Clearance",
    about: "Clearance of a revolute joint; parameters of models other than the one in use are kept as written.",
    fields: &[
        required("model", Shape::Choice(&CLEARANCE_MODEL), ""),
        optional(
            "radius",
            Shape::Range(Measure::Of(Dimension::Length), Bound::AtLeast(0.0)),
            "Radial clearance: bearing radius − journal radius \\[m\\], or `[least, most]` of it, whose mean counts but for accuracy; needed by every model but `ideal`.",
        ),
        optional(
            "fit",
            Shape::Text,
            "Instead of `radius`: nominal diameter in mm, hole and shaft by ISO 286, as in `20 H7/g6`.",
        ),
        optional(
            "bearing_radius",
            Shape::Quantity(Measure::Of(Dimension::Length), Bound::Above(0.0)),
            "Radius of the bearing R_b \\[m\\]; with `elastic` it gives the stiffness.",
        ),
        optional(
            "axial_length",
            Shape::Quantity(Measure::Of(Dimension::Length), Bound::Above(0.0)),
            "Axial length of the contact \\[m\\], of the cylindrical laws `johnson`, `radzimovsky`, `dubowsky_freudenstein` and `pereira`.",
        ),
        optional(
            "normal",
            Shape::Object(&NORMAL),
            "Normal force of `contact`.",
        ),
        optional(
            "friction",
            Shape::Object(&FRICTION),
            "Friction of `contact` and `two_state`; left out: none.",
        ),
        optional(
            "surface",
            Shape::Object(&SURFACE),
            "Linear surface of `two_state`.",
        ),
        optional(
            "impact",
            Shape::Object(&IMPACT),
            "Impact of `three_state`; what it leaves out: `normal.restitution` and `friction.coefficient`.",
        ),
    ],
    refused: &[],
    drives: Drives::Nothing,
    either: Some(Either {
        keys: ["radius", "fit"],
        needed: None,
        exclusive: true,
    }),
};

/// The rung of the ladder.
pub static CLEARANCE_MODEL: Choice = Choice {
    name: "ClearanceModel",
    about: "The rung of the ladder.",
    words: &[
        ("ideal", "As if there were no clearance."),
        (
            "massless_link",
            "The journal always touches the bearing, at the end of a massless link (Earles and Wu 1972).",
        ),
        (
            "two_state",
            "Free flight, or contact with a linear surface of stiffness and damping (Dubowsky and Freudenstein 1971).",
        ),
        (
            "three_state",
            "Free flight, impact, or sliding contact (Miedema and Mansour 1976).",
        ),
        (
            "contact",
            "Continuous contact force from a law of penetration.",
        ),
    ],
};

/// Normal force of a contact; where a law dissipates by a hysteresis factor χ, F = K δⁿ + χ δⁿ δ̇.
pub static NORMAL: Object = Object {
    name: "Normal",
    about: "Normal force of a contact; where a law dissipates by a hysteresis factor χ, F = K δⁿ + χ δⁿ δ̇.",
    fields: &[
        required("law", Shape::Choice(&NORMAL_LAW), ""),
        optional(
            "stiffness",
            Shape::ContactStiffness,
            "Stiffness K [N/m^exponent], a plain SI number, for `kelvin_voigt` also text with a unit; left out, it follows from `elastic`. Not used by the cylindrical laws.",
        ),
        optional(
            "exponent",
            Shape::Coefficient(Bound::AtLeast(1.0)),
            "Exponent n of Kδⁿ [–], at least 1, default 3/2 (Hertz); `kelvin_voigt` has 1, the cylindrical laws their own.",
        ),
        optional(
            "restitution",
            Shape::Coefficient(Bound::Between(0.0, 1.0)),
            "Coefficient of restitution c [–], 0 to 1, above 0 for `flores`, `gonthier` and `hu_guo`; without it the cylindrical laws are elastic.",
        ),
        optional(
            "damping",
            Shape::Quantity(Measure::Of(Dimension::Damping), Bound::AtLeast(0.0)),
            "Damping D of `kelvin_voigt` [N·s/m].",
        ),
        optional(
            "elastic",
            Shape::Materials,
            "Elastic constants that give K = 4/(3(h_b + h_j))·√(R_b R_j/(R_b − R_j)), h = (1 − ν²)/E (Goldsmith 1960).",
        ),
    ],
    refused: &[
        (
            "axial_length",
            "it belongs to the clearance, beside \"radius\"",
        ),
        (
            "bearing_radius",
            "it belongs to the clearance, beside \"radius\"",
        ),
        ("radius", "it belongs to the clearance, beside \"model\""),
    ],
    drives: Drives::Nothing,
    either: None,
};

/// Law of the normal force, F(penetration δ, its rate δ̇) ≥ 0.
pub static NORMAL_LAW: Choice = Choice {
    name: "NormalLaw",
    about: "Law of the normal force, F(penetration δ, its rate δ̇) ≥ 0.",
    words: &[
        ("hertz", "F = K δⁿ (Hertz 1881)."),
        ("kelvin_voigt", "F = K δ + D δ̇ (Kelvin and Voigt)."),
        (
            "hunt_crossley",
            "χ = 3(1 − c)/2 · K/δ̇₀ (Hunt and Crossley 1975).",
        ),
        (
            "herbert_mcwhannell",
            "χ = 6(1 − c)/((2c − 1)² + 3) · K/δ̇₀ (Herbert and McWhannell 1977).",
        ),
        ("lee_wang", "χ = 3(1 − c)/4 · K/δ̇₀ (Lee and Wang 1983)."),
        (
            "lankarani_nikravesh",
            "χ = 3(1 − c²)/4 · K/δ̇₀ (Lankarani and Nikravesh 1990).",
        ),
        ("flores", "χ = 8(1 − c)/(5c) · K/δ̇₀ (Flores et al. 2011)."),
        (
            "gonthier",
            "χ = d/c · K/δ̇₀, (1 + d/c)/(1 − d) = exp(d(1 + 1/c)) (Gonthier et al. 2004).",
        ),
        (
            "zhiying_qishao",
            "χ = 3(1 − c²)exp(2(1 − c))/4 · K/δ̇₀ (Zhiying and Qishao 2006).",
        ),
        ("hu_guo", "χ = 3(1 − c)/(2c) · K/δ̇₀ (Hu and Guo 2015)."),
        (
            "johnson",
            "Cylinder in cylinder, δ(F) logarithmic (Johnson 1985).",
        ),
        (
            "radzimovsky",
            "Cylinder in cylinder, δ(F) logarithmic (Radzimovsky 1953).",
        ),
        (
            "dubowsky_freudenstein",
            "Cylinder in cylinder, δ(F) logarithmic (Dubowsky and Freudenstein 1971).",
        ),
        (
            "pereira",
            "Cylinder in cylinder, explicit fit (Pereira et al. 2015).",
        ),
    ],
};

/// An elastic material.
pub static MATERIAL: Object = Object {
    name: "Material",
    about: "An elastic material.",
    fields: &[
        required(
            "young_modulus",
            Shape::Quantity(Measure::Of(Dimension::Stress), Bound::Above(0.0)),
            "Young's modulus E \\[Pa\\].",
        ),
        required(
            "poisson_ratio",
            Shape::Number(Bound::Between(-1.0, 0.5)),
            "Poisson's ratio ν [–].",
        ),
    ],
    refused: &[],
    drives: Drives::Nothing,
    either: None,
};

/// Linear surface of the two-state model (Dubowsky and Freudenstein 1971).
pub static SURFACE: Object = Object {
    name: "Surface",
    about: "Linear surface of the two-state model (Dubowsky and Freudenstein 1971).",
    fields: &[
        required(
            "stiffness",
            Shape::Quantity(Measure::Of(Dimension::Stiffness), Bound::Above(0.0)),
            "Stiffness [N/m].",
        ),
        default(
            "damping",
            Shape::Quantity(Measure::Of(Dimension::Damping), Bound::AtLeast(0.0)),
            Default::Zero,
            "Damping [N·s/m].",
        ),
    ],
    refused: &[],
    drives: Drives::Nothing,
    either: None,
};

/// Impact of the three-state model (Miedema and Mansour 1976).
pub static IMPACT: Object = Object {
    name: "Impact",
    about: "Impact of the three-state model (Miedema and Mansour 1976).",
    fields: &[
        optional(
            "restitution",
            Shape::Coefficient(Bound::Between(0.0, 1.0)),
            "Coefficient of restitution [–], 0 to 1.",
        ),
        optional(
            "friction",
            Shape::Coefficient(Bound::AtLeast(0.0)),
            "Coefficient of friction [–].",
        ),
        optional(
            "sense",
            Shape::Choice(&IMPACT_SENSE),
            "What the coefficient of restitution compares, default `energetic`.",
        ),
    ],
    refused: &[],
    drives: Drives::Nothing,
    either: None,
};

/// What a coefficient of restitution compares; the three agree where sliding keeps its direction.
pub static IMPACT_SENSE: Choice = Choice {
    name: "ImpactSense",
    about: "What a coefficient of restitution compares; the three agree where sliding keeps its direction.",
    words: &[
        (
            "energetic",
            "Works of the normal force (Stronge 1990): never gains energy.",
        ),
        ("kinetic", "Normal impulses (Poisson 1817)."),
        ("kinematic", "Normal velocities (Newton 1687)."),
    ],
};

/// Materials of bearing and journal, each its own.
pub static SEPARATE: Object = Object {
    name: "Elastic",
    about: "Each its own.",
    fields: &[
        required("bearing", Shape::Object(&MATERIAL), ""),
        required("journal", Shape::Object(&MATERIAL), ""),
    ],
    refused: &[],
    drives: Drives::Nothing,
    either: None,
};
