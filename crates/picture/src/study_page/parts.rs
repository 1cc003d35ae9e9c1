//! What the page is made of.

use serde_json::Value;

use super::values::{FEWEST_INSTANTS, instant_bytes};
use crate::accuracy_page::Unit;
use crate::mechanism::Drawing;
use crate::poses::Pose;
use crate::shape::Shape;

/// Variants that are drawn, at most: more points than that are one blot.
const MOST_ROWS: usize = 20_000;
/// Variants that can be played, at most.
const MOST_MOTIONS: usize = 200;
/// Bytes that numbers of variants may take, before base64 makes a third more of them, and those of motions.
const ROOM_ROWS: usize = 2_000_000;
const ROOM_MOTIONS: usize = 900_000;

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
    pub(super) fn drawn(&self) -> [Value; 2] {
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

/// How many variants of so many columns a page draws.
pub fn most_rows(columns: usize) -> usize {
    (ROOM_ROWS / super::values::row_bytes(columns)).clamp(1, MOST_ROWS)
}

/// How many motions of so many moving bodies a page plays.
pub fn most_motions(bodies: usize) -> usize {
    (ROOM_MOTIONS / (FEWEST_INSTANTS * instant_bytes(bodies))).min(MOST_MOTIONS)
}

/// How many instants each of so many motions has in the page, at most.
pub(super) fn most_instants(motions: usize, bodies: usize) -> usize {
    (ROOM_MOTIONS / (motions.max(1) * instant_bytes(bodies))).clamp(2, MOST_INSTANTS)
}

/// More instants than this look like a continuous motion.
const MOST_INSTANTS: usize = 121;
