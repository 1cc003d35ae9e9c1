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
mod scene;
mod seams;
mod settings;
mod simulation;
mod start;
mod state;
mod stepped;
mod steps;
mod switches;
mod words;

use super::control::{Control, Stop};
use super::words::unsure_friction;
use crate::element::pair::Hold;
use crate::system::{Inputs, System};
use linkdyn_output::{Report, Trajectory};
use outputs::Outputs;
use scene::Scene;
use std::borrow::Cow;

pub use settings::{Exactness, Settings};
pub use start::Start;
pub use stepped::{Snapshot, Stepped};

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
    let scene = Scene::new(Cow::Borrowed(system), start)?;
    let system = scene.system();
    let mut report = Report {
        mobility: scene.mobility.clone(),
        warnings: scene.warnings.clone(),
        assemble: scene.assembling,
        ..Report::default()
    };
    let end = settings.instants.last().copied().unwrap_or(0.0);
    let mut simulation = scene.begin(settings, end)?;
    let mut outputs = Outputs::new(system, settings, &mut report);
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
    report.statistics.newton_iterations += scene.assembled.iterations;
    report.solve = scene.watch.read();
    Ok((trajectory, peaks, report))
}

/// A point of a motion, with what holds there.
pub struct Visited<'v> {
    /// The mechanism with the rows in force.
    pub system: &'v System,
    /// Columns of its independent coordinates.
    pub columns: Vec<usize>,
    /// Coordinates and their rates (n).
    pub q: &'v [f64],
    pub v: &'v [f64],
    /// What is prescribed, and what contacts and states are.
    pub inputs: Inputs,
    /// How contacts are held.
    pub holds: Vec<Hold>,
    /// \[s\]
    pub time: f64,
}

/// Goes along a motion and calls `told` at instants that come one after the other; what `told` cannot do ends it.
///
/// # Errors
/// Faults of the input, a start that is impossible, and where the motion can't go on.
pub fn visit<E>(
    system: &System,
    start: Start,
    settings: &Settings,
    times: &[f64],
    control: &Control,
    told: &mut dyn FnMut(Visited) -> Result<(), E>,
) -> Result<Result<(), E>, Stop> {
    let scene = Scene::new(Cow::Borrowed(system), start)?;
    let end = settings.instants.last().copied().unwrap_or(0.0);
    let mut simulation = scene.begin(settings, end)?;
    for &time in times {
        simulation.reach(time, control)?;
        if let Err(fault) = simulation.output(time) {
            return Err(simulation.ended_at(fault, time).into());
        }
        let flow = &mut simulation.flow;
        let holds = flow.holds();
        let system = flow.equations.own_system();
        let equations = &flow.equations;
        let visited = Visited {
            system,
            columns: equations.independent_columns().collect(),
            q: equations.position(),
            v: equations.velocity(),
            inputs: equations.inputs.clone(),
            holds,
            time,
        };
        if let Err(failed) = told(visited) {
            return Ok(Err(failed));
        }
    }
    Ok(Ok(()))
}
