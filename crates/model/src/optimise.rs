//! Optimisation: which parameters may change, what is to be best, and what must hold.

use indexmap::IndexMap;
use serde::{Deserialize, Serialize};

use crate::PointRef;

/// What is asked of an optimisation.
#[derive(Debug, Clone, PartialEq, Default, Deserialize, Serialize)]
#[serde(default)]
pub struct Optimise {
    /// Parameters that may change.
    pub design: IndexMap<String, Range>,
    /// What is to be least or greatest.
    pub objective: Option<Objective>,
    /// What must hold.
    pub constraints: Vec<Constraint>,
    /// The path that a point should take.
    pub curve: Option<Curve>,
    /// The objective gets so many standard deviations worse, by the tolerances of parameters.
    pub robust: Option<f64>,
    /// How many starts there are.
    pub starts: Option<u64>,
    /// Seed of the points from which they start.
    pub seed: Option<u64>,
}

/// Between what a parameter may change.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize, Serialize)]
#[serde(untagged)]
pub enum Range {
    /// Lower and upper bound, in SI.
    Within([f64; 2]),
    /// Around its value, as far as needed.
    Free(Free),
}

/// The word for a range without bounds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Free {
    /// That word.
    Free,
}

/// What is to be least or greatest.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize)]
pub struct Objective {
    /// What is to be least.
    pub minimise: Option<Sought>,
    /// What is to be greatest.
    pub maximise: Option<Sought>,
}

/// An expression of responses, columns and parameters.
#[derive(Debug, Clone, PartialEq, Default, Deserialize, Serialize)]
pub struct Sought {
    /// As the file has it.
    pub text: String,
    /// The same without names of responses.
    pub value: String,
}

/// What must hold.
#[derive(Debug, Clone, PartialEq, Default, Deserialize, Serialize)]
pub struct Constraint {
    /// As the file has it.
    pub text: String,
    /// The left side, without names of responses.
    pub left: String,
    /// How it compares.
    pub relation: Relation,
    /// The right side.
    pub right: String,
}

/// How two sides compare.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Relation {
    /// The left one is the right one.
    #[default]
    Equal,
    /// The left one is not greater.
    AtMost,
    /// The left one is not less.
    AtLeast,
}

/// The path that a point should take.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize)]
pub struct Curve {
    /// The point.
    pub point: PointRef,
    /// Points that its path should pass \[m\].
    pub through: Vec<[f64; 2]>,
    /// Name of the driver; may be left out where there is only one.
    pub driver: Option<String>,
    /// Values of the driver at these points \[rad or m\]; `None` if it does not matter when.
    pub at: Option<Vec<f64>>,
}

impl Optimise {
    /// The goal of one parameter, where that is all there is: an equation and nothing to be best.
    pub fn goal(&self) -> Option<&Constraint> {
        let is_alone = self.objective.is_none() && self.curve.is_none() && self.design.len() == 1;
        match self.constraints.as_slice() {
            [goal] if is_alone && goal.relation == Relation::Equal => Some(goal),
            _ => None,
        }
    }
}
