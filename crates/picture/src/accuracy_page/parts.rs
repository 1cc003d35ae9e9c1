//! What the page is made of.

use crate::poses::Pose as Frame;
use crate::shape::Shape;

/// A unit of the file: its symbol, and its size in SI.
#[derive(Debug, Clone, PartialEq)]
pub struct Unit {
    /// Its symbol.
    pub symbol: String,
    /// Its size in SI.
    pub size: f64,
}

/// What the page is made of.
#[derive(Debug)]
pub struct AccuracyPage<'a> {
    /// Name of the model.
    pub model: &'a str,
    /// What the model is about.
    pub about: Option<&'a str>,
    /// What the numbers assume of pins and parameters.
    pub assumed: String,
    /// The level: 0 the first order, 1 with the worst found, 2 with the certified bound.
    pub level: u8,
    /// Unit of lengths.
    pub length: Unit,
    /// Unit of angles.
    pub angle: Unit,
    /// Name of each driver, and `rad` or `m`.
    pub drivers: Vec<(String, &'static str)>,
    /// The mechanism; its clearances are the largest that are allowed.
    pub shape: Shape,
    /// What deviates.
    pub sources: Vec<Source>,
    /// What is asked about.
    pub outputs: Vec<Output<'a>>,
    /// What the reader should know.
    pub notes: &'a [String],
}

/// What deviates.
#[derive(Debug)]
pub struct Source {
    /// As the file names it.
    pub name: String,
    /// A parameter can be moved.
    pub slider: Option<Slider>,
}

/// How far a parameter can be moved, in SI.
#[derive(Debug, Clone, PartialEq)]
pub struct Slider {
    /// Its nominal value.
    pub value: f64,
    /// Its SI unit; empty of a plain number.
    pub unit: String,
    /// Least and greatest deviation.
    pub range: [f64; 2],
    /// Whether the range is its tolerance.
    pub is_tolerance: bool,
}

/// An output at its poses.
#[derive(Debug)]
pub struct Output<'a> {
    /// As the file names it.
    pub name: &'a str,
    /// What it is: a column, or a distance.
    pub of: &'a str,
    /// `rad` or `m`.
    pub unit: &'static str,
    /// Allowed deviations [rad or m].
    pub limits: Option<[f64; 2]>,
    /// One, or one per instant.
    pub poses: Vec<Pose<'a>>,
}

/// An output at a pose, all in SI; deviations to the lower and the upper side.
#[derive(Debug)]
pub struct Pose<'a> {
    /// \[s\]
    pub time: f64,
    /// Values of the drivers [rad or m].
    pub drivers: &'a [f64],
    /// The output [rad or m].
    pub nominal: f64,
    /// To first order.
    pub first: Option<[f64; 2]>,
    /// Worst found.
    pub found: [Option<f64>; 2],
    /// A bound that nothing exceeds.
    pub certified: Option<[f64; 2]>,
    /// Deviations, the least first, each with the share of all clearances and tolerances that it needs.
    pub needed: [&'a [[f64; 2]]; 2],
    /// Mean and standard deviation.
    pub moments: Option<[f64; 2]>,
    /// Share within the limits, Cp, Cpk.
    pub capability: Option<[f64; 3]>,
    /// Deviation with every pin where the loads press it.
    pub pressed: Option<f64>,
    /// Frames of the moving bodies.
    pub position: &'a [Frame],
    /// The same where the output is carried farthest to either side.
    pub displaced: [Option<&'a [Frame]>; 2],
    /// Of each source: sensitivity, how far it carries the output down and up, variance; empty without first order.
    pub contributions: Vec<[f64; 4]>,
}

impl Pose<'_> {
    /// How far the output may go, by the best that is known of it.
    pub(super) fn extent(&self) -> f64 {
        let found = self.found.iter().flatten();
        let found = found.map(|by| by.abs()).fold(0.0, f64::max);
        let first = self.first.map_or(0.0, |[low, high]| high.max(-low));
        if found > 0.0 { found } else { first }
    }
}
