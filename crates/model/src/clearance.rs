//! Clearance of a revolute joint: which model, and the parameters of all of them.
//!
//! Parameters that the chosen model does not use are kept, so that one word switches the model.

mod words;

use serde::{Deserialize, Serialize};

use super::fit::Fit;

/// The rung of the ladder.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ClearanceModel {
    /// As if there were no clearance.
    #[default]
    Ideal,
    /// The journal always touches the bearing, at the end of a massless link (Earles and Wu 1972).
    MasslessLink,
    /// Free flight, or contact with a linear surface of stiffness and damping (Dubowsky and Freudenstein 1971).
    TwoState,
    /// Free flight, impact, or sliding contact (Miedema and Mansour 1976).
    ThreeState,
    /// Continuous contact force from a law of penetration.
    Contact,
}

/// Clearance of a revolute joint; parameters of models other than the one in use are kept as written.
#[derive(Debug, Clone, PartialEq, Default, Deserialize, Serialize)]
#[serde(from = "words::ClearanceWords", into = "words::ClearanceWords")]
pub struct Clearance {
    /// How it is modelled.
    pub model: ClearanceModel,
    /// Radial clearance: bearing radius − journal radius \[m\], the mean of its range; needed by every model but `ideal`.
    pub radius: Option<f64>,
    /// Least and greatest radial clearance \[m\], where the file says them or a fit; see [`Clearance::limits`].
    pub range: Option<[f64; 2]>,
    /// The fit by ISO 286 from which the range follows, as in `20 H7/g6`.
    pub fit: Option<String>,
    /// Radius of the bearing R_b \[m\]; with `elastic` it gives the stiffness.
    pub bearing_radius: Option<f64>,
    /// Axial length of the contact \[m\], of the cylindrical laws `johnson`, `radzimovsky`, `dubowsky_freudenstein` and `pereira`.
    pub axial_length: Option<f64>,
    /// Normal force of `contact`.
    pub normal: Option<Normal>,
    /// Friction of `contact` and `two_state`; left out: none.
    pub friction: Option<Friction>,
    /// Linear surface of `two_state`.
    pub surface: Option<Surface>,
    /// Impact of `three_state`; what it leaves out: `normal.restitution` and `friction.coefficient`.
    pub impact: Option<Impact>,
}

impl Clearance {
    /// Least and greatest radial clearance \[m\]; the radius alone where it was changed since the range was given.
    pub fn limits(&self) -> Option<[f64; 2]> {
        let radius = self.radius?;
        let range = self.range.filter(|range| words::mean(*range) == radius);
        Some(range.unwrap_or([radius, radius]))
    }

    /// The limits of the fit, as read; `None` if there is no fit or it can't be read.
    pub fn read_fit(&self) -> Option<Fit> {
        Fit::parse(self.fit.as_deref()?).ok()
    }
}

/// Law of the normal force, F(penetration δ, its rate δ̇) ≥ 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum NormalLaw {
    /// F = K δⁿ (Hertz 1881).
    Hertz,
    /// F = K δ + D δ̇ (Kelvin and Voigt).
    KelvinVoigt,
    /// χ = 3(1 − c)/2 · K/δ̇₀ (Hunt and Crossley 1975).
    HuntCrossley,
    /// χ = 6(1 − c)/((2c − 1)² + 3) · K/δ̇₀ (Herbert and McWhannell 1977).
    HerbertMcwhannell,
    /// χ = 3(1 − c)/4 · K/δ̇₀ (Lee and Wang 1983).
    LeeWang,
    /// χ = 3(1 − c²)/4 · K/δ̇₀ (Lankarani and Nikravesh 1990).
    LankaraniNikravesh,
    /// χ = 8(1 − c)/(5c) · K/δ̇₀ (Flores et al. 2011).
    Flores,
    /// χ = d/c · K/δ̇₀, (1 + d/c)/(1 − d) = exp(d(1 + 1/c)) (Gonthier et al. 2004).
    Gonthier,
    /// χ = 3(1 − c²)exp(2(1 − c))/4 · K/δ̇₀ (Zhiying and Qishao 2006).
    ZhiyingQishao,
    /// χ = 3(1 − c)/(2c) · K/δ̇₀ (Hu and Guo 2015).
    HuGuo,
    /// Cylinder in cylinder, δ(F) logarithmic (Johnson 1985).
    Johnson,
    /// Cylinder in cylinder, δ(F) logarithmic (Radzimovsky 1953).
    Radzimovsky,
    /// Cylinder in cylinder, δ(F) logarithmic (Dubowsky and Freudenstein 1971).
    DubowskyFreudenstein,
    /// Cylinder in cylinder, explicit fit (Pereira et al. 2015).
    Pereira,
}

/// Normal force of a contact; where a law dissipates by a hysteresis factor χ, F = K δⁿ + χ δⁿ δ̇.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize)]
pub struct Normal {
    /// The law.
    pub law: NormalLaw,
    /// Stiffness K [N/m^exponent], a plain SI number, for `kelvin_voigt` also text with a unit; left out, it follows from `elastic`. Not used by the cylindrical laws.
    pub stiffness: Option<f64>,
    /// Exponent n of Kδⁿ [–], at least 1, default 3/2 (Hertz); `kelvin_voigt` has 1, the cylindrical laws their own.
    pub exponent: Option<f64>,
    /// Coefficient of restitution c [–], 0 to 1, above 0 for `flores`, `gonthier` and `hu_guo`; without it the cylindrical laws are elastic.
    pub restitution: Option<f64>,
    /// Damping D of `kelvin_voigt` [N·s/m].
    pub damping: Option<f64>,
    /// Elastic constants that give K = 4/(3(h_b + h_j))·√(R_b R_j/(R_b − R_j)), h = (1 − ν²)/E (Goldsmith 1960).
    pub elastic: Option<Elastic>,
}

/// Materials of bearing and journal.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize, Serialize)]
#[serde(untagged)]
pub enum Elastic {
    /// Each its own.
    Separate {
        /// Of the bearing.
        bearing: Material,
        /// Of the journal.
        journal: Material,
    },
    /// One for both.
    Same(Material),
}

/// An elastic material.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize, Serialize)]
pub struct Material {
    /// Young's modulus E \[Pa\].
    pub young_modulus: f64,
    /// Poisson's ratio ν [–].
    pub poisson_ratio: f64,
}

/// Law of the friction force, against the sliding velocity v.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum FrictionLaw {
    /// No friction.
    None,
    /// μ F_n, linear up to `threshold_velocity` (Coulomb 1785).
    Coulomb,
    /// μ F_n, none below `lower_velocity`, linear up to `upper_velocity` (Ambrósio 2003).
    Ambrosio,
    /// μ F_n (1 − exp(−3v/`threshold_velocity`)) up to it, 0.95 μ F_n from there (Threlfall 1978).
    Threlfall,
    /// From static to kinetic as exp(−(v/`stribeck_velocity`)^`stribeck_exponent`) (Stribeck 1902; Bo and Pavelescu 1982).
    Stribeck,
    /// Bristles with a state (Canudas de Wit et al. 1995).
    Lugre,
}

/// Friction of a contact.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize)]
pub struct Friction {
    /// The law.
    pub law: FrictionLaw,
    /// (Kinetic) coefficient μ [–].
    pub coefficient: Option<f64>,
    /// Static coefficient μ_s [–], of `stribeck` and `lugre`.
    pub static_coefficient: Option<f64>,
    /// Velocity up to which the force grows from zero [m/s], of `coulomb`, `threlfall` and `stribeck`.
    pub threshold_velocity: Option<f64>,
    /// Velocity v₀ of `ambrosio` [m/s].
    pub lower_velocity: Option<f64>,
    /// Velocity v₁ of `ambrosio` [m/s].
    pub upper_velocity: Option<f64>,
    /// Velocity v_s of `stribeck` and `lugre` [m/s].
    pub stribeck_velocity: Option<f64>,
    /// Exponent of `stribeck` and `lugre` [–], default 2.
    pub stribeck_exponent: Option<f64>,
    /// Viscous part of `stribeck` and `lugre`, σ₂ [s/m] (of the normal force), a plain SI number.
    pub viscous: Option<f64>,
    /// Stiffness of the bristles of `lugre`, σ₀ [1/m] (of the normal force), a plain SI number.
    pub bristle_stiffness: Option<f64>,
    /// Damping of the bristles of `lugre`, σ₁ [s/m] (of the normal force), a plain SI number.
    pub bristle_damping: Option<f64>,
}

/// Linear surface of the two-state model (Dubowsky and Freudenstein 1971).
#[derive(Debug, Clone, Copy, PartialEq, Deserialize, Serialize)]
pub struct Surface {
    /// Stiffness [N/m].
    pub stiffness: f64,
    /// Damping [N·s/m].
    #[serde(default)]
    pub damping: f64,
}

/// Impact of the three-state model (Miedema and Mansour 1976).
#[derive(Debug, Clone, Copy, PartialEq, Deserialize, Serialize)]
pub struct Impact {
    /// Coefficient of restitution [–], 0 to 1.
    pub restitution: Option<f64>,
    /// Coefficient of friction [–].
    pub friction: Option<f64>,
    /// What the coefficient of restitution compares, default `energetic`.
    pub sense: Option<ImpactSense>,
}

/// What a coefficient of restitution compares; the three agree where sliding keeps its direction.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ImpactSense {
    /// Works of the normal force (Stronge 1990): never gains energy.
    Energetic,
    /// Normal impulses (Poisson 1817).
    Kinetic,
    /// Normal velocities (Newton 1687).
    Kinematic,
}
