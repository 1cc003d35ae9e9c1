//! Assembly with its diagnosis: what does not close, what is over- or underdetermined, and by whose fault.

mod assembled;
mod beside;
mod determined;
mod diagnosis;
mod limits;
mod meeting;
mod mobility;
mod overlap;
mod ranks;
mod velocities;

pub use assembled::Assembled;
pub use determined::check_driven;
pub use limits::too_short;
pub use mobility::{counted, topology};
pub use ranks::ranks;
pub(super) use ranks::tangent;
pub use velocities::{velocities, velocities_near};

use super::control::Stop;
use crate::mechanism::closing::close;
use crate::system::{Block, Inputs, System};
use diagnosis::diagnose;
use limits::beyond_numbers;
use mobility::mobility;

/// Assembles at `inputs` from the model's guess; with `initial` values exact.
///
/// # Errors
/// [`Stop::Failed`] with status `assembly_failed` and the loop or the values that do not fit.
pub fn assemble(system: &System, inputs: &Inputs) -> Result<Assembled, Stop> {
    if let Some(complaint) = beyond_numbers(system, inputs) {
        return Err(Stop::Input(vec![complaint]));
    }
    let all: Vec<&Block> = system.blocks.iter().chain(&system.initial).collect();
    let closed = close(system, &all, &system.guess, inputs);
    let (q, iterations, mut warnings) = if closed.converged {
        (closed.q, closed.iterations, Vec::new())
    } else {
        diagnose(system, inputs, closed)?
    };
    let (joints, all) = ranks(system, &q, inputs);
    if all
        .dependent
        .iter()
        .any(|dependent| dependent.row >= system.joint_rows())
    {
        overlap::refuse(system, &q, inputs)?;
    }
    warnings.extend(meeting::doubts(system, &q, inputs)?);
    let mobility = mobility(system, &joints);
    Ok(Assembled {
        q,
        joints,
        all,
        mobility,
        iterations,
        warnings,
    })
}

/// The same position with the ranks and the mobility of another system of the same bodies.
pub fn ranked(system: &System, assembled: Assembled, inputs: &Inputs) -> Assembled {
    let (joints, all) = ranks(system, &assembled.q, inputs);
    let mobility = mobility(system, &joints);
    Assembled {
        joints,
        all,
        mobility,
        ..assembled
    }
}
