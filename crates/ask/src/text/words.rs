//! What reports hold, in words.

use super::{count, names, number};
use linkdyn_model::AnalysisKind;
use linkdyn_model::error::Complaints;
use linkdyn_output::{Equilibrium, Mobility, Status};

/// Digits of numbers.
const DIGITS: usize = 4;

/// The analysis in words.
pub fn analysis_words(kind: AnalysisKind) -> &'static str {
    match kind {
        AnalysisKind::Assembly => "assembly",
        AnalysisKind::Kinematics => "kinematics",
        AnalysisKind::InverseDynamics => "inverse dynamics",
        AnalysisKind::Dynamics => "dynamics",
        AnalysisKind::Statics => "statics",
        AnalysisKind::QuasiStatics => "quasi-statics",
    }
}

/// The status in words.
pub fn status_words(status: Status) -> String {
    status.word().replace('_', " ")
}

/// Mobility and what is odd about it.
pub fn mobility(mobility: &Mobility) -> String {
    let Mobility {
        grubler,
        rank,
        drivers,
        redundant,
        reactions_not_unique,
    } = mobility;
    let mut text = format!(
        "{grubler} by Grübler, {rank} by rank, {}",
        count(*drivers, "driver")
    );
    if !redundant.is_empty() {
        text += &format!("; redundant: {}", names(redundant));
    }
    if !reactions_not_unique.is_empty() {
        text += &format!("; reactions not unique: {}", names(reactions_not_unique));
    }
    text
}

/// `stable, stiffness 7.688 by crank.angle, residual 1e-16`.
pub fn equilibrium(found: &Equilibrium) -> String {
    let stiffness: Vec<String> = found.stiffness.iter().map(|k| number(*k, DIGITS)).collect();
    let by = match stiffness.is_empty() {
        true => "nothing is free to move".to_string(),
        false => format!(
            "stiffness {} by {}",
            stiffness.join(", "),
            found.coordinates.join(", ")
        ),
    };
    format!(
        "{}, {by}, residual {}",
        found.stability,
        number(found.residual, 2)
    )
}

/// What is wrong with a model, without its values: many variants have the same fault.
pub fn input_fault(complaints: &Complaints) -> String {
    let first = complaints.0.first();
    first.map_or_else(
        || "bad_input".to_owned(),
        |complaint| format!("bad_input: {}: {}", complaint.path, complaint.message),
    )
}

/// A unit as people write it: `N·m`, `m/s²`.
pub fn unit_words(unit: &str) -> String {
    unit.replace('*', "·").replace("^2", "²")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_mobility_has_words_too() {
        assert_eq!(
            mobility(&Mobility::default()),
            "0 by Grübler, 0 by rank, 0 drivers"
        );
    }
}
