//! Event location: the first instant in the last step at which a guard becomes positive.

mod course;
pub(super) mod locate;
mod sweep;

use super::fault::Fault;
use super::steps::LastStep;
use locate::{Bracket, GuardPoint, locate};
use sweep::Sweep;

/// Points within a step at which guards are evaluated once one of them has been positive somewhere.
const POINTS: usize = 8;
/// Width, as a part of the distance between these points, at which an event is located.
const NARROW: f64 = 1e-10;
/// The same where events close joints.
const NARROWER: f64 = 1e-13;
/// A step with an event is taken again to this part of it beyond the event, which is then near its end.
const BEYOND: f64 = 1e-3;
/// An event is known well enough for that within this part of `BEYOND`.
const ROUGH: f64 = 0.1;

/// Finds the events of steps.
#[derive(Debug, Clone, Default)]
pub struct Events(Sweep);

impl Events {
    /// The first event of the last step, which ends near it then; `None` if no guard becomes positive. The mechanism is
    /// evaluated at the step's end then.
    ///
    /// # Errors
    /// Where the mechanism can't be evaluated within the step, or the step is too long.
    pub fn first(&mut self, step: &mut LastStep) -> Result<Option<f64>, Fault> {
        let (from, to) = (step.from(), step.to());
        let seen = match step.flow.has_passed(from, to) {
            true => search(step)?,
            false => None,
        };
        let mut found = match seen {
            Some(bracket) => self.nearer(step, bracket)?,
            None => None,
        };
        // What is seen at the evaluations of a step may not be the first event in it.
        let until = found.map_or(step.to(), |(bracket, _)| bracket.low.time);
        if let Some(bracket) = self.0.first(step, until)? {
            found = self.nearer(step, bracket)?;
        }
        match found {
            Some((bracket, narrow)) => {
                let located = locate(bracket, narrow, |time| guard(step, time))?;
                Ok(Some(located.high.time))
            }
            None if self.0.taken() > 0 => step.evaluate(step.to()).map(|()| None),
            None => Ok(None),
        }
    }

    /// The first event between two times of the last step, which ends near it then, and how narrowly it is to be located.
    fn nearer(
        &mut self,
        step: &mut LastStep,
        bracket: Bracket,
    ) -> Result<Option<(Bracket, f64)>, Fault> {
        let (from, to) = (step.from(), step.to());
        // Where joints meet depends on the instant at which they close.
        let part = match step.flow.system().timed.is_empty() {
            true => NARROW,
            false => NARROWER,
        };
        let narrow = part * bracket.width();
        let bracket = locate(
            bracket,
            ROUGH * BEYOND * (bracket.high.time - from),
            |time| guard(step, time),
        )?;
        let beyond = |time: f64| from + (1.0 + BEYOND) * (time - from);
        if beyond(bracket.high.time) >= to {
            return Ok(Some((bracket, narrow)));
        }
        step.take_again(beyond(bracket.high.time))?;
        let before = from + (1.0 - BEYOND) * (bracket.low.time - from);
        let mut again = between(step, before, step.to())?;
        if again.is_none() {
            again = search(step)?;
        }
        // One that soon ends again.
        if again.is_none() {
            again = self.0.first(step, step.to())?;
        }
        let narrow = narrow.min(part * (step.to() - from) / POINTS as f64);
        Ok(again.map(|bracket| (bracket, narrow)))
    }
}

/// The largest guard at a time within the step.
fn guard(step: &mut LastStep, time: f64) -> Result<f64, Fault> {
    step.evaluate(time)?;
    Ok(step.flow.largest_guard())
}

/// An event between two times, of which guards are positive at the later one alone.
fn between(step: &mut LastStep, low: f64, high: f64) -> Result<Option<Bracket>, Fault> {
    let mut point = |time: f64| {
        Ok::<_, Fault>(GuardPoint {
            time,
            value: guard(step, time)?,
        })
    };
    let (low, high) = (point(low)?, point(high)?);
    Ok((low.value <= 0.0 && high.value > 0.0).then_some(Bracket { low, high }))
}

/// The two neighbouring points between which a guard first becomes positive.
fn search(step: &mut LastStep) -> Result<Option<Bracket>, Fault> {
    let (from, to) = (step.from(), step.to());
    let mut point = |time: f64| {
        Ok::<_, Fault>(GuardPoint {
            time,
            value: guard(step, time)?,
        })
    };
    let mut low = point(from)?;
    low.value = low.value.min(0.0);
    for index in 1..=POINTS {
        let time = match index {
            POINTS => to,
            _ => from + (to - from) * index as f64 / POINTS as f64,
        };
        let high = point(time)?;
        if high.value > 0.0 {
            return Ok(Some(Bracket { low, high }));
        }
        low = high;
    }
    Ok(None)
}
