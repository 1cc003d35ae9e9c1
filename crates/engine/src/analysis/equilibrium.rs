//! The mechanism at rest: from its assembled position into equilibrium, and why there is none.

use super::assembly::{Assembled, assemble, check_driven, ranks};
use super::branch::{leave, singularity};
use super::control::{Control, Stop};
use super::in_line::singular_text;
use super::words::friction_may_hold;
use crate::element::Axis;
use crate::mechanism::driven::Failure;
use crate::mechanism::equilibrium::{Balance, Lost, find};
use crate::mechanism::linearised_system::LinearisedSystem;
use crate::system::{Inputs, System};
use linkdyn_output::Status;

/// The mechanism at rest where it is assembled or, where that is a singular position, a little beside it on the branch that
/// the forces drive most; a pose that must not be left can't be singular. Drivers and loads have their values at `time`.
///
/// # Errors
/// When it does not assemble, has too many drivers, or is in a singular position that it can't leave.
pub fn start(
    system: &System,
    time: f64,
    pose: bool,
) -> Result<(Assembled, LinearisedSystem<'_>), Stop> {
    let inputs = Inputs::at_time(system, time);
    let mut assembled = assemble(system, &inputs)?;
    if assembled.all.rank == system.n() || system.drivers.len() > system.n() - assembled.joints.rank
    {
        check_driven(system, &assembled, &inputs)?;
    }
    if !pose {
        assembled = leave(system, assembled, &inputs)?;
    } else if singularity(system, &assembled, &inputs)?.is_some() {
        return Err(Stop::failed(
            Status::Singular,
            "the pose is a singular position (the constraints lose rank there): several motions lead away from it, or none, so \
             that small motions about it have no linear equations; take a pose a little beside it"
                .into(),
        ));
    }
    let held = LinearisedSystem::new(system, &assembled.all.free_columns, &assembled.q, time)
        .map_err(singular)?;
    Ok((assembled, held))
}

fn singular(_: Failure) -> Stop {
    Stop::failed(
        Status::Singular,
        "the start is a singular position (the constraints lose rank there); start a little beside it".into(),
    )
}

/// Moves the mechanism into equilibrium; `depth` as in [`find`].
///
/// # Errors
/// When there is none or a singular one, or it is time to stop.
pub fn balance(
    held: &mut LinearisedSystem,
    assembled: &Assembled,
    control: &Control,
    depth: Option<&dyn Fn(&LinearisedSystem) -> f64>,
) -> Result<Balance, Stop> {
    let found = find(held, &|| control.stop().is_some(), depth);
    let singular = |message: String| Stop::failed(Status::Singular, message);
    let lost = match found {
        Ok(_) | Err(Lost::Blocked | Lost::Failed(_) | Lost::Unbalanced { .. })
            if rests_in_singular(held, assembled) =>
        {
            return Err(singular(
                "the equilibrium is itself a singular position (the constraints lose rank there), from which several motions \
                 lead away, each with a stiffness of its own; there is no one answer, move something a little to leave it"
                    .into(),
            ));
        }
        Ok(balance) => return Ok(balance),
        Err(lost) => lost,
    };
    let friction = friction_may_hold(held.driven.system);
    Err(match lost {
        Lost::Stopped => {
            let status = control.stop().unwrap_or(Status::Interrupted);
            Stop::failed(
                status,
                format!(
                    "{} before an equilibrium was found",
                    status.word().replace('_', " ")
                ),
            )
        }
        Lost::Unbalanced { residual } => singular(format!(
            "no equilibrium found: something still pulls at {} (residual {residual:.1e}) however far it moves; look for a \
             load that nothing balances{friction}",
            pulled(held)
        )),
        Lost::Blocked => singular(format!(
            "no equilibrium found: the forces pull {} against a dead centre or change point{}, where its way ends; start \
             on the other side, or drive it{friction}",
            pulled(held),
            what(held),
        )),
        Lost::Met => singular(format!(
            "no equilibrium found: the forces pull {} against a stop, and nothing holds it there{friction}",
            pulled(held)
        )),
        Lost::Failed(_) => singular(format!(
            "no equilibrium found: the search came to a singular position{}; start closer to the equilibrium",
            what(held)
        )),
    })
}

/// ` (…)`: what is nearest to being singular.
fn what(held: &mut LinearisedSystem) -> String {
    let rows = held.strained_rows();
    singular_text(held.driven.system, &rows).map_or_else(String::new, |what| format!(" ({what})"))
}

/// Remainder of a row by that at the start, and pull by the largest force, below which the mechanism rests in a singular
/// position.
const RESTS: f64 = 1e-4;

/// Whether the search ended where nothing pulls any more and constraints lose rank.
fn rests_in_singular(held: &LinearisedSystem, start: &Assembled) -> bool {
    let system = held.driven.system;
    let rows = ranks(system, &held.q, &held.inputs).1;
    let near = rows.rank + held.freedom() < system.n()
        || rows.smallest_kept < RESTS * start.all.smallest_kept.min(1.0);
    let scaled = |k: usize, force: f64| (force * system.column_scale(k)).abs();
    let largest = held
        .force
        .iter()
        .enumerate()
        .fold(0.0, |most: f64, (k, force)| most.max(scaled(k, *force)));
    let pull = held
        .pull()
        .iter()
        .enumerate()
        .fold(0.0, |most: f64, (k, g)| most.max((g * held.scale(k)).abs()));
    near && pull <= RESTS * largest
}

/// The coordinate that is pulled at most.
fn pulled(held: &LinearisedSystem) -> String {
    let pull: Vec<f64> = held
        .pull()
        .iter()
        .enumerate()
        .map(|(k, g)| (g * held.scale(k)).abs())
        .collect();
    let most = (0..pull.len()).max_by(|&a, &b| pull[a].total_cmp(&pull[b]));
    most.map_or_else(String::new, |k| coordinate(held, k))
}

/// The name of a minimal coordinate.
pub(super) fn coordinate(held: &LinearisedSystem, k: usize) -> String {
    coordinate_name(held.driven.system, held.driven.independent[k].column)
}

/// The name of a coordinate, `crank.angle`.
pub(super) fn coordinate_name(system: &System, column: usize) -> String {
    let (body, axis) = system.layout.coordinate(column);
    let axis = match axis {
        Axis::X => "x",
        Axis::Y => "y",
        Axis::Theta => "angle",
    };
    let name = body.index().map_or("", |index| &system.bodies[index].name);
    format!("{name}.{axis}")
}
