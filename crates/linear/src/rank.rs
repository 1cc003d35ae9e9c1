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

use thiserror::Error;

use super::pattern::Pattern;
use super::triangle::{Entry, NONE, Search, Triangle};

/// What is left of a row, over its largest entry, up to which it counts as dependent [-].
///
/// Rounding leaves 1e-16 to 1e-13 of a dependent row. Models are written with some nine digits, so what is smaller than
/// that is meant as dependent; independent rows of linkages away from dead points leave more than 1e-3.
pub const DEPENDENCE_TOLERANCE: f64 = 1e-9;

/// What is left of a row that is kept, below which it may be rounding, multiplied by weak rows before it [-]. Long chains
/// leave little more.
const DOUBTFUL: f64 = 1e-5;

/// What must be left of a row for it to be taken before others, where a first pass in order of precedence leaves doubt [-].
///
/// Of a loop near a flat position little is left of its last row, though rows behind may hold what it holds, and better.
/// Kept nevertheless, it multiplies the rounding of the rows that depend on it by the inverse of what was left, until
/// these look independent. With strong rows first, weak ones are judged by what all strong ones leave of them.
const LEVELS: [f64; 4] = [1e-2, 1e-4, 1e-6, 1e-8];

/// Pivots may be this times smaller than the largest candidate [-].
const PIVOT_THRESHOLD: f64 = 0.5;

/// Shares of a combination below this times the largest entry of the dependent row are noise [-].
const SHARE_TOLERANCE: f64 = 1e-9;

/// A matrix by rows.
#[derive(Debug, Clone)]
pub struct SparseRows {
    /// Rows of J as columns.
    transposed: Pattern,
    values: Vec<f64>,
}

/// An entry that is not finite or outside the matrix.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[error("row {row}, column {column}: entry is not finite, or outside the matrix")]
pub struct BadEntry {
    pub row: usize,
    pub column: usize,
}

/// A row that depends on rows kept.
#[derive(Debug, Clone, PartialEq)]
pub struct Dependent {
    pub row: usize,
    /// What was left of it, over its largest entry [-].
    pub ratio: f64,
    /// It is the sum of these rows times these factors, rows rising; empty when it is zero.
    pub combination: Vec<(usize, f64)>,
}

/// Verdict on all rows.
#[derive(Debug, Clone, PartialEq)]
pub struct RankReport {
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

impl SparseRows {
    /// From a dense matrix, row after row.
    ///
    /// # Errors
    /// The first entry that is not finite.
    ///
    /// # Panics
    /// When the values do not fill whole rows.
    pub fn from_dense(rows: usize, columns: usize, values: &[f64]) -> Result<Self, BadEntry> {
        assert_eq!(
            values.len(),
            rows * columns,
            "a {rows} × {columns} matrix wants {} values",
            rows * columns
        );
        let entries: Vec<(usize, usize, f64)> = values
            .iter()
            .enumerate()
            .filter(|&(_, &value)| value != 0.0)
            .map(|(at, &value)| (at / columns, at % columns, value))
            .collect();
        Self::from_triplets(rows, columns, &entries)
    }

    /// From (row, column, value) in any order; repeats add up.
    ///
    /// # Errors
    /// The first entry that is not finite or outside.
    pub fn from_triplets(
        rows: usize,
        columns: usize,
        entries: &[(usize, usize, f64)],
    ) -> Result<Self, BadEntry> {
        let outside = |&&(row, column, value): &&(usize, usize, f64)| {
            row >= rows || column >= columns || !value.is_finite()
        };
        if let Some(&(row, column, _)) = entries.iter().find(outside) {
            return Err(BadEntry { row, column });
        }
        let positions: Vec<(usize, usize)> = entries
            .iter()
            .map(|&(row, column, _)| (column, row))
            .collect();
        let (transposed, slots) =
            Pattern::from_entries(columns, rows, &positions).map_err(|_| BadEntry {
                row: rows,
                column: columns,
            })?;
        let mut values = vec![0.0; transposed.entries()];
        for (&slot, &(_, _, value)) in slots.iter().zip(entries) {
            values[slot as usize] += value;
        }
        Ok(SparseRows { transposed, values })
    }

    /// From a pattern by columns and its values.
    ///
    /// # Errors
    /// The first entry that is not finite.
    pub fn from_pattern(pattern: &Pattern, values: &[f64]) -> Result<Self, BadEntry> {
        assert_eq!(
            values.len(),
            pattern.entries(),
            "one value per entry of the pattern"
        );
        let (transposed, slots) = pattern.transposed();
        let values: Vec<f64> = slots.iter().map(|&slot| values[slot as usize]).collect();
        for row in 0..transposed.columns() {
            for at in transposed.span(row) {
                if !values[at].is_finite() {
                    let column = transposed.column(row)[at - transposed.span(row).start] as usize;
                    return Err(BadEntry { row, column });
                }
            }
        }
        Ok(SparseRows { transposed, values })
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.transposed.columns()
    }

    /// Number of columns.
    pub fn columns(&self) -> usize {
        self.transposed.rows()
    }

    /// Entries (column, value) of a row.
    pub fn row(&self, row: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let span = self.transposed.span(row);
        self.transposed
            .column(row)
            .iter()
            .map(|&column| column as usize)
            .zip(self.values[span].iter().copied())
    }
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
    let mut left: Vec<usize> = (0..rows.rows()).collect();
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
        .filter(|&column| elimination.position[column] == NONE)
        .collect();
    (elimination, report)
}

/// A direction that none of the rows forbids, largest component 1, as general as such directions are: what stands still in
/// it stands still in all of them. None where the rows determine everything.
///
/// With Jᵀ = L U and U regular, J x = 0 is Lᵀ x = 0: the free columns' components are chosen, the others follow from the
/// last pivot to the first.
pub fn free_direction(rows: &SparseRows, tolerance: f64) -> Option<Vec<f64>> {
    let (elimination, _) = decide(rows, tolerance);
    let mut coordinates = vec![0; elimination.pivot.len()];
    let mut x = vec![0.0; rows.columns()];
    for (column, &position) in elimination.position.iter().enumerate() {
        if position == NONE {
            // No two alike and none small, so that nothing cancels by chance.
            x[column] = 0.5 + 0.5 * (column as f64 + 1.0).sin().abs();
        } else {
            coordinates[position as usize] = column;
        }
    }
    for (k, &column) in coordinates.iter().enumerate().rev() {
        x[column] = -elimination
            .lower
            .column(k as u32)
            .iter()
            .map(|l| l.value * x[l.row as usize])
            .sum::<f64>();
    }
    let largest = crate::math::max_abs(&x);
    (largest > 0.0).then(|| x.iter().map(|x| x / largest).collect())
}

/// The triangular factors of the rows kept so far.
struct Elimination<'a> {
    rows: &'a SparseRows,
    /// Number of rows that use a coordinate.
    use_count: Vec<u32>,
    /// Row kept that has its pivot at a coordinate, counting rows kept.
    position: Vec<u32>,
    lower: Triangle,
    upper: Triangle,
    pivot: Vec<f64>,
    /// Largest entry of each row kept.
    scale: Vec<f64>,
    /// Row being eliminated, by coordinates; zero between rows.
    work: Vec<f64>,
    search: Search,
    /// Number of eliminations, of which a row may take several.
    searches: u32,
}

impl<'a> Elimination<'a> {
    fn new(rows: &'a SparseRows) -> Self {
        let n = rows.columns();
        let mut use_count = vec![0; n];
        for row in 0..rows.rows() {
            for &coordinate in rows.transposed.column(row) {
                use_count[coordinate as usize] += 1;
            }
        }
        Elimination {
            rows,
            use_count,
            position: vec![NONE; n],
            lower: Triangle::new(),
            upper: Triangle::new(),
            pivot: Vec::new(),
            scale: Vec::new(),
            work: vec![0.0; n],
            search: Search::new(n),
            searches: 0,
        }
    }

    fn row_scale(&self, row: usize) -> f64 {
        self.rows.values[self.rows.transposed.span(row)]
            .iter()
            .fold(0.0, |m, value| m.max(value.abs()))
    }

    /// Subtracts the rows kept; gives the largest entry left over the largest there was.
    fn eliminate(&mut self, row: usize) -> f64 {
        let coordinates = self.rows.transposed.column(row);
        self.search
            .find(self.searches, coordinates, &self.position, &self.lower);
        self.searches += 1;
        let x = &mut self.work;
        for (&coordinate, &value) in coordinates
            .iter()
            .zip(&self.rows.values[self.rows.transposed.span(row)])
        {
            x[coordinate as usize] = value;
        }
        let mut left = 0.0f64;
        for &coordinate in self.search.reach().iter().rev() {
            let k = self.position[coordinate as usize];
            if k == NONE {
                continue;
            }
            let u = std::mem::take(&mut x[coordinate as usize]);
            self.upper.entries.push(Entry { row: k, value: u });
            for l in self.lower.column(k) {
                x[l.row as usize] -= l.value * u;
            }
        }
        for &coordinate in self.search.reach() {
            left = left.max(x[coordinate as usize].abs());
        }
        let scale = self.row_scale(row);
        self.scale.push(scale);
        if scale == 0.0 { 0.0 } else { left / scale }
    }

    /// Makes what is left a column of L.
    fn keep(&mut self) {
        let free = || {
            self.search
                .reach()
                .iter()
                .filter(|&&c| self.position[c as usize] == NONE)
        };
        let largest = free().fold(0.0f64, |m, &c| m.max(self.work[c as usize].abs()));
        let chosen = free()
            .filter(|&&c| self.work[c as usize].abs() >= PIVOT_THRESHOLD * largest)
            .min_by_key(|&&c| (self.use_count[c as usize], c));
        let Some(&chosen) = chosen else { return };
        let pivot = std::mem::take(&mut self.work[chosen as usize]);
        self.position[chosen as usize] = self.pivot.len() as u32;
        self.pivot.push(pivot);
        for &coordinate in self.search.reach() {
            let value = std::mem::take(&mut self.work[coordinate as usize]);
            // What cancelled exactly leads nowhere.
            if value != 0.0 {
                self.lower.entries.push(Entry {
                    row: coordinate,
                    value: value / pivot,
                });
            }
        }
        self.lower.close_column();
        self.upper.close_column();
    }

    /// Solves U c = u for the row just eliminated.
    fn combination(&self, row: usize, kept: &[usize]) -> Vec<(usize, f64)> {
        let mut c = vec![0.0; self.pivot.len()];
        for entry in &self.upper.entries[self.open_column()..] {
            c[entry.row as usize] = entry.value;
        }
        for k in (0..c.len()).rev() {
            let factor = c[k] / self.pivot[k];
            c[k] = factor;
            if factor != 0.0 {
                for u in self.upper.column(k as u32) {
                    c[u.row as usize] -= u.value * factor;
                }
            }
        }
        let noise = SHARE_TOLERANCE * self.row_scale(row);
        let counts = |&k: &usize| (c[k] * self.scale[k]).abs() > noise;
        let mut shares: Vec<(usize, f64)> = (0..c.len())
            .filter(counts)
            .map(|k| (kept[k], c[k]))
            .collect();
        shares.sort_unstable_by_key(|&(row, _)| row);
        shares
    }

    /// Forgets the row just eliminated.
    fn drop_row(&mut self) {
        for &coordinate in self.search.reach() {
            self.work[coordinate as usize] = 0.0;
        }
        let end = self.open_column();
        self.upper.entries.truncate(end);
        self.scale.pop();
    }

    /// Where the entries of U that belong to no row kept begin.
    fn open_column(&self) -> usize {
        self.upper.start.last().map_or(0, |&end| end as usize)
    }
}

#[cfg(test)]
mod tests;
