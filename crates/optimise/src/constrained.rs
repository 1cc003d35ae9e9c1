//! Constrained optimisation within bounds, by a sequence of quadratic programs.
//!
//! ```text
//! minimise  f(x)        c(x) = 0 or ≤ 0, lower ≤ x ≤ upper
//! merit     f + ρ Σ violation(c)
//! step      the quadratic program of the merit within |d| ≤ Δ, by ranges; B by Powell's damped BFGS of the Lagrangian
//! ```
//!
//! Fletcher's Sl₁QP with a trust region (Practical Methods of Optimization, 1987, §14.4), a second order correction where constraints
//! bend, and the price ρ raised until the linear constraints get as good as they can (steering: Byrd, Nocedal, Waltz 2008). A step
//! to where there is no value is refused like a bad one, and Δ shrinks: that is why it is a trust region and no line search, and why
//! no optimiser at hand served, for they all take a function to have a value everywhere.
//!
//! A greatest of many, such as a peak, has kinks where two are equal, and there the optimum often lies. Where steps are refused, the linear
//! model at the refused point joins that of the objective, whose model is then the greatest of both (a bundle; Kiwiel 1985): the next step
//! goes along the kink, and the weights of the pieces say whether it is an optimum.

mod model;

use crate::differences::{Underived, jacobian};
use crate::outcome::{Bounds, Function, Outcome};
use crate::quadratic::{Kind, Step};
use model::Search;

/// When it ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// A violation below this keeps a constraint.
    pub kept: f64,
    /// Steps at most, refused ones included.
    pub most_steps: usize,
}

impl Default for Settings {
    fn default() -> Self {
        Settings {
            kept: 1e-9,
            most_steps: 300,
        }
    }
}

/// How a search ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ended {
    /// The slopes vanish to the accuracy of the derivatives, and the constraints are kept.
    Optimum,
    /// No step makes it better, though slopes do not vanish: a kink, or noise.
    Stuck,
    /// No step makes the constraints better, and they are not kept.
    Infeasible,
    /// Steps are used up.
    Steps,
    /// There are no values at the start, or none around a point.
    NoValues,
    /// Whoever asked wants no more.
    Stopped,
}

/// What was found.
#[derive(Debug, Clone, PartialEq)]
pub struct Optimum {
    /// The variables.
    pub x: Vec<f64>,
    /// Objective, then constraints; `None` if there never were any.
    pub values: Vec<f64>,
    /// By constraint: ∂f/∂(right side), with the sign that makes ∇f + Σ multiplier ∇c vanish.
    pub multipliers: Vec<f64>,
    /// How it ended.
    pub ended: Ended,
    /// Largest slope of the Lagrangian that no bound holds, by that of f at the start, over the ranges.
    pub slope: f64,
}

/// A trust region below this moves nothing.
const LEAST_RADIUS: f64 = 1e-12;
/// Relative gain that is round-off.
const ROUND_OFF: f64 = 1e-15;
/// Slopes below this vanish: derivatives have ten digits, and second ones come from many steps.
const FLAT: f64 = 1e-6;
/// Slopes below this are not worth another step: a hundred times what differences leave.
const SETTLED: f64 = 1e-8;
/// After so many refused steps a kink is looked for.
const PATIENCE: usize = 2;
/// A step on which the first piece counts so much follows it alone.
const ALONE: f64 = 0.999;
/// Part of the gain that must come true.
const ACCEPTED: f64 = 1e-4;

/// Searches from `start`; `kinds` of the values behind the first.
pub fn minimise(
    f: &mut Function,
    kinds: &[Kind],
    bounds: &Bounds,
    start: &[f64],
    settings: &Settings,
) -> Optimum {
    let mut x = start.to_vec();
    bounds.clamp(&mut x);
    let nothing = |ended: Ended, x: Vec<f64>, values: Vec<f64>| Optimum {
        x,
        values,
        multipliers: vec![0.0; kinds.len()],
        ended,
        slope: f64::INFINITY,
    };
    let values = match f.values(&x) {
        Outcome::Values(values) => values,
        Outcome::Missing => return nothing(Ended::NoValues, x, Vec::new()),
        Outcome::Stopped => return nothing(Ended::Stopped, x, Vec::new()),
    };
    let slopes = match jacobian(f, bounds, &x, &values) {
        Ok(slopes) => slopes,
        Err(Underived::NoValues) => return nothing(Ended::NoValues, x, values),
        Err(Underived::Stopped) => return nothing(Ended::Stopped, x, values),
    };
    let mut search = Search::new(kinds, bounds, settings.kept, (x, values), slopes);
    let ended = search.run(f, settings);
    let slope = search.slope();
    let scales = search.scales;
    Optimum {
        multipliers: (search.multipliers.iter().enumerate())
            .map(|(i, own)| own * scales[0] / scales[i + 1])
            .collect(),
        x: search.x,
        values: search.values,
        ended,
        slope,
    }
}

impl Search<'_> {
    fn run(&mut self, f: &mut Function, settings: &Settings) -> Ended {
        for _ in 0..settings.most_steps {
            let Some(step) = self.priced(&self.scaled(&self.values)) else {
                return self.end();
            };
            let expected = self.expected(&step);
            let size = self.scaled(&self.values)[0]
                .abs()
                .max(self.merit(&self.values).abs());
            if expected <= ROUND_OFF * size.max(1e-3) || self.radius < LEAST_RADIUS {
                self.blend = Some(self.blended(&step.weights));
                self.multipliers = step.multipliers;
                return self.end();
            }
            let accepted = match self.attempt(f, &step, expected) {
                Ok(accepted) => accepted,
                Err(ended) => return ended,
            };
            let Some((x, values, multipliers)) = accepted else {
                if let Err(ended) = self.see(f) {
                    return ended;
                }
                continue;
            };
            let slopes = match jacobian(f, self.bounds, &x, &values) {
                Ok(slopes) => slopes,
                Err(Underived::Stopped) => return Ended::Stopped,
                Err(Underived::NoValues) => {
                    self.shrink(&step.d);
                    continue;
                }
            };
            // Between pieces slopes jump, which says nothing of how they bend.
            if step.weights[0] > ALONE {
                self.learn(&x, &slopes, &multipliers);
            }
            self.refused = None;
            self.refusals = 0;
            (self.x, self.values, self.slopes, self.multipliers) = (x, values, slopes, multipliers);
            self.forget();
            if self.worst() <= 1e-3 * self.kept && self.slope() <= SETTLED {
                return Ended::Optimum;
            }
        }
        Ended::Steps
    }

    /// Tries a step, and again with the bend of the constraints; where it leads, if it is taken.
    #[allow(clippy::type_complexity)]
    fn attempt(
        &mut self,
        f: &mut Function,
        step: &Step,
        expected: f64,
    ) -> Result<Option<(Vec<f64>, Vec<f64>, Vec<f64>)>, Ended> {
        let before = self.merit(&self.values);
        let to = self.moved(&step.d);
        let values = match f.values(&to) {
            Outcome::Stopped => return Err(Ended::Stopped),
            Outcome::Missing => {
                self.shrink(&step.d);
                self.refused = None;
                return Ok(None);
            }
            Outcome::Values(values) => values,
        };
        let ratio = (before - self.merit(&values)) / expected;
        if ratio > ACCEPTED {
            let length = largest(&step.d);
            if ratio > 0.75 && length > 0.9 * self.radius {
                self.radius = (2.0 * self.radius).min(1.0);
            } else if ratio < 0.25 {
                self.radius = 0.5 * length;
            }
            return Ok(Some((to, values, step.multipliers.clone())));
        }
        if !self.kinds.is_empty()
            && let Some(bent) = self.corrected(step, &values)
        {
            let to = self.moved(&bent.d);
            match f.values(&to) {
                Outcome::Stopped => return Err(Ended::Stopped),
                Outcome::Missing => {}
                Outcome::Values(values) => {
                    if before - self.merit(&values) > ACCEPTED * expected {
                        return Ok(Some((to, values, bent.multipliers)));
                    }
                }
            }
        }
        self.shrink(&step.d);
        self.refusals += 1;
        self.refused = Some((to, values));
        Ok(None)
    }

    /// Where steps are refused again, the objective may have a kink: takes its linear model at the last point as another piece.
    fn see(&mut self, f: &mut Function) -> Result<(), Ended> {
        if self.refusals < PATIENCE {
            return Ok(());
        }
        let Some((x, values)) = self.refused.take() else {
            return Ok(());
        };
        match jacobian(f, self.bounds, &x, &values) {
            Ok(slopes) => {
                self.add_piece(x, &values, &slopes);
                Ok(())
            }
            Err(Underived::NoValues) => Ok(()),
            Err(Underived::Stopped) => Err(Ended::Stopped),
        }
    }

    fn shrink(&mut self, d: &[f64]) {
        self.radius = 0.35 * largest(d).min(self.radius);
    }

    /// Largest violation.
    fn worst(&self) -> f64 {
        let all = self.kinds.iter().zip(&self.values[1..]);
        all.map(|(kind, value)| kind.violation(*value))
            .fold(0.0, f64::max)
    }

    /// Why no more is to be had.
    fn end(&self) -> Ended {
        match (self.worst() <= self.kept, self.slope() <= FLAT) {
            (false, _) => Ended::Infeasible,
            (true, true) => Ended::Optimum,
            (true, false) => Ended::Stuck,
        }
    }

    fn moved(&self, d: &[f64]) -> Vec<f64> {
        let mut x: Vec<f64> = (0..d.len())
            .map(|k| self.x[k] + d[k] * self.bounds.width(k))
            .collect();
        self.bounds.clamp(&mut x);
        // An interior point method comes near a bound; the bound is what it means.
        for (k, x) in x.iter_mut().enumerate() {
            match self.bounds.end(k, *x) {
                Some(crate::End::Lower) => *x = self.bounds.of(k)[0],
                Some(crate::End::Upper) => *x = self.bounds.of(k)[1],
                None => {}
            }
        }
        x
    }
}

fn largest(d: &[f64]) -> f64 {
    d.iter().fold(0.0, |most, d| d.abs().max(most))
}

#[cfg(test)]
mod tests;
