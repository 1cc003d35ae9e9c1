//! One start: a global search over the whole box, and a local one from the best of what it saw.
//!
//! Start k takes points k M … (k + 1) M − 1 of one scrambled Sobol sequence, so that all starts together cover the box evenly and each
//! is a pure function of (seed, k): the same whichever thread runs it.
//!
//! Least squares go on from one candidate after the other. A descent that is not half as good as the best after some steps is given
//! up, and the start ends where no residual is left, for below zero nobody gets, or where ten descents ended at the best. With 25 points of a four-bar's curve and nine unknowns
//! about every twelfth descent reaches the bottom, so that sixty reach it nearly always. Constrained problems have no known bottom;
//! there a start goes down from its best candidate, and other starts say whether there is more.

use crate::constrained::{self, Optimum, minimise};
use crate::least_squares::{self, Ended, Fitted, least_squares};
use crate::outcome::{Bounds, Function, Outcome};
use crate::quadratic::Kind;
use linkdyn_study::design::{DesignFault, Layout, Method, Samples};

/// Which start, and what it may cost.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Start {
    /// Seed of all starts.
    pub seed: u64,
    /// Number of this one.
    pub number: u64,
    /// Points of the global search.
    pub points: u64,
    /// Descents from the best of them, at most.
    pub descents: usize,
}

/// Steps after which a descent must be good.
const TRIAL: usize = 40;
/// So many descents to the same value are enough.
const SAME: usize = 10;
/// Values that differ by less than this part are the same.
const ALIKE: f64 = 1e-6;
/// A descent must be as good as this part of the best.
const HOPEFUL: f64 = 0.5;

impl Start {
    /// The points of the global search, in the box.
    ///
    /// # Errors
    /// More variables than Sobol points have.
    pub fn candidates(&self, bounds: &Bounds) -> Result<Vec<Vec<f64>>, DesignFault> {
        let method = Method::Sobol { scrambled: true };
        let first = self.number * self.points;
        let samples = Samples::new(
            method,
            Layout::Plain,
            first + self.points,
            bounds.len(),
            self.seed,
        )?;
        let mut parts = vec![0.0; bounds.len()];
        let all = first..first + self.points;
        Ok(all
            .map(|number| {
                samples.row(number, &mut parts);
                bounds.point(&parts)
            })
            .collect())
    }
}

/// How good a point is: violation first, then the value; smaller is better.
#[derive(Debug, Clone, PartialEq)]
struct Ranked {
    violation: f64,
    value: f64,
    x: Vec<f64>,
    values: Vec<f64>,
}

impl Ranked {
    fn order(&self, other: &Ranked) -> std::cmp::Ordering {
        let violation = self.violation.total_cmp(&other.violation);
        violation.then(self.value.total_cmp(&other.value))
    }
}

/// The candidates that have values, the best first, and whether it was stopped.
fn rank(
    f: &mut Function,
    candidates: Vec<Vec<f64>>,
    of: impl Fn(&[f64]) -> [f64; 2],
) -> (Vec<Ranked>, bool) {
    let mut ranked = Vec::with_capacity(candidates.len());
    let mut is_stopped = false;
    for x in candidates {
        let values;
        let [violation, value] = match f.values(&x) {
            Outcome::Values(found) => {
                values = found;
                of(&values)
            }
            Outcome::Missing => continue,
            Outcome::Stopped => {
                is_stopped = true;
                break;
            }
        };
        ranked.push(Ranked {
            violation,
            value,
            x,
            values,
        });
    }
    // Of equals the first one, for sorting is stable.
    ranked.sort_by(Ranked::order);
    (ranked, is_stopped)
}

fn length(residuals: &[f64]) -> f64 {
    residuals.iter().map(|r| r * r).sum::<f64>().sqrt()
}

/// Least squares from all over the box; `given` is a candidate that is tried first.
///
/// # Errors
/// More variables than Sobol points have.
pub fn fit(
    f: &mut Function,
    bounds: &Bounds,
    start: &Start,
    given: Option<&[f64]>,
    settings: &least_squares::Settings,
) -> Result<Fitted, DesignFault> {
    let middle = || bounds.point(&vec![0.5; bounds.len()]);
    let nothing = |ended: Ended| Fitted {
        x: middle(),
        residuals: Vec::new(),
        ended,
        slope: f64::INFINITY,
    };
    let (mut ranked, is_stopped) = rank(f, start.candidates(bounds)?, |residuals| {
        [0.0, length(residuals)]
    });
    if is_stopped {
        ranked.truncate(1);
        let seen = ranked.pop().map(|own| Fitted {
            x: own.x,
            residuals: own.values,
            ..nothing(Ended::Stopped)
        });
        return Ok(seen.unwrap_or_else(|| nothing(Ended::Stopped)));
    }
    let first = given.map(<[f64]>::to_vec).into_iter();
    let tried = first.chain(ranked.into_iter().map(|one| one.x));
    let mut best: Option<Fitted> = None;
    let mut same = 0;
    for x in tried.take(start.descents) {
        let good = best.as_ref().map(|best| length(&best.residuals));
        let settings = least_squares::Settings {
            trial: good.map_or(usize::MAX, |_| TRIAL),
            hopeful: good.map_or(f64::INFINITY, |good| HOPEFUL * good),
            ..*settings
        };
        let found = least_squares(f, bounds, &x, &settings);
        let ended = found.ended;
        if found.residuals.is_empty() {
            if ended == Ended::Stopped {
                break;
            }
            continue;
        }
        let own = length(&found.residuals);
        same = match good {
            Some(good) if (own - good).abs() <= ALIKE * good => same + 1,
            Some(good) if own > good => same,
            Some(_) | None => 1,
        };
        if good.is_none_or(|good| own < good) {
            best = Some(found);
        }
        match (ended, &mut best) {
            (Ended::Solved, _) => break,
            _ if same >= SAME => break,
            (Ended::Stopped, Some(best)) => {
                best.ended = Ended::Stopped;
                break;
            }
            _ => {}
        }
    }
    Ok(best.unwrap_or_else(|| nothing(Ended::NoValues)))
}

/// A constrained optimum from all over the box; `given` is a candidate that is tried first.
///
/// # Errors
/// More variables than Sobol points have.
pub fn optimise(
    f: &mut Function,
    kinds: &[Kind],
    bounds: &Bounds,
    start: &Start,
    given: Option<&[f64]>,
    settings: &constrained::Settings,
) -> Result<Optimum, DesignFault> {
    let nothing = |ended: constrained::Ended| Optimum {
        x: bounds.point(&vec![0.5; bounds.len()]),
        values: Vec::new(),
        multipliers: vec![0.0; kinds.len()],
        ended,
        slope: f64::INFINITY,
    };
    let of = |values: &[f64]| {
        let all = kinds.iter().zip(&values[1..]);
        [
            all.map(|(kind, value)| kind.violation(*value)).sum(),
            values[0],
        ]
    };
    let mut tried: Vec<Vec<f64>> = given.map(<[f64]>::to_vec).into_iter().collect();
    if tried.len() < start.descents {
        let (mut ranked, is_stopped) = rank(f, start.candidates(bounds)?, of);
        if is_stopped {
            ranked.truncate(1);
            let seen = ranked.pop().map(|own| Optimum {
                x: own.x,
                values: own.values,
                ..nothing(constrained::Ended::Stopped)
            });
            return Ok(seen.unwrap_or_else(|| nothing(constrained::Ended::Stopped)));
        }
        tried.extend(ranked.into_iter().map(|one| one.x));
    }
    let mut best: Option<Optimum> = None;
    for x in tried.into_iter().take(start.descents) {
        let found = minimise(f, kinds, bounds, &x, settings);
        let is_stopped = found.ended == constrained::Ended::Stopped;
        let is_better = |best: &Optimum| better(&found, best, kinds, settings.kept);
        if !found.values.is_empty() && best.as_ref().is_none_or(is_better) {
            best = Some(found);
        }
        if is_stopped {
            if let Some(best) = &mut best {
                best.ended = constrained::Ended::Stopped;
            }
            return Ok(best.unwrap_or_else(|| nothing(constrained::Ended::Stopped)));
        }
    }
    Ok(best.unwrap_or_else(|| nothing(constrained::Ended::NoValues)))
}

/// Whether an optimum is better: constraints kept before the value.
pub fn better(one: &Optimum, other: &Optimum, kinds: &[Kind], kept: f64) -> bool {
    let worst = |found: &Optimum| {
        let all = kinds.iter().zip(found.values.iter().skip(1));
        all.map(|(kind, value)| kind.violation(*value))
            .fold(0.0, f64::max)
    };
    let value = |found: &Optimum| found.values.first().copied().unwrap_or(f64::INFINITY);
    match (worst(one), worst(other)) {
        (own, their) if own <= kept && their <= kept => value(one) < value(other),
        (own, their) => own < their,
    }
}

#[cfg(test)]
mod tests;
