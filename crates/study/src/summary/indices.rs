//! Sobol indices: which share of the variance an input causes.
//!
//! ```text
//! first order   S_k = mean((f(B) − m)(f(A_B^k) − f(A)))/V     A_B^k: A with column k from B
//! total         T_k = mean((f(A) − f(A_B^k))²)/(2V)
//! m, V          mean and variance of f(A) and f(B) together
//! ```
//!
//! Sources: first order, Saltelli and others, Comput. Phys. Commun. 181, 2010, equation (b) of table 2, with the mean taken from f(B), which
//! changes no expectation and lessens the scatter; total, Jansen, Comput. Phys. Commun. 117, 1999.
//!
//! Points go in turn into 1000 groups, of which only sums are kept, so that memory is flat. The interval comes from drawing groups with
//! replacement (bootstrap by percentiles, Efron 1979); up to 1000 points that is the usual bootstrap of points. With few points it is
//! narrow: of a sum of three even inputs it held the true indices in 91 of 100 studies of 16 points, in 93 of 64, in 94 of 256. For Sobol
//! points and Latin hypercubes it is as a rule wider than need be, since it takes points for independent.
//!
//! A point counts only if all of its rows have a value; the others are counted as left out.

use serde::Serialize;

use super::sum::Sum;
use crate::random::{Philox, Purpose, below};

const GROUPS: usize = 1000;
const REPLICATES: usize = 1000;
/// Share of the replicates on each side of the interval: 95 % are within.
const TAIL: f64 = 0.025;

/// An index with its interval of about 95 %.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Index {
    /// The estimate.
    pub value: f64,
    /// Where the interval begins.
    pub lower: f64,
    /// Where it ends.
    pub upper: f64,
}

/// Indices of all inputs.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Indices {
    /// First order, by input.
    pub first: Vec<Index>,
    /// Total, by input.
    pub total: Vec<Index>,
    /// Points that count.
    pub points: u64,
    /// Points left out because a row of theirs has no value.
    pub left_out: u64,
}

/// Sums over the points of a group, about a common shift.
#[derive(Debug, Clone)]
struct Group {
    count: u64,
    /// Σ f(A) + f(B), Σ f(A)² + f(B)².
    ends: [Sum; 2],
    /// By input: Σ f(B) (f(A_B) − f(A)), Σ f(A_B) − f(A), Σ (f(A) − f(A_B))².
    inputs: Vec<[Sum; 3]>,
}

/// Collects the responses of points in Saltelli's layout.
#[derive(Debug, Clone)]
pub struct SobolIndices {
    inputs: usize,
    shift: Option<f64>,
    groups: Vec<Group>,
    points: u64,
    left_out: u64,
}

impl SobolIndices {
    /// For so many inputs.
    pub fn new(inputs: usize) -> Self {
        SobolIndices {
            inputs,
            shift: None,
            groups: Vec::new(),
            points: 0,
            left_out: 0,
        }
    }

    /// Takes the responses of the rows of one point, in the order of the rows (inputs + 2); points must come in order.
    pub fn push(&mut self, rows: &[f64]) {
        let number = (self.points + self.left_out) as usize % GROUPS;
        if rows.len() != self.inputs + 2 || rows.iter().any(|y| !y.is_finite()) {
            self.left_out += 1;
            return;
        }
        while self.groups.len() <= number {
            self.groups.push(Group {
                count: 0,
                ends: [Sum::default(); 2],
                inputs: vec![[Sum::default(); 3]; self.inputs],
            });
        }
        let shift = *self.shift.get_or_insert(rows[0]);
        let group = &mut self.groups[number];
        let [a, b] = [rows[0] - shift, rows[self.inputs + 1] - shift];
        group.count += 1;
        group.ends[0].add(a + b);
        group.ends[1].add(a * a + b * b);
        for (sums, y) in group.inputs.iter_mut().zip(&rows[1..]) {
            let step = (y - shift) - a;
            sums[0].add(b * step);
            sums[1].add(step);
            sums[2].add(step * step);
        }
        self.points += 1;
    }

    /// The indices; `None` if nothing scatters. The seed is that of the study.
    pub fn indices(&self, seed: u64) -> Option<Indices> {
        let groups: Vec<Plain> = self.groups.iter().map(Plain::of).collect();
        let one_each = vec![1.0; groups.len()];
        let values = self.estimate(&groups, &one_each)?;
        let philox = Philox::of(seed, Purpose::Bootstrap);
        let mut replicates = Vec::with_capacity(REPLICATES);
        for replicate in 0..REPLICATES {
            let mut times = vec![0.0; groups.len()];
            for draw in 0..groups.len() {
                let number = (replicate * groups.len() + draw) as u128;
                let drawn = below(philox.word(number), groups.len() as u64);
                times[drawn as usize] += 1.0;
            }
            replicates.extend(self.estimate(&groups, &times));
        }
        let with_interval = |place: usize| {
            let mut all: Vec<f64> = replicates.iter().map(|values| values[place]).collect();
            all.sort_unstable_by(f64::total_cmp);
            let at = |p: f64| all[(p * (all.len() - 1) as f64).round() as usize];
            let value = values[place];
            // With few points no replicate may scatter.
            let [lower, upper] = match all.is_empty() {
                true => [value; 2],
                false => [at(TAIL), at(1.0 - TAIL)],
            };
            Index {
                value,
                lower,
                upper,
            }
        };
        Some(Indices {
            first: (0..self.inputs).map(with_interval).collect(),
            total: (self.inputs..2 * self.inputs).map(with_interval).collect(),
            points: self.points,
            left_out: self.left_out,
        })
    }

    /// First orders and totals of groups that count so many times.
    fn estimate(&self, groups: &[Plain], times: &[f64]) -> Option<Vec<f64>> {
        let mut count = 0.0;
        let mut ends = [0.0; 2];
        let mut inputs = vec![[0.0; 3]; self.inputs];
        for (group, &times) in groups.iter().zip(times).filter(|(_, times)| **times > 0.0) {
            count += times * group.count;
            for (sum, more) in ends.iter_mut().zip(group.ends) {
                *sum += times * more;
            }
            for (sums, more) in inputs.iter_mut().zip(&group.inputs) {
                for (sum, more) in sums.iter_mut().zip(more) {
                    *sum += times * more;
                }
            }
        }
        let mean = ends[0] / (2.0 * count);
        let variance = ends[1] / (2.0 * count) - mean * mean;
        // What remains of the squares after rounding is no variance.
        if variance.is_nan() || variance <= 8.0 * f64::EPSILON * mean * mean {
            return None;
        }
        let first = inputs
            .iter()
            .map(|sums| (sums[0] - mean * sums[1]) / (count * variance));
        let total = inputs.iter().map(|sums| sums[2] / (2.0 * count * variance));
        Some(first.chain(total).collect())
    }
}

/// The sums of a group as they are.
struct Plain {
    count: f64,
    ends: [f64; 2],
    inputs: Vec<[f64; 3]>,
}

impl Plain {
    fn of(group: &Group) -> Self {
        Plain {
            count: group.count as f64,
            ends: group.ends.map(|sum| sum.value()),
            inputs: group
                .inputs
                .iter()
                .map(|sums| sums.map(|sum| sum.value()))
                .collect(),
        }
    }
}

#[cfg(test)]
mod tests;
