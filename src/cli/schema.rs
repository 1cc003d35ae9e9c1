//! `linkdyn schema`: the JSON Schema of model files.

use super::{BadInput, Exit, print};
use crate::model;

/// Prints the schema.
pub fn execute() -> Result<Exit, BadInput> {
    print(&format!("{:#}\n", model::schema()))?;
    Ok(Exit::Done)
}
