//! Kinematics and inverse dynamics of a driven mechanism, ideal or with massless clearance links.

mod ahead;
mod between;
mod bridge;
mod outputs;
mod passages;
mod paths;
mod words;

use super::assembly::{Assembled, assemble, check_driven, ranked};
use super::channels::Contents;
use super::clearance_link::forces;
use super::control::{Control, Stop};
use super::departure::{self, Departure};
use super::ends;
use super::instants::Instants;
use super::sample::Sample;
use super::words::listed;
use crate::mechanism::continuation::{Parameter, Path};
use crate::mechanism::driven::{Driven, Failure};
use crate::system::{Inputs, JointData, System};
pub(super) use between::Between;
use linkdyn_model::error::Complaint;
use linkdyn_output::{Column, Report, Status, Stopwatch, Trajectory};
use outputs::Outputs;
pub use passages::{passages, range};
pub use paths::path;
pub(super) use words::describe;

/// The settings of a prescribed motion.
#[derive(Debug, Clone)]
pub(super) struct Settings {
    /// When there are outputs.
    pub instants: Instants,
    /// Located events are outputs, too.
    pub at_events: bool,
    /// What is computed.
    pub contents: Contents,
    /// Columns that rows have; all where not given.
    pub kept: Option<Vec<Column>>,
}

/// Follows the drivers: the rows, how it went, and the motion where it can be asked for more rows.
///
/// # Errors
/// Faults of the input, and failures before the first output.
pub(super) fn run<'s>(
    system: &'s System,
    settings: Settings,
    control: &Control,
) -> Result<(Trajectory, Report, Option<Between<'s>>), Stop> {
    let clock = Stopwatch::start();
    let Settings {
        instants,
        at_events,
        contents,
        kept,
    } = settings;
    refuse(system, contents.reactions, at_events)?;
    let instants = instants.list(system)?;
    let (assembled, start) = from(system)?;
    let mut report = Report {
        mobility: assembled.mobility.clone(),
        warnings: assembled.warnings,
        ..Report::default()
    };
    report.statistics.newton_iterations = assembled.iterations;
    report
        .warnings
        .extend(shared(system, assembled.mobility.rank));

    let singular = |_: Failure| {
        Stop::failed(
            Status::Singular,
            "the start is a singular position of the mechanism; start a little beside it".into(),
        )
    };
    let mut q = assembled.q;
    let mut driven = Driven::new(system, &q, &start).map_err(singular)?;
    driven.correct(&mut q, &start).map_err(singular)?;
    report.assemble = clock.read();

    let clock = Stopwatch::start();
    let range = range(system, &instants);
    let (first, range) = if Parameter::of(system) == Parameter::DriverValue {
        // A singular start is passed on the way from where it is followed.
        let first = start.drive[0][0];
        (first, (range.0.min(first), range.1.max(first)))
    } else {
        (0.0, range)
    };
    let path = path(&mut driven, (first, &q), range, control).map_err(singular)?;
    report.statistics.steps = path.steps;
    report.statistics.rejected = path.rejected;
    let of_rows = (kept.as_deref(), instants.len());
    let mut outputs = Outputs::new(system, contents, of_rows, &mut report);
    outputs.march(&mut driven, &path, &instants, at_events, control);
    let trajectory = outputs.finish();
    let done = driven.done;
    report.statistics.newton_iterations += done.newton_iterations;
    report.statistics.evaluations += done.evaluations;
    report.statistics.factorisations += done.factorisations;
    report.solve = clock.read();
    Ok((
        trajectory,
        report,
        Between::new(driven, path, contents.reactions),
    ))
}

/// What is said of drivers that share the work.
pub fn shared(system: &System, freedom: i64) -> Option<String> {
    let names: Vec<&str> = system
        .drivers
        .iter()
        .map(|driver| driver.name.as_str())
        .collect();
    let shared_out = system.drivers.iter().any(|driver| driver.share != 1.0);
    let several = if freedom == 1 { "degree" } else { "degrees" };
    (names.len() as i64 > freedom).then(|| {
        format!(
            "{} drive {freedom} {several} of freedom together: their efforts are those with the least sum of squares{}, and others, with \
             other joint forces, would do as well",
            listed(&names, " and "),
            if shared_out { ", each divided by its share" } else { "" }
        )
    })
}

/// Where the motion is followed from, and the drivers there: its start or, where that is singular, a position away from it on
/// the branch that is meant.
fn from(system: &System) -> Result<(Assembled, Inputs), Stop> {
    let start = Inputs::at_time(system, 0.0);
    let assembled = assemble(system, &start)?;
    let departure = match check_driven(system, &assembled, &start) {
        Ok(()) => None,
        Err(stop @ Stop::Failed { .. }) => {
            Some(departure::driven(system, &assembled)?.ok_or(stop)?)
        }
        Err(stop @ Stop::Input(_)) => return Err(stop),
    };
    super::assembly::velocities(system, &assembled.q, &start)?;
    if !system.contacts.is_empty() {
        let turned = ends::at_this_turn(system, &assembled.q);
        ends::check_start(turned.as_ref().unwrap_or(system), &assembled.q)?;
    }
    let Some(departure) = departure else {
        return Ok((assembled, start));
    };
    let Departure {
        away: q,
        inputs,
        warning,
        ..
    } = departure;
    let mut away = Assembled { q, ..assembled };
    away.warnings.extend(warning);
    Ok((ranked(system, away, &inputs), inputs))
}

/// What a prescribed motion can't do.
///
/// # Errors
/// Rows at events with clearance links, and friction with a history where forces are wanted.
pub fn refuse(system: &System, reactions: bool, at_events: bool) -> Result<(), Stop> {
    if at_events && system.links > 0 {
        return Err(Stop::Input(vec![
            Complaint::new(
                "analysis.outputs_at",
                "a massless clearance link turns by differences between outputs, which rows at events would change",
            )
            .found("\"events\"")
            .hint("use \"equidistant\""),
        ]));
    }
    let remembers = |force: usize| {
        system.dependent_forces[force]
            .force
            .memory_scale()
            .is_some()
    };
    let bristles = |joint: &&JointData| {
        joint
            .extras()
            .friction
            .is_some_and(|friction| remembers(friction.force))
    };
    match system
        .joints
        .iter()
        .find(bristles)
        .filter(|_| reactions || system.links > 0)
    {
        Some(joint) => Err(Stop::Input(vec![
            Complaint::new(
                format!("joints.{}.friction.law", joint.name),
                "bristles have a history, which instants of a prescribed motion do not have",
            )
            .found("\"lugre\"")
            .hint("use \"stribeck\", which is \"lugre\" at steady sliding"),
        ])),
        None => Ok(()),
    }
}

/// Kept for the six-bar benchmark: solves one instant, all reactions, without output.
pub fn solve_instant(
    driven: &mut Driven,
    path: &Path,
    inputs: &Inputs,
    sample: &mut Sample,
) -> Result<(), Failure> {
    let s = match path.parameter {
        Parameter::DriverValue => inputs.drive[0][0],
        Parameter::Time | Parameter::Coordinate => inputs.time,
    };
    let Sample { q, v, a, .. } = sample;
    path.guess(s, q, v, a);
    driven.correct(q, inputs)?;
    forces(driven, inputs, sample)
}
