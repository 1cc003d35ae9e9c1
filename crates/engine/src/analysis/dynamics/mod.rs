//! Forward dynamics: the motion that forces and masses bring about, with drivers where there are some.
//!
//! Integrated are minimal coordinates (see [`crate::mechanism::reduced`] and [`motion`]), by a method of [`crate::integrate`];
//! positions and velocities of everything else follow from the constraints at every stage, so nothing drifts. Outputs come
//! from the method's continuous extension and are put exactly onto the constraints.
//!
//! Joints with clearance by contact are open: journals fly and press (`contact`), and the instants at which they begin
//! and cease to are located within the steps (`integration`).

mod account;
mod closer;
mod contact;
mod ended;
mod episodes;
mod fault;
mod following;
mod history;
mod impact;
mod integration;
mod jam;
mod locate;
mod look;
mod looking;
mod margins;
pub mod motion;
mod outputs;
mod parts;
mod peaks;
mod point;
mod quantities;
mod sampling;
mod settings;
mod settle;
mod start;
mod tolerance;
mod watch;
mod within;
mod words;

use super::assembly::Assembled;
use super::branch::singularity;
use super::control::{Control, Stop};
use super::words::{locked, unsure_friction};
use crate::mechanism::driven::Failure;
use crate::mechanism::phases::Phases;
use crate::mechanism::reduced::Reduced;
use crate::system::System;
use ended::Ended;
use integration::Integration;
use linkdyn_model::error::Complaint;
use linkdyn_output::{Report, Status, Stopwatch, Trajectory};
use looking::Looking;
use motion::Motion;
use outputs::Outputs;

pub use settings::{Settings, Wanted};
pub use start::Start;

/// Runs a motion from its start: the outputs, and rows of peaks between them.
///
/// # Errors
/// Faults of the input, and a start that is impossible.
pub fn run(
    system: &System,
    start: Start,
    settings: &Settings,
    control: &Control,
) -> Result<(Trajectory, Trajectory, Report), Stop> {
    let Start {
        assembled,
        v,
        clock,
    } = start;
    refuse(system)?;
    let assembling = clock.read();

    let watch = Stopwatch::start();
    let phases = Phases::new(system);
    let mut reduced = equations(system, &assembled, &v)?;
    let parts = if reduced.has_curve() {
        Vec::new()
    } else {
        parts::parts(system, &assembled.q)
    };
    reduced.cross(&parts, &phases);
    let mut motion = Motion::new(&phases, reduced);
    let mut report = Report {
        mobility: assembled.mobility,
        warnings: assembled.warnings,
        ..Report::default()
    };
    report.assemble = assembling;
    let end = settings.instants.last().copied().unwrap_or(0.0);
    let mut solver = Integration::new(settings, &mut motion, end)?;
    if !system.contacts.is_empty() {
        solver.looking = Some(Box::new(Looking::new(&motion, settings)));
        solver.watch_from(&mut motion, 0.0);
    }
    let rows = settings.instants.len();
    let mut outputs = Outputs::new(system, settings.contents, rows, &mut report);
    for &instant in &settings.instants {
        let reached = solver.reach(&mut motion, instant, control).and_then(|()| {
            let recorded = outputs.record(&mut solver, &mut motion, instant);
            recorded.map_err(|fault| Ended::at_output(&mut motion, fault, instant))
        });
        if let Err(ended) = reached {
            outputs.report.status = ended.status;
            outputs.report.message = Some(ended.message);
            outputs.report.reason = ended.reason.map(|reason| *reason);
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
fn refuse(system: &System) -> Result<(), Stop> {
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

/// The equations of motion at the assembled state.
fn equations<'s>(
    system: &'s System,
    assembled: &Assembled,
    v: &[f64],
) -> Result<Reduced<'s>, Stop> {
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
