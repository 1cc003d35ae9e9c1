//! What a motion borrows: the mechanism at its start, in the phases it comes to be in.

use super::flow::Flow;
use super::parts;
use super::settings::Settings;
use super::simulation::Simulation;
use super::start::Start;
use crate::analysis::assembly::{Assembled, ranked};
use crate::analysis::branch::singularity;
use crate::analysis::control::Stop;
use crate::analysis::departure::{self, Departure};
use crate::analysis::ends;
use crate::analysis::words::locked;
use crate::element::pair::{Pair, Surface};
use crate::mechanism::driven::Failure;
use crate::mechanism::parts::Part;
use crate::mechanism::phases::Phases;
use crate::mechanism::reduced::{Reduced, Solver};
use crate::system::{Inputs, System};
use linkdyn_model::error::Complaint;
use linkdyn_output::{Mobility, Stage, Status, Stopwatch};
use std::borrow::Cow;

/// A mechanism at the start of a motion.
pub struct Scene<'m> {
    phases: Phases<'m>,
    parts: Vec<Part>,
    pub(super) assembled: Assembled,
    v: Vec<f64>,
    departure: Option<Departure>,
    /// Mobility, where the motion starts.
    pub(super) mobility: Mobility,
    /// What is to be said of the start.
    pub(super) warnings: Vec<String>,
    /// What it took to get there.
    pub(super) assembling: Stage,
    /// What it takes since.
    pub(super) watch: Stopwatch,
}

impl<'m> Scene<'m> {
    /// The mechanism with all open that may be: what holds at the start closes there.
    ///
    /// # Errors
    /// Faults of the input, and a start that is impossible.
    pub fn new(system: Cow<'m, System>, start: Start) -> Result<Self, Stop> {
        let Start {
            assembled,
            v,
            clock,
        } = start;
        refuse(&system)?;
        let system = match ends::at_this_turn(&system, &assembled.q) {
            Some(turned) => Cow::Owned(turned),
            None => system,
        };
        ends::check_start(&system, &assembled.q)?;
        let assembling = clock.read();

        let watch = Stopwatch::start();
        let mut mobility = assembled.mobility.clone();
        let (system, assembled) = match system.opened() {
            Some(opened) => {
                let assembled = ranked(&opened, assembled, &Inputs::at_time(&opened, 0.0));
                (Cow::Owned(opened), assembled)
            }
            None => (system, assembled),
        };
        let departure = departure::free(&system, &assembled)?;
        let (mut assembled, v) = match &departure {
            Some(departure) => {
                let assembled = away(&system, assembled, departure);
                mobility = assembled.mobility.clone();
                (assembled, departure.v.clone())
            }
            None => (assembled, v),
        };
        let mut warnings = std::mem::take(&mut assembled.warnings);
        warnings.extend(departure.as_ref().and_then(|own| own.warning.clone()));
        Ok(Scene {
            parts: parts::parts(&system, &assembled),
            phases: Phases::new(system),
            assembled,
            v,
            departure,
            mobility,
            warnings,
            assembling,
            watch,
        })
    }

    /// The mechanism.
    pub fn system(&self) -> &System {
        self.phases.whole()
    }

    /// The motion at t = 0, towards `end`.
    ///
    /// # Errors
    /// A start that is impossible.
    pub fn begin(&self, settings: &Settings, end: f64) -> Result<Simulation<'_>, Stop> {
        let system = self.system();
        let solver = solver(system, &self.parts, settings);
        let mut reduced = equations(system, &self.assembled, &self.v, solver)?;
        reduced.cross(&self.parts, &self.phases);
        if let Some(Departure { q, v, .. }) = &self.departure {
            let left = reduced.begin_at(q, v);
            left.map_err(|_| singular_start())?;
        }
        Simulation::begin(settings, Flow::new(&self.phases, reduced), end)
    }
}

/// The mechanism away from a singular start, on the branch on which it leaves.
fn away(system: &System, assembled: Assembled, departure: &Departure) -> Assembled {
    let q = departure.away.clone();
    ranked(system, Assembled { q, ..assembled }, &departure.inputs)
}

/// Who solves for accelerations, where that is said.
///
/// Where parts have smooth branches, which stand for their joints at times, there are tangents; and so there are where rigid
/// journals come and go as constraints, unless it is said otherwise.
fn solver(system: &System, parts: &[Part], settings: &Settings) -> Option<Solver> {
    let is_rigid = |contact: &Pair| matches!(contact.surface, Surface::Rigid(_));
    let tangents =
        !parts.is_empty() || settings.solver.is_none() && system.contacts.iter().any(is_rigid);
    if tangents {
        Some(Solver::Tangents)
    } else {
        settings.solver
    }
}

/// What forward dynamics can't do.
fn refuse(system: &System) -> Result<(), Stop> {
    if let Some(joint) = system
        .joints
        .iter()
        .find(|joint| joint.clearance().is_some())
    {
        return Err(Stop::Input(vec![
            Complaint::new(
                format!("joints.{}.clearance.model", joint.name),
                "a massless clearance link takes its direction from the force of the instant, which leaves a mechanism that \
                 is free to move without a well-defined motion",
            )
            .hint("use \"ideal\" or a model of contact, or let drivers prescribe the whole motion"),
        ]));
    }
    Ok(())
}

/// The equations of motion at the assembled state.
fn equations<'s>(
    system: &'s System,
    assembled: &Assembled,
    v: &[f64],
    solver: Option<Solver>,
) -> Result<Reduced<'s>, Stop> {
    let columns = &assembled.all.free_columns;
    let point = (&assembled.q[..], v, 0.0);
    let reduced = Reduced::new(system, columns, point, solver).map_err(|failure| {
        let massless: Vec<&str> = system
            .bodies
            .iter()
            .filter(|body| body.is_light)
            .map(|body| body.name.as_str())
            .collect();
        match failure {
            Failure::Singular if !massless.is_empty() => Stop::Input(vec![
                Complaint::new(
                    "bodies",
                    format!(
                        "something free to move has neither mass nor inertia (without: {})",
                        massless.join(", ")
                    ),
                )
                .hint("give mass and inertia to what the joints leave free"),
            ]),
            Failure::Locked { force } => Stop::failed(
                Status::Singular,
                format!("at the start {}", locked(system, force)),
            ),
            Failure::Singular | Failure::Diverged { .. } | Failure::Inconsistent { .. } => {
                singular_start()
            }
        }
    })?;
    if singularity(system, assembled, &reduced.inputs)?.is_some() {
        return Err(singular_start());
    }
    Ok(reduced)
}

/// What to say of a singular start that can't be left.
fn singular_start() -> Stop {
    Stop::failed(
        Status::Singular,
        "the start is a singular position (the constraints lose rank there), so that more than one motion leads away \
         from it; start a little beside it"
            .into(),
    )
}
