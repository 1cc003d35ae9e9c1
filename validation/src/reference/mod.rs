//! Reference cases: a model, and a table of what it must give.
//!
//! `case.json`:
//!
//! ```text
//! about      a line for people
//! source     who measured, published or computed the reference
//! model      name of a bundled model, or a model itself
//! set        overrides of the model, ["analysis.outputs=11"]; may be left out
//! compare    [{ column, tolerance_relative, tolerance_absolute, verdict }]; may be left out
//! tolerance  { position, velocity, acceleration, force, effort }, one number for all columns of a kind; may be left out
//! ```
//!
//! `reference.csv` has some of the columns of `results.csv`, under the same names, at some of its instants (equal to 1e-9 s); a
//! cell left empty is not compared. `column` is a pattern for names with or without `[unit]`; a column belongs to the first entry that matches, one that
//! none matches is held against [`default_tolerance`]. The tolerance of a value is absolute + relative·max |reference| over its
//! column, since a relative error of a value that passes zero says nothing. `verdict` says what a larger difference is: `fault` (default) or `finding`.
//!
//! A number of `tolerance` is held against columns that no entry of `compare` matches, and means |ours − reference| ≤ tolerance · max(1, max |reference|)
//! in SI units: `position` for m and rad (values of drivers too), `velocity`, `acceleration`, `force` for joint forces, joint
//! torques and energies, `effort` for the efforts of drivers.

pub mod comparison;
pub mod words;

use serde_json::Value;

use super::claim::{CaseError, Claim, Setting};
use super::table::Table;
use linkdyn_engine::analysis;
use linkdyn_model::bundled;
use linkdyn_output::{Directory, Status, csv};

pub use comparison::compare;
pub use words::{CaseWords, Compare, OnDifference, Tolerance, default_tolerance};

/// The files of a reference case.
#[derive(Debug, Clone, Copy)]
pub struct ReferenceCase {
    /// Text of `case.json`.
    pub case: &'static str,
    /// Text of `reference.csv`.
    pub reference: &'static str,
}

impl ReferenceCase {
    /// The words of the case.
    ///
    /// # Errors
    /// When `case.json` is not what it should be.
    pub fn read(&self) -> Result<CaseWords, CaseError> {
        serde_json::from_str(self.case)
            .map_err(|error| CaseError::Broken(format!("case.json: {error}")))
    }

    /// Runs the model and compares.
    ///
    /// # Errors
    /// When the case can't be run, or its results can't be written.
    pub fn run(&self, setting: &Setting) -> Result<Vec<Claim>, CaseError> {
        let words = self.read()?;
        let table = Table::parse(self.reference)
            .map_err(|said| CaseError::Broken(format!("reference.csv: {said}")))?;
        let broken = |complaints: linkdyn_model::error::Complaints| {
            let complaints: Vec<String> = complaints.iter().map(ToString::to_string).collect();
            CaseError::Broken(format!("model: {}", complaints.join("; ")))
        };
        let loaded =
            linkdyn_model::load(&model_bytes(&words.model)?, &words.set).map_err(broken)?;
        let outcome = analysis::run(&loaded.model, &setting.control).map_err(broken)?;
        if let Some(output) = &setting.output {
            Directory::open(output)?
                .write_with("results.csv", |file| csv::write(&outcome.trajectory, file))?;
        }
        match outcome.report.status {
            Status::Interrupted => Err(CaseError::Interrupted),
            // A run that stopped early is compared too: the missing instants show.
            Status::Completed
            | Status::CompletedWithGaps
            | Status::DeadCentre
            | Status::AssemblyFailed
            | Status::StepTooSmall
            | Status::Singular
            | Status::TimeLimit => compare(&table, &outcome.trajectory, &words.comparisons())
                .map_err(CaseError::Broken),
        }
    }
}

/// The text of the case's model.
fn model_bytes(model: &Value) -> Result<Vec<u8>, CaseError> {
    match model {
        Value::String(name) => match bundled::find(name) {
            Some(bundled) => Ok(bundled.text.as_bytes().to_vec()),
            None => Err(CaseError::Broken(format!(
                "case.json: no bundled model {name:?}"
            ))),
        },
        model => Ok(model.to_string().into_bytes()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    #[test]
    fn the_words_of_a_case_are_read() {
        let case = r#"{ "about": "a", "source": "s", "model": "four-bar",
            "compare": [{ "column": "*", "tolerance_relative": 1e-3, "verdict": "finding" }] }"#;
        let words = ReferenceCase {
            case,
            reference: "",
        }
        .read()
        .expect("valid");
        assert_eq!(words.compare[0].verdict, OnDifference::Finding);
        assert!(
            model_bytes(&words.model)
                .expect("bundled")
                .starts_with(b"{")
        );
        let broken = ReferenceCase {
            case: r#"{ "abuot": "a" }"#,
            reference: "",
        }
        .read()
        .expect_err("misspelt");
        assert!(broken.to_string().contains("abuot"), "{broken}");
    }
}
