//! One model with each model of a joint's clearance, and how far their results are apart.

mod columns;
mod figures;
mod json;
mod ladder;
mod page;
mod question;
mod text;

use std::sync::atomic::Ordering;

use linkdyn_engine::analysis::{Control, Outcome};
use linkdyn_output::comparison::{Comparison, Difference};
use linkdyn_output::{Column, Trajectory};

use crate::{ModelFile, Question, Unanswered};
use columns::{compare, curves};
pub use figures::Figure;
pub use ladder::Rung;
use ladder::ran;
pub use question::Compare;
use question::{joints, models};

/// How far the models of a clearance are apart.
#[derive(Debug)]
pub struct Compared {
    /// The model.
    pub file: ModelFile,
    /// Joints whose clearance model changes.
    pub joints: Vec<String>,
    /// The runs.
    pub rungs: Vec<Rung>,
    /// Whether the models were asked for by name.
    pub is_chosen: bool,
    /// Models that were left out as it was interrupted.
    pub left_out: Vec<&'static str>,
    /// How far they are apart.
    pub comparison: Comparison,
    /// Of each model that ran: its outputs and peaks.
    pub curves: Vec<(&'static str, Trajectory)>,
}

impl Question for Compare {
    type Answer = Compared;

    fn answer(&self, file: &ModelFile, control: &Control) -> Result<Compared, Unanswered> {
        self.answer_model_by_model(file, control, |_| ())
    }
}

impl Compare {
    /// The same; `begin` is called with each model before it is run, and what it gives is dropped after that.
    ///
    /// # Errors
    /// Joints, models or columns that there are not; none of the models can be run.
    pub fn answer_model_by_model<T>(
        &self,
        file: &ModelFile,
        control: &Control,
        mut begin: impl FnMut(&'static str) -> T,
    ) -> Result<Compared, Unanswered> {
        let joints = joints(file, &self.joints)?;
        let models = models(&self.models)?;
        let mut rungs: Vec<Rung> = Vec::new();
        for (number, &model) in models.iter().enumerate() {
            if number > 0 && control.interrupted.load(Ordering::SeqCst) {
                break;
            }
            let begun = begin(model);
            let ran = ladder::run(self, file, &joints, model, control);
            drop(begun);
            rungs.push(Rung { model, ran });
            if rungs.iter().filter(|rung| rung.ran.is_ok()).count() == 1 {
                self.expect_columns(&compare(file.model(), &joints, &rungs, &self.columns))?;
            }
        }
        if rungs.iter().all(|rung| rung.ran.is_err()) {
            let said = rungs.iter().filter_map(|rung| {
                let (model, why) = (rung.model, rung.ran.as_ref().err()?);
                Some(format!("{}: {model}: {why}", file.label()))
            });
            return Err(Unanswered::Question(said.collect()));
        }
        Ok(Compared {
            file: file.clone(),
            comparison: compare(file.model(), &joints, &rungs, &self.columns),
            curves: curves(&joints, &rungs),
            joints,
            is_chosen: !self.models.is_empty(),
            left_out: models[rungs.len()..].to_vec(),
            rungs,
        })
    }

    fn expect_columns(&self, comparison: &Comparison) -> Result<(), Unanswered> {
        if comparison.unmatched.is_empty() {
            return Ok(());
        }
        let said = comparison.unmatched.iter().map(|pattern| {
            format!(
                "--columns {pattern:?}: matches no column (names without [unit], as in results.csv)"
            )
        });
        Err(Unanswered::Question(said.collect()))
    }
}

impl Compared {
    /// Smallest value of a column, its time, largest value and its time, by model; peaks between the outputs included.
    fn extremes(&self, column: &Column) -> impl Iterator<Item = (&'static str, [f64; 4])> {
        self.curves.iter().map(|(model, table)| {
            let extremes = table.id_of(column).and_then(|id| table.extremes_of(id));
            let numbers = extremes.map(|e| [e.min, e.min_time, e.max, e.max_time]);
            (*model, numbers.unwrap_or([f64::NAN; 4]))
        })
    }

    /// The models that ran; the others are compared with the first.
    fn ran(&self) -> impl Iterator<Item = (&'static str, &Outcome)> {
        ran(&self.rungs)
    }

    /// Word for a model that can't be run.
    fn refusal(&self) -> &'static str {
        if self.is_chosen { "refused" } else { "skipped" }
    }

    fn joint_word(&self) -> &'static str {
        if self.joints.len() == 1 {
            "joint"
        } else {
            "joints"
        }
    }

    /// Contacts of the joints, where the model has any.
    fn contacts(&self, outcome: &Outcome) -> Option<u64> {
        let sums = outcome.report.clearances.iter();
        let counted = sums.filter(|sums| self.joints.contains(&sums.joint));
        counted.map(|sums| sums.episodes).reduce(|a, b| a + b)
    }

    /// A figure of each compared column, with the curves of all models.
    pub fn figures(&self) -> Vec<Figure> {
        figures::figures(&self.comparison.columns, &self.curves)
    }
}

/// Largest difference, its time, mean and root mean square.
fn numbers(difference: &Difference) -> [f64; 4] {
    let numbers = difference.numbers;
    let numbers = numbers.map(|n| [n.max, n.max_time, n.mean, n.rms]);
    numbers.unwrap_or([f64::NAN; 4])
}

/// CPU of assembly and solution \[s\].
fn cpu(outcome: &Outcome) -> f64 {
    outcome.report.assemble.cpu + outcome.report.solve.cpu
}
