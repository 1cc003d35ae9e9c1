//! Cross-sections of bodies that are straight links.

use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// The cross-section of a body along the straight line between two of its points.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize)]
pub struct LinkSection {
    /// The point of the body where its axis begins.
    pub from: String,
    /// The point of the body where it ends.
    pub to: String,
    /// The shape with its dimensions.
    #[serde(flatten)]
    pub shape: SectionShape,
    /// What it is made of.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub material: Option<LinkMaterial>,
    /// Young's modulus E \[Pa\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub young_modulus: Option<f64>,
    /// Density [kg/m³].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub density: Option<f64>,
    /// Number of stations along the axis, both ends included; 5 where left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stations: Option<usize>,
}

/// A shape of cross-section with its dimensions \[m\].
#[derive(Debug, Clone, Copy, PartialEq, Deserialize, Serialize)]
#[serde(tag = "type", rename_all = "snake_case")]
pub enum SectionShape {
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
    /// A round tube.
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
        /// Section modulus \[m³\], which links need and beams have not.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        section_modulus: Option<f64>,
        /// Area that resists shear \[m²\], of beams; left out: the area.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        shear_area: Option<f64>,
    },
}

impl SectionShape {
    /// Area \[m²\].
    pub fn area(&self) -> f64 {
        match *self {
            SectionShape::Rectangle { width, height } => width * height,
            SectionShape::Circle { diameter } => PI / 4.0 * diameter * diameter,
            // by the mean diameter, so that a thin wall loses no digits
            SectionShape::Tube { diameter, wall } => PI * (diameter - wall) * wall,
            SectionShape::General { area, .. } => area,
        }
    }

    /// Second moment of area for bending in the plane \[m⁴\].
    pub fn second_moment(&self) -> f64 {
        match *self {
            SectionShape::Rectangle { width, height } => width * height.powi(3) / 12.0,
            SectionShape::Circle { diameter } => PI / 64.0 * diameter.powi(4),
            SectionShape::Tube { diameter, wall } => {
                let inner = diameter - 2.0 * wall;
                self.area() / 16.0 * (diameter * diameter + inner * inner)
            }
            SectionShape::General { second_moment, .. } => second_moment,
        }
    }

    /// The smallest second moment of area in any direction, as far as it is known \[m⁴\].
    pub fn least_second_moment(&self) -> f64 {
        match *self {
            SectionShape::Rectangle { width, height } => {
                width * height * width.min(height).powi(2) / 12.0
            }
            SectionShape::Circle { .. }
            | SectionShape::Tube { .. }
            | SectionShape::General { .. } => self.second_moment(),
        }
    }

    /// Area that resists shear \[m²\], of a material with this ratio of Poisson, and of a tube with a thin wall (Cowper, The shear coefficient
    /// in Timoshenko's beam theory, 1966).
    pub fn shear_area(&self, poisson_ratio: f64) -> f64 {
        let nu = poisson_ratio;
        let share = match *self {
            SectionShape::Rectangle { .. } => 10.0 * (1.0 + nu) / (12.0 + 11.0 * nu),
            SectionShape::Circle { .. } => 6.0 * (1.0 + nu) / (7.0 + 6.0 * nu),
            SectionShape::Tube { .. } => 2.0 * (1.0 + nu) / (4.0 + 3.0 * nu),
            SectionShape::General {
                area, shear_area, ..
            } => return shear_area.unwrap_or(area),
        };
        share * self.area()
    }

    /// Section modulus for bending in the plane \[m³\]; NaN where it is not given.
    pub fn modulus(&self) -> f64 {
        match *self {
            SectionShape::Rectangle { height, .. } => self.second_moment() / (height / 2.0),
            SectionShape::Circle { diameter } | SectionShape::Tube { diameter, .. } => {
                self.second_moment() / (diameter / 2.0)
            }
            SectionShape::General {
                section_modulus, ..
            } => section_modulus.unwrap_or(f64::NAN),
        }
    }
}

/// A material of links.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum LinkMaterial {
    /// Structural steel (EN 1993-1-1).
    Steel,
    /// Austenitic stainless steel (EN 10088-1, 1.4301).
    StainlessSteel,
    /// Aluminium alloys (EN 1999-1-1).
    Aluminium,
    /// Titanium Ti-6Al-4V (ASM).
    Titanium,
    /// Free-cutting brass CuZn39Pb3 (Deutsches Kupferinstitut).
    Brass,
    /// Grey cast iron EN-GJL-250 (EN 1561).
    CastIron,
    /// Polyoxymethylene, a copolymer (data sheets by ISO 527).
    Pom,
    /// Polyamide 6, dry (data sheets by ISO 527).
    Pa6,
}

impl LinkMaterial {
    /// Typical Young's modulus \[Pa\] and density [kg/m³].
    pub fn typical(self) -> [f64; 2] {
        match self {
            LinkMaterial::Steel => [210e9, 7850.0],
            LinkMaterial::StainlessSteel => [200e9, 7900.0],
            LinkMaterial::Aluminium => [70e9, 2700.0],
            LinkMaterial::Titanium => [114e9, 4430.0],
            LinkMaterial::Brass => [97e9, 8470.0],
            LinkMaterial::CastIron => [110e9, 7200.0],
            LinkMaterial::Pom => [2.8e9, 1410.0],
            LinkMaterial::Pa6 => [3.0e9, 1140.0],
        }
    }
}

impl LinkSection {
    /// Young's modulus \[Pa\], where it is known.
    pub fn stiffness(&self) -> Option<f64> {
        let typical = self.material.map(|material| material.typical()[0]);
        typical.or(self.young_modulus)
    }

    /// Density [kg/m³], where it is known.
    pub fn density(&self) -> Option<f64> {
        let typical = self.material.map(|material| material.typical()[1]);
        typical.or(self.density)
    }
}
