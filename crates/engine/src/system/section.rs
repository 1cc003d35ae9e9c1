//! Cross-sections of straight links as numbers.

use linkdyn_linear::math::Vec2;

/// A straight link with a cross-section.
#[derive(Debug, Clone)]
pub struct SectionData {
    /// Where its axis begins, from the centre of mass, body frame \[m\].
    pub(crate) from: Vec2,
    /// Direction of the axis in the body's frame, length one.
    pub(crate) axis: Vec2,
    /// Length of the axis \[m\].
    pub length: f64,
    /// Area \[m²\].
    pub(crate) area: f64,
    /// Section modulus \[m³\].
    pub(crate) modulus: f64,
    /// Mass of the bar by its length [kg/m].
    pub(crate) bar: f64,
    /// Load under which it buckles \[N\], where that is known.
    pub buckling_load: Option<f64>,
    /// Number of stations along the axis.
    pub stations: usize,
}
