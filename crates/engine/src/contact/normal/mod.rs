//! Normal force of a contact.
//!
//! ```text
//! Hertz          F = K δⁿ
//! KelvinVoigt    F = K δ + D δ̇
//! Dissipative    F = K δⁿ (1 + χ δ̇/δ̇₀)
//! Logarithmic    F = F_e(δ) (1 + χ δ̇/δ̇₀),   δ = (F_e/κ) ln(Λ/F_e)         cylinder in cylinder
//! ```
//!
//! F is zero where δ ≤ 0, and where the formula would pull (a contact ends there); its derivatives are zero with it. χ comes
//! from the coefficient of restitution (`hysteresis`), K from materials and radii (`stiffness`), κ and Λ too (`cylinder`). Where a contact
//! begins without approach, δ̇₀ ≤ 0, nothing can be said of its loss and the force is elastic.
//!
//! With χ δ̇/δ̇₀ the force begins at zero and has a slope everywhere if n ≥ 1. Kelvin and Voigt's begins at D δ̇₀, a jump,
//! and at the end of a contact the force is zero while δ > 0 still: restitution follows from K, D and the mass.
//!
//! Sources: H. Hertz, *Über die Berührung fester elastischer Körper*, J. reine angew. Math. 92, 1881 (n = 3/2, spheres);
//! K. H. Hunt, F. R. E. Crossley, *Coefficient of restitution interpreted as damping in vibroimpact*, J. Appl. Mech. 42,
//! 1975 (the form of the loss); W. Goldsmith, *Impact*, 1960 (Kelvin and Voigt's body in impact).

pub mod cylinder;
pub mod hysteresis;
pub mod stiffness;

use super::Value;
use cylinder::Logarithmic;

/// A law F(δ, δ̇; δ̇₀), its parameters as numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Law {
    /// F = K δⁿ: `stiffness` K [N/mⁿ] above 0, `exponent` n at least 1.
    Hertz {
        /// K [N/mⁿ].
        stiffness: f64,
        /// n [–].
        exponent: f64,
    },
    /// F = K δ + D δ̇: `stiffness` K [N/m] above 0, `damping` D [N·s/m] at least 0.
    KelvinVoigt {
        /// K [N/m].
        stiffness: f64,
        /// D [N·s/m].
        damping: f64,
    },
    /// F = K δⁿ (1 + χ δ̇/δ̇₀): as with Hertz, `hysteresis` χ [–] at least 0.
    Dissipative {
        /// K [N/mⁿ].
        stiffness: f64,
        /// n [–].
        exponent: f64,
        /// χ [–].
        hysteresis: f64,
    },
    /// F = F_e(δ) (1 + χ δ̇/δ̇₀): parallel cylinders, one in the other.
    Cylindrical {
        /// F_e(δ).
        elastic: Logarithmic,
        /// χ [–].
        hysteresis: f64,
    },
}

/// Least depth at which slopes are taken \[m\]: some laws have none at zero.
const SHALLOWEST: f64 = 1e-100;

impl Law {
    /// F(δ, δ̇; δ̇₀) with its derivatives; `approach` δ̇₀ is the rate remembered from the start of the contact.
    pub fn force(&self, penetration: f64, rate: f64, approach: f64) -> Value {
        if penetration <= 0.0 {
            return Value::default();
        }
        let (elastic, slope) = self.elastic(penetration);
        let value = match *self {
            Law::Hertz { .. } => Value {
                force: elastic,
                d_penetration: slope,
                d_rate: 0.0,
            },
            Law::KelvinVoigt { damping, .. } => Value {
                force: elastic + damping * rate,
                d_penetration: slope,
                d_rate: damping,
            },
            Law::Dissipative { hysteresis, .. } | Law::Cylindrical { hysteresis, .. } => {
                let loss = if approach > 0.0 {
                    hysteresis / approach
                } else {
                    0.0
                };
                let factor = 1.0 + loss * rate;
                Value {
                    force: elastic * factor,
                    d_penetration: slope * factor,
                    d_rate: elastic * loss,
                }
            }
        };
        if value.force > 0.0 {
            value
        } else {
            Value::default()
        }
    }

    /// The formula as it stands also where it pulls, F_e odd in δ: smooth across the end of a contact, for whoever locates it.
    pub(crate) fn continued(&self, penetration: f64, rate: f64, approach: f64) -> f64 {
        let elastic = self.elastic_continued(penetration);
        match *self {
            Law::Hertz { .. } => elastic,
            Law::KelvinVoigt { damping, .. } => elastic + damping * rate,
            Law::Dissipative { hysteresis, .. } | Law::Cylindrical { hysteresis, .. } => {
                elastic * loss_factor(hysteresis, rate, approach)
            }
        }
    }

    /// Derivatives of [`Law::continued`] by δ and δ̇.
    pub(crate) fn continued_slopes(&self, penetration: f64, rate: f64, approach: f64) -> [f64; 2] {
        let (elastic, slope) = self.elastic(penetration.abs().max(SHALLOWEST));
        match *self {
            Law::Hertz { .. } => [slope, 0.0],
            Law::KelvinVoigt { damping, .. } => [slope, damping],
            Law::Dissipative { hysteresis, .. } | Law::Cylindrical { hysteresis, .. } => {
                let loss = if approach > 0.0 {
                    hysteresis / approach
                } else {
                    0.0
                };
                [
                    slope * loss_factor(hysteresis, rate, approach),
                    elastic.copysign(penetration) * loss,
                ]
            }
        }
    }

    /// The elastic part of [`Law::continued`].
    pub(crate) fn elastic_continued(&self, penetration: f64) -> f64 {
        if penetration == 0.0 {
            0.0
        } else {
            self.elastic(penetration.abs()).0.copysign(penetration)
        }
    }

    /// Above zero as long as the formula presses at δ > 0: K δ + D δ̇ \[N\], or 1 + χ δ̇/δ̇₀ [–].
    pub(crate) fn hold(&self, penetration: f64, rate: f64, approach: f64) -> f64 {
        match *self {
            Law::KelvinVoigt { stiffness, damping } if damping > 0.0 => {
                stiffness * penetration + damping * rate
            }
            Law::Hertz { .. } | Law::KelvinVoigt { .. } => 1.0,
            Law::Dissipative { hysteresis, .. } | Law::Cylindrical { hysteresis, .. } => {
                loss_factor(hysteresis, rate, approach)
            }
        }
    }

    /// The force without damping \[N\]; zero where δ ≤ 0.
    #[cfg(test)]
    fn elastic_force(&self, penetration: f64) -> f64 {
        if penetration > 0.0 {
            self.elastic(penetration).0
        } else {
            0.0
        }
    }

    /// Energy stored by the force without damping, ∫₀^δ F dδ \[J\]; zero where δ ≤ 0.
    pub fn elastic_energy(&self, penetration: f64) -> f64 {
        if penetration <= 0.0 {
            return 0.0;
        }
        match *self {
            Law::Hertz {
                stiffness,
                exponent,
            }
            | Law::Dissipative {
                stiffness,
                exponent,
                ..
            } => {
                let force = stiffness * penetration * power(penetration, exponent - 1.0);
                force * penetration / (exponent + 1.0)
            }
            Law::KelvinVoigt { stiffness, .. } => 0.5 * stiffness * penetration * penetration,
            Law::Cylindrical { elastic, .. } => elastic.energy(penetration),
        }
    }

    /// Penetration up to which the formula is used as published \[m\]; beyond it the force goes on as the law says there.
    pub(crate) fn range(&self) -> Option<f64> {
        match self {
            Law::Cylindrical { elastic, .. } => Some(elastic.range()),
            Law::Hertz { .. } | Law::KelvinVoigt { .. } | Law::Dissipative { .. } => None,
        }
    }

    /// Elastic force and its slope at δ > 0.
    fn elastic(&self, penetration: f64) -> (f64, f64) {
        match *self {
            Law::Hertz {
                stiffness,
                exponent,
            }
            | Law::Dissipative {
                stiffness,
                exponent,
                ..
            } => {
                let slope = stiffness * power(penetration, exponent - 1.0);
                (slope * penetration, slope * exponent)
            }
            Law::KelvinVoigt { stiffness, .. } => (stiffness * penetration, stiffness),
            Law::Cylindrical { elastic, .. } => elastic.force(penetration),
        }
    }
}

/// 1 + χ δ̇/δ̇₀; without an approach nothing can be said of the loss.
fn loss_factor(hysteresis: f64, rate: f64, approach: f64) -> f64 {
    if approach > 0.0 {
        1.0 + hysteresis / approach * rate
    } else {
        1.0
    }
}

/// xⁿ, for Hertz's exponent by the root, which is rounded alike everywhere.
fn power(x: f64, n: f64) -> f64 {
    if n == 0.5 { x.sqrt() } else { x.powf(n) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One of each, and of the powers that have an own branch.
    fn laws() -> Vec<Law> {
        let elastic = Logarithmic {
            modulus: 3e9,
            scale: 4e6,
        };
        vec![
            Law::Hertz {
                stiffness: 1e9,
                exponent: 1.5,
            },
            Law::Hertz {
                stiffness: 1e7,
                exponent: 1.0,
            },
            Law::KelvinVoigt {
                stiffness: 1e7,
                damping: 300.0,
            },
            Law::Dissipative {
                stiffness: 1e9,
                exponent: 1.5,
                hysteresis: 0.1425,
            },
            Law::Dissipative {
                stiffness: 3e8,
                exponent: 10.0 / 9.0,
                hysteresis: 1.2,
            },
            Law::Cylindrical {
                elastic,
                hysteresis: 0.0,
            },
            Law::Cylindrical {
                elastic,
                hysteresis: 0.7,
            },
        ]
    }

    #[test]
    fn derivatives_are_those_of_the_force() {
        let approach = 0.4;
        let mut compared = 0;
        for law in laws() {
            for penetration in [1e-9, 2e-7, 1e-5, 1e-4, 8e-4] {
                for rate in [-0.3, -0.01, 0.0, 0.2, 0.6] {
                    let value = law.force(penetration, rate, approach);
                    // Central differences of a smooth function: error h²/6·F‴, here below 1e-8 of the scale.
                    let by = 1e-5;
                    let force = |factor: f64, plus: f64| {
                        law.force(penetration * factor, rate + plus, approach).force
                    };
                    let ends = [
                        force(1.0 + by, 0.0),
                        force(1.0 - by, 0.0),
                        force(1.0, by),
                        force(1.0, -by),
                    ];
                    // Where the force is cut off next by there is no derivative.
                    if ends.contains(&0.0) {
                        continue;
                    }
                    let slope = (ends[0] - ends[1]) / (2.0 * by * penetration);
                    let damping = (ends[2] - ends[3]) / (2.0 * by);
                    let scale = value.force.max(law.elastic_force(penetration));
                    let said = format!(
                        "{law:?} δ {penetration:e} δ̇ {rate}: {value:?}, {slope:e}, {damping:e}"
                    );
                    assert!(
                        (slope - value.d_penetration).abs() <= 1e-8 * scale / penetration,
                        "{said}"
                    );
                    assert!(
                        (damping - value.d_rate).abs() <= 1e-8 * scale / approach,
                        "{said}"
                    );
                    compared += 1;
                }
            }
        }
        assert!(compared > 150, "{compared}");
    }

    #[test]
    fn the_energy_is_the_integral_of_the_elastic_force() {
        for law in laws() {
            for penetration in [1e-6, 3e-4, 9e-4] {
                let integral = quadrature(|at| law.elastic_force(at), penetration);
                let energy = law.elastic_energy(penetration);
                assert!(
                    (integral - energy).abs() <= 1e-9 * energy,
                    "{law:?} {penetration}: {integral:e} {energy:e}"
                );
            }
        }
    }

    /// ∫₀^end f by Simpson's rule in s, x = end·s⁴, which tames the start.
    fn quadrature(f: impl Fn(f64) -> f64, end: f64) -> f64 {
        const STEPS: usize = 2000;
        let sum: f64 = (0..=STEPS)
            .map(|k| {
                let s = k as f64 / STEPS as f64;
                let weight = if k == 0 || k == STEPS {
                    1.0
                } else {
                    2.0 + 2.0 * (k % 2) as f64
                };
                weight * f(end * s.powi(4)) * 4.0 * end * s.powi(3)
            })
            .sum();
        sum / (3.0 * STEPS as f64)
    }

    #[test]
    fn no_force_without_penetration_and_none_that_pulls() {
        for law in laws() {
            for (penetration, rate) in [(0.0, 1.0), (-1e-5, 1.0), (-0.0, -1.0), (1e-7, -1e3)] {
                let value = law.force(penetration, rate, 0.5);
                let elastic = matches!(law, Law::Hertz { .. })
                    || matches!(law, Law::Cylindrical { hysteresis, .. } if hysteresis == 0.0);
                if penetration <= 0.0 || !elastic {
                    assert_eq!(value, Value::default(), "{law:?} {penetration} {rate}");
                }
            }
            assert_eq!(
                (law.elastic_force(-1.0), law.elastic_energy(-1.0)),
                (0.0, 0.0)
            );
        }
    }

    #[test]
    fn a_contact_that_begins_without_approach_is_elastic() {
        let law = Law::Dissipative {
            stiffness: 1e9,
            exponent: 1.5,
            hysteresis: 0.5,
        };
        let value = law.force(1e-4, 0.3, 0.0);
        assert_eq!((value.force, value.d_rate), (law.elastic_force(1e-4), 0.0));
    }
}
