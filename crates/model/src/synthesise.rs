//! Synthesis: the motion for which linkages are wanted.

use serde::{Deserialize, Serialize};

/// What is wanted; one of `path`, `positions`, `function` is there.
#[derive(Debug, Clone, PartialEq, Default, Deserialize, Serialize)]
#[serde(default)]
pub struct Synthesise {
    /// Points that a point passes \[m\].
    pub path: Option<Vec<[f64; 2]>>,
    /// Positions that a body passes.
    pub positions: Option<Vec<WantedPosition>>,
    /// Angles of crank and output \[rad\].
    pub function: Option<Vec<[f64; 2]>>,
    /// The crank's angle at each point or position \[rad\].
    pub crank: Option<Vec<f64>>,
    /// Whether the angles of `function` are directions.
    pub directions: bool,
    /// Which linkages are tried.
    pub linkages: Vec<LinkageKind>,
    /// All linkages of so many bodies are tried.
    pub bodies: Option<u64>,
    /// Where the fixed pivots are.
    pub pivots: Option<Region>,
    /// Distance of the fixed pivots of crank and output \[m\].
    pub base: Option<f64>,
    /// Least and greatest distance of two pins of a moving body \[m\].
    pub lengths: Option<[f64; 2]>,
    /// Least angle of transmission \[rad\].
    pub transmission: Option<f64>,
    /// What acts on the output.
    pub load: Option<WantedLoad>,
    /// How many linkages are kept.
    pub most: Option<u64>,
    /// How many starts a search has.
    pub starts: Option<u64>,
    /// Seed of the starts.
    pub seed: Option<u64>,
}

/// A position of a body.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize, Serialize)]
pub struct WantedPosition {
    /// Where its point is \[m\].
    pub point: [f64; 2],
    /// Its angle \[rad\]; left out: any.
    pub angle: Option<f64>,
}

/// A rectangle.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize, Serialize)]
pub struct Region {
    /// Least and greatest x \[m\].
    pub x: [f64; 2],
    /// Least and greatest y \[m\].
    pub y: [f64; 2],
}

/// A load on the output.
#[derive(Debug, Clone, Copy, PartialEq, Default, Deserialize, Serialize)]
#[serde(default)]
pub struct WantedLoad {
    /// Force at its point \[N\].
    pub force: [f64; 2],
    /// Torque \[N·m\].
    pub torque: f64,
}

/// A kind of linkage.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum LinkageKind {
    /// Four bodies and four pins.
    FourBar,
    /// The output of the coupler is a slider.
    SliderCrank,
    /// Watt's six bodies, a body with two pins fixed.
    #[serde(rename = "watt_1")]
    Watt1,
    /// Watt's six bodies, a body with three pins fixed.
    #[serde(rename = "watt_2")]
    Watt2,
    /// Stephenson's six bodies, one between those with three pins fixed.
    #[serde(rename = "stephenson_1")]
    Stephenson1,
    /// Stephenson's six bodies, one of two in a row fixed.
    #[serde(rename = "stephenson_2")]
    Stephenson2,
    /// Stephenson's six bodies, a body with three pins fixed.
    #[serde(rename = "stephenson_3")]
    Stephenson3,
}

impl Synthesise {
    /// How many points, positions or pairs there are.
    pub fn count(&self) -> usize {
        let path = self.path.as_ref().map(Vec::len);
        let positions = self.positions.as_ref().map(Vec::len);
        let function = self.function.as_ref().map(Vec::len);
        path.or(positions).or(function).unwrap_or_default()
    }
}
