//! A study: many variants of a model.

use indexmap::IndexMap;
use serde::{Deserialize, Serialize};

/// What a study varies.
#[derive(Debug, Clone, PartialEq, Default, Deserialize, Serialize)]
#[serde(default)]
pub struct Study {
    /// Parameters, and their values as the command takes them.
    pub vary: IndexMap<String, String>,
    /// How many samples are drawn.
    pub samples: Option<usize>,
    /// How.
    pub method: SampleMethod,
    /// Whether they serve Sobol indices.
    pub indices: SampleIndices,
    /// Seed of the samples.
    pub seed: Option<usize>,
}

/// How samples are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum SampleMethod {
    /// Each by itself.
    #[default]
    Random,
    /// A Latin hypercube.
    Latin,
    /// Scrambled Sobol points.
    Sobol,
}

/// What samples serve besides.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum SampleIndices {
    /// Nothing.
    #[default]
    None,
    /// Sobol indices.
    Sobol,
}
