//! Least squares within bounds.
//!
//! ```text
//! minimise  ½|r(x)|²                       lower ≤ x ≤ upper
//! step      min |(J; √λ D) p + (r; 0)|     D = largest length so far of each column of J
//! ```
//!
//! The method of Levenberg and Marquardt with the scales of Moré (The Levenberg-Marquardt algorithm, 1978) and the damping of Nielsen
//! (Damping parameter in Marquardt's method, 1999). A variable at a bound that the step would cross stays there, and the others are
//! solved for again. A step to where there are no residuals is refused as one that makes them worse, and the next is shorter.

use crate::differences::{Underived, jacobian};
use crate::outcome::{Bounds, End, Function, Outcome};
use linkdyn_linear::dense::{Dense, least_norm_solve};

/// When it ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Residuals below this are as good as zero.
    pub enough: f64,
    /// Steps at most, refused ones included.
    pub most_steps: usize,
    /// After so many steps, give up where |r| is not below `hopeful`.
    pub trial: usize,
    /// |r| with which it goes on after `trial` steps.
    pub hopeful: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Settings {
            enough: 1e-13,
            most_steps: 200,
            trial: usize::MAX,
            hopeful: f64::INFINITY,
        }
    }
}

/// How a search ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ended {
    /// No residual is left.
    Solved,
    /// No step makes it better: a minimum to the accuracy of the derivatives.
    Minimum,
    /// Steps are used up.
    Steps,
    /// Given up after the trial.
    Hopeless,
    /// There are no values at the start, or none around a point.
    NoValues,
    /// Whoever asked wants no more.
    Stopped,
}

/// What was found.
#[derive(Debug, Clone, PartialEq)]
pub struct Fitted {
    /// The variables.
    pub x: Vec<f64>,
    /// The residuals there; `None` if it never had any.
    pub residuals: Vec<f64>,
    /// How it ended.
    pub ended: Ended,
    /// Length of Jᵀr of the variables that are free, by |r| and the lengths of the columns.
    pub slope: f64,
}

/// Relative gain that is round-off.
const ROUND_OFF: f64 = 1e-15;
/// A step below this part of the ranges moves nothing.
const SMALLEST_STEP: f64 = 1e-14;
/// First damping, by the squares of the scales.
const FIRST_DAMPING: f64 = 1e-3;
/// Singular values below this part of the largest say nothing.
const RANK: f64 = 1e-14;
/// The cosine between r and a column of J below which it counts as stationary.
const STATIONARY: f64 = 1e-10;

struct State {
    x: Vec<f64>,
    residuals: Vec<f64>,
    cost: f64,
    jacobian: Vec<f64>,
    scales: Vec<f64>,
}

/// Half the sum of squares.
fn cost(residuals: &[f64]) -> f64 {
    0.5 * residuals.iter().map(|r| r * r).sum::<f64>()
}

/// Searches from `start`.
pub fn least_squares(
    f: &mut Function,
    bounds: &Bounds,
    start: &[f64],
    settings: &Settings,
) -> Fitted {
    let mut x = start.to_vec();
    bounds.clamp(&mut x);
    let mut fitted = Fitted {
        x: x.clone(),
        residuals: Vec::new(),
        ended: Ended::NoValues,
        slope: f64::INFINITY,
    };
    let residuals = match f.values(&x) {
        Outcome::Values(values) => values,
        Outcome::Missing => return fitted,
        Outcome::Stopped => {
            fitted.ended = Ended::Stopped;
            return fitted;
        }
    };
    let mut state = State {
        cost: cost(&residuals),
        scales: vec![0.0; x.len()],
        jacobian: Vec::new(),
        x,
        residuals,
    };
    fitted.ended = state.search(f, bounds, settings);
    fitted.slope = state.slope(bounds);
    fitted.x = state.x;
    fitted.residuals = state.residuals;
    fitted
}

impl State {
    fn search(&mut self, f: &mut Function, bounds: &Bounds, settings: &Settings) -> Ended {
        let (mut damping, mut growth) = (FIRST_DAMPING, 2.0);
        let mut is_new = true;
        for step in 0..settings.most_steps {
            let worst = self
                .residuals
                .iter()
                .fold(0.0_f64, |most, r| most.max(r.abs()));
            if worst <= settings.enough {
                return Ended::Solved;
            }
            if step == settings.trial && (2.0 * self.cost).sqrt() > settings.hopeful {
                return Ended::Hopeless;
            }
            if is_new {
                match jacobian(f, bounds, &self.x, &self.residuals) {
                    Ok(found) => self.take(found),
                    Err(Underived::NoValues) => return Ended::NoValues,
                    Err(Underived::Stopped) => return Ended::Stopped,
                }
                if self.slope(bounds) <= STATIONARY {
                    return Ended::Minimum;
                }
            }
            let Some(p) = self.step(bounds, damping) else {
                return Ended::Minimum;
            };
            let length = (0..p.len())
                .map(|k| (p[k] / bounds.width(k)).abs())
                .fold(0.0, f64::max);
            let gain = self.cost - self.predicted(&p);
            if length <= SMALLEST_STEP || gain <= ROUND_OFF * self.cost {
                return Ended::Minimum;
            }
            let mut to: Vec<f64> = self.x.iter().zip(&p).map(|(x, p)| x + p).collect();
            bounds.clamp(&mut to);
            is_new = false;
            let ratio = match f.values(&to) {
                Outcome::Stopped => return Ended::Stopped,
                Outcome::Missing => -1.0,
                Outcome::Values(residuals) => {
                    let after = cost(&residuals);
                    let ratio = (self.cost - after) / gain;
                    if after < self.cost {
                        (self.x, self.residuals, self.cost) = (to, residuals, after);
                        is_new = true;
                    }
                    ratio
                }
            };
            if is_new {
                damping *= (1.0 - (2.0 * ratio - 1.0).powi(3)).max(1.0 / 3.0);
                growth = 2.0;
            } else {
                damping *= growth;
                growth *= 2.0;
            }
            if damping > 1e12 {
                return Ended::Minimum;
            }
        }
        Ended::Steps
    }

    fn take(&mut self, jacobian: Vec<f64>) {
        let columns = self.x.len();
        for (k, scale) in self.scales.iter_mut().enumerate() {
            let column = jacobian.iter().skip(k).step_by(columns);
            *scale = scale.max(column.map(|entry| entry * entry).sum::<f64>().sqrt());
        }
        self.jacobian = jacobian;
    }

    /// Jᵀr.
    fn gradient(&self) -> Vec<f64> {
        let columns = self.x.len();
        let mut gradient = vec![0.0; columns];
        for (row, r) in self.jacobian.chunks_exact(columns).zip(&self.residuals) {
            gradient
                .iter_mut()
                .zip(row)
                .for_each(|(sum, entry)| *sum += entry * r);
        }
        gradient
    }

    /// Whether a variable stays at its bound.
    fn held(&self, bounds: &Bounds, k: usize, slope: f64) -> bool {
        match bounds.end(k, self.x[k]) {
            Some(End::Lower) => slope >= 0.0,
            Some(End::Upper) => slope <= 0.0,
            None => false,
        }
    }

    /// Largest cosine between r and a column of J whose variable is free.
    fn slope(&self, bounds: &Bounds) -> f64 {
        if self.jacobian.is_empty() {
            return f64::INFINITY;
        }
        let size = (2.0 * self.cost).sqrt();
        let all = self.gradient().into_iter().enumerate();
        let free = all.filter(|(k, slope)| !self.held(bounds, *k, *slope) && self.scales[*k] > 0.0);
        free.map(|(k, slope)| slope.abs() / (self.scales[k] * size))
            .fold(0.0, f64::max)
    }

    /// ½|r + J p|².
    fn predicted(&self, p: &[f64]) -> f64 {
        let rows = self.jacobian.chunks_exact(p.len()).zip(&self.residuals);
        let squares = rows.map(|(row, r)| {
            let moved = r + row.iter().zip(p).map(|(entry, p)| entry * p).sum::<f64>();
            moved * moved
        });
        0.5 * squares.sum::<f64>()
    }

    /// The damped step within the bounds; `None` if nothing is free.
    fn step(&self, bounds: &Bounds, damping: f64) -> Option<Vec<f64>> {
        let columns = self.x.len();
        let gradient = self.gradient();
        // What each variable moves where that is given.
        let mut given: Vec<Option<f64>> = (0..columns)
            .map(|k| (self.held(bounds, k, gradient[k]) || self.scales[k] == 0.0).then_some(0.0))
            .collect();
        loop {
            let free: Vec<usize> = (0..columns).filter(|k| given[*k].is_none()).collect();
            if free.is_empty() {
                let p: Vec<f64> = given.iter().map(|p| p.unwrap_or(0.0)).collect();
                return p.iter().any(|p| *p != 0.0).then_some(p);
            }
            let solved = self.solve(&free, &given, damping)?;
            let mut p: Vec<f64> = given.iter().map(|p| p.unwrap_or(0.0)).collect();
            for (k, moved) in free.iter().zip(&solved) {
                p[*k] = *moved;
            }
            let mut crossed = false;
            for &k in &free {
                let [lower, upper] = bounds.of(k);
                let to = self.x[k] + p[k];
                if to < lower || to > upper {
                    given[k] = Some(to.clamp(lower, upper) - self.x[k]);
                    crossed = true;
                }
            }
            if !crossed {
                return Some(p);
            }
        }
    }

    /// The free variables, where others move as given.
    fn solve(&self, free: &[usize], given: &[Option<f64>], damping: f64) -> Option<Vec<f64>> {
        let columns = self.x.len();
        let rows = self.residuals.len();
        let mut matrix = Vec::with_capacity((rows + free.len()) * free.len());
        let mut right = Vec::with_capacity(rows + free.len());
        // Unknowns are in units of the scales, so that small singular values mean what they say.
        for (row, r) in self.jacobian.chunks_exact(columns).zip(&self.residuals) {
            matrix.extend(free.iter().map(|&k| row[k] / self.scales[k]));
            let moved: f64 = row
                .iter()
                .zip(given)
                .map(|(entry, p)| entry * p.unwrap_or(0.0))
                .sum();
            right.push(-r - moved);
        }
        for index in 0..free.len() {
            matrix.extend(
                (0..free.len()).map(|other| if other == index { damping.sqrt() } else { 0.0 }),
            );
            right.push(0.0);
        }
        let dense = Dense::new(rows + free.len(), free.len(), matrix);
        let solved = least_norm_solve(&dense, &right, RANK).ok()?.x;
        Some(
            free.iter()
                .zip(solved)
                .map(|(&k, z)| z / self.scales[k])
                .collect(),
        )
    }
}

#[cfg(test)]
mod tests;
