//! The loop over the output instants, and what it reports.

mod ended;

use super::super::channels::Contents;
use super::super::clearance_link::{ClearanceLinks, Fixpoint, balance, carried, effort_by_power};
use super::super::control::Control;
use super::super::ends::Overrun;
use super::super::instants::OutputInstant;
use super::super::interval::Interval;
use super::super::outside::Outside;
use super::super::power::Powers;
use super::super::record::Recorder;
use super::super::sample::Sample;
use super::super::words::locked;
use super::ahead::Ahead;
use super::bridge::{Bridge, Near};
use super::passages::{events, range, with_passages};
use super::words::{describe, limits, stopped};
use crate::mechanism::continuation::{End, Parameter, Path, Source};
use crate::mechanism::driven::{Driven, Failure};
use crate::system::{DriverId, Inputs, System};
use linkdyn_linear::math::WIDTH;
use linkdyn_output::{Column, Event, EventKind, Report, Status};

/// A joint belongs to a self-stress when its part is above this, relative to the largest.
const STRESSED: f64 = 1e-6;

/// State of the loop over the outputs.
pub(super) struct Outputs<'a, 'r> {
    system: &'a System,
    links: Option<ClearanceLinks>,
    recorder: Recorder,
    inputs: Inputs,
    sample: Sample,
    bridge: Bridge,
    report: &'r mut Report,
    powers: Powers,
    gap: Interval,
    wavering: Interval,
    locking: Interval,
    contents: Contents,
    /// Whether a formula without a value was told of.
    lacks_value: bool,
    outside: Outside,
    overrun: Overrun,
}

/// What a slow motion shows is at rest.
pub(super) fn rest(driven: &mut Driven, sample: &mut Sample) {
    if driven.system.is_slow {
        sample.v.fill(0.0);
        driven.evaluation.set_velocity(&sample.v);
    }
}

impl<'a, 'r> Outputs<'a, 'r> {
    /// With room for so many rows, of these columns alone where some are given.
    pub fn new(
        system: &'a System,
        contents: Contents,
        (kept, rows): (Option<&[Column]>, usize),
        report: &'r mut Report,
    ) -> Self {
        Outputs {
            system,
            links: ClearanceLinks::of(system),
            recorder: Recorder::keeping(system, contents, kept, rows),
            inputs: Inputs::still(system),
            sample: Sample::new(system),
            bridge: Bridge::new(system),
            report,
            powers: Powers::default(),
            gap: Interval::default(),
            wavering: Interval::default(),
            locking: Interval::default(),
            contents,
            lacks_value: false,
            outside: Outside::new(system),
            overrun: Overrun::default(),
        }
    }

    /// Solves and records every instant, as far as the path goes; with `at_events` also those of passages.
    pub fn march(
        &mut self,
        driven: &mut Driven,
        path: &Path,
        instants: &[OutputInstant],
        at_events: bool,
        control: &Control,
    ) {
        let end = instants.last().map_or(0.0, |last| last.time);
        if [path.low, path.high].contains(&End::Interrupted) {
            let status = control.stop().unwrap_or(Status::Interrupted);
            self.report.status = status;
            self.report.message = Some(stopped(
                status,
                "while the path was followed, before the first output",
            ));
            return;
        }
        let limit = limits(self.system, path, end);
        let until = limit.as_ref().map_or(end, |(time, ..)| *time);
        let passed = events(self.system, path, range(self.system, instants), until);
        for event in &passed {
            let columns = self.unbounded(driven, path, event);
            self.report.note_unbounded(&columns, event.time);
        }
        self.report.events.extend(passed);
        self.report.events.sort_by(|a, b| a.time.total_cmp(&b.time));
        let passages: &[Event] = if at_events { &self.report.events } else { &[] };
        let instants = with_passages(instants, passages);
        let are_many = instants.len() >= WIDTH;
        let mut ahead = are_many
            .then(|| Ahead::new(driven, self.contents.reactions))
            .flatten();
        for (index, instant) in instants.iter().enumerate() {
            control.progress.note(end + instant.time, 2.0 * end);
            instant.drive(self.system, &mut self.inputs.drive);
            let beyond = !path.holds(match path.parameter {
                Parameter::DriverValue => self.inputs.drive[0][0],
                Parameter::Time | Parameter::Coordinate => instant.time,
            });
            // Between the path's last node and its end nothing is solved.
            if let Some((time, status, message)) = &limit
                && (instant.time >= *time || beyond)
            {
                self.report.status = *status;
                self.report.message = Some(message.clone());
                return;
            }
            if let Some(status) = control.stop() {
                self.report.status = status;
                let at = format!(
                    "at t = {}; the rows until then are kept",
                    self.system.display.time(instant.time)
                );
                self.report.message = Some(stopped(status, &at));
                return;
            }
            self.inputs.time = instant.time;
            let found = ahead.as_mut().and_then(|ahead| {
                let (inputs, sample) = (&self.inputs, &mut self.sample);
                ahead.take(driven, path, &instants[index..], inputs, sample)
            });
            if let Err(failure) = self.solve(driven, path, found) {
                self.report.status = Status::Singular;
                let shared = self.system.drivers.len() as i64 > self.report.mobility.rank;
                self.report.message = Some(format!(
                    "no solution at t = {}: {}{}",
                    self.system.display.time(instant.time),
                    describe(self.system, failure),
                    match shared {
                        true => "; drivers that move a freedom together have to agree at all times",
                        false => "",
                    }
                ));
                return;
            }
        }
    }

    /// Columns without bound at an event. Massless links displace a change point, or take it away.
    fn unbounded(&mut self, driven: &mut Driven, path: &Path, event: &Event) -> Vec<String> {
        let is_asked = event.kind == EventKind::ChangePoint && self.contents.reactions;
        if !is_asked || self.links.is_some() {
            return Vec::new();
        }
        self.inputs.time = event.time;
        let at = OutputInstant {
            time: event.time,
            exact: event.value.map(|value| (0, value)),
        };
        at.drive(self.system, &mut self.inputs.drive);
        let s = self.parameter(path);
        let Some(index) = path.window_at(s[0]) else {
            return Vec::new();
        };
        let near = Near {
            index,
            distance: 0.0,
            s,
        };
        let of = (&self.inputs, self.contents);
        self.bridge.unbounded(driven, path, near, of)
    }

    /// The path's parameter and its rates at the instant at hand.
    fn parameter(&self, path: &Path) -> [f64; 3] {
        match path.parameter {
            Parameter::DriverValue => self.inputs.drive[0],
            Parameter::Time | Parameter::Coordinate => [self.inputs.time, 1.0, 0.0],
        }
    }

    fn driver_value(&self) -> Option<(String, f64)> {
        self.system
            .drivers
            .first()
            .map(|driver| (driver.name.clone(), self.inputs.drive[0][0]))
    }

    /// Solves and records the instant at hand, whose residual is known where it has been solved.
    fn solve(
        &mut self,
        driven: &mut Driven,
        path: &Path,
        found: Option<f64>,
    ) -> Result<(), Failure> {
        if let Some(residual) = found {
            if self.contents.reactions {
                self.note_formulas(driven);
            }
            self.locking.close(&mut self.report.events);
            self.record(driven, residual);
            return Ok(());
        }
        let system = self.system;
        let parameter = self.parameter(path);
        let s = parameter[0];
        self.inputs
            .offset
            .iter_mut()
            .for_each(|offset| offset.fill(linkdyn_linear::math::Vec2::zeros()));
        let Sample { q, v, a, .. } = &mut self.sample;
        let Some(source) = path.guess(s, q, v, a) else {
            return Err(Failure::Singular);
        };
        let mut residual;
        match source {
            Source::Regular | Source::Known => {
                driven.prepare(q, &self.inputs)?;
                residual = driven.correct(q, &self.inputs)?.residual;
                driven.factor(&self.inputs)?;
                driven.velocity(&self.inputs, v);
                driven.acceleration(&self.inputs, a);
                if self.contents.reactions || self.links.is_some() {
                    balance(system, &driven.evaluation, &self.inputs, &mut self.sample);
                    self.note_formulas(driven);
                    self.carry(driven);
                }
            }
            Source::Bridged { index, distance } => {
                let near = Near {
                    index,
                    distance,
                    s: parameter,
                };
                residual = self.bridged(driven, path, near);
            }
        }
        let has_locked = driven.dependent_forces.locked().is_some();
        if !has_locked {
            self.locking.close(&mut self.report.events);
        }
        if !has_locked && let Some(mut links) = self.links.take() {
            let outcome = links.solve(driven, &mut self.inputs, &mut self.sample);
            self.links = Some(links);
            if !self.is_met(driven, outcome) {
                self.recorder.push_gap(&self.inputs);
                return Ok(());
            }
            driven.evaluation.set_position(&self.sample.q);
            driven.evaluation.set_velocity(&self.sample.v);
            driven.evaluation.eval_phi(system, &self.inputs);
            residual = system.scaled_residual(&driven.evaluation.phi);
        }
        self.record(driven, residual);
        Ok(())
    }

    /// Records the instant at hand.
    fn record(&mut self, driven: &mut Driven, residual: f64) {
        self.report.quality.constraint_residual =
            self.report.quality.constraint_residual.max(residual);
        if self.contents.reactions {
            self.account();
        }
        rest(driven, &mut self.sample);
        let at = driven.evaluation.kinematics(&self.inputs);
        self.overrun.note(self.system, &at);
        self.recorder
            .push(self.system, &driven.evaluation, &self.inputs, &self.sample);
    }

    /// Warns of the first formula that has no value at an instant.
    fn note_formulas(&mut self, driven: &Driven) {
        let at = driven.evaluation.kinematics(&self.inputs);
        self.outside.note(self.system, &at);
        let mut formulas = self.system.formulas.iter();
        let Some(formula) = formulas.find(|formula| !formula.value(&at).is_finite()) else {
            return;
        };
        if !std::mem::replace(&mut self.lacks_value, true) {
            self.report.warnings.push(format!(
                "from t = {} on, the formula of {} has no value at times (a root of a negative number, a division by \
                 zero, or the like): the forces of these rows are empty",
                self.system.display.time(self.inputs.time),
                self.system.owner(formula.force)
            ));
        }
    }

    /// The smooth branch near a change point; returns the scaled residual.
    fn bridged(&mut self, driven: &mut Driven, path: &Path, near: Near) -> f64 {
        let tangent = self.sample.v.clone();
        let residual = near.settle(driven, &self.inputs, &mut self.sample);
        if !(self.contents.reactions || self.links.is_some()) {
            return residual;
        }
        if near.is_regular(driven, path, &self.sample.q, &self.inputs) {
            self.carry(driven);
        } else {
            let (inputs, sample) = (&self.inputs, &mut self.sample);
            let locked = self.bridge.limit(driven, path, near, inputs, sample);
            self.note_locked(locked);
        }
        let sizes = &self.sample.dependent_forces;
        if path.parameter == Parameter::DriverValue && sizes.iter().all(|size| size.is_finite()) {
            let row = self.system.driver_row(DriverId(0));
            self.sample.lambda[row] = effort_by_power(&self.sample.balance, &tangent);
        }
        residual
    }

    /// Notes how the clearance links' fixed point came out; whether there is a position to record.
    fn is_met(&mut self, driven: &Driven, outcome: Fixpoint) -> bool {
        let events = &mut self.report.events;
        match outcome {
            Fixpoint::Converged { .. } => {
                self.gap.close(events);
                self.wavering.close(events);
                true
            }
            Fixpoint::NotConverged { .. } => {
                self.gap.close(events);
                let (time, driver) = (self.inputs.time, self.driver_value());
                let note = "the clearance links' fixed point was not met within 50 passes; the last pass is kept";
                self.wavering
                    .extend(EventKind::NotConverged, time, driver, note);
                true
            }
            Fixpoint::NoSolution { .. } if driven.dependent_forces.locked().is_some() => {
                self.wavering.close(events);
                self.gap.close(events);
                self.note_locked(driven.dependent_forces.locked());
                false
            }
            Fixpoint::NoSolution { .. } => {
                self.wavering.close(events);
                let (time, driver) = (self.inputs.time, self.driver_value());
                let note = "with the clearance links in the directions of the joint forces the mechanism can't be \
                            assembled on the branch of the ideal one";
                self.gap.extend(EventKind::NoSolution, time, driver, note);
                self.report.status = Status::CompletedWithGaps;
                false
            }
        }
    }

    /// What the constraints carry, with friction; where a joint locks itself these values do not exist.
    fn carry(&mut self, driven: &mut Driven) {
        if carried(driven, &self.inputs, &mut self.sample).is_err() {
            self.sample.lambda.fill(f64::NAN);
            self.note_locked(driven.dependent_forces.locked());
        }
        self.note_not_unique(driven);
    }

    /// An event where forces do not exist because a joint locks itself by this friction.
    fn note_locked(&mut self, force: Option<usize>) {
        if let Some(force) = force {
            let (time, driver) = (self.inputs.time, self.driver_value());
            self.locking.extend(
                EventKind::SelfLocking,
                time,
                driver,
                &locked(self.system, force),
            );
            self.report.status = Status::CompletedWithGaps;
        }
    }

    /// Joints whose reactions differ between equilibria.
    fn note_not_unique(&mut self, driven: &mut Driven) {
        if !driven.is_redundant() {
            return;
        }
        for z in driven.self_stress() {
            let largest = linkdyn_linear::math::max_abs(&z);
            for (joint, block) in self.system.joints.iter().zip(&self.system.blocks) {
                let part = linkdyn_linear::math::max_abs(&z[block.rows()]);
                let listed = &mut self.report.mobility.reactions_not_unique;
                if part > STRESSED * largest && !listed.contains(&joint.name) {
                    listed.push(joint.name.clone());
                }
            }
        }
    }

    /// Power of drivers + power of forces = change of kinetic energy.
    fn account(&mut self) {
        let Sample {
            v,
            a,
            lambda,
            force,
            ..
        } = &self.sample;
        let efforts = &lambda[self.system.joint_rows()..];
        if efforts.iter().any(|effort| !effort.is_finite()) {
            return;
        }
        let drivers = efforts
            .iter()
            .zip(&self.inputs.drive)
            .map(|(effort, jet)| (*effort, jet[1]));
        self.powers.note(self.system, [v, a, force], drivers);
    }
}
