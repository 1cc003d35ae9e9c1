//! Which instants are wanted, and what is transmitted.

use super::Rules;
use crate::analysis::MOST_OUTPUTS;
use crate::error::Complaint;
use crate::tree::word;
use crate::{Analysis, AnalysisKind, GROUND, OutputsAt, Sample, Transmission};

/// All rules of the analysis.
pub(super) fn analysis(rules: &mut Rules<'_>) {
    let Some(analysis) = rules.model.analysis.as_ref() else {
        return;
    };
    if rules.holes.has("analysis") {
        return;
    }
    if let Some(wanted) = &analysis.transmission {
        transmission(rules, wanted);
    }
    if !rules.holes.has("analysis.type") {
        instants(rules, analysis);
    }
    if let Some(wanted) = &analysis.sample {
        sample(rules, wanted);
    }
}

/// A transmission leads from one driver to a body that moves.
fn transmission(rules: &mut Rules<'_>, transmission: &Transmission) {
    let path = "analysis.transmission";
    if rules.holes.has(path) {
        return;
    }
    let output = format!("{path}.output");
    if transmission.output == GROUND && !rules.holes.has(&output) {
        let message = "ground is fixed, nothing is transmitted to it";
        rules.complaints.push(Complaint::new(output, message));
    }
    let drivers = rules.model.drivers.len();
    if transmission.driver.is_none() && drivers != 1 {
        let message = format!("\"driver\" is missing, the model has {drivers} of them");
        let hint = "name the driver from which the transmission leads";
        rules.complain(path, message, hint);
    }
}

/// Not more samples than fit.
fn sample(rules: &mut Rules<'_>, sample: &Sample) {
    let known = |key: &str| !rules.holes.has(&format!("analysis.sample.{key}"));
    let Sample { from, to, step, .. } = sample;
    if ["from", "to", "step"].into_iter().all(known)
        && ((to - from) / step).abs() > MOST_OUTPUTS as f64
    {
        let message = format!("more than {MOST_OUTPUTS} outputs between \"from\" and \"to\"");
        rules.complain("analysis.sample.step", message, "take a larger step");
    }
}

/// Exactly one way to say which instants are wanted.
fn instants(rules: &mut Rules<'_>, analysis: &Analysis) {
    let needed = match analysis.kind {
        AnalysisKind::Assembly | AnalysisKind::Statics => false,
        AnalysisKind::Kinematics
        | AnalysisKind::InverseDynamics
        | AnalysisKind::Dynamics
        | AnalysisKind::QuasiStatics => true,
    };
    if !needed
        && analysis.outputs_at == OutputsAt::Events
        && !rules.holes.has("analysis.outputs_at")
    {
        let message = format!("{} has one instant and no events", word(&analysis.kind));
        let hint = "leave it out, or choose an analysis of a motion";
        rules.complain("analysis.outputs_at", message, hint);
    }
    let given = (
        analysis.end.is_some(),
        analysis.outputs.is_some(),
        analysis.sample.is_some(),
    );
    let (path, message, hint) = match given {
        (true, _, true) => (
            "analysis.end",
            "\"end\" and \"sample\" exclude each other",
            "keep one of them",
        ),
        (false, true, true) => (
            "analysis.outputs",
            "\"outputs\" and \"sample\" exclude each other",
            "keep one of them",
        ),
        (true, false, false) if needed => (
            "analysis",
            "\"outputs\" is missing",
            "the number of output instants, both ends included",
        ),
        (false, true, false) if needed => (
            "analysis",
            "\"end\" is missing",
            "the end time, the start is 0",
        ),
        (false, false, false) if needed => (
            "analysis",
            "it is not said for which instants",
            "give \"end\" and \"outputs\", or \"sample\"",
        ),
        (true, true, false) | (_, _, false) | (false, false, true) => return,
    };
    rules.complain(path, message, hint);
}
