//! Clearances of joints.

use super::Case;

pub const CASES: &[Case] = &[
    Case {
        what: "clearance model unknown",
        edits: &[(r#""massless_link""#, r#""massles_link""#)],
        sets: &[],
        complaints: &[
            r#"line 17, column 31: joints.b.clearance.model: "massles_link": unknown model (did you mean "massless_link"?)"#,
        ],
    },
    Case {
        what: "clearance radius missing",
        edits: &[(r#", "radius": 0.1"#, "")],
        sets: &[],
        complaints: &[
            r#"line 17, column 20: joints.b.clearance: "radius" is missing, the model "massless_link" needs the radial clearance (bearing radius − journal radius, as in "0.1 mm")"#,
        ],
    },
    Case {
        what: "clearance radius zero",
        edits: &[(
            r#""massless_link", "radius": 0.1"#,
            r#""contact", "radius": 0, "normal": { "law": "hertz", "stiffness": 1e8 }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 17, column 52: joints.b.clearance.radius: 0: must be greater than 0 for the model "contact""#,
        ],
    },
    Case {
        what: "clearance radius negative",
        edits: &[(r#""radius": 0.1"#, r#""radius": "-10 um""#)],
        sets: &[],
        complaints: &[
            r#"line 17, column 58: joints.b.clearance.radius: "-10 um": must not be negative"#,
        ],
    },
    Case {
        what: "contact without a normal law",
        edits: &[(r#""massless_link""#, r#""contact""#)],
        sets: &[],
        complaints: &[
            r#"line 17, column 20: joints.b.clearance: "normal" is missing (the model "contact" needs a law of the normal force)"#,
        ],
    },
    Case {
        what: "contact without stiffness",
        edits: &[(
            r#""massless_link""#,
            r#""contact", "normal": { "law": "flores", "restitution": 0.9 }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 17, column 20: joints.b.clearance: "normal.stiffness" is missing (give it, or "elastic" and "bearing_radius")"#,
        ],
    },
    Case {
        what: "contact with elastic and no bearing radius",
        edits: &[(
            r#""massless_link""#,
            r#""contact", "normal": { "law": "hertz", "elastic": { "young_modulus": "207 GPa", "poisson_ratio": 0.3 } }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 17, column 20: joints.b.clearance: "bearing_radius" is missing (the stiffness follows from "elastic" and the radii)"#,
        ],
    },
    Case {
        what: "law without restitution",
        edits: &[(
            r#""massless_link""#,
            r#""contact", "normal": { "law": "hu_guo", "stiffness": 1e8 }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 17, column 20: joints.b.clearance: "normal.restitution" is missing (the law "hu_guo" needs it)"#,
        ],
    },
    Case {
        what: "friction without its velocity",
        edits: &[(
            r#""massless_link""#,
            r#""contact", "normal": { "law": "hertz", "stiffness": 1e8 }, "friction": { "law": "coulomb", "coefficient": 0.1 }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 17, column 20: joints.b.clearance: "friction.threshold_velocity" is missing (the law "coulomb" needs it)"#,
        ],
    },
    Case {
        what: "restitution and Poisson out of range",
        edits: &[(
            r#""massless_link""#,
            r#""ideal", "normal": { "law": "hertz", "restitution": 1.2, "elastic": { "young_modulus": 1, "poisson_ratio": 0.6 } }"#,
        )],
        sets: &[],
        complaints: &[
            "line 17, column 83: joints.b.clearance.normal.restitution: 1.2: must not be greater than 1",
            "line 17, column 138: joints.b.clearance.normal.elastic.poisson_ratio: 0.6: must not be greater than 0.5",
        ],
    },
    Case {
        what: "material of one part only",
        edits: &[(
            r#""massless_link""#,
            r#""ideal", "normal": { "law": "hertz", "elastic": { "bearing": { "young_modulus": 1, "poisson_ratio": 0.3 } } }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 17, column 79: joints.b.clearance.normal.elastic: "journal" is missing"#,
        ],
    },
    Case {
        what: "law unknown",
        edits: &[(
            r#""massless_link""#,
            r#""ideal", "normal": { "law": "lankarani-nikravesh" }, "friction": { "law": "stick" }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 17, column 59: joints.b.clearance.normal.law: "lankarani-nikravesh": unknown law (did you mean "lankarani_nikravesh"?)"#,
            r#"line 17, column 105: joints.b.clearance.friction.law: "stick": unknown law (one of "none", "coulomb", "ambrosio", "threlfall", "stribeck" or "lugre")"#,
        ],
    },
    Case {
        what: "two_state without a surface",
        edits: &[(r#""massless_link""#, r#""two_state""#)],
        sets: &[],
        complaints: &[
            r#"line 17, column 20: joints.b.clearance: "surface" is missing (the model "two_state" needs its stiffness and damping)"#,
        ],
    },
    Case {
        what: "three_state without a restitution",
        edits: &[(r#""massless_link""#, r#""three_state""#)],
        sets: &[],
        complaints: &[
            r#"line 17, column 20: joints.b.clearance: "impact.restitution" is missing (the model "three_state" needs it, or "normal.restitution")"#,
        ],
    },
];
