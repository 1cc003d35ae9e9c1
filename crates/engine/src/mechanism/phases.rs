//! The systems of one mechanism by the rows in force, each made when it is first wanted.
//!
//! They are picked from rows that are compiled already (see [`System::with_rows`]) and stay where they are, so that solvers
//! may borrow them. One system with a mask would not do: patterns, scales and eliminations belong to one set of rows, and a
//! motion comes back to few of them often.

use crate::element::Constraint;
use crate::element::pair::Hold;
use crate::system::System;
use std::borrow::Cow;
use std::sync::{Arc, OnceLock};

/// For each part the window in which its smooth branch stands for its joints.
pub type Windows = Vec<Option<usize>>;

/// Constraints in the place of those of some blocks.
pub type Exchanged = Vec<(usize, Arc<dyn Constraint>)>;

/// A mechanism in all phases that it has been in.
pub struct Phases<'m> {
    /// With all contacts in flight.
    whole: Cow<'m, System>,
    first: Link,
}

type Link = OnceLock<Box<LinkedPhase>>;

/// One of them, and the next.
struct LinkedPhase {
    /// Those that are held.
    holds: Vec<(usize, Hold)>,
    windows: Windows,
    system: System,
    next: Link,
}

impl Drop for LinkedPhase {
    /// One after the other: a tip that rolls along an outline makes a phase of each of its pieces.
    fn drop(&mut self) {
        let mut link = std::mem::take(&mut self.next);
        while let Some(mut phase) = link.into_inner() {
            link = std::mem::take(&mut phase.next);
        }
    }
}

impl<'m> Phases<'m> {
    /// Of the mechanism with all contacts in flight.
    pub fn new(whole: Cow<'m, System>) -> Self {
        Phases {
            whole,
            first: Link::new(),
        }
    }

    /// The mechanism with all contacts in flight.
    pub fn whole(&self) -> &System {
        &self.whole
    }

    /// The system in which the contacts are held so, and the parts are in these windows; `exchanged` makes what stands for them
    /// there.
    pub fn get(
        &self,
        holds: &[Hold],
        windows: &Windows,
        exchanged: impl FnOnce() -> Exchanged,
    ) -> &System {
        let held = holds.iter().copied().enumerate();
        let held: Vec<(usize, Hold)> = held.filter(|(_, hold)| *hold != Hold::Free).collect();
        if held.is_empty() && windows.iter().all(Option::is_none) {
            return &self.whole;
        }
        let mut link = &self.first;
        while let Some(phase) = link.get() {
            if phase.holds == held && phase.windows == *windows {
                return &phase.system;
            }
            link = &phase.next;
        }
        let made = link.get_or_init(|| {
            Box::new(LinkedPhase {
                holds: held,
                windows: windows.clone(),
                system: self.whole.with_rows(holds, exchanged()),
                next: Link::new(),
            })
        });
        &made.system
    }
}
