//! Values of parameters with which goals are met, an objective is least, or a point takes a path.
//!
//! | file        | does                                                                  |
//! | ----------- | --------------------------------------------------------------------- |
//! | `asked`     | the request, put into the model's `optimise`                          |
//! | `target`    | what is looked for                                                    |
//! | `variants`  | what a variant gives: the one place where the search meets the engine |
//! | `guarded`   | variants among which one with a fault of linkdyn has no value         |
//! | `path`      | the model whose motion gives a path, and its nodes                    |
//! | `timing`    | the analysis that gives a path                                        |
//! | `problem`   | a variant as the search sees it                                       |
//! | `slopes`    | its derivatives                                                       |
//! | `search`    | the starts                                                            |
//! | `optimised` | what they come to                                                     |
//! | `json`      | the same for programs                                                 |
//! | `text`      | the same in words                                                     |
//! | `page`      | the same as a page                                                    |
//! | `history`   | how the search went                                                   |

mod asked;
mod derivatives;
mod guarded;
mod history;
mod json;
mod optimised;
mod page;
mod path;
mod problem;
mod search;
mod slopes;
mod target;
mod text;
mod timing;
mod variants;

use std::sync::Arc;

use linkdyn_engine::analysis::Control;

use crate::{ModelFile, Question, Text, Unanswered};
pub use optimised::Optimised;
use search::Search;
use target::Target;
use timing::Timing;
use variants::{Found, Runs};

/// Searches for values of parameters. What is given here replaces what the model says under `optimise`.
#[derive(Debug, Clone, Default)]
pub struct Optimise {
    /// Parameters that may change, `parameters.r=10 mm:60 mm` or without bounds.
    pub vary: Vec<String>,
    /// Equations that must hold.
    pub goals: Vec<String>,
    /// What is to be least; one at most, here or below.
    pub minimise: Vec<String>,
    /// What is to be greatest.
    pub maximise: Vec<String>,
    /// Constraints.
    pub constraints: Vec<String>,
    /// Standard deviations that the objective may get worse by tolerances.
    pub robust: Option<f64>,
    /// How many starts there are.
    pub starts: Option<u64>,
    /// Seed of the points from which they start.
    pub seed: Option<u64>,
}

/// A search that is ready to begin.
pub struct Optimisation {
    /// The model with the request.
    pub file: ModelFile,
    target: Target,
    timing: Option<Timing>,
    runs: Runs,
    control: Control,
}

impl Optimise {
    /// Reads a model with the request; `control` may interrupt it.
    ///
    /// # Errors
    /// Faults of the model and of the request.
    pub fn of(
        &self,
        text: &Arc<Text>,
        sets: &[String],
        control: &Control,
    ) -> Result<Optimisation, Unanswered> {
        let plain = self.read(text, sets)?;
        let (target, file) = Target::new(&plain)?;
        let timing = Timing::new(&plain, &target)?;
        let interrupted = Arc::clone(&control.interrupted);
        let runs = Runs::new(&target, &file, &plain, timing.as_ref(), interrupted)?;
        Ok(Optimisation {
            file,
            target,
            timing,
            runs,
            control: control.clone(),
        })
    }
}

/// Threads of rayon share the starts.
impl Question for Optimise {
    type Answer = Optimised;

    fn answer(&self, file: &ModelFile, control: &Control) -> Result<Optimised, Unanswered> {
        self.of(&file.text, &file.sets, control)?.answer(false)
    }
}

impl Optimisation {
    /// Searches; threads of rayon share the starts. All evaluations are kept if that is requested.
    ///
    /// # Errors
    /// More parameters than the starts can be spread over.
    pub fn answer(self, is_kept: bool) -> Result<Optimised, Unanswered> {
        let mut search = Search {
            target: &self.target,
            runs: &self.runs,
            timing: self.timing.as_ref(),
            scales: Vec::new(),
            keep: is_kept,
        };
        let before = match search.as_it_is()? {
            Found::Some(measured) => Ok(measured),
            Found::None(why) => Err(why),
            // Nobody asks why.
            Found::Stopped => Err(String::new()),
        };
        let ended = search.run(&self.control.progress)?;
        let scales = search.scales;
        Ok(Optimised::new(
            self.file,
            self.target,
            ended,
            scales,
            before,
        ))
    }
}
