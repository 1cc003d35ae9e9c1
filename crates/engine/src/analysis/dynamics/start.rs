//! Where a motion starts: with open joints closed, unless initial values say otherwise.

use crate::analysis::assembly::{Assembled, assemble, ranked, velocities, velocities_near};
use crate::analysis::control::Stop;
use crate::analysis::departure;
use crate::mechanism::closing::close;
use crate::system::{Block, Inputs, System};
use linkdyn_output::Stopwatch;

/// Where a motion starts.
pub struct Start {
    pub(super) assembled: Assembled,
    pub(super) v: Vec<f64>,
    /// What it took to get there.
    pub(super) clock: Stopwatch,
}

impl Start {
    /// Position and velocities at t = 0.
    ///
    /// # Errors
    /// What can't be assembled, and initial values that conflict.
    pub fn of(system: &System) -> Result<Start, Stop> {
        let clock = Stopwatch::start();
        let (assembled, v) = start(system)?;
        Ok(Start {
            assembled,
            v,
            clock,
        })
    }

    /// Whether nothing is free: the motion is that of the drivers.
    pub fn is_driven(&self, system: &System) -> bool {
        self.assembled.all.rank == system.n() || departure::is_driven(system, &self.assembled)
    }
}

/// Position and velocities at t = 0.
///
/// Journals start in the centres of their bearings with the velocities of ideal joints. Initial values that ideal joints do
/// not allow are met by the nearest position, and velocities, of the open mechanism.
///
/// # Errors
/// What can't be assembled, and initial values that conflict.
fn start(system: &System) -> Result<(Assembled, Vec<f64>), Stop> {
    let inputs = Inputs::at_time(system, 0.0);
    if !system.has_journals() {
        let assembled = assemble(system, &inputs)?;
        let v = velocities(system, &assembled.q, &inputs)?;
        return Ok((assembled, v));
    }
    let closed = system.closed();
    let closed_inputs = Inputs::at_time(&closed, 0.0);
    let blocks: Vec<&Block> = closed.blocks.iter().chain(&closed.initial).collect();
    let met = close(&closed, &blocks, &closed.guess, &closed_inputs).converged;
    if met || system.initial.is_empty() {
        let ideal = assemble(&closed, &closed_inputs)?;
        let open = ranked(system, ideal, &inputs);
        let v = match velocities(&closed, &open.q, &closed_inputs) {
            Ok(v) => v,
            // Rates that ideal joints do not allow.
            Err(_) => beside(&closed, system, &open.q, &open.q)?,
        };
        return Ok((open, v));
    }
    // Positions that ideal joints do not allow: the open mechanism from the ideal assembly without them.
    let mut free = closed.clone();
    free.initial.clear();
    let ideal = assemble(&free, &closed_inputs)?;
    let mut open = system.clone();
    open.guess.clone_from(&ideal.q);
    let assembled = assemble(&open, &inputs)?;
    let v = beside(&closed, system, &ideal.q, &assembled.q)?;
    Ok((assembled, v))
}

/// Velocities of the open mechanism at `q`, with the initial ones, nearest to those of ideal joints at `ideal`.
fn beside(closed: &System, open: &System, ideal: &[f64], q: &[f64]) -> Result<Vec<f64>, Stop> {
    let (closed_inputs, inputs) = (Inputs::at_time(closed, 0.0), Inputs::at_time(open, 0.0));
    let near = velocities_near(closed, ideal, &closed_inputs, false, None)?;
    velocities_near(open, q, &inputs, true, Some(&near))
}
