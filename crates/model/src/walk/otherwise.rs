//! Reading a file once more: with other values of its parameters, or to see what depends on them.

use super::{Findings, Units, Walk, driven, walk_with};
use crate::error::Complaint;
use crate::expression::{Parameters, Recorded};
use crate::source::Source;

/// Reads the whole file with other values of parameters.
///
/// # Errors
/// A value that no parameter can have.
pub fn walk_given(source: &Source, given: &[(&str, f64)]) -> Result<Findings, Vec<Complaint>> {
    let written = source.root.get("parameters");
    let (units, mut parameters) = read(source);
    parameters.give(written, given)?;
    Ok(walk_with(source, units, parameters, Vec::new()))
}

/// Reads the whole file with parameters that deviate.
///
/// # Errors
/// A deviation that no parameter can have.
pub fn walk_deviating(
    source: &Source,
    deviations: &[(&str, f64)],
) -> Result<Findings, Vec<Complaint>> {
    let written = source.root.get("parameters");
    let (units, mut parameters) = read(source);
    parameters.deviate(written, deviations)?;
    Ok(walk_with(source, units, parameters, Vec::new()))
}

/// The parameters, and all expressions of the file that give a quantity.
pub fn recorded(source: &Source) -> (Parameters, Vec<Recorded>) {
    let (units, parameters) = read(source);
    let mut walk = Walk::new(source, units, parameters, driven(&source.root));
    walk.record = Some(Vec::new());
    walk.file();
    (walk.parameters, walk.record.unwrap_or_default())
}

/// Units and parameters; their faults were complained about when the file was loaded.
fn read(source: &Source) -> (Units, Parameters) {
    let units = Units::read(source.root.get("units"));
    let degrees = !units.in_radians();
    let (parameters, _) = Parameters::read(source.root.get("parameters"), degrees);
    (units, parameters)
}
