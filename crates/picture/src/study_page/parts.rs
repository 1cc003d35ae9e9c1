//! What the page is made of.

use serde_json::Value;

use crate::accuracy_page::Unit;
use crate::mechanism::Drawing;
use crate::poses::Pose;
use crate::shape::Shape;

/// What the page is made of; all numbers in SI.
#[derive(Debug)]
pub struct StudyPage<'a> {
    /// Name of the model.
    pub model: &'a str,
    /// How the variants were chosen, in words.
    pub method: String,
    /// All variants of the study.
    pub variants: u64,
    /// Unit of the file for lengths, and for angles.
    pub units: [Unit; 2],
    /// What was varied.
    pub inputs: Vec<Variable>,
    /// What came out.
    pub responses: Vec<Variable>,
    /// What the rows come to, as `study.json` has it under `summary`.
    pub summary: &'a Value,
    /// The variants that are drawn, in their order.
    pub rows: Vec<Variant>,
    /// The variants that can be played.
    pub played: Played,
}

/// A column of the variants.
#[derive(Debug)]
pub struct Variable {
    /// As the file names it.
    pub name: String,
    /// Its SI unit; empty of a plain number.
    pub unit: String,
    /// The unit in which it is shown, where that is its own.
    pub shown: Option<Unit>,
    /// How it varies, or its expression and limits, as `study.json` has it.
    pub facts: Value,
}

/// One variant.
#[derive(Debug, Clone, PartialEq)]
pub struct Variant {
    /// Its number.
    pub number: u64,
    /// Why it has no result.
    pub reason: Option<String>,
    /// Inputs and responses; NaN where there is none.
    pub values: Vec<f64>,
}

/// The variants that can be played.
#[derive(Debug)]
pub enum Played {
    /// None, for this reason.
    None(&'static str),
    /// These.
    Motions(Vec<Motion>),
}

/// The motion of a variant.
#[derive(Debug)]
pub struct Motion {
    /// Its number; `None` for the nominal mechanism.
    pub variant: Option<u64>,
    /// The mechanism.
    pub shape: Shape,
    /// Instants \[s\].
    pub times: Vec<f64>,
    /// x, y and angle of each moving body, instant by instant [m, rad].
    pub poses: Vec<f64>,
}

impl Motion {
    /// The mechanism and its drawing.
    pub(crate) fn drawn(&self) -> [Value; 2] {
        let moving = self.shape.bodies.len().saturating_sub(1);
        let pose = |instant: &[f64]| {
            let moving = instant.as_chunks::<3>().0.iter().copied();
            [[0.0; 3]].into_iter().chain(moving).collect()
        };
        let rows: Vec<Vec<Pose>> = self
            .poses
            .chunks_exact((3 * moving).max(1))
            .map(pose)
            .collect();
        [self.shape.for_page(), Drawing::of(&self.shape, &rows).0]
    }
}
