//! Samples of the unit cube, any of them by its number.
//!
//! ```text
//! Monte Carlo      u_ij = word i d + j of Philox: numpy.random.Generator(Philox(key=[seed, 0])).random((n, d))
//! Latin hypercube  u_ij = (π_j(i) + v_ij)/n: in each column each of n strata once
//! Sobol            see `sobol`
//! Saltelli         of each point (a, b) of 2d columns d + 2 rows: a;  a with a_k from b, k = 1 … d;  b
//! ```
//!
//! Sources: McKay, Beckman, Conover, A comparison of three methods, Technometrics 21, 1979; Saltelli and others, Variance based sensitivity
//! analysis of model output, Comput. Phys. Commun. 181, 2010.

use serde::{Deserialize, Serialize};

use super::fault::{DesignFault, count};
use super::latin::Permutation;
use super::sobol::Sobol;
use crate::random::{Philox, Purpose, uniform};

/// How samples fill the unit cube.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// Independent of each other.
    MonteCarlo,
    /// Each of n strata once in each column.
    LatinHypercube,
    /// Points of a Sobol sequence.
    Sobol {
        /// Whether a seed scrambles them.
        scrambled: bool,
    },
}

/// What rows are made of a point.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Layout {
    /// One.
    Plain,
    /// Those that the estimators of Sobol indices need: columns + 2.
    Saltelli,
}

#[derive(Debug, Clone)]
enum Points {
    MonteCarlo(Philox),
    LatinHypercube {
        orders: Vec<Permutation>,
        places: Philox,
    },
    Sobol(Sobol),
}

/// Samples of the unit cube.
#[derive(Debug, Clone)]
pub struct Samples {
    points: Points,
    layout: Layout,
    count: u64,
    columns: usize,
}

impl Samples {
    /// So many points with so many columns.
    ///
    /// # Errors
    /// Where there are none, or more than are counted or have direction numbers.
    pub fn new(
        method: Method,
        layout: Layout,
        points: u64,
        columns: usize,
        seed: u64,
    ) -> Result<Self, DesignFault> {
        if points == 0 {
            return Err(DesignFault::NoSamples);
        }
        if columns == 0 {
            return Err(DesignFault::NoColumns);
        }
        let (rows, width) = match layout {
            Layout::Plain => (1, columns),
            Layout::Saltelli => (columns as u64 + 2, 2 * columns),
        };
        count(&[points, rows])?;
        let all = match method {
            Method::MonteCarlo => Points::MonteCarlo(Philox::of(seed, Purpose::MonteCarlo)),
            Method::LatinHypercube => Points::LatinHypercube {
                orders: (0..width)
                    .map(|column| Permutation::new(points, seed, column as u64))
                    .collect(),
                places: Philox::of(seed, Purpose::LatinPlace),
            },
            Method::Sobol { scrambled } => {
                Points::Sobol(Sobol::new(width, scrambled.then_some(seed))?)
            }
        };
        Ok(Samples {
            points: all,
            layout,
            count: points,
            columns,
        })
    }

    /// How many rows there are.
    pub fn rows(&self) -> u64 {
        self.count * self.rows_per_point()
    }

    /// How many rows each point has, which follow one another.
    pub fn rows_per_point(&self) -> u64 {
        match self.layout {
            Layout::Plain => 1,
            Layout::Saltelli => self.columns as u64 + 2,
        }
    }

    /// How many values a row has.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// The numbers in \[0, 1) of row `number`, counted from 0, to `values` (columns).
    pub fn row(&self, number: u64, values: &mut [f64]) {
        let point = number / self.rows_per_point();
        let part = (number % self.rows_per_point()) as usize;
        for (column, value) in values.iter_mut().enumerate() {
            let is_of_b = part == column + 1 || part == self.columns + 1;
            let place = if is_of_b {
                column + self.columns
            } else {
                column
            };
            *value = self.value(point, place);
        }
    }

    /// Coordinate `column` of a point.
    fn value(&self, point: u64, column: usize) -> f64 {
        let width = match self.layout {
            Layout::Plain => self.columns,
            Layout::Saltelli => 2 * self.columns,
        };
        let number = u128::from(point) * width as u128 + column as u128;
        match &self.points {
            Points::MonteCarlo(philox) => uniform(philox.word(number)),
            Points::LatinHypercube { orders, places } => {
                stratum(orders[column].of(point), places.word(number), self.count)
            }
            Points::Sobol(sobol) => sobol.value(point, column),
        }
    }
}

/// A number in stratum `place` of `count`, by a word.
fn stratum(place: u64, word: u64, count: u64) -> f64 {
    // So few digits within the stratum that neither sum nor quotient is rounded out of it.
    let digits = 50_u32.saturating_sub(u64::BITS - count.leading_zeros());
    let within = ((word >> 12 >> (52 - digits)) as f64 + 0.5) / (1_u64 << digits) as f64;
    (place as f64 + within) / count as f64
}
