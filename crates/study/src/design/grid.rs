//! Grids: all combinations of the values of several axes.
//!
//! ```text
//! linear   x_k = a + k (b − a)/(n − 1),  k = 0 … n − 1, with x_{n−1} = b exactly
//! row      the last axis varies fastest
//! ```

use super::fault::{DesignFault, count};

/// The values of one axis.
#[derive(Debug, Clone, PartialEq)]
pub enum Axis {
    /// Evenly spaced values, both ends included.
    Linear {
        /// The first value.
        from: f64,
        /// The last value.
        to: f64,
        /// How many values.
        count: u64,
    },
    /// Values as they are listed.
    Listed(Vec<f64>),
}

impl Axis {
    /// How many values there are.
    pub fn count(&self) -> u64 {
        match self {
            Axis::Linear { count, .. } => *count,
            Axis::Listed(values) => values.len() as u64,
        }
    }

    /// Value `number`, counted from 0.
    pub fn value(&self, number: u64) -> f64 {
        match self {
            Axis::Linear { from, to, count } if number + 1 < *count => {
                from + (number as f64 * (to - from)) / (count - 1) as f64
            }
            Axis::Linear { to, .. } => *to,
            Axis::Listed(values) => values[number as usize],
        }
    }

    /// Whether the axis has values, all of them finite.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn check(&self) -> Result<(), DesignFault> {
        let ends;
        let values = match self {
            Axis::Linear { from, to, .. } => {
                ends = [*from, *to];
                &ends[..]
            }
            Axis::Listed(values) => values,
        };
        if let Some(&value) = values.iter().find(|value| !value.is_finite()) {
            return Err(DesignFault::NotFinite(value));
        }
        match self {
            Axis::Linear { count: 0, .. } => Err(DesignFault::NoValues),
            Axis::Linear { from, to, count: 1 } if from != to => Err(DesignFault::OneValue {
                from: *from,
                to: *to,
            }),
            Axis::Linear { from, to, .. } if !(to - from).is_finite() => {
                Err(DesignFault::NotFinite(to - from))
            }
            Axis::Listed(values) if values.is_empty() => Err(DesignFault::NoValues),
            Axis::Linear { .. } | Axis::Listed(_) => Ok(()),
        }
    }
}

/// All combinations of the values of several axes, the last of which varies fastest.
#[derive(Debug, Clone, PartialEq)]
pub struct Grid {
    axes: Vec<Axis>,
    rows: u64,
}

impl Grid {
    /// The grid of these axes; without axes it is one point without values.
    ///
    /// # Errors
    /// Where an axis makes no sense, or the points are too many.
    pub fn new(axes: Vec<Axis>) -> Result<Self, DesignFault> {
        axes.iter().try_for_each(Axis::check)?;
        let counts: Vec<u64> = axes.iter().map(Axis::count).collect();
        let rows = count(&counts)?;
        Ok(Grid { axes, rows })
    }

    /// How many points.
    pub fn rows(&self) -> u64 {
        self.rows
    }

    /// How many axes.
    pub fn columns(&self) -> usize {
        self.axes.len()
    }

    /// The values of point `number` to `values` (columns).
    pub fn row(&self, number: u64, values: &mut [f64]) {
        let mut rest = number;
        for (axis, value) in self.axes.iter().zip(values).rev() {
            *value = axis.value(rest % axis.count());
            rest /= axis.count();
        }
    }
}
