//! The bundled lock as a model file.

use serde_json::Value;

use crate::CaseError;
use linkdyn_model::bundled;

/// A fault of the case.
pub fn broken(what: impl std::fmt::Display) -> CaseError {
    CaseError::Broken(what.to_string())
}

/// The bundled model file.
///
/// # Errors
/// When it is not there.
pub fn bundled() -> Result<Value, CaseError> {
    let bundled =
        bundled::find("watt-i-lock").ok_or_else(|| broken("no bundled model watt-i-lock"))?;
    serde_json::from_str(bundled.text).map_err(broken)
}

/// A body's point in the file \[mm\].
///
/// # Errors
/// When there is none.
pub fn point(document: &Value, body: &str, name: &str) -> Result<[f64; 2], CaseError> {
    serde_json::from_value(document["bodies"][body]["points"][name].clone()).map_err(broken)
}
