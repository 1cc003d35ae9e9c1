//! What a study is asked for: by options, or else by the words of the model.

use super::Options;
use crate::cli::exit::{BadInput, Failure};
use crate::cli::open::Opened;
use linkdyn_model::study::{SampleIndices, SampleMethod, Study};
use linkdyn_study::design::Method;

/// Random numbers where the user says no seed.
const SEED: u64 = 1;

/// What is varied, and how.
#[derive(Debug)]
pub struct Wanted {
    pub axes: Vec<Axis>,
    pub samples: Option<u64>,
    pub method: Method,
    pub indices: bool,
    pub seed: u64,
}

/// Values of a parameter, as they were written.
#[derive(Debug)]
pub struct Axis {
    /// How messages call it, `--vary parameters.r=40 mm:60 mm`.
    pub label: String,
    /// The parameter.
    pub name: String,
    pub values: String,
}

impl Wanted {
    /// Of options; of the model, where these do not say what is varied.
    ///
    /// # Errors
    /// What can't be read as an axis.
    pub fn new(options: &Options, opened: &Opened) -> Result<Self, Failure> {
        let own = match &opened.loaded.model.study {
            Some(study) if options.vary.is_empty() && options.samples.is_none() => study,
            Some(_) | None => return Wanted::of_options(options),
        };
        let axes = own.vary.iter().map(|(name, values)| Axis {
            label: format!("study.vary.{name} {values:?}"),
            name: bare(name),
            values: values.clone(),
        });
        let whole = |number: usize| number as u64;
        Ok(Wanted {
            axes: axes.collect(),
            samples: own.samples.map(whole),
            method: match own.method {
                SampleMethod::Random => Method::MonteCarlo,
                SampleMethod::Latin => Method::LatinHypercube,
                SampleMethod::Sobol => Method::Sobol { scrambled: true },
            },
            indices: own.indices == SampleIndices::Sobol,
            seed: options.seed.or(own.seed.map(whole)).unwrap_or(SEED),
        })
    }

    fn of_options(options: &Options) -> Result<Self, Failure> {
        let axes = options.vary.iter().map(|text| {
            let (path, values) = text
                .split_once('=')
                .ok_or_else(|| BadInput(vec![format!("--vary {text}: {}", Axis::FORM)]))?;
            Ok(Axis {
                label: format!("--vary {text}"),
                name: bare(path.trim()),
                values: values.to_owned(),
            })
        });
        Ok(Wanted {
            axes: axes.collect::<Result<_, Failure>>()?,
            samples: options.samples,
            method: match (options.sobol, options.latin) {
                (true, _) => Method::Sobol { scrambled: true },
                (_, true) => Method::LatinHypercube,
                _ => Method::MonteCarlo,
            },
            indices: options.indices,
            seed: options.seed.unwrap_or(SEED),
        })
    }
}

/// What a model says of its study, for people.
pub fn rows(study: &Study) -> Vec<String> {
    let axes = study.vary.iter();
    let mut rows: Vec<String> = axes
        .map(|(name, values)| format!("{} over {values}", bare(name)))
        .collect();
    if let Some(samples) = study.samples {
        let how = match study.method {
            SampleMethod::Random => "random",
            SampleMethod::Latin => "a Latin hypercube",
            SampleMethod::Sobol => "Sobol points",
        };
        let indices = match study.indices {
            SampleIndices::None => "",
            SampleIndices::Sobol => ", for Sobol indices",
        };
        rows.push(format!("{samples} samples ({how}{indices})"));
    }
    rows
}

impl Axis {
    /// How axes are written.
    pub const FORM: &str =
        "write it as in \"parameters.r=40 mm:60 mm:21\" or \"parameters.r=40 mm, 50 mm\"";
}

/// The name of a parameter without what stands before it.
fn bare(path: &str) -> String {
    path.strip_prefix("parameters.").unwrap_or(path).to_owned()
}
