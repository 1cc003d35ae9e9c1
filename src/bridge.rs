//! What the packages for other languages need beside the face. It changes without notice.

use std::path::{Path, PathBuf};

use linkdyn_model::Beside;
use linkdyn_output::{Column, Stage};

use crate::error::Error;
use crate::family::Family;
use crate::mechanism::Mechanism;
use crate::run::Run;

pub use linkdyn_ask::caught;
pub use linkdyn_engine::analysis::Progress;
pub use linkdyn_engine::system::{System, Terms};

/// Reads a model file that has this name, and is at a path, beside which its tables are, or in folders that are allowed.
///
/// # Errors
/// [`Error::Model`] with all faults of the model.
pub fn read(
    stem: &str,
    text: &[u8],
    path: &Path,
    allowed: Vec<PathBuf>,
) -> Result<Mechanism, Error> {
    let path = path.to_owned();
    Mechanism::read_beside(stem, text.to_vec(), Beside { path, allowed })
}

/// The mechanism with values of its model set at once, each as `PATH=VALUE`: what is legal only together can be set.
///
/// # Errors
/// [`Error::Model`] where a path leads nowhere, or the model has faults with these values.
pub fn set(mechanism: &Mechanism, sets: Vec<String>) -> Result<Mechanism, Error> {
    mechanism.set_all(sets)
}

/// The text of `summary.json`; no time of writing files is told, as none were written.
pub fn summary(run: &Run) -> String {
    run.mechanism()
        .origin()
        .summary(run.outcome(), Stage::default())
}

/// The columns of `results.csv`; all others were computed, too, where `analysis.columns` leaves some out.
pub fn wanted(run: &Run) -> &[Column] {
    &run.outcome().trajectory.columns
}

/// Names and SI units of the responses of a family, in their order.
pub fn responses(family: &Family) -> Vec<(String, String)> {
    let owned = |(name, unit): (&str, &str)| (name.to_owned(), unit.to_owned());
    family.responses().map(owned).collect()
}

/// The equations that a mechanism was compiled to.
///
/// # Errors
/// [`Error::Model`] where the model has no analysis, or lacks what it needs.
pub fn system(mechanism: &Mechanism) -> Result<&System, Error> {
    Ok(mechanism.prepared()?.system())
}
