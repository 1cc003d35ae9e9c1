//! Forward dynamics: the motion that forces and masses bring about, with drivers where there are some.
//!
//! Integrated are minimal coordinates (see [`crate::mechanism::reduced`] and [`motion`]), by a method of [`crate::integrate`];
//! positions and velocities of everything else follow from the constraints at every stage, so nothing drifts. Outputs come
//! from the method's continuous extension and are put exactly onto the constraints.
//!
//! Joints with clearance by contact are open: journals fly and press (`contact`), and the instants at which they begin
//! and cease to are located within the steps (`integration`).

mod closer;
mod contact;
mod episodes;
mod impact;
mod integration;
mod jam;
mod locate;
mod look;
pub mod motion;
mod outputs;
mod parts;
mod peaks;
mod sampling;
mod start;
mod variants;
mod watch;
mod within;
mod words;

use super::assembly::Assembled;
use super::branch::singularity;
use super::channels::Contents;
use super::instants::instants;
use super::{Control, Stop, locked, unsure_friction};
use crate::integrate::Method;
use crate::mechanism::driven::Failure;
use crate::mechanism::reduced::Reduced;
use crate::system::System;
use closer::Looking;
use integration::Integration;
use linkdyn_model::error::Complaint;
use linkdyn_model::{Analysis, Model, OutputsAt, Solver};
use linkdyn_output::{Report, Status, Stopwatch, Trajectory};
use motion::Motion;
use outputs::Outputs;
use variants::Variants;

/// Runs the analysis: the outputs, and rows of peaks between them.
///
/// # Errors
/// Faults of the input, and a start that is impossible.
pub fn run(
    model: &Model,
    system: &System,
    analysis: &Analysis,
    contents: Contents,
    control: &Control,
) -> Result<(Trajectory, Trajectory, Report), Stop> {
    let watch = Stopwatch::start();
    let (assembled, v) = start::start(model, system)?;
    if assembled.all.rank == system.n() {
        // Nothing is free: the motion is that of the drivers.
        let (trajectory, report) = super::driven::run(system, analysis, control)?;
        return Ok((trajectory, Trajectory::default(), report));
    }
    refuse(system, analysis)?;
    let method = method(&analysis.solver)?;
    let assembling = watch.read();

    let watch = Stopwatch::start();
    let variants = Variants::new(model);
    let mut reduced = start(system, &assembled, &v)?;
    if !reduced.has_curve() {
        let parts = parts::parts(&variants, system, &assembled.q);
        reduced.cross(parts, variants.rewrite(&[]));
    }
    let mut motion = Motion::new(&variants, reduced);
    let mut report = Report {
        mobility: assembled.mobility,
        warnings: assembled.warnings,
        ..Report::default()
    };
    report.assemble = assembling;
    let instants = instants(system, analysis).map_err(Stop::Input)?;
    let end = instants.last().map_or(0.0, |last| last.time);
    let mut solver = Integration::new(method, &analysis.solver, &mut motion, end)?;
    if !system.contacts.is_empty() {
        let all = analysis.outputs_at == OutputsAt::Events;
        solver.looking = Some(Box::new(Looking::new(
            &motion,
            contents,
            &analysis.columns,
            all,
        )));
        solver.watch_from(&mut motion, 0.0);
    }
    let mut outputs = Outputs::new(system, contents, instants.len(), &mut report);
    for instant in &instants {
        if let Err((status, message)) = solver.reach(&mut motion, instant.time, control) {
            outputs.report.status = status;
            outputs.report.message = Some(message);
            break;
        }
        if let Err(failure) = outputs.record(&mut solver, &mut motion, instant.time) {
            outputs.report.status = Status::Singular;
            outputs.report.message = Some(match failure {
                Failure::Locked { force } => format!(
                    "at t = {} {}; the rows until there are kept",
                    system.display.time(instant.time),
                    locked(system, force)
                ),
                Failure::Singular | Failure::Diverged { .. } | Failure::Inconsistent { .. } => {
                    format!(
                        "the position at t = {} can't be solved",
                        system.display.time(instant.time)
                    )
                }
            });
            break;
        }
    }
    let mut trajectory = outputs.finish();
    let peaks = solver
        .looking
        .take()
        .map(|looking| looking.finish(&mut trajectory))
        .unwrap_or_default();
    report.warnings.extend(unsure_friction(
        system,
        &report.mobility.reactions_not_unique,
    ));
    report.warnings.extend(motion.reduced.passed_change_point().map(|time| {
        format!(
            "at t = {} or a little before the motion passes a change point: friction from reactions that have no bound \
             there may hold or brake the mechanism more than the steps see",
            system.display.time(time)
        )
    }));
    solver.account(&motion, &mut report);
    let done = motion.reduced.driven.done;
    report.statistics.newton_iterations += done.newton_iterations + assembled.iterations;
    report.statistics.factorisations += done.factorisations;
    report.solve = watch.read();
    Ok((trajectory, peaks, report))
}

/// What forward dynamics can't do.
fn refuse(system: &System, analysis: &Analysis) -> Result<(), Stop> {
    if analysis.sample.is_some() && system.contacts.is_empty() {
        return Err(Stop::Input(vec![
            Complaint::new(
                "analysis.sample",
                "outputs at driver values need a motion that is prescribed",
            )
            .hint("give \"end\" and \"outputs\" instead"),
        ]));
    }
    if let Some(joint) = system.joints.iter().find(|joint| joint.clearance.is_some()) {
        return Err(Stop::Input(vec![
            Complaint::new(
                format!("joints.{}.clearance.model", joint.name),
                "a massless clearance link takes its direction from the force of the instant, which leaves a mechanism that \
                 is free to move without a well-defined motion",
            )
            .hint("use \"ideal\" or a model of contact, or let drivers prescribe the whole motion"),
        ]));
    }
    Ok(())
}

fn method(solver: &Solver) -> Result<Method, Stop> {
    solver
        .method
        .parse()
        .map_err(|unknown: crate::integrate::UnknownMethod| {
            Stop::Input(vec![Complaint::new(
                "analysis.solver.method",
                unknown.to_string(),
            )])
        })
}

/// The equations of motion at the assembled state.
fn start<'s>(system: &'s System, assembled: &Assembled, v: &[f64]) -> Result<Reduced<'s>, Stop> {
    let singular = || {
        Stop::failed(
            Status::Singular,
            "the start is a singular position (the constraints lose rank there), so that more than one motion leads away \
             from it; start a little beside it"
                .into(),
        )
    };
    let columns = &assembled.all.free_columns;
    let reduced = Reduced::new(system, columns, &assembled.q, v, 0.0).map_err(|failure| {
        let massless: Vec<&str> = system
            .bodies
            .iter()
            .filter(|body| body.mass == Some(0.0) || body.inertia == Some(0.0))
            .map(|body| body.name.as_str())
            .collect();
        match failure {
            Failure::Singular if !massless.is_empty() => Stop::Input(vec![
                Complaint::new(
                    "bodies",
                    format!(
                        "something free to move has neither mass nor inertia (without: {})",
                        massless.join(", ")
                    ),
                )
                .hint("give mass and inertia to what the joints leave free"),
            ]),
            Failure::Locked { force } => Stop::failed(
                Status::Singular,
                format!("at the start {}", locked(system, force)),
            ),
            Failure::Singular | Failure::Diverged { .. } | Failure::Inconsistent { .. } => {
                singular()
            }
        }
    })?;
    if singularity(system, assembled, &reduced.inputs)?.is_some() {
        return Err(singular());
    }
    Ok(reduced)
}
