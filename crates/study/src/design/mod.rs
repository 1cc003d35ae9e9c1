//! The list of variants: a pure function of (design, seed), any row by its number.
//!
//! ```text
//! variants      grid points × samples; the samples vary fastest
//! a row         the values of the grid, then one value x = F⁻¹(u) per distribution
//! ```
//!
//! Rows need no state and no order, so that any machine can compute any chunk of them. Fixed forever: tests hold the digits.

mod fault;
mod grid;
mod latin;
mod samples;
mod sobol;

pub use fault::{DesignFault, MOST_COLUMNS, MOST_ROWS};
pub use grid::{Axis, Grid};
pub use samples::{Layout, Method, Samples};

use crate::distribution::Distribution;
use fault::count;

/// Variants: a grid, samples, or samples at each point of a grid.
#[derive(Debug, Clone)]
pub struct Design {
    grid: Grid,
    samples: Option<(Samples, Vec<Distribution>)>,
}

impl Design {
    /// The points of a grid.
    pub fn of_grid(grid: Grid) -> Self {
        Design {
            grid,
            samples: None,
        }
    }

    /// Samples of distributions at each point of a grid; a grid without axes is one point.
    ///
    /// # Errors
    /// Where they do not fit, or there would be too many.
    pub fn of_samples(
        grid: Grid,
        samples: Samples,
        distributions: Vec<Distribution>,
    ) -> Result<Self, DesignFault> {
        if samples.columns() != distributions.len() {
            return Err(DesignFault::Mismatch {
                samples: samples.columns(),
                distributions: distributions.len(),
            });
        }
        count(&[grid.rows(), samples.rows()])?;
        Ok(Design {
            grid,
            samples: Some((samples, distributions)),
        })
    }

    /// How many variants there are.
    pub fn rows(&self) -> u64 {
        self.grid.rows() * self.samples_per_point()
    }

    fn samples_per_point(&self) -> u64 {
        self.samples
            .as_ref()
            .map_or(1, |(samples, _)| samples.rows())
    }

    /// How many values a variant has: first those of the grid, then those of the samples.
    pub fn columns(&self) -> usize {
        self.grid.columns() + self.samples.as_ref().map_or(0, |(_, all)| all.len())
    }

    /// The values of variant `number`, counted from 0, to `values` (columns).
    pub fn row(&self, number: u64, values: &mut [f64]) {
        let per_point = self.samples_per_point();
        let (varied, sampled) = values.split_at_mut(self.grid.columns());
        self.grid.row(number / per_point, varied);
        if let Some((samples, distributions)) = &self.samples {
            samples.row(number % per_point, sampled);
            for (value, distribution) in sampled.iter_mut().zip(distributions) {
                *value = distribution.quantile(*value);
            }
        }
    }
}

#[cfg(test)]
mod tests;
