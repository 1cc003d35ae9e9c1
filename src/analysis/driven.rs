//! Kinematics and inverse dynamics of a driven mechanism, ideal or with massless clearance links.

use super::assembly::{assemble, check_driven};
use super::clearance_link::{ClearanceLinks, Fixpoint, balance, effort_by_power, forces};
use super::instants::{OutputInstant, instants};
use super::record::{Contents, Recorder, Sample};
use super::{Control, Interval, Stop};
use crate::element::Measure;
use crate::math::dot;
use crate::model::Analysis;
use crate::motion::Law;
use crate::output::{Event, Report, Status, Stopwatch, Trajectory};
use crate::solve::continuation::{End, HALF_TURN, Parameter, Path, SingularKind, Source, follow};
use crate::solve::driven::{Driven, Failure};
use crate::system::{DriverId, Evaluation, Inputs, Origin, System};

/// Within this part of a window's width the reactions of a singular loop are not computed: the change point is known to
/// about 1e-12 of it, so closer they are known to less than four digits.
const NO_REACTION: f64 = 1e-8;
/// Distances, in parts of a window's width, at which bounded reactions at a change point are taken for their limit.
const LIMIT: f64 = 1e-3;
/// A joint belongs to a self-stress when its part is above this, relative to the largest.
const STRESSED: f64 = 1e-6;
/// The same for a change point's self-stress, which is read off at 1e-5 of the window's width beside it.
const UNBOUNDED: f64 = 1e-3;

/// Runs the analysis.
///
/// # Errors
/// Faults of the input, and failures before the first output.
pub fn run(system: &System, analysis: &Analysis, control: &Control) -> Result<(Trajectory, Report), Stop> {
    let clock = Stopwatch::start();
    let reactions = super::has_reactions(analysis.kind);
    let instants = instants(system, analysis).map_err(Stop::Input)?;
    let start = Inputs::at_time(system, 0.0);
    let assembled = assemble(system, &start)?;
    check_driven(system, &assembled, &start)?;
    super::assembly::velocities(system, &assembled.q, &start)?;
    let mut report = Report { mobility: assembled.mobility.clone(), warnings: assembled.warnings, ..Report::default() };
    report.statistics.newton_iterations = assembled.iterations;

    let singular = |_: Failure| {
        Stop::failed(
            Status::Singular,
            "the start is a singular position of the mechanism; start a little beside it".into(),
        )
    };
    let mut driven = Driven::new(system, &assembled.q, &start).map_err(singular)?;
    let mut q = assembled.q;
    driven.correct(&mut q, &start).map_err(singular)?;
    report.assemble = clock.read();

    let clock = Stopwatch::start();
    let range = range(system, &instants);
    let parameter = Parameter::of(system);
    let first = if parameter == Parameter::DriverValue { start.drive[0][0] } else { 0.0 };
    let path = path(&mut driven, (first, &q), range, control).map_err(singular)?;
    report.statistics.steps = path.steps;
    report.statistics.rejected = path.rejected;
    let contents = Contents { accelerations: true, reactions };
    let mut outputs = Outputs {
        system,
        links: ClearanceLinks::of(system),
        recorder: Recorder::new(system, contents, instants.len()),
        inputs: Inputs::still(system),
        sample: Sample::new(system),
        scratch: Sample::new(system),
        report: &mut report,
        power: 0.0,
        imbalance: 0.0,
        gap: Interval::default(),
        wavering: Interval::default(),
        missing: Vec::new(),
        reactions,
    };
    outputs.march(&mut driven, &path, &instants, control);
    let trajectory = outputs.finish();
    let done = driven.done;
    report.statistics.newton_iterations += done.newton_iterations;
    report.statistics.evaluations += done.evaluations;
    report.statistics.factorisations += done.factorisations;
    report.solve = clock.read();
    Ok((trajectory, report))
}

/// The path over `range`: of a crank that goes round more than once and comes back, one turn stands for all.
fn path(driven: &mut Driven, start: (f64, &[f64]), range: (f64, f64), control: &Control) -> Result<Path, Failure> {
    let system = driven.system;
    let parameter = Parameter::of(system);
    let stop = || control.stop().is_some();
    let turns = parameter == Parameter::DriverValue && system.drivers[0].measure == Measure::Angle;
    if turns && range.1 - range.0 > 4.0 * HALF_TURN {
        let around = (start.0 - HALF_TURN, start.0 + HALF_TURN);
        let mut path = follow(driven, (parameter, Inputs::still(system)), start, around, &stop)?;
        if path.close_turn(system, start.0) {
            return Ok(path);
        }
    }
    follow(driven, (parameter, Inputs::still(system)), start, range, &stop)
}

/// The range of the path's parameter that the instants (and what lies between them) need.
fn range(system: &System, instants: &[OutputInstant]) -> (f64, f64) {
    let end = instants.last().map_or(0.0, |last| last.time);
    match Parameter::of(system) {
        Parameter::Time | Parameter::Pin => (0.0, end),
        Parameter::DriverValue => {
            let law = &system.drivers[0].law;
            let turns = law.turning_times(end).into_iter().chain([0.0, end]).map(|t| law.jet(t)[0]);
            let sampled = instants.iter().filter_map(|instant| instant.exact.map(|(_, value)| value));
            turns.chain(sampled).fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), s| (low.min(s), high.max(s)))
        }
    }
}

/// Times in [0, end] at which the path's parameter passes `s`, ascending.
fn times_of(system: &System, s: f64, end: f64) -> Vec<f64> {
    match Parameter::of(system) {
        Parameter::Time | Parameter::Pin => {
            Vec::from_iter((s >= 0.0 && s <= end * (1.0 + ON_THE_EDGE)).then_some(s.min(end)))
        }
        Parameter::DriverValue => passages(&system.drivers[0].law, s, end),
    }
}

/// A singular position this close beyond the end of the range, relative to the range, still belongs to it: that is how
/// well its place and the user's numbers agree.
const ON_THE_EDGE: f64 = 1e-10;
/// More passages of one position than anybody reads.
const MOST_PASSAGES: usize = 1000;

/// Times in [0, end] at which a law passes a value: at most one on each monotone stretch.
fn passages(law: &Law, value: f64, end: f64) -> Vec<f64> {
    let mut times: Vec<f64> = Vec::new();
    let mut left = 0.0;
    for right in law.turning_times(end).into_iter().chain([end]) {
        let (from, to) = (law.jet(left)[0], law.jet(right)[0]);
        let (a, b) = (from - value, to - value);
        let edge = ON_THE_EDGE * (to - from).abs();
        let time = if a.abs() <= edge {
            Some(left)
        } else if b.abs() <= edge {
            Some(right)
        } else if a * b < 0.0 {
            Some(crate::motion::bisect(|t| (law.jet(t)[0] - value) * a, left, right))
        } else {
            None
        };
        if let Some(time) = time
            && times.last() != Some(&time)
        {
            times.push(time);
        }
        if times.len() >= MOST_PASSAGES {
            break;
        }
        left = right;
    }
    times
}

/// State of the loop over the outputs.
struct Outputs<'a, 'r> {
    system: &'a System,
    links: Option<ClearanceLinks>,
    recorder: Recorder,
    inputs: Inputs,
    sample: Sample,
    scratch: Sample,
    report: &'r mut Report,
    /// Largest power that flows, and largest imbalance [W].
    power: f64,
    imbalance: f64,
    gap: Interval,
    wavering: Interval,
    /// Joints whose reaction was left out, with the position.
    missing: Vec<String>,
    reactions: bool,
}

impl Outputs<'_, '_> {
    fn march(&mut self, driven: &mut Driven, path: &Path, instants: &[OutputInstant], control: &Control) {
        let end = instants.last().map_or(0.0, |last| last.time);
        let limit = self.limits(path, end);
        self.events(path, range(self.system, instants), limit.as_ref().map_or(end, |(time, ..)| *time));
        for instant in instants {
            if let Some((time, status, message)) = &limit
                && instant.time >= *time
            {
                self.report.status = *status;
                self.report.message = Some(message.clone());
                return;
            }
            if let Some(status) = control.stop() {
                self.report.status = status;
                self.report.message = Some(match status {
                    Status::Interrupted => "interrupted; the rows until then are kept".into(),
                    _ => format!("max_wall_time is over at t = {} s; the rows until then are kept", instant.time),
                });
                return;
            }
            self.inputs.time = instant.time;
            instant.drive(self.system, &mut self.inputs.drive);
            if let Err(failure) = self.solve(driven, path) {
                self.report.status = Status::Singular;
                self.report.message = Some(format!("no solution at t = {} s: {}", instant.time, describe(failure)));
                return;
            }
        }
    }

    /// Where the path ends before the outputs do.
    fn limits(&self, path: &Path, end: f64) -> Option<(f64, Status, String)> {
        let ends = [path.low, path.high].into_iter().filter_map(|side| match side {
            End::Reached => None,
            End::DeadCentre { s } => {
                let time = times_of(self.system, s, end).first().copied()?;
                let what = format!(
                    "dead centre: {} can't go on; the results until there are kept",
                    self.position_text(s, time)
                );
                Some((time, Status::DeadCentre, what))
            }
            End::Stuck { s } => {
                let time = times_of(self.system, s, end).first().copied()?;
                let what = format!("the motion can't be followed beyond {}", self.position_text(s, time));
                Some((time, Status::Singular, what))
            }
            End::Interrupted => Some((0.0, Status::Interrupted, "interrupted while the path was followed".into())),
        });
        ends.min_by(|a, b| a.0.total_cmp(&b.0))
    }

    fn position_text(&self, s: f64, time: f64) -> String {
        match Parameter::of(self.system) {
            Parameter::Time | Parameter::Pin => format!("t = {time} s"),
            Parameter::DriverValue => {
                let driver = &self.system.drivers[0];
                let value = match driver.measure {
                    Measure::Angle => format!("{s} rad ({:.9}°)", s.to_degrees()),
                    Measure::Length => format!("{s} m"),
                };
                format!("driver \"{}\" at {value}, t = {time} s,", driver.name)
            }
        }
    }

    /// Passages of singular positions within the run, by time; a dead centre ends it.
    fn events(&mut self, path: &Path, (low, high): (f64, f64), end: f64) {
        let by_value = path.parameter == Parameter::DriverValue;
        let edge = ON_THE_EDGE * (high - low);
        for position in path.singular_between(low - edge, high + edge) {
            let times = times_of(self.system, position.s, end);
            let (kind, times) = match position.kind {
                SingularKind::ChangePoint => ("change_point", &times[..]),
                SingularKind::DeadCentre => ("dead_centre", &times[..times.len().min(1)]),
            };
            self.report.events.extend(times.iter().map(|&time| Event {
                kind,
                time,
                end_time: None,
                driver: by_value.then(|| self.system.drivers[0].name.clone()),
                value: by_value.then_some(position.s),
                end_value: None,
                note: None,
            }));
        }
        self.report.events.sort_by(|a, b| a.time.total_cmp(&b.time));
    }

    fn driver_value(&self) -> Option<(String, f64)> {
        self.system.drivers.first().map(|driver| (driver.name.clone(), self.inputs.drive[0][0]))
    }

    fn solve(&mut self, driven: &mut Driven, path: &Path) -> Result<(), Failure> {
        let system = self.system;
        // The path's parameter and its rates.
        let [s, rate, bend] = match path.parameter {
            Parameter::DriverValue => self.inputs.drive[0],
            Parameter::Time | Parameter::Pin => [self.inputs.time, 1.0, 0.0],
        };
        self.inputs.offset.iter_mut().for_each(|offset| offset.fill(crate::math::Vec2::zeros()));
        let Sample { q, v, a, .. } = &mut self.sample;
        let Some(source) = path.guess(s, q, v, a) else { return Err(Failure::Diverged { residual: f64::NAN }) };
        let mut residual;
        match source {
            Source::Regular => {
                driven.prepare(q, &self.inputs)?;
                residual = driven.correct(q, &self.inputs)?.residual;
                driven.factor(&self.inputs)?;
                driven.velocity(&self.inputs, v);
                driven.acceleration(&self.inputs, a);
                if self.reactions || self.links.is_some() {
                    balance(system, &driven.evaluation, &self.inputs, &mut self.sample);
                    driven.multipliers(&self.sample.balance, &mut self.sample.lambda);
                    self.note_not_unique(driven);
                }
            }
            Source::Bridged { index, distance } => {
                residual = self.bridged(driven, path, index, distance, [s, rate, bend]);
            }
        }
        if let Some(mut links) = self.links.take() {
            let outcome = links.solve(driven, &mut self.inputs, &mut self.sample);
            self.links = Some(links);
            match outcome {
                Fixpoint::Converged { .. } => {
                    self.gap.close(&mut self.report.events);
                    self.wavering.close(&mut self.report.events);
                }
                Fixpoint::NotConverged { .. } => {
                    self.gap.close(&mut self.report.events);
                    let (time, driver) = (self.inputs.time, self.driver_value());
                    let note = "the clearance links' fixed point was not met within 50 passes; the last pass is kept";
                    self.wavering.extend("not_converged", time, driver, note);
                }
                Fixpoint::NoSolution { .. } => {
                    self.wavering.close(&mut self.report.events);
                    let (time, driver) = (self.inputs.time, self.driver_value());
                    let note = "with the clearance links in the directions of the joint forces the mechanism can't be \
                                assembled on the branch of the ideal one";
                    self.gap.extend("no_solution", time, driver, note);
                    self.recorder.push_gap(&self.inputs);
                    self.report.status = Status::CompletedWithGaps;
                    return Ok(());
                }
            }
            driven.evaluation.set_position(&self.sample.q);
            driven.evaluation.set_velocity(&self.sample.v);
            driven.evaluation.eval_phi(system, &self.inputs);
            residual = system.scaled_residual(&driven.evaluation.phi);
        }
        self.report.quality.constraint_residual = self.report.quality.constraint_residual.max(residual);
        if self.reactions {
            self.account();
        }
        self.recorder.push(system, &driven.evaluation, &self.inputs, &self.sample);
        Ok(())
    }

    /// The smooth branch near a change point; returns the scaled residual.
    fn bridged(&mut self, driven: &mut Driven, path: &Path, index: usize, distance: f64, s: [f64; 3]) -> f64 {
        let system = self.system;
        let [_, rate, bend] = s;
        let tangent = self.sample.v.clone();
        let Sample { v, a, .. } = &mut self.sample;
        for (v, a) in v.iter_mut().zip(a.iter_mut()) {
            *a = *a * rate * rate + *v * bend;
            *v *= rate;
        }
        self.settle(driven);
        let residual = system.scaled_residual(&driven.evaluation.phi);
        if !(self.reactions || self.links.is_some()) {
            return residual;
        }
        let window = &path.windows()[index];
        let regular = distance.abs() > NO_REACTION * window.width
            && driven.prepare(&self.sample.q, &self.inputs).is_ok()
            && driven.factor(&self.inputs).is_ok();
        if regular {
            driven.multipliers(&self.sample.balance, &mut self.sample.lambda);
            self.note_not_unique(driven);
        } else {
            self.limit_reactions(driven, path, index, s);
        }
        if path.parameter == Parameter::DriverValue {
            let row = system.driver_row(DriverId(0));
            self.sample.lambda[row] = effort_by_power(&self.sample.balance, &tangent);
        }
        residual
    }

    /// Takes position and velocity of the sample and works out what the constraints carry.
    fn settle(&mut self, driven: &mut Driven) {
        driven.evaluation.set_position(&self.sample.q);
        driven.evaluation.set_velocity(&self.sample.v);
        driven.evaluation.eval_phi(self.system, &self.inputs);
        balance(self.system, &driven.evaluation, &self.inputs, &mut self.sample);
    }

    /// At a change point: reactions of the singular loop do not exist, the others are limits from both sides.
    fn limit_reactions(&mut self, driven: &mut Driven, path: &Path, index: usize, s: [f64; 3]) {
        let system = self.system;
        let window = &path.windows()[index];
        let [s, rate, bend] = s;
        let mut limit = vec![0.0; system.m()];
        // Mean of both sides at h and 2h, then (4 M(h) − M(2h)) / 3: error O(h⁴).
        for (part, weight) in
            [(LIMIT, 4.0 / 6.0), (-LIMIT, 4.0 / 6.0), (2.0 * LIMIT, -1.0 / 6.0), (-2.0 * LIMIT, -1.0 / 6.0)]
        {
            let Sample { q, v, a, .. } = &mut self.scratch;
            path.guess(s + part * window.width, q, v, a);
            for (v, a) in v.iter_mut().zip(a.iter_mut()) {
                *a = *a * rate * rate + *v * bend;
                *v *= rate;
            }
            driven.evaluation.set_position(q);
            driven.evaluation.set_velocity(v);
            balance(system, &driven.evaluation, &self.inputs, &mut self.scratch);
            let q = &self.scratch.q;
            if driven.prepare(q, &self.inputs).is_ok() && driven.factor(&self.inputs).is_ok() {
                driven.multipliers(&self.scratch.balance, &mut self.scratch.lambda);
                limit.iter_mut().zip(&self.scratch.lambda).for_each(|(sum, l)| *sum += weight * l);
            } else {
                limit.fill(f64::NAN);
            }
        }
        driven.evaluation.set_position(&self.sample.q);
        driven.evaluation.set_velocity(&self.sample.v);
        let stress = path.self_stress(index);
        let largest = crate::math::max_abs(stress);
        for block in &system.blocks {
            let rows = block.row..block.row + block.rows;
            let stressed =
                stress.get(rows.clone()).is_some_and(|part| crate::math::max_abs(part) > UNBOUNDED * largest);
            if stressed {
                limit[rows].fill(f64::NAN);
                if let Origin::Joint(id) = block.origin {
                    let name = &system.joints[id.0].name;
                    if !self.missing.contains(name) {
                        self.missing.push(name.clone());
                    }
                }
            }
        }
        self.sample.lambda.copy_from_slice(&limit);
    }

    /// Joints whose reactions differ between equilibria.
    fn note_not_unique(&mut self, driven: &mut Driven) {
        if !driven.is_redundant() {
            return;
        }
        for z in driven.self_stress() {
            let largest = crate::math::max_abs(&z);
            for (joint, block) in self.system.joints.iter().zip(&self.system.blocks) {
                let part = crate::math::max_abs(&z[block.row..block.row + block.rows]);
                let listed = &mut self.report.mobility.reactions_not_unique;
                if part > STRESSED * largest && !listed.contains(&joint.name) {
                    listed.push(joint.name.clone());
                }
            }
        }
    }

    /// Power of drivers + power of forces = change of kinetic energy.
    fn account(&mut self) {
        let Sample { v, a, lambda, force, .. } = &self.sample;
        let efforts = &lambda[self.system.joint_rows()..];
        let driven: f64 = efforts.iter().zip(&self.inputs.drive).map(|(effort, jet)| effort * jet[1]).sum();
        if !driven.is_finite() {
            return;
        }
        let applied = Evaluation::power(force, v);
        let kinetic: f64 = dot(v, &a.iter().zip(&self.system.mass).map(|(a, m)| a * m).collect::<Vec<f64>>());
        self.power = self.power.max(driven.abs()).max(applied.abs()).max(kinetic.abs());
        self.imbalance = self.imbalance.max((driven + applied - kinetic).abs());
    }

    fn finish(mut self) -> Trajectory {
        self.gap.close(&mut self.report.events);
        self.wavering.close(&mut self.report.events);
        self.report.events.sort_by(|a, b| a.time.total_cmp(&b.time));
        if self.reactions {
            let balance = if self.power > 0.0 { self.imbalance / self.power } else { 0.0 };
            self.report.quality.power_imbalance = Some(balance);
        }
        if !self.missing.is_empty() {
            self.report.warnings.push(format!(
                "at a change point the reactions of {} have no bound and are left out",
                self.missing.join(", ")
            ));
        }
        if !self.report.mobility.redundant.is_empty() && self.reactions {
            self.report.warnings.push(format!(
                "constraints of {} are redundant: the reactions of {} are the ones of least norm, not the only ones",
                self.report.mobility.redundant.join(", "),
                self.report.mobility.reactions_not_unique.join(", ")
            ));
        }
        for (kind, what) in
            [("not_converged", "the clearance fixed point does not converge"), ("no_solution", "there is no assembly")]
        {
            let count = self.report.events.iter().filter(|event| event.kind == kind).count();
            if count > 0 {
                let intervals = if count == 1 { "interval" } else { "intervals" };
                self.report.warnings.push(format!("in {count} {intervals} {what} (see events)"));
            }
        }
        self.recorder.trajectory
    }
}

fn describe(failure: Failure) -> String {
    match failure {
        Failure::Singular => "the constraints are singular there".into(),
        Failure::Diverged { residual } => {
            format!("Newton's iteration does not converge (residual {residual:.1e} of the size)")
        }
        Failure::Inconsistent { residual } => {
            format!("redundant constraints contradict each other by {residual:.1e} of the mechanism's size")
        }
    }
}

/// Kept for the six-bar benchmark: solves one instant, all reactions, without output.
pub fn solve_instant(driven: &mut Driven, path: &Path, inputs: &Inputs, sample: &mut Sample) -> Result<(), Failure> {
    let s = match path.parameter {
        Parameter::DriverValue => inputs.drive[0][0],
        Parameter::Time | Parameter::Pin => inputs.time,
    };
    let Sample { q, v, a, .. } = sample;
    path.guess(s, q, v, a);
    driven.correct(q, inputs)?;
    forces(driven, inputs, sample)
}
