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
    pub shape: BeamShape,
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

/// A shape of a beam's cross-section with its dimensions \[m\].
#[derive(Debug, Clone, Copy, PartialEq, Deserialize, Serialize)]
#[serde(tag = "type", rename_all = "snake_case")]
pub enum BeamShape {
    /// A rectangle: `width` out of the plane, `height` in the plane.
    Rectangle {
        /// Out of the plane.
        width: f64,
        /// In the plane.
        height: f64,
    },
    /// A circle.
    Circle {
        /// Its diameter.
        diameter: f64,
    },
    /// A round tube with a thin wall.
    Tube {
        /// Outer diameter.
        diameter: f64,
        /// Thickness of its wall.
        wall: f64,
    },
    /// Any other, by its numbers for bending in the plane.
    General {
        /// Area \[m²\].
        area: f64,
        /// Second moment of area \[m⁴\].
        second_moment: f64,
        /// Area that resists shear \[m²\]; left out: the area.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        shear_area: Option<f64>,
    },
}

impl BeamShape {
    /// Area \[m²\] and second moment of area for bending in the plane \[m⁴\].
    pub fn moments(&self) -> [f64; 2] {
        let of = |shape: SectionShape| [shape.area(), shape.second_moment()];
        match *self {
            BeamShape::Rectangle { width, height } => of(SectionShape::Rectangle { width, height }),
            BeamShape::Circle { diameter } => of(SectionShape::Circle { diameter }),
            BeamShape::Tube { diameter, wall } => of(SectionShape::Tube { diameter, wall }),
            BeamShape::General {
                area,
                second_moment,
                ..
            } => [area, second_moment],
        }
    }

    /// Area that resists shear \[m²\], of a material with this ratio of Poisson (Cowper, The shear coefficient in Timoshenko's beam theory,
    /// 1966).
    pub fn shear_area(&self, poisson_ratio: f64) -> f64 {
        let nu = poisson_ratio;
        let share = match *self {
            BeamShape::Rectangle { .. } => 10.0 * (1.0 + nu) / (12.0 + 11.0 * nu),
            BeamShape::Circle { .. } => 6.0 * (1.0 + nu) / (7.0 + 6.0 * nu),
            BeamShape::Tube { .. } => 2.0 * (1.0 + nu) / (4.0 + 3.0 * nu),
            BeamShape::General {
                area, shear_area, ..
            } => return shear_area.unwrap_or(area),
        };
        share * self.moments()[0]
    }
}

impl BeamSection {
    /// Young's modulus \[Pa\], where it is known.
    pub fn stiffness(&self) -> Option<f64> {
        let typical = self.material.map(|material| material.typical()[0]);
        typical.or(self.young_modulus)
    }
}
