//! The circuits of a mechanism with one freedom.

use super::grashof::FourBarClass;
use crate::{ModelFile, Question, Unanswered};
use linkdyn_engine::analysis::{AllCircuits, CircuitsQuestion, Control, all_circuits};

/// Values of the driver where nobody says.
const VALUES: usize = 72;
/// The most values, which takes a minute for a large mechanism.
const MOST_VALUES: usize = 100_000;

/// Asks for the circuits.
#[derive(Debug, Clone, Default)]
pub struct Circuits {
    /// The driver; the only one where none is named.
    pub driver: Option<String>,
    /// Its values at which all assemblies are looked for.
    pub values: Option<usize>,
    /// Its least and greatest value \[rad or m\]; a full turn, or what its motion passes.
    pub range: Option<[f64; 2]>,
    /// The most assemblies at each value.
    pub most: Option<usize>,
}

/// The circuits.
#[derive(Debug, Clone)]
pub struct CircuitsFound {
    /// The model.
    pub file: ModelFile,
    /// What was found.
    pub found: AllCircuits,
    /// The class of a four-bar.
    pub four_bar: Option<FourBarClass>,
}

impl Question for Circuits {
    type Answer = CircuitsFound;

    fn answer(&self, file: &ModelFile, control: &Control) -> Result<CircuitsFound, Unanswered> {
        let values = self.values.unwrap_or(VALUES);
        if !(2..=MOST_VALUES).contains(&values) {
            return Err(Unanswered::question(format!(
                "--values {values}: 2 to {MOST_VALUES} values"
            )));
        }
        if self.most == Some(0) {
            return Err(Unanswered::question("--most 0: look for one at least"));
        }
        if let Some([low, high]) = self.range
            && (!low.is_finite() || !high.is_finite() || low >= high)
        {
            return Err(Unanswered::question(format!(
                "--range {low}:{high}: the first end must be the lower one"
            )));
        }
        let question = CircuitsQuestion {
            driver: self.driver.clone(),
            count: values,
            range: self.range,
            most: self.most.unwrap_or(super::MOST),
        };
        let found = all_circuits(file.model(), &question, control);
        match found.map_err(|complaints| file.refused(complaints))? {
            Some(found) => Ok(CircuitsFound {
                file: file.clone(),
                four_bar: FourBarClass::of(file.model()),
                found,
            }),
            None => Err(Unanswered::question(
                "interrupted before the circuits were found",
            )),
        }
    }
}
