//! Words and what is made of them.

use super::*;
use crate::contact::friction::Decay;
use serde_json::{Value, json};

fn clearance(normal: Value, more: Value) -> Clearance {
    let mut words =
        json!({ "model": "contact", "radius": 0.0005, "bearing_radius": 0.01, "normal": normal });
    for (key, value) in more.as_object().into_iter().flatten() {
        words[key] = value.clone();
    }
    serde_json::from_value(words).expect("words of a clearance")
}

fn normal(normal: Value, more: Value) -> Result<normal::Law, String> {
    let clearance = clearance(normal, more);
    Words {
        clearance: &clearance,
        path: "joints.b.clearance",
    }
    .normal_law()
    .map_err(|said| said.to_string())
}

fn friction(words: Value) -> Result<friction::Law, String> {
    let clearance = clearance(json!({ "law": "hertz" }), json!({ "friction": words }));
    Words {
        clearance: &clearance,
        path: "joints.b.clearance",
    }
    .friction_law()
    .map_err(|said| said.to_string())
}

#[test]
fn stiffness_is_given_or_follows_from_materials_and_radii() {
    let law = normal(
        json!({ "law": "hertz", "stiffness": 1e9, "exponent": 1.4 }),
        json!({}),
    );
    assert_eq!(
        law,
        Ok(normal::Law::Hertz {
            stiffness: 1e9,
            exponent: 1.4
        })
    );
    let steel = json!({ "young_modulus": 207e9, "poisson_ratio": 0.3 });
    let law = normal(
        json!({ "law": "lankarani_nikravesh", "restitution": 0.9, "elastic": steel }),
        json!({}),
    );
    let Ok(normal::Law::Dissipative {
        stiffness,
        exponent,
        hysteresis,
    }) = law
    else {
        panic!("{law:?}")
    };
    // By hand in `normal::stiffness`; χ = 3(1 − 0.81)/4.
    assert!(
        (stiffness / 6.610198e10 - 1.0).abs() < 1e-6 && exponent == 1.5,
        "{stiffness:e}"
    );
    assert!((hysteresis - 0.1425).abs() < 1e-15, "{hysteresis}");
    let apart = json!({ "bearing": { "young_modulus": 100e9, "poisson_ratio": 0.0 },
                            "journal": { "young_modulus": 50e9, "poisson_ratio": 0.5 } });
    let law = normal(json!({ "law": "hertz", "elastic": apart }), json!({}));
    let Ok(normal::Law::Hertz { stiffness, .. }) = law else {
        panic!("{law:?}")
    };
    // h = 1e-11 + 0.75/5e10 = 2.5e-11, K = 4/(7.5e-11)·√0.19
    assert!(
        (stiffness / (4.0 / 7.5e-11 * 0.19_f64.sqrt()) - 1.0).abs() < 1e-12,
        "{stiffness:e}"
    );
}

#[test]
fn each_rule_has_its_word() {
    for (word, factor) in [
        ("hunt_crossley", 0.75),
        ("herbert_mcwhannell", 1.0),
        ("lee_wang", 0.375),
        ("lankarani_nikravesh", 0.5625),
        ("flores", 1.6),
        ("gonthier", 1.4327505),
        ("zhiying_qishao", 0.5625 * std::f64::consts::E),
        ("hu_guo", 1.5),
    ] {
        let law = normal(
            json!({ "law": word, "stiffness": 1e9, "restitution": 0.5 }),
            json!({}),
        );
        let Ok(normal::Law::Dissipative { hysteresis, .. }) = law else {
            panic!("{word}: {law:?}")
        };
        assert!((hysteresis - factor).abs() < 5e-8, "{word}: {hysteresis}");
    }
}

#[test]
fn cylinders_take_length_and_materials() {
    let words = |law: &str| json!({ "law": law, "elastic": { "young_modulus": 207e9, "poisson_ratio": 0.3 } });
    let mut scales = Vec::new();
    for law in ["johnson", "radzimovsky", "dubowsky_freudenstein"] {
        let law = normal(words(law), json!({ "axial_length": 0.02 }));
        let Ok(normal::Law::Cylindrical {
            elastic,
            hysteresis: 0.0,
        }) = law
        else {
            panic!("{law:?}")
        };
        scales.push(elastic.scale / (elastic.modulus * 0.0005));
    }
    let e = std::f64::consts::E;
    let wanted = [
        4.0 / e,
        6.25 / std::f64::consts::PI * (2.0_f64 / 3.0).exp(),
        e * 4.0 / 0.95,
    ];
    assert!(
        scales
            .iter()
            .zip(wanted)
            .all(|(scale, wanted)| (scale - wanted).abs() < 1e-12),
        "{scales:?}"
    );
    let law = normal(words("pereira"), json!({ "axial_length": 0.02 }));
    assert!(
        matches!(
            law,
            Ok(normal::Law::Dissipative {
                hysteresis: 0.0,
                ..
            })
        ),
        "{law:?}"
    );
    let said = normal(words("johnson"), json!({})).expect_err("no length");
    assert_eq!(
        said,
        "joints.b.clearance.axial_length: is missing, the law needs it"
    );
}

#[test]
fn what_can_not_be_evaluated_is_refused() {
    let said = normal(
        json!({ "law": "flores", "stiffness": 1e9, "restitution": 0.0 }),
        json!({}),
    )
    .unwrap_err();
    assert_eq!(
        said,
        "joints.b.clearance.normal.restitution: 0: is out of the law's range"
    );
    assert!(
        normal(
            json!({ "law": "lee_wang", "stiffness": 1e9, "restitution": 0.0 }),
            json!({})
        )
        .is_ok()
    );
    assert!(normal(json!({ "law": "hertz", "stiffness": -1e9 }), json!({})).is_err());
    assert!(normal(json!({ "law": "hertz" }), json!({})).is_err());
    let elastic =
        json!({ "law": "hertz", "elastic": { "young_modulus": 1e9, "poisson_ratio": 0.3 } });
    assert!(normal(elastic, json!({ "bearing_radius": 0.0005 })).is_err());
}

#[test]
fn an_impact_takes_what_it_lacks_from_the_contact() {
    let parameters = |more: Value| {
        let clearance = clearance(json!({ "law": "hertz", "restitution": 0.9 }), more);
        Words {
            clearance: &clearance,
            path: "joints.b.clearance",
        }
        .impact_parameters()
    };
    let coulomb = json!({ "law": "coulomb", "coefficient": 0.03, "threshold_velocity": 0.01 });
    let found = |restitution: f64, friction: f64, sense: Sense| {
        Ok(Rigid {
            restitution,
            friction,
            sense,
            latch: None,
        })
    };
    assert_eq!(parameters(json!({})), found(0.9, 0.0, Sense::Energetic));
    assert_eq!(
        parameters(json!({ "friction": coulomb })),
        found(0.9, 0.03, Sense::Energetic)
    );
    let impact = json!({ "restitution": 0.4, "friction": 0.2, "sense": "kinematic" });
    assert_eq!(
        parameters(json!({ "friction": coulomb, "impact": impact })),
        found(0.4, 0.2, Sense::Kinematic)
    );
    let impact = json!({ "sense": "kinetic" });
    assert_eq!(
        parameters(json!({ "friction": coulomb, "impact": impact })),
        found(0.9, 0.03, Sense::Kinetic)
    );
    assert!(parameters(json!({ "impact": { "restitution": 1.5 } })).is_err());
}

#[test]
fn friction_takes_its_words() {
    let law =
        friction(json!({ "law": "coulomb", "coefficient": 0.03, "threshold_velocity": 0.01 }));
    assert_eq!(
        law,
        Ok(friction::Law::Coulomb {
            coefficient: 0.03,
            threshold: 0.01
        })
    );
    let law = friction(
        json!({ "law": "lugre", "coefficient": 0.1, "static_coefficient": 0.15,
            "stribeck_velocity": 0.001, "bristle_stiffness": 1e5, "viscous": 0.4 }),
    );
    let decay = Decay {
        kinetic: 0.1,
        r#static: 0.15,
        velocity: 0.001,
        exponent: 2.0,
    };
    assert_eq!(
        law,
        Ok(friction::Law::Lugre {
            decay,
            stiffness: 1e5,
            damping: 0.0,
            viscous: 0.4
        })
    );
    let ambrosio = |lower: f64| {
        friction(
            json!({ "law": "ambrosio", "coefficient": 0.1, "lower_velocity": lower, "upper_velocity": 0.01 }),
        )
    };
    assert_eq!(
        ambrosio(0.001),
        Ok(friction::Law::Ambrosio {
            coefficient: 0.1,
            lower: 0.001,
            upper: 0.01
        })
    );
    assert!(ambrosio(0.01).is_err());
    assert!(friction(json!({ "law": "stribeck", "coefficient": 0.1 })).is_err());
    assert_eq!(friction(json!({ "law": "none" })), Ok(friction::Law::None));
}
