//! `linkdyn schema`: the JSON Schema of model files.

use super::exit::{BadInput, Exit};
use super::streams::print;

/// Prints the schema.
pub fn execute() -> Result<Exit, BadInput> {
    print(&format!("{:#}\n", linkdyn_model::schema()))?;
    Ok(Exit::Done)
}
