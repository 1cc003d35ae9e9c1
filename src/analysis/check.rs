//! Diagnosis of a model without running it.

use super::Stop;
use super::assembly::{assemble, check_driven, topology};
use crate::error::Complaint;
use crate::model::{AnalysisKind, GROUND, JointKind, Model};
use crate::output::{Mobility, Status};
use crate::system::{Evaluation, Inputs, compile::compile};

/// What `check` finds.
#[derive(Debug, Clone, Default)]
pub struct Check {
    /// `Completed` where the model assembles.
    pub status: Status,
    /// Why it does not.
    pub message: Option<String>,
    /// Moving bodies.
    pub bodies: usize,
    pub joints: usize,
    /// Each as the names of its joints.
    pub loops: Vec<String>,
    pub mobility: Mobility,
    /// Largest constraint residual after assembly, divided by the mechanism's size [–].
    pub assembly_residual: f64,
    /// What each analysis that can't be run lacks; an analysis that is not listed can be run.
    pub missing: Vec<(AnalysisKind, Vec<String>)>,
    pub warnings: Vec<String>,
    /// Faults of the model that do not keep it from being read (exit status 1).
    pub faults: Vec<String>,
}

/// Diagnoses a model.
///
/// # Errors
/// Faults of the input.
pub fn check(model: &Model) -> Result<Check, Vec<Complaint>> {
    let system = compile(&undemanding(model), AnalysisKind::Assembly)?;
    let topology = topology(&system);
    let names: Vec<&str> = system.joints.iter().map(|joint| joint.name.as_str()).collect();
    let mut check = Check {
        bodies: system.bodies.len(),
        joints: system.joints.len(),
        loops: topology.loop_names(&names),
        ..Check::default()
    };
    check.mobility.grubler = topology.mobility();
    check.mobility.drivers = system.drivers.len();
    let unheld: Vec<&str> =
        topology.unheld_bodies().iter().map(|&body| system.bodies[body - 1].name.as_str()).collect();
    if !unheld.is_empty() {
        check.warnings.push(format!("nothing holds {}", unheld.join(", ")));
    }
    let inputs = Inputs::at_time(&system, 0.0);
    let assembled = match assemble(&system, &inputs) {
        Ok(assembled) => assembled,
        Err(Stop::Input(complaints)) => return Err(complaints),
        Err(Stop::Failed { status, message }) => {
            check.status = status;
            check.mobility = super::assembly::counted(&system);
            check.message = Some(message);
            return Ok(check);
        }
    };
    let mut evaluation = Evaluation::new(&system);
    evaluation.set_position(&assembled.q);
    evaluation.eval_phi(&system, &inputs);
    check.assembly_residual = system.scaled_residual(&evaluation.phi);
    check.mobility = assembled.mobility.clone();
    check.warnings.extend(assembled.warnings.iter().cloned());
    let undriven = match check_driven(&system, &assembled, &inputs) {
        Ok(()) => None,
        Err(Stop::Input(complaints)) => complaints.first().map(|complaint| complaint.message.clone()),
        Err(Stop::Failed { message, .. }) => Some(message),
    };
    check.missing = missing(model, undriven.as_deref(), check.mobility.rank as usize);
    Ok(check)
}

/// The model with every clearance ideal: what is diagnosed here does not depend on it.
fn undemanding(model: &Model) -> Model {
    let mut model = model.clone();
    for joint in model.joints.values_mut() {
        match &mut joint.kind {
            JointKind::Revolute { clearance } => *clearance = None,
            JointKind::Prismatic { .. } | JointKind::Slot { .. } | JointKind::Gear { .. } | JointKind::Fixed { .. } => {
            }
        }
    }
    model
}

/// What keeps each analysis from running.
fn missing(model: &Model, undriven: Option<&str>, freedom: usize) -> Vec<(AnalysisKind, Vec<String>)> {
    let mut data = Vec::new();
    for (name, body) in model.bodies.iter().filter(|(name, _)| *name != GROUND) {
        let keys: Vec<&str> = [("mass", body.mass.is_none()), ("inertia", body.inertia.is_none())]
            .iter()
            .filter(|k| k.1)
            .map(|k| k.0)
            .collect();
        if !keys.is_empty() {
            data.push(format!("{} of body \"{name}\"", keys.join(" and ")));
        }
    }
    let drive: Vec<String> = undriven.iter().map(|text| (*text).to_string()).collect();
    let mut inverse = drive.clone();
    inverse.extend(data.iter().cloned());
    let mut dynamics = Vec::new();
    if freedom == model.drivers.len() {
        dynamics.push("every degree of freedom is driven: nothing is free to move".into());
    }
    dynamics.extend(data.iter().cloned());
    let heavy = model.gravity.iter().any(|g| *g != 0.0);
    let statics = model
        .bodies
        .iter()
        .filter(|(name, body)| heavy && *name != GROUND && body.mass.is_none())
        .map(|(name, _)| format!("mass of body \"{name}\""))
        .collect();
    [
        (AnalysisKind::Kinematics, drive),
        (AnalysisKind::InverseDynamics, inverse),
        (AnalysisKind::Dynamics, dynamics),
        (AnalysisKind::Statics, statics),
    ]
    .into_iter()
    .filter(|(_, lacks)| !lacks.is_empty())
    .collect()
}
