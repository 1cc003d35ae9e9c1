//! Diagnosis of a model without running it.

mod clearances;
mod found;
mod lacks;
mod odd;
mod words;

pub use found::{Check, Lack, Open};

use super::assembly::{Assembled, assemble, check_driven, ranked, too_short, topology};
use super::control::Stop;
use super::instants::{Instants, Sampled};
use super::question::instants;
use super::run::Prepared;
use super::suspicious;
use super::words::listed;
use crate::graph::Topology;
use crate::system::{Evaluation, Inputs, System, compile::compile, compile::compile_geometry};
use clearances::{clearances, is_open, journals_move};
use found::Undriven;
use lacks::{lacks, missing};
use linkdyn_model::error::{Complaint, Complaints};
use linkdyn_model::{AnalysisKind, Checked, Model};
use linkdyn_output::Status;
use odd::{odd_springs, turned_over};
use words::{freedom_text, words};

/// Diagnoses a model, and goes with its own analysis as far as the first instant, as `run` does.
///
/// # Errors
/// Faults of the input that leave nothing to diagnose.
pub fn check(model: &Checked) -> Result<Check, Complaints> {
    let admitted = admit(model);
    let mut check = match (diagnose(model), &admitted) {
        (Ok(check), _) => check,
        (Err(_), Err(Stop::Input(refused))) => return Err(refused.clone().into()),
        (Err(complaints), _) => return Err(complaints),
    };
    match admitted {
        Err(Stop::Input(refused)) => check.refused = refused,
        Err(Stop::Failed { status, message }) if check.status == Status::Completed => {
            check.status = status;
            check.message = Some(message);
        }
        Ok(()) | Err(Stop::Failed { .. }) => {}
    }
    Ok(check)
}

/// Whether the model's own analysis, where it has one, comes to its first instant.
fn admit(model: &Checked) -> Result<(), Stop> {
    if model.analysis.is_none() {
        return Ok(());
    }
    let prepared = Prepared::new(model).map_err(|complaints| Stop::Input(complaints.0))?;
    prepared.admit()
}

fn diagnose(model: &Checked) -> Result<Check, Complaints> {
    let mut system = compile(&model.with_clearances(|_| false), AnalysisKind::Assembly)?;
    let topology = topology(&system);
    let names: Vec<&str> = system
        .joints
        .iter()
        .map(|joint| joint.name.as_str())
        .collect();
    let mut check = Check {
        bodies: system.bodies.len(),
        joints: system.joints.len(),
        loops: topology.loop_names(&names),
        loop_bodies: topology
            .loops()
            .iter()
            .map(|one| moving_names(&system, &one.bodies))
            .collect(),
        loop_joints: topology
            .loops()
            .iter()
            .map(|one| one.joints.iter().map(|&joint| names[joint].to_string()))
            .map(Iterator::collect)
            .collect(),
        ..Check::default()
    };
    check.mobility.grubler = topology.mobility();
    check.mobility.drivers = system.drivers.len();
    check.suspicious.extend(unheld(&system, &topology));
    let end = end_of_run(model, &system)?;
    check.suspicious.extend(
        end.into_iter()
            .flat_map(|end| suspicious::tables(model, end)),
    );
    let inputs = Inputs::at_time(&system, 0.0);
    if journals_move(model) && matches!(assemble(&system, &inputs), Err(Stop::Failed { .. })) {
        // Journals that move may have places that ideal pins do not allow.
        system.initial.clear();
    }
    let assembled = match assemble(&system, &inputs) {
        Ok(assembled) => assembled,
        Err(Stop::Input(complaints)) => return Err(complaints.into()),
        Err(Stop::Failed { status, message }) => {
            check.status = status;
            check.mobility = super::assembly::counted(&system);
            check.message = Some(message);
            check.assembly_residual = f64::NAN;
            check.words = format!(
                "{}; it can't be assembled",
                freedom_text(check.mobility.rank)
            );
            return Ok(check);
        }
    };
    let mut evaluation = Evaluation::new(&system);
    evaluation.set_position(&assembled.q);
    evaluation.eval_phi(&system, &inputs);
    check.assembly_residual = system.scaled_residual(&evaluation.phi);
    check.mobility = assembled.mobility.clone();
    check.warnings.extend(assembled.warnings.iter().cloned());
    let q = assembled.q.clone();
    let names = system.bodies.iter().map(|body| body.name.clone());
    check.poses = names.zip(system.frames(&q)).collect();
    let undriven = if journals_move(model) {
        let (open, undriven) = open(model, assembled)?;
        check.open = Some(open);
        undriven
    } else {
        undriven(&system, &assembled, &inputs)
    };
    check.lacks = lacks(model);
    check.missing = missing(
        model,
        undriven.as_ref(),
        &check.lacks,
        check.mobility.rank as usize,
    );
    check.words = words(model, undriven.as_ref(), &check);
    check.suspicious.extend(turned_over(model, &system, &q));
    check.suspicious.extend(odd_springs(model, &system, &q));
    Ok(check)
}

/// Bodies that no joint holds.
fn unheld(system: &System, topology: &Topology) -> Option<Complaint> {
    let unheld: Vec<&str> = topology
        .unheld_bodies()
        .iter()
        .map(|&body| system.bodies[body - 1].name.as_str())
        .collect();
    let first = unheld.first()?;
    let others = if unheld.len() > 1 {
        format!(", nor {}", listed(&unheld[1..], ", "))
    } else {
        String::new()
    };
    let message = format!("no joint holds it{others}");
    let hint = "connect it by a joint or take it out, unless it is to move freely";
    Some(Complaint::new(format!("bodies.{first}"), message).hint(hint))
}

/// Why the drivers do not prescribe the motion.
fn undriven(system: &System, assembled: &Assembled, inputs: &Inputs) -> Option<Undriven> {
    match check_driven(system, assembled, inputs) {
        Ok(()) => None,
        Err(Stop::Input(complaints)) => complaints.first().map(|complaint| {
            let message = complaint.message.clone();
            if complaint.message.starts_with("too many") {
                Undriven::TooMany(message)
            } else {
                Undriven::TooFew(message)
            }
        }),
        Err(Stop::Failed { message, .. }) => Some(Undriven::Singular(message)),
    }
}

/// The mechanism with its journals free, at the position that it has with ideal pins, as a run has it. Its motion is
/// integrated whatever the analysis, so that only too many drivers are in the way.
fn open(model: &Checked, closed: Assembled) -> Result<(Open, Option<Undriven>), Complaints> {
    let system = compile_geometry(&model.with_clearances(is_open))?;
    if let Some(complaint) = too_short(&system) {
        return Err(complaint.into());
    }
    let inputs = Inputs::at_time(&system, 0.0);
    let assembled = ranked(&system, closed, &inputs);
    let undriven =
        undriven(&system, &assembled, &inputs).filter(|why| matches!(why, Undriven::TooMany(_)));
    let joints = clearances(model)
        .filter(|(_, model)| is_open(*model))
        .map(|(name, _)| name.to_string())
        .collect();
    Ok((
        Open {
            joints,
            mobility: assembled.mobility,
        },
        undriven,
    ))
}

/// When the run that the model asks for ends \[s\]; where a driver is sampled, it must pass the first and the last value, in this order.
fn end_of_run(model: &Model, system: &System) -> Result<Option<f64>, Complaints> {
    let Some(analysis) = &model.analysis else {
        return Ok(None);
    };
    if matches!(
        analysis.kind,
        AnalysisKind::Assembly | AnalysisKind::Statics
    ) {
        return Ok(None);
    }
    let ends = match instants(system, analysis)? {
        Instants::Start | Instants::Equidistant(_) => return Ok(analysis.end),
        Instants::Sampled(sample) => {
            let whole = sample.to - sample.from;
            Instants::Sampled(Sampled {
                step: if whole == 0.0 { sample.step } else { whole },
                ..sample
            })
        }
    };
    let instants = ends.list(system)?;
    Ok(instants.last().map(|last| last.time))
}

fn moving_names(system: &System, bodies: &[usize]) -> Vec<String> {
    bodies
        .iter()
        .filter(|&&body| body > 0)
        .map(|&body| system.bodies[body - 1].name.clone())
        .collect()
}
