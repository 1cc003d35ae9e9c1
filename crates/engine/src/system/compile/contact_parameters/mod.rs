//! Words → numbers for the contact of a clearance joint: its laws with their parameters.
//!
//! The loader checks a file's words, and says what is wrong with them and where (`linkdyn_model::load`); a model that was made
//! otherwise is only refused here where a law could not be evaluated.

mod friction_law;

pub use friction_law::friction_law;

use crate::contact::friction;
use crate::contact::impact::Sense;
use crate::contact::normal::cylinder::{Logarithmic, Pair};
use crate::contact::normal::hysteresis::Rule;
use crate::contact::normal::{self, stiffness};
use crate::element::pair::Rigid;
use linkdyn_model::error::Complaint;
use linkdyn_model::{Clearance, Elastic, FrictionLaw, ImpactSense, Normal, NormalLaw};

/// Exponent n of a power law where none is given: Hertz's.
const EXPONENT: f64 = 1.5;

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
        let sense = impact.and_then(|impact| impact.sense);
        Ok(Rigid {
            restitution: self.need("impact.restitution", restitution, |e| {
                (0.0..=1.0).contains(&e)
            })?,
            friction: self.need("impact.friction", Some(friction), |friction| {
                friction >= 0.0
            })?,
            sense: sense.map_or(Sense::Energetic, compared),
            latch: None,
        })
    }
}

/// What the word says.
pub fn compared(sense: ImpactSense) -> Sense {
    match sense {
        ImpactSense::Energetic => Sense::Energetic,
        ImpactSense::Kinetic => Sense::Kinetic,
        ImpactSense::Kinematic => Sense::Kinematic,
    }
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
mod tests;
