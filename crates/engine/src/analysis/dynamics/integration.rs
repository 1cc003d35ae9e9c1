//! The loop of steps: chooses coordinates anew where that is better, finds what contacts do within each step, and starts
//! again from there.

use super::closer::Looking;
use super::contact::{Change, History, Sums, change, first_phase, sticks};
use super::fault::Fault;
use super::motion::Motion;
use super::settings::{Settings, Wanted};
use super::words::{TIGHT, beyond_range, culprits, deep_start, describe, jam, tight};
use crate::analysis::control::{Control, Stop};
use crate::analysis::words::locked;
use crate::element::journal::{Phase, Reading, Surface};
use crate::integrate::{Limits, Method, Ode, Stepper};
use crate::mechanism::driven::Failure;
use linkdyn_output::{ClearanceSums, Reason, Report, Status};

/// Newton's step, by rtol, below which the equations are taken for those of its end: a hundredth of what the step's error
/// may be.
const LAG: f64 = 1e-2;
/// The same with contacts, where positions matter by parts of the clearance.
const CONTACT_LAG: f64 = 1e-10;
/// With contacts a step's error is bounded by this part of rtol: an impact takes some twenty steps and multiplies what was
/// wrong before it, and a run has many.
const IMPACTS: f64 = 1e-2;
/// No less than this, which is near round-off.
const FINEST: f64 = 1e-13;
/// How often a step is halved until all within it can be evaluated.
pub(super) const HALVINGS: usize = 20;
/// Deepest penetration at the start, in parts of the clearance.
const DEEPEST_START: f64 = 0.1;
const DEEPEST_RIGID: f64 = 1e-9;

/// The stepper at work, and what the contacts have done.
pub struct Integration {
    method: Method,
    pub(super) wanted: Wanted,
    max_step: Option<f64>,
    pub(super) stepper: Box<dyn Stepper>,
    /// Work of steppers before.
    before: [u64; 3],
    pub(super) end: f64,
    /// Where, within the last step, a contact changes its phase.
    pub(super) pending: Option<f64>,
    pub(super) y: Vec<f64>,
    pub histories: Vec<History>,
    /// Readings at the end of the last piece of a step.
    pub(super) last: Vec<Reading>,
    /// Elastic energy lost where a contact ended by its law while penetrated, per contact \[J\].
    released: Vec<f64>,
    /// Rigid contacts, by number, that rub so that no normal forces answer the motion.
    pub(super) jammed: Vec<usize>,
    /// When they did last, and how often then.
    pub(super) last_jam: (f64, usize),
    /// How far the friction of ideal joints was from locking them at the ends of the last two steps.
    margins: [Margin; 2],
    /// What looks for the extremes of columns, in motions with contacts.
    pub(super) looking: Option<Box<Looking>>,
}

/// How far the equations of friction are from having no solution.
#[derive(Debug, Clone, Copy)]
struct Margin {
    time: f64,
    /// Their determinant: 1 without friction, 0 where a joint locks itself.
    left: f64,
    /// The force that feeds on itself most.
    force: usize,
}

/// A lock that lies ahead by less than this many rounding units of the time is where the steps end.
const LOCK_AHEAD: f64 = 1e6;

/// Why the loop ended before its time.
pub struct Ended {
    pub status: Status,
    pub message: String,
    pub reason: Option<Box<Reason>>,
}

impl Ended {
    /// At an output that can't be solved.
    pub fn at_output(motion: &mut Motion, fault: Fault, time: f64) -> Ended {
        let system = motion.system();
        let when = system.display.time(time);
        let message = match fault {
            Fault::Unsolved(Failure::Locked { force }) => format!(
                "at t = {when} {}; the rows until there are kept",
                locked(system, force)
            ),
            Fault::Unsolved(
                Failure::Singular | Failure::Diverged { .. } | Failure::Inconsistent { .. },
            )
            | Fault::TooSmall { .. }
            | Fault::Indivisible { .. } => format!("the position at t = {when} can't be solved"),
        };
        Ended {
            status: Status::Singular,
            message,
            reason: Some(Box::new(fault.reason(motion, time))),
        }
    }
}

impl Integration {
    /// Starts at t = 0.
    ///
    /// # Errors
    /// A start with deep penetration, or where the equations can't be evaluated.
    pub fn new(settings: &Settings, motion: &mut Motion, end: f64) -> Result<Self, Stop> {
        let system = motion.system();
        let contacts = system.contacts.len();
        let (method, mut wanted) = (settings.method, settings.wanted);
        motion.reduced.lag = LAG * wanted.rtol;
        if contacts > 0 {
            wanted.rtol = (IMPACTS * wanted.rtol).max(FINEST.min(wanted.rtol));
            motion.reduced.lag = CONTACT_LAG.min(LAG * wanted.rtol);
        }
        let limits = Limits {
            initial_step: settings.initial_step,
            max_step: settings.max_step,
            ..Limits::default()
        };
        let names = system
            .joints
            .iter()
            .filter(|joint| joint.contact.is_some())
            .map(|joint| joint.name.as_str());
        let mut integration = Integration {
            method,
            stepper: method.stepper(motion.tolerance(wanted), limits),
            wanted,
            max_step: settings.max_step,
            before: [0; 3],
            end,
            pending: None,
            y: vec![0.0; motion.dimension()],
            histories: names.map(History::new).collect(),
            last: vec![Reading::default(); contacts],
            released: vec![0.0; contacts],
            jammed: Vec::new(),
            last_jam: (f64::NEG_INFINITY, 0),
            margins: [Margin {
                time: f64::NEG_INFINITY,
                left: 1.0,
                force: 0,
            }; 2],
            looking: None,
        };
        for (contact, journal) in system.contacts.iter().enumerate() {
            let reading = motion.reading(contact);
            let history = &mut integration.histories[contact];
            let deepest = match journal.surface {
                Surface::Compliant(_) => DEEPEST_START,
                Surface::Rigid(_) => DEEPEST_RIGID,
            };
            if reading.penetration > deepest * journal.clearance {
                return Err(Stop::Input(vec![deep_start(system, contact, &reading)]));
            }
            motion.reduced.inputs.contacts[contact] = first_phase(journal, &reading);
            if reading.penetration > 0.0 {
                history.begin(
                    0.0,
                    &reading,
                    Sums::default(),
                    motion.contact_angle(contact, &reading),
                );
            }
            let first = motion.reading(contact);
            integration.histories[contact].peak(first.penetration, first.normal);
            integration.last[contact] = first;
        }
        motion.state(&mut integration.y);
        let y = std::mem::take(&mut integration.y);
        let started = integration.stepper.start(motion, 0.0, &y, end);
        integration.y = y;
        started.map_err(|failure| {
            let fault = motion.stopped(failure);
            Stop::failed(
                Status::Singular,
                describe(fault, 0.0, "", &motion.system().display),
            )
        })?;
        Ok(integration)
    }

    /// Time up to which the motion is known.
    pub(super) fn reached(&self) -> f64 {
        self.pending.unwrap_or(self.stepper.t())
    }

    /// A new stepper at (time, y).
    pub(super) fn restart(
        &mut self,
        motion: &mut Motion,
        time: f64,
        y: &[f64],
        step: Option<f64>,
    ) -> Result<(), Fault> {
        let counters = self.stepper.counters();
        for (sum, part) in
            self.before
                .iter_mut()
                .zip([counters.steps, counters.rejected, counters.evaluations])
        {
            *sum += part;
        }
        let limits = Limits {
            initial_step: step,
            max_step: self.max_step,
            ..Limits::default()
        };
        self.stepper = self.method.stepper(motion.tolerance(self.wanted), limits);
        let started = self.stepper.start(motion, time, y, self.end);
        started.map_err(|failure| motion.stopped(failure))
    }

    /// Steps until `time` lies within the last step, before its event.
    pub fn reach(
        &mut self,
        motion: &mut Motion,
        time: f64,
        control: &Control,
    ) -> Result<(), Ended> {
        while self.reached() < time {
            control.progress.note(self.stepper.t(), self.end);
            if let Some(status) = control.stop() {
                let why = match status {
                    Status::Interrupted => "interrupted".to_string(),
                    _ => format!(
                        "max_wall_time is over at t = {}",
                        motion.system().display.time(self.stepper.t())
                    ),
                };
                return Err(Ended {
                    status,
                    message: format!("{why}; the rows until then are kept"),
                    reason: None,
                });
            }
            let now = self.reached();
            if let Err(fault) = self.advance(motion) {
                return Err(self.ended(motion, fault, now));
            }
        }
        Ok(())
    }

    /// What a step that can't be taken means.
    fn ended(&self, motion: &mut Motion, fault: Fault, now: f64) -> Ended {
        let (status, message) = self.told(motion, fault, now);
        Ended {
            status,
            message,
            reason: Some(Box::new(fault.reason(motion, now))),
        }
    }

    fn told(&self, motion: &mut Motion, fault: Fault, now: f64) -> (Status, String) {
        let refused = match fault {
            Fault::TooSmall { .. } => false,
            Fault::Indivisible { .. } | Fault::Unsolved(_) => true,
        };
        let lock = motion
            .reduced
            .driven
            .dependent_forces
            .locked()
            .filter(|_| refused)
            .or_else(|| self.lock_ahead());
        if let Some(force) = lock {
            let who = locked(motion.system(), force);
            let when = motion.system().display.time(now);
            return (
                Status::Singular,
                format!("at t = {when} {who}; the rows until there are kept"),
            );
        }
        let display = &motion.system().display;
        if !refused {
            let what = describe(fault, now, "", display);
            return (Status::StepTooSmall, format!("{what}{}", tight(motion)));
        }
        if !self.jammed.is_empty() {
            return (Status::Singular, jam(motion, &self.jammed, now));
        }
        let culprits = culprits(motion);
        (Status::Singular, describe(fault, now, &culprits, display))
    }

    /// Notes how far the friction is from locking a joint at the end of the step just taken.
    fn note_margin(&mut self, motion: &Motion) {
        let dependent = &motion.reduced.driven.dependent_forces;
        if motion.system().dependent_forces.is_empty() || dependent.locked().is_some() {
            return;
        }
        let here = Margin {
            time: self.stepper.t(),
            left: dependent.margin(),
            force: dependent.tightest(),
        };
        if here.time > self.margins[1].time {
            self.margins = [self.margins[1], here];
        }
    }

    /// The force that locks its joint within the next few of the shortest steps, where its margin goes to zero: friction
    /// grows there as 1/(t* − t), or with its root, so that every step goes a part of the way only.
    fn lock_ahead(&self) -> Option<usize> {
        let [before, here] = self.margins;
        let fall = (before.left - here.left) / (here.time - before.time);
        let ahead = here.left / fall;
        let near = LOCK_AHEAD * f64::EPSILON * here.time.abs();
        (here.left < TIGHT && fall > 0.0 && ahead <= near).then_some(here.force)
    }

    /// One step.
    fn advance(&mut self, motion: &mut Motion) -> Result<(), Fault> {
        let now = self.reached();
        if let Some(time) = self.pending.take() {
            self.change(motion, time)?;
        }
        if motion.reduced.repin()? {
            self.y.copy_from_slice(self.stepper.y());
            motion.state(&mut self.y);
            self.begin_again(motion, now)?;
        }
        if let Err(failure) = self.stepper.step(motion, self.end) {
            let fault = motion.stopped(failure);
            if !self.loosen(motion, now) {
                return Err(fault);
            }
            self.begin_again(motion, now)?;
            let taken = self.stepper.step(motion, self.end);
            taken.map_err(|failure| motion.stopped(failure))?;
        }
        self.note_margin(motion);
        if !self.histories.is_empty() {
            self.look_closely(motion)?;
            self.watch_step(motion);
        }
        Ok(())
    }

    /// A new stepper at (time, y), as long steps as the last one was.
    fn begin_again(&mut self, motion: &mut Motion, time: f64) -> Result<(), Fault> {
        let y = std::mem::take(&mut self.y);
        let step = (self.stepper.t() - self.stepper.previous()).abs();
        let restarted = self.restart(motion, time, &y, (step > 0.0).then_some(step));
        self.y = y;
        restarted
    }

    /// Sums of a contact at the point in `y`.
    pub fn sums(&self, motion: &Motion, contact: usize) -> Sums {
        let mut sums = Sums::of(&self.y[motion.dissipated(contact)..]);
        sums.dissipated += self.released[contact];
        sums
    }

    /// Energy that contacts have dissipated, and work of everything else, at the point in `y` \[J\].
    pub fn ledger(&self, motion: &Motion) -> [f64; 2] {
        if self.histories.is_empty() {
            return [0.0; 2];
        }
        let dissipated = (0..self.histories.len())
            .map(|contact| self.sums(motion, contact).dissipated)
            .sum();
        [dissipated, self.y[motion.work()]]
    }

    /// Changes the phases that end at `time`, and starts again from there.
    fn change(&mut self, motion: &mut Motion, time: f64) -> Result<(), Fault> {
        self.evaluate_at(motion, time)?;
        self.collide(motion, time)?;
        let system = motion.system();
        for contact in 0..self.histories.len() {
            let reading = motion.reading(contact);
            let before = motion.reduced.inputs.contacts[contact];
            let journal = &system.contacts[contact];
            let mut memory = before;
            let Some(change) = change(&system.scale, journal, &mut memory, &reading) else {
                continue;
            };
            let stored = |memory| motion.stored(contact, memory);
            self.released[contact] += stored(&before) - stored(&memory);
            let sums = self.sums(motion, contact);
            motion.reduced.inputs.contacts[contact] = memory;
            let now = motion.reading(contact);
            let history = &mut self.histories[contact];
            match change {
                Change::Begin => {
                    history.begin(
                        time,
                        &reading,
                        sums,
                        motion.contact_angle(contact, &reading),
                    );
                    // The force of some laws begins at once.
                    history.peak(now.penetration, now.normal);
                    if let Some(component) = motion.bristle(contact) {
                        self.y[component] = 0.0;
                    }
                }
                Change::Release => history.rest(time, &reading, sums),
                Change::Press => history.press(),
                Change::End => {
                    if before.phase == Phase::Contact {
                        history.rest(time, &reading, sums);
                    }
                    history.end();
                }
                Change::Piece => {
                    let is = sticks(journal, &memory);
                    if is != sticks(journal, &before) {
                        history.switch(time, is);
                    }
                }
            }
            self.last[contact] = now;
        }
        self.begin_again(motion, time)?;
        self.watch_from(motion, time);
        Ok(())
    }

    /// The point of an output: y and the mechanism at `time`, within the last step.
    ///
    /// # Errors
    /// Where the position can't be solved.
    pub fn output(&mut self, motion: &mut Motion, time: f64) -> Result<(), Fault> {
        for _ in 0..HALVINGS {
            match self.point(motion, time) {
                // Long steps of smooth motions have stages, or predictions, that are too far from it.
                Err(Fault::Unsolved(Failure::Singular | Failure::Diverged { .. }))
                    if time > self.stepper.previous() =>
                {
                    self.halve(motion, time)?;
                    if !self.histories.is_empty() {
                        self.look_closely(motion)?;
                    }
                    while self.reached() < time {
                        self.advance(motion)?;
                    }
                }
                result => return result,
            }
        }
        self.point(motion, time)
    }

    fn point(&mut self, motion: &mut Motion, time: f64) -> Result<(), Fault> {
        self.y.resize(motion.dimension(), 0.0);
        if time == self.stepper.t() {
            self.y.copy_from_slice(self.stepper.y());
        } else {
            let known = self.stepper.interpolate(motion, time, &mut self.y);
            known.map_err(|refused| motion.refused(refused))?;
        }
        Ok(motion.evaluate_exactly(time, &self.y)?)
    }

    /// Work and contacts into the report.
    pub fn account(&mut self, motion: &Motion, report: &mut Report) {
        let counters = self.stepper.counters();
        report.statistics.steps = self.before[0] + counters.steps;
        report.statistics.rejected = self.before[1] + counters.rejected;
        report.statistics.evaluations = self.before[2] + counters.evaluations;
        let joints = motion
            .system()
            .joints
            .iter()
            .filter(|joint| joint.contact.is_some());
        for (contact, joint) in joints.enumerate() {
            let sums = self.sums(motion, contact);
            let history = &mut self.histories[contact];
            history.finish(self.stepper.t(), sums);
            report.clearances.push(ClearanceSums {
                joint: joint.name.clone(),
                episodes: history.episodes,
                switches: history.switches,
                time_in_contact: history.time_in_contact,
                energy_lost: sums.dissipated,
                impulse: sums.impulse,
                wear: std::mem::take(&mut history.wear),
            });
            let (display, journal) = (&motion.system().display, &motion.system().contacts[contact]);
            report.warnings.extend(beyond_range(
                display,
                joint.name.as_str(),
                journal,
                history.most,
            ));
            if history.unlisted > 0 {
                report.warnings.push(format!(
                    "joint \"{}\": {} further contacts and changes between stick and slip are counted but not listed",
                    joint.name, history.unlisted
                ));
            }
            report.events.append(&mut history.events);
        }
        report.events.sort_by(|a, b| a.time.total_cmp(&b.time));
    }
}
