//! `linkdyn schema`: the JSON Schema of model files.

use super::exit::{Exit, Failure};
use super::streams::print;

/// Prints the schema.
pub fn execute() -> Result<Exit, Failure> {
    print(&format!("{:#}\n", linkdyn_model::schema()))?;
    Ok(Exit::Done)
}
