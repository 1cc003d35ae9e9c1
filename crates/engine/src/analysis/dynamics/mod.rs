//! Forward dynamics: the motion that forces and masses bring about, with drivers where there are some.
//!
//! A motion is a hybrid system (`simulation`):
//!
//! ```text
//! state         y and its layout: coordinates, bristles, work, sums of contacts
//! flow          the equations between events, in minimal coordinates (see [`crate::mechanism::reduced`])
//! steps         a method of [`crate::integrate`] along the flow; the last step as a function of time
//! modes         phases of contacts, the guards that end them, and what is reset there
//! events        the first guard that becomes positive within a step
//! impulses      impacts, sustained contacts and jams at an instant, by one complementarity problem
//! ledger        episodes, wear and energy of contacts
//! extremes      peaks of all columns between the outputs
//! ```
//!
//! Positions and velocities of all bodies follow from the constraints at every stage, so nothing drifts. Outputs come from the
//! method's continuous extension and are put exactly onto the constraints.

mod begin;
mod ended;
mod events;
mod extremes;
mod fault;
mod flow;
mod impulses;
mod ledger;
mod margins;
mod modes;
mod outputs;
mod paces;
mod parts;
mod passages;
mod sampling;
mod seams;
mod settings;
mod simulation;
mod start;
mod state;
mod steps;
mod switches;
mod words;

use super::assembly::{Assembled, ranked};
use super::branch::singularity;
use super::control::{Control, Stop};
use super::departure::{self, Departure};
use super::ends;
use super::words::{locked, unsure_friction};
use crate::element::pair::{Pair, Surface};
use crate::mechanism::driven::Failure;
use crate::mechanism::parts::Part;
use crate::mechanism::phases::Phases;
use crate::mechanism::reduced::{Reduced, Solver};
use crate::system::{Inputs, System};
use flow::Flow;
use linkdyn_model::error::Complaint;
use linkdyn_output::{Report, Status, Stopwatch, Trajectory};
use outputs::Outputs;
use simulation::Simulation;

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
    let turned = ends::at_this_turn(system, &assembled.q);
    let system = turned.as_ref().unwrap_or(system);
    ends::check_start(system, &assembled.q)?;
    let assembling = clock.read();

    let watch = Stopwatch::start();
    let mut report = Report {
        mobility: assembled.mobility.clone(),
        ..Report::default()
    };
    // It begins with all open that may be; what holds at the start closes there.
    let opened = system.opened();
    let system = opened.as_ref().unwrap_or(system);
    let assembled = match opened {
        Some(_) => ranked(system, assembled, &Inputs::at_time(system, 0.0)),
        None => assembled,
    };
    let departure = departure::free(system, &assembled)?;
    let (assembled, v) = match &departure {
        Some(departure) => {
            let assembled = away(system, assembled, departure);
            report.mobility = assembled.mobility.clone();
            (assembled, departure.v.clone())
        }
        None => (assembled, v),
    };
    let phases = Phases::new(system);
    let parts = parts::parts(system, &assembled);
    let solver = solver(system, &parts, settings);
    let mut reduced = equations(system, &assembled, &v, solver)?;
    reduced.cross(&parts, &phases);
    if let Some(Departure { q, v, .. }) = &departure {
        let left = reduced.begin_at(q, v);
        left.map_err(|_| singular_start())?;
    }
    report.warnings = assembled.warnings;
    let said = departure.and_then(|departure| departure.warning);
    report.warnings.extend(said);
    report.assemble = assembling;
    let end = settings.instants.last().copied().unwrap_or(0.0);
    let flow = Flow::new(&phases, reduced);
    let mut simulation = Simulation::begin(settings, flow, end)?;
    let rows = settings.instants.len();
    let mut outputs = Outputs::new(system, settings.contents, rows, &mut report);
    for &instant in &settings.instants {
        let reached = simulation.reach(instant, control).and_then(|()| {
            let sampled = simulation.output(instant);
            let recorded = sampled.map(|(flow, energy)| outputs.record(flow, energy));
            recorded.map_err(|fault| simulation.ended_at(fault, instant))
        });
        if let Err(ended) = reached {
            outputs.report.status = ended.status;
            outputs.report.message = Some(ended.message);
            outputs.report.reason = ended.reason.map(|reason| *reason);
            break;
        }
    }
    let mut trajectory = outputs.finish();
    report.warnings.extend(unsure_friction(
        system,
        &report.mobility.reactions_not_unique,
    ));
    let peaks = simulation.finish(&mut trajectory, &mut report);
    report.statistics.newton_iterations += assembled.iterations;
    report.solve = watch.read();
    Ok((trajectory, peaks, report))
}

/// The mechanism away from a singular start, on the branch on which it leaves.
fn away(system: &System, assembled: Assembled, departure: &Departure) -> Assembled {
    let q = departure.away.clone();
    ranked(system, Assembled { q, ..assembled }, &departure.inputs)
}

/// Who solves for accelerations, where that is said.
///
/// Where parts have smooth branches, which stand for their joints at times, there are tangents; and so there are where rigid
/// journals come and go as constraints, unless it is said otherwise.
fn solver(system: &System, parts: &[Part], settings: &Settings) -> Option<Solver> {
    let is_rigid = |contact: &Pair| matches!(contact.surface, Surface::Rigid(_));
    let tangents =
        !parts.is_empty() || settings.solver.is_none() && system.contacts.iter().any(is_rigid);
    if tangents {
        Some(Solver::Tangents)
    } else {
        settings.solver
    }
}

/// What forward dynamics can't do.
fn refuse(system: &System) -> Result<(), Stop> {
    if let Some(joint) = system
        .joints
        .iter()
        .find(|joint| joint.clearance().is_some())
    {
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
    solver: Option<Solver>,
) -> Result<Reduced<'s>, Stop> {
    let columns = &assembled.all.free_columns;
    let point = (&assembled.q[..], v, 0.0);
    let reduced = Reduced::new(system, columns, point, solver).map_err(|failure| {
        let massless: Vec<&str> = system
            .bodies
            .iter()
            .filter(|body| body.is_light)
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
                singular_start()
            }
        }
    })?;
    if singularity(system, assembled, &reduced.inputs)?.is_some() {
        return Err(singular_start());
    }
    Ok(reduced)
}

/// What to say of a singular start that can't be left.
fn singular_start() -> Stop {
    Stop::failed(
        Status::Singular,
        "the start is a singular position (the constraints lose rank there), so that more than one motion leads away \
         from it; start a little beside it"
            .into(),
    )
}
