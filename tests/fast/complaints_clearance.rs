//! Understands the user: clearances that lack what their model needs, or whose parameters no law holds for.

/// A pendulum in a bearing; the clearance stands alone in line 6.
fn file(clearance: &str) -> String {
    format!(
        r#"{{ "format": "linkdyn/1", "units": "SI", "analysis": {{ "type": "dynamics", "end": 1, "outputs": 2 }},
  "bodies": {{ "ground": {{ "points": {{ "O": [0, 0] }} }},
              "bar": {{ "mass": 1, "inertia": 1, "com": [1, 0], "points": {{ "O": [0, 0] }} }} }},
  "joints": {{ "pin": {{ "type": "revolute", "between": ["ground.O", "bar.O"],
    "clearance":
{clearance}
  }} }} }}"#
    )
}

/// Complaints with the path shortened; their place is that of the object, or of the value.
fn said(clearance: &str) -> Vec<String> {
    let complaints = match linkdyn_model::load(file(clearance).as_bytes(), &[]) {
        Ok(_) => Vec::new(),
        Err(complaints) => Vec::from(complaints),
    };
    let text = |complaint: &linkdyn_model::error::Complaint| {
        let place = complaint.place.expect("it stands in the file");
        assert_eq!(place.line, 6, "{complaint}");
        if let Some(found) = complaint.found.as_ref() {
            assert!(
                clearance[place.column - 1..].starts_with(found.as_str()),
                "{complaint}"
            );
        }
        let text = complaint.to_string();
        let (_, rest) = text.split_once("joints.pin.clearance").expect("the path");
        rest.to_string()
    };
    complaints.iter().map(text).collect()
}

fn warnings(clearance: &str) -> Vec<String> {
    let loaded = linkdyn_model::load(file(clearance).as_bytes(), &[]).expect("a sound model");
    let rest = |warning: &String| {
        warning
            .split_once("joints.pin.clearance")
            .expect("the path")
            .1
            .to_string()
    };
    loaded.warnings.iter().map(rest).collect()
}

/// A contact with a law of the normal force and more.
fn contact(normal: &str, more: &str) -> String {
    format!(r#"{{ "model": "contact", "radius": 0.0005, "normal": {{ {normal} }}{more} }}"#)
}

const STEEL: &str = r#""elastic": { "young_modulus": 207e9, "poisson_ratio": 0.3 }"#;

#[test]
fn a_law_says_what_it_lacks() {
    let stiff = |law: &str| format!(r#""law": "{law}", "stiffness": 1e9"#);
    for law in [
        "hunt_crossley",
        "herbert_mcwhannell",
        "lee_wang",
        "lankarani_nikravesh",
        "zhiying_qishao",
    ] {
        let needs = format!(": \"normal.restitution\" is missing (the law {law:?} needs it)");
        assert_eq!(said(&contact(&stiff(law), "")), [needs]);
        assert!(said(&contact(&format!("{}, \"restitution\": 0", stiff(law)), "")).is_empty());
    }
    for law in ["flores", "gonthier", "hu_guo"] {
        let refused = format!(
            ".normal.restitution: 0: must be greater than 0 for the law {law:?} (\"hunt_crossley\" or \"zhiying_qishao\" allow 0)"
        );
        assert_eq!(
            said(&contact(&format!("{}, \"restitution\": 0", stiff(law)), "")),
            [refused]
        );
        assert!(said(&contact(&format!("{}, \"restitution\": 1", stiff(law)), "")).is_empty());
    }
    let needs = |key: &str, law: &str| format!(": {key:?} is missing (the law {law:?} needs it)");
    assert_eq!(
        said(&contact(&stiff("kelvin_voigt"), "")),
        [needs("normal.damping", "kelvin_voigt")]
    );
    let all = ["normal.elastic", "bearing_radius", "axial_length"];
    for law in ["johnson", "radzimovsky", "dubowsky_freudenstein", "pereira"] {
        assert_eq!(
            said(&contact(&stiff(law), "")),
            all.map(|key| needs(key, law))
        );
        let elastic = format!(r#""law": "{law}", {STEEL}"#);
        assert!(
            said(&contact(
                &elastic,
                r#", "bearing_radius": 0.01, "axial_length": 0.02"#
            ))
            .is_empty()
        );
    }
}

#[test]
fn the_stiffness_of_a_linear_law_may_have_a_unit() {
    let kelvin = |stiffness: &str| {
        format!(r#""law": "kelvin_voigt", "damping": 100, "stiffness": {stiffness}"#)
    };
    let stiffness = |stiffness: &str, units: &str| {
        let text = file(&contact(&kelvin(stiffness), "")).replace(r#""SI""#, units);
        let loaded = linkdyn_model::load(text.as_bytes(), &[]).expect("a sound model");
        let linkdyn_model::JointKind::Revolute {
            clearance: Some(clearance),
            ..
        } = &loaded.model.joints["pin"].kind
        else {
            panic!("a revolute joint with clearance")
        };
        clearance
            .normal
            .as_ref()
            .and_then(|normal| normal.stiffness)
    };
    assert_eq!(stiffness(r#""1e6 N/m""#, r#""SI""#), Some(1e6));
    assert_eq!(stiffness(r#""1e3 N/mm""#, r#""SI""#), Some(1e6));
    assert_eq!(stiffness(r#""=2*500 N/mm""#, r#""SI""#), Some(1e6));
    // A plain number is in SI whatever the springs' are in.
    assert_eq!(stiffness("1e6", r#"{ "stiffness": "N/mm" }"#), Some(1e6));
    let said_of = |stiffness: &str| said(&contact(&kelvin(stiffness), ""));
    assert_eq!(
        said_of(r#""1e6 N""#),
        [r#".normal.stiffness: "1e6 N": "N" is not a unit of stiffness (such as "N/m")"#]
    );
    assert_eq!(
        said_of("0"),
        [".normal.stiffness: 0: must be greater than 0"]
    );
    let hertz = r#""law": "hertz", "stiffness": "1e6 N/m""#;
    assert_eq!(
        said(&contact(hertz, "")),
        [
            r#".normal.stiffness: "1e6 N/m": a plain number is expected, not text (as in "stiffness": 1e9, in N/m^exponent; only "kelvin_voigt" takes a unit)"#
        ]
    );
}

#[test]
fn the_radii_and_the_length_stand_in_the_clearance() {
    let normal = format!(r#""law": "johnson", {STEEL}, "axial_length": 0.02"#);
    assert_eq!(
        said(&contact(&normal, r#", "bearing_radius": 0.01"#)),
        [
            r#": "axial_length" is missing (the law "johnson" needs it)"#,
            r#".normal.axial_length: "axial_length": it belongs to the clearance, beside "radius""#,
        ]
    );
}

#[test]
fn numbers_out_of_their_range_are_refused() {
    for (words, refused) in [
        (
            r#""law": "hertz", "stiffness": 0"#,
            ".normal.stiffness: 0: must be greater than 0",
        ),
        (
            r#""law": "hertz", "stiffness": -1e9"#,
            ".normal.stiffness: -1e9: must be greater than 0",
        ),
        (
            r#""law": "hertz", "stiffness": 1e9, "exponent": 0.9"#,
            ".normal.exponent: 0.9: must not be less than 1",
        ),
        (
            r#""law": "lee_wang", "stiffness": 1e9, "restitution": 1.2"#,
            ".normal.restitution: 1.2: must not be greater than 1",
        ),
        (
            r#""law": "lee_wang", "stiffness": 1e9, "restitution": -0.1"#,
            ".normal.restitution: -0.1: must not be negative",
        ),
        (
            r#""law": "kelvin_voigt", "stiffness": 1e9, "damping": -1"#,
            ".normal.damping: -1: must not be negative",
        ),
        (
            r#""law": "hertz", "elastic": { "young_modulus": 0, "poisson_ratio": 0.3 }"#,
            ".normal.elastic.young_modulus: 0: must be greater than 0",
        ),
        (
            r#""law": "hertz", "elastic": { "young_modulus": 1e9, "poisson_ratio": -1.5 }"#,
            ".normal.elastic.poisson_ratio: -1.5: must not be less than -1",
        ),
    ] {
        assert_eq!(
            said(&contact(words, r#", "bearing_radius": 0.01"#)),
            [refused]
        );
    }
    let radius = |radius: &str, more: &str| {
        said(&contact(&format!(r#""law": "pereira", {STEEL}"#), more).replace("0.0005", radius))
    };
    let bearing = r#", "bearing_radius": 0.02, "axial_length": 0.02"#;
    let fitted = "the law \"pereira\" holds from 5 µm to 10 mm (\"johnson\" has no such bound)";
    assert_eq!(
        radius("4e-6", bearing),
        [format!(".radius: 4e-6: {fitted}")]
    );
    assert_eq!(
        radius("0.01", bearing),
        [format!(".radius: 0.01: {fitted}")]
    );
    let bearing = r#", "bearing_radius": 0, "axial_length": 0"#;
    assert_eq!(
        radius("-1", bearing),
        [
            ".radius: -1: must not be negative",
            ".bearing_radius: 0: must be greater than 0",
            ".axial_length: 0: must be greater than 0"
        ]
    );
}

#[test]
fn the_journal_has_a_radius() {
    let refused = |radius: &str| {
        format!(
            ".bearing_radius: {radius}: must be greater than \"radius\", or the journal has none (\"radius\" is the clearance: bearing radius − journal radius)"
        )
    };
    let hertz = r#""law": "hertz", "stiffness": 1e9"#;
    assert_eq!(
        said(&contact(hertz, r#", "bearing_radius": 0.0005"#)),
        [refused("0.0005")]
    );
    assert_eq!(
        said(&contact(hertz, r#", "bearing_radius": 0.0004"#)),
        [refused("0.0004")]
    );
    assert!(said(&contact(hertz, r#", "bearing_radius": 0.0006"#)).is_empty());
    let two_state = r#"{ "model": "two_state", "radius": 1, "bearing_radius": 1, "surface": { "stiffness": 1e6 } }"#;
    assert_eq!(said(two_state), [refused("1")]);
    let impact = r#"{ "model": "three_state", "radius": 1, "bearing_radius": 1, "impact": { "restitution": 1 } }"#;
    assert_eq!(said(impact), [refused("1")]);
    // not used: kept and ignored
    assert!(said(r#"{ "model": "massless_link", "radius": 1, "bearing_radius": 1 }"#).is_empty());
}

#[test]
fn friction_says_what_it_lacks() {
    let friction = |words: &str| {
        let of_contact = contact(
            r#""law": "hertz", "stiffness": 1e9"#,
            &format!(r#", "friction": {{ {words} }}"#),
        );
        let of_surface = format!(
            r#"{{ "model": "two_state", "radius": 0.0005, "surface": {{ "stiffness": 1e6 }}, "friction": {{ {words} }} }}"#
        );
        let found = said(&of_contact);
        assert_eq!(said(&of_surface), found);
        found
    };
    let needs = |key: &str, law: &str| {
        format!(": \"friction.{key}\" is missing (the law {law:?} needs it)")
    };
    for (law, keys) in [
        ("none", &[][..]),
        ("coulomb", &["coefficient", "threshold_velocity"]),
        ("threlfall", &["coefficient", "threshold_velocity"]),
        (
            "ambrosio",
            &["coefficient", "lower_velocity", "upper_velocity"],
        ),
        (
            "stribeck",
            &[
                "coefficient",
                "static_coefficient",
                "stribeck_velocity",
                "threshold_velocity",
            ],
        ),
        (
            "lugre",
            &[
                "coefficient",
                "static_coefficient",
                "stribeck_velocity",
                "bristle_stiffness",
            ],
        ),
    ] {
        let needed: Vec<String> = keys.iter().map(|key| needs(key, law)).collect();
        assert_eq!(friction(&format!(r#""law": "{law}""#)), needed);
    }
    assert_eq!(
        friction(
            r#""law": "ambrosio", "coefficient": 0.1, "lower_velocity": 0.01, "upper_velocity": 0.01"#
        ),
        [
            ".friction.upper_velocity: 0.01: must be greater than \"lower_velocity\" (the force grows from nothing to μF_n between the two)"
        ]
    );
    assert_eq!(
        friction(r#""law": "coulomb", "coefficient": -0.1, "threshold_velocity": 0"#),
        [
            ".friction.coefficient: -0.1: must not be negative",
            ".friction.threshold_velocity: 0: must be greater than 0"
        ]
    );
}

#[test]
fn an_impact_may_take_its_restitution_from_the_contact() {
    let missing = [
        ": \"impact.restitution\" is missing (the model \"three_state\" needs it, or \"normal.restitution\")",
    ];
    let three_state = |more: &str| {
        said(&format!(
            r#"{{ "model": "three_state", "radius": 0.001{more} }}"#
        ))
    };
    assert_eq!(three_state(""), missing);
    assert_eq!(three_state(r#", "impact": { "friction": 0.1 }"#), missing);
    assert!(
        three_state(
            r#", "impact": { "friction": 0.1 }, "normal": { "law": "hertz", "restitution": 0.5 }"#
        )
        .is_empty()
    );
    assert_eq!(
        three_state(r#", "impact": { "restitution": 1.2, "friction": -1, "sense": "newton" }"#),
        [
            ".impact.restitution: 1.2: must not be greater than 1",
            ".impact.friction: -1: must not be negative",
            ".impact.sense: \"newton\": unknown sense (one of \"energetic\", \"kinetic\" or \"kinematic\")"
        ]
    );
}

#[test]
fn doubtful_parameters_are_warned_of() {
    let with = |normal: &str| contact(&format!("{normal}, {STEEL}"), r#", "bearing_radius": 0.01"#);
    let said = |exponent: f64| {
        [format!(
            ".normal.elastic: gives a stiffness in N/m^1.5, whose number is taken with the exponent {exponent} (give \"stiffness\" in the unit that belongs to the exponent)"
        )]
    };
    assert_eq!(
        warnings(&with(r#""law": "kelvin_voigt", "damping": 10"#)),
        said(1.0)
    );
    assert_eq!(
        warnings(&with(r#""law": "hertz", "exponent": 1.4"#)),
        said(1.4)
    );
    assert!(warnings(&with(r#""law": "hertz""#)).is_empty());
    assert!(
        warnings(&with(
            r#""law": "hertz", "exponent": 1.4, "stiffness": 1e9"#
        ))
        .is_empty()
    );
    let friction = r#", "friction": { "law": "stribeck", "coefficient": 0.2, "static_coefficient": 0.1,
        "stribeck_velocity": 0.1, "threshold_velocity": 0.01 }"#;
    assert_eq!(
        warnings(&contact(r#""law": "hertz", "stiffness": 1e9"#, friction)),
        [
            ".friction.static_coefficient: 0.1: is less than the kinetic \"coefficient\" (\"coefficient\" is the kinetic one)"
        ]
    );
}
