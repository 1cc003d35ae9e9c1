//! Tables that a run looks at beyond their points, where their ends hold.

use crate::element::Kinematics;
use crate::system::System;

/// The formulas that did so, each with the first time at which it was seen.
#[derive(Debug, Clone, Default)]
pub struct Outside {
    seen: Vec<(usize, f64)>,
}

impl Outside {
    /// With room for all formulas.
    pub fn new(system: &System) -> Self {
        Outside {
            seen: Vec::with_capacity(system.formulas.len()),
        }
    }

    /// Looks at all formulas at an instant.
    pub fn note(&mut self, system: &System, at: &Kinematics) {
        for (index, formula) in system.formulas.iter().enumerate() {
            let is_new = || self.seen.iter().all(|(known, _)| *known != index);
            if formula.outside(at).is_some_and(|_| is_new()) {
                self.seen.push((index, at.time));
            }
        }
    }

    /// A warning for each.
    pub fn warnings(&self, system: &System) -> impl Iterator<Item = String> {
        self.seen.iter().map(|&(index, time)| {
            format!(
                "from t = {} on, the formula of {} looks at times beyond the table, whose first and last value hold there",
                system.display.time(time),
                system.owner(system.formulas[index].force)
            )
        })
    }
}
