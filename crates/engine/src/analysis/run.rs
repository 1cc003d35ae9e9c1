//! From a model to a trajectory and a report.

use super::bent::straightened;
use super::channels::{Channels, Contents};
use super::control::{Control, Stop};
use super::derived_columns::{DerivedColumns, DerivedSelection};
use super::driven::Between;
use super::needed::{Needed, behind};
use super::outcome::Outcome;
use super::question::{Kind, Question};
use super::record::Recorder;
use super::responses::{Answer, Responses};
use super::rows::Columns;
use super::sample::Sample;
use super::settings::settings;
use super::{assembly, belts, driven, dynamics, quasi_statics, statics};
use crate::system::{Evaluation, Inputs, System, compile::compile};
use linkdyn_model::error::{Complaint, Complaints};
use linkdyn_model::{Checked, unheld};
use linkdyn_output::{Column, Quality, Report, Status, Stopwatch, Trajectory};
use std::fmt;
use std::sync::Arc;
use std::sync::atomic::Ordering;

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
    /// Nothing else is wanted of its runs.
    responses_alone: bool,
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
        let system = straightened(model, system);
        let question = Question::new(&system, analysis);
        let question = question.map_err(|complaint| loose(complaint.into()))?;
        one_freedom(&system).map_err(|complaint| loose(complaint.into()))?;
        Ok(Prepared {
            responses: responses(model, &system, &question)?,
            responses_alone: false,
            question,
            settings: settings(analysis),
            system,
            unheld,
        })
    }

    /// Runs for the responses alone: columns that none of them needs have no peaks between the outputs.
    #[must_use]
    pub fn for_responses(self) -> Self {
        Prepared {
            responses_alone: true,
            ..self
        }
    }

    /// Runs for the columns alone that `analysis.columns` asks for: where nothing else is read from them, rows have no others, so that
    /// [`Outcome::all`] has no others either.
    #[must_use]
    pub fn for_columns(mut self) -> Self {
        if self.responses.is_empty() {
            self.question.keep_asked(&self.system);
        }
        self
    }

    /// The columns of the results.
    pub fn columns(&self) -> Arc<[Column]> {
        let mut columns = self.question.contents.columns(&self.system);
        columns.extend(self.question.following.headings());
        columns.into()
    }

    /// What it was compiled to, and what is asked of it.
    pub(super) fn parts(&self) -> (&System, &Question) {
        (&self.system, &self.question)
    }

    /// What it was compiled to.
    pub fn system(&self) -> &System {
        &self.system
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
        let mut solved = match self.solve(control) {
            Ok(found) => found,
            Err(Stop::Input(complaints)) => return Err(complaints.into()),
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
                Solved::rows((trajectory, report))
            }
        };
        let responses = self.answers(&mut solved);
        if self.system.contacts.is_empty() || self.question.kind != Kind::Free {
            // those of smooth motions are looked for where a response needs them
            solved.peaks = Trajectory::default();
        }
        let Solved {
            trajectory,
            peaks,
            mut report,
            ..
        } = solved;
        report
            .warnings
            .extend(belts::notes(&self.system, &trajectory));
        let (trajectory, peaks) = self.with_following((trajectory, peaks), &mut report);
        let patterns = &self.question.columns;
        let (selected, warnings) = match patterns.is_empty() {
            true => (None, Vec::new()),
            false => {
                let contents = self.question.contents;
                let offered = DerivedSelection::all(&self.system, contents).headings();
                let left_out = self.question.kept.as_ref();
                let left_out = left_out.map_or_else(Vec::new, |_| contents.columns(&self.system));
                trajectory.select_beside(patterns, &[left_out, offered].concat())
            }
        };
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

    /// Outputs and peaks with the columns that follow from their rows; the report says where these are empty.
    fn with_following(
        &self,
        (outputs, peaks): (Trajectory, Trajectory),
        report: &mut Report,
    ) -> (Trajectory, Trajectory) {
        let Question {
            contents,
            following,
            ..
        } = &self.question;
        if following.is_empty() {
            return (outputs, peaks);
        }
        let columns = Columns::of(&contents.columns(&self.system));
        let mut beside = DerivedColumns::new(&self.system, &columns, following);
        let outputs = beside.appended(&outputs);
        report.warnings.extend(beside.notes());
        let peaks = match peaks.width() {
            0 => peaks,
            _ => beside.appended(&peaks),
        };
        (outputs, peaks)
    }

    /// The responses of what was solved.
    fn answers(&self, solved: &mut Solved) -> Vec<Answer> {
        if self.responses.is_empty() {
            return Vec::new();
        }
        let Solved {
            trajectory,
            peaks,
            report,
            between,
        } = solved;
        let mut wanted = Needed::new(
            &self.system,
            &self.question,
            &self.responses,
            &trajectory.columns,
        );
        let channels = Channels::new(&self.system, self.question.contents);
        let mut whole = Vec::with_capacity(trajectory.columns.len());
        let mut motion = between.take();
        let mut evaluation = self.responses.begin();
        let mut needed = Vec::with_capacity(self.responses.needed().len());
        for row in trajectory.rows() {
            wanted.take(row, &mut needed);
            evaluation.row(&needed);
        }
        for row in peaks.rows() {
            wanted.take(row, &mut needed);
            evaluation.between(&needed);
        }
        evaluation.ask(report, &mut |time, needed| {
            whole.clear();
            let is_known =
                (motion.as_mut()).is_some_and(|motion| motion.row(&channels, time, &mut whole));
            if is_known {
                wanted.take(&whole, needed);
            }
            is_known
        });
        evaluation.answers(report)
    }

    /// Goes where a run has its first instant, by the same way.
    ///
    /// # Errors
    /// What [`Prepared::run`] refuses, and why a run ends before it has anything.
    pub(super) fn admit(&self) -> Result<(), Stop> {
        let control = Control::default();
        control.interrupted.store(true, Ordering::Relaxed);
        match self.solve(&control) {
            Err(stop) if !stop.is_of(Status::Interrupted) => Err(stop),
            Ok(_) | Err(_) => Ok(()),
        }
    }

    /// The motion at t = 0, to be stepped from outside.
    ///
    /// # Errors
    /// What [`Prepared::run`] refuses, a motion that is not integrated, and a start that is impossible.
    pub fn begin(&self, steered: &[usize]) -> Result<dynamics::Stepped, Stop> {
        let (system, question) = (&self.system, &self.question);
        self.complete(|| {
            if question.kind != Kind::Free {
                let message = "only dynamics can be stepped, which integrates a motion";
                let complaint = Complaint::new("analysis.type", message);
                return Err(complaint.hint("use \"dynamics\"").into());
            }
            let start = self.start()?;
            if start.is_driven(system) && steered.is_empty() {
                let message =
                    "drivers prescribe the whole motion, so that there is nothing to step";
                let complaint = Complaint::new("drivers", message);
                return Err(complaint.hint("drive by forces instead").into());
            }
            let mut settings = question.dynamics(system)?;
            settings.watched = None;
            dynamics::Stepped::new(system, start, &settings, &question.following, steered)
        })
    }

    /// Where a motion that is integrated starts.
    fn start(&self) -> Result<dynamics::Start, Stop> {
        if let Some(complaint) = assembly::too_short(&self.system) {
            return Err(complaint.into());
        }
        dynamics::Start::of(&self.system)
    }

    /// What the analysis finds.
    fn solve(&self, control: &Control) -> Result<Solved<'_>, Stop> {
        self.complete(|| self.found(control))
    }

    /// Complaints of an attempt with what else may be the cause.
    fn complete<T>(&self, attempt: impl FnOnce() -> Result<T, Stop>) -> Result<T, Stop> {
        attempt().map_err(|stop| match stop {
            Stop::Input(complaints) => Stop::Input(with(complaints.into(), self.unheld.as_ref()).0),
            failed @ Stop::Failed { .. } => failed,
        })
    }

    fn found(&self, control: &Control) -> Result<Solved<'_>, Stop> {
        let (system, question) = (&self.system, &self.question);
        let prescribed = || {
            let (trajectory, report, between) = driven::run(system, question.driven(), control)?;
            Ok(Solved {
                between,
                ..Solved::rows((trajectory, report))
            })
        };
        match question.kind {
            Kind::Position => run_assembly(system, question.contents).map(Solved::rows),
            Kind::Prescribed => prescribed(),
            Kind::Free => {
                let start = self.start()?;
                if start.is_driven(system) && system.timed.is_empty() {
                    return prescribed();
                }
                let mut settings = question.dynamics(system)?;
                if settings.watched.is_none() || self.responses_alone {
                    let needed = || self.responses.columns().map(str::to_owned).collect();
                    settings.watched = self.responses.look_between().then(needed);
                }
                let found = dynamics::run(system, start, &settings, control)?;
                let (trajectory, peaks, report) = found;
                Ok(Solved {
                    peaks,
                    ..Solved::rows((trajectory, report))
                })
            }
            Kind::Rest => statics::run(system, question.contents, control).map(Solved::rows),
            Kind::Slow => {
                let (trajectory, report, between) = quasi_statics::run(system, question, control)?;
                Ok(Solved {
                    between,
                    ..Solved::rows((trajectory, report))
                })
            }
        }
    }
}

/// Outputs are of mechanisms that move in one way, or by one of several drivers that determine the motion. Near a position ranks are highest, so that more freedom there is more
/// everywhere, unless it is singular itself, which the count is not; less may be redundancy.
fn one_freedom(system: &System) -> Result<(), Complaint> {
    if system.outputs.is_empty() {
        return Ok(());
    }
    let mobility = assembly::counted(system);
    let freedom = mobility.rank;
    let are_driven = freedom == system.drivers.len() as i64;
    let mut outputs = system.outputs.iter();
    let unclear = outputs.find(|output| !are_driven || output.by.is_none());
    let (2.., Some(output)) = (freedom.min(mobility.grubler), unclear) else {
        return Ok(());
    };
    let message = format!(
        "a ratio of velocities wants a mechanism with one degree of freedom, and this one has {freedom} without its drivers"
    );
    let complaint = Complaint::new(format!("outputs.{}", output.name), message);
    let mut joints = system.joints.iter();
    let is_open =
        joints.any(|joint| joint.extras().bearing.is_some() && joint.extras().contact.is_some());
    Err(complaint.hint(match is_open {
        false if are_driven => {
            "divide by a driver, d(rod.B.x)/d(driver.left): the others stand still beside it"
        }
        false => "hold what shall not move by joints",
        true => {
            "journals that move in their bearings count: give the clearances the model \"ideal\""
        }
    }))
}

/// The responses of a model, of its result columns and what follows from them.
fn responses(
    model: &Checked,
    system: &System,
    question: &Question,
) -> Result<Responses, Complaints> {
    if model.responses.is_empty() {
        return Ok(Responses::default());
    }
    let mut columns = question.contents.columns(system);
    columns.extend(behind(system, question));
    Responses::new(model, &columns)
}

/// What an analysis finds.
struct Solved<'s> {
    /// The outputs.
    trajectory: Trajectory,
    /// Rows of peaks between them.
    peaks: Trajectory,
    /// How it went.
    report: Report,
    /// The motion, where it can be asked for other rows.
    between: Option<Between<'s>>,
}

impl Solved<'_> {
    /// Rows that are all there is.
    fn rows((trajectory, report): (Trajectory, Report)) -> Self {
        Solved {
            trajectory,
            peaks: Trajectory::default(),
            report,
            between: None,
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
        warnings: [assembled.warnings, recorder.warnings(system)].concat(),
        ..Report::default()
    };
    report.statistics.newton_iterations = assembled.iterations;
    report.quality.constraint_residual = system.scaled_residual(&evaluation.phi);
    report.assemble = clock.read();
    Ok((recorder.trajectory, report))
}
