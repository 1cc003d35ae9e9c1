//! Beams: elastic bars between bodies.

use serde::{Deserialize, Serialize};

use crate::section::{LinkMaterial, SectionShape};

/// An elastic bar from the first point to the second, which holds no constraint and has no mass.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize)]
pub struct Beam {
    /// What it is made of and how thick it is.
    pub section: BeamSection,
    /// Its length where nothing loads it \[m\]; left out: the distance of the points as drawn.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub length: Option<f64>,
    /// Directions of its ends in the frames of both bodies \[rad\]; left out: it is straight as drawn.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub angles: Option<[f64; 2]>,
    /// Forces by rates, as a time by which the stiffness is multiplied \[s\].
    #[serde(default)]
    pub damping_time: f64,
}

/// The cross-section of a beam, the same all along.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize)]
pub struct BeamSection {
    /// The shape with its dimensions.
    #[serde(flatten)]
    pub shape: SectionShape,
    /// What it is made of.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub material: Option<LinkMaterial>,
    /// Young's modulus E \[Pa\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub young_modulus: Option<f64>,
    /// Poisson's ratio ν; left out: cross-sections stay perpendicular.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub poisson_ratio: Option<f64>,
}

impl BeamSection {
    /// Young's modulus \[Pa\], where it is known.
    pub fn stiffness(&self) -> Option<f64> {
        let typical = self.material.map(|material| material.typical()[0]);
        typical.or(self.young_modulus)
    }
}
