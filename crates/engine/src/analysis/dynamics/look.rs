//! Looks at a step that was taken: the first event in it, and what contacts did before.

use super::fault::Fault;
use super::integration::{HALVINGS, Integration};
use super::locate::locate;
use super::motion::Motion;
use crate::element::journal::Phase;
use crate::integrate::Ode;

/// Points within a step at which guards are looked at once one of them has been positive somewhere.
const LOOKS: usize = 8;
/// A step with an event is taken again to this part of it beyond the event, which is then near its end.
const BEYOND: f64 = 1e-3;

impl Integration {
    /// Looks at the last step; where something within it can't be evaluated, at the first part of it alone, which the step
    /// then is.
    pub(super) fn look_closely(&mut self, motion: &mut Motion) -> Result<(), Fault> {
        for _ in 0..HALVINGS {
            if self.look(motion).is_ok() {
                return Ok(());
            }
            self.halve(motion, self.stepper.t())?;
        }
        self.look(motion)
    }

    /// Takes the last step again, to halfway between its beginning and `time`.
    pub(super) fn halve(&mut self, motion: &mut Motion, time: f64) -> Result<(), Fault> {
        self.pending = None;
        let from = self.stepper.previous();
        self.step_again(motion, from, 0.5 * (from + time))
    }

    /// y and the mechanism at a time within the last step.
    pub(super) fn evaluate_at(&mut self, motion: &mut Motion, time: f64) -> Result<(), Fault> {
        let known = self.stepper.interpolate(motion, time, &mut self.y);
        known.map_err(|refused| motion.refused(refused))?;
        Ok(motion.evaluate(time, &self.y)?)
    }

    /// Finds the first event of the last step, and tells the histories what came before it. The mechanism is evaluated at the
    /// event, or the step's end, then.
    fn look(&mut self, motion: &mut Motion) -> Result<(), Fault> {
        let (mut from, mut to) = (self.stepper.previous(), self.stepper.t());
        let has_passed = motion.passed(from, to);
        if has_passed {
            self.pending = self.first_event(motion, from, to)?;
        }
        if let Some(time) = self.pending
            && from + (1.0 + BEYOND) * (time - from) < to
        {
            self.step_again(motion, from, from + (1.0 + BEYOND) * (time - from))?;
            (from, to) = (self.stepper.previous(), self.stepper.t());
            self.pending = self.first_event(motion, from, to)?;
        }
        let until = self.reached();
        let touching = motion
            .reduced
            .inputs
            .contacts
            .iter()
            .any(|memory| memory.phase != Phase::Flight);
        if !touching && !has_passed {
            // The step's last evaluation was at its end.
            self.y.resize(motion.dimension(), 0.0);
            self.y.copy_from_slice(self.stepper.y());
            return Ok(());
        }
        self.evaluate_at(motion, until)?;
        for contact in 0..self.histories.len() {
            let reading = motion.reading(contact);
            if motion.reduced.inputs.contacts[contact].phase == Phase::Contact {
                if self.peaks(motion, contact, &reading, from, until)? {
                    self.evaluate_at(motion, until)?;
                }
                let sums = self.sums(motion, contact);
                let angle = motion.contact_angle(contact, &reading);
                self.histories[contact].go_on(&reading, sums, angle);
            }
            self.last[contact] = reading;
        }
        Ok(())
    }

    /// The last step once more, from its beginning, to `to` within it: a method's continuous extension is less accurate than
    /// the ends of its steps, and where the motion goes on after an event is such an end.
    fn step_again(&mut self, motion: &mut Motion, from: f64, to: f64) -> Result<(), Fault> {
        let mut y = std::mem::take(&mut self.y);
        y.resize(motion.dimension(), 0.0);
        let known = self
            .stepper
            .interpolate(motion, from, &mut y)
            .map_err(|refused| motion.refused(refused));
        let end = std::mem::replace(&mut self.end, to);
        let restarted = known.and_then(|()| self.restart(motion, from, &y, Some(to - from)));
        (self.y, self.end) = (y, end);
        restarted.map_err(Fault::of_part)?;
        // Where it is rejected now, a shorter one takes its place.
        let taken = self.stepper.step(motion, to);
        taken.map_err(|failure| motion.stopped(failure).of_part())
    }

    /// The first instant in (from, to] at which a guard is positive, where there is one.
    fn first_event(
        &mut self,
        motion: &mut Motion,
        from: f64,
        to: f64,
    ) -> Result<Option<f64>, Fault> {
        let guard = |integration: &mut Self, motion: &mut Motion, time: f64| {
            integration.evaluate_at(motion, time)?;
            Ok::<f64, Fault>(motion.worst())
        };
        let mut low = (from, guard(self, motion, from)?.min(0.0));
        for look in 1..=LOOKS {
            let time = if look == LOOKS {
                to
            } else {
                from + (to - from) * look as f64 / LOOKS as f64
            };
            let high = (time, guard(self, motion, time)?);
            if high.1 > 0.0 {
                return locate(low, high, |time| guard(self, motion, time)).map(Some);
            }
            low = high;
        }
        Ok(None)
    }
}
