//! The steps of the integration, and the last of them as a function of time.

use super::fault::Fault;
use super::flow::Flow;
use super::paces::{Begun, Paces};
use super::settings::{Exactness, Settings};
use super::state::State;
use crate::integrate::{Counters, Limits, Method, Refused, StepFailure, Stepper};

/// How far before a break of a law steps end, of the time of the run \[–\]: so that no stage sees what comes after it, by far less
/// than the motion is known to.
const BEFORE_BREAK: f64 = 16.0 * f64::EPSILON;

/// The stepper at work.
#[derive(Clone)]
pub struct Steps {
    method: Method,
    wanted: Exactness,
    max_step: Option<f64>,
    stepper: Box<dyn Stepper>,
    /// Work of steppers before.
    before: Counters,
    /// Where the run ends \[s\].
    end: f64,
    paces: Paces,
}

impl Steps {
    /// Starts at t = 0.
    ///
    /// # Errors
    /// Where the equations can't be evaluated there.
    pub fn new(
        settings: &Settings,
        wanted: Exactness,
        (flow, state): (&mut Flow, &State),
        end: f64,
    ) -> Result<Self, Fault> {
        let mut steps = Steps {
            method: settings.method,
            wanted,
            max_step: settings.max_step,
            stepper: stepper(
                settings.method,
                flow,
                wanted,
                settings.max_step,
                settings.initial_step,
            ),
            before: Counters::default(),
            end,
            paces: Paces::new(flow.system().contacts.len()),
        };
        steps.start(flow, 0.0, state.as_slice(), end)?;
        Ok(steps)
    }

    fn start(&mut self, flow: &mut Flow, time: f64, y: &[f64], end: f64) -> Result<(), Fault> {
        let started = self.stepper.start(flow, time, y, end);
        flow.equations.tell();
        started.map_err(|failure| flow.stopped(failure))
    }

    /// Starts again at (time, y), with a first step where one is given, towards `end`.
    fn restart(
        &mut self,
        flow: &mut Flow,
        (time, y): (f64, &[f64]),
        step: Option<f64>,
        end: f64,
    ) -> Result<(), Fault> {
        self.before = self.counters();
        self.stepper = stepper(self.method, flow, self.wanted, self.max_step, step);
        self.start(flow, time, y, end)
    }

    /// Starts again at (time, y), with steps as long as the last one was.
    ///
    /// # Errors
    /// Where the equations can't be evaluated there.
    pub fn begin_again(&mut self, flow: &mut Flow, state: &State, time: f64) -> Result<(), Fault> {
        let step = (self.time() - self.previous()).abs();
        let step = (step > 0.0).then_some(step);
        self.restart(flow, (time, state.as_slice()), step, self.end)
    }

    /// The same after a contact has changed: with steps as long as they were at the beginning of such a piece before.
    ///
    /// # Errors
    /// As there.
    pub fn begin_piece(
        &mut self,
        flow: &mut Flow,
        (state, time): (&State, f64),
        begun: Begun,
    ) -> Result<(), Fault> {
        let step = self.paces.begin(begun);
        self.restart(flow, (time, state.as_slice()), step, self.end)
    }

    /// How near steps come to a break \[s\].
    fn margin(&self) -> f64 {
        BEFORE_BREAK * self.end
    }

    /// The break of a law to which the last step has led \[s\].
    pub fn at_break(&self, flow: &Flow) -> Option<f64> {
        let time = self.time();
        let next = flow.system().next_break(time)?;
        (time > 0.0 && next - time <= 2.0 * self.margin() && next <= self.end).then_some(next)
    }

    /// Starts again at a break, with steps of whatever length fits there.
    ///
    /// # Errors
    /// Where the equations can't be evaluated there.
    pub fn begin_at_break(
        &mut self,
        flow: &mut Flow,
        state: &State,
        time: f64,
    ) -> Result<(), Fault> {
        self.restart(flow, (time, state.as_slice()), None, self.end)
    }

    /// How far the next step may go: no law has a break on the way.
    fn ahead(&self, flow: &Flow) -> f64 {
        let next = flow.system().next_break(self.time() + 2.0 * self.margin());
        next.map_or(self.end, |next| (next - self.margin()).min(self.end))
    }

    /// One step.
    ///
    /// # Errors
    /// Where it can't be taken.
    pub fn step(&mut self, flow: &mut Flow) -> Result<(), Fault> {
        let ahead = self.ahead(flow);
        flow.begin_step();
        let taken = self.stepper.step(flow, ahead);
        flow.equations.tell();
        taken.map_err(|failure| flow.stopped(failure))?;
        self.paces.note((self.time() - self.previous()).abs());
        Ok(())
    }

    /// End of the last step \[s\].
    pub fn time(&self) -> f64 {
        self.stepper.t()
    }

    /// y there.
    pub fn y(&self) -> &[f64] {
        self.stepper.y()
    }

    /// Its beginning \[s\].
    pub fn previous(&self) -> f64 {
        self.stepper.previous()
    }

    /// Where the run ends \[s\].
    pub fn end(&self) -> f64 {
        self.end
    }

    /// Steps go until there from now on \[s\].
    pub fn set_end(&mut self, end: f64) {
        self.end = end;
    }

    /// What is wanted of a step's error.
    pub fn wanted(&self) -> Exactness {
        self.wanted
    }

    /// Work done so far.
    pub fn counters(&self) -> Counters {
        self.before + self.stepper.counters()
    }
}

fn stepper(
    method: Method,
    flow: &Flow,
    wanted: Exactness,
    max_step: Option<f64>,
    initial_step: Option<f64>,
) -> Box<dyn Stepper> {
    let limits = Limits {
        initial_step,
        max_step,
        pace: Some(flow.system().scale.time),
        ..Limits::default()
    };
    method.stepper(flow.tolerance(wanted), limits)
}

impl Flow<'_> {
    /// What a step that can't be taken means: the stepper knows only that it was refused, the flow why.
    fn stopped(&self, failure: StepFailure) -> Fault {
        if let Some(force) = self.without_value() {
            return Fault::NoValue { force };
        }
        match failure {
            StepFailure::TooSmall { t, h } => Fault::TooSmall { t, h },
            StepFailure::Refused { .. } => self.refused(Refused),
        }
    }

    fn refused(&self, _: Refused) -> Fault {
        Fault::Unsolved(self.refusal())
    }
}

/// The last step as a function of time, by the method's continuous extension.
pub struct LastStep<'a, 's> {
    /// The stepper.
    pub steps: &'a mut Steps,
    /// The mechanism, at the time of the last evaluation.
    pub flow: &'a mut Flow<'s>,
    /// y there.
    pub state: &'a mut State,
}

impl<'a, 's> LastStep<'a, 's> {
    /// Of a stepper and the mechanism that it moves.
    pub fn new(steps: &'a mut Steps, flow: &'a mut Flow<'s>, state: &'a mut State) -> Self {
        LastStep { steps, flow, state }
    }

    /// Its beginning \[s\].
    pub fn from(&self) -> f64 {
        self.steps.previous()
    }

    /// Its end \[s\].
    pub fn to(&self) -> f64 {
        self.steps.time()
    }

    /// y at a time within the step.
    fn interpolate(&mut self, time: f64) -> Result<(), Fault> {
        let stepper = &mut self.steps.stepper;
        let known = stepper.interpolate(self.flow, time, self.state.as_mut_slice());
        known.map_err(|refused| self.flow.refused(refused))
    }

    /// y and the mechanism at a time within the step.
    ///
    /// # Errors
    /// Where the position can't be solved.
    pub fn evaluate(&mut self, time: f64) -> Result<(), Fault> {
        self.interpolate(time)?;
        Ok(self.flow.evaluate(time, self.state.as_slice())?)
    }

    /// The coordinate of one of the mechanism's curves at a time within the step [rad or m].
    ///
    /// # Errors
    /// As there.
    pub fn coordinate(&mut self, curve: usize, time: f64) -> Result<f64, Fault> {
        if self.flow.equations.is_curve() {
            self.interpolate(time)?;
            return Ok(self.state.as_slice()[0]);
        }
        self.evaluate(time)?;
        let equations = &self.flow.equations;
        let coordinate = equations.coordinate(curve, equations.position());
        Ok(coordinate.unwrap_or(f64::NAN))
    }

    /// The same, exactly onto the constraints.
    ///
    /// # Errors
    /// As there.
    pub fn evaluate_exactly(&mut self, time: f64) -> Result<(), Fault> {
        self.interpolate(time)?;
        Ok(self.flow.evaluate_exactly(time, self.state.as_slice())?)
    }

    /// y at its end, where the mechanism was evaluated last.
    pub fn take_end(&mut self) {
        self.state.take(self.flow.layout(), self.steps.y());
    }

    /// y at its beginning, which is its end too where the next one has failed.
    ///
    /// # Errors
    /// Where it can't be interpolated.
    pub fn take_beginning(&mut self) -> Result<(), Fault> {
        if self.from() == self.to() {
            self.take_end();
            return Ok(());
        }
        self.state.fit(self.flow.layout());
        self.interpolate(self.from())
    }

    /// The point of an output: y and the mechanism, exactly onto the constraints.
    ///
    /// # Errors
    /// Where the position can't be solved.
    pub fn output(&mut self, time: f64) -> Result<(), Fault> {
        self.state.fit(self.flow.layout());
        if time != self.to() {
            return self.evaluate_exactly(time);
        }
        self.take_end();
        Ok(self.flow.evaluate_exactly(time, self.state.as_slice())?)
    }

    /// The same step once more, to `to` within it: a method's continuous extension is less accurate than the ends of its
    /// steps, and where the motion goes on after an event is such an end.
    ///
    /// # Errors
    /// Where it can't be taken again.
    pub fn take_again(&mut self, to: f64) -> Result<(), Fault> {
        let from = self.from();
        self.state.fit(self.flow.layout());
        self.interpolate(from)
            .and_then(|()| {
                let point = (from, self.state.as_slice());
                self.steps.restart(self.flow, point, Some(to - from), to)
            })
            .map_err(Fault::of_part)?;
        // Where it is rejected now, a shorter one takes its place.
        self.flow.begin_step();
        let taken = self.steps.stepper.step(self.flow, to);
        self.flow.equations.tell();
        taken.map_err(|failure| self.flow.stopped(failure).of_part())
    }

    /// The same step once more, to halfway between its beginning and `time`.
    ///
    /// # Errors
    /// As [`LastStep::take_again`].
    pub fn halve(&mut self, time: f64) -> Result<(), Fault> {
        self.take_again(0.5 * (self.from() + time))
    }
}
