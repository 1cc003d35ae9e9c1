//! Forward dynamics: the motion that forces and masses bring about, with drivers where there are some.
//!
//! Integrated are minimal coordinates y = (u, u̇) (see [`crate::solve::reduced`]), by a method of [`crate::integrate`];
//! positions and velocities of everything else follow from the constraints at every stage, so nothing drifts. Outputs come
//! from the method's continuous extension and are put exactly onto the constraints.

use super::assembly::{Assembled, assemble, is_singular_start, velocities};
use super::instants::instants;
use super::record::{Contents, Recorder, Sample};
use super::{Control, Stop};
use crate::error::Complaint;
use crate::integrate::{Limits, Method, Ode, Refused, StepFailure, Stepper, Tolerance};
use crate::math::dot;
use crate::model::{Analysis, Solver};
use crate::output::{Report, Status, Stopwatch, Trajectory};
use crate::solve::driven::{Failure, LAST_STEP};
use crate::solve::reduced::Reduced;
use crate::system::{Inputs, Origin, System};

/// Newton's step, by rtol, below which the equations are taken for those of its end: a hundredth of what the step's error
/// may be.
const LAG: f64 = 1e-2;

impl Ode for Reduced<'_> {
    fn dimension(&self) -> usize {
        2 * self.freedom()
    }

    fn eval(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), Refused> {
        self.evaluate(t, y).map_err(|_| Refused)?;
        let f = self.freedom();
        dy[..f].copy_from_slice(&y[f..]);
        dy[f..].copy_from_slice(self.accelerations());
        Ok(())
    }

    fn accept(&mut self, t: f64, y: &[f64]) {
        Reduced::accept(self, t, y);
    }
}

/// Runs the analysis.
///
/// # Errors
/// Faults of the input, and a start that is impossible.
pub fn run(system: &System, analysis: &Analysis, control: &Control) -> Result<(Trajectory, Report), Stop> {
    refuse(system, analysis)?;
    let watch = Stopwatch::start();
    let inputs = Inputs::at_time(system, 0.0);
    let assembled = assemble(system, &inputs)?;
    if assembled.all.rank == system.n() {
        // Nothing is free: the motion is that of the drivers.
        return super::driven::run(system, analysis, control);
    }
    let method = method(&analysis.solver)?;
    let v = velocities(system, &assembled.q, &inputs)?;
    let assembling = watch.read();

    let watch = Stopwatch::start();
    let mut reduced = start(system, &assembled, &v)?;
    let mut report = Report { mobility: assembled.mobility, warnings: assembled.warnings, ..Report::default() };
    report.assemble = assembling;
    let instants = instants(system, analysis).map_err(Stop::Input)?;
    let end = instants.last().map_or(0.0, |last| last.time);
    let contents = Contents { velocities: true, accelerations: true, reactions: true };
    let mut outputs = Outputs {
        system,
        recorder: Recorder::new(system, contents, instants.len()),
        sample: Sample::new(system),
        y: vec![0.0; 2 * reduced.freedom()],
        report: &mut report,
        power: 0.0,
        imbalance: 0.0,
        energy: None,
    };
    let mut solver = Integration::new(method, &analysis.solver, &mut reduced, end)
        .map_err(|failure| Stop::failed(Status::Singular, describe(failure, 0.0)))?;
    for instant in &instants {
        if let Err((status, message)) = solver.reach(&mut reduced, instant.time, control) {
            outputs.report.status = status;
            outputs.report.message = Some(message);
            break;
        }
        if outputs.record(&mut solver, &mut reduced, instant.time).is_err() {
            outputs.report.status = Status::Singular;
            outputs.report.message = Some(format!("the position at t = {} s can't be solved", instant.time));
            break;
        }
    }
    let trajectory = outputs.finish();
    solver.account(&mut report);
    let done = reduced.driven.done;
    report.statistics.newton_iterations += done.newton_iterations + assembled.iterations;
    report.statistics.factorisations += done.factorisations;
    report.solve = watch.read();
    Ok((trajectory, report))
}

/// What forward dynamics can't do.
fn refuse(system: &System, analysis: &Analysis) -> Result<(), Stop> {
    if analysis.sample.is_some() {
        return Err(Stop::Input(vec![
            Complaint::new("analysis.sample", "outputs at driver values need a motion that is prescribed")
                .hint("give \"end\" and \"outputs\" instead"),
        ]));
    }
    if let Some(joint) = system.joints.iter().find(|joint| joint.clearance.is_some()) {
        return Err(Stop::Input(vec![
            Complaint::new(
                format!("joints.{}.clearance.model", joint.name),
                "a massless clearance link takes its direction from the force of the instant, which leaves forward dynamics \
                 without a well-defined motion",
            )
            .hint("use \"ideal\", or prescribe the motion and use inverse_dynamics"),
        ]));
    }
    Ok(())
}

fn method(solver: &Solver) -> Result<Method, Stop> {
    solver.method.parse().map_err(|unknown: crate::integrate::UnknownMethod| {
        Stop::Input(vec![Complaint::new("analysis.solver.method", unknown.to_string())])
    })
}

/// The equations of motion at the assembled state.
fn start<'s>(system: &'s System, assembled: &Assembled, v: &[f64]) -> Result<Reduced<'s>, Stop> {
    let singular = || {
        Stop::failed(
            Status::Singular,
            "the start is a singular position (the constraints lose rank there), so that more than one motion leads away \
             from it; start a little beside it"
                .into(),
        )
    };
    let columns = &assembled.all.free_columns;
    let reduced = Reduced::new(system, columns, &assembled.q, v, 0.0).map_err(|failure| {
        let massless: Vec<&str> = system
            .bodies
            .iter()
            .filter(|body| body.mass == Some(0.0) || body.inertia == Some(0.0))
            .map(|body| body.name.as_str())
            .collect();
        match failure {
            Failure::Singular if !massless.is_empty() => Stop::Input(vec![
                Complaint::new(
                    "bodies",
                    format!("something free to move has neither mass nor inertia (without: {})", massless.join(", ")),
                )
                .hint("give mass and inertia to what the joints leave free"),
            ]),
            Failure::Singular | Failure::Diverged { .. } | Failure::Inconsistent { .. } => singular(),
        }
    })?;
    if is_singular_start(system, assembled, reduced.motions(), &reduced.inputs) {
        return Err(singular());
    }
    Ok(reduced)
}

/// The stepper, made anew when the minimal coordinates change.
struct Integration {
    method: Method,
    tolerance: f64,
    floor: f64,
    limits: Limits,
    stepper: Box<dyn Stepper>,
    /// Work of steppers before.
    before: [u64; 3],
    end: f64,
}

impl Integration {
    fn new(method: Method, solver: &Solver, reduced: &mut Reduced, end: f64) -> Result<Self, StepFailure> {
        let limits = Limits { initial_step: solver.initial_step, max_step: solver.max_step, ..Limits::default() };
        let mut integration = Integration {
            method,
            tolerance: solver.rtol,
            floor: solver.atol,
            limits,
            stepper: method.stepper(Tolerance { rtol: solver.rtol, atol: Vec::new() }, limits),
            before: [0; 3],
            end,
        };
        reduced.lag = LAG * solver.rtol;
        integration.restart(reduced, 0.0, solver.initial_step)?;
        Ok(integration)
    }

    fn restart(&mut self, reduced: &mut Reduced, time: f64, step: Option<f64>) -> Result<(), StepFailure> {
        let dimension = 2 * reduced.freedom();
        let tolerance = Tolerance { rtol: self.tolerance, atol: vec![self.floor; dimension] };
        let counters = self.stepper.counters();
        for (sum, part) in self.before.iter_mut().zip([counters.steps, counters.rejected, counters.evaluations]) {
            *sum += part;
        }
        let limits = Limits { initial_step: step, ..self.limits };
        self.stepper = self.method.stepper(tolerance, limits);
        let mut y = vec![0.0; dimension];
        reduced.state(&mut y);
        self.stepper.start(reduced, time, &y, self.end)
    }

    /// Steps until `time` lies within the last step.
    fn reach(&mut self, reduced: &mut Reduced, time: f64, control: &Control) -> Result<(), (Status, String)> {
        while self.stepper.t() < time {
            if let Some(status) = control.stop() {
                let why = match status {
                    Status::Interrupted => "interrupted".to_string(),
                    _ => format!("max_wall_time is over at t = {} s", self.stepper.t()),
                };
                return Err((status, format!("{why}; the rows until then are kept")));
            }
            let now = self.stepper.t();
            let stepped = reduced.repin().map_err(|_| StepFailure::Refused { t: now }).and_then(|exchanged| {
                if exchanged {
                    let step = (now - self.stepper.previous()).abs();
                    self.restart(reduced, now, (step > 0.0).then_some(step))?;
                }
                self.stepper.step(reduced, self.end)
            });
            if let Err(failure) = stepped {
                let status = match failure {
                    StepFailure::TooSmall { .. } => Status::StepTooSmall,
                    StepFailure::Refused { .. } => Status::Singular,
                };
                let culprits = match failure {
                    StepFailure::TooSmall { .. } => String::new(),
                    StepFailure::Refused { .. } => culprits(reduced),
                };
                return Err((status, format!("{}{culprits}", describe(failure, now))));
            }
        }
        Ok(())
    }

    fn account(&self, report: &mut Report) {
        let counters = self.stepper.counters();
        report.statistics.steps = self.before[0] + counters.steps;
        report.statistics.rejected = self.before[1] + counters.rejected;
        report.statistics.evaluations = self.before[2] + counters.evaluations;
    }
}

/// The joints whose constraints come nearest to contradicting each other at the last accepted point.
fn culprits(reduced: &mut Reduced) -> String {
    let system = reduced.driven.system;
    let mut joints: Vec<&str> = Vec::new();
    for row in reduced.strained_rows() {
        if let Origin::Joint(id) = system.block_of_row(row).origin
            && !joints.contains(&system.joints[id.0].name.as_str())
        {
            joints.push(&system.joints[id.0].name);
        }
    }
    if joints.is_empty() { String::new() } else { format!(" (nearest to singular: the joints {})", joints.join(", ")) }
}

fn describe(failure: StepFailure, now: f64) -> String {
    match failure {
        StepFailure::TooSmall { t, h } => format!(
            "step too small at t = {t} s: the tolerances ask for steps below {h:.1e} s; the rows until there are kept. \
             Loosen rtol, or look for what changes so fast there"
        ),
        StepFailure::Refused { .. } => format!(
            "the motion can't be followed beyond t = {now} s: the constraints are singular there; the rows until there are kept"
        ),
    }
}

/// The loop's results.
struct Outputs<'a, 'r> {
    system: &'a System,
    recorder: Recorder,
    sample: Sample,
    y: Vec<f64>,
    report: &'r mut Report,
    power: f64,
    imbalance: f64,
    /// Least and largest energy, and largest kinetic energy [J].
    energy: Option<[f64; 3]>,
}

impl Outputs<'_, '_> {
    /// A row at `time`, within the last step.
    fn record(&mut self, solver: &mut Integration, reduced: &mut Reduced, time: f64) -> Result<(), Failure> {
        self.y.resize(2 * reduced.freedom(), 0.0);
        if time == solver.stepper.t() {
            self.y.copy_from_slice(solver.stepper.y());
        } else {
            solver.stepper.interpolate(reduced, time, &mut self.y).map_err(|_| Failure::Singular)?;
        }
        // Exactly onto the constraints, whatever the tolerance of the integration.
        let (lag, last_step) = (reduced.lag, reduced.driven.last_step);
        reduced.lag = 0.0;
        reduced.driven.last_step = LAST_STEP;
        let solved = reduced.evaluate(time, &self.y);
        (reduced.lag, reduced.driven.last_step) = (lag, last_step);
        solved?;
        let Sample { q, v, a, lambda, force, .. } = &mut self.sample;
        q.copy_from_slice(&reduced.q);
        v.copy_from_slice(&reduced.v);
        a.copy_from_slice(&reduced.a);
        force.copy_from_slice(&reduced.force);
        reduced.multipliers(lambda);
        let evaluation = &mut reduced.driven.evaluation;
        evaluation.set_position(q);
        evaluation.eval_phi(self.system, &reduced.inputs);
        let residual = self.system.scaled_residual(&evaluation.phi);
        self.report.quality.constraint_residual = self.report.quality.constraint_residual.max(residual);
        let efforts = &lambda[self.system.joint_rows()..];
        let driven: f64 = efforts.iter().zip(&reduced.inputs.drive).map(|(effort, jet)| effort * jet[1]).sum();
        let applied = dot(force, v);
        let kinetic: f64 = v.iter().zip(a.iter()).zip(&self.system.mass).map(|((v, a), m)| v * a * m).sum();
        self.power = self.power.max(driven.abs()).max(applied.abs()).max(kinetic.abs());
        self.imbalance = self.imbalance.max((driven + applied - kinetic).abs());
        let motion = evaluation.kinetic_energy(self.system, v);
        let energy = motion + evaluation.potential_energy(self.system, &reduced.inputs);
        let [least, most, largest] = self.energy.unwrap_or([energy, energy, 0.0]);
        self.energy = Some([least.min(energy), most.max(energy), largest.max(motion)]);
        self.recorder.push(self.system, &reduced.driven.evaluation, &reduced.inputs, &self.sample);
        Ok(())
    }

    fn finish(self) -> Trajectory {
        let balance = if self.power > 0.0 { self.imbalance / self.power } else { 0.0 };
        self.report.quality.power_imbalance = Some(balance);
        if self.system.is_conservative()
            && let Some([least, most, largest]) = self.energy
        {
            self.report.quality.energy_drift = Some(if largest > 0.0 { (most - least) / largest } else { 0.0 });
        }
        self.recorder.trajectory
    }
}
