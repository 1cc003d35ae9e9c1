//! Statics: the equilibrium that the mechanism takes under gravity, springs and loads.
//!
//! Drivers are held at their values at t = 0, loads have theirs of t = 0, nothing moves. The search begins at the assembled
//! position, `initial` values included, and goes where the forces pull (see [`crate::mechanism::equilibrium`]). Reactions and
//! efforts are the multipliers of Jᵀλ = Q there. The one row at t = 0 has no velocities and no accelerations.

use super::assembly::{Assembled, assemble, check_driven, ranks};
use super::branch::{leave, singularity};
use super::channels::Contents;
use super::control::{Control, Stop};
use super::in_line::singular_text;
use super::record::Recorder;
use super::sample::{ContactSample, Sample};
use super::words::friction_left_out;
use super::{ends, leaning};
use crate::element::Axis;
use crate::mechanism::driven::Failure;
use crate::mechanism::equilibrium::{Balance, Lost, Stability, find};
use crate::mechanism::held::Held;
use crate::system::{Inputs, JointData, System};
use linkdyn_model::error::Complaint;
use linkdyn_output::{Equilibrium, Report, Status, Stopwatch, Trajectory};

/// Runs the analysis.
///
/// # Errors
/// Faults of the input, a singular start, and forces without equilibrium.
pub fn run(
    system: &System,
    contents: Contents,
    control: &Control,
) -> Result<(Trajectory, Report), Stop> {
    refuse(system)?;
    let watch = Stopwatch::start();
    if system.contacts.is_empty() {
        let (assembled, mut held) = start(system, false)?;
        let assemble = watch.read();
        let watch = Stopwatch::start();
        let balance = balance(&mut held, &assembled, control)?;
        let (trajectory, mut report) =
            told((system, contents), &assembled, &mut held, &balance, &[]);
        (report.assemble, report.solve) = (assemble, watch.read());
        return Ok((trajectory, report));
    }
    // What the mechanism is without its stops, and where they are seen from there.
    let assembled = start(system, false)?.0;
    let turned = ends::at_rest(system, &assembled.q);
    let system = turned.as_ref().unwrap_or(system);
    ends::check_start(system, &assembled.q)?;
    let mobility = assembled.mobility;
    let assemble = watch.read();
    let watch = Stopwatch::start();
    let (trajectory, mut report) = leaning::rest(
        system,
        &assembled.q,
        control,
        |assembled, held, balance, contacts| {
            told((system, contents), assembled, held, balance, contacts)
        },
    )?;
    report.mobility = mobility;
    (report.assemble, report.solve) = (assemble, watch.read());
    Ok((trajectory, report))
}

/// The row of an equilibrium, and what is reported of it; `contacts` are the stops there.
fn told(
    (system, contents): (&System, Contents),
    assembled: &Assembled,
    held: &mut Held,
    balance: &Balance,
    contacts: &[ContactSample],
) -> (Trajectory, Report) {
    let mut report = Report {
        mobility: assembled.mobility.clone(),
        warnings: assembled.warnings.clone(),
        ..Report::default()
    };
    let mut recorder = Recorder::new(system, contents, 1);
    let mut sample = sample(held);
    sample.contacts.copy_from_slice(contacts);
    recorder.push(
        held.driven.system,
        &held.driven.evaluation,
        &held.inputs,
        &sample,
    );
    report.warnings.extend(warning(balance));
    report.warnings.extend(friction_left_out(system));
    report.warnings.extend(recorder.warnings(system));
    report.equilibrium = Some(described(held, balance));
    report.quality.constraint_residual = held.residual;
    let done = held.driven.done;
    report.statistics.steps = balance.iterations;
    report.statistics.newton_iterations = done.newton_iterations + assembled.iterations;
    report.statistics.evaluations = done.evaluations;
    report.statistics.factorisations = done.factorisations;
    (recorder.trajectory, report)
}

/// A mechanism at rest where it is held.
pub fn sample(held: &mut Held) -> Sample {
    let mut sample = Sample::new(held.driven.system);
    sample.q.copy_from_slice(&held.q);
    sample.force.copy_from_slice(&held.force);
    sample.balance.copy_from_slice(&held.force);
    held.driven.multipliers(&held.force, &mut sample.lambda);
    sample
}

/// What statics can't do.
///
/// # Errors
/// Joints whose clearance is modelled, all of them.
pub fn refuse(system: &System) -> Result<(), Stop> {
    let complaint = |joint: &JointData| {
        let path = format!("joints.{}.clearance.model", joint.name);
        if joint.clearance().is_some() {
            let message = "a massless clearance link takes its direction from a force, so that its position at rest is not that of a mechanism: statics and modes have no place for it";
            Some(Complaint::new(path, message).hint("use \"ideal\""))
        } else if joint.extras().contact.is_some() {
            let message = "a journal in its bearing has its place at rest from the contact alone, which statics and modes do not solve for";
            Some(
                Complaint::new(path, message)
                    .hint("use \"ideal\", or \"dynamics\" with losses until it has come to rest"),
            )
        } else {
            None
        }
    };
    let complaints: Vec<Complaint> = system.joints.iter().filter_map(complaint).collect();
    if complaints.is_empty() {
        Ok(())
    } else {
        Err(Stop::Input(complaints))
    }
}

/// The mechanism at rest where it is assembled or, where that is a singular position, a little beside it on the branch that
/// the forces drive most; a pose that must not be left can't be singular.
///
/// # Errors
/// When it does not assemble, has too many drivers, or is in a singular position that it can't leave.
pub fn start(system: &System, pose: bool) -> Result<(Assembled, Held<'_>), Stop> {
    let inputs = Inputs::at_time(system, 0.0);
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
    let held = Held::new(system, &assembled.all.free_columns, &assembled.q).map_err(singular)?;
    Ok((assembled, held))
}

fn singular(_: Failure) -> Stop {
    Stop::failed(
        Status::Singular,
        "the start is a singular position (the constraints lose rank there); start a little beside it".into(),
    )
}

/// Moves the mechanism into equilibrium.
///
/// # Errors
/// When there is none or a singular one, or it is time to stop.
pub fn balance(held: &mut Held, assembled: &Assembled, control: &Control) -> Result<Balance, Stop> {
    let found = find(held, &|| control.stop().is_some());
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
             load that nothing balances",
            pulled(held)
        )),
        Lost::Blocked => singular(format!(
            "no equilibrium found: the forces pull {} against a dead centre or change point{}, where its way ends; start \
             on the other side, or drive it",
            pulled(held),
            what(held),
        )),
        Lost::Failed(_) => singular(format!(
            "no equilibrium found: the search came to a singular position{}; start closer to the equilibrium",
            what(held)
        )),
    })
}

/// ` (…)`: what is nearest to being singular.
fn what(held: &mut Held) -> String {
    let rows = held.strained_rows();
    singular_text(held.driven.system, &rows).map_or_else(String::new, |what| format!(" ({what})"))
}

/// Remainder of a row by that at the start, and pull by the largest force, below which the mechanism rests in a singular
/// position.
const RESTS: f64 = 1e-4;

/// Whether the search ended where nothing pulls any more and constraints lose rank.
fn rests_in_singular(held: &Held, start: &Assembled) -> bool {
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
fn pulled(held: &Held) -> String {
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
fn coordinate(held: &Held, k: usize) -> String {
    let system = held.driven.system;
    let (body, axis) = system.layout.coordinate(held.driven.independent[k].column);
    let axis = match axis {
        Axis::X => "x",
        Axis::Y => "y",
        Axis::Theta => "angle",
    };
    let name = body.index().map_or("", |index| &system.bodies[index].name);
    format!("{name}.{axis}")
}

/// The word for a stability.
fn word(stability: Stability) -> &'static str {
    match stability {
        Stability::Stable => "stable",
        Stability::Indifferent => "indifferent",
        Stability::Unstable => "unstable",
    }
}

/// An equilibrium for the report.
pub fn described(held: &Held, balance: &Balance) -> Equilibrium {
    Equilibrium {
        stability: word(balance.stability),
        coordinates: (0..held.freedom()).map(|k| coordinate(held, k)).collect(),
        stiffness: balance.stiffness.clone(),
        residual: balance.residual,
    }
}

/// What to say of an equilibrium that does not hold by itself.
pub fn warning(balance: &Balance) -> Option<String> {
    match balance.stability {
        Stability::Stable => None,
        Stability::Indifferent => Some(
            "the equilibrium is indifferent: in some direction nothing brings the mechanism back"
                .into(),
        ),
        Stability::Unstable => {
            Some("the equilibrium is unstable: the mechanism leaves it at the least push".into())
        }
    }
}
