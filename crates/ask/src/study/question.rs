//! The settings of a study.

use linkdyn_model::study::{SampleIndices, SampleMethod};
use linkdyn_study::design::Method;

use crate::{ModelFile, Unanswered};

/// What is varied, and how.
#[derive(Debug, Clone)]
pub struct Study {
    /// Parameters that take values of a grid.
    pub varied: Vec<Varied>,
    /// How many samples are drawn of the parameters that have a tolerance.
    pub samples: Option<u64>,
    /// How samples are drawn.
    pub method: Method,
    /// Whether samples are those that Sobol indices need.
    pub indices: bool,
    /// Seed of the samples.
    pub seed: u64,
}

/// Values of a parameter, as they were written.
#[derive(Debug, Clone)]
pub struct Varied {
    /// How messages call it, `--vary parameters.r=40 mm:60 mm`.
    pub label: String,
    /// The parameter.
    pub name: String,
    /// Its values: `FROM:TO:COUNT`, or one by one with commas.
    pub values: String,
}

impl Default for Study {
    /// Nothing is varied.
    fn default() -> Self {
        Study {
            varied: Vec::new(),
            samples: None,
            method: Method::MonteCarlo,
            indices: false,
            seed: 1,
        }
    }
}

impl Study {
    /// What a model says of its study, where it does.
    pub fn of_model(file: &ModelFile, seed: Option<u64>) -> Option<Self> {
        let own = file.model().study.as_ref()?;
        let varied = own.vary.iter().map(|(name, values)| Varied {
            label: format!("study.vary.{name} {values:?}"),
            name: bare(name),
            values: values.clone(),
        });
        let whole = |number: usize| number as u64;
        Some(Study {
            varied: varied.collect(),
            samples: own.samples.map(whole),
            method: match own.method {
                SampleMethod::Random => Method::MonteCarlo,
                SampleMethod::Latin => Method::LatinHypercube,
                SampleMethod::Sobol => Method::Sobol { scrambled: true },
            },
            indices: own.indices == SampleIndices::Sobol,
            seed: seed.or(own.seed.map(whole)).unwrap_or(1),
        })
    }
}

impl Varied {
    /// How axes are written.
    pub(super) const FORM: &str =
        "write it as in \"parameters.r=40 mm:60 mm:21\" or \"parameters.r=40 mm, 50 mm\"";

    /// Values of a parameter: `FROM:TO:COUNT`, or one by one with commas.
    pub fn new(name: &str, values: &str) -> Self {
        Varied {
            label: format!("{name} over {values:?}"),
            name: bare(name),
            values: values.to_owned(),
        }
    }

    /// Reads `parameters.NAME=VALUES`, which messages call `--vary`.
    ///
    /// # Errors
    /// A text without `=`.
    pub fn read(text: &str) -> Result<Self, Unanswered> {
        let bad = || Unanswered::question(format!("--vary {text}: {}", Varied::FORM));
        let (path, values) = text.split_once('=').ok_or_else(bad)?;
        Ok(Varied {
            label: format!("--vary {text}"),
            name: bare(path.trim()),
            values: values.to_owned(),
        })
    }
}

/// The name of a parameter without what stands before it.
fn bare(path: &str) -> String {
    path.strip_prefix("parameters.").unwrap_or(path).to_owned()
}
