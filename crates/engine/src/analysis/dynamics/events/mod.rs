//! Event location: the first instant in the last step at which a guard becomes positive.

mod locate;

use super::fault::Fault;
use super::steps::LastStep;
use locate::locate;

/// Points within a step at which guards are evaluated once one of them has been positive somewhere.
const POINTS: usize = 8;
/// A step with an event is taken again to this part of it beyond the event, which is then near its end.
const BEYOND: f64 = 1e-3;

/// The first event of the last step, which ends near it then; none where no guard was positive.
///
/// # Errors
/// Where the mechanism can't be evaluated within the step.
pub fn first_event(step: &mut LastStep) -> Result<Option<f64>, Fault> {
    let (from, to) = (step.from(), step.to());
    let event = search(step)?;
    match event {
        Some(time) if from + (1.0 + BEYOND) * (time - from) < to => {
            step.take_again(from + (1.0 + BEYOND) * (time - from))?;
            search(step)
        }
        Some(_) | None => Ok(event),
    }
}

/// The first instant in the step at which a guard is positive, where there is one.
fn search(step: &mut LastStep) -> Result<Option<f64>, Fault> {
    let (from, to) = (step.from(), step.to());
    let mut guard = |time: f64| {
        step.evaluate(time)?;
        Ok::<f64, Fault>(step.flow.largest_guard())
    };
    let mut low = (from, guard(from)?.min(0.0));
    for point in 1..=POINTS {
        let time = if point == POINTS {
            to
        } else {
            from + (to - from) * point as f64 / POINTS as f64
        };
        let high = (time, guard(time)?);
        if high.1 > 0.0 {
            return locate(low, high, guard).map(Some);
        }
        low = high;
    }
    Ok(None)
}
