//! Statics: the equilibrium that the mechanism takes under gravity, springs and loads.
//!
//! Drivers are held at their values at t = 0, loads have theirs of t = 0, nothing moves. The search begins at the assembled
//! position, `initial` values included, and goes where the forces pull (see [`crate::mechanism::equilibrium`]). Reactions and
//! efforts are the multipliers of Jᵀλ = Q there. The one row at t = 0 has no velocities and no accelerations.

use super::assembly::Assembled;
use super::channels::Contents;
use super::control::{Control, Stop};
use super::equilibrium::{balance, coordinate, start};
use super::record::Recorder;
use super::sample::{ContactSample, Sample};
use super::words::friction_left_out;
use super::{ends, leaning};
use crate::mechanism::equilibrium::{Balance, Stability};
use crate::mechanism::linearised_system::LinearisedSystem;
use crate::system::{JointData, System};
use linkdyn_model::error::Complaint;
use linkdyn_output::{Equilibrium, Report, Stopwatch, Trajectory};

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
        let (assembled, mut held) = start(system, 0.0, false)?;
        let assemble = watch.read();
        let watch = Stopwatch::start();
        let balance = balance(&mut held, &assembled, control, None)?;
        let (trajectory, mut report) =
            told((system, contents), &assembled, &mut held, &balance, &[]);
        (report.assemble, report.solve) = (assemble, watch.read());
        return Ok((trajectory, report));
    }
    // What the mechanism is without its stops, and where they are seen from there.
    let assembled = start(system, 0.0, false)?.0;
    let turned = ends::at_rest(system, &assembled.q);
    let system = turned.as_ref().unwrap_or(system);
    ends::check_start(system, &assembled.q)?;
    let mobility = assembled.mobility;
    let assemble = watch.read();
    let watch = Stopwatch::start();
    let (trajectory, mut report) = leaning::rest(
        system,
        (&assembled.q, 0.0),
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
    held: &mut LinearisedSystem,
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
    let shared = super::driven::shared(system, assembled.mobility.rank);
    report.warnings.extend(shared);
    report.warnings.extend(warning(balance));
    report.warnings.extend(friction_left_out(system));
    recorder.close(system, &mut report);
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
pub fn sample(held: &mut LinearisedSystem) -> Sample {
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

/// The word for a stability.
fn word(stability: Stability) -> &'static str {
    match stability {
        Stability::Stable => "stable",
        Stability::Indifferent => "indifferent",
        Stability::Unstable => "unstable",
    }
}

/// An equilibrium for the report.
pub fn described(held: &LinearisedSystem, balance: &Balance) -> Equilibrium {
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
