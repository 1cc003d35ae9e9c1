//! How far the friction of ideal joints is from locking them.

use super::flow::Flow;
use super::words::TIGHT;

/// A lock that lies ahead by less than this many rounding units of the time is where the steps end.
const LOCK_AHEAD: f64 = 1e6;

/// How far the equations of friction are from having no solution.
#[derive(Debug, Clone, Copy)]
struct Margin {
    time: f64,
    /// Their determinant: 1 without friction, 0 where a joint locks itself.
    left: f64,
    /// The force that feeds on itself most.
    force: usize,
}

/// Margins at the ends of the last two steps.
#[derive(Clone)]
pub struct Margins([Margin; 2]);

impl Margins {
    /// Before the first step.
    pub fn new() -> Self {
        Margins(
            [Margin {
                time: f64::NEG_INFINITY,
                left: 1.0,
                force: 0,
            }; 2],
        )
    }

    /// Notes how far the friction is from locking a joint at `time`, the end of the step just taken.
    pub fn note(&mut self, flow: &Flow, time: f64) {
        let dependent = flow.equations.dependent_forces();
        if flow.system().dependent_forces.is_empty() || dependent.locked().is_some() {
            return;
        }
        let here = Margin {
            time,
            left: dependent.margin(),
            force: dependent.tightest(),
        };
        if here.time > self.0[1].time {
            self.0 = [self.0[1], here];
        }
    }

    /// The force that locks its joint within the next few of the shortest steps, where its margin goes to zero: friction
    /// grows there as 1/(t* − t), or with its root, so that every step goes a part of the way only.
    pub fn lock_ahead(&self) -> Option<usize> {
        let [before, here] = self.0;
        let fall = (before.left - here.left) / (here.time - before.time);
        let ahead = here.left / fall;
        let near = LOCK_AHEAD * f64::EPSILON * here.time.abs();
        (here.left < TIGHT && fall > 0.0 && ahead <= near).then_some(here.force)
    }
}
