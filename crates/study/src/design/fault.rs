//! What can be wrong with a list of variants.

use thiserror::Error;

/// Variants at most: their numbers are exact as doubles.
pub const MOST_ROWS: u64 = 1 << 52;

/// Columns that Sobol points have at most.
pub const MOST_COLUMNS: usize = 256;

/// Why a list of variants can't be made.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum DesignFault {
    /// An axis without values.
    #[error("0 values: give at least 1")]
    NoValues,
    /// A value or an end of an axis that is not finite.
    #[error("{0:?}: values must be finite")]
    NotFinite(f64),
    /// One value between two ends.
    #[error("1 value from {from:?} to {to:?}: give at least 2 values, or the same ends")]
    OneValue {
        /// The first end.
        from: f64,
        /// The other end.
        to: f64,
    },
    /// No samples.
    #[error("0 samples: give at least 1")]
    NoSamples,
    /// Samples of nothing.
    #[error("samples of nothing: no value has a tolerance or a range")]
    NoColumns,
    /// More variants than are counted.
    #[error("more than {MOST_ROWS} variants (2^52): give fewer values or samples")]
    TooMany,
    /// More values than Sobol points have.
    #[error(
        "Sobol points for {needed} values: there are at most {MOST_COLUMNS}, and indices need two for each value"
    )]
    TooManyColumns {
        /// How many would be needed.
        needed: usize,
    },
    /// Samples for another number of values than there are distributions.
    #[error("samples of {samples} values for {distributions} distributions")]
    Mismatch {
        /// Values of the samples.
        samples: usize,
        /// Distributions.
        distributions: usize,
    },
}

/// The product of counts, as far as variants are counted.
pub(super) fn count(factors: &[u64]) -> Result<u64, DesignFault> {
    factors
        .iter()
        .try_fold(1_u64, |product, &factor| product.checked_mul(factor))
        .filter(|&product| product <= MOST_ROWS)
        .ok_or(DesignFault::TooMany)
}
