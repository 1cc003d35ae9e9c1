//! Assembly with its diagnosis: what does not close, what is over- or underdetermined, and by whose fault.

mod assembled;
mod beside;
mod closed_position;
mod determined;
mod diagnosis;
mod drawing;
mod limits;
mod meeting;
mod messages;
mod mobility;
mod overlap;
mod ranks;
mod values;
mod velocities;
mod way;

pub use assembled::Assembled;
pub use determined::check_driven;
pub use limits::too_short;
pub use mobility::{counted, ranked, topology};
pub(super) use ranks::tangent;
pub use ranks::{dependent_and_free, ranks};
pub use velocities::{velocities, velocities_near};

use super::control::Stop;
use crate::mechanism::closing::{Closed, close_proven};
use crate::system::{Block, Inputs, System};
use closed_position::ClosedPosition;
use diagnosis::diagnose;
use limits::{beyond_numbers, too_steep};
use mobility::mobility;
use way::{PathEnd, from_drawing};

/// Assembles at `inputs` by moving there from the drawing (see the module `way`); with `initial` values exact.
///
/// # Errors
/// [`Stop::Failed`] with status `assembly_failed` and the loop or the values that do not fit.
pub fn assemble(system: &System, inputs: &Inputs) -> Result<Assembled, Stop> {
    if let Some(complaint) = beyond_numbers(system, inputs) {
        return Err(Stop::Input(vec![complaint]));
    }
    let all: Vec<&Block> = system.blocks.iter().chain(&system.initial).collect();
    let closed = close_proven(system, &all, &system.guess, inputs);
    let ClosedPosition {
        q,
        iterations,
        arrival,
        mut warnings,
    } = if closed.proven {
        ClosedPosition::alone(closed)
    } else if closed.converged {
        settle(system, inputs, closed)
    } else {
        diagnose(system, inputs, closed)?
    };
    if let Some(complaint) = too_steep(system, &q, inputs) {
        return Err(Stop::Input(vec![complaint]));
    }
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
        arrival,
        warnings,
    })
}

/// The assembly that Newton's iteration found, or the one that is reached from the drawing where that is another.
fn settle(system: &System, inputs: &Inputs, closed: Closed) -> ClosedPosition {
    match from_drawing(system, inputs, Some(&closed.q)) {
        PathEnd::Nowhere => ClosedPosition::alone(closed),
        PathEnd::Ended(said) => ClosedPosition {
            warnings: vec![said],
            ..ClosedPosition::alone(closed)
        },
        PathEnd::Reached(reached) if reached.is(system, &closed.q) => ClosedPosition {
            arrival: reached.arrival,
            warnings: reached.warnings,
            ..ClosedPosition::alone(closed)
        },
        PathEnd::Reached(reached) => {
            let there = ClosedPosition::reached(system, inputs, reached, closed.iterations);
            there.unwrap_or_else(|| ClosedPosition {
                warnings: vec![way::unmet(system, inputs)],
                ..ClosedPosition::alone(closed)
            })
        }
    }
}
