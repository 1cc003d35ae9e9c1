//! Quasi-statics: a motion so slow that the mechanism is in equilibrium at every instant.
//!
//! ```text
//! Jᵀ λ = Q(q, t)      no inertia, no damping; weights of the bodies that have a mass
//! ```
//!
//! Where drivers prescribe the whole motion, it is that of kinematics, and joints rub in its direction. Where something is left
//! free, or nothing is driven and loads change with time, each equilibrium is sought from the one before, without friction.

use super::assembly::Assembled;
use super::channels::Contents;
use super::control::{Control, Stop};
use super::dynamics::Start;
use super::equilibrium::start;
use super::instants::OutputInstant;
use super::leaning;
use super::question::Question;
use super::record::Recorder;
use super::sample::ContactSample;
use super::statics::{refuse, sample};
use super::words::friction_left_out;
use super::{driven, ends};
use crate::mechanism::equilibrium::{Balance, Stability};
use crate::mechanism::linearised_system::LinearisedSystem;
use crate::system::System;
use linkdyn_output::{Report, Stopwatch, Trajectory};

/// How far an equilibrium moves at most between two that belong together, in rad or sizes.
const FARTHEST: f64 = 0.1;
/// Part of the way between two outputs at which one that moves farther is no continuation.
const SHORTEST: f64 = 1.0 / 1024.0;

/// Runs the analysis: the rows, how it went, and the motion where it can be asked for more rows.
///
/// # Errors
/// Faults of the input, and failures before the first output.
pub(super) fn run<'s>(
    system: &'s System,
    question: &Question,
    control: &Control,
) -> Result<(Trajectory, Report, Option<driven::Between<'s>>), Stop> {
    refuse(system)?;
    let mut found = if Start::of(system)?.is_driven(system) {
        driven::run(system, question.driven(), control)?
    } else {
        let instants = question.instants.list(system)?;
        let (trajectory, report) = equilibria(system, &instants, question.contents, control)?;
        (trajectory, report, None)
    };
    found.1.warnings.extend(weightless(system));
    Ok(found)
}

/// Bodies without mass beside others that have some, under gravity.
fn weightless(system: &System) -> Option<String> {
    let masses = system.mass.diagonal();
    let bodies = || system.bodies.iter().zip(system.layout.bodies());
    let mut weights = bodies().map(|(_, columns)| masses[columns.x()]);
    if system.gravity.norm() == 0.0 || weights.all(|mass| mass == 0.0) {
        return None;
    }
    let light = bodies().filter(|(_, columns)| masses[columns.x()] == 0.0);
    let names: Vec<&str> = light.map(|(body, _)| body.name.as_str()).collect();
    (!names.is_empty())
        .then(|| format!("without mass, and so without weight: {}", names.join(", ")))
}

/// The equilibrium at every instant, each sought from the one before.
fn equilibria(
    system: &System,
    instants: &[OutputInstant],
    contents: Contents,
    control: &Control,
) -> Result<(Trajectory, Report), Stop> {
    let watch = Stopwatch::start();
    let assembled = start(system, 0.0, false)?.0;
    let turned = ends::at_rest(system, &assembled.q);
    let system = turned.as_ref().unwrap_or(system);
    ends::check_start(system, &assembled.q)?;
    let mut report = Report {
        mobility: assembled.mobility.clone(),
        warnings: assembled.warnings.clone(),
        assemble: watch.read(),
        ..Report::default()
    };
    report.statistics.newton_iterations = assembled.iterations;
    report.warnings.extend(friction_left_out(system));
    let watch = Stopwatch::start();
    let mut march = Equilibria {
        // The first is sought from the assembled position, `initial` included.
        system: system.clone(),
        q: assembled.q,
        time: 0.0,
        is_begun: false,
        unstable: None,
        recorder: Recorder::new(system, contents, instants.len()),
        report,
    };
    let end = instants.last().map_or(0.0, |last| last.time);
    // Outputs may begin later than the motion, which leads there from its start.
    if instants.first().is_some_and(|first| first.time > 0.0) {
        march.attempt(0.0, f64::INFINITY, false, control)?;
    }
    for instant in instants {
        control.progress.note(instant.time, end);
        match march.advance(instant.time, control) {
            Ok(()) => {}
            Err(Stop::Failed { status, message }) if march.recorder.trajectory.rows().len() > 0 => {
                let time = system.display.time(instant.time);
                march.report.status = status;
                march.report.message = Some(format!("at t = {time}: {message}"));
                break;
            }
            Err(stop) => return Err(stop),
        }
    }
    let Equilibria {
        recorder,
        mut report,
        ..
    } = march;
    recorder.close(system, &mut report);
    report.solve = watch.read();
    Ok((recorder.trajectory, report))
}

/// A mechanism on its way from equilibrium to equilibrium.
struct Equilibria {
    /// Its search begins at the last equilibrium.
    system: System,
    q: Vec<f64>,
    time: f64,
    is_begun: bool,
    /// Whether the last equilibrium was unstable.
    unstable: Option<bool>,
    recorder: Recorder,
    report: Report,
}

impl Equilibria {
    /// Goes to an instant and records it.
    fn advance(&mut self, end: f64, control: &Control) -> Result<(), Stop> {
        let whole = end - self.time;
        let mut step = whole;
        loop {
            let time = if self.is_begun { self.time + step } else { end };
            let is_last = !self.is_begun || (end - time).abs() <= 1e-12 * whole.abs();
            let to = if is_last { end } else { time };
            let shortest = step.abs() <= SHORTEST * whole.abs();
            let allowed = if self.is_begun && !shortest {
                FARTHEST
            } else {
                f64::INFINITY
            };
            match self.attempt(to, allowed, is_last, control) {
                Ok(true) if is_last => return Ok(()),
                Ok(true) => step = f64::min((2.0 * step).abs(), (end - self.time).abs()),
                Err(stop) if shortest || control.stop().is_some() || !self.is_begun => {
                    return Err(stop);
                }
                Ok(false) | Err(_) => step *= 0.5,
            }
        }
    }

    /// The equilibrium at a time, recorded where it is wanted; whether it is near enough to be taken.
    fn attempt(
        &mut self,
        time: f64,
        allowed: f64,
        is_wanted: bool,
        control: &Control,
    ) -> Result<bool, Stop> {
        let (recorder, report, before) = (&mut self.recorder, &mut self.report, &self.q);
        let told = |assembled: &Assembled,
                    held: &mut LinearisedSystem,
                    balance: &Balance,
                    contacts: &[ContactSample]| {
            let moved: Vec<f64> = held
                .q
                .iter()
                .zip(before)
                .map(|(now, then)| now - then)
                .collect();
            let moved = held.driven.system.scaled_norm(&moved);
            if moved > allowed {
                return None;
            }
            let statistics = &mut report.statistics;
            statistics.steps += balance.iterations;
            statistics.newton_iterations +=
                held.driven.done.newton_iterations + assembled.iterations;
            statistics.evaluations += held.driven.done.evaluations;
            statistics.factorisations += held.driven.done.factorisations;
            let quality = &mut report.quality;
            quality.constraint_residual = quality.constraint_residual.max(held.residual);
            if is_wanted {
                let mut sample = sample(held);
                sample.contacts.copy_from_slice(contacts);
                recorder.push(
                    held.driven.system,
                    &held.driven.evaluation,
                    &held.inputs,
                    &sample,
                );
            }
            Some((held.q.clone(), moved, balance.stability))
        };
        let found = leaning::rest(&self.system, (&self.q, time), control, told)?;
        let Some((q, moved, stability)) = found else {
            return Ok(false);
        };
        let at = self.system.display.time(time);
        if self.is_begun && moved > FARTHEST {
            self.report.warnings.push(format!(
                "the mechanism snaps at about t = {at}: the equilibrium that it was in ends there, and the next one is far from it"
            ));
        }
        let is_unstable = stability == Stability::Unstable;
        if is_unstable && self.unstable != Some(true) {
            self.report.warnings.push(format!(
                "from t = {at} on the equilibrium is unstable: the mechanism leaves it at the least push"
            ));
        }
        self.unstable = Some(is_unstable);
        if !self.is_begun {
            self.system.initial.clear();
            self.is_begun = true;
        }
        self.system.guess.copy_from_slice(&q);
        (self.q, self.time) = (q, time);
        Ok(true)
    }
}
