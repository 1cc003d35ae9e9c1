//! What a study is: enough to join its chunks without its model.

use linkdyn_engine::analysis::Family;
use linkdyn_model::{AnalysisKind, Model};
use linkdyn_study::chunks::{Identity, Plan};
use linkdyn_study::design::Method;
use linkdyn_study::summary::Limits;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use super::inputs::{Column, How, Inputs};
use super::question::Study;
use crate::{ENGINE, ModelFile, Varying};

/// Rows of a chunk, at least and at most.
const FEWEST: u64 = 16;
const MOST: u64 = 8192;
/// Outputs times bodies of a chunk, about.
const WORK: u64 = 1 << 22;
/// So many outputs of a prescribed motion cost what one of a free motion does.
const FREE: u64 = 64;

/// A response requested.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Asked {
    /// Its name.
    pub name: String,
    /// SI unit; empty of a plain number.
    pub unit: String,
    /// Its expression.
    pub value: String,
    /// Within which it is to be.
    pub limits: Limits,
}

/// What a study is.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Head {
    /// The version that computes it.
    pub engine: String,
    /// The model that is varied.
    pub model: Varying,
    /// SHA-256 of all that the rows follow from.
    pub study: String,
    /// How variants are chosen.
    pub method: String,
    /// Of the samples.
    pub seed: u64,
    /// How many there are.
    pub variants: u64,
    /// Rows that are kept together.
    pub rows_per_chunk: u64,
    /// Rows that belong together for Sobol indices.
    pub rows_per_point: Option<u64>,
    /// What is varied.
    pub inputs: Vec<Column>,
    /// What comes out.
    pub responses: Vec<Asked>,
}

/// Which variants are a random sample, so that a share of them says something of the true one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sampling {
    /// All.
    Each,
    /// The first and the last of so many rows: the others take each of their values from one of these.
    Ends(u64),
    /// None: they are the points of a grid.
    Grid,
    /// The same samples at each point of a grid.
    Repeated,
}

impl Sampling {
    /// Whether a variant counts for shares.
    pub fn counts(self, variant: u64) -> bool {
        match self {
            Sampling::Each | Sampling::Grid | Sampling::Repeated => true,
            Sampling::Ends(rows) => matches!(variant % rows, part if part == 0 || part == rows - 1),
        }
    }
}

impl Head {
    /// Which variants are a sample.
    pub fn sampling(&self) -> Sampling {
        let is_scattered = |own: &Column| match own.how {
            How::Scattered { .. } => true,
            How::Linear { .. } | How::Listed(_) => false,
        };
        let scattered = self.inputs.iter().filter(|own| is_scattered(own)).count();
        match (scattered, self.rows_per_point) {
            (0, _) => Sampling::Grid,
            (count, _) if count < self.inputs.len() => Sampling::Repeated,
            (_, Some(rows)) => Sampling::Ends(rows),
            (_, None) => Sampling::Each,
        }
    }

    /// Of a question.
    pub(super) fn new(study: &Study, file: &ModelFile, inputs: &Inputs, family: &Family) -> Head {
        let method = match (study.samples, study.method) {
            (None, _) => "grid",
            (Some(_), Method::Sobol { .. }) => "sobol",
            (Some(_), Method::LatinHypercube) => "latin_hypercube",
            (Some(_), Method::MonteCarlo) => "monte_carlo",
        };
        let mut head = Head {
            engine: ENGINE.to_owned(),
            model: file.varying(),
            study: String::new(),
            method: method.to_owned(),
            seed: study.seed,
            variants: inputs.design.rows(),
            rows_per_chunk: rows_per_chunk(file.model()),
            rows_per_point: inputs.rows_per_point,
            inputs: inputs.inputs.iter().map(|own| own.column.clone()).collect(),
            responses: responses(family),
        };
        let said = serde_json::to_vec(&head).expect("texts and numbers");
        head.study = format!("{:x}", Sha256::digest(&said));
        head
    }

    /// What its chunks have in common.
    pub fn identity(&self) -> Identity {
        let named = |name: &str, unit: &str| match unit {
            "" => name.to_owned(),
            unit => format!("{name}[{unit}]"),
        };
        Identity {
            study: self.study.clone(),
            engine: self.engine.clone(),
            inputs: self
                .inputs
                .iter()
                .map(|own| named(&own.name, &own.unit))
                .collect(),
            responses: self
                .responses
                .iter()
                .map(|own| named(&own.name, &own.unit))
                .collect(),
        }
    }

    /// How its variants go into chunks.
    pub fn plan(&self) -> Plan {
        Plan::new(self.variants, self.rows_per_chunk)
    }
}

/// What a family's responses are.
fn responses(family: &Family) -> Vec<Asked> {
    let list = family.responses().list().iter();
    let asked = list.map(|own| Asked {
        name: own.name.clone(),
        unit: own.unit.clone(),
        value: own.text.clone(),
        limits: own
            .limits
            .map_or_else(Limits::default, |[lower, upper]| Limits {
                lower: Some(lower),
                upper: Some(upper),
            }),
    });
    asked.collect()
}

/// A power of two that follows from the model alone, so that all machines share out the same chunks.
fn rows_per_chunk(model: &Model) -> u64 {
    let analysis = model.analysis.as_ref();
    let outputs = analysis.and_then(|analysis| analysis.outputs);
    let is_free = analysis.is_some_and(|analysis| analysis.kind == AnalysisKind::Dynamics);
    let each = if is_free { FREE } else { 1 };
    let cost = model.bodies.len() as u64 * outputs.unwrap_or(1) as u64 * each;
    let rows = (WORK / cost.max(1)).clamp(FEWEST, MOST);
    1 << rows.ilog2()
}
