//! A motion as a hybrid system: the flow between events, the steps along it, the events that end them, and what happens there.
//!
//! ```text
//! step        the flow is integrated                                   [`super::flow`], [`super::steps`]
//! locate      the first guard of a contact that becomes positive       [`super::modes`], [`super::events`]
//! note        what contacts did in the step, extremes of columns       [`super::ledger`], [`super::extremes`]
//! change      impulses, other constraints, other phases                [`super::impulses`], [`super::modes`]
//! ```

use super::ended::Ended;
use super::events::Events;
use super::extremes::{Extremes, StepPiece};
use super::fault::Fault;
use super::flow::Flow;
use super::impulses::{Impulses, Instant, Jams};
use super::ledger::Ledger;
use super::margins::Margins;
use super::modes::{Change, change};
use super::paces::Begun;
use super::passages::Passages;
use super::state::State;
use super::steps::{LastStep, Steps};
use super::switches::Switches;
use crate::analysis::control::Control;
use crate::analysis::outside::Outside;
use crate::element::pair::{Hold, Phase};
use crate::mechanism::driven::Failure;
use linkdyn_output::{Report, Trajectory};

/// How often a step is halved until all within it can be evaluated.
const HALVINGS: usize = 20;

/// A motion; it begins in [`super::begin`].
#[derive(Clone)]
pub struct Simulation<'s> {
    /// The equations of the moment, at the point of the last evaluation.
    pub(super) flow: Flow<'s>,
    /// That point.
    pub(super) state: State,
    pub(super) steps: Steps,
    /// Where, within the last step, a contact changes its phase.
    pub(super) event: Option<f64>,
    pub(super) events: Events,
    pub(super) ledger: Ledger,
    pub(super) switches: Switches,
    pub(super) outside: Outside,
    pub(super) jams: Jams,
    /// How far the friction of ideal joints was from locking them.
    pub(super) margins: Margins,
    /// The extremes of columns, where they are looked for.
    pub(super) extremes: Option<Box<Extremes>>,
    /// Change points that were passed.
    pub(super) passages: Passages,
    /// Forces from outside have changed since the last step.
    pub(super) is_pushed_anew: bool,
}

impl<'s> Simulation<'s> {
    /// Time up to which the motion is known \[s\].
    pub(super) fn reached(&self) -> f64 {
        self.event.unwrap_or(self.steps.time())
    }

    /// Steps until `time` lies within the last step, before its event.
    ///
    /// # Errors
    /// Where the motion ends before, or is stopped.
    pub fn reach(&mut self, time: f64, control: &Control) -> Result<(), Ended> {
        while self.reached() < time {
            control.progress.note(self.steps.time(), self.steps.end());
            if let Some(status) = control.stop() {
                let (time, system) = (self.steps.time(), self.flow.system());
                return Err(Ended::stopped(status, time, system, &self.ledger));
            }
            let now = self.reached();
            if let Err(fault) = self.advance() {
                return Err(self.ended(fault, now));
            }
        }
        Ok(())
    }

    /// Why the motion can't go on from `now`.
    pub(super) fn ended(&mut self, fault: Fault, now: f64) -> Ended {
        let (ahead, jammed) = (self.margins.lock_ahead(), &self.jams.contacts);
        Ended::at_step(&mut self.flow, fault, now, ahead, jammed)
    }

    /// Whether anything may end a piece of the motion.
    fn has_guards(&self) -> bool {
        !self.ledger.is_empty() || self.flow.has_kinks()
    }

    /// What happens at the end of the last step, and one step more.
    fn advance(&mut self) -> Result<(), Fault> {
        let now = self.reached();
        if let Some(time) = self.event.take() {
            self.change(time)?;
        }
        if let Some(time) = self.steps.at_break(&self.flow) {
            self.state.take(self.flow.layout(), self.steps.y());
            self.steps
                .begin_at_break(&mut self.flow, &self.state, time)?;
        }
        if std::mem::take(&mut self.is_pushed_anew) {
            self.state.take(self.flow.layout(), self.steps.y());
            let time = self.steps.time();
            self.steps.begin_again(&mut self.flow, &self.state, time)?;
        }
        if self.flow.equations.choose_better()? {
            self.state.take(self.flow.layout(), self.steps.y());
            self.flow.store(&mut self.state);
            self.steps.begin_again(&mut self.flow, &self.state, now)?;
        }
        if let Err(fault) = self.stride() {
            let from = self.steps.previous();
            if !self.loosen(from) {
                return Err(fault);
            }
            self.steps.begin_again(&mut self.flow, &self.state, from)?;
            self.stride()?;
        }
        self.check_outlines()?;
        let until = self.reached();
        let mut step = LastStep::new(&mut self.steps, &mut self.flow, &mut self.state);
        self.passages.note(&mut step, until);
        let piece = StepPiece {
            from: self.steps.previous(),
            until,
            has_event: self.event.is_some(),
        };
        let is_smooth = !self.has_guards();
        let (mut step, ledger, extremes) = self.last_step();
        if let Some(extremes) = extremes {
            if is_smooth {
                step.take_end();
            }
            extremes.note_step(&mut step, ledger, piece);
        }
        Ok(())
    }

    /// One step, and its first event.
    fn stride(&mut self) -> Result<(), Fault> {
        self.steps.step(&mut self.flow)?;
        self.margins.note(&self.flow, self.steps.time());
        if self.has_guards() {
            self.locate()?;
        }
        Ok(())
    }

    /// The last step, and what is kept of it.
    fn last_step(&mut self) -> (LastStep<'_, 's>, &mut Ledger, Option<&mut Box<Extremes>>) {
        let step = LastStep::new(&mut self.steps, &mut self.flow, &mut self.state);
        (step, &mut self.ledger, self.extremes.as_mut())
    }

    /// Locates the first event of the last step; where something within it can't be evaluated, of the first part of it alone,
    /// which the step then is.
    fn locate(&mut self) -> Result<(), Fault> {
        for _ in 0..HALVINGS {
            if self.try_to_locate().is_ok() {
                return Ok(());
            }
            self.halve(self.steps.time())?;
        }
        self.try_to_locate()
    }

    /// The last step again, to halfway between its beginning and `time`.
    fn halve(&mut self, time: f64) -> Result<(), Fault> {
        self.event = None;
        self.last_step().0.halve(time)
    }

    /// Locates the first event of the last step, and tells the ledger what came before it. The mechanism is evaluated at the
    /// event, or the step's end, then.
    fn try_to_locate(&mut self) -> Result<(), Fault> {
        let has_passed = {
            let (from, to) = (self.steps.previous(), self.steps.time());
            self.flow.has_passed(from, to)
        };
        let mut step = LastStep::new(&mut self.steps, &mut self.flow, &mut self.state);
        self.event = self.events.first(&mut step)?;
        let memories = self.flow.memories();
        let touching = memories.iter().any(|memory| memory.phase != Phase::Flight);
        let (until, has_event) = (self.reached(), self.event.is_some());
        let (mut step, ledger, mut extremes) = self.last_step();
        if !touching && !has_passed && !has_event {
            step.take_end();
            return Ok(());
        }
        ledger.follow(&mut step, until, &mut |ledger, step, contact, time| {
            if let Some(extremes) = &mut extremes {
                extremes.note_peak(ledger, step, contact, time);
            }
        })
    }

    /// What acts at an instant.
    fn impulses(&mut self, time: f64) -> Impulses<'_, 's> {
        let at = Instant {
            time,
            flow: &mut self.flow,
            state: &mut self.state,
            ledger: &mut self.ledger,
            jams: &mut self.jams,
        };
        Impulses::new(at, self.steps.wanted().rtol)
    }

    /// Ends a jam at `time`, beyond which the next step would be none; whether there was one. A step that was taken and can't be
    /// evaluated within is taken back: where forces grow beyond all bounds its end is beyond that by round-off.
    fn loosen(&mut self, time: f64) -> bool {
        let holds = self.flow.holds();
        let jams =
            |contact: usize| holds[contact] != Hold::Free && self.flow.has_rigid_friction(contact);
        if !(0..holds.len()).any(jams) {
            return false;
        }
        self.event = None;
        self.last_step().0.take_beginning().is_ok() && self.impulses(time).loosen().is_ok()
    }

    /// Closes and opens what events of the motion say; whether there was anything.
    fn fire(&mut self, time: f64) -> Result<bool, Fault> {
        if self.flow.system().timed.is_empty() {
            return Ok(false);
        }
        let switching = self.flow.switching();
        if switching.is_none() && !self.flow.turns_over() {
            return Ok(false);
        }
        let fired = self.flow.fired();
        if fired.is_empty() {
            return Ok(false);
        }
        if let Some(force) = switching {
            self.switches.note(force, time, self.flow.system())?;
        }
        self.flow.freeze_branches();
        for (contact, closes) in fired {
            match closes {
                true => self.impulses(time).close(contact)?,
                false => self.impulses(time).open(contact)?,
            }
        }
        Ok(true)
    }

    /// Evaluates the mechanism at an event, and tells its time: where round-off of positions makes that its guard is not positive
    /// at the time that was located, so much later that it is. An event that is not seen would be met again and again.
    fn met(&mut self, located: f64) -> Result<f64, Fault> {
        let end = self.steps.time();
        let mut later = f64::EPSILON * located;
        let mut time = located;
        loop {
            self.last_step().0.evaluate(time)?;
            if self.flow.largest_guard() > 0.0 || time >= end {
                return Ok(time);
            }
            time = (located + later).min(end);
            later *= 4.0;
        }
    }

    /// What happens at an event: impulses, then phases that end. The motion starts again from there.
    pub(super) fn change(&mut self, time: f64) -> Result<(), Fault> {
        let time = self.met(time)?;
        self.hand_over();
        self.pass();
        // Velocities that impulses leave may be an event themselves.
        while self.fire(time)? {}
        self.impulses(time).resolve()?;
        while self.fire(time)? {
            self.impulses(time).resolve()?;
        }
        let system = self.flow.system();
        let mut begun = None;
        for (contact, journal) in system.contacts.iter().enumerate() {
            let reading = self.flow.reading(contact);
            let was = self.flow.memories()[contact];
            let mut memory = was;
            if self.flow.is_carried(contact) {
                continue;
            }
            let Some(change) = change(&system.scale, journal, &mut memory, &reading) else {
                continue;
            };
            let stored = |memory| self.flow.stored(contact, memory);
            let released = stored(&was) - stored(&memory);
            self.ledger.release(contact, released);
            let at = (&self.flow, &self.state);
            let entry = self.ledger.entry(at, contact, &reading, time);
            *self.flow.memory_mut(contact) = memory;
            let now = self.flow.reading(contact);
            let told = (change, &was);
            self.ledger.change(&self.flow, contact, told, &entry, &now);
            if change == Change::Begin {
                self.state.straighten_bristle(contact);
            }
            begun = Some((contact, change));
        }
        if let Some(force) = self.flow.switching() {
            self.switches.note(force, time, self.flow.system())?;
            self.flow.freeze_branches();
            self.outside
                .note(self.flow.system(), &self.flow.equations.kinematics());
        } else if self.flow.turns_over() {
            self.flow.freeze_branches();
        }
        match begun {
            Some((contact, change)) => {
                let presses = |other: usize| other != contact && self.flow.is_in_contact(other);
                let begun = Begun {
                    contact,
                    change,
                    is_loaded: (0..system.contacts.len()).any(presses),
                };
                let at = (&self.state, time);
                self.steps.begin_piece(&mut self.flow, at, begun)?;
            }
            None => self.steps.begin_again(&mut self.flow, &self.state, time)?,
        }
        let handed = self.ledger.handed();
        if let Some(extremes) = &mut self.extremes {
            extremes.hand_over(&handed);
            extremes.begin_piece(&mut self.flow, &self.state, &self.ledger, time);
        }
        Ok(())
    }

    /// The mechanism at an output, within the last step: with the energy that contacts have dissipated and the work of
    /// everything else \[J\].
    ///
    /// # Errors
    /// Where the position can't be solved.
    pub fn output(&mut self, time: f64) -> Result<(&mut Flow<'s>, [f64; 2]), Fault> {
        for _ in 0..HALVINGS {
            match self.last_step().0.output(time) {
                // Long steps of smooth motions have stages, or predictions, that are too far from it.
                Err(Fault::Unsolved(Failure::Singular | Failure::Diverged { .. }))
                    if time > self.steps.previous() =>
                {
                    self.halve(time)?;
                    if self.has_guards() {
                        self.locate()?;
                    }
                    while self.reached() < time {
                        self.advance()?;
                    }
                }
                result => return result.map(|()| self.sampled()),
            }
        }
        self.last_step().0.output(time)?;
        Ok(self.sampled())
    }

    fn sampled(&mut self) -> (&mut Flow<'s>, [f64; 2]) {
        if self.flow.has_kinks() {
            self.outside
                .note(self.flow.system(), &self.flow.equations.kinematics());
        }
        let energy = self.ledger.energy(&self.state);
        (&mut self.flow, energy)
    }

    /// An output at which the position can't be solved.
    pub fn ended_at(&mut self, fault: Fault, time: f64) -> Ended {
        Ended::at_output(&mut self.flow, fault, time)
    }

    /// What was done goes to the report, rows of events to the outputs; the rows of peaks beside them.
    pub fn finish(mut self, outputs: &mut Trajectory, report: &mut Report) -> Trajectory {
        let extremes = self.extremes.take();
        let peaks = extremes.map(|extremes| extremes.finish(outputs));
        let system = self.flow.system();
        if !system.dependent_forces.is_empty()
            && let Some(time) = self.passages.first()
        {
            report.warnings.push(format!(
                "at t = {} the motion passes a change point: friction from reactions that have no bound \
                 there may hold or brake the mechanism more than the steps see",
                system.display.time(time)
            ));
        }
        report.warnings.extend(self.outside.warnings(system));
        let counters = self.steps.counters();
        report.statistics.steps = counters.steps;
        report.statistics.rejected = counters.rejected;
        report.statistics.evaluations = counters.evaluations;
        self.ledger
            .close(system, &self.state, self.steps.time(), report);
        self.passages.tell(report);
        let done = self.flow.equations.work();
        report.statistics.newton_iterations += done.newton_iterations;
        report.statistics.factorisations += done.factorisations;
        peaks.unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::Simulation;

    #[test]
    fn a_motion_may_go_on_in_another_thread() {
        fn is_send<T: Send>() {}
        is_send::<Simulation>();
    }
}
