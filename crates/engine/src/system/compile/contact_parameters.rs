//! Words → numbers for the contact of a clearance joint: its laws with their parameters.
//!
//! The loader checks a file's words, and says what is wrong with them and where (`linkdyn_model::load`); a model that was made
//! otherwise is only refused here where a law could not be evaluated.

use crate::contact::friction::{self, Decay};
use crate::contact::impact::Sense;
use crate::contact::normal::cylinder::{Logarithmic, Pair};
use crate::contact::normal::hysteresis::Rule;
use crate::contact::normal::{self, stiffness};
use crate::element::journal::Rigid;
use linkdyn_model::error::Complaint;
use linkdyn_model::{Clearance, Elastic, Friction, FrictionLaw, ImpactSense, Normal, NormalLaw};

/// Exponent n of a power law where none is given: Hertz's.
const EXPONENT: f64 = 1.5;

/// Sliding velocity up to which the friction of a journal that follows its bearing grows from zero where the file gives no
/// `friction.threshold_velocity` [m/s].
const THRESHOLD: f64 = 1e-3;

/// Words of a clearance, with their path for complaints.
#[derive(Debug, Clone, Copy)]
pub struct Words<'a> {
    pub clearance: &'a Clearance,
    /// `joints.b.clearance`.
    pub path: &'a str,
}

impl Words<'_> {
    fn need(
        &self,
        key: &str,
        value: Option<f64>,
        range: impl Fn(f64) -> bool,
    ) -> Result<f64, Complaint> {
        need(self.path, key, value, range)
    }

    /// Law of the normal force of `contact`.
    ///
    /// # Errors
    /// Where a parameter is missing or out of the law's range.
    pub fn normal_law(&self) -> Result<normal::Law, Complaint> {
        let Some(words) = &self.clearance.normal else {
            return Err(Complaint::new(
                format!("{}.normal", self.path),
                "is missing, a contact needs it",
            ));
        };
        let rule = match words.law {
            NormalLaw::Hertz => return self.power(words, None),
            NormalLaw::KelvinVoigt => {
                let damping =
                    self.need("normal.damping", words.damping, |damping| damping >= 0.0)?;
                return Ok(normal::Law::KelvinVoigt {
                    stiffness: self.stiffness(words)?,
                    damping,
                });
            }
            NormalLaw::Johnson => return self.cylindrical(words, Pair::johnson),
            NormalLaw::Radzimovsky => return self.cylindrical(words, Pair::radzimovsky),
            NormalLaw::DubowskyFreudenstein => {
                return self.cylindrical(words, Pair::dubowsky_freudenstein);
            }
            NormalLaw::Pereira => {
                let fit = self.pair(words)?.pereira();
                let (stiffness, exponent) = fit.ok_or_else(|| {
                    let path = format!("{}.radius", self.path);
                    Complaint::new(
                        path,
                        "is outside the clearances that Pereira's law was fitted to",
                    )
                })?;
                let hysteresis = self.cylindrical_hysteresis(words)?;
                return Ok(normal::Law::Dissipative {
                    stiffness,
                    exponent,
                    hysteresis,
                });
            }
            NormalLaw::HuntCrossley => Rule::HuntCrossley,
            NormalLaw::HerbertMcwhannell => Rule::HerbertMcwhannell,
            NormalLaw::LeeWang => Rule::LeeWang,
            NormalLaw::LankaraniNikravesh => Rule::LankaraniNikravesh,
            NormalLaw::Flores => Rule::Flores,
            NormalLaw::Gonthier => Rule::Gonthier,
            NormalLaw::ZhiyingQishao => Rule::ZhiyingQishao,
            NormalLaw::HuGuo => Rule::HuGuo,
        };
        let least = |e: f64| (0.0..=1.0).contains(&e) && (e > 0.0 || !rule.needs_rebound());
        let restitution = self.need("normal.restitution", words.restitution, least)?;
        self.power(words, Some(rule.factor(restitution)))
    }

    /// F = K δⁿ, with a hysteresis factor K δⁿ (1 + χ δ̇/δ̇₀).
    fn power(&self, words: &Normal, hysteresis: Option<f64>) -> Result<normal::Law, Complaint> {
        let stiffness = self.stiffness(words)?;
        let exponent = words.exponent.unwrap_or(EXPONENT);
        let exponent = self.need("normal.exponent", Some(exponent), |exponent| {
            exponent >= 1.0
        })?;
        Ok(match hysteresis {
            None => normal::Law::Hertz {
                stiffness,
                exponent,
            },
            Some(hysteresis) => normal::Law::Dissipative {
                stiffness,
                exponent,
                hysteresis,
            },
        })
    }

    /// K as given, else that of a sphere in a cup.
    fn stiffness(&self, words: &Normal) -> Result<f64, Complaint> {
        match (words.stiffness, &words.elastic) {
            (None, Some(elastic)) => {
                let (bearing, clearance) = self.radii()?;
                Ok(stiffness::sphere_in_cup(
                    flexibility(elastic),
                    bearing,
                    bearing - clearance,
                ))
            }
            (stiffness, _) => self.need("normal.stiffness", stiffness, |stiffness| stiffness > 0.0),
        }
    }

    /// R_b and ΔR, with 0 < ΔR < R_b.
    fn radii(&self) -> Result<(f64, f64), Complaint> {
        let clearance = self.need("radius", self.clearance.radius, |radius| radius > 0.0)?;
        let bearing = self.need("bearing_radius", self.clearance.bearing_radius, |bearing| {
            bearing > clearance
        })?;
        Ok((bearing, clearance))
    }

    /// Journal and bearing as cylinders.
    fn pair(&self, words: &Normal) -> Result<Pair, Complaint> {
        let (bearing_radius, clearance) = self.radii()?;
        let length = self.need("axial_length", self.clearance.axial_length, |length| {
            length > 0.0
        })?;
        let Some(elastic) = &words.elastic else {
            return Err(Complaint::new(
                format!("{}.normal.elastic", self.path),
                "is missing, the law needs it",
            ));
        };
        Ok(Pair {
            bearing_radius,
            clearance,
            length,
            flexibility: flexibility(elastic),
        })
    }

    fn cylindrical(
        &self,
        words: &Normal,
        law: fn(&Pair) -> Logarithmic,
    ) -> Result<normal::Law, Complaint> {
        let elastic = law(&self.pair(words)?);
        Ok(normal::Law::Cylindrical {
            elastic,
            hysteresis: self.cylindrical_hysteresis(words)?,
        })
    }

    /// Lankarani's and Nikravesh's χ, which Pereira's law has as published; none without a restitution.
    fn cylindrical_hysteresis(&self, words: &Normal) -> Result<f64, Complaint> {
        let restitution = words.restitution.unwrap_or(1.0);
        let restitution = self.need("normal.restitution", Some(restitution), |e| {
            (0.0..=1.0).contains(&e)
        })?;
        Ok(Rule::LankaraniNikravesh.factor(restitution))
    }

    /// Law of the surface of `two_state`: Kelvin's and Voigt's body.
    ///
    /// # Errors
    /// Where a parameter is missing or out of its range.
    pub fn surface_law(&self) -> Result<normal::Law, Complaint> {
        let surface = self.clearance.surface.as_ref();
        let stiffness = self.need(
            "surface.stiffness",
            surface.map(|surface| surface.stiffness),
            |k| k > 0.0,
        )?;
        let damping = self.need(
            "surface.damping",
            surface.map(|surface| surface.damping),
            |d| d >= 0.0,
        )?;
        Ok(normal::Law::KelvinVoigt { stiffness, damping })
    }

    /// Law of the friction of `contact` and `two_state`.
    ///
    /// # Errors
    /// Where a parameter is missing or out of the law's range.
    pub fn friction_law(&self) -> Result<friction::Law, Complaint> {
        self.clearance
            .friction
            .as_ref()
            .map_or(Ok(friction::Law::None), |words| {
                friction_law(words, self.path)
            })
    }

    /// Impact of `three_state`; what `impact` leaves out is that of the continuous contact.
    ///
    /// # Errors
    /// Where the restitution is missing, or a parameter out of its range.
    pub fn impact_parameters(&self) -> Result<Rigid, Complaint> {
        let Clearance {
            impact,
            normal,
            friction,
            ..
        } = self.clearance;
        let impact = impact.as_ref();
        let restitution = impact.and_then(|impact| impact.restitution);
        let restitution = restitution.or(normal.as_ref().and_then(|normal| normal.restitution));
        let of_contact = friction
            .as_ref()
            .filter(|friction| friction.law != FrictionLaw::None);
        let friction = impact.and_then(|impact| impact.friction);
        let friction = friction
            .or(of_contact.and_then(|friction| friction.coefficient))
            .unwrap_or(0.0);
        let sense = match impact.and_then(|impact| impact.sense) {
            None | Some(ImpactSense::Energetic) => Sense::Energetic,
            Some(ImpactSense::Kinetic) => Sense::Kinetic,
            Some(ImpactSense::Kinematic) => Sense::Kinematic,
        };
        let threshold = self
            .clearance
            .friction
            .as_ref()
            .and_then(|friction| friction.threshold_velocity);
        Ok(Rigid {
            restitution: self.need("impact.restitution", restitution, |e| {
                (0.0..=1.0).contains(&e)
            })?,
            friction: self.need("impact.friction", Some(friction), |friction| {
                friction >= 0.0
            })?,
            sense,
            threshold: threshold.unwrap_or(THRESHOLD),
        })
    }
}

/// Law of a friction, with the path of what has it: `joints.b.clearance`, or `joints.b` where the joint is ideal.
///
/// # Errors
/// Where a parameter is missing or out of the law's range.
pub fn friction_law(words: &Friction, path: &str) -> Result<friction::Law, Complaint> {
    let not_negative = |value: f64| value >= 0.0;
    let coefficient = || {
        need(
            path,
            "friction.coefficient",
            words.coefficient,
            not_negative,
        )
    };
    let threshold = || {
        need(
            path,
            "friction.threshold_velocity",
            words.threshold_velocity,
            |v| v > 0.0,
        )
    };
    let viscous = || {
        need(
            path,
            "friction.viscous",
            Some(words.viscous.unwrap_or(0.0)),
            not_negative,
        )
    };
    Ok(match words.law {
        FrictionLaw::None => friction::Law::None,
        FrictionLaw::Coulomb => friction::Law::Coulomb {
            coefficient: coefficient()?,
            threshold: threshold()?,
        },
        FrictionLaw::Threlfall => friction::Law::Threlfall {
            coefficient: coefficient()?,
            threshold: threshold()?,
        },
        FrictionLaw::Ambrosio => {
            let lower = need(
                path,
                "friction.lower_velocity",
                words.lower_velocity,
                not_negative,
            )?;
            let upper = need(
                path,
                "friction.upper_velocity",
                words.upper_velocity,
                |upper| upper > lower,
            )?;
            friction::Law::Ambrosio {
                coefficient: coefficient()?,
                lower,
                upper,
            }
        }
        FrictionLaw::Stribeck => {
            let (decay, viscous) = (decay(words, path)?, viscous()?);
            friction::Law::Stribeck {
                decay,
                threshold: threshold()?,
                viscous,
            }
        }
        FrictionLaw::Lugre => {
            let decay = decay(words, path)?;
            let stiffness = need(
                path,
                "friction.bristle_stiffness",
                words.bristle_stiffness,
                |s| s > 0.0,
            )?;
            let damping = words.bristle_damping.unwrap_or(0.0);
            let damping = need(
                path,
                "friction.bristle_damping",
                Some(damping),
                not_negative,
            )?;
            friction::Law::Lugre {
                decay,
                stiffness,
                damping,
                viscous: viscous()?,
            }
        }
    })
}

fn decay(words: &Friction, path: &str) -> Result<Decay, Complaint> {
    let not_negative = |value: f64| value >= 0.0;
    let exponent = words.stribeck_exponent.unwrap_or(2.0);
    Ok(Decay {
        kinetic: need(
            path,
            "friction.coefficient",
            words.coefficient,
            not_negative,
        )?,
        r#static: need(
            path,
            "friction.static_coefficient",
            words.static_coefficient,
            not_negative,
        )?,
        velocity: need(
            path,
            "friction.stribeck_velocity",
            words.stribeck_velocity,
            |v| v > 0.0,
        )?,
        exponent: need(
            path,
            "friction.stribeck_exponent",
            Some(exponent),
            |exponent| exponent > 0.0,
        )?,
    })
}

/// A value that a law can't do without, and that must be in a range.
pub fn need(
    owner: &str,
    key: &str,
    value: Option<f64>,
    range: impl Fn(f64) -> bool,
) -> Result<f64, Complaint> {
    let path = format!("{owner}.{key}");
    match value {
        Some(value) if range(value) => Ok(value),
        Some(value) => {
            Err(Complaint::new(path, "is out of the law's range").found(value.to_string()))
        }
        None => Err(Complaint::new(path, "is missing, the law needs it")),
    }
}

/// h_b + h_j [1/Pa].
fn flexibility(elastic: &Elastic) -> f64 {
    let (bearing, journal) = match elastic {
        Elastic::Separate { bearing, journal } => (bearing, journal),
        Elastic::Same(material) => (material, material),
    };
    [bearing, journal]
        .iter()
        .map(|of| stiffness::flexibility(of.young_modulus, of.poisson_ratio))
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::{Value, json};

    fn clearance(normal: Value, more: Value) -> Clearance {
        let mut words = json!({ "model": "contact", "radius": 0.0005, "bearing_radius": 0.01, "normal": normal });
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
        let found = |restitution: f64, friction: f64, sense: Sense, threshold: f64| {
            Ok(Rigid {
                restitution,
                friction,
                sense,
                threshold,
            })
        };
        assert_eq!(
            parameters(json!({})),
            found(0.9, 0.0, Sense::Energetic, THRESHOLD)
        );
        assert_eq!(
            parameters(json!({ "friction": coulomb })),
            found(0.9, 0.03, Sense::Energetic, 0.01)
        );
        let impact = json!({ "restitution": 0.4, "friction": 0.2, "sense": "kinematic" });
        assert_eq!(
            parameters(json!({ "friction": coulomb, "impact": impact })),
            found(0.4, 0.2, Sense::Kinematic, 0.01)
        );
        let impact = json!({ "sense": "kinetic" });
        assert_eq!(
            parameters(json!({ "friction": coulomb, "impact": impact })),
            found(0.9, 0.03, Sense::Kinetic, 0.01)
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
}
