//! Changes of the sides of formulas' kinks, and those that never end.

use super::fault::Fault;
use crate::system::System;

/// Changes that follow each other at once, after which a formula is one that holds the motion where it jumps.
const MANY: usize = 100;
/// Two changes follow each other at once within this part of the mechanism's own time.
const AT_ONCE: f64 = 1e-7;

/// The changes so far.
#[derive(Debug, Clone, Default)]
pub struct Switches {
    last: Option<f64>,
    /// How many have followed each other at once.
    at_once: usize,
}

impl Switches {
    /// The formula of a force changes its side at `time`.
    ///
    /// # Errors
    /// Where it has done so without end.
    pub fn note(&mut self, force: usize, time: f64, system: &System) -> Result<(), Fault> {
        let near = AT_ONCE * system.scale.time;
        let is_at_once = self.last.is_some_and(|last| time - last < near);
        self.at_once = if is_at_once { self.at_once + 1 } else { 0 };
        self.last = Some(time);
        match self.at_once > MANY {
            true => Err(Fault::Chatters { force }),
            false => Ok(()),
        }
    }
}
