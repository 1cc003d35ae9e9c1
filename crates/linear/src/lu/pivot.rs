//! Which pivots are good enough.

/// A pivot smaller than this times the largest entry of its column and of its row (whichever is smaller) means singular
/// [-].
///
/// Eliminating dependent columns leaves rounding of some n·1e-16 of those entries, below 1e-14 on doubled pins and
/// aligned links; regular linkages measured 0.01 to 1, and 1e-4 with masses eight decades apart. Judging by column and
/// row alike, neither heavy bodies nor rows in small units raise a false alarm; only a column and a row that are both
/// tiny do.
pub const SINGULAR_RATIO: f64 = 1e-13;

/// A preferred pivot is taken when it is at least this times the largest candidate [-].
///
/// Bounds each entry of L by 10. KLU's 1e-3 keeps more sparsity but lost 12 of 16 digits on grids of linkages.
pub const PIVOT_THRESHOLD: f64 = 0.1;

/// Kept pivots are given up when an entry of L grows beyond this [-].
///
/// At most about six of sixteen digits are lost then; a new choice of pivots costs some ten refactorisations, and a
/// mechanism meets such configurations a few times per turn.
pub const GROWTH_LIMIT: f64 = 1e6;

/// Bits of the absolute value: ordered like it, and above infinity for NaN, so that a maximum never loses one.
pub(super) fn magnitude(value: f64) -> u64 {
    value.to_bits() & (u64::MAX >> 1)
}
