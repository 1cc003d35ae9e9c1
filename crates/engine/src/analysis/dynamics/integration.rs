//! The loop of steps: chooses coordinates anew where that is better, finds what contacts do within each step, and starts
//! again from there.

use super::contact::{Change, change, first_phase, sticks};
use super::ended::Ended;
use super::fault::Fault;
use super::history::{History, Sums};
use super::looking::Looking;
use super::margins::Margins;
use super::motion::Motion;
use super::settings::{Settings, Wanted};
use super::words::{deep_start, describe};
use crate::analysis::control::{Control, Stop};
use crate::element::journal::{Phase, Reading, Surface};
use crate::integrate::{Limits, Method, Ode, Stepper};
use crate::mechanism::driven::Failure;
use linkdyn_output::Status;

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
    /// What is wanted of a step's error.
    pub(super) wanted: Wanted,
    max_step: Option<f64>,
    /// The method at work.
    pub(super) stepper: Box<dyn Stepper>,
    /// Work of steppers before.
    pub(super) before: [u64; 3],
    /// Where the run, or a step that is taken again, ends \[s\].
    pub(super) end: f64,
    /// Where, within the last step, a contact changes its phase.
    pub(super) pending: Option<f64>,
    /// The point that is looked at.
    pub(super) y: Vec<f64>,
    /// What each contact has done.
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
    margins: Margins,
    /// What looks for the extremes of columns, in motions with contacts.
    pub(super) looking: Option<Box<Looking>>,
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
            margins: Margins::new(),
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
                let ahead = self.margins.lock_ahead();
                return Err(Ended::at_step(motion, fault, now, ahead, &self.jammed));
            }
        }
        Ok(())
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
        self.margins.note(motion, self.stepper.t());
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
}
