//! Whether the drivers determine the motion.

use super::assembled::Assembled;
use super::beside::nudged;
use super::ranks::{free, ranks};
use super::velocities::agree;
use crate::analysis::control::Stop;
use crate::analysis::in_line::singular_text;
use crate::analysis::words::quoted;
use crate::system::{Inputs, System};
use linkdyn_model::error::Complaint;
use linkdyn_output::Status;

/// A null vector's component below this is round-off of the rank decision.
const MOVES: f64 = 1e-6;

/// Checks that the drivers determine the motion.
///
/// # Errors
/// Too few or too many drivers (input), or a start in a singular position.
pub fn check_driven(system: &System, assembled: &Assembled, inputs: &Inputs) -> Result<(), Stop> {
    let n = system.n();
    // Drivers beyond the freedom share the work where they agree, else they fight each other; beside the position it is not larger.
    if system.drivers.len() > n - assembled.joints.rank
        && !(assembled.all.rank == n && agree(system, &assembled.q, inputs))
    {
        return Err(Stop::Input(vec![over_driven(
            system,
            n - assembled.joints.rank,
        )]));
    }
    if assembled.all.rank == n {
        return Ok(());
    }
    // A loss of rank may be the position's alone: look from a little beside it.
    let direction = free(system, &assembled.q, inputs).unwrap_or_default();
    let beside = nudged(system, &assembled.q, &direction, inputs);
    let (joints, all) = beside.map_or((assembled.joints.clone(), assembled.all.clone()), |q| {
        ranks(system, &q, inputs)
    });
    let freedom = n - joints.rank;
    if system.drivers.len() > freedom {
        return Err(Stop::Input(vec![over_driven(system, freedom)]));
    }
    if all.rank < n {
        return Err(Stop::Input(vec![under_driven(system, freedom, &direction)]));
    }
    let what = singular_text(system, &assembled.all.dependent_rows());
    let what = what.map_or_else(String::new, |what| format!(": {what}"));
    Err(Stop::failed(
        Status::Singular,
        format!(
            "the start is a singular position (the constraints lose rank there{what}), so that more than one motion leads away \
             from it, or none; start a little beside it"
        ),
    ))
}

pub(super) fn over_driven(system: &System, freedom: usize) -> Complaint {
    let names = quoted(system.drivers.iter().map(|driver| driver.name.as_str()));
    Complaint::new(
        "drivers",
        format!(
            "too many drivers: the joints leave {freedom} degree{} of freedom, and there are {} drivers ({})",
            if freedom == 1 { "" } else { "s" },
            system.drivers.len(),
            names
        ),
    )
    .hint("take drivers out until their number is that of the degrees of freedom")
}

fn under_driven(system: &System, freedom: usize, direction: &[f64]) -> Complaint {
    let moves = |k: usize| {
        direction[system.layout.moving(k).range()]
            .iter()
            .any(|z| z.abs() > MOVES)
    };
    let moving = system
        .bodies
        .iter()
        .enumerate()
        .filter(|(k, _)| moves(*k))
        .map(|(_, body)| body.name.as_str());
    let drivers = system.drivers.len();
    Complaint::new(
        "drivers",
        format!(
            "too few drivers: the joints leave {freedom} degree{} of freedom, {drivers} driven; {} can still move",
            if freedom == 1 { "" } else { "s" },
            quoted(moving)
        ),
    )
    .hint("drive what is free, or hold it by a joint")
}
