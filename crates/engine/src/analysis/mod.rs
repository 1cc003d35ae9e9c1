//! The analyses: from a model to a trajectory and a report.

mod applied;
pub mod assembly;
mod branch;
pub mod channels;
pub mod check;
pub mod clearance_link;
pub mod derived;
pub mod driven;
pub mod dynamics;
mod in_line;
mod instants;
pub mod modes;
mod overlap;
mod power;
mod progress;
mod question;
mod readings;
pub mod record;
mod rows;
pub mod sample;
mod shaking;
pub mod statics;
mod suspicious;
mod transmission;

pub use check::{Check, Lack, check};
pub use modes::{Linearised, Mode, modes};
pub use progress::Progress;
pub use suspicious::suspicious;

use crate::system::{Evaluation, Inputs, System, compile::compile};
use channels::{Channels, Contents};
use linkdyn_model::error::Complaint;
use linkdyn_model::{AnalysisKind, Checked, OutputsAt, unheld};
use linkdyn_output::{Column, Event, Quality, Report, Status, Stopwatch, Trajectory};
use record::Recorder;
use sample::Sample;
use std::borrow::Cow;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

/// Outside influence on a run.
#[derive(Debug, Clone, Default)]
pub struct Control {
    /// When to give up (`max_wall_time`).
    pub deadline: Option<Instant>,
    /// Set when the user wants the run to stop.
    pub interrupted: Arc<AtomicBool>,
    /// How far the run has come.
    pub progress: Progress,
}

impl Control {
    /// The reason to stop now, if there is one.
    pub fn stop(&self) -> Option<Status> {
        if self.interrupted.load(Ordering::Relaxed) {
            return Some(Status::Interrupted);
        }
        self.deadline
            .is_some_and(|deadline| Instant::now() >= deadline)
            .then_some(Status::TimeLimit)
    }
}

/// What a run leaves.
#[derive(Debug, Clone)]
pub struct Outcome {
    /// The columns that are wanted.
    pub trajectory: Trajectory,
    /// All columns, where `analysis.columns` leaves some out.
    pub complete: Option<Trajectory>,
    /// Rows between the outputs, by time, all columns: of motions with contacts those where columns have extremes, and where
    /// contacts begin, press most and end.
    pub peaks: Trajectory,
    pub report: Report,
    /// The analysis as resolved, for the summary.
    pub settings: serde_json::Value,
}

impl Outcome {
    /// All columns that were computed, wanted or not.
    pub fn all(&self) -> &Trajectory {
        self.complete.as_ref().unwrap_or(&self.trajectory)
    }

    /// The columns that are wanted, with the rows of peaks among the outputs: what extremes and curves come from.
    pub fn curves(&self) -> Cow<'_, Trajectory> {
        self.trajectory.with_rows(&self.peaks)
    }

    /// The rows of peaks, with the columns that are wanted.
    pub fn wanted_peaks(&self) -> Trajectory {
        Trajectory::with_columns(&self.trajectory.columns)
            .with_rows(&self.peaks)
            .into_owned()
    }

    /// All columns, with the rows of peaks among the outputs.
    pub fn all_curves(&self) -> Cow<'_, Trajectory> {
        self.all().with_rows(&self.peaks)
    }
}

/// Why a run can't go on.
#[derive(Debug, Clone, PartialEq)]
pub enum Stop {
    /// The input is bad.
    Input(Vec<Complaint>),
    /// Numerics or geometry forbid to go on.
    Failed { status: Status, message: String },
}

impl Stop {
    pub fn failed(status: Status, message: String) -> Self {
        Stop::Failed { status, message }
    }
}

/// Runs the model's analysis.
///
/// # Errors
/// Faults of the input: no analysis, a clearance model that the analysis has no place for, missing data, too few or too
/// many drivers. Everything else ends in the report's status, with what was computed until then.
pub fn run(model: &Checked, control: &Control) -> Result<Outcome, Vec<Complaint>> {
    let Some(analysis) = &model.analysis else {
        return Err(vec![Complaint::new("analysis", "the model says no analysis to run").hint(
            "add \"analysis\": { \"type\": \"kinematics\", \"end\": 1, \"outputs\": 101 }, or use `linkdyn check`",
        )]);
    };
    // Data or drivers may be missing only because the fixed body has another name.
    let loose = |mut complaints: Vec<Complaint>| {
        complaints.extend(unheld(model));
        complaints
    };
    let system = compile(model, analysis.kind).map_err(loose)?;
    let without_peaks = |(trajectory, report)| (trajectory, Trajectory::default(), report);
    let outcome = match analysis.kind {
        AnalysisKind::Assembly => run_assembly(&system).map(without_peaks),
        // Journals that move freely in their bearings leave the mechanism free to move, however it is driven.
        AnalysisKind::Kinematics | AnalysisKind::InverseDynamics if system.contacts.is_empty() => {
            driven::run(&system, analysis, control).map(without_peaks)
        }
        AnalysisKind::Kinematics | AnalysisKind::InverseDynamics | AnalysisKind::Dynamics => {
            question::run(&system, analysis, contents(analysis.kind), control)
        }
        AnalysisKind::Statics => statics::run(&system, control).map(without_peaks),
    };
    let (trajectory, peaks, mut report) = match outcome {
        Ok(found) => found,
        Err(Stop::Input(complaints)) => return Err(loose(complaints)),
        Err(Stop::Failed { status, message }) => {
            let trajectory = Recorder::new(&system, contents(analysis.kind), 0).trajectory;
            // Of no position there is no residual.
            let quality = Quality {
                constraint_residual: f64::NAN,
                ..Quality::default()
            };
            let mobility = assembly::counted(&system);
            without_peaks((
                trajectory,
                Report {
                    status,
                    message: Some(message),
                    mobility,
                    quality,
                    ..Report::default()
                },
            ))
        }
    };
    let (selected, warnings) = trajectory.select(&analysis.columns);
    report.warnings.extend(warnings);
    let (trajectory, complete) = match selected {
        Some(selected) => (selected, Some(trajectory)),
        None => (trajectory, None),
    };
    Ok(Outcome {
        trajectory,
        complete,
        peaks,
        report,
        settings: settings(analysis),
    })
}

/// The columns of the results of the model's analysis, without running it; none where it says no analysis.
///
/// # Errors
/// Faults of the input that come up when it is compiled.
pub fn columns(model: &Checked) -> Result<Arc<[Column]>, Vec<Complaint>> {
    let Some(analysis) = &model.analysis else {
        return Ok(Arc::new([]));
    };
    let system = compile(model, analysis.kind)?;
    Ok(Arc::clone(
        Channels::new(&system, contents(analysis.kind)).columns(),
    ))
}

/// Whether joint forces are among the results.
fn has_reactions(kind: AnalysisKind) -> bool {
    match kind {
        AnalysisKind::Assembly | AnalysisKind::Kinematics => false,
        AnalysisKind::InverseDynamics | AnalysisKind::Dynamics | AnalysisKind::Statics => true,
    }
}

/// What an analysis leaves in the results.
fn contents(kind: AnalysisKind) -> Contents {
    let (velocities, accelerations) = match kind {
        AnalysisKind::Assembly => (true, false),
        AnalysisKind::Kinematics | AnalysisKind::InverseDynamics | AnalysisKind::Dynamics => {
            (true, true)
        }
        AnalysisKind::Statics => (false, false),
    };
    Contents {
        velocities,
        accelerations,
        reactions: has_reactions(kind),
    }
}

/// An analysis as the file calls it.
fn kind_word(kind: AnalysisKind) -> &'static str {
    match kind {
        AnalysisKind::Assembly => "assembly",
        AnalysisKind::Kinematics => "kinematics",
        AnalysisKind::InverseDynamics => "inverse_dynamics",
        AnalysisKind::Dynamics => "dynamics",
        AnalysisKind::Statics => "statics",
    }
}

/// The analysis as resolved.
fn settings(analysis: &linkdyn_model::Analysis) -> serde_json::Value {
    let solver = &analysis.solver;
    let mut json = serde_json::json!({
        "type": kind_word(analysis.kind),
        "end": analysis.end,
        "outputs": analysis.outputs,
        "sample": analysis.sample.as_ref().map(|sample| serde_json::json!({
            "driver": sample.driver, "from": sample.from, "to": sample.to, "step": sample.step,
        })),
        "outputs_at": (analysis.outputs_at == OutputsAt::Events).then_some("events"),
        "solver": {
            "method": solver.method, "rtol": solver.rtol, "atol": solver.atol, "max_step": solver.max_step,
            "initial_step": solver.initial_step, "max_wall_time": solver.max_wall_time,
        },
        "columns": analysis.columns,
        "transmission": analysis.transmission.as_ref().map(|transmission| serde_json::json!({
            "driver": transmission.driver, "output": transmission.output,
        })),
    });
    // What is left out in the file is left out here.
    if let Some(map) = json.as_object_mut() {
        map.retain(|_, value| !value.is_null());
        if let Some(solver) = map
            .get_mut("solver")
            .and_then(|solver| solver.as_object_mut())
        {
            solver.retain(|_, value| !value.is_null());
        }
    }
    json
}

/// The position at t = 0, with the velocities of least kinetic energy.
fn run_assembly(system: &System) -> Result<(Trajectory, Report), Stop> {
    let clock = Stopwatch::start();
    let inputs = Inputs::at_time(system, 0.0);
    let assembled = assembly::assemble(system, &inputs)?;
    let mut sample = Sample::new(system);
    sample.v = assembly::velocities(system, &assembled.q, &inputs)?;
    sample.q = assembled.q;
    let mut evaluation = Evaluation::new(system);
    evaluation.set_position(&sample.q);
    evaluation.set_velocity(&sample.v);
    evaluation.eval_phi(system, &inputs);
    let mut recorder = Recorder::new(system, contents(AnalysisKind::Assembly), 1);
    recorder.push(system, &evaluation, &inputs, &sample);
    let mut report = Report {
        mobility: assembled.mobility,
        warnings: assembled.warnings,
        ..Report::default()
    };
    report.statistics.newton_iterations = assembled.iterations;
    report.quality.constraint_residual = system.scaled_residual(&evaluation.phi);
    report.assemble = clock.read();
    Ok((recorder.trajectory, report))
}

/// What to say where a force that depends on multipliers has no finite size.
fn locked(system: &System, force: usize) -> String {
    let block = &system.blocks[system.dependent_forces[force].block];
    format!(
        "{} locks itself: its friction grows with its reaction faster than it can be balanced (no motion satisfies the \
         equations)",
        system.origin_name(&block.origin)
    )
}

/// What to say of friction from reactions that are not the only ones possible.
fn unsure_friction(system: &System, not_unique: &[String]) -> Option<String> {
    let rubbing = system
        .joints
        .iter()
        .filter(|joint| joint.friction.is_some() && not_unique.contains(&joint.name));
    let names: Vec<&str> = rubbing.map(|joint| joint.name.as_str()).collect();
    (!names.is_empty()).then(|| {
        format!(
            "the friction of {} follows from reactions of least norm, which are not the only ones",
            names.join(", ")
        )
    })
}

/// What to say where nothing moves.
fn friction_left_out(system: &System) -> Option<String> {
    let rubbing = system
        .joints
        .iter()
        .filter(|joint| joint.friction.is_some());
    let names: Vec<&str> = rubbing.map(|joint| joint.name.as_str()).collect();
    (!names.is_empty()).then(|| {
        format!(
            "the friction of {} is left out: at rest it can hold the mechanism in many positions, this is the one that needs none",
            names.join(", ")
        )
    })
}

/// Joins consecutive instants of one kind into an event over an interval.
#[derive(Debug, Default)]
struct Interval {
    open: Option<Event>,
}

impl Interval {
    /// The instant belongs to the interval.
    fn extend(&mut self, kind: &'static str, time: f64, driver: Option<(String, f64)>, note: &str) {
        let value = driver.as_ref().map(|(_, value)| *value);
        match &mut self.open {
            Some(event) => {
                event.end_time = Some(time);
                event.end_value = value;
            }
            None => {
                self.open = Some(Event {
                    kind,
                    time,
                    end_time: Some(time),
                    driver: driver.map(|(name, _)| name),
                    value,
                    end_value: value,
                    note: Some(note.to_string()),
                    ..Event::default()
                });
            }
        }
    }

    /// The interval ends before this instant.
    fn close(&mut self, events: &mut Vec<Event>) {
        events.extend(self.open.take());
    }
}
