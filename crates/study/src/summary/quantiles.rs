//! Quantiles, exact for some time and then within a stated error.
//!
//! ```text
//! up to a limit    all values are kept: linear between the two order statistics about (n − 1) p (type 7, as numpy)
//! beyond           counts in cells [k 2^e, (k + 1) 2^e),  e the least with at most 2^18 cells from the least to the largest value
//! error            one cell, which is at most (max − min)/2^16.9
//! ```
//!
//! Cells begin at whole multiples of their width, and two of them make one of the next width. So what is kept is a function of the set of
//! values, of no order and no split, and takes 4 MB. A sketch of relative ranks, as t-digest or KLL, has no such bound at 0.135 %.

use super::histogram::{Bins, Histogram};

/// Values that are kept as they are, unless another limit is requested: 8 MB.
pub const EXACT: usize = 1_000_000;

/// Cells that hold values, at most.
const CELLS: usize = 1 << 18;
/// Cells in memory: as many again, so that a range that grows seldom moves them.
const ROOM: usize = 2 * CELLS;
/// Widths of cells, as powers of two.
const FINEST: i32 = -1000;
const COARSEST: i32 = 1020;

/// A set of finite values, as far as its quantiles need it.
#[derive(Debug, Clone)]
pub struct Quantiles {
    limit: usize,
    kept: Kept,
}

#[derive(Debug, Clone)]
enum Kept {
    Values(Vec<f64>),
    Cells(Cells),
}

impl Default for Quantiles {
    fn default() -> Self {
        Quantiles::new(EXACT)
    }
}

impl Quantiles {
    /// Exact up to so many values.
    pub fn new(limit: usize) -> Self {
        Quantiles {
            limit,
            kept: Kept::Values(Vec::new()),
        }
    }

    /// Takes a finite value.
    pub fn push(&mut self, x: f64) {
        match &mut self.kept {
            Kept::Values(values) if values.len() < self.limit => values.push(x),
            Kept::Values(_) => self.cells().add(x),
            Kept::Cells(cells) => cells.add(x),
        }
    }

    /// Takes the values of another part.
    pub fn merge(&mut self, other: &Quantiles) {
        match &other.kept {
            Kept::Values(values) => values.iter().for_each(|&x| self.push(x)),
            Kept::Cells(cells) => self.cells().merge(cells),
        }
    }

    /// The cells, into which the values go that were kept.
    fn cells(&mut self) -> &mut Cells {
        if let Kept::Values(values) = &self.kept {
            let mut cells = Cells::new();
            values.iter().for_each(|&x| cells.add(x));
            self.kept = Kept::Cells(cells);
        }
        match &mut self.kept {
            Kept::Cells(cells) => cells,
            Kept::Values(_) => unreachable!("they have just gone into cells"),
        }
    }

    /// How many values.
    pub fn count(&self) -> u64 {
        match &self.kept {
            Kept::Values(values) => values.len() as u64,
            Kept::Cells(cells) => cells.total,
        }
    }

    /// How far quantiles may be off; 0 while they are exact.
    pub fn error(&self) -> f64 {
        match &self.kept {
            Kept::Values(_) => 0.0,
            Kept::Cells(cells) => cells.width(),
        }
    }

    /// The values that the shares `p` in \[0, 1\] are below; none without values.
    pub fn at(&self, p: &[f64]) -> Option<Vec<f64>> {
        let last = self.count().checked_sub(1)?;
        let mut sorted = Vec::new();
        if let Kept::Values(values) = &self.kept {
            sorted.clone_from(values);
            sorted.sort_unstable_by(f64::total_cmp);
        }
        let order = |rank: u64| match &self.kept {
            Kept::Values(_) => sorted[rank as usize],
            Kept::Cells(cells) => cells.order(rank),
        };
        let quantile = |p: &f64| {
            let place = p * last as f64;
            let rank = (place as u64).min(last);
            let (low, part) = (order(rank), place - rank as f64);
            if part == 0.0 {
                return low;
            }
            low * (1.0 - part) + order((rank + 1).min(last)) * part
        };
        Some(p.iter().map(quantile).collect())
    }

    /// A histogram from the least to the largest value; none without values.
    pub fn histogram(&self, bins: Bins) -> Option<Histogram> {
        let ends = self.at(&[0.0, 0.25, 0.75, 1.0])?;
        let mut histogram = Histogram::new([ends[0], ends[3]], bins.count(self.count(), &ends));
        match &self.kept {
            Kept::Values(values) => values.iter().for_each(|&x| histogram.add(x, 1)),
            Kept::Cells(cells) => {
                for (number, &count) in cells.counts.iter().enumerate().filter(|cell| *cell.1 > 0) {
                    let middle = (cells.origin + number as i64) as f64 + 0.5;
                    histogram.add(middle * cells.width(), count);
                }
            }
        }
        Some(histogram)
    }
}

/// Counts in cells of one width.
#[derive(Debug, Clone)]
struct Cells {
    /// e of the width 2^e.
    exponent: i32,
    /// Number of the first cell in memory.
    origin: i64,
    counts: Vec<u64>,
    range: [f64; 2],
    total: u64,
}

/// The number of the cell of width 2^e that holds `x`, as a double: none beyond the whole numbers that doubles have.
fn cell(x: f64, exponent: i32) -> Option<i64> {
    let scaled = libm::ldexp(x, -exponent);
    if x < 0.0 && scaled == 0.0 {
        return Some(-1);
    }
    let cell = scaled.floor();
    (cell.abs() <= (1_u64 << 53) as f64).then_some(cell as i64)
}

impl Cells {
    fn new() -> Self {
        Cells {
            exponent: FINEST,
            origin: 0,
            counts: Vec::new(),
            range: [f64::INFINITY, f64::NEG_INFINITY],
            total: 0,
        }
    }

    fn width(&self) -> f64 {
        libm::ldexp(1.0, self.exponent)
    }

    fn add(&mut self, x: f64) {
        self.reach([x, x]);
        let place = cell(x, self.exponent).unwrap_or_default() - self.origin;
        self.counts[place as usize] += 1;
        self.total += 1;
    }

    fn merge(&mut self, other: &Cells) {
        if other.total == 0 {
            return;
        }
        self.reach(other.range);
        let coarser = self.exponent - other.exponent;
        for (number, &count) in other.counts.iter().enumerate().filter(|cell| *cell.1 > 0) {
            let place = shift(other.origin + number as i64, coarser) - self.origin;
            self.counts[place as usize] += count;
        }
        self.total += other.total;
    }

    /// Makes room for values between these.
    fn reach(&mut self, [least, most]: [f64; 2]) {
        let [from, to] = self.range;
        if least >= from && most <= to {
            return;
        }
        self.range = [from.min(least), to.max(most)];
        let fits = |exponent: i32| {
            let ends = self.range.map(|x| cell(x, exponent));
            let [first, last] = [ends[0]?, ends[1]?];
            (last - first < CELLS as i64).then_some((exponent, first, last))
        };
        // A range of doubles has at most 2^1025 in it, so that the coarsest always fits.
        let found = (self.exponent..=COARSEST).find_map(fits);
        let (exponent, first, last) = found.unwrap_or((COARSEST, -1, 1));
        let room = self.origin..self.origin + self.counts.len() as i64;
        if exponent == self.exponent && room.contains(&first) && room.contains(&last) {
            return;
        }
        let origin = (first + last) / 2 - CELLS as i64;
        let old = std::mem::replace(&mut self.counts, vec![0; ROOM]);
        for (number, count) in old.into_iter().enumerate().filter(|cell| cell.1 > 0) {
            let place = shift(self.origin + number as i64, exponent - self.exponent) - origin;
            self.counts[place as usize] += count;
        }
        (self.exponent, self.origin) = (exponent, origin);
    }

    /// About the value with `rank` smaller ones: in the same cell.
    fn order(&self, rank: u64) -> f64 {
        // The ends are known as they are.
        if rank == 0 || rank + 1 == self.total {
            return self.range[usize::from(rank > 0)];
        }
        let mut before = 0;
        for (number, &count) in self.counts.iter().enumerate() {
            if rank < before + count {
                let part = ((rank - before) as f64 + 0.5) / count as f64;
                let x = (self.origin + number as i64) as f64 + part;
                return (x * self.width()).clamp(self.range[0], self.range[1]);
            }
            before += count;
        }
        self.range[1]
    }
}

/// The cell that holds a cell, so many doublings coarser.
fn shift(cell: i64, doublings: i32) -> i64 {
    cell >> doublings.min(63)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::normal;
    use crate::random::{Philox, uniform, uniform_open};

    const P: [f64; 3] = [0.00135, 0.5, 0.99865];

    fn of(limit: usize, values: &[f64]) -> Quantiles {
        let mut all = Quantiles::new(limit);
        values.iter().for_each(|&x| all.push(x));
        all
    }

    fn exponentials() -> Vec<f64> {
        let philox = Philox::new([7, 0]);
        let value = |number| libm::exp(3.0 * uniform(philox.word(number)));
        (0..1000).map(value).collect()
    }

    /// numpy: `quantile(y, [0.00135, 0.5, 0.99865])` and `histogram(y, 'fd')` of `y = exp(3 random(1000))`.
    #[test]
    fn few_values_are_exact() {
        let all = of(1000, &exponentials());
        let found = all.at(&P).expect("values");
        for (found, expected) in
            found
                .iter()
                .zip([1.0090494266484664, 4.351859439340311, 19.953314502498056])
        {
            assert!((found / expected - 1.0).abs() < 1e-14, "{found} {expected}");
        }
        assert_eq!(all.error(), 0.0);
        let histogram = all.histogram(Bins::FreedmanDiaconis).expect("values");
        assert_eq!(
            histogram.counts,
            [301, 152, 96, 74, 72, 62, 39, 45, 31, 33, 23, 22, 20, 30]
        );
        let ends = all.at(&[0.0, 1.0]).expect("values");
        assert_eq!([histogram.from, histogram.to], ends[..]);
    }

    #[test]
    fn many_values_are_within_the_stated_error() {
        let philox = Philox::new([1, 0]);
        let value = |number| 80.0 + 0.01 * normal::quantile(uniform_open(philox.word(number)));
        let values: Vec<f64> = (0..200_000).map(value).collect();
        let (exact, cells) = (of(200_000, &values), of(1000, &values));
        let [least, most] = [0.0, 1.0].map(|p| exact.at(&[p]).expect("values")[0]);
        assert!(
            cells.error() > 0.0 && cells.error() <= (most - least) / 2.0_f64.powf(16.9),
            "{}",
            cells.error()
        );
        let (exact, found) = (exact.at(&P).expect("values"), cells.at(&P).expect("values"));
        for (exact, found) in exact.iter().zip(&found) {
            assert!((exact - found).abs() <= cells.error(), "{exact} {found}");
        }
        assert_eq!(cells.at(&[0.0, 1.0]), Some(vec![least, most]));
        let histogram = cells.histogram(Bins::Count(50)).expect("values");
        assert_eq!(histogram.counts.iter().sum::<u64>(), 200_000);
    }

    /// A sweep grows the range with every value: cells move seldom, or this takes hours.
    #[test]
    fn sorted_values_take_no_longer() {
        let mut all = Quantiles::new(10);
        (0..3_000_000).for_each(|k| all.push(f64::from(k)));
        assert_eq!(all.count(), 3_000_000);
        let median = all.at(&[0.5]).expect("values")[0];
        assert!((median - 1_499_999.5).abs() <= all.error(), "{median}");
        assert_eq!(all.error(), 16.0);
    }

    #[test]
    fn extreme_values_have_their_cells() {
        let all = of(0, &[f64::MAX, f64::MIN, -5e-324, 0.0, 5e-324]);
        assert_eq!(all.at(&[0.0, 1.0]), Some(vec![f64::MIN, f64::MAX]));
        let far = of(2, &[f64::MAX, f64::MIN]);
        assert_eq!(
            far.at(&[0.0, 0.5, 1.0]),
            Some(vec![f64::MIN, 0.0, f64::MAX])
        );
        let same = of(0, &[0.1; 9]);
        assert_eq!(same.at(&P), Some(vec![0.1; 3]));
        assert_eq!(Quantiles::new(3).at(&P), None);
    }

    proptest::proptest! {
        #[test]
        fn neither_order_nor_split_matters(
            values in proptest::collection::vec(-1e6..1e6_f64, 1..60), limit in 0..40_usize, at in 0..60_usize,
        ) {
            let (first, rest) = values.split_at(at.min(values.len()));
            let mut joined = of(limit, rest);
            joined.merge(&of(limit, first));
            let whole = of(limit, &values);
            proptest::prop_assert_eq!(joined.at(&[0.0, 0.1, 0.5, 1.0]), whole.at(&[0.0, 0.1, 0.5, 1.0]));
            proptest::prop_assert_eq!(joined.error(), whole.error());
        }
    }
}
