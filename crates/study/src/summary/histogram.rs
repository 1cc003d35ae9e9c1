//! Counts in bins of one width.

use serde::Serialize;

/// Bins at most: more than a picture shows.
const MOST: u64 = 200;

/// How many bins a histogram has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bins {
    /// Of width 2 (Q₃ − Q₁) n^(−1/3), at most 200 (Freedman and Diaconis 1981); log₂ n + 1 where the quartiles are the same (Sturges).
    FreedmanDiaconis,
    /// So many.
    Count(usize),
}

impl Bins {
    /// For `n` values with these: least, quartiles, largest.
    pub(super) fn count(self, n: u64, ends: &[f64]) -> usize {
        let asked = match self {
            Bins::Count(count) => return count.max(1),
            Bins::FreedmanDiaconis => {
                let width = 2.0 * (ends[2] - ends[1]) / libm::cbrt(n as f64);
                let sturges = libm::log2(n as f64).ceil() + 1.0;
                let bins = ((ends[3] - ends[0]) / width).ceil();
                if width > 0.0 { bins } else { sturges }
            }
        };
        (asked as u64).clamp(1, MOST) as usize
    }
}

/// Counts in bins of one width from the least to the largest value.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Histogram {
    /// Where the first bin begins.
    pub from: f64,
    /// Where the last bin ends; the largest value belongs to it.
    pub to: f64,
    /// How many values each bin holds.
    pub counts: Vec<u64>,
}

impl Histogram {
    pub(super) fn new([from, to]: [f64; 2], bins: usize) -> Self {
        Histogram {
            from,
            to,
            counts: vec![0; bins],
        }
    }

    pub(super) fn add(&mut self, x: f64, count: u64) {
        let bins = self.counts.len();
        // Halves, since the difference of two doubles may be none.
        let part = (0.5 * x - 0.5 * self.from) / (0.5 * self.to - 0.5 * self.from);
        let bin = ((part * bins as f64) as usize).min(bins - 1);
        self.counts[bin] += count;
    }
}
