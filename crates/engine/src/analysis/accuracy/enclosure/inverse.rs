//! C, an inverse of J₀ but for rounding, and what it leaves.

use crate::system::System;

/// Of four coordinates, that go through sums together.
pub(super) type Four = [f64; 4];

/// What widens sums by more than their rounding.
pub(super) const WIDENED: f64 = 1.0 + 1e-12;

/// Parts of a product of J₀ are off by this much of it, before there are many.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// J₀ by its columns.
pub(super) struct Columns {
    /// Row of each entry, and its number among all, column by column.
    entries: Vec<[u32; 2]>,
    /// Where those of each column end (n).
    ends: Vec<u32>,
    /// Their values.
    values: Vec<f64>,
    /// How far the sum of a column's products is off by rounding, at most, as a part of the sum of their sizes.
    rounding: f64,
    /// Room for what a row's entries come to (m).
    sizes: Vec<f64>,
}

impl Columns {
    /// Of a mechanism.
    pub fn new(system: &System) -> Columns {
        let mut columns: Vec<Vec<[u32; 2]>> = vec![Vec::new(); system.n()];
        for (index, entry) in system.entries.iter().enumerate() {
            if let Some(column) = entry.column() {
                columns[column as usize].push([entry.row, index as u32]);
            }
        }
        let longest = columns.iter().map(Vec::len).max().unwrap_or(0);
        let mut end = 0;
        let ends = columns.iter().map(|column| {
            end += column.len() as u32;
            end
        });
        Columns {
            ends: ends.collect(),
            values: vec![0.0; columns.iter().map(Vec::len).sum()],
            entries: columns.concat(),
            rounding: ROUNDING.max(longest as f64 * f64::EPSILON),
            sizes: vec![0.0; system.m()],
        }
    }

    /// Takes J₀ of the pose.
    pub fn take(&mut self, jacobian: &[f64]) {
        for (value, &[_, index]) in self.values.iter_mut().zip(&self.entries) {
            *value = jacobian[index as usize];
        }
    }

    /// Row and value of the entries of each column.
    pub fn each(&self) -> impl Iterator<Item = impl Iterator<Item = (usize, f64)>> {
        let mut begin = 0;
        self.ends.iter().map(move |&end| {
            let span = begin..end as usize;
            begin = span.end;
            let rows = self.entries[span.clone()].iter();
            let rows = rows.map(|&[row, _]| row as usize);
            rows.zip(self.values[span].iter().copied())
        })
    }
}

/// Rows of C of some coordinates.
pub(super) struct Inverse {
    /// The columns of the coordinates.
    pub wanted: Vec<usize>,
    /// The place of each column of J among them, behind them of the others (n).
    places: Vec<u32>,
    /// Four rows of C by columns (m), then the next four.
    pub rows: Vec<Four>,
    /// Number of rows of J.
    m: usize,
}

impl Inverse {
    /// With room for these coordinates.
    pub fn new(system: &System, wanted: Vec<usize>) -> Inverse {
        let fours = wanted.len().div_ceil(4);
        let mut places = vec![4 * fours as u32; system.n()];
        for (place, &column) in wanted.iter().enumerate() {
            places[column] = place as u32;
        }
        Inverse {
            rows: vec![[0.0; 4]; fours * system.m()],
            m: system.m(),
            places,
            wanted,
        }
    }

    /// For each four coordinates their rows of C.
    pub fn fours(&self) -> impl ExactSizeIterator<Item = &[Four]> {
        self.rows.chunks_exact(self.m.max(1))
    }

    /// Adds |C| rows to as many images as are asked for, each of its own kind of rows.
    pub fn add_images<const R: usize, const K: usize>(
        &self,
        rows: &[[f64; R]],
        images: &mut [&mut [f64]; K],
    ) {
        for (g, own) in self.fours().enumerate() {
            let mut sums = [[0.0; 4]; K];
            for (c, by) in own.iter().zip(rows) {
                for (sum, by) in sums.iter_mut().zip(by) {
                    for (sum, c) in sum.iter_mut().zip(c) {
                        *sum += c.abs() * by;
                    }
                }
            }
            for (image, sum) in images.iter_mut().zip(sums) {
                for (x, sum) in image[4 * g..][..4].iter_mut().zip(sum) {
                    *x += sum;
                }
            }
        }
    }

    /// Adds |I − C J₀| x and its rounding to images alike; `x` by the `slots` of the coordinates.
    pub fn add_residual(
        &self,
        columns: &mut Columns,
        (slots, x): (&[u32], &[f64]),
        images: &mut [&mut [f64]],
    ) {
        let mut sizes = std::mem::take(&mut columns.sizes);
        sizes.fill(0.0);
        for (column, slot) in columns.each().zip(slots) {
            let x = columns.rounding * x[*slot as usize];
            for (row, value) in column {
                sizes[row] += value.abs() * x;
            }
        }
        for (g, own) in self.fours().enumerate() {
            let mut sum = [0.0; 4];
            for (c, size) in own.iter().zip(&sizes) {
                for (sum, c) in sum.iter_mut().zip(c) {
                    *sum += c.abs() * size;
                }
            }
            let places = self.places.iter().zip(slots);
            for (column, (&place, &slot)) in columns.each().zip(places) {
                let mut left = [0.0; 4];
                if place as usize / 4 == g {
                    left[place as usize % 4] = 1.0;
                }
                for (row, value) in column {
                    for (left, c) in left.iter_mut().zip(&own[row]) {
                        *left -= c * value;
                    }
                }
                for (sum, left) in sum.iter_mut().zip(left) {
                    *sum += left.abs() * x[slot as usize];
                }
            }
            for image in &mut *images {
                for (x, sum) in image[4 * g..][..4].iter_mut().zip(sum) {
                    *x += sum * WIDENED;
                }
            }
        }
        columns.sizes = sizes;
    }
}
