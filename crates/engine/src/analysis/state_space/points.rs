//! Where a mechanism is linearised: at rest, or at instants of its motion.

use super::answer::NoLinearSystem;
use crate::analysis::bent::straightened;
use crate::analysis::channels::Contents;
use crate::analysis::control::Control;
use crate::analysis::modes;
use crate::analysis::question::{Kind, Question};
use crate::analysis::statics::{described, warning};
use crate::analysis::words::friction_left_out;
use crate::analysis::{assembly, driven, dynamics};
use crate::element::pair::{ContactId, Hold, Phase, Surface};
use crate::system::compile::{compile, compile_about_rest};
use crate::system::{Inputs, System};
use linkdyn_model::error::{Complaint, Complaints};
use linkdyn_model::{AnalysisKind, Checked};
use linkdyn_output::{Equilibrium, Status};

/// A state of the mechanism, and what holds there.
pub struct OperatingPoint<'p> {
    /// Its equations, with the rows of contacts that are held.
    pub system: &'p System,
    /// Columns of minimal coordinates, where all drivers prescribe their motions.
    pub columns: Vec<usize>,
    /// Coordinates and their rates (n).
    pub q: &'p [f64],
    pub v: &'p [f64],
    /// What is prescribed there, states and memories included.
    pub inputs: Inputs,
    /// How contacts are held (by contact).
    pub holds: Vec<Hold>,
    /// Stops that press at rest.
    pub pressed: Vec<bool>,
    /// Whether joints rub.
    pub rubs: bool,
    /// \[s\]
    pub time: Option<f64>,
    pub equilibrium: Option<Equilibrium>,
    pub warnings: Vec<String>,
}

/// What is done at a point.
pub type ToldPoint<'t> = &'t mut dyn FnMut(OperatingPoint) -> Result<(), NoLinearSystem>;

/// The equilibrium or, with `pose`, the assembled position.
///
/// # Errors
/// As of modes.
pub fn at_rest(
    model: &Checked,
    pose: bool,
    control: &Control,
    told: ToldPoint,
) -> Result<(), NoLinearSystem> {
    let system = straightened(model, compile_about_rest(model)?);
    let full = straightened(model, compile(model, AnalysisKind::Dynamics)?);
    if full.states.len() == system.states.len() {
        return rest(&system, pose, control, told);
    }
    // Currents are states, whose rates vanish at rest; there the mechanism is where it is with currents that follow at once.
    let steady = modes::at_rest(&system, pose, control, |_, held, _, _| {
        let mut inputs = Inputs::still(&full);
        inputs.drive.clone_from(&held.inputs.drive);
        let currents = full.states.iter().zip(full.inputs.len()..);
        let values: Vec<f64> = currents
            .skip(system.states.len())
            .map(|(current, index)| {
                let mut rate = |value: f64| {
                    inputs.states[index] = value;
                    let at = held.driven.evaluation.kinematics(&inputs);
                    current.rate.value(&at)
                };
                let [none, one] = [0.0, 1.0].map(&mut rate);
                none / (none - one)
            })
            .collect();
        (held.q.clone(), values)
    });
    let (q, currents) = steady?;
    let mut full = full;
    let first = full.states.len() - currents.len();
    for (state, current) in full.states[first..].iter_mut().zip(currents) {
        state.start = current;
    }
    full.guess = q;
    full.initial.clear();
    rest(&full, pose, control, told)
}

fn rest(
    system: &System,
    pose: bool,
    control: &Control,
    told: ToldPoint,
) -> Result<(), NoLinearSystem> {
    modes::at_rest(
        system,
        pose,
        control,
        |assembled, held, balance, contacts| {
            let own = held.driven.system;
            let mut warnings = assembled.warnings.clone();
            warnings.extend(warning(balance).filter(|_| !pose));
            warnings.extend(friction_left_out(own));
            let pressed: Vec<bool> = contacts.iter().map(|contact| contact.state > 0.0).collect();
            let is_rigid =
                |contact: usize| matches!(own.contacts[contact].surface, Surface::Rigid(_));
            let hold = |(contact, pressed): (usize, &bool)| match *pressed && is_rigid(contact) {
                true => Hold::Slides,
                false => Hold::Free,
            };
            told(OperatingPoint {
                system: own,
                columns: held.columns(),
                q: &held.q.clone(),
                v: &vec![0.0; own.n()],
                inputs: held.inputs.clone(),
                holds: pressed.iter().enumerate().map(hold).collect(),
                pressed,
                rubs: false,
                time: None,
                equilibrium: Some(described(held, balance)),
                warnings,
            })
        },
    )?
}

/// The instants of the motion that the model's analysis has, in the order of time.
///
/// # Errors
/// Where there is no such motion, or no such instant.
pub fn along(
    model: &Checked,
    times: &[f64],
    control: &Control,
    told: ToldPoint,
) -> Result<(), NoLinearSystem> {
    let no_motion = |why: &str, hint: &str| {
        let complaint = Complaint::new("analysis", why).hint(hint);
        NoLinearSystem::Model(complaint.into())
    };
    let hint = "use \"kinematics\", \"inverse_dynamics\" or \"dynamics\", or linearise about rest";
    let Some(analysis) = &model.analysis else {
        return Err(no_motion(
            "the model has no analysis, and so no motion to linearise along",
            hint,
        ));
    };
    let system = straightened(model, compile(model, AnalysisKind::Dynamics)?);
    let question = Question::new(&system, analysis).map_err(Complaints::from)?;
    match question.kind {
        Kind::Prescribed | Kind::Free => {}
        Kind::Position | Kind::Rest | Kind::Slow => {
            return Err(no_motion(
                "this analysis has no motion to linearise along",
                hint,
            ));
        }
    }
    let instants = question.instants.list(&system).map_err(Complaints::from)?;
    let end = instants
        .iter()
        .fold(0.0, |end: f64, instant| end.max(instant.time));
    let mut times = times.to_vec();
    for time in &times {
        if !(0.0..=end).contains(time) {
            let [time, end] = [*time, end].map(|time| system.display.time(time));
            return Err(NoLinearSystem::Question(format!(
                "at {time}: the motion is known from 0 to {end}"
            )));
        }
    }
    times.sort_by(f64::total_cmp);
    times.dedup();
    remembers(&system)?;
    if let Some(complaint) = assembly::too_short(&system) {
        return Err(NoLinearSystem::Model(complaint.into()));
    }
    let is_prescribed = question.kind == Kind::Prescribed
        || dynamics::Start::of(&system)?.is_driven(&system) && system.timed.is_empty();
    match is_prescribed {
        true => prescribed(&system, &question, &times, control, told),
        false => {
            let mut settings = question.dynamics(&system)?;
            settings.watched = None;
            let start = dynamics::Start::of(&system)?;
            dynamics::visit(&system, start, &settings, &times, control, &mut |visited| {
                let no_contacts = vec![false; visited.holds.len()];
                told(OperatingPoint {
                    system: visited.system,
                    columns: visited.columns,
                    q: visited.q,
                    v: visited.v,
                    inputs: visited.inputs,
                    holds: visited.holds,
                    pressed: no_contacts,
                    rubs: true,
                    time: Some(visited.time),
                    equilibrium: None,
                    warnings: Vec::new(),
                })
            })?
        }
    }
}

/// Refuses bristles: they are states that have no names here.
fn remembers(system: &System) -> Result<(), NoLinearSystem> {
    let said = |path: String| {
        let message = "bristles are states of their own, which a linear system does not have";
        let complaint = Complaint::new(path, message).found("\"lugre\"");
        NoLinearSystem::Model(complaint.hint("use \"stribeck\"").into())
    };
    let mut joints = system.joints.iter();
    let rubs = |force: usize| {
        system.dependent_forces[force]
            .force
            .memory_scale()
            .is_some()
    };
    let own = joints.find(|joint| joint.extras().friction.is_some_and(|own| rubs(own.force)));
    if let Some(joint) = own {
        return Err(said(format!("joints.{}.friction.law", joint.name)));
    }
    let mut contacts = system.contacts.iter().zip(0..);
    let bristles = contacts.find(|(pair, _)| match &pair.surface {
        Surface::Compliant(laws) => laws.friction.has_bristle(),
        Surface::Rigid(_) => false,
    });
    match bristles {
        Some((_, contact)) => {
            let path = system.owner_path(ContactId(contact));
            Err(said(path))
        }
        None => Ok(()),
    }
}

/// A motion that the drivers prescribe.
fn prescribed(
    system: &System,
    question: &Question,
    times: &[f64],
    control: &Control,
    told: ToldPoint,
) -> Result<(), NoLinearSystem> {
    if let Some(joint) = system
        .joints
        .iter()
        .find(|joint| joint.clearance().is_some())
    {
        let path = format!("joints.{}.clearance.model", joint.name);
        let message = "a massless clearance link takes its direction from the force of the instant: that is no motion of a linear system";
        return Err(NoLinearSystem::Model(
            Complaint::new(path, message).hint("use \"ideal\"").into(),
        ));
    }
    let settings = driven::Settings {
        at_events: false,
        contents: Contents {
            velocities: true,
            accelerations: true,
            reactions: false,
            friction: false,
        },
        kept: Some(Vec::new()),
        ..question.driven()
    };
    let (_, report, between) = driven::run(system, settings, control)?;
    let failed = |message: String| NoLinearSystem::Failed {
        status: Status::Singular,
        message,
    };
    let mut between = between.ok_or_else(|| failed("the motion can't be followed".into()))?;
    for &time in times {
        let Some((q, v, inputs)) = between.point(time) else {
            let message = report.message.clone().unwrap_or_else(|| {
                format!(
                    "at t = {} the mechanism is in a singular position, or beside one, where motions about it have no linear equations",
                    system.display.time(time)
                )
            });
            return Err(failed(message));
        };
        told(OperatingPoint {
            system,
            columns: Vec::new(),
            q,
            v,
            inputs: inputs.clone(),
            holds: vec![Hold::Free; system.contacts.len()],
            pressed: vec![false; system.contacts.len()],
            rubs: true,
            time: Some(time),
            equilibrium: None,
            warnings: report.warnings.clone(),
        })?;
    }
    Ok(())
}

impl OperatingPoint<'_> {
    /// What contacts do there, in words.
    pub fn phases(&self) -> Vec<String> {
        let contacts = self.inputs.contacts.iter().zip(&self.holds).enumerate();
        let told = contacts.filter_map(|(contact, (memory, hold))| {
            let name = self.system.contact_name(ContactId(contact));
            let pressed = self.pressed.get(contact) == Some(&true);
            let what = match (hold, memory.phase) {
                (Hold::Slides, _) => "is held as a constraint",
                (Hold::Sticks, _) => "sticks, held as a constraint",
                (Hold::Free, Phase::Flight) if pressed => "presses",
                (Hold::Free, Phase::Flight) => return None,
                (Hold::Free, _) => "is in contact",
            };
            Some(format!("{name} {what}"))
        });
        told.collect()
    }
}
