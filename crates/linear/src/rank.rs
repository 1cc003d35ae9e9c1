//! Which rows of a matrix depend on earlier ones, and how.
//!
//! ```text
//! J (m × n)          rows = constraints, in order of precedence; columns = coordinates
//! Jᵀ kept = L U      L (n × rank) unit lower trapezoidal, U (rank × rank) upper triangular
//! row i dependent    largest entry left of row i after elimination ≤ tolerance · its largest entry
//! row i = Σ cₖ row k over the rows kept, from U c = u(i)
//! ```
//!
//! Rows are taken one by one and eliminated by those kept before, left-looking as in [`super::lu`], so that the
//! earliest rows stay and a culprit is the later of two that quarrel. Among coordinates with at least half the largest
//! entry left, the one that fewest rows use becomes the pivot: that keeps L as sparse as the linkage and its entries at
//! most 2. Where that leaves doubt, because little was left of a row that was kept, strong rows are taken first. Time and memory follow the sparsity, a chain of a thousand bodies takes about a millisecond, so one method
//! serves all sizes. Checked against singular values on random linkages.
//!
//! The verdict depends on units: scale lengths by that of the mechanism first.

mod elimination;
mod rows;

pub use rows::{BadEntry, SparseRows};

use elimination::Elimination;

/// What is left of a row, over its largest entry, up to which it counts as dependent [-].
///
/// Rounding leaves 1e-16 to 1e-13 of a dependent row. Models are written with some nine digits, so what is smaller than
/// that is meant as dependent; independent rows of linkages away from dead points leave more than 1e-3.
pub const DEPENDENCE_TOLERANCE: f64 = 1e-9;

/// What is left of a row that is kept, below which it may be rounding, multiplied by weak rows before it [-]. Long chains
/// leave little more.
const DOUBTFUL: f64 = 1e-5;

/// Coordinates from which on open ends are looked for: rows of a chain fill with the square of its length. Of fewer there is
/// nothing to gain.
const LARGE: usize = 1000;

/// What must be left of a row for it to be taken before others, where a first pass in order of precedence leaves doubt [-].
///
/// Of a loop near a flat position little is left of its last row, though rows behind may hold what it holds, and better.
/// Kept nevertheless, it multiplies the rounding of the rows that depend on it by the inverse of what was left, until
/// these look independent. With strong rows first, weak ones are judged by what all strong ones leave of them.
const LEVELS: [f64; 4] = [1e-2, 1e-4, 1e-6, 1e-8];

/// A row that depends on rows kept.
#[derive(Debug, Clone, PartialEq)]
pub struct Dependent {
    /// The row.
    pub row: usize,
    /// What was left of it, over its largest entry [-].
    pub ratio: f64,
    /// It is the sum of these rows times these factors, rows rising; empty when it is zero.
    pub combination: Vec<(usize, f64)>,
}

/// Verdict on all rows.
#[derive(Debug, Clone, PartialEq)]
pub struct RankReport {
    /// Number of rows kept.
    pub rank: usize,
    /// Rows kept, rising.
    pub independent: Vec<usize>,
    /// Columns that no row kept has its pivot in: with these given, the rows kept determine the others.
    pub free_columns: Vec<usize>,
    /// Rows dropped, rising.
    pub dependent: Vec<Dependent>,
    /// Smallest ratio among rows kept: near the tolerance the verdict is doubtful. Infinite when none was kept.
    pub smallest_kept: f64,
    /// Largest ratio among rows dropped. Zero when none was dropped.
    pub largest_dropped: f64,
}

impl RankReport {
    /// Rows that depend on each other: those dropped, and those that they are combinations of.
    pub fn dependent_rows(&self) -> Vec<usize> {
        let together = |dependent: &Dependent| {
            let kept = dependent.combination.iter().map(|(row, _)| *row);
            kept.chain([dependent.row]).collect::<Vec<_>>()
        };
        self.dependent.iter().flat_map(together).collect()
    }
}

/// Keeps each row that is independent of the rows kept before it, and tells how the others depend on those.
///
/// # Examples
/// ```
/// use linkdyn_linear::rank::{DEPENDENCE_TOLERANCE, SparseRows, independent_rows};
/// let rows = SparseRows::from_dense(3, 2, &[1.0, 1.0, 2.0, 2.0, 0.0, 1.0])?;
/// let report = independent_rows(&rows, DEPENDENCE_TOLERANCE);
/// assert_eq!(report.independent, [0, 2]);
/// assert_eq!(report.dependent[0].combination, [(0, 2.0)]);
/// # Ok::<(), linkdyn_linear::rank::BadEntry>(())
/// ```
pub fn independent_rows(rows: &SparseRows, tolerance: f64) -> RankReport {
    decide(rows, tolerance).1
}

/// The verdict, and the elimination that leads to it.
fn decide(rows: &SparseRows, tolerance: f64) -> (Elimination<'_>, RankReport) {
    let first = keep_by_levels(rows, &[tolerance]);
    if first.1.smallest_kept > DOUBTFUL {
        return first;
    }
    let levels: Vec<f64> = LEVELS
        .into_iter()
        .filter(|level| *level > tolerance)
        .chain([tolerance])
        .collect();
    let certain = keep_by_levels(rows, &levels);
    // Where both agree, the earliest rows stay.
    if certain.1.rank == first.1.rank {
        first
    } else {
        certain
    }
}

/// Keeps, level by level, the rows of which more than that is left.
fn keep_by_levels<'a>(rows: &'a SparseRows, levels: &[f64]) -> (Elimination<'a>, RankReport) {
    let mut elimination = Elimination::new(rows);
    let mut report = RankReport {
        rank: 0,
        independent: Vec::new(),
        free_columns: Vec::new(),
        dependent: Vec::new(),
        smallest_kept: f64::INFINITY,
        largest_dropped: 0.0,
    };
    // In the order of the elimination.
    let mut kept = Vec::new();
    let mut is_kept = vec![false; rows.rows()];
    if rows.columns() >= LARGE {
        for (row, coordinate) in elimination.open_ends() {
            report.smallest_kept = report.smallest_kept.min(elimination.eliminate(row));
            elimination.keep_at(coordinate);
            kept.push(row);
            is_kept[row] = true;
        }
    }
    let mut left: Vec<usize> = (0..rows.rows()).filter(|row| !is_kept[*row]).collect();
    for (k, &level) in levels.iter().enumerate() {
        let last = k + 1 == levels.len();
        left.retain(|&row| {
            let ratio = elimination.eliminate(row);
            if ratio > level {
                elimination.keep();
                kept.push(row);
                report.smallest_kept = report.smallest_kept.min(ratio);
                return false;
            }
            if last {
                let combination = elimination.combination(row, &kept);
                report.dependent.push(Dependent {
                    row,
                    ratio,
                    combination,
                });
                report.largest_dropped = report.largest_dropped.max(ratio);
            }
            elimination.drop_row();
            true
        });
    }
    report.rank = kept.len();
    kept.sort_unstable();
    report.independent = kept;
    report.free_columns = (0..rows.columns())
        .filter(|&column| elimination.is_free(column))
        .collect();
    (elimination, report)
}

/// The direction that the rows leave, largest component 1, where they leave one alone.
///
/// # Errors
/// How many there are.
pub fn only_direction(rows: &SparseRows, tolerance: f64) -> Result<Vec<f64>, usize> {
    let (elimination, report) = decide(rows, tolerance);
    match rows.columns() - report.rank {
        1 => {
            let x = elimination.null_vector();
            let largest = crate::math::max_abs(&x);
            Ok(x.iter().map(|x| x / largest).collect())
        }
        left => Err(left),
    }
}

/// A direction that none of the rows forbids, largest component 1, as general as such directions are: what stands still in
/// it stands still in all of them. `None` if the rows determine everything.
pub fn free_direction(rows: &SparseRows, tolerance: f64) -> Option<Vec<f64>> {
    let (elimination, _) = decide(rows, tolerance);
    let x = elimination.null_vector();
    let largest = crate::math::max_abs(&x);
    (largest > 0.0).then(|| x.iter().map(|x| x / largest).collect())
}

#[cfg(test)]
mod tests;
