//! What keeps each analysis from running.

use super::clearances::{clearances, journals_move};
use super::found::{ANALYSES, Lack, Undriven};
use linkdyn_model::{AnalysisKind, GROUND, Model};

/// Data that bodies lack, and for what.
pub fn lacks(model: &Model) -> Vec<Lack> {
    let heavy = model.gravity.iter().any(|g| *g != 0.0);
    let linked = clearances(model).next().is_some();
    let mut lacks: Vec<Lack> = Vec::new();
    for (name, body) in model.bodies.iter().filter(|(name, _)| *name != GROUND) {
        let keys = [
            ("mass", body.mass.is_none()),
            ("inertia", body.inertia.is_none()),
        ];
        let keys: Vec<&str> = keys
            .iter()
            .filter(|(_, lacks)| *lacks)
            .map(|(key, _)| *key)
            .collect();
        if keys.is_empty() {
            continue;
        }
        if let Some(same) = lacks.iter_mut().find(|lack| lack.keys == keys) {
            same.bodies.push(name.clone());
            continue;
        }
        let statics = heavy && keys.contains(&"mass");
        let analyses = [
            // The direction of a massless link is that of a force; a journal in contact moves by forces.
            (AnalysisKind::Kinematics, linked),
            (AnalysisKind::InverseDynamics, true),
            (AnalysisKind::Dynamics, true),
            (AnalysisKind::Statics, statics),
        ];
        let analyses = analyses
            .into_iter()
            .filter(|(_, needs)| *needs)
            .map(|(kind, _)| kind)
            .collect();
        lacks.push(Lack {
            bodies: vec![name.clone()],
            keys,
            analyses,
        });
    }
    lacks
}

/// What keeps each analysis from running.
pub fn missing(
    model: &Model,
    undriven: Option<&Undriven>,
    lacks: &[Lack],
    freedom: usize,
) -> Vec<(AnalysisKind, Vec<String>)> {
    let of = |kind: AnalysisKind| {
        let mut missing = Vec::new();
        match (kind, undriven) {
            (
                AnalysisKind::Kinematics | AnalysisKind::InverseDynamics,
                Some(Undriven::TooFew(text) | Undriven::TooMany(text) | Undriven::Singular(text)),
            ) => missing.push(text.clone()),
            (AnalysisKind::Dynamics, _)
                if freedom == model.drivers.len() && !journals_move(model) =>
            {
                missing.push("every degree of freedom is driven: nothing is free to move".into());
            }
            (
                AnalysisKind::Dynamics | AnalysisKind::Statics | AnalysisKind::QuasiStatics,
                Some(Undriven::TooMany(text)),
            )
            | (AnalysisKind::QuasiStatics, Some(Undriven::Singular(text))) => {
                missing.push(text.clone())
            }
            (AnalysisKind::Kinematics | AnalysisKind::InverseDynamics, None)
            | (
                AnalysisKind::Assembly
                | AnalysisKind::Dynamics
                | AnalysisKind::Statics
                | AnalysisKind::QuasiStatics,
                _,
            ) => {}
        }
        if matches!(kind, AnalysisKind::Statics | AnalysisKind::QuasiStatics) {
            missing.extend(
                clearances(model)
                    .map(|(name, _)| format!("an ideal clearance of joint \"{name}\"")),
            );
        }
        for lack in lacks.iter().filter(|lack| lack.analyses.contains(&kind)) {
            // At rest nothing is turned.
            let keys = if kind == AnalysisKind::Statics {
                "mass".to_string()
            } else {
                lack.keys.join(" and ")
            };
            missing.extend(
                lack.bodies
                    .iter()
                    .map(|body| format!("{keys} of body \"{body}\"")),
            );
        }
        (kind, missing)
    };
    ANALYSES
        .map(of)
        .into_iter()
        .filter(|(_, missing)| !missing.is_empty())
        .collect()
}
