//! Why a mechanism does not assemble, or by which way it does.

use super::beside::close_from_beside;
use super::closed_position::ClosedPosition;
use super::determined::over_driven;
use super::mobility::topology;
use super::overlap;
use super::ranks::ranks;
use super::way::{PathEnd, from_drawing};
use crate::analysis::control::Stop;
use crate::analysis::words::listed;
use crate::mechanism::closing::{Closed, close, close_weighted};
use crate::system::{Block, Inputs, Origin, System};
use linkdyn_output::Status;

/// Finds out why everything together does not assemble, or assembles by another way.
pub(super) fn diagnose(
    system: &System,
    inputs: &Inputs,
    closed: Closed,
) -> Result<ClosedPosition, Stop> {
    let joints: Vec<&Block> = system
        .blocks
        .iter()
        .filter(|b| matches!(b.origin, Origin::Joint(_)))
        .collect();
    let undriven = close(system, &joints, &system.guess, inputs);
    if !undriven.converged {
        if let Some(found) = close_from_beside(system, inputs) {
            let warning = "assembled from a drawing with its bodies turned a little, since from the one given no way leads to an \
                           assembly (its bodies lie in a line?); check that this is the assembly you want, or give poses \
                           closer to it"
                .to_string();
            return Ok(ClosedPosition {
                iterations: closed.iterations + found.iterations,
                warnings: vec![warning],
                ..ClosedPosition::alone(found)
            });
        }
        return Err(Stop::failed(
            Status::AssemblyFailed,
            open_loop(system, &undriven),
        ));
    }
    // The joints alone close: then it is a driver or an initial value.
    let (by_joints, _) = ranks(system, &undriven.q, inputs);
    let freedom = system.n() - by_joints.rank;
    if system.drivers.len() > freedom {
        return Err(Stop::Input(vec![over_driven(system, freedom)]));
    }
    overlap::refuse(system, &undriven.q, inputs)?;
    if let PathEnd::Reached(reached) = from_drawing(system, inputs, None)
        && let Some(found) = ClosedPosition::reached(system, inputs, reached, closed.iterations)
    {
        return Ok(found);
    }
    let driven: Vec<&Block> = system.blocks.iter().collect();
    if !system.initial.is_empty() && close(system, &driven, &system.guess, inputs).converged {
        return Err(Stop::failed(
            Status::AssemblyFailed,
            conflicting(system, inputs),
        ));
    }
    let held = close_weighted(system, &driven, DRIVERS_FIRST, &system.guess, inputs);
    Err(Stop::failed(
        Status::AssemblyFailed,
        format!(
            "can't assemble: the joints alone close, but with the drivers at their first values {}; change the start of a \
             driver, or the lengths that keep it from there",
            gap_text(system, &held)
        ),
    ))
}

/// Weight of drivers when the gap that they leave is measured: they are met to a millionth of it.
const DRIVERS_FIRST: f64 = 1e3;

/// What to say of joints that do not close by themselves.
fn open_loop(system: &System, closed: &Closed) -> String {
    format!(
        "can't assemble: {}; change a length in it, or draw the guess closer to the assembly",
        gap_text(system, closed)
    )
}

/// Digits of a gap: of a compromise that drivers are met in to a millionth.
const GAP_DIGITS: usize = 4;

/// The loop with the largest gap, and that gap: in the least-squares compromise it is shared out evenly among the loop's
/// joints, so their gaps add up to it.
fn gap_text(system: &System, closed: &Closed) -> String {
    let gap = |joint: usize| closed.gaps[joint];
    let topology = topology(system);
    let widest = topology
        .loops()
        .iter()
        .map(|cycle| {
            (
                cycle,
                cycle.joints.iter().map(|&joint| gap(joint)).sum::<f64>(),
            )
        })
        .max_by(|a, b| a.1.total_cmp(&b.1));
    match widest {
        Some((cycle, gap)) => {
            let names: Vec<&str> = cycle
                .joints
                .iter()
                .map(|&joint| system.joints[joint].name.as_str())
                .collect();
            let gap = system.display.length_to(gap * system.size, GAP_DIGITS);
            format!(
                "the loop {} does not close; it lacks {gap} at the best position found",
                listed(&names, " – ")
            )
        }
        None => {
            let worst = (0..system.joints.len()).max_by(|&a, &b| gap(a).total_cmp(&gap(b)));
            let name = worst.map_or("no joint", |joint| system.joints[joint].name.as_str());
            let gap = system
                .display
                .length_to(worst.map_or(0.0, gap) * system.size, GAP_DIGITS);
            format!("joint \"{name}\" is open by {gap} at the best position found")
        }
    }
}

/// The initial values that can't be met together: each that the others leave no room for.
fn conflicting(system: &System, inputs: &Inputs) -> String {
    let mut names = Vec::new();
    for left_out in 0..system.initial.len() {
        let others: Vec<&Block> = system
            .blocks
            .iter()
            .chain(
                system
                    .initial
                    .iter()
                    .enumerate()
                    .filter(|(k, _)| *k != left_out)
                    .map(|(_, block)| block),
            )
            .collect();
        if close(system, &others, &system.guess, inputs).converged {
            names.push(system.origin_name(&system.initial[left_out].origin));
        }
    }
    if names.is_empty() {
        names = system
            .initial
            .iter()
            .map(|block| system.origin_name(&block.origin))
            .collect();
    }
    let who = listed(&names, " and ");
    format!(
        "can't assemble: {who} can't be met together with the joints and drivers; leave out one, or change it"
    )
}
