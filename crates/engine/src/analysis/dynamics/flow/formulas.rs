//! How far formulas are from their kinks.

use super::marks::Sample;
use crate::mechanism::reduced::Reduced;

/// How far beyond its side a kink is before that counts, by its scale: above what velocities resolve.
pub(super) const PAST: f64 = 1e-12;

/// How far a formula is past its side, beyond what counts for none.
pub(super) fn beyond(equations: &Reduced, formula: usize) -> f64 {
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
