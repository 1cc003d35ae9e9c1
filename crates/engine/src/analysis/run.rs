//! From a model to a trajectory and a report.

use super::channels::{Channels, Contents};
use super::control::{Control, Stop};
use super::outcome::Outcome;
use super::question::{Kind, Question};
use super::record::Recorder;
use super::responses::Responses;
use super::sample::Sample;
use super::settings::settings;
use super::{assembly, driven, dynamics, statics};
use crate::system::{Evaluation, Inputs, System, compile::compile};
use linkdyn_model::error::{Complaint, Complaints};
use linkdyn_model::{Checked, unheld};
use linkdyn_output::{Column, Quality, Report, Stopwatch, Trajectory};
use std::fmt;
use std::sync::Arc;

/// Runs the model's analysis.
///
/// # Errors
/// See [`Prepared::new`] and [`Prepared::run`].
pub fn run(model: &Checked, control: &Control) -> Result<Outcome, Complaints> {
    Prepared::new(model)?.run(control)
}

/// A model compiled for its own analysis. It runs as often as wanted, from any thread.
pub struct Prepared {
    system: System,
    question: Question,
    /// The analysis as resolved, for the summary.
    settings: serde_json::Value,
    responses: Responses,
    /// Data or drivers may be missing only because the fixed body has another name.
    unheld: Option<Complaint>,
}

impl fmt::Debug for Prepared {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut debug = f.debug_struct("Prepared");
        debug.field("question", &self.question);
        debug.finish_non_exhaustive()
    }
}

impl Prepared {
    /// Compiles a model for its analysis.
    ///
    /// # Errors
    /// Faults of the input: no analysis, a clearance model that the analysis has no place for, missing data.
    pub fn new(model: &Checked) -> Result<Self, Complaints> {
        let Some(analysis) = &model.analysis else {
            return Err(Complaint::new("analysis", "the model says no analysis to run").hint(
                "add \"analysis\": { \"type\": \"kinematics\", \"end\": 1, \"outputs\": 101 }, or use `linkdyn check`",
            ).into());
        };
        let unheld = unheld(model);
        let loose = |complaints| with(complaints, unheld.as_ref());
        let system = compile(model, analysis.kind).map_err(loose)?;
        let question = Question::new(&system, analysis);
        let question = question.map_err(|complaint| loose(complaint.into()))?;
        let channels = Channels::new(&system, question.contents);
        Ok(Prepared {
            responses: Responses::new(model, channels.columns())?,
            question,
            settings: settings(analysis),
            system,
            unheld,
        })
    }

    /// The columns of the results.
    pub fn columns(&self) -> Arc<[Column]> {
        let channels = Channels::new(&self.system, self.question.contents);
        Arc::clone(channels.columns())
    }

    /// What it was compiled to, and what is asked of it.
    pub(super) fn parts(&self) -> (&System, &Question) {
        (&self.system, &self.question)
    }

    /// The named numbers that runs have.
    pub fn responses(&self) -> &Responses {
        &self.responses
    }

    /// Runs the analysis.
    ///
    /// # Errors
    /// Faults of the input: too few or too many drivers, what an analysis has no place for. Everything else ends in the
    /// report's status, with what was computed until then.
    pub fn run(&self, control: &Control) -> Result<Outcome, Complaints> {
        let (trajectory, peaks, mut report) = match self.solve(control) {
            Ok(found) => found,
            Err(Stop::Input(complaints)) => {
                return Err(with(complaints.into(), self.unheld.as_ref()));
            }
            Err(Stop::Failed { status, message }) => {
                let trajectory = Recorder::new(&self.system, self.question.contents, 0).trajectory;
                // Of no position there is no residual.
                let quality = Quality {
                    constraint_residual: f64::NAN,
                    ..Quality::default()
                };
                let report = Report {
                    status,
                    message: Some(message),
                    mobility: assembly::counted(&self.system),
                    quality,
                    ..Report::default()
                };
                (trajectory, Trajectory::default(), report)
            }
        };
        let responses = self.responses.answers(&trajectory, &peaks, &report);
        let (selected, warnings) = trajectory.select(&self.question.columns);
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
            responses,
            settings: self.settings.clone(),
        })
    }

    /// The outputs, rows of peaks between them, and how it went.
    fn solve(&self, control: &Control) -> Result<(Trajectory, Trajectory, Report), Stop> {
        let (system, question) = (&self.system, &self.question);
        let without_peaks = |(trajectory, report)| (trajectory, Trajectory::default(), report);
        let prescribed = || driven::run(system, question.driven(), control).map(without_peaks);
        match question.kind {
            Kind::Position => run_assembly(system, question.contents).map(without_peaks),
            Kind::Prescribed => prescribed(),
            Kind::Free => {
                if let Some(complaint) = assembly::too_short(system) {
                    return Err(Stop::Input(vec![complaint]));
                }
                let start = dynamics::Start::of(system)?;
                if start.is_driven(system) {
                    return prescribed();
                }
                dynamics::run(system, start, &question.dynamics(system)?, control)
            }
            Kind::Rest => statics::run(system, question.contents, control).map(without_peaks),
        }
    }
}

/// Complaints with one more.
fn with(mut complaints: Complaints, more: Option<&Complaint>) -> Complaints {
    complaints.0.extend(more.cloned());
    complaints
}

/// The position at t = 0, with the velocities of least kinetic energy.
fn run_assembly(system: &System, contents: Contents) -> Result<(Trajectory, Report), Stop> {
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
    let mut recorder = Recorder::new(system, contents, 1);
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
