//! The length and the order of the next step.

use super::{Age, Converged, ITERATIONS, PATIENCE, Radau};
use crate::integrate::control::fourth_root;

/// Safety factor of the step-size control [-].
const SAFETY: f64 = 0.9;
/// A step changes by factors within these [-].
const SHRINK: f64 = 0.2;
const GROW: f64 = 8.0;
/// J is kept when iterations shrink the error by this or when two are enough [-].
const KEEP_RATE: f64 = 1e-3;
const KEEP_ITERATIONS: u32 = 2;
/// A step that would grow by less keeps its length, and the factors [-].
const KEEP_STEP: f64 = 1.2;
/// Rates of convergence from which on the order is raised, and lowered [-].
const RAISE: f64 = 0.002;
const LOWER: f64 = 0.8;
/// A step that changes by a factor within these keeps its length well enough for another order [-].
const STEADY: std::ops::Range<f64> = 0.8..1.25;

impl Radau {
    /// Takes another number of stages from now on.
    pub(super) fn set_order(&mut self, order: usize) {
        self.order = order;
        (self.eta, self.factored) = (1.0, None);
    }

    /// e^(1/(s+1)).
    fn root(&self, error: f64) -> f64 {
        match self.order {
            0 => fourth_root(error),
            1 => libm::cbrt(error.sqrt()),
            _ => fourth_root(error.sqrt()),
        }
    }

    /// Factor for the next step after one with this error.
    pub(super) fn factor_for(&self, h: f64, error: f64, iterations: u32) -> f64 {
        let most = 2 * ITERATIONS[self.order];
        let effort = f64::from(1 + most) / f64::from(iterations + most);
        let factor = (SAFETY * effort.min(1.0) / self.root(error)).clamp(SHRINK, GROW);
        if error > 1.0 || self.taken == 0.0 || self.order != self.order_taken {
            return factor;
        }
        let predicted =
            SAFETY * (h / self.taken).abs() * self.root(self.error / error) / self.root(error);
        factor.min(predicted.clamp(SHRINK, GROW))
    }

    /// Another number of stages for the next step, where convergence speaks for it; whether that is so.
    pub(super) fn choose_order(&mut self, converged: Converged, factor: f64) -> bool {
        self.patience = self.patience.saturating_sub(1);
        let order = if converged.mean >= LOWER && self.order > 0 {
            self.patience = PATIENCE;
            self.order - 1
        } else if converged.mean <= RAISE
            && self.patience == 0
            && STEADY.contains(&factor)
            && self.order < self.highest
        {
            self.order + 1
        } else {
            return false;
        };
        self.set_order(order);
        true
    }

    /// What follows an accepted step by h with its proposed length: the next one's, J's age, and the order.
    pub(super) fn follow(
        &mut self,
        (h, first, proposed): (f64, bool, f64),
        error: f64,
        by: Converged,
    ) {
        let factor = self
            .factor_for(h, error, by.iterations)
            .min(if first { GROW } else { 1.0 });
        let keep = by.iterations <= KEEP_ITERATIONS || by.rate <= KEEP_RATE;
        self.age = if keep { Age::Kept } else { Age::Stale };
        let stay = keep && (1.0..=KEEP_STEP).contains(&factor);
        let cut = if first && h.abs() < proposed {
            proposed
        } else {
            0.0
        };
        self.h = (if stay { 1.0 } else { factor } * h.abs()).max(cut);
    }
}
