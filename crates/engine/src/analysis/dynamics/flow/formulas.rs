//! Formulas and cams whose kinks are held on one side each, so that the flow is smooth between events.

use super::{Flow, Sample};
use crate::mechanism::reduced::Reduced;

/// How far beyond its side a kink is before that counts, by its scale: above what velocities resolve.
const PAST: f64 = 1e-12;
/// How far it is at an event: less, so that one that was located is there as well when the mechanism is evaluated again, with
/// round-off of its own.
const STILL_PAST: f64 = 0.5 * PAST;

impl Flow<'_> {
    /// Whether any formula or cam has kinks.
    pub fn has_kinks(&self) -> bool {
        !self.system().kinks.is_empty()
    }

    /// Holds all formulas and cams on the sides on which they are at the point of the last evaluation.
    pub fn freeze_branches(&mut self) {
        if self.has_kinks() {
            self.equations.take_sides();
        }
    }

    /// The formulas whose sides are held.
    fn held_formulas(&self) -> std::ops::Range<usize> {
        match self.has_kinks() {
            true => 0..self.system().formulas.len(),
            false => 0..0,
        }
    }

    /// The largest guard of formulas and cams at the point of the last evaluation: positive where one is beyond its side.
    pub(super) fn formula_guard(&self) -> f64 {
        let guards = self.held_formulas().map(|formula| self.beyond(formula));
        guards.fold(self.cam_guard(), f64::max)
    }

    /// The largest guard of the cams: positive where one is beyond the stretch of its law.
    fn cam_guard(&self) -> f64 {
        let at = self.equations.kinematics();
        let guards = self.system().cams().map(|cam| cam.beyond(&at) - PAST);
        guards.fold(f64::NEG_INFINITY, f64::max)
    }

    /// The guard of a formula where its arguments have these levels.
    pub fn guard_at(&self, formula: usize, levels: &[f64]) -> f64 {
        let system = self.system();
        let sides = &self.equations.inputs.sides;
        system.formulas[formula].beyond_at(levels, sides, &system.kinks) - PAST
    }

    /// Whether a cam comes to another stretch of its law at the point of the last evaluation.
    pub fn turns_over(&self) -> bool {
        self.has_kinks() && self.cam_guard() > STILL_PAST - PAST
    }

    fn beyond(&self, formula: usize) -> f64 {
        beyond(&self.equations, formula)
    }

    /// The force of the first formula that is beyond its side at the point of the last evaluation.
    pub fn switching(&self) -> Option<usize> {
        let mut formulas = self.held_formulas();
        let formula = formulas.find(|formula| self.beyond(*formula) > STILL_PAST - PAST)?;
        Some(self.system().formulas[formula].force)
    }

    /// The force of the first formula that has no value at the point of the last evaluation.
    pub fn without_value(&self) -> Option<usize> {
        let at = self.equations.kinematics();
        let mut formulas = self.system().formulas.iter();
        let formula = formulas.find(|formula| !formula.value(&at).is_finite())?;
        Some(formula.force)
    }
}

/// How far a formula is past its side, beyond what counts for none.
fn beyond(equations: &Reduced, formula: usize) -> f64 {
    let (system, inputs) = (equations.system(), &equations.inputs);
    equations.evaluation().beyond(system, inputs, formula) - PAST
}

/// The levels of the formulas' arguments at the point of the last evaluation, one formula's after the other's.
pub(super) fn levels(equations: &Reduced, mut levels: &mut [[f64; 2]]) {
    let (system, at) = (equations.system(), equations.kinematics());
    if levels.is_empty() {
        return;
    }
    for formula in &system.formulas {
        let (own, others) = levels.split_at_mut(formula.arguments.len());
        formula.levels(&at, own);
        levels = others;
    }
}

/// The largest guard of formulas and cams whose sides are held, at the point of the last evaluation, with a sample of each.
pub(super) fn sample_sides(equations: &Reduced, samples: &mut [Sample]) -> f64 {
    if samples.is_empty() {
        return f64::NEG_INFINITY;
    }
    let (system, at) = (equations.system(), equations.kinematics());
    let formulas = (0..system.formulas.len()).map(|formula| beyond(equations, formula));
    let cams = system.cams().map(|cam| cam.beyond(&at) - PAST);
    let guards = formulas.chain(cams).zip(samples);
    guards.fold(f64::NEG_INFINITY, |largest, (guard, sample)| {
        *sample = Sample::of(guard);
        largest.max(guard)
    })
}
