//! Elastic links: straight bars that bend, and bodies by their modal data.

use indexmap::IndexMap;
use serde::{Deserialize, Serialize};

use crate::Model;
use crate::section::{LinkMaterial, SectionShape};
use crate::tree::Tree;

/// How a body bends along the straight line between two of its points.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize)]
pub struct ElasticLink {
    /// The point of the body where its axis begins.
    pub from: String,
    /// The point of the body where it ends.
    pub to: String,
    /// Its cross-section.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub section: Option<SectionShape>,
    /// What it is made of.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub material: Option<LinkMaterial>,
    /// Young's modulus E \[Pa\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub young_modulus: Option<f64>,
    /// Density [kg/m³].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub density: Option<f64>,
    /// EI [N·m²].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bending_stiffness: Option<f64>,
    /// EA \[N\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub axial_stiffness: Option<f64>,
    /// ρA [kg/m].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mass_per_length: Option<f64>,
    /// Matrices instead of a bar.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub modal: Option<Box<ModalData>>,
    /// Number of bending modes with its joints held; 2 where left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub modes: Option<usize>,
    /// Number of elements, instead of modes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub elements: Option<usize>,
    /// Where the frame of its deflections is; `chord` where left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub frame: Option<ElasticFrame>,
    /// Whether it also stretches.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub axial: Option<bool>,
    /// Cracks across it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cracks: Option<Vec<Crack>>,
    /// Whether its ends come closer where it bends; left out: they do.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub foreshortening: Option<bool>,
    /// Damping ratio of each mode [–].
    #[serde(default)]
    pub damping: f64,
    /// Amplitudes at the start \[m\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub amplitudes: Option<Vec<f64>>,
    /// Rates of the amplitudes at the start [m/s].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rates: Option<Vec<f64>>,
}

/// A crack from one edge of a bar, open.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize, Serialize)]
pub struct Crack {
    /// Its place from the beginning of the axis \[m\].
    pub at: f64,
    /// Its depth by the height of the cross-section [–].
    pub depth: f64,
}

impl Crack {
    /// Stiffness of the hinge that it is in a rectangle \[N·m/rad\].
    ///
    /// ```text
    /// 1/k = 72 π/(E b h²) ∫₀^s ξ F(ξ)² dξ      F = 1.122 − 1.40 s + 7.33 s² − 13.08 s³ + 14.0 s⁴
    /// ```
    ///
    /// by the energy release rate K²/E of plane stress, K = 6 M F √(π a)/(b h²) (Tada, Paris and Irwin, The Stress Analysis of Cracks Handbook,
    /// 1973, sec. 2.13: pure bending, 0.2 % up to s = 0.6; the spring after Dimarogonas and Paipetis, Analytical Methods in Rotor
    /// Dynamics, 1983).
    pub fn stiffness(&self, young: f64, [width, height]: [f64; 2]) -> f64 {
        const FORM: [f64; 5] = [1.122, -1.40, 7.33, -13.08, 14.0];
        let power = |n: usize| self.depth.powi(n as i32 + 2) / (n as f64 + 2.0);
        let terms = (0..FORM.len()).flat_map(|i| (0..FORM.len()).map(move |j| (i, j)));
        let integral: f64 = terms.map(|(i, j)| FORM[i] * FORM[j] * power(i + j)).sum();
        young * width * height * height / (72.0 * std::f64::consts::PI * integral)
    }
}

/// The frame in which a link is deflected.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ElasticFrame {
    /// Its axis goes through both ends.
    Chord,
    /// Its axis is tangent to the link where it begins.
    Tangent,
}

/// A body that deflects by u = Σ Φ_i q_i: its matrices and inertia integrals.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize)]
pub struct ModalData {
    /// ∫ρ Φ_i·Φ_j.
    pub mass: Vec<Vec<f64>>,
    /// Stiffness matrix.
    pub stiffness: Vec<Vec<f64>>,
    /// Damping matrix.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub damping: Option<Vec<Vec<f64>>>,
    /// ∫ρ Φ_i.
    pub momentum: Vec<[f64; 2]>,
    /// ∫ρ X·Φ_i.
    pub radial: Vec<f64>,
    /// ∫ρ X × Φ_i.
    pub angular_momentum: Vec<f64>,
    /// ∫ρ Φ_i × Φ_j.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub gyroscopic: Option<Vec<Vec<f64>>>,
    /// How points of the body move.
    #[serde(default)]
    pub points: IndexMap<String, ModalPoint>,
}

/// Displacements of a point by the amplitudes.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize)]
pub struct ModalPoint {
    /// Φ_i there [–].
    pub displacement: Vec<[f64; 2]>,
    /// How it turns by each amplitude [rad/m].
    pub rotation: Vec<f64>,
}

/// The numbers of a bar.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ElasticBar {
    /// EI [N·m²].
    pub bending: f64,
    /// EA \[N\], where it is known.
    pub axial: Option<f64>,
    /// ρA [kg/m].
    pub mass: f64,
    /// ρI \[kg·m\].
    pub rotary: f64,
}

impl ElasticLink {
    /// Young's modulus \[Pa\], where it is known.
    pub fn young(&self) -> Option<f64> {
        let typical = self.material.map(|material| material.typical()[0]);
        typical.or(self.young_modulus)
    }

    /// The bar that is described, where it is whole.
    pub fn bar(&self) -> Option<ElasticBar> {
        if let Some(bending) = self.bending_stiffness {
            let (axial, mass) = (self.axial_stiffness, self.mass_per_length?);
            let rotary = axial.filter(|axial| *axial > 0.0);
            let rotary = rotary.map_or(0.0, |axial| mass * bending / axial);
            return Some(ElasticBar {
                bending,
                axial,
                mass,
                rotary,
            });
        }
        let typical = self.material.map(LinkMaterial::typical);
        let young = self.young()?;
        let density = typical.map(|[_, density]| density).or(self.density)?;
        let shape = self.section?;
        Some(ElasticBar {
            bending: young * shape.second_moment(),
            axial: Some(young * shape.area()),
            mass: density * shape.area(),
            rotary: density * shape.second_moment(),
        })
    }
}

impl Model {
    /// Whether a force of the model names a point.
    pub fn forces_name(&self, body: &str, point: &str) -> bool {
        fn names(tree: &Tree, text: &str) -> bool {
            match tree {
                Tree::Text(own) => own == text,
                Tree::List(items) => items.iter().any(|item| names(item, text)),
                Tree::Map(members) => members.values().any(|item| names(item, text)),
                Tree::Null | Tree::Number(_) | Tree::Count(_) | Tree::Flag(_) => false,
            }
        }
        names(&Tree::of(&self.forces), &format!("{body}.{point}"))
    }
}
