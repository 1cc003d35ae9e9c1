//! From a model to a trajectory and a report.

use super::channels::Channels;
use super::contents::{contents, settings};
use super::control::{Control, Stop};
use super::outcome::Outcome;
use super::record::Recorder;
use super::sample::Sample;
use super::{assembly, driven, question, statics};
use crate::system::{Evaluation, Inputs, System, compile::compile};
use linkdyn_model::error::Complaint;
use linkdyn_model::{AnalysisKind, Checked, unheld};
use linkdyn_output::{Column, Quality, Report, Stopwatch, Trajectory};
use std::sync::Arc;

/// Runs the model's analysis.
///
/// # Errors
/// Faults of the input: no analysis, a clearance model that the analysis has no place for, missing data, too few or too
/// many drivers. Everything else ends in the report's status, with what was computed until then.
pub fn run(model: &Checked, control: &Control) -> Result<Outcome, Vec<Complaint>> {
    let Some(analysis) = &model.analysis else {
        return Err(vec![Complaint::new("analysis", "the model says no analysis to run").hint(
            "add \"analysis\": { \"type\": \"kinematics\", \"end\": 1, \"outputs\": 101 }, or use `linkdyn check`",
        )]);
    };
    // Data or drivers may be missing only because the fixed body has another name.
    let loose = |mut complaints: Vec<Complaint>| {
        complaints.extend(unheld(model));
        complaints
    };
    let system = compile(model, analysis.kind).map_err(loose)?;
    let without_peaks = |(trajectory, report)| (trajectory, Trajectory::default(), report);
    let outcome = match analysis.kind {
        AnalysisKind::Assembly => run_assembly(&system).map(without_peaks),
        // Journals that move freely in their bearings leave the mechanism free to move, however it is driven.
        AnalysisKind::Kinematics | AnalysisKind::InverseDynamics if system.contacts.is_empty() => {
            driven::run(&system, analysis, control).map(without_peaks)
        }
        AnalysisKind::Kinematics | AnalysisKind::InverseDynamics | AnalysisKind::Dynamics => {
            question::run(&system, analysis, contents(analysis.kind), control)
        }
        AnalysisKind::Statics => statics::run(&system, control).map(without_peaks),
    };
    let (trajectory, peaks, mut report) = match outcome {
        Ok(found) => found,
        Err(Stop::Input(complaints)) => return Err(loose(complaints)),
        Err(Stop::Failed { status, message }) => {
            let trajectory = Recorder::new(&system, contents(analysis.kind), 0).trajectory;
            // Of no position there is no residual.
            let quality = Quality {
                constraint_residual: f64::NAN,
                ..Quality::default()
            };
            let mobility = assembly::counted(&system);
            without_peaks((
                trajectory,
                Report {
                    status,
                    message: Some(message),
                    mobility,
                    quality,
                    ..Report::default()
                },
            ))
        }
    };
    let (selected, warnings) = trajectory.select(&analysis.columns);
    report.warnings.extend(warnings);
    let (trajectory, complete) = match selected {
        Some(selected) => (selected, Some(trajectory)),
        None => (trajectory, None),
    };
    Ok(Outcome {
        trajectory,
        complete,
        peaks,
        report,
        settings: settings(analysis),
    })
}

/// The columns of the results of the model's analysis, without running it; none where it says no analysis.
///
/// # Errors
/// Faults of the input that come up when it is compiled.
pub fn columns(model: &Checked) -> Result<Arc<[Column]>, Vec<Complaint>> {
    let Some(analysis) = &model.analysis else {
        return Ok(Arc::new([]));
    };
    let system = compile(model, analysis.kind)?;
    let channels = Channels::new(&system, contents(analysis.kind));
    Ok(Arc::clone(channels.columns()))
}

/// The position at t = 0, with the velocities of least kinetic energy.
fn run_assembly(system: &System) -> Result<(Trajectory, Report), Stop> {
    let clock = Stopwatch::start();
    let inputs = Inputs::at_time(system, 0.0);
    let assembled = assembly::assemble(system, &inputs)?;
    let mut sample = Sample::new(system);
    sample.v = assembly::velocities(system, &assembled.q, &inputs)?;
    sample.q = assembled.q;
    let mut evaluation = Evaluation::new(system);
    evaluation.set_position(&sample.q);
    evaluation.set_velocity(&sample.v);
    evaluation.eval_phi(system, &inputs);
    let mut recorder = Recorder::new(system, contents(AnalysisKind::Assembly), 1);
    recorder.push(system, &evaluation, &inputs, &sample);
    let mut report = Report {
        mobility: assembled.mobility,
        warnings: assembled.warnings,
        ..Report::default()
    };
    report.statistics.newton_iterations = assembled.iterations;
    report.quality.constraint_residual = system.scaled_residual(&evaluation.phi);
    report.assemble = clock.read();
    Ok((recorder.trajectory, report))
}
